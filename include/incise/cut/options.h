// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace incise {
inline namespace v0 {

/// Which pipeline cuts.
enum class Profile : std::uint8_t {
  kPaper,   ///< the paper to the letter where it is unambiguous: the baseline
  kIncise,  ///< exact classification, snapping before splitting, star components
};

/// How a blade cuts.
struct CutOptions {
  Profile profile = Profile::kIncise;  ///< which pipeline
  /// Snapping distance as a fraction of the mean length of a vertex's edges, in [0, 0.4]. 0 turns snapping and the
  /// clamp of split points off, and only what is smaller than a ten-thousandth of a cubed edge is a crumb then. Above
  /// 0.3 cuts may lose thin pieces. Ignored by the paper profile.
  double snap = 0.2;
};

/// What cutting did, summed over the steps of a stroke. A step takes back what the ones before it did only as far as
/// the blade had come: counts of growth can be below zero for a step, and so for a frame; their sums over a stroke are
/// what is there at its end.
struct CutStatistics {
  std::uint64_t steps = 0;             ///< blade steps swept
  std::uint64_t cut_tets = 0;          ///< tets with material on both sides of the sweep, replaced or separated
  std::int64_t created_tets = 0;       ///< growth: tets after minus tets before
  std::int64_t new_vertices = 0;       ///< growth: split points and copies
  std::uint64_t copied_vertices = 0;   ///< the copies among them
  std::int64_t incision_faces = 0;     ///< growth: faces opened, one per pair of sides
  std::uint64_t snapped_vertices = 0;  ///< vertices that took part in the cut instead of being split beside
  std::uint64_t bent_vertices = 0;     ///< snapped, but not movable onto the sweep: the wall bends to them
  std::uint64_t crumbs_kept = 0;       ///< pieces too small to separate, left attached
  std::uint64_t pinched_edges = 0;     ///< edges bisected because both their fans kept both ends
  std::uint64_t latent_faces = 0;      ///< incision faces whose vertices all stayed joined
  std::uint64_t blocked_edges = 0;     ///< edges left whole because a tet around them is, or would become, flat
  std::uint64_t sheets = 0;            ///< parts into which a sweep that meets itself was taken, in time order

  CutStatistics& operator+=(const CutStatistics& other);
  /// Takes a part of the sum away again.
  CutStatistics& operator-=(const CutStatistics& other);
};

}  // namespace v0
}  // namespace incise
