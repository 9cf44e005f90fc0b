// SPDX-License-Identifier: Apache-2.0
// The cutting pipeline: collision → incision faces → subdivision → separation (paper, Figure 1, first four boxes).
#include "incise/cut/cutter.h"

#include <algorithm>
#include <utility>

#include "cut/contact.h"
#include "cut/crossing.h"
#include "cut/crumbs.h"
#include "cut/dividable.h"
#include "cut/separate.h"
#include "cut/snap.h"
#include "cut/subdivide.h"
#include "cut/sweep.h"
#include "incise/mesh/verbs.h"

namespace incise::inline v0 {

namespace {

/// Split points keep this share of their edge on either side, where snapping is on.
constexpr double kSplitClamp = 0.02;
/// Two crossings of one edge closer than this share of it are one graze, not two sheets.
constexpr double kGrazeShare = 0.02;
/// A blade within this share of the mesh's spacing from what it swept before is in its own slit.
constexpr double kSlitShare = 0.02;
/// Consecutive parts of a sweep that meets itself overlap by so many spacings.
constexpr double kOverlapShare = 3.0;
/// An edge crossed twice is bisected at most so often.
constexpr unsigned kMaxBisectionRounds = 8;

/// The mean edge length of a few tets, as a scale for overlaps.
double typical_spacing(const TetMesh& mesh) {
  double sum = 0;
  std::size_t count = 0;
  const std::uint32_t stride = std::max(1U, mesh.tet_slots() / 64U);
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); slot += stride) {
    if (!mesh.is_live(TetId(slot))) continue;
    const TetVertices& v = mesh.vertices(TetId(slot));
    for (const auto& [a, b] : kEdgeCorners) {
      sum += (mesh.rest(v[a]) - mesh.rest(v[b])).norm();
      ++count;
    }
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

}  // namespace

CutStatistics& CutStatistics::operator+=(const CutStatistics& other) {
  steps += other.steps;
  cut_tets += other.cut_tets;
  created_tets += other.created_tets;
  new_vertices += other.new_vertices;
  copied_vertices += other.copied_vertices;
  incision_faces += other.incision_faces;
  snapped_vertices += other.snapped_vertices;
  bent_vertices += other.bent_vertices;
  crumbs_kept += other.crumbs_kept;
  pinched_edges += other.pinched_edges;
  latent_faces += other.latent_faces;
  blocked_edges += other.blocked_edges;
  sheets += other.sheets;
  return *this;
}

class Cutter::Pipeline {
 public:
  explicit Pipeline(CutOptions options) : options_(options) {}

  Result<CutStatistics> cut(TetMesh& mesh, Journal& journal, const Stroke& stroke, std::uint32_t tag,
                            StageTimes& times) {
    if (Status status = check(stroke); !status) {
      return status.error();
    }
    CutStatistics statistics;
    statistics.steps = stroke.times.size() - 1;
    const double spacing = typical_spacing(mesh);
    const SweptSurface surface = sweep(stroke, kSlitShare * spacing);
    for (const auto& part : split_at_self_crossings(surface, kOverlapShare * spacing, kCoincident * spacing)) {
      const Sheet sheet(surface, part);
      Transaction transaction(mesh);
      cut_sheet(transaction, sheet, tag, statistics, times);
      ++statistics.sheets;
      Step step = transaction.commit();
      if (!step.is_empty()) {
        journal.append(std::move(step));
      }
    }
    return statistics;
  }

 private:
  bool is_paper() const { return options_.profile == Profile::kPaper; }
  double snap() const { return is_paper() ? 0.0 : options_.snap; }

  void cut_sheet(Transaction& transaction, const Sheet& sheet, std::uint32_t tag, CutStatistics& statistics,
                 StageTimes& times) {
    const TetMesh& mesh = transaction.mesh();
    const std::size_t tets_before = mesh.tet_count();
    std::vector<OnVertex> on;
    {
      const StageZone zone(times, Stage::kCollision);
      collide(transaction, sheet);
      on = choose_on_vertices(mesh, sheet, snap(), near_, walker_);
    }
    std::vector<IncisionFace> incision;
    Subdivision subdivision;
    {
      const StageZone zone(times, Stage::kSubdivide);
      statistics.blocked_edges += plan_subdivision(mesh, rules(), templates_, near_);
      statistics.cut_tets += count_cut_tets();
      subdivision = subdivide(transaction, sheet, templates_, near_);
      incision = is_paper() ? find_paper_incision(mesh, near_, subdivision) : std::move(subdivision.incision);
      statistics.snapped_vertices += on.size();
    }
    {
      const StageZone zone(times, Stage::kSeparate);
      if (snap() > 0) {
        statistics.crumbs_kept += keep_crumbs(transaction, near_, incision);
      }
      const Separation separation =
          is_paper() ? separate_as_paper(transaction, std::move(incision), tag, walker_)
                     : separate(transaction, std::move(incision), subdivision.children, tag, separation_, [&] {
                         statistics.bent_vertices += move_on_vertices(transaction, sheet, snap(), on, walker_);
                       });
      statistics.incision_faces += separation.opened_faces;
      statistics.latent_faces += separation.latent_faces;
      statistics.copied_vertices += separation.copied_vertices;
      statistics.pinched_edges += separation.pinched_edges;
    }
    statistics.new_vertices += transaction.new_vertices().size();
    statistics.created_tets += mesh.tet_count() - tets_before;
  }

  /// Finds the crossings of the mesh's edges with the sheet; edges crossed twice are bisected in between and retried.
  void collide(Transaction& transaction, const Sheet& sheet) {
    const TetMesh& mesh = transaction.mesh();
    for (unsigned round = 0;; ++round) {
      find_crossings(mesh, sheet, find_near_tets(mesh, sheet), near_);
      const std::vector<DoublyCrossed> twice = find_doubly_crossed(mesh, sheet, near_, kGrazeShare);
      if (twice.empty() || round == kMaxBisectionRounds) {
        return;
      }
      for (const DoublyCrossed& crossed : twice) {
        bisect(transaction, near_.edges[crossed.edge], crossed.t);
      }
    }
  }
  void bisect(Transaction& transaction, const CutEdge& edge, double t) {
    const TetMesh& mesh = transaction.mesh();
    if (mesh.is_overshared_at_load(edge.a, edge.b)) {
      return;
    }
    for (const TetId tet : walker_.star(mesh, edge.a)) {
      if (mesh.corner_of(tet, edge.b) < 4) {
        const SplitEdgePlan plan = plan_split_edge(mesh, edge.a, edge.b, tet, t);
        if (plan) {
          apply(transaction, plan);
        }
        return;
      }
    }
  }
  [[nodiscard]] SubdivisionRules rules() const {
    SubdivisionRules rules;
    rules.splits_partial_tets = is_paper();
    rules.clamp = snap() > 0 ? kSplitClamp : 0.0;
    rules.keeps_shape_floor = snap() > 0;
    return rules;
  }
  [[nodiscard]] std::uint64_t count_cut_tets() const {
    return static_cast<std::uint64_t>(
        std::count_if(near_.tets.begin(), near_.tets.end(), [](const NearTet& tet) { return tet.is_cuttable; }));
  }

  CutOptions options_;
  Neighbourhood near_;
  SplitTemplates templates_;
  StarWalker walker_;
  SeparationScratch separation_;
};

Cutter::Cutter(CutOptions options) : pipeline_(std::make_unique<Pipeline>(options)) {}
Cutter::Cutter(Cutter&&) noexcept = default;
Cutter& Cutter::operator=(Cutter&&) noexcept = default;
Cutter::~Cutter() = default;

Result<CutStatistics> Cutter::cut(TetMesh& mesh, Journal& journal, const Stroke& stroke, std::uint32_t tag,
                                  StageTimes& times) {
  return pipeline_->cut(mesh, journal, stroke, tag, times);
}

}  // namespace incise::inline v0
