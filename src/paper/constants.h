// SPDX-License-Identifier: Apache-2.0
// The constants of the paper's profile, with what each is measured in, and what goes wrong where it is changed. Where
// no source is named the paper is silent, and a value was chosen by hand. What a blade does alike in both profiles is
// in cut/constants.h and cut/blade_constants.h.
#pragma once

#include <cstddef>

#include "incise/mesh/quality_stats.h"

namespace incise {
inline namespace v0 {

/// The most children of a tet: what the ids must have room for.
inline constexpr std::size_t kMostDivided = 16;

/// Sweeps of Jacobi's method that fit a plane: convergence is quadratic, five reach rounding.
inline constexpr int kPlaneSweeps = 8;
/// Faces around a vertex, at most: ends the walk on a surface that is broken at load.
inline constexpr std::size_t kLongestFan = 4096;

/// A sweep that turns sharply more often is not cut as one sheet: an edge of the mesh might cross each of its folds.
inline constexpr std::size_t kMostTurns = 4;

/// Edges that bisection makes are asked about the strips that were laid within so many spacings of travel before: a tet
/// that the front stands in is seldom longer.
inline constexpr double kStripsReach = 2.0;

/// A blade that has travelled so many spacings and comes within so many of where its incision began closes a ring.
inline constexpr double kRingTravel = 4.0;
inline constexpr double kClosesWithin = 0.25;

/// A piece is on both sides of a ring's walls if it has more than this share of its own on either: half of them if the
/// ring is joined, one of a thousand that lie at a corner if not.
inline constexpr double kJoinedShare = 0.25;

/// A stroke goes on with an incision where a collision point at that one's front lies in the plane of its sheet within
/// so many of its vertex's mean edges (`kJoinOffset`), and within so many of the longest ones of the sheet itself
/// (`kJoinReach`), and the two sheets enclose less than 45° there (`kJoinCosine`: √½). Two strokes of one hand meet
/// within rounding; with more than a tenth of an edge a cut beside another one is drawn into it. A point may lie an
/// uncut tet behind the front, whose edges are longer than those that are left of it.
inline constexpr double kJoinReach = 2.0;
inline constexpr double kJoinOffset = 0.1;
inline constexpr double kJoinCosine = 0.70710678118654752440;

/// The wall of an older cut goes along a sheet, as the same cut, where it encloses less than 20° with it: its cosine.
/// With more, walls that cross in a star of ten pieces pass for one beside their axis; with less, the facets of a bent
/// wall that was smoothed do not count.
inline constexpr double kAlongCosine = 0.94;
/// A stroke crosses an older wall where it encloses more than 10° with it: its cosine. With more, planes that cross at
/// small angles come out joined beside their axis; with less, crumbs come off where a bent sheet goes over its own
/// wall.
inline constexpr double kCrossingCosine = 0.985;
/// A sheet goes on beyond its border within a cone of this slope, as far as is known: a corner of a tet that lies
/// there, on an older wall, may lie on its next strip.
inline constexpr double kMostBend = 0.5;
/// As far as an older wall is taken for one of a sheet's own, that slope is less. With 0.35 and more, planes that cross
/// at 14° to 18° in many short strips come out joined beside their axis.
inline constexpr double kWallBend = 0.3;

/// The ends of so many strokes are remembered: more than a hand leaves open at once.
inline constexpr std::size_t kEndsKept = 16;
/// In a body that moves a blade that goes back is in its wound, and held, until it is so many spacings away from the
/// front, or further than the wound is long: then it is on another way. Less, and one that is drawn back by some
/// elements cuts crumbs off the lips.
inline constexpr double kLeavesWound = 6.0;

namespace paper {

/// In a body that moves, what is closed in is a crumb if it has less than half of the volume of the largest tet within
/// so many faces, or less than a quarter of that of a typical one. With a third within two faces a saw leaves five
/// crumbs in soft muscle; with a sixth of a typical one a vein ends in two pieces.
inline constexpr double kCrumb = 0.5;
inline constexpr unsigned kCrumbReach = 3;
inline constexpr double kCrumbOfMean = 0.25;

/// L/r above which a tet is bad-shaped. Merging and Boundary Laplacian may not make a tet worse than this, nor worse
/// than the worst about already is. **Source:** Paper §4.3, Table 3 ("measurement > 200").
inline constexpr double kBadShape = kBadRatio;
/// Between the skin before a merge and after it may lie at most this share of the volume of the tets there. More, and a
/// stroke through a coarse body with round, thin parts takes 2 % of it away; less, and thin tets stay where skin is
/// curved.
inline constexpr double kMostSkinChange = 0.01;
/// An edge below this share of the body's typical edge is tiny: the tets of a layer that thin have an L/r above 200,
/// whatever their other edges are. Unit 1. 1/20 gives a little less, with 1/80 layers of SPINE stay.
inline constexpr double kTinyEdge = 1.0 / 40;
/// How many times worse than the worst was a merge of a tiny edge may leave a tet. Unit 1. Of 81 planes through CUBE,
/// by its planes of vertices or anywhere, 1 leaves 1,741 bad shapes, 1.5 leaves 603, 2 leaves 605 and 3 to 1,000 leave
/// 565 to 581; beyond that tets that are all but flat are let in.
inline constexpr double kMostWorse = 5;
/// Boundary edges whose faces enclose a greater angle than this are sharp, and so are contours that turn by more:
/// 45°, as its cosine √½. Below it lie the facets of a curved skin of a few hundred faces; above it what one sees as an
/// edge.
inline constexpr double kSharpCosine = 0.70710678118654752440;
/// Two faces at an edge lie in one plane where the sine of their angle is at most this: rounding, no more. With more,
/// swaps on the boundary would change the volume.
inline constexpr double kFlatSine = 1e-6;
/// How often a move that does harm is tried: the whole way, half, a quarter, an eighth. What is left after that is less
/// than the paper's smoothing is worth.
inline constexpr unsigned kMoveTries = 4;

}  // namespace paper

}  // namespace v0
}  // namespace incise
