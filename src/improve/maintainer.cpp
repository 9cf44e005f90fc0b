// SPDX-License-Identifier: Apache-2.0
// Maintenance of a cut mesh: the worst tet in care first, and the cheapest remedy that makes its surroundings better.
#include "incise/improve/maintainer.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "improve/care.h"
#include "improve/edge_collapse.h"
#include "improve/edge_removal.h"
#include "improve/smooth.h"

namespace incise::inline v0 {

namespace {

/// Tets with an L/r below this are good enough: each further step costs more and gains less.
constexpr double kGoal = kRegularLr / 11.0;
/// Changes per journal step: what they free is used again from the next one on.
constexpr std::uint64_t kChangesPerStep = 4096;

/// A tet in care, with its quality when it was put there.
struct Waiting {
  double ratio;
  TetId tet;

  /// Heaps keep the greatest in front: here the worst, of equals the lowest.
  bool operator<(const Waiting& o) const { return ratio != o.ratio ? ratio > o.ratio : o.tet.value < tet.value; }
};

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
    for (std::size_t i = first_step; i < journal.position(); ++i) {
      const Step& step = journal.step(i);
      for (const BornVertex& v : step.born) touched.push_back(v.id);
      for (const MovedVertex& v : step.moved) touched.push_back(v.id);
      for (const CopiedVertex& v : step.copied) touched.insert(touched.end(), {v.id, v.source});
    }
    std::vector<VertexId> ring;
    for (const VertexId v : touched) {
      add_with_neighbours(mesh, v, ring);
    }
    push_stars(mesh, ring);
  }
  void take_up_all(const TetMesh& mesh) {
    in_care_.ensure(mesh.vertex_slots());
    mesh.for_each_vertex([&](VertexId v) { in_care_[v.value] = epoch_; });
    mesh.for_each_tet([&](TetId tet) { push(mesh, tet); });
  }

  MaintainStatistics run(TetMesh& mesh, Journal& journal, std::uint64_t work_units, StageTimes& times) {
    statistics_ = {};
    const std::size_t tets_before = mesh.tet_count();
    while (!heap_.empty() && statistics_.work_units < work_units) {
      run_step(mesh, journal, work_units, times);
    }
    statistics_.waiting_tets = heap_.size();
    statistics_.created_tets = static_cast<std::int64_t>(mesh.tet_count()) - static_cast<std::int64_t>(tets_before);
    return statistics_;
  }
  [[nodiscard]] bool has_work() const { return !heap_.empty(); }
  void forget() {
    heap_.clear();
    ++epoch_;
  }

 private:
  [[nodiscard]] bool is_in_care(VertexId v) const {
    return v.value < in_care_.capacity() && in_care_[v.value] == epoch_;
  }
  void add_to_care(VertexId v, std::vector<VertexId>& added) {
    in_care_.ensure(std::size_t{v.value} + 1);
    if (in_care_[v.value] != epoch_) {
      in_care_[v.value] = epoch_;
      added.push_back(v);
    }
  }
  /// Takes a touched vertex and its neighbours into care.
  void add_with_neighbours(const TetMesh& mesh, VertexId touched, std::vector<VertexId>& added) {
    if (!mesh.is_live(touched)) {
      return;
    }
    add_to_care(touched, added);
    for (const TetId tet : walker_.star(mesh, touched)) {
      for (const VertexId v : mesh.vertices(tet)) add_to_care(v, added);
    }
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
    const double ratio = inradius_ratio(mesh, mesh.vertices(tet));
    if (ratio < kGoal && !mesh.is_flat_at_load(tet)) {
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

  void run_step(TetMesh& mesh, Journal& journal, std::uint64_t work_units, StageTimes& times) {
    Transaction transaction(mesh, true);
    Care care{transaction, mesh, references_, walker_, statistics_, changed_};
    for (std::uint64_t changes = 0;
         !heap_.empty() && changes < kChangesPerStep && statistics_.work_units < work_units;) {
      const Waiting worst = pop();
      care.spend(1);
      const bool is_stale =
          !mesh.is_live(worst.tet) || inradius_ratio(mesh, mesh.vertices(worst.tet)) != worst.ratio;
      if (is_stale || !improve(care, worst.tet, times)) {
        continue;
      }
      ++changes;
      requeue(mesh);
    }
    if (Step step = transaction.commit(); !step.is_empty()) {
      journal.append(std::move(step));
    }
  }
  bool improve(Care& care, TetId tet, StageTimes& times) {
    if (options_.merge) {
      const StageZone zone(times, Stage::kMerge);
      if (collapser_.improve(care, tet)) return true;
    }
    if (!options_.improve) {
      return false;
    }
    const StageZone zone(times, Stage::kImprove);
    return remover_.improve(care, tet) || face_remover_.improve(care, tet) || smooth(care, tet);
  }
  bool smooth(Care& care, TetId tet) {
    const TetVertices corners = care.mesh.vertices(tet);
    return std::any_of(corners.begin(), corners.end(), [&](VertexId v) { return smoother_.improve(care, v); });
  }
  /// What the last operation changed is judged anew, as far as it is in care.
  void requeue(const TetMesh& mesh) {
    for (const TetId tet : changed_) {
      const TetVertices& corners = mesh.vertices(tet);
      if (std::any_of(corners.begin(), corners.end(), [&](VertexId v) { return is_in_care(v); })) {
        push(mesh, tet);
      }
    }
  }

  MaintainOptions options_;
  References references_;
  MaintainStatistics statistics_;  // of the run in progress
  std::vector<Waiting> heap_;
  std::vector<TetId> changed_;
  ZeroedArray<std::uint32_t> in_care_;   // per vertex slot: the epoch that took it up
  ZeroedArray<std::uint8_t> is_pushed_;  // scratch of `push_stars`, zero between calls
  std::uint32_t epoch_ = 1;
  StarWalker walker_;
  EdgeCollapser collapser_;
  EdgeRemover remover_;
  FaceRemover face_remover_;
  Smoother smoother_;
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
MaintainStatistics Maintainer::run(TetMesh& mesh, Journal& journal, std::uint64_t work_units, StageTimes& times) {
  return queue_->run(mesh, journal, work_units, times);
}
bool Maintainer::has_work() const {
  return queue_->has_work();
}
void Maintainer::forget() {
  queue_->forget();
}

}  // namespace incise::inline v0
