// SPDX-License-Identifier: Apache-2.0
// The report twice, from the same struct: as a tree of JSON and as a table for people.
#include "app/jobs/report.h"

#include <algorithm>
#include <cmath>

#include "app/jobs/report_tree.h"
#include "app/text/counted.h"
#include "app/text/formatted.h"
#include "incise/version.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr std::size_t kMaxPiecesListed = 1000;
constexpr std::size_t kMaxPiecesShown = 8;

Json json_of(const MeshCounts& counts) {
  return {{"vertices", counts.vertices}, {"tets", counts.tets}, {"components", counts.components}};
}

std::string profile_name(const ReportOptions& options) {
  if (options.method) return std::string(name_of(*options.method));
  return options.profile == Profile::kPaper ? "paper" : "incise";
}

Json options_json(const JobReport& report) {
  const ReportOptions& options = report.options;
  Json root = {{"profile", profile_name(options)},
               {"merge", options.merge},
               {"improve", options.improve},
               {"budget_us", options.budget_us > 0 ? Json(options.budget_us) : Json()}};
  if (report.strokes == 0) return root;  // the others are about cutting
  root["snap"] = options.snap;
  root["threads"] = options.threads;
  root["seed"] = options.seed;
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
          {"blocked_edges", cut.blocked_edges},
          {"sheets", cut.sheets}};
}

Json maintain_json(const JobReport& report) {
  const MaintainStatistics& done = report.maintain;
  return {{"work_units", done.work_units},
          {"collapsed_edges", done.collapsed_edges},
          {"moved_vertices", done.moved_vertices},
          {"removed_edges", done.removed_edges},
          {"removed_faces", done.removed_faces},
          {"peeled_tets", done.peeled_tets},
          {"inserted_vertices", done.inserted_vertices},
          {"waiting_tets", done.waiting_tets},
          {"created_tets", done.created_tets},
          {"units_per_stroke", report.units_per_stroke}};
}

Json quality_json(const JobReport& report) {
  Json root = {{"before", encode(report.quality_before)},
               {"cut", encode(report.quality_cut)},
               {"after", encode(report.quality_after)}};
  root["cut"]["incision"] = encode(report.quality_cut_incision);
  root["after"]["incision"] = encode(report.quality_incision);
  return root;
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
    root[kStageNames[i]] = encode(percentiles(std::move(of_stage)));
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

double relative_error(const JobReport& report) {
  if (!(report.volume_before > 0)) return 0;
  return std::abs(report.volume_after - report.volume_before) / report.volume_before;
}

// `ok` is about what the job did: violations that the input brought along are listed, but do not count.
Json validity_json(const JobReport& report) {
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
  if (report.broken) {
    root["broken_stroke"] = {{"index", report.broken->index},
                             {"name", report.broken->name},
                             {"kept_hash", hash_text(report.broken->kept_hash)}};
  }
  return root;
}

std::string sizes_text(const JobReport& report) {
  std::string text =
      formatted("{} -> {} tets, {} -> {} vertices, {} -> {} pieces\n", report.before.tets, report.after.tets,
                report.before.vertices, report.after.vertices, report.before.components, report.after.components);
  for (std::size_t i = 0; i < report.pieces.size() && i < kMaxPiecesShown; ++i) {
    text += formatted("  piece {}: {} tets, volume {:.9g}\n", i, report.pieces[i].tets, report.pieces[i].volume);
  }
  if (report.pieces.size() > kMaxPiecesShown) {
    text += formatted("  and {} more\n", report.pieces.size() - kMaxPiecesShown);
  }
  return text;
}

std::string work_text(const JobReport& report) {
  const CutStatistics& cut = report.cut;
  const MaintainStatistics& done = report.maintain;
  std::string text;
  if (report.strokes > 0) {
    text = formatted("cut {} in {}: {} opened, {} vertices snapped, {} bent\n", counted(cut.cut_tets, "tet"),
                     counted(cut.steps, "step"), counted(static_cast<std::uint64_t>(cut.incision_faces), "face"),
                     cut.snapped_vertices, cut.bent_vertices);
  }
  if (report.options.merge || report.options.improve) {
    text += formatted("maintained: {} edges collapsed, {} swapped away, {} faces swapped away, {} vertices moved\n",
                      done.collapsed_edges, done.removed_edges, done.removed_faces, done.moved_vertices);
  }
  if (done.waiting_tets > 0) text += formatted("{} tets wait for maintenance\n", done.waiting_tets);
  return text;
}

std::string quality_row(const char* name, const QualityStats& q) {
  if (q.tets == q.flat_tets) return {};
  return formatted("{:<16}{:>10}{:>10.4g}{:>10.4g}{:>10.4g}{:>10.3g}{:>10.3g}{:>10.4g}\n", name, q.tets, q.lr_mean,
                   q.lr_p99, q.lr_max, q.lr_over_200_pct, q.dihedral_min_deg, q.dihedral_max_deg);
}

std::string quality_text(const JobReport& report) {
  const bool is_cut = report.strokes > 0;
  return formatted("{:<16}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}\n", "", "tets", "L/r mean", "p99", "max",
                   "% > 200", "angle min", "max") +
         quality_row("before", report.quality_before) + (is_cut ? quality_row("cut", report.quality_cut) : "") +
         quality_row("after", report.quality_after) + quality_row("at walls, cut", report.quality_cut_incision) +
         quality_row("at walls, after", report.quality_incision);
}

}  // namespace

Json encode(const Percentiles& p) {
  return {{"p50", p.p50}, {"p99", p.p99}, {"p999", p.p999}, {"max", p.max}};
}

Percentiles percentiles(std::vector<double> sample) {
  if (sample.empty()) return {};
  std::sort(sample.begin(), sample.end());
  const auto rank = [&](double share) {
    const double n = std::ceil(share * static_cast<double>(sample.size()));
    return sample[std::clamp<std::size_t>(static_cast<std::size_t>(n), 1, sample.size()) - 1];
  };
  return {rank(0.5), rank(0.99), rank(0.999), sample.back()};
}

Json report_tree(const JobReport& report) {
  Json root;
  root["format"] = "incise-report";
  root["version"] = 1;
  root["program"] = "incise " INCISE_VERSION;
  root["input"] = {{"file", report.input}, {"format", report.input_format}, {"notes", report.notes}};
  root["options"] = options_json(report);
  root["strokes"] = report.strokes;
  root["mesh"] = {{"before", json_of(report.before)}, {"after", json_of(report.after)}};
  root["pieces"] = json_of(report.pieces);
  root["cut"] = json_of(report.cut);
  root["maintain"] = maintain_json(report);
  root["quality"] = quality_json(report);
  root["volume"] = {{"before", encode(report.volume_before)},
                    {"after", encode(report.volume_after)},
                    {"relative_error", encode(relative_error(report))}};
  root["validity"] = validity_json(report);
  root["time_ms"] = json_of(report.times, report.total_ms);
  root["step_ms"] = encode(percentiles(report.step_ms));
  root["stage_ms"] = stage_percentiles(report.stage_ms);
  root["hash"] = hash_text(report.hash);
  return root;
}

std::string to_json(const JobReport& report) {
  return report_tree(report).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_text(const JobReport& report) {
  return sizes_text(report) + work_text(report) + quality_text(report) +
         formatted("volume changed by {:.2g} (relative); {}\n", relative_error(report),
                   report.change.ok ? "valid" : "INVALID") +
         formatted("{:.3f} ms, hash {}\n", report.total_ms, hash_text(report.hash));
}

}  // namespace app
}  // namespace v0
}  // namespace incise
