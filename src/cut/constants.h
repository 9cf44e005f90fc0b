// SPDX-License-Identifier: Apache-2.0
// The constants of cutting a mesh along a sheet, with what each is measured in and what goes wrong where it is changed;
// those of the way that the blade takes are in blade_constants.h. Where no source is named a value was chosen by hand,
// and changing it changes hashes. A spacing is the mean edge of the mesh before it was cut. Documents cite names.
#pragma once

#include <cstddef>

namespace incise {
inline namespace v0 {

// --- where the sheet crosses the mesh (`sheet_crossing`, `contact_walk`, `stroke_cut`)

/// Vertices closer to the blade than this share of their mean edge coincide with it: geometry given twice, not a
/// choice.
inline constexpr double kCoincident = 1e-6;
/// Two crossings of one edge closer than this share of it are one graze, not two sheets. More, and thin slabs between
/// two sheets are lost; less, and edges are bisected for slivers.
inline constexpr double kGrazeShare = 0.02;
/// A chord between two crossings that stays this share of its length away from the sheet is as good as on it: one
/// graze, not two crossings.
inline constexpr double kGrazeChord = 0.1;
/// An edge crossed twice is bisected in at most so many rounds; what is crossed twice then still is taken as crossed
/// once.
inline constexpr unsigned kMaxBisectionRounds = 8;
/// Split points keep this share of their edge on either side, where snapping is on. Less, and tets at both ends of an
/// edge get thinner.
inline constexpr double kSplitClamp = 0.02;
/// Two crossings of an edge within so many spacings of travel are a corner of the blade's way: the cut passes it by
/// (docs/decisions/0120).
inline constexpr double kCornerTravel = 1.5;
/// Strips of more triangles than this are searched by their tree. A matter of speed.
inline constexpr std::size_t kFewTriangles = 4;
/// Coordinates are rounded to this share of their magnitude, with room to spare.
inline constexpr double kBoxRounding = 1e-12;
/// A front that passes a tet's box this close by, as a share of the box's diagonal, may lie in it.
inline constexpr double kCloseBy = 1e-6;

// --- what lies behind the front (`stroke_cut`)

/// What lies further behind the front than so many spacings is settled, at rest and in a body that moves: less than
/// that, and a blade that trembles would come back to it (docs/decisions/0024).
inline constexpr double kBand = 0.5, kMovingBand = 1.0;
/// What is crossed at most this share of an edge (`uncut_length`) beyond the rim of an older cut, where the sheet ends
/// there, is let go. 0.4 is no better; 0.2 leaves edges that join what two strokes should part (docs/decisions/0137).
inline constexpr double kLetGo = 0.3;

// --- front points (`front_points`, `division`)

/// The margin of front points once the blade has stopped, as a share of the height of their face: nothing has to be
/// simulated beside them until they are maintained.
inline constexpr double kFinalMargin = 0.04;
/// The border of a sheet turns where its direction changes by more than this cosine tells, 20°.
inline constexpr double kStraight = 0.94;
/// A border that passes this close, as a barycentric share, to an edge at the vertex that stands for the crossing is
/// absorbed by it, where the face has no split edge: the line from there to the border runs along that edge.
inline constexpr double kLeastOpen = 1e-6;
/// Once the blade goes no further, points slide along the sheet by at most this share of the mean edge to keep off the
/// edges of their face; what is lacking then they give way across the sheet, but at least the lesser share always.
inline constexpr double kMostSlide = 0.03, kLeastMargin = 0.01;
/// The front point inside a tet keeps this barycentric share from every side, where it can.
inline constexpr double kInnerMargin = 0.08;
/// It is drawn along the sheet by this share of an edge at most.
inline constexpr double kGreatestDraw = 0.15;

// --- beside older walls (`front_points`, `older_walls`, `spacing`)

/// How far an older wall may pass beside a place of the sheet that counts as open already, as a share of the local
/// edge before it was cut (`uncut_length`), with snapping and without; and how far short of that place its rim may end.
/// Of 600 cuts that go over older ones 17 fall short with 0.12, 15 with 0.2 and with 0.3, which joins two strokes that
/// overlap (docs/decisions/0034).
inline constexpr double kBesideWall = 0.2, kBesideExactly = 0.02, kBeyondRim = 0.2;
/// A wall whose normal has at least this cosine with the sheet's runs along it: 60°. Fronts are crooked: 0.9 misses
/// their facets.
inline constexpr double kRunsAlongOlder = 0.5;
/// A segment meets a wall at an angle of which this is the sine at least: in its plane, rounding would decide.
inline constexpr double kAcrossWallSine = 0.1;
/// Edges near an older wall count as longer than they are by this factor at most, for a mesh may be finer in places
/// (docs/decisions/0137).
inline constexpr double kMostShortened = 8.0;
/// Uncut tets tell how long edges were before cuts where they are at least this share of those looked at.
inline constexpr double kUncutShare = 0.125;

// --- vertices that move onto the sheet (`snapping`)

/// The snapping distance counts by this share for vertices of skin that cannot be moved onto the sheet, since the wall
/// then bends to them. Not so for those of older walls: where cuts cross, what lies between them and the sheet would be
/// splinters.
inline constexpr double kBentReach = 0.5;
/// A wall whose normal has at least this cosine with the sheet's lies along it: 26°. Older walls are crooked at their
/// fronts, and may by the second: 37°.
inline constexpr double kSnapAlong = 0.9, kSnapAlongOlder = 0.8;
/// Older walls attract within this share of the spacing at least, whatever the snapping distance: without snapping
/// those that the sheet goes on from, at less than 8 degrees (the cosine that follows), since where planes cross the
/// pieces are to be exact. With it, those at less than 8 degrees attract from so many times as far: strokes of a hand
/// that wanders by a tenth of the body's mean edge to either side are one, also where edges are shorter than that.
/// More, and thin slices are not cut (docs/decisions/0090).
inline constexpr double kLeastOlderReach = 0.02, kAlongExactly = 0.99, kParallelReach = 1.15;
/// A move changes the volume of a star by this share of it at most, rounding, or not at all: overlapping input tets
/// would not obey.
inline constexpr double kSnappedVolume = 1e-11;

// --- what is too small to be a piece (`crumbs`, `bridges`, `star_parts`)

/// A piece smaller than this share of the cubed edge length is a crumb: debris of a blade that grazes a vertex
/// (docs/decisions/0012). Without snapping pieces are to be exact, and only what walls that were smoothed leave of a
/// line where three cuts meet is one.
inline constexpr double kCrumbShare = 0.02, kExactCrumbShare = 1e-4;
/// Tets of the largest piece that may be a crumb or a shaving.
inline constexpr std::size_t kMaxCrumbTets = 256;
/// So many tets of a piece are gathered around a place. A matter of speed.
inline constexpr std::size_t kMaxPieceSearch = 512;
/// A piece may look so many times too thick while it is searched, and as thick as it likes while it has few tets: its
/// walls come last.
inline constexpr double kWhileGrowing = 2.0;
inline constexpr std::size_t kFewTets = 32;
/// The sides of the cut are looked for within so many spacings of a place, faces to be opened within so many: what
/// joins the sides beyond is the body, not the seam.
inline constexpr double kBridgeBall = 2.5, kOpenWithin = 1.5;
/// Walls within so many spacings of a seam are looked at.
inline constexpr double kNearJoint = 1.0;
/// A face lies on the sweep if its middle is within so many spacings of it (docs/decisions/0145).
inline constexpr double kOnSweep = 0.3;
/// Its middle is beside the sweep, not beyond the border of that, if so much of the way there is across the sweep, a
/// cosine. Nearer than so many spacings it is on it.
inline constexpr double kBesideSweep = 0.8, kOnSweepExactly = 0.02;
/// A part between walls that is thinner than so many spacings, on the average, is a shaving, and no side
/// (docs/decisions/0145).
inline constexpr double kShaving = 0.2;
/// Material stands where a vertex does within this share of a tet's size: the rounding of interpolation.
inline constexpr double kSamePlace = 1e-9;

// --- the mesh made anew (`rebuild`, `reversal`)

/// Closing a face may pinch another edge. Rounds beyond so many are not worth their time: what is pinched by then is
/// opened as it is.
inline constexpr unsigned kMaxPinchRounds = 64;
/// A vertex is looked for this share of the way to the middle of a tet that it had: on its own side of a wall.
inline constexpr double kReversalInwards = 0.02;
/// A place that would have a barycentric weight below this in a tet is sampled in it as it was before anything moved.
inline constexpr double kLeastSampledWeight = -2.0;

// --- the grid of the surface's sides (`surface_index`): a matter of speed and memory, but for the rounding

/// Cells of the grid at most, and along one axis.
inline constexpr double kMostIndexCells = 4e6, kMostIndexAlong = 6e4;
/// A cell is so many mean edges of the surface wide.
inline constexpr double kCellEdges = 2.0;
/// The grid is built anew, with cells for the edges of then, once it lists so many times the sides of when it was
/// built, and so many more: cuts add ten times as many, and each search of a cell looks at all of its sides.
inline constexpr std::size_t kGrown = 4, kGrownBy = 1000;
/// Halvings of a triangle's box: from a million bodies down to a cell takes 60.
inline constexpr unsigned kMostCellHalvings = 100;
/// Bounds of cells are rounded by this share of a cell's size and of the place's coordinates at most.
inline constexpr double kCellRounding = 1e-9;

}  // namespace v0
}  // namespace incise
