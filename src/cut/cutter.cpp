// SPDX-License-Identifier: Apache-2.0
// The cutting pipeline: collision → incision faces → subdivision → separation (paper, Figure 1, first four boxes).
#include "incise/cut/cutter.h"

#include <algorithm>
#include <new>
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
/// A tet falls apart into so many children at most.
constexpr std::size_t kMostChildren = 16;
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
  Pipeline(CutOptions options, unsigned threads) : options_(options), threads_(threads) {}

  Result<CutStatistics> cut(TetMesh& mesh, Journal& journal, const Stroke& stroke, std::uint32_t tag,
                            StageTimes& times) {
    if (Status status = check(stroke); !status) {
      return status.error();
    }
    const std::size_t start = journal.position();
    statistics_ = {};
    statistics_.steps = stroke.times.size() - 1;
    Status status;
    try {
      status = cut_parts(mesh, journal, stroke, tag, times);
    } catch (const std::bad_alloc&) {
      status = Error{ErrorCode::kOutOfMemory, "not enough memory to cut; use a coarser mesh", {}};
    }
    if (!status) {
      while (journal.position() > start) {
        journal.undo(mesh);
      }
      return status.error();
    }
    return statistics_;
  }

 private:
  bool is_paper() const { return options_.profile == Profile::kPaper; }
  double snap() const { return is_paper() ? 0.0 : options_.snap; }

  /// The parts of a sweep that meet each other are cut one after the other, in the order of time.
  Status cut_parts(TetMesh& mesh, Journal& journal, const Stroke& stroke, std::uint32_t tag, StageTimes& times) {
    const double spacing = typical_spacing(mesh);
    const SweptSurface surface = sweep(stroke, kSlitShare * spacing);
    for (const auto& part : split_at_self_crossings(surface, kOverlapShare * spacing, kCoincident * spacing)) {
      if (Status status = cut_sheet(mesh, journal, Sheet(surface, part), tag, times); !status) {
        return status;
      }
      ++statistics_.sheets;
    }
    return {};
  }
  /// One sheet: collision, subdivision, separation.
  Status cut_sheet(TetMesh& mesh, Journal& journal, const Sheet& sheet, std::uint32_t tag, StageTimes& times) {
    const std::size_t tets_before = mesh.tet_count();
    Transaction transaction(mesh);
    const std::vector<OnVertex> on = find_contact(transaction, sheet, times);
    if (std::size_t{mesh.tet_slots()} + kMostChildren * near_.tets.size() >= TetMesh::kMaxTets) {
      return Error{ErrorCode::kOutOfMemory, "the cut would need more than 2^28 tets; use a coarser mesh", {}};
    }
    Subdivision subdivision = divide(transaction, sheet, times);
    separate_parts(transaction, sheet, subdivision, on, tag, times);
    statistics_.snapped_vertices += on.size();
    statistics_.new_vertices += transaction.new_vertices().size();
    append(journal, transaction);
    if (is_paper()) {
      part_edges(mesh, journal, subdivision.incision, times);
    }
    statistics_.created_tets += mesh.tet_count() - tets_before;
    return {};
  }
  static void append(Journal& journal, Transaction& transaction) {
    Step step = transaction.commit();
    if (!step.is_empty()) {
      journal.append(std::move(step));
    }
  }
  std::vector<OnVertex> find_contact(Transaction& transaction, const Sheet& sheet, StageTimes& times) {
    const StageZone zone(times, Stage::kCollision);
    collide(transaction, sheet);
    return choose_on_vertices(transaction.mesh(), sheet, snap(), near_, walker_);
  }
  Subdivision divide(Transaction& transaction, const Sheet& sheet, StageTimes& times) {
    const StageZone zone(times, Stage::kSubdivide);
    const TetMesh& mesh = transaction.mesh();
    statistics_.blocked_edges += plan_subdivision(mesh, rules(), templates_, near_);
    statistics_.cut_tets += count_cut_tets();
    Subdivision subdivision = subdivide(transaction, sheet, templates_, near_);
    if (is_paper()) {
      subdivision.incision = find_paper_incision(mesh, near_, subdivision);
    }
    return subdivision;
  }
  void separate_parts(Transaction& transaction, const Sheet& sheet, Subdivision& subdivision,
                      const std::vector<OnVertex>& on, std::uint32_t tag, StageTimes& times) {
    const StageZone zone(times, Stage::kSeparate);
    if (snap() > 0) {
      statistics_.crumbs_kept += keep_crumbs(transaction, near_, subdivision.incision);
    }
    const auto move = [&] { statistics_.bent_vertices += move_on_vertices(transaction, sheet, snap(), on, walker_); };
    const Separation separation = is_paper() ? separate_as_paper(transaction, subdivision.incision, tag, walker_)
                                             : separate(transaction, std::move(subdivision.incision),
                                                        subdivision.children, tag, separation_, move);
    statistics_.incision_faces += separation.opened_faces;
    statistics_.latent_faces += separation.latent_faces;
    statistics_.copied_vertices += separation.copied_vertices;
    statistics_.pinched_edges += separation.pinched_edges;
  }
  /// The paper profile's repair; a step of its own.
  void part_edges(TetMesh& mesh, Journal& journal, const std::vector<IncisionFace>& incision, StageTimes& times) {
    const StageZone zone(times, Stage::kSeparate);
    Transaction transaction(mesh);
    statistics_.pinched_edges += part_pinched_edges(transaction, incision, walker_);
    statistics_.new_vertices += transaction.new_vertices().size();
    append(journal, transaction);
  }

  /// Finds the crossings of the mesh's edges with the sheet; edges crossed twice are bisected in between and retried.
  void collide(Transaction& transaction, const Sheet& sheet) {
    const TetMesh& mesh = transaction.mesh();
    for (unsigned round = 0;; ++round) {
      find_crossings(mesh, sheet, find_near_tets(mesh, sheet, threads_), near_, threads_);
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
  unsigned threads_;
  CutStatistics statistics_;  // of the stroke being cut
  Neighbourhood near_;
  SplitTemplates templates_;
  StarWalker walker_;
  SeparationScratch separation_;
};

Cutter::Cutter(CutOptions options, unsigned threads) : pipeline_(std::make_unique<Pipeline>(options, threads)) {}
Cutter::Cutter(Cutter&&) noexcept = default;
Cutter& Cutter::operator=(Cutter&&) noexcept = default;
Cutter::~Cutter() = default;

Result<CutStatistics> Cutter::cut(TetMesh& mesh, Journal& journal, const Stroke& stroke, std::uint32_t tag,
                                  StageTimes& times) {
  return pipeline_->cut(mesh, journal, stroke, tag, times);
}

}  // namespace incise::inline v0
