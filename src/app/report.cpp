// SPDX-License-Identifier: Apache-2.0
#include "incise/app/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/json_write.h"
#include "incise/version.h"

namespace incise::inline v0 {
namespace app {
namespace {

constexpr std::size_t kMaxPiecesListed = 1000;
constexpr std::size_t kMaxPiecesShown = 8;

Json json_of(const MeshCounts& counts) {
  return {{"vertices", counts.vertices}, {"tets", counts.tets}, {"components", counts.components}};
}

Json json_of(const Percentiles& p) {
  return {{"p50", p.p50}, {"p99", p.p99}, {"p999", p.p999}, {"max", p.max}};
}

Json json_of(const ReportOptions& options) {
  Json root = {{"profile", options.profile == Profile::kPaper ? "paper" : "incise"},
               {"snap", options.snap},
               {"merge", false},
               {"improve", false},
               {"threads", options.threads},
               {"seed", options.seed}};
  if (!options.blade.empty()) root["blade"] = options.blade;
  if (!options.plane.empty()) root["plane"] = options.plane;
  return root;
}

Json json_of(const CutStatistics& cut) {
  return {{"steps", cut.steps},
          {"cut_tets", cut.cut_tets},
          {"created_tets", cut.created_tets},
          {"new_vertices", cut.new_vertices},
          {"incision_faces", cut.incision_faces},
          {"snapped_vertices", cut.snapped_vertices},
          {"bent_vertices", cut.bent_vertices},
          {"copied_vertices", cut.copied_vertices},
          {"crumbs_kept", cut.crumbs_kept},
          {"pinched_edges", cut.pinched_edges},
          {"latent_faces", cut.latent_faces},
          {"sheets", cut.sheets}};
}

Json json_of(const StageTimes& times, double total_ms) {
  Json root;
  for (std::size_t i = 0; i < kStageNames.size(); ++i) root[kStageNames[i]] = times.ms[i];
  root["total"] = total_ms;
  return root;
}

Json stage_percentiles(const std::vector<StageTimes>& samples) {
  Json root;
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    std::vector<double> of_stage;
    for (const StageTimes& sample : samples) of_stage.push_back(sample.ms[i]);
    root[kStageNames[i]] = json_of(percentiles(std::move(of_stage)));
  }
  return root;
}

Json json_of(const std::vector<PieceFigures>& pieces) {
  Json list = Json::array();
  for (std::size_t i = 0; i < pieces.size() && i < kMaxPiecesListed; ++i) {
    list.push_back({{"tets", pieces[i].tets}, {"volume", encode(pieces[i].volume)}});
  }
  return list;
}

double relative_error(const CutReport& report) {
  if (!(report.volume_before > 0)) return 0;
  return std::abs(report.volume_after - report.volume_before) / report.volume_before;
}

// `ok` is about what the cut did: violations that the input brought along are listed, but do not count.
Json validity_json(const CutReport& report) {
  Json root;
  root["ok"] = report.change.ok;
  root["before"] = encode(report.validity_before)["violations"];
  root["after"] = encode(report.validity_after)["violations"];
  root["grown"] = Json::object();
  for (std::size_t i = 0; i < kViolationKinds; ++i) {
    if (report.change.grown[i] > 0) {
      root["grown"][std::string(name_of(static_cast<ViolationKind>(i)))] = report.change.grown[i];
    }
  }
  root["first"] = encode(report.validity_after)["first"];
  return root;
}

}  // namespace

Percentiles percentiles(std::vector<double> sample) {
  if (sample.empty()) return {};
  std::sort(sample.begin(), sample.end());
  const auto rank = [&](double share) {
    const double n = std::ceil(share * static_cast<double>(sample.size()));
    return sample[std::clamp<std::size_t>(static_cast<std::size_t>(n), 1, sample.size()) - 1];
  };
  return {rank(0.5), rank(0.99), rank(0.999), sample.back()};
}

std::string to_json(const CutReport& report) {
  Json root;
  root["format"] = "incise-report";
  root["version"] = 1;
  root["program"] = "incise " INCISE_VERSION;
  root["input"] = {{"file", report.input}, {"format", report.input_format}, {"notes", report.notes}};
  root["options"] = json_of(report.options);
  root["strokes"] = report.strokes;
  root["mesh"] = {{"before", json_of(report.before)}, {"after", json_of(report.after)}};
  root["pieces"] = json_of(report.pieces);
  root["cut"] = json_of(report.cut);
  root["quality"] = {{"before", encode(report.quality_before)},
                     {"cut", encode(report.quality_cut)},
                     {"after", encode(report.quality_after)}};
  root["quality"]["after"]["incision"] = encode(report.quality_incision);
  root["volume"] = {{"before", encode(report.volume_before)},
                    {"after", encode(report.volume_after)},
                    {"relative_error", encode(relative_error(report))}};
  root["validity"] = validity_json(report);
  root["time_ms"] = json_of(report.times, report.total_ms);
  root["step_ms"] = json_of(percentiles(report.step_ms));
  root["stage_ms"] = stage_percentiles(report.stage_ms);
  root["hash"] = fmt::format("{:016x}", report.hash);
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_text(const CutReport& report) {
  std::string text =
      fmt::format("{} -> {} tets, {} -> {} vertices, {} -> {} pieces\n", report.before.tets, report.after.tets,
                  report.before.vertices, report.after.vertices, report.before.components, report.after.components);
  for (std::size_t i = 0; i < report.pieces.size() && i < kMaxPiecesShown; ++i) {
    text += fmt::format("  piece {}: {} tets, volume {:.9g}\n", i, report.pieces[i].tets, report.pieces[i].volume);
  }
  if (report.pieces.size() > kMaxPiecesShown) {
    text += fmt::format("  and {} more\n", report.pieces.size() - kMaxPiecesShown);
  }
  text +=
      fmt::format("cut {} tets in {} steps: {} faces opened, {} vertices snapped, {} bent\n", report.cut.cut_tets,
                  report.cut.steps, report.cut.incision_faces, report.cut.snapped_vertices, report.cut.bent_vertices);
  text += fmt::format("L/r max {:.4g} -> {:.4g}, {:.3g} -> {:.3g} % over 200\n", report.quality_before.lr_max,
                      report.quality_after.lr_max, report.quality_before.lr_over_200_pct,
                      report.quality_after.lr_over_200_pct);
  text += fmt::format("volume changed by {:.2g} (relative); {}\n", relative_error(report),
                      report.change.ok ? "valid" : "INVALID");
  return text + fmt::format("{:.3f} ms, hash {:016x}\n", report.total_ms, report.hash);
}

}  // namespace app
}  // namespace incise::inline v0
