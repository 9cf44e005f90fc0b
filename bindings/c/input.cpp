// SPDX-License-Identifier: Apache-2.0
// What comes in as C structs and goes out as such: options, arrays, poses, reports.
#include "handles.h"
#include "incise/mesh/defects.h"
#include "incise/mesh/step_check.h"

namespace incise::c {
namespace {

Error bad(std::string message, std::vector<std::uint64_t> ids = {}) {
  return {ErrorCode::kBadArgument, std::move(message), std::move(ids)};
}

incise_engine_options to_c(const EngineOptions& options) {
  incise_engine_options c{};
  c.size = sizeof c;
  c.profile = options.cut.profile == Profile::kPaper ? INCISE_PROFILE_PAPER : INCISE_PROFILE_INCISE;
  c.snap = options.cut.snap;
  c.merge = options.maintain.merge ? 1 : 0;
  c.improve = options.maintain.improve ? 1 : 0;
  c.work_units = options.maintain.work_units;
  c.threads = options.threads;
  c.smooth_boundary = options.maintain.smooth_boundary ? 1 : 0;
  c.check_steps = options.check_step ? 1 : 0;
  return c;
}

Status check_counts(const incise_mesh_arrays& c) {
  if (c.points == nullptr || c.tets == nullptr) return bad("points or tets are null; give both");
  if (c.n_points >= kInvalidIndex) return bad("n_points is " + std::to_string(c.n_points) + "; at most 2^32 - 2");
  if (c.n_tets > TetMesh::kMaxTets) {
    return Error{ErrorCode::kOutOfMemory, "n_tets is " + std::to_string(c.n_tets) + "; at most 2^28", {}};
  }
  if (c.n_walls > 4 * std::uint64_t{TetMesh::kMaxTets}) return bad("more walls than 2^28 tets have sides");
  if (c.n_walls > 0 && c.walls == nullptr) return bad("walls are null, and n_walls is not 0");
  return {};
}

TetSoup soup_of(const incise_mesh_arrays& c) {
  TetSoup soup;
  soup.points.resize(c.n_points);
  for (std::size_t i = 0; i < c.n_points; ++i) soup.points[i] = to_vec(c.points + 3 * i);
  soup.tets.resize(c.n_tets);
  if (c.n_tets > 0) std::memcpy(soup.tets.data(), c.tets, c.n_tets * sizeof soup.tets[0]);
  if (c.regions != nullptr) soup.regions.assign(c.regions, c.regions + c.n_tets);
  for (std::size_t i = 0; i < c.n_walls; ++i) {
    const std::uint32_t* wall = c.walls + 4 * i;
    soup.walls.push_back({{wall[0], wall[1], wall[2]}, wall[3]});
  }
  if (c.origins != nullptr) soup.origins.assign(c.origins, c.origins + c.n_points);
  if (c.fronts != nullptr) soup.fronts.assign(c.fronts, c.fronts + c.n_points);
  return soup;
}

/// What `normalise` asks for; without it building looks for itself.
Status check_for_mending(const TetSoup& soup) {
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    if (!soup.points[i].allFinite()) return bad("point " + std::to_string(i) + " is not finite", {i});
  }
  for (std::size_t i = 0; i < soup.tets.size(); ++i) {
    for (const std::uint32_t v : soup.tets[i]) {
      if (v >= soup.points.size()) {
        return bad("tet " + std::to_string(i) + " names point " + std::to_string(v) + " of " +
                       std::to_string(soup.points.size()),
                   {i});
      }
    }
  }
  return {};
}

/// What a cut through them leaves as it was, without a word.
void note_duplicates(const std::vector<std::uint32_t>& ids, std::vector<std::string>& notes) {
  constexpr std::size_t kFirst = 4;
  if (ids.empty()) return;
  std::string list;
  for (std::size_t i = 0; i < ids.size() && i < kFirst; ++i) list += (i > 0 ? ", " : "") + std::to_string(ids[i]);
  if (ids.size() > kFirst) list += ", ...";
  const bool is_one = ids.size() == 1;
  notes.push_back(std::to_string(ids.size()) + (is_one ? " tet has" : " tets have") + " the corners of a tet before (" +
                  list + "), and will not be parted by cuts; set mend, which drops " + (is_one ? "it" : "them"));
}

}  // namespace

LogSink log_to(incise_log log, void* user) {
  if (log == nullptr) return {};
  return [log, user](LogLevel level, std::string_view text) {
    log(user, static_cast<std::int32_t>(level), std::string(text).c_str());
  };
}

BladePose pose_of(const double* edge, std::uint64_t n, const double* direction) {
  BladePose pose;
  pose.edge.reserve(n);
  for (std::uint64_t i = 0; i < n; ++i) pose.edge.push_back(to_vec(edge + 3 * i));
  if (direction != nullptr) pose.direction = to_vec(direction);
  return pose;
}

Result<EngineOptions> engine_options(const incise_engine_options* given, EngineOptions otherwise) {
  if (given == nullptr) return otherwise;
  incise_engine_options c = to_c(otherwise);
  if (take(given, c, "incise_engine_options") != INCISE_OK) return bad(incise_last_error());
  if (c.profile != INCISE_PROFILE_PAPER && c.profile != INCISE_PROFILE_INCISE) {
    return bad("profile is " + std::to_string(c.profile) + "; 0 is paper, 1 incise");
  }
  EngineOptions options = std::move(otherwise);
  options.cut = {c.profile == INCISE_PROFILE_PAPER ? Profile::kPaper : Profile::kIncise, c.snap};
  options.maintain.merge = c.merge != 0;
  options.maintain.improve = c.improve != 0;
  options.maintain.work_units = c.work_units;
  options.maintain.smooth_boundary = c.smooth_boundary != 0;
  options.threads = c.threads;
  options.log = log_to(c.log, c.log_user);
  options.check_step = c.check_steps != 0 ? StepCheck(TouchedCheck()) : StepCheck();
  return options;
}

Result<TetMesh> mesh_of(const incise_mesh_arrays* given, std::vector<std::string>& notes) {
  if (given == nullptr) return bad("the arrays of the mesh are null");
  incise_mesh_arrays c{};
  if (take(given, c, "incise_mesh_arrays") != INCISE_OK) return bad(incise_last_error());
  if (const Status counts = check_counts(c); !counts.ok()) return counts.error();
  TetSoup soup = soup_of(c);
  if (c.mend != 0) {
    if (const Status sound = check_for_mending(soup); !sound.ok()) return sound.error();
    normalise(soup);
  } else {
    note_duplicates(find_duplicate_tets(soup), notes);
  }
  return TetMesh::build(std::move(soup));
}

void fill(incise_report& report, const CutStatistics& cut) {
  report.steps = cut.steps;
  report.cut_tets = cut.cut_tets;
  report.created_tets = cut.created_tets;
  report.new_vertices = cut.new_vertices;
  report.copied_vertices = cut.copied_vertices;
  report.incision_faces = cut.incision_faces;
  report.snapped_vertices = cut.snapped_vertices;
  report.bent_vertices = cut.bent_vertices;
  report.crumbs_kept = cut.crumbs_kept;
  report.pinched_edges = cut.pinched_edges;
  report.latent_faces = cut.latent_faces;
  report.blocked_edges = cut.blocked_edges;
  report.sheets = cut.sheets;
}

void fill(incise_report& report, const MaintainStatistics& maintain) {
  report.work_units = maintain.work_units;
  report.collapsed_edges = maintain.collapsed_edges;
  report.moved_vertices = maintain.moved_vertices;
  report.removed_edges = maintain.removed_edges;
  report.removed_faces = maintain.removed_faces;
  report.inserted_vertices = maintain.inserted_vertices;
  report.peeled_tets = maintain.peeled_tets;
  report.waiting_tets = maintain.waiting_tets;
  report.maintenance_tets = maintain.created_tets;
}

void fill(incise_report& report, const StageTimes& times) {
  report.collision_ms = times[Stage::kCollision];
  report.subdivide_ms = times[Stage::kSubdivide];
  report.separate_ms = times[Stage::kSeparate];
  report.merge_ms = times[Stage::kMerge];
  report.improve_ms = times[Stage::kImprove];
  report.relax_ms = times[Stage::kRelax];
}

}  // namespace incise::c

incise_status incise_default_engine_options(incise_engine_options* options, uint32_t size) {
  return incise::c::give_default(incise::c::to_c(incise::EngineOptions{}), options, size, "incise_engine_options");
}
