// SPDX-License-Identifier: Apache-2.0
// Maintenance of a cut mesh: the worst tet in care first, and the cheapest remedy that makes its surroundings better.
#include "improve/maintainer.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include "improve/constants.h"

namespace incise {
inline namespace v0 {

namespace {

/// Whether a side still stands for what a step opened: later steps of a stroke make tets around the blade anew.
bool is_wall(const TetMesh& mesh, Side side, std::uint32_t tag) {
  return mesh.is_live(side.tet()) && mesh.link(side) == Link::boundary(tag);
}

}  // namespace

void Maintainer::take_up(const TetMesh& mesh, const Journal& journal, std::size_t first_step,
                         const IsLocked& is_locked) {
  if (!has_work() && taken_.empty()) {  // a stroke begins
    ++epoch_;
    began_ = time_;
    hopeless_.clear();  // none of them is in care any more
  }
  trial_work_ = other_work_ = 0;
  for (std::size_t i = first_step; i < journal.position(); ++i) {
    const Step& step = journal.step(i);
    opened_.insert(opened_.end(), step.opened.begin(), step.opened.end());
    for (const BornVertex& v : step.born) touch(v.id);
    for (const MovedVertex& v : step.moved) touch(v.id);
    for (const CopiedVertex& v : step.copied) {
      touch(v.id);
      touch(v.source);
    }
  }
  const std::vector<VertexId> touched = take_touched(mesh, is_locked);
  const std::vector<OpenedFace> opened = take_opened(mesh, is_locked);
  references_.measure(mesh, opened);
  take_held(mesh);
  crowd_.begin();
  std::vector<VertexId> ring;
  for (const VertexId v : touched) {
    add_with_neighbours(mesh, v, ring);
  }
  if (!opened.empty()) tag_ = opened.front().tag;
  for (const VertexId v : ring) taken_.push_back({v, mesh.generation(v)});
  if (!is_locked) look_for_seam(mesh, ring);
  for (const VertexId v : ring) is_in_ring_[v.value] = 0;
  push_stars(mesh, ring);
  for (const VertexId v : ring) {
    if (!mesh.origin(v).is_valid()) crowd_.add(mesh, v);
  }
}

void Maintainer::take_up_all(const TetMesh& mesh) {
  in_care_.ensure(mesh.vertex_slots());
  mesh.for_each_vertex([&](VertexId v) { in_care_[v.value] = epoch_ * 4 + 2; });
  mesh.for_each_tet([&](TetId tet) { push(mesh, tet); });
}

MaintainStatistics Maintainer::run(TetMesh& mesh, Journal& journal, std::uint64_t work_units, StageTimes& times,
                                   const ShouldStop& should_stop, const IsLocked& is_locked) {
  statistics_ = {};
  is_locked_ = &is_locked;
  work_units_ = work_units;
  should_stop_ = &should_stop;
  const std::size_t tets_before = mesh.tet_count();
  while (has_budget()) {
    if (is_due()) {
      run_step(mesh, journal, times);
      if (!is_due()) take_hopeless(mesh);
    } else if (is_locked || !try_next(mesh, journal, times)) {
      break;
    }
  }
  statistics_.waiting_tets = heap_.size() + (waits_for_trials() ? 1 : 0);
  statistics_.created_tets = static_cast<std::int64_t>(mesh.tet_count()) - static_cast<std::int64_t>(tets_before);
  return statistics_;
}

bool Maintainer::has_work() const {
  return is_due() || waits_for_trials() || !touched_.empty() || !held_.empty() || crowd_.has_waiting();
}

void Maintainer::forget() {
  heap_.clear();
  crowd_.clear();
  hopeless_.clear();
  for (const VertexId v : touched_) is_touched_[v.value] = 0;
  touched_.clear();
  opened_.clear();
  for (const TetId tet : held_) is_held_[tet.value] = 0;
  held_.clear();
  taken_.clear();
  tag_ = 0;
  ++epoch_;
}

bool Maintainer::waits_for_trials() const {
  return std::any_of(hopeless_.begin(), hopeless_.end(), std::mem_fn(&Hopeless::waits_for_trial));
}

/// A bad tet that nothing could mend is tried again once something has changed at one of its vertices.
void Maintainer::take_hopeless(const TetMesh& mesh) {
  std::size_t kept = 0;
  for (const Hopeless& entry : hopeless_) {
    if (!mesh.is_live(entry.tet) || inradius_ratio(mesh, mesh.vertices(entry.tet)) != entry.ratio) continue;
    const TetVertices& v = mesh.vertices(entry.tet);
    if (std::any_of(v.begin(), v.end(), [&](VertexId id) { return changed_at(id) > entry.time; })) {
      push(mesh, entry.tet);
    } else {
      hopeless_[kept++] = entry;
    }
  }
  hopeless_.resize(kept);
}

std::uint64_t Maintainer::changed_at(VertexId v) const {
  return v.value < changed_at_.capacity() ? changed_at_[v.value] : 0;
}

bool Maintainer::is_free(const TetMesh& mesh, VertexId v, const IsLocked& is_locked) {
  if (!is_locked || !mesh.is_live(v)) return true;
  if (is_locked(mesh.tet_of(v))) return false;
  const std::vector<TetId>& star = walker_.star(mesh, v);
  return std::none_of(star.begin(), star.end(), std::cref(is_locked));
}

void Maintainer::touch(VertexId v) {
  is_touched_.ensure(std::size_t{v.value} + 1);
  if (std::exchange(is_touched_[v.value], std::uint8_t{1}) == 0) touched_.push_back(v);
}

/// The touched vertices around which nothing is locked, each once; the others wait.
std::vector<VertexId> Maintainer::take_touched(const TetMesh& mesh, const IsLocked& is_locked) {
  const auto waits = [&](VertexId v) { return !is_free(mesh, v, is_locked); };
  const auto first = std::stable_partition(touched_.begin(), touched_.end(), waits);
  std::vector<VertexId> taken(first, touched_.end());
  touched_.erase(first, touched_.end());
  for (const VertexId v : taken) is_touched_[v.value] = 0;
  return taken;
}

/// The faces opened that are still walls, of tets that are not locked.
std::vector<OpenedFace> Maintainer::take_opened(const TetMesh& mesh, const IsLocked& is_locked) {
  std::erase_if(opened_, [&](const OpenedFace& face) {
    return !is_wall(mesh, face.a, face.tag) || !is_wall(mesh, face.b, face.tag);
  });
  const auto waits = [&](const OpenedFace& face) {
    return is_locked && (is_locked(face.a.tet()) || is_locked(face.b.tet()));
  };
  const auto first = std::stable_partition(opened_.begin(), opened_.end(), waits);
  std::vector<OpenedFace> taken(first, opened_.end());
  opened_.erase(first, opened_.end());
  return taken;
}

/// What was found locked before is looked at again.
void Maintainer::take_held(const TetMesh& mesh) {
  const std::vector<TetId> held = std::exchange(held_, {});
  for (const TetId tet : held) {
    is_held_[tet.value] = 0;
    if (mesh.is_live(tet)) push(mesh, tet);
  }
}

void Maintainer::hold(TetId tet) {
  is_held_.ensure(std::size_t{tet.value} + 1);
  if (std::exchange(is_held_[tet.value], std::uint8_t{1}) == 0) held_.push_back(tet);
}

/// How near a vertex is to what was taken up: 2 touched, 1 a neighbour, 0 not in care.
unsigned Maintainer::nearness(VertexId v) const {
  const bool is_known = v.value < in_care_.capacity() && in_care_[v.value] / 4 == epoch_;
  return is_known ? in_care_[v.value] % 4 : 0;
}

/// What is in care already is looked at again where it is touched again: the blade has made other tets there.
void Maintainer::add_to_care(VertexId v, unsigned near, std::vector<VertexId>& ring) {
  in_care_.ensure(std::size_t{v.value} + 1);
  in_care_[v.value] = epoch_ * 4 + std::max(nearness(v), near);
  add_to_ring(v, ring);
}

void Maintainer::add_to_ring(VertexId v, std::vector<VertexId>& ring) {
  is_in_ring_.ensure(std::size_t{v.value} + 1);
  if (std::exchange(is_in_ring_[v.value], std::uint8_t{1}) == 0) ring.push_back(v);
}

/// Takes a touched vertex and its neighbours into care.
void Maintainer::add_with_neighbours(const TetMesh& mesh, VertexId touched, std::vector<VertexId>& ring) {
  if (!mesh.is_live(touched)) {
    return;
  }
  add_to_care(touched, 2, ring);
  for (const TetId tet : walker_.star(mesh, touched)) {
    for (const VertexId v : mesh.vertices(tet)) add_to_care(v, 1, ring);
  }
}

/// Once the blade has gone, what the whole stroke touched is taken up again where it goes on from an older cut.
void Maintainer::look_for_seam(const TetMesh& mesh, std::vector<VertexId>& ring) {
  std::vector<VertexId> all;
  for (const KnownVertex& known : std::exchange(taken_, {})) {
    if (known.is_in(mesh)) all.push_back(known.vertex);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  for (const VertexId v : all) is_in_ring_[v.value] = 1;
  is_at_seam_ = tag_ != 0 && add_older_seam(mesh, tag_, all);
  tag_ = 0;
  for (const VertexId v : all) is_in_ring_[v.value] = 0;
  if (is_at_seam_) ring = all;
}

/// What an older cut had to leave dense around its end can be thinned out once this one, with another tag, goes on
/// from there. Returns whether there is any.
bool Maintainer::add_older_seam(const TetMesh& mesh, std::uint32_t tag, std::vector<VertexId>& ring) {
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

void Maintainer::push_stars(const TetMesh& mesh, const std::vector<VertexId>& centres) {
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

void Maintainer::push(const TetMesh& mesh, TetId tet, unsigned least_near) {
  const TetVertices& v = mesh.vertices(tet);
  const unsigned near = std::max({least_near, nearness(v[0]), nearness(v[1]), nearness(v[2]), nearness(v[3])});
  const double ratio = inradius_ratio(mesh, v), goal = near == 2 ? kGoal : (near == 1 ? kBadQuality : 0.0);
  if (ratio < goal && !mesh.is_flat_at_load(tet)) {
    heap_.push_back({ratio, tet});
    std::push_heap(heap_.begin(), heap_.end());
  }
}

Waiting Maintainer::pop() {
  std::pop_heap(heap_.begin(), heap_.end());
  const Waiting worst = heap_.back();
  heap_.pop_back();
  while (!heap_.empty() && heap_.front() == worst) {  // pushed twice
    std::pop_heap(heap_.begin(), heap_.end());
    heap_.pop_back();
  }
  return worst;
}

bool Maintainer::has_budget() const {
  return statistics_.work_units < work_units_ && !(*should_stop_ && (*should_stop_)());
}

/// One journal step: bad tets first, then what the cut made needlessly dense, then the tets that could be better.
void Maintainer::run_step(TetMesh& mesh, Journal& journal, StageTimes& times) {
  const std::uint64_t spent = statistics_.work_units;
  Transaction transaction(mesh, true);
  Care care{transaction, mesh, references_, walker_, statistics_, false, {}, changed_, is_locked_};
  for (std::uint64_t changes = 0; is_due() && has_budget() && changes < kChangesPerStep;) {
    const bool has_bad = !heap_.empty() && heap_.front().ratio < kBadQuality;
    const bool has_changed = has_bad || crowd_.is_empty() ? improve_worst(care, times) : thin_out_next(care, times);
    if (has_changed) {
      ++changes;
      requeue(care);
    }
  }
  journal.append_if_changed(transaction.commit());
  other_work_ += statistics_.work_units - spent;
}

bool Maintainer::improve_worst(Care& care, StageTimes& times) {
  const Waiting worst = pop();
  care.spend(1);
  const TetMesh& mesh = care.mesh;
  const bool is_fresh = mesh.is_live(worst.tet) && inradius_ratio(mesh, mesh.vertices(worst.tet)) == worst.ratio;
  if (is_fresh && is_locked(worst.tet)) {
    hold(worst.tet);
    return false;
  }
  if (!is_fresh) return false;
  care.is_bad = worst.ratio < kBadQuality;
  care.is_at_seam = false;
  care.has_met_lock = false;
  const bool has_improved = remedies_.improve(care, worst.tet, options_, times);
  if (!has_improved && care.has_met_lock) hold(worst.tet);
  if (!has_improved && !care.has_met_lock && care.is_bad) hopeless_.push_back({worst.tet, worst.ratio, time_});
  return has_improved;
}

bool Maintainer::thin_out_next(Care& care, StageTimes& times) {
  const StageZone zone(times, Stage::kMerge);
  care.is_bad = false;
  care.is_at_seam = is_at_seam_;
  care.spend(1);
  const KnownVertex current = crowd_.current();
  const bool is_there = options_.merge && current.is_in(care.mesh);
  if (is_there && crowd_.is_in_first_round() && !is_free(care.mesh, current.vertex, *is_locked_)) {
    crowd_.wait();
    return false;
  }
  crowd_.advance();
  return is_there && collapser_.thin_out(care, current.vertex, is_at_seam_ ? kBadQuality : 1.0);
}

/// The worst of the tets that wait for a trial; none where there is none.
Hopeless* Maintainer::find_trial(const TetMesh& mesh) {
  Hopeless* next = nullptr;
  for (Hopeless& entry : hopeless_) {
    if (!entry.waits_for_trial() || (next != nullptr && !entry.is_worse_than(*next))) continue;
    const bool is_there = mesh.is_live(entry.tet) && inradius_ratio(mesh, mesh.vertices(entry.tet)) == entry.ratio;
    if (is_there && is_of_cut(mesh, entry.tet) && splits_at(mesh, entry.tet) < kMostSplits) next = &entry;
  }
  return next;
}

/// Whether cuts made a tet, or may have: it has a vertex that the input did not have, or that the stroke moved, or
/// maintenance has changed something at each of its vertices.
bool Maintainer::is_of_cut(const TetMesh& mesh, TetId tet) const {
  const TetVertices& v = mesh.vertices(tet);
  return std::any_of(v.begin(), v.end(),
                     [&](VertexId id) { return !mesh.origin(id).is_valid() || nearness(id) == 2; }) ||
         std::all_of(v.begin(), v.end(), [&](VertexId id) { return changed_at(id) > began_; });
}

/// How many trials in turn led to a tet.
unsigned Maintainer::splits_at(const TetMesh& mesh, TetId tet) const {
  unsigned splits = 0;
  for (const VertexId v : mesh.vertices(tet)) {
    const bool is_known = v.value < splits_.capacity() && splits_[v.value] / 8 == epoch_;
    splits = std::max(splits, is_known ? splits_[v.value] % 8 : 0);
  }
  return splits;
}

/// The next trial of the worst of the tets that nothing mends. Returns false when none is left.
bool Maintainer::try_next(TetMesh& mesh, Journal& journal, StageTimes& times) {
  const StageZone zone(times, Stage::kImprove);
  const double most = kTrialShare * static_cast<double>(other_work_) + static_cast<double>(kTrialWork);
  const bool may_try = options_.improve && static_cast<double>(trial_work_) < most;
  Hopeless* const next = may_try ? find_trial(mesh) : nullptr;
  if (next == nullptr) {
    for (Hopeless& entry : hopeless_) entry.trials = kTrials;  // gone, or not to be improved
    return false;
  }
  Transaction transaction(mesh, true);
  Care care{transaction, mesh, references_, walker_, statistics_, true, {}, changed_, is_locked_};
  const MaintainStatistics before = statistics_;
  const unsigned splits = splits_at(mesh, next->tet) + 1;
  if (try_on(care, next->tet, next->trials++)) {
    for (const VertexId born : trial_.born()) {
      take_born(born);
      splits_.ensure(std::size_t{born.value} + 1);
      splits_[born.value] = epoch_ * 8 + splits;
    }
    requeue(care);
    journal.append(transaction.commit());
    return true;
  }
  trial_work_ += statistics_.work_units - before.work_units;
  const std::uint64_t spent = statistics_.work_units;
  statistics_ = before;  // the transaction is rolled back
  statistics_.work_units = spent;
  return true;
}

/// One of the trials of a tet: merges along its edges, both ways, and then splits.
bool Maintainer::try_on(Care& care, TetId tet, unsigned trial) {
  if (trial >= kMergeTrials) return trial_.split(care, tet, trial - kMergeTrials);
  return options_.merge && trial_.merge(care, tet, trial / 2, trial % 2 != 0);
}

void Maintainer::take_born(VertexId vertex) {
  in_care_.ensure(std::size_t{vertex.value} + 1);
  in_care_[vertex.value] = epoch_ * 4 + 2;
}

/// What the last operation changed is judged anew: it may lie beyond what is in care.
void Maintainer::requeue(Care& care) {
  if (care.born.is_valid()) {
    take_born(care.born);
    care.born = {};
  }
  ++time_;
  changed_at_.ensure(care.mesh.vertex_slots());
  for (const TetId tet : changed_) {
    push(care.mesh, tet, 1);
    for (const VertexId v : care.mesh.vertices(tet)) changed_at_[v.value] = time_;
  }
}

}  // namespace v0
}  // namespace incise
