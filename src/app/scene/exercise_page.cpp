// SPDX-License-Identifier: Apache-2.0
// HTML as text, its drawings as SVG and its pictures as base64. All that comes from a scene goes through one function
// that quotes it.
#include "app/scene/exercise_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "app/text/formatted.h"
#include "app/text/markup.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr double kChartWidth = 640, kChartHeight = 220, kChartEdge = 44;  // CSS pixels
constexpr double kTallestPlan = 360;                                      // CSS pixels
constexpr std::size_t kMostForceDots = 400;                               // of the drawing of force over time

constexpr const char* kPageHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width,initial-scale=1">
<title>{}</title><style>
body{{font:16px/1.5 system-ui,sans-serif;max-width:46rem;margin:2rem auto;padding:0 1rem;color:#1b2228;background:#fff}}
h1{{margin:0 0 .3rem}}h2{{margin:2rem 0 .5rem;font-size:1.15rem}}.points{{font-size:2rem;font-weight:600}}
.yes{{color:#00704f}}.no{{color:#a83f00}}table{{border-collapse:collapse;width:100%}}
td,th{{text-align:left;padding:.25rem .6rem .25rem 0;border-bottom:1px solid #dde2e7;vertical-align:top}}
td.n{{text-align:right;white-space:nowrap}}img,svg{{max-width:100%;height:auto;display:block}}figure{{margin:1rem 0}}
figcaption{{color:#56616b;font-size:.9rem}}text{{font:12px system-ui,sans-serif;fill:#56616b}}
</style></head><body>
)";

/// What a kind of fault is called.
const char* fault_name(std::string_view kind) {
  constexpr std::array<std::pair<std::string_view, const char*>, 18> kNames = {
      {{"nothing", "Something was cut"},
       {"missed", "All of the line is cut"},
       {"line", "On the line"},
       {"overshoot", "Within its ends"},
       {"depth", "Depth, on average"},
       {"too_deep", "Nowhere too deep"},
       {"through", "Not through and through"},
       {"angle", "Angle of the edge"},
       {"elsewhere", "No skin cut elsewhere"},
       {"elsewhere_area", "No walls elsewhere"},
       {"strokes", "Number of strokes"},
       {"force", "Force"},
       {"undivided", "Layers are cut through"},
       {"wound", "Tissue stays whole"},
       {"piece", "A piece came off"},
       {"share", "The piece holds enough"},
       {"margin", "Margin"},
       {"volume", "Size of the piece"}}};
  for (const auto& [name, text] : kNames) {
    if (name == kind) return text;
  }
  return "Other";
}

const std::string* reason_of(const ExerciseScore& score, std::size_t criterion) {
  std::size_t deduction = 0;  // those that cost something come in the same order
  for (std::size_t i = 0; i < criterion; ++i) deduction += score.criteria[i].lost > 0 ? 1U : 0U;
  const bool has = score.criteria[criterion].lost > 0 && deduction < score.deductions.size();
  return has ? &score.deductions[deduction].reason : nullptr;
}

std::string criteria_table(const ExerciseScore& score) {
  std::string html =
      "<h2>What was judged</h2>\n<table><tr><th>Criterion</th><th>Lost, of at most</th><th>Why</th></tr>\n";
  for (std::size_t i = 0; i < score.criteria.size(); ++i) {
    const ExerciseCriterion& c = score.criteria[i];
    const std::string* reason = reason_of(score, i);
    html += formatted("<tr><td>{}</td><td class=\"n\">{:.1f} of {:.0f}</td><td>{}</td></tr>\n", fault_name(c.kind),
                      c.lost, c.most, reason != nullptr ? as_markup(*reason) : std::string());
  }
  return html + "</table>\n";
}

std::string tissue_table(const ExerciseScore& score) {
  if (score.wounds.empty() && !score.removed) return {};
  std::string html = "<h2>What became of the tissue</h2>\n<table>\n";
  for (const ExerciseWound& w : score.wounds) {
    html += formatted("<tr><td>{}</td><td>cut {:.3g} deep; {:.3g} is allowed</td></tr>\n", as_markup(w.name), w.depth,
                      w.allowed);
  }
  if (score.removed) {
    const ExerciseRemoved& r = *score.removed;
    html += formatted("<tr><td>{}</td><td>{}</td></tr>\n", as_markup(r.name),
                      r.has_piece
                          ? formatted("{:.3g} % of it is in a piece with a volume of {:.4g}; margin {:.3g} to {:.3g}",
                                      100 * r.share, r.volume, r.margin_least, r.margin_most)
                          : std::string("nothing came off"));
  }
  return html + "</table>\n";
}

/// Maps figures to places of a drawing.
class Chart {
 public:
  Chart(double left, double right, double bottom, double top, double height = kChartHeight)
      : left_(left), right_(right), bottom_(bottom), top_(top), height_(height) {}

  [[nodiscard]] double x(double value) const {
    return kChartEdge + (value - left_) / (right_ - left_) * (kChartWidth - 2 * kChartEdge);
  }
  [[nodiscard]] double y(double value) const {
    return height_ - kChartEdge - (value - bottom_) / (top_ - bottom_) * (height_ - 2 * kChartEdge);
  }
  void line(const std::vector<std::array<double, 2>>& points, const char* color, const char* more = "") {
    std::string list;
    for (const auto& [px, py] : points) list += formatted("{:.1f},{:.1f} ", x(px), y(py));
    svg_ +=
        formatted("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"2\" {} points=\"{}\"/>\n", color, more, list);
  }
  void band(double from, double to) {
    const double upper = std::min(y(from), y(to));
    svg_ += formatted("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#d5efe6\"/>\n",
                      kChartEdge, upper, kChartWidth - 2 * kChartEdge, std::abs(y(from) - y(to)));
  }
  void word(double px, double py, const std::string& text) {
    svg_ += formatted("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", px, py, as_markup(text));
  }
  [[nodiscard]] std::string figure(const std::string& title) const {
    return formatted(
        "<figure><svg viewBox=\"0 0 {:.0f} {:.0f}\" width=\"{:.0f}\" role=\"img\" aria-label=\"{}\">\n{}</svg>"
        "<figcaption>{}</figcaption></figure>\n",
        kChartWidth, height_, kChartWidth, as_markup(title), svg_, as_markup(title));
  }

 private:
  double left_, right_, bottom_, top_, height_;
  std::string svg_;
};

using ChartLine = std::vector<std::array<double, 2>>;

/// The line and the cut, each as points in the plane of the skin; parts that were missed are left out of the cut.
struct PlanLines {
  ChartLine ideal;
  std::vector<ChartLine> cuts;
  std::array<double, 4> box{1e300, -1e300, 1e300, -1e300};  ///< least and greatest x, least and greatest y
};

PlanLines plan_lines(const ExerciseScore& score) {
  Vec3 normal = Vec3::Zero();
  for (const ExercisePlace& place : score.profile) normal += place.normal;
  normal = normal.isZero(0) ? Vec3(Vec3::UnitZ()) : Vec3(normal.normalized());
  const Vec3& from = score.profile.front().ideal;
  Vec3 right = Vec3::Zero();  // to the place that is furthest from the first
  for (const ExercisePlace& place : score.profile) {
    const Vec3 way = place.ideal - from - (place.ideal - from).dot(normal) * normal;
    if (way.squaredNorm() > right.squaredNorm()) right = way;
  }
  right = right.isZero(0) ? Vec3(normal.unitOrthogonal()) : Vec3(right.normalized());
  const Vec3 up = normal.cross(right);
  PlanLines lines;
  const auto add = [&](const Vec3& point, ChartLine& line) {
    const double x = point.dot(right), y = point.dot(up);
    line.push_back({x, y});
    lines.box = {std::min(lines.box[0], x), std::max(lines.box[1], x), std::min(lines.box[2], y),
                 std::max(lines.box[3], y)};
  };
  bool was_cut = false;
  for (const ExercisePlace& place : score.profile) {
    add(place.ideal, lines.ideal);
    if (place.is_cut && !was_cut) lines.cuts.emplace_back();
    if (place.is_cut) add(place.ideal + place.beside, lines.cuts.back());
    was_cut = place.is_cut;
  }
  return lines;
}

/// As seen from above; both ways have the same scale.
std::string plan_figure(const ExerciseScore& score) {
  const PlanLines lines = plan_lines(score);
  const auto& [left, right, low, high] = lines.box;
  const double pad = 0.05 * std::max(right - left, high - low);
  const double wide = right - left + 2 * pad, tall = std::max(high - low + 2 * pad, 0.1 * wide);
  const double inner = kChartWidth - 2 * kChartEdge;
  const double scale = std::min(inner / wide, kTallestPlan / tall);
  const double middle_x = 0.5 * (left + right), middle_y = 0.5 * (low + high), half = 0.5 * inner / scale;
  Chart chart(middle_x - half, middle_x + half, middle_y - 0.5 * tall, middle_y + 0.5 * tall,
              tall * scale + 2 * kChartEdge);
  chart.line(lines.ideal, "#009e73", "stroke-dasharray=\"8 5\"");
  for (const ChartLine& cut : lines.cuts) chart.line(cut, "#a83f00");
  return chart.figure("Seen from above: the line (green, dashed) and the cut (red)");
}

std::string depth_figure(const Exercise& exercise, const ExerciseScore& score) {
  double most = exercise.depth + exercise.tolerances.depth;
  for (const ExercisePlace& place : score.profile) most = std::max(most, place.depth);
  Chart chart(0, score.target_length, -1.1 * most, 0);
  chart.band(-exercise.depth + exercise.tolerances.depth, -exercise.depth - exercise.tolerances.depth);
  chart.line({{0, 0}, {score.target_length, 0}}, "#56616b");
  chart.line({{0, -exercise.depth}, {score.target_length, -exercise.depth}}, "#009e73", "stroke-dasharray=\"8 5\"");
  ChartLine cut;
  const double step = score.target_length / static_cast<double>(score.profile.size());
  for (std::size_t i = 0; i < score.profile.size(); ++i) {
    cut.push_back({(static_cast<double>(i) + 0.5) * step, score.profile[i].is_cut ? -score.profile[i].depth : 0});
  }
  chart.line(cut, "#a83f00");
  chart.word(4, chart.y(0) + 4, "skin");
  chart.word(4, chart.y(-exercise.depth) + 4, formatted("{:.3g}", exercise.depth));
  return chart.figure("Depth along the line: asked for (green, dashed) with what is allowed, and cut (red)");
}

std::string force_figure(const Exercise& exercise, const ExerciseScore& score) {
  if (score.forces.size() < 2) return {};
  const double most = std::max({1e-3, 1.1 * score.peak_force, 1.1 * exercise.max_force});
  Chart chart(0, score.seconds, 0, most);
  if (exercise.max_force > 0) chart.band(0, exercise.max_force);
  const std::size_t each = (score.forces.size() + kMostForceDots - 1) / kMostForceDots;
  ChartLine line;
  for (std::size_t i = 0; i < score.forces.size(); i += each) {
    double greatest = 0;
    for (std::size_t k = i; k < std::min(i + each, score.forces.size()); ++k)
      greatest = std::max(greatest, score.forces[k]);
    line.push_back({score.seconds * static_cast<double>(i) / static_cast<double>(score.forces.size() - 1), greatest});
  }
  chart.line(line, "#0072b2");
  chart.word(4, chart.y(score.peak_force) + 4, formatted("{:.2g} N", score.peak_force));
  chart.word(kChartWidth - kChartEdge - 30, kChartHeight - 20, formatted("{:.3g} s", score.seconds));
  return chart.figure("Force of the tissue on the edge over time");
}

std::string heading_of(const Scene& scene, const ExerciseScore& score) {
  const Exercise& exercise = *scene.exercise;
  const std::string title = as_markup(exercise.name.empty() ? scene.name : exercise.name);
  std::string html = formatted(kPageHead, title);
  html += formatted("<h1>{}</h1>\n<p>{}</p>\n", title, as_markup(exercise.instructions));
  html += formatted(
      "<p><span class=\"points\">{:.1f}</span> of 100 points, <b class=\"{}\">{}</b> ({:.3g} are asked for)</p>\n",
      score.points, score.is_passed ? "yes" : "no", score.is_passed ? "passed" : "not passed", score.pass);
  return html;
}

}  // namespace

std::string to_base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t byte = i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U;
      three = (three << 8U) | byte;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool is_there = k == 0 || i + k - 1 < bytes.size();  // one byte makes two digits, each further one one more
      out += is_there ? kDigits[(three >> (18U - 6U * k)) & 63U] : '=';
    }
  }
  return out;
}

std::string exercise_page(const Scene& scene, const ExerciseScore& score, const std::vector<PagePicture>& pictures) {
  std::string html = heading_of(scene, score);
  for (const PagePicture& picture : pictures) {
    html += formatted("<figure><img alt=\"{}\" src=\"data:image/png;base64,{}\"><figcaption>{}</figcaption></figure>\n",
                      as_markup(picture.title), to_base64(picture.png), as_markup(picture.title));
  }
  html += criteria_table(score) + tissue_table(score);
  html += "<h2>How it was cut</h2>\n" + plan_figure(score) + depth_figure(*scene.exercise, score);
  html += force_figure(*scene.exercise, score);
  return html + "<p>Lengths are in the unit of the scene.</p>\n</body></html>\n";
}

}  // namespace app
}  // namespace v0
}  // namespace incise
