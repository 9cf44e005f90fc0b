// SPDX-License-Identifier: Apache-2.0
// The constants of the paper's profile, with what each is measured in, and what goes wrong where it is changed. Where
// no source is named the paper is silent, and a value was chosen by hand.
#pragma once

#include <cstddef>

#include "incise/mesh/quality_stats.h"

namespace incise {
inline namespace v0 {

/// Two crossings of one edge closer than this share of it are one graze, not two sheets. More, and thin slabs between
/// two sheets are lost; less, and edges are bisected for slivers.
inline constexpr double kGrazeShare = 0.02;
/// The most children of a tet: what the ids must have room for.
inline constexpr std::size_t kMostChildren = 16;
/// An edge crossed twice is bisected at most so often; what is crossed twice then still is taken as crossed once.
inline constexpr unsigned kMaxBisectionRounds = 8;

namespace paper {

/// L/r above which a tet is bad-shaped. Merging and Boundary Laplacian may not make a tet worse than this, nor worse
/// than the worst about already is. **Source:** Paper §4.3, Table 3 ("measurement > 200").
inline constexpr double kBadShape = kBadRatio;
/// Boundary edges whose faces enclose a greater angle than this are sharp, and so are contours that turn by more:
/// 45°, as its cosine √½. Below it lie the facets of a curved skin of a few hundred faces; above it what one sees as an
/// edge.
inline constexpr double kSharpCosine = 0.70710678118654752440;
/// How often a move that does harm is tried: the whole way, half, a quarter, an eighth. What is left after that is less
/// than the paper's smoothing is worth.
inline constexpr unsigned kMoveTries = 4;

}  // namespace paper

}  // namespace v0
}  // namespace incise
