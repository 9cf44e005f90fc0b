// SPDX-License-Identifier: Apache-2.0
// The constants of bodies that deform, with what each is measured in and what goes wrong where it is changed. Where no
// source is named a value was chosen by hand, and changing it changes hashes. The local edge is the mean edge of a
// star.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

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
inline constexpr std::size_t kMostUntangled = 4000;

// --- a body that follows the mesh (`body_follow`, `body_pieces`, `body_rewind`, `stars`)

/// Tets resist a change of volume themselves as tissue of this Poisson's ratio would. More of it locks: with 0.3 a
/// cantilever of four cells across at ν 0.49 is 25 % too stiff. Without any, the volumes of single tets are free.
inline constexpr double kOwnPoisson = 0.1;
/// Slabs of a body in which its vertices are sorted, at most, along its longest axis: flat ones would have no end of
/// them.
inline constexpr double kMostSlabs = 1000;
/// Vertices that follow each other are seldom neighbours, so that one visit need not wait for the one before it: of so
/// many in turn, each comes so many places after the one before it. A matter of speed, but hashes follow the order.
inline constexpr std::size_t kOrderWindow = 64, kOrderStride = 8;
/// Tets below this share of a tet's mean volume at load only resist stretch: a lump a hundredth of a cell wide. Moved
/// by a cell it would swell a million times.
inline constexpr double kLeastLump = 3e-6;
/// The weight of a parent that has no part in a birth: rounding alone gives it one.
inline constexpr double kNoWeight = 1e-9;
/// So many vertices are labelled by their piece in a step: a large body waits a few steps before its new pieces are
/// told apart.
inline constexpr std::size_t kLabelledPerStep = 20000;
/// Barycentric weights below this are not followed: beside a thin tet they would lead far away. From there on a vertex
/// lies as at rest.
inline constexpr double kFarthestWeight = -0.5;
/// Steps of a walk from tet to tet.
inline constexpr unsigned kMostWalkSteps = 500;

// --- visits and substeps (`body_advance`, `body_energy`, `bones`, `element`, `star_kernel`, `sweep_order`)

/// A vertex leaps that goes further in a substep than this share of the reach of a visit, so 0.005 of the local edge: a
/// tenth of the thickness that the thinnest tets are taken for.
inline constexpr double kSafeLeap = 0.02;
/// More sweeps of what `list_strained` lists, for substeps of this length, s; and the rings of neighbours that it takes
/// in.
inline constexpr double kUsualSubstep = 1.0 / 240;
inline constexpr unsigned kStrainedSweeps = 20;
inline constexpr unsigned kStrainedRings = 2;
/// Changes below this share of the sum of single-precision energies, which do not start at 0, are rounding.
inline constexpr double kEnergyNoise = 2e-7;
/// Beyond this much of 1 + Q/8 a tet stiffens no more: it is 8⁷, two million times as stiff as at rest.
inline constexpr double kStiffest = 8;
/// Fibres that are shorter than taut by this share or less count in the curvature: no visit finds itself beyond where
/// they begin to pull.
inline constexpr float kNearlyTaut = 0.02F;
/// Rounds of Higham's iteration with scaling: bones twenty times as long as wide need 8.
inline constexpr unsigned kBoneTurnRounds = 12;
/// As far as a visit moves a vertex of a bone at most, in reaches: one local edge.
inline constexpr double kFarthestVisit = 4;
/// Steps without motion before a vertex sleeps: by itself, by a neighbour.
inline constexpr std::uint8_t kHotSteps = 10, kWarmSteps = 5;

// --- lips that were joined or parted go towards their balance (`body_balance`)

/// Sweeps between two looks at the energy: each is over in a moment, and most often one is enough.
inline constexpr std::array kBalanceSweeps = {1U, 1U, 2U, 4U};
/// A step that adds no more than this share of what its tets had adds nothing.
inline constexpr double kBalanceGain = 0.01;
/// Strains below are none.
inline constexpr double kNoStrain = 1e-3;
/// From these numbers of vertices on, by the tets that were touched and besides, a further ring is taken in only where
/// the energy is still more than this multiple of what it was: where lips that stood apart were joined. In the end all
/// are swept this number of times more.
inline constexpr std::size_t kMostByTouched = 4, kMostBesides = 400;
inline constexpr double kFarMore = 1.5;
inline constexpr unsigned kMoreSweeps = 24;

// --- the coarse lattice

/// Cells along the longest axis, at most.
inline constexpr double kMostLatticeCells = 10;
/// Mean edges that a cell is wide at least: sweeps see to what is shorter.
inline constexpr double kLeastLatticeSpacing = 2.5;
/// Vertices of a piece that gets one: in smaller ones sweeps reach everywhere.
inline constexpr std::size_t kLeastLatticeVertices = 64;
/// Vertices of the body for each node of the lattice, at least; and nodes in any case at most.
inline constexpr std::size_t kVerticesPerNode = 4, kMostLatticeNodes = 400;
/// How stiff what is held is, by the vertex' own stiffness: it hardly moves.
inline constexpr double kHoldStiffness = 10;
/// The lattice's own Poisson's ratio: linear cells lock near 1/2.
inline constexpr double kLatticePoisson = 0.3;
/// Steps after which the lattice is turned with the body.
inline constexpr unsigned kTurnEvery = 4;
/// The most that one answer moves a vertex, in cells.
inline constexpr double kFarthestAnswer = 0.5;
/// How many times further than it asks an answer may be taken.
inline constexpr double kLongestAnswer = 2;

// --- tools, tissues and the grid of contact

/// The balls that stand for a rod in an outline: a row of balls reads as a rod.
inline constexpr int kRodBalls = 24;
/// Cells of the grid for each box, at most: more would cost more to clear than they save.
inline constexpr double kCellsPerBox = 8;
/// The cosine by which normals of faces may have turned since the grid was made, and by which a face may be nearer.
inline constexpr float kTurnedSince = 0.15F;
/// Poisson's ratio of soft tissues in the table: water does not let soft tissue be compressed, which linear tets do not
/// bear.
inline constexpr double kSoftPoisson = 0.45;
/// Friction by tearing: of what needles meet in tissue 61 % is tearing and 21 % friction (Barnett 2016).
inline constexpr double kRubbing = 21.0 / 61;

}  // namespace detail
}  // namespace v0
}  // namespace incise
