// SPDX-License-Identifier: Apache-2.0
// The constants of the mesh and of surfaces that it carries, with what each is measured in and what goes wrong where it
// is changed. All were chosen by hand. Those of the input's checks are in include/incise/mesh.
#pragma once

namespace incise {
inline namespace v0 {

// --- the mesh, its attributes and its mirrors

/// Two walls lie on one another where the cosine of the angle between their normals, turned round, is above this.
inline constexpr double kFolded = 0.9;
/// Volumes that differ by less than this share are equal up to rounding.
inline constexpr double kVolumeRounding = 1e-9;
/// Of a vertex's lumped volume: where less than this is left of it the difference has lost its digits, or all of them.
inline constexpr double kDigitsLost = 1e-6;
/// The weight of a parent below which it is none: weights are computed, and seldom exactly 0.
inline constexpr double kLeastPart = 1e-6;
/// Cells of a grid per tet at most: bodies that fill little of their box get larger cells.
inline constexpr double kMostCellsPerTet = 4;
/// Share of a tet's extent below which a place counts as inside: far above rounding, far below what is seen.
inline constexpr double kCountsAsInside = 1e-9;

// --- which tet a place of a surface hangs on (`near_tets`, `embedded_surface`, `surface_keeper`, `drawn_surface`)

/// Mean edges by which tets are looked for further away than points lay at first: maintenance moves the skin by less.
inline constexpr double kReachMargin = 0.25;
/// Share of the way to `towards` at which it is asked what a place hangs on.
inline constexpr double kAskedTowards = 1e-3;
/// Share of the way to the middles of its triangles at which it is asked what a point hung on.
inline constexpr double kAskedInwards = 1e-2;
/// Share of the way to which a crossing is found.
inline constexpr double kCrossingPrecision = 0x1p-20;
/// Weights below this do not tell what a place on the border of a tet lies on: above what `kCrossingPrecision` leaves
/// in tets a thousand times thinner than edges of the surface are long.
inline constexpr double kTellingWeight = 1e-3;
/// The share of wall vertices from which on a place lies at a wall. Maintenance moves each lip on its own, so that they
/// overlap a little at rest: the place may then be a way off the rim. Below it lie grooves of the skin.
inline constexpr double kAtWallShare = 0.75;
/// Squared distances that differ by less than this share are the same, but for rounding.
inline constexpr double kSameDistance = 1e-8;
/// How far aside places are taken, in extents of the body: above rounding, and far below what is seen; in no direction
/// that meshes or blades are made along.
inline constexpr double kAsideX = 4.7e-8, kAsideY = 2.9e-8, kAsideZ = 6.1e-8;

// --- how a surface is divided and drawn

/// How often a triangle is halved between walls; beyond it, walls that lie still closer count as one.
inline constexpr unsigned kMostWallHalvings = 12;
/// Share of an edge within which a wall is said to pass through its end: no slivers of parts.
inline constexpr double kSnapToEnd = 1e-3;
/// Share of an edge within which two walls are one.
inline constexpr double kLeastGap = 1e-3;
/// Twice the area of a triangle below which it fills no gap, by its longest edge squared.
inline constexpr double kLeastWidth = 1e-6;
/// Normals are opposite where 1 and their cosine add up to less than this: of two opposite ones no turn is the
/// shortest.
inline constexpr double kOppositeNormals = 1e-6;

}  // namespace v0
}  // namespace incise
