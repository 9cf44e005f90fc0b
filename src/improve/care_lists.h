// SPDX-License-Identifier: Apache-2.0
// What waits for maintenance: tets by their quality, vertices that may not be needed, tets that nothing has mended yet.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "improve/constants.h"
#include "incise/core/grow_array.h"
#include "incise/geom/quality.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// A tet in care, with its quality when it was put there.
struct Waiting {
  double ratio;
  TetId tet;

  /// Heaps keep the greatest in front: here the worst, of equals the lowest.
  bool operator==(const Waiting& o) const { return ratio == o.ratio && tet == o.tet; }
  bool operator<(const Waiting& o) const { return ratio != o.ratio ? ratio > o.ratio : o.tet.value < tet.value; }
};

/// A bad tet that no operation by itself could mend, at a time in changes.
struct Hopeless {
  TetId tet;
  double ratio;
  std::uint64_t time;
  unsigned trials = 0;  ///< so far, of `kTrials`

  [[nodiscard]] bool is_worse_than(const Hopeless& o) const { return ratio != o.ratio ? ratio < o.ratio : tet < o.tet; }
  [[nodiscard]] bool waits_for_trial() const { return ratio < kTried && trials < kTrials; }
};

/// A vertex, by slot and generation: slots are used again.
struct KnownVertex {
  VertexId vertex;
  std::uint32_t generation;

  [[nodiscard]] bool is_in(const TetMesh& mesh) const {
    return mesh.is_live(vertex) && mesh.generation(vertex) == generation;
  }
};

/// Vertices that cuts made, to be merged where they are not needed: gone through in rounds, since a merge makes room
/// for others. What lies where others are at work waits outside until `begin`. Each is there once.
class Crowd {
 public:
  [[nodiscard]] bool is_empty() const { return entries_.empty(); }
  [[nodiscard]] bool has_waiting() const { return !waiting_.empty(); }
  [[nodiscard]] bool is_in_first_round() const { return round_ == 0; }
  void add(const TetMesh& mesh, VertexId vertex) {
    const std::uint32_t generation = mesh.generation(vertex);
    known_.ensure(std::size_t{vertex.value} + 1);
    if (std::exchange(known_[vertex.value], generation + 1) != generation + 1) entries_.push_back({vertex, generation});
  }
  /// The first round begins, with those that waited.
  void begin() {
    entries_.insert(entries_.end(), waiting_.begin(), waiting_.end());
    waiting_.clear();
    round_ = 0;
    next_ = 0;
  }
  /// The one whose turn it is.
  [[nodiscard]] KnownVertex current() const { return entries_[next_]; }
  /// It waits, or has had its turn in this round.
  void wait() {
    waiting_.push_back(entries_[next_]);
    entries_[next_].vertex = {};
    advance();
  }
  void advance() {
    if (++next_ < entries_.size()) return;
    next_ = 0;
    if (++round_ == kThinningRounds) forget(entries_);
  }
  void clear() {
    forget(entries_);
    forget(waiting_);
  }

 private:
  void forget(std::vector<KnownVertex>& vertices) {
    for (const KnownVertex& v : vertices) {
      if (v.vertex.is_valid()) known_[v.vertex.value] = 0;
    }
    vertices.clear();
  }

  std::vector<KnownVertex> entries_, waiting_;
  ZeroedArray<std::uint32_t> known_;  // by vertex slot: 1 + the generation of the one that is there
  std::size_t next_ = 0;
  unsigned round_ = 0;
};

}  // namespace v0
}  // namespace incise
