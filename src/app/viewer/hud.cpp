// SPDX-License-Identifier: Apache-2.0
// Rates are differences of sums over a window of samples; rows of figures are made as text, so that every front end
// shows the same.
#include "app/viewer/hud.h"

#include <algorithm>

#include "app/text/formatted.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr double kWindow = 1;     // s
constexpr double kKeepsUp = 0.9;  // of real time: below it the person is told

double per(double sum, std::uint64_t count) {
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

std::string ratio_text(double ratio) {
  return ratio < 1000 ? formatted("{:.2f}", ratio) : formatted("{:.3g}", ratio);
}

}  // namespace

void Hud::add(double now, double draw_ms, std::uint64_t session, const SessionFigures& figures) {
  Sample sample;
  if (!samples_.empty() && samples_.back().session == session && samples_.back().frames <= figures.frames) {
    sample = samples_.back();
  } else {
    samples_.clear();  // another body, or the same from its start
  }
  sample.now = now;
  sample.session = session;
  ++sample.pictures;
  sample.draw_ms += draw_ms;
  sample.frames = figures.frames;
  sample.times = figures.times;
  samples_.push_back(sample);
  while (samples_.size() > 2 && samples_[1].now < now - kWindow) samples_.pop_front();
}

double Hud::pictures_per_second() const {
  if (samples_.size() < 2) return 0;
  const double passed = samples_.back().now - samples_.front().now;
  return passed > 0 ? static_cast<double>(samples_.back().pictures - samples_.front().pictures) / passed : 0;
}

std::array<StageRow, 4> Hud::stages() const {
  std::array<StageRow, 4> rows = {{{"CD", 0, 0}, {"GM", 0, 0}, {"RLX", 0, 0}, {"RD", 0, 0}}};
  if (samples_.size() < 2) return rows;
  const Sample &first = samples_.front(), &last = samples_.back();
  StageTimes times = last.times;
  times -= first.times;
  const std::uint64_t frames = last.frames - first.frames;
  rows[0].ms = per(times[Stage::kCollision], frames);
  rows[2].ms = per(times[Stage::kRelax], frames);
  rows[1].ms = std::max(0.0, per(times.total(), frames) - rows[0].ms - rows[2].ms);
  rows[3].ms = per(last.draw_ms - first.draw_ms, last.pictures - first.pictures);
  double sum = 0;
  for (const StageRow& row : rows) sum += row.ms;
  for (StageRow& row : rows) row.percent = sum > 0 ? 100 * row.ms / sum : 0;
  return rows;
}

std::vector<HudRow> rate_rows(const Hud& hud, const SessionView& view) {
  std::vector<HudRow> rows;
  rows.push_back({"Pictures", formatted("{:.0f} /s", hud.pictures_per_second()), ""});
  if (view.is_paused) {
    rows.push_back({"Simulation", "paused", "Space goes on"});
    return rows;
  }
  rows.push_back({"Simulation", formatted("{:.0f} steps/s", view.steps_per_second), ""});
  if (view.real_time > 0 && view.real_time < kKeepsUp) {
    rows.back().remark = formatted("slow: {:.2f} of real time", view.real_time);
  }
  return rows;
}

std::vector<HudRow> mesh_rows(const SessionView& view) {
  const SessionFigures& f = view.figures;
  const auto start = static_cast<double>(std::max<std::uint64_t>(f.tets_at_start, 1));
  std::vector<HudRow> rows;
  rows.push_back({"Tets", with_commas(f.tets), formatted("{:.2f} x the start", static_cast<double>(f.tets) / start)});
  rows.push_back({"Vertices", with_commas(f.vertices), ""});
  rows.push_back({"Strokes", with_commas(f.strokes), formatted("{} tets cut", with_commas(f.cut.cut_tets))});
  return rows;
}

std::vector<QualityRow> quality_rows(const SessionView& view) {
  const QualityFigures &a = view.quality_before, &b = view.quality;
  return {{"min", ratio_text(a.lr_min), ratio_text(b.lr_min)},
          {"mean", ratio_text(a.lr_mean), ratio_text(b.lr_mean)},
          {"max", ratio_text(a.lr_max), ratio_text(b.lr_max)},
          {"over 200", formatted("{:.2f} %", a.lr_over_200_pct), formatted("{:.2f} %", b.lr_over_200_pct)}};
}

std::vector<HudRow> force_rows(const SessionView& view) {
  const SessionFigures& f = view.figures;
  std::vector<HudRow> rows;
  rows.push_back({"Now", formatted("{:.2f} N", f.blade.force.norm()), f.blade.touches ? "touches" : ""});
  rows.push_back({"At most", formatted("{:.2f} N", f.peak_force), ""});
  rows.push_back({"Edge in tissue", formatted("{:.1f} mm", 1e3 * f.blade.engaged_length), ""});
  return rows;
}

std::string with_commas(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, 1, ',');
  return text;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
