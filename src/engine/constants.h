// SPDX-License-Identifier: Apache-2.0
// The constants of the engine and of what hands hold in a simulation, with what each is measured in and what goes wrong
// where it is changed. Where no source is named a value was chosen by hand. A spacing is the mean edge at load.
#pragma once

#include <cstddef>

namespace incise {
inline namespace v0 {
namespace detail {

/// So many strokes can be gone on from after undo: each keeps its band and what it swept.
inline constexpr std::size_t kKeptContinuations = 16;

// --- tissue that bears an edge (`blade_coupling`): in spacings, where nothing else is said

/// By how much a spring is pressed where the tissue yields.
inline constexpr double kGiveAt = 0.1;
/// Radius of the zone in which tissue bears the edge, at least: some vertices.
inline constexpr double kNarrowestZone = 1;
/// At most, by the body's least extent, and in spacings: more vertices would only cost more.
inline constexpr double kWidestZone = 0.25, kMostZoneReach = 3;
/// The share of what it bears at which tissue yields: vertices on the rim of a zone need not all be at theirs.
inline constexpr double kYieldsAt = 0.95;
/// How far ahead of the front the edge has hold of the tissue.
inline constexpr double kHoldsAhead = 0.05;
/// How far behind the front an edge is told to be that does not yield.
inline constexpr double kToldBehind = 0.25;
/// How far along the edge a point keeps its material (docs/decisions/0047).
inline constexpr double kSlides = 0.5;
/// Between points of the edge, which are so many at most.
inline constexpr double kEdgeSpan = 0.5;
inline constexpr std::size_t kMostEdgePoints = 64;
/// A blade no wider than this is a point.
inline constexpr double kPointWidth = 1e-3;
/// Withdrawn by this, the blade has let go of the tissue.
inline constexpr double kWithdrawn = 0.5;
/// What tissue along the edge may be pressed together by, a factor: more is a ragged front.
inline constexpr double kMostBulge = 1.25;
/// Points to both sides by which the direction of the edge is told.
inline constexpr std::size_t kTangentSpan = 3;
/// Steps in which the way ahead of a front is looked at.
inline constexpr unsigned kStepsAhead = 16;
/// Halvings of a way, to find a place on it.
inline constexpr unsigned kPlaceHalvings = 10;
/// Tets that are looked at for material that has come into another one.
inline constexpr std::size_t kMostSearchedTets = 200;

// --- what hooks and sutures take hold of

/// The share by which jaws close or open in a frame at most: tissue is gathered, not struck.
inline constexpr double kJawsPerFrame = 1.0 / 32;
/// Skin that is no further than the nearest triangle by this share of the radius is taken.
inline constexpr double kSkinFirst = 1e-3;
/// As far outside of the tissue an end of a suture may be, in spacings.
inline constexpr double kSutureReach = 0.25;

}  // namespace detail
}  // namespace v0
}  // namespace incise
