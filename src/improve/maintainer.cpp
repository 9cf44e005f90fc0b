// SPDX-License-Identifier: Apache-2.0
// Maintenance of a cut mesh: the worst tet in care first, and the cheapest remedy that makes its surroundings better.
#include "incise/improve/maintainer.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "improve/care.h"
#include "improve/edge_collapse.h"
#include "improve/edge_removal.h"
#include "improve/insertion.h"
#include "improve/peeling.h"
#include "improve/smooth.h"

namespace incise::inline v0 {

namespace {

/// Tets at the cut with an L/r below this are good enough: each further step costs more and gains less.
constexpr double kGoal = kRegularLr / 11.0;
/// Tets with an L/r above this come first of all; of those beside the cut no others are worked on.
constexpr double kBad = kRegularLr / 18.0;
/// Vertices that cuts made are tried so often: a merge makes room for others.
constexpr unsigned kThinningRounds = 3;
/// Where a cut goes on from an older one, thinning out may cost shape down to this L/r: there all is in good shape
/// already, and nothing would ever be thinned out.
constexpr double kEnough = kRegularLr / 18.0;
/// The end of an older cut is dense so many rings of vertices behind the seam.
constexpr unsigned kSeamRings = 4;
/// Changes per journal step: what they free is used again from the next one on.
constexpr std::uint64_t kChangesPerStep = 4096;

/// A tet in care, with its quality when it was put there.
struct Waiting {
  double ratio;
  TetId tet;

  /// Heaps keep the greatest in front: here the worst, of equals the lowest.
  bool operator<(const Waiting& o) const { return ratio != o.ratio ? ratio > o.ratio : o.tet.value < tet.value; }
};

/// A vertex that may be merged, by slot and generation: slots are used again.
struct Crowded {
  VertexId vertex;
  std::uint32_t generation;
};

}  // namespace

namespace {

/// Whether a side still stands for what a step opened: later steps of a stroke make tets around the blade anew.
bool is_wall(const TetMesh& mesh, Side side, std::uint32_t tag) {
  return mesh.is_live(side.tet()) && mesh.link(side) == Link::boundary(tag);
}

}  // namespace

class Maintainer::Queue {
 public:
  explicit Queue(MaintainOptions options) : options_(options) {}

  void set_reference(std::uint32_t stroke, TriangleTree sweep) { references_.set(stroke, std::move(sweep)); }

  void take_up(const TetMesh& mesh, const Journal& journal, std::size_t first_step) {
    if (heap_.empty()) {
      ++epoch_;
    }
    std::vector<VertexId> touched;
    std::vector<OpenedFace> opened;
    for (std::size_t i = first_step; i < journal.position(); ++i) {
      const Step& step = journal.step(i);
      std::copy_if(step.opened.begin(), step.opened.end(), std::back_inserter(opened), [&](const OpenedFace& face) {
        return is_wall(mesh, face.a, face.tag) && is_wall(mesh, face.b, face.tag);
      });
      for (const BornVertex& v : step.born) touched.push_back(v.id);
      for (const MovedVertex& v : step.moved) touched.push_back(v.id);
      for (const CopiedVertex& v : step.copied) touched.insert(touched.end(), {v.id, v.source});
    }
    references_.measure(mesh, opened);
    std::vector<VertexId> ring;
    for (const VertexId v : touched) {
      add_with_neighbours(mesh, v, ring);
    }
    is_at_seam_ = !opened.empty() && add_older_seam(mesh, opened.front().tag, ring);
    push_stars(mesh, ring);
    for (const VertexId v : ring) {
      if (!mesh.origin(v).is_valid()) crowd_.push_back({v, mesh.generation(v)});
    }
    thinning_round_ = 0;
    next_in_crowd_ = 0;
  }
  void take_up_all(const TetMesh& mesh) {
    in_care_.ensure(mesh.vertex_slots());
    mesh.for_each_vertex([&](VertexId v) { in_care_[v.value] = epoch_ * 4 + 2; });
    mesh.for_each_tet([&](TetId tet) { push(mesh, tet); });
  }

  MaintainStatistics run(TetMesh& mesh, Journal& journal, std::uint64_t work_units, StageTimes& times,
                         const ShouldStop& should_stop) {
    statistics_ = {};
    work_units_ = work_units;
    should_stop_ = &should_stop;
    const std::size_t tets_before = mesh.tet_count();
    if (has_work()) references_.skin().follow(mesh, journal);
    while (has_work() && has_budget()) {
      run_step(mesh, journal, times);
      references_.skin().skip(journal);
    }
    statistics_.waiting_tets = heap_.size();
    statistics_.created_tets = static_cast<std::int64_t>(mesh.tet_count()) - static_cast<std::int64_t>(tets_before);
    return statistics_;
  }
  [[nodiscard]] bool has_work() const { return !heap_.empty() || !crowd_.empty(); }
  void forget(std::size_t position) {
    references_.skin().rewind(position);
    heap_.clear();
    crowd_.clear();
    ++epoch_;
  }

 private:
  /// How near a vertex is to what was taken up: 2 touched, 1 a neighbour, 0 not in care.
  [[nodiscard]] unsigned nearness(VertexId v) const {
    const bool is_known = v.value < in_care_.capacity() && in_care_[v.value] / 4 == epoch_;
    return is_known ? in_care_[v.value] % 4 : 0;
  }
  void add_to_care(VertexId v, unsigned near, std::vector<VertexId>& added) {
    in_care_.ensure(std::size_t{v.value} + 1);
    const unsigned known = nearness(v);
    if (known == 0) {
      added.push_back(v);
    }
    in_care_[v.value] = epoch_ * 4 + std::max(known, near);
  }
  /// Takes a touched vertex and its neighbours into care.
  void add_with_neighbours(const TetMesh& mesh, VertexId touched, std::vector<VertexId>& added) {
    if (!mesh.is_live(touched)) {
      return;
    }
    add_to_care(touched, 2, added);
    for (const TetId tet : walker_.star(mesh, touched)) {
      for (const VertexId v : mesh.vertices(tet)) add_to_care(v, 1, added);
    }
  }
  /// What an older cut had to leave dense around its end can be thinned out once this one, with another tag, goes on
  /// from there. Returns whether there is any.
  bool add_older_seam(const TetMesh& mesh, std::uint32_t tag, std::vector<VertexId>& ring) {
    const auto has_older_wall = [&](TetId tet) {
      const TetLinks& links = mesh.links(tet);
      return std::any_of(links.begin(), links.end(),
                         [&](Link link) { return link.is_boundary() && link.tag() != 0 && link.tag() != tag; });
    };
    bool is_at_seam = false;
    std::size_t first = 0;
    for (unsigned round = 0; round < kSeamRings; ++round) {
      const std::size_t last = ring.size();
      for (std::size_t i = first; i < last; ++i) {
        if (mesh.origin(ring[i]).is_valid()) continue;
        for (const TetId tet : walker_.star(mesh, ring[i])) {
          is_at_seam = is_at_seam || has_older_wall(tet);
          for (const VertexId v : mesh.vertices(tet)) add_to_care(v, 1, ring);
        }
      }
      first = last;
    }
    return is_at_seam;
  }
  void push_stars(const TetMesh& mesh, const std::vector<VertexId>& centres) {
    is_pushed_.ensure(mesh.tet_slots());
    std::vector<TetId> pushed;
    for (const VertexId v : centres) {
      for (const TetId tet : walker_.star(mesh, v)) {
        if (is_pushed_[tet.value] == 0) {
          is_pushed_[tet.value] = 1;
          pushed.push_back(tet);
          push(mesh, tet);
        }
      }
    }
    for (const TetId tet : pushed) is_pushed_[tet.value] = 0;
  }
  void push(const TetMesh& mesh, TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    const unsigned near = std::max({nearness(v[0]), nearness(v[1]), nearness(v[2]), nearness(v[3])});
    const double ratio = inradius_ratio(mesh, v), goal = near == 2 ? kGoal : (near == 1 ? kBad : 0.0);
    if (ratio < goal && !mesh.is_flat_at_load(tet)) {
      heap_.push_back({ratio, tet});
      std::push_heap(heap_.begin(), heap_.end());
    }
  }
  Waiting pop() {
    std::pop_heap(heap_.begin(), heap_.end());
    const Waiting worst = heap_.back();
    heap_.pop_back();
    return worst;
  }

  [[nodiscard]] bool has_budget() const {
    return statistics_.work_units < work_units_ && !(*should_stop_ && (*should_stop_)());
  }

  /// One journal step: bad tets first, then what the cut made needlessly dense, then the tets that could be better.
  void run_step(TetMesh& mesh, Journal& journal, StageTimes& times) {
    Transaction transaction(mesh, true);
    Care care{transaction, mesh, references_, walker_, statistics_, false, {}, changed_};
    for (std::uint64_t changes = 0; has_work() && has_budget() && changes < kChangesPerStep;) {
      const bool has_bad = !heap_.empty() && heap_.front().ratio < kBad;
      const bool has_changed = has_bad || crowd_.empty() ? improve_worst(care, times) : thin_out_next(care, times);
      if (has_changed) {
        ++changes;
        requeue(care);
      }
    }
    if (Step step = transaction.commit(); !step.is_empty()) {
      journal.append(std::move(step));
    }
  }
  bool improve_worst(Care& care, StageTimes& times) {
    const Waiting worst = pop();
    care.spend(1);
    const TetMesh& mesh = care.mesh;
    const bool is_fresh = mesh.is_live(worst.tet) && inradius_ratio(mesh, mesh.vertices(worst.tet)) == worst.ratio;
    care.is_bad = worst.ratio < kBad;
    return is_fresh && improve(care, worst.tet, times);
  }
  bool thin_out_next(Care& care, StageTimes& times) {
    const StageZone zone(times, Stage::kMerge);
    care.is_bad = false;
    const auto [vertex, generation] = crowd_[next_in_crowd_++];
    const bool has_merged = options_.merge && care.mesh.is_live(vertex) && care.mesh.generation(vertex) == generation &&
                            collapser_.thin_out(care, vertex, is_at_seam_ ? kEnough : 1.0);
    if (next_in_crowd_ == crowd_.size()) {
      next_in_crowd_ = 0;
      if (++thinning_round_ == kThinningRounds) crowd_.clear();
    }
    return has_merged;
  }
  /// The first remedy that helps; collapses first, since they leave fewer tets behind.
  bool improve(Care& care, TetId tet, StageTimes& times) {
    return collapse(care, tet, times) || reshape(care, tet, times);
  }
  bool collapse(Care& care, TetId tet, StageTimes& times) {
    const StageZone zone(times, Stage::kMerge);
    return options_.merge && collapser_.improve(care, tet);
  }
  bool reshape(Care& care, TetId tet, StageTimes& times) {
    const StageZone zone(times, Stage::kImprove);
    return options_.improve && (remover_.improve(care, tet) || face_remover_.improve(care, tet) || smooth(care, tet) ||
                                (care.is_bad && (peeler_.improve(care, tet) || inserter_.improve(care, tet))));
  }
  bool smooth(Care& care, TetId tet) {
    const TetVertices corners = care.mesh.vertices(tet);
    return std::any_of(corners.begin(), corners.end(), [&](VertexId v) { return smoother_.improve(care, v); });
  }
  /// What the last operation changed is judged anew, as far as it is in care.
  void requeue(Care& care) {
    if (care.born.is_valid()) {
      in_care_.ensure(std::size_t{care.born.value} + 1);
      in_care_[care.born.value] = epoch_ * 4 + 2;
      care.born = {};
    }
    for (const TetId tet : changed_) {
      push(care.mesh, tet);
    }
  }

  MaintainOptions options_;
  References references_;
  MaintainStatistics statistics_;  // of the run in progress
  std::vector<Waiting> heap_;
  std::vector<TetId> changed_;
  std::vector<Crowded> crowd_;  // vertices that cuts made, to be merged where they are not needed
  std::size_t next_in_crowd_ = 0;
  unsigned thinning_round_ = 0;
  bool is_at_seam_ = false;
  std::uint64_t work_units_ = 0;  // of the run in progress
  const ShouldStop* should_stop_ = nullptr;
  ZeroedArray<std::uint32_t> in_care_;   // per vertex slot: 4 · the epoch that took it up + nearness
  ZeroedArray<std::uint8_t> is_pushed_;  // scratch of `push_stars`, zero between calls
  std::uint32_t epoch_ = 1;
  StarWalker walker_;
  EdgeCollapser collapser_;
  EdgeRemover remover_;
  FaceRemover face_remover_;
  Smoother smoother_;
  Peeler peeler_;
  VertexInserter inserter_;
};

Maintainer::Maintainer(MaintainOptions options) : queue_(std::make_unique<Queue>(options)) {}
Maintainer::Maintainer(Maintainer&&) noexcept = default;
Maintainer& Maintainer::operator=(Maintainer&&) noexcept = default;
Maintainer::~Maintainer() = default;

void Maintainer::set_reference(std::uint32_t stroke, TriangleTree sweep) {
  queue_->set_reference(stroke, std::move(sweep));
}
void Maintainer::take_up(const TetMesh& mesh, const Journal& journal, std::size_t first_step) {
  queue_->take_up(mesh, journal, first_step);
}
void Maintainer::take_up_all(const TetMesh& mesh) {
  queue_->take_up_all(mesh);
}
MaintainStatistics Maintainer::run(TetMesh& mesh, Journal& journal, std::uint64_t work_units, StageTimes& times,
                                   const ShouldStop& should_stop) {
  return queue_->run(mesh, journal, work_units, times, should_stop);
}
bool Maintainer::has_work() const {
  return queue_->has_work();
}
void Maintainer::forget(std::size_t position) {
  queue_->forget(position);
}

}  // namespace incise::inline v0
