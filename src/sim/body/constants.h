// SPDX-License-Identifier: Apache-2.0
// Constants of contact, of free pieces and of averaged volumes.
#pragma once

namespace incise {
inline namespace v0 {
namespace detail {

/// Frames over which the depth fades at which a contact was found: at 60 Hz a twelfth of a second, short to the eye and
/// long against the swing of one cell. 1 throws tissue out that something appeared in.
inline constexpr unsigned kFadingFrames = 5;

/// Free pieces smaller than this share of the mean tet at load are crumbs and move as points: a few slivers, whose
/// descent single precision does not carry (21 of them were drawn out to 1e5 times their size).
inline constexpr double kCrumbPiece = 1e-2;
/// Seconds after which a crumb sleeps.
inline constexpr double kCrumbSeconds = 1;

/// Free pieces further from what is held than this many of its extents sleep: nobody sees them, and where they go on
/// they are cut and computed on.
inline constexpr double kLost = 5;

/// Shares of the local edge. A slow vertex is taken for contact when it is as near as this: contacts come into being
/// before they are needed.
inline constexpr double kContactMargin = 0.1;
/// A vertex deeper than this that was no contact before is let alone: no explosion is worth a repaired overlap.
inline constexpr double kDeepest = 0.5;
/// Or, as a multiple, than the way that the two came nearer in a step.
inline constexpr double kDeepestSteps = 1.5;
/// How far a search must see at least, in mean edges of the surface, and at most; beyond what it must, the grid of
/// faces sees by the last two more, so that it serves for some steps.
inline constexpr double kLeastReach = 0.15, kMostReach = 1.5, kReachMore = 0.1, kReachTimes = 1.5;
/// A contact keeps its face, without a look at others, as long as it has not slid by more than this, in local edges,
/// and for at most this number of steps.
inline constexpr double kLookAgain = 0.02;
inline constexpr unsigned kMostUnseen = 8;
/// Cells of the grid are longer by this than it sees, in mean edges.
inline constexpr double kGridCell = 0.6;
/// How far a vertex may stand beside the nearest point of a face, in edges: from the one on contact gets softer, from
/// the other on there is none. Neither depends on the gap: what rests would press and let go by turns.
inline constexpr double kBesideALittle = 0.03, kBesideFace = 0.1;
/// The least cosine between the vertex' normal and the face's, turned round: a vertex on the side of a body does not
/// face its top.
inline constexpr double kFacing = 0.2;
/// Faces as near as the nearest but for this share of an edge are as good: twins of a fresh cut are exactly so.
inline constexpr double kAsNear = 1e-3;
/// The face of the last step is as good as the nearest within this share of an edge, and counts as met more squarely by
/// this cosine: else what rests would go to and fro between faces, and never sleep.
inline constexpr double kKnownAsNear = 1e-2, kKnownSquarer = 0.1;
/// A vertex that lies behind a face by more than this at rest, and no further than it is now, is behind it through the
/// material: a thin flap is not in contact with its own back.
inline constexpr double kBehindAtRest = 0.05;
/// An anchor further from its face than this number of the face's own shares is let go.
inline constexpr double kFarthestAnchor = 8;

/// How often each carried piece is moved to where its neighbours leave it, at the end of a substep.
inline constexpr unsigned kCarriedRounds = 3;

/// How stiff a visit takes a tet to be by the share of its volume that its vertices average, against one that keeps
/// that share for itself; no unit. A visit reads its neighbours' pressures as they were, so that all vertices around
/// one answer the same pressure: below 1 they go too far together, and a cantilever stays where it was (measured at
/// Poisson's ratio 0.49 on a grid and on jittered ones); above 5 sweeps are slow.
inline constexpr double kSharedBend = 3;

// --- tets that a step left inside out (`untangle`)

/// The share of its volume at rest that such a tet is given; no unit. With 0.01 more of them turn over again.
inline constexpr double kLeastVolume = 0.1;
/// No corner goes further for one of them at once, in its reach (a quarter of its edges); no unit.
inline constexpr double kTurningReach = 0.5;
/// Each time those around what moved are looked at as well. In soft bodies that are cut, 8 left one in two of them, 30
/// one in ten.
inline constexpr unsigned kTurningSweeps = 30;
/// In one step, so that a body that is torn into slivers takes some milliseconds at most.
inline constexpr std::size_t kMostTurns = 4000;

}  // namespace detail
}  // namespace v0
}  // namespace incise
