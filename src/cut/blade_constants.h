// SPDX-License-Identifier: Apache-2.0
// The constants of the way that a blade takes, with what each is measured in and what goes wrong where it is changed;
// those of cutting the mesh are in constants.h. Where no source is named a value was chosen by hand, and changing it
// changes hashes. A spacing is the mean edge of the mesh before it was cut. Documents cite names.
#pragma once

#include <array>
#include <cstddef>

namespace incise {
inline namespace v0 {

// --- the surface that a blade sweeps (`sweep`, `twist`, `border_reach`)

/// A blade whose stroke is known to its end is in its own slit within this many spacings of what it swept before.
inline constexpr double kOwnSlit = 0.02;
/// What a blade sweeps while it turns is made of triangles that lie within so many spacings of it.
inline constexpr double kTwist = 0.1;
/// A segment of a blade that turns is made of so many parts at most, or each side of the point that it turns about.
inline constexpr double kMostTwistParts = 64;
/// The point that a segment turns about moves less than this share of what its ends do.
inline constexpr double kPivotShare = 0.5;
/// One that moves by less than this share of the tolerance does so by rounding alone.
inline constexpr double kHolds = 1e-8;
/// A blade turns sharply where the cosine of the angle between two of its moves is below this: by more than 45°.
inline constexpr double kSharpTurn = 0.70710678118654752440;
/// A triangle that is thinner than this share of its length has no normal of its own: it closes a seam.
inline constexpr double kSeamShare = 1e-9;
/// Whether one triangle laps over another is asked at places that lie this share of the way inside it: one that ends
/// where the other begins does not.
inline constexpr double kLapInset = 0.05;
/// A border is asked about at places so many spacings apart, but at so many at most.
inline constexpr double kBorderSample = 0.2, kMostReachSamples = 4096.0;

// --- strips that the blade lays step by step (`blade_motion`, `front_course`)

/// A blade within this many spacings of what it swept before, step by step, is in its own slit (docs/decisions/0110).
inline constexpr double kSlitShare = 0.25;
/// It is asked for at the end of its way, which decides most often, then at places half as far apart; at so many at
/// most.
inline constexpr double kMostSlitSamples = 256;
/// Points of a blade that moved less than this many spacings wait for more (docs/decisions/0110).
inline constexpr double kLeastBladeStep = 0.05;
/// Those that moved less than this many spacings, as the point does that an edge turns about, have not moved.
inline constexpr double kStandsStill = 1e-9;
/// A blade within so many spacings of what it has swept waits until it gets on: folds that are finer enclose vertices
/// (docs/decisions/0120).
inline constexpr double kWaitsNearSlit = 1.0;
/// One that comes to what it has swept from so many spacings away closes a ring (docs/decisions/0150).
inline constexpr double kLeavesFor = 0.4;
/// It comes by its front if it has left its slit within so many spacings of it (docs/decisions/0120).
inline constexpr double kByFront = 0.75;
/// It gets on if so much of its way, a share, is along the way that its front has come.
inline constexpr double kGetsOn = 0.7;
/// The direction in which a front has come is that of its last so many spacings of travel, or of material in a body
/// that moves; at rest it is known from half of that on (docs/decisions/0120, 0125).
inline constexpr double kComeLength = 0.5;
/// Within so many spacings of travel behind the front a sheet does not count as meeting itself (docs/decisions/0144).
inline constexpr double kFrontShare = 1.5;
/// A sheet lays so many spacings of the one before it, of the same stroke, once more at least. Where the blade has
/// turned sharply both legs pass within an element of each other, and the wall ends an element before the turn
/// (docs/decisions/0144).
inline constexpr double kLaidAgain = 1.0;
/// One that starts in the slit reaches through its wall by so many spacings (docs/decisions/0144).
inline constexpr double kThroughSlit = 0.3;
/// The end of a blade draws back by less than this share of its last segment.
inline constexpr double kMostRetreat = 0.5;
/// Older walls are looked for along the blade at places so many spacings apart, but at so many at most.
inline constexpr double kWallShare = 0.5, kMostWallPlaces = 1024;
/// Strips that fold back onto earlier ones within so many spacings meet them.
inline constexpr double kMeetingShare = 1e-6;

// --- where a stroke begins, ends and meets older cuts (`cutter`)

/// Two crossings of one edge at rest, in different steps, that are further apart than this share of it are two passes
/// of the blade.
inline constexpr double kPassesApart = 0.05;
/// A border of the sheet that lies at most so many spacings beyond the rim of an older cut reaches on into it
/// (docs/decisions/0022). A gap that small is closed, whoever left it.
inline constexpr double kWeld = 0.08;
/// It reaches on so many spacings along that cut: further than fronts lie off their blades; or through its wall, where
/// it meets that at an angle.
inline constexpr double kReachOn = 0.3, kReachThrough = 0.12;
/// A wall that it comes to at an angle may be so many spacings away: tissue that thin is of no use beside a cut.
inline constexpr double kWeldThrough = 0.11;
/// The end of a blade that passes an older wall by less than `kWeld` stays so many spacings before it.
inline constexpr double kBeforeWall = 0.02;
/// It draws back from walls that it meets at an angle of this sine at least: those along its way are crooked.
inline constexpr double kSteepSine = 0.4;
/// All of this way lies in the older cut or outside the body: asked at these shares of it, the furthest first.
inline constexpr std::array kReachSamples = {1.0, 0.5, 0.1, 0.25, 0.75};
/// What lies at most so many spacings beyond the rim of an older cut lies in it: rounding, no more.
inline constexpr double kInsideOlder = 0.02;
/// A stroke that goes on from an older front by less than so many spacings takes that front along
/// (docs/decisions/0029).
inline constexpr double kCarry = 0.3;
/// The blade starts at an older front where that ends so many spacings behind it at most; and has taken it along where
/// none of it is left further behind than that. For the second, one of seven rows of the table of ways to compose fails
/// with 0.1, and another one with 0.15 (docs/decisions/0029).
inline constexpr double kAtFront = 0.2, kLag = 0.12;
/// Where a front cannot follow it is drawn back by so many spacings, and cut from there: nothing that is cut anew is
/// shorter.
inline constexpr double kDrawBack = 0.8;
/// Whether a blade starts at an older front is asked at places so many spacings apart, but at so many at most.
inline constexpr double kStartShare = 0.2, kMostStarts = 1024.0;
/// A stroke goes on from one whose blade stood within so many spacings from where it starts, at rest and in a body that
/// has moved: there the tissue tells where that blade would be (docs/decisions/0030).
inline constexpr double kStandsWithin = 0.05;
/// A blade that cannot go on yet waits while it is no more spacings from there (docs/decisions/0169). Longer steps have
/// passed the wall, or there is nothing that it could get through to.
inline constexpr double kMostWait = 1.0;

// --- fronts that are taken along (`front_carry`)

/// A front lies within so many spacings of the sheet across it, and so far behind the row that goes on from it.
inline constexpr double kCarryBeside = 0.1, kCarryBehind = 0.3;
/// Tets around a vertex that moves may get as bad as this L/r.
inline constexpr double kWorstLr = 25.0;
/// A star keeps its volume but for this share, rounding.
inline constexpr double kCarriedVolume = 1e-12;
/// To that end a vertex gives way by this share of its way at most.
inline constexpr double kMostAcross = 0.2;
/// A blade that meets the skin at a smaller sine runs along it; skin is flat where its sides' sum has this share of
/// their areas.
inline constexpr double kLeastSlope = 0.1, kFlatSkin = 0.99;
/// Vertices whose neighbours have moved are tried again so often.
inline constexpr unsigned kCarryRounds = 6;
/// A vertex this close to the blade is there, in spacings.
inline constexpr double kCarriedThere = 1e-4;

// --- a blade in a body that moves, as the pipeline sees it (`cutter`)

/// A step of a blade in a moving body is taken in parts of an element, or of the body's size over this where elements
/// are smaller: at most so many.
inline constexpr double kMostStepParts = 64;
/// A blade that comes from far away is near the body within so many of its diagonals.
inline constexpr double kNearBody = 0.1;
/// A blade this many spacings ahead of the crack's tip cuts on even where that closes the cut behind it: else strong
/// shaking would hold it for ever (docs/decisions/0017).
inline constexpr double kGiveWay = 0.75;
/// One that would come back to what it has left is on another way only if it is so many spacings ahead: less, and each
/// tremor makes a sheet of its own (docs/decisions/0024).
inline constexpr double kTurnBack = 2.0;
/// Front points of a moving body stay while the blade pierces their face within so many spacings.
inline constexpr double kPointReach = 0.2;

// --- the blade in the material (`material_blade`)

/// Points of the blade stand at most so many spacings apart (docs/decisions/0017).
inline constexpr double kPointSpacing = 0.25;
/// The way that the front has come is the mean over so many points to either side: a spacing (docs/decisions/0125).
inline constexpr std::size_t kNearPoints = 4;
/// Segments of more parts than this are dense only near the body, if they leave its surroundings: so many of its
/// diagonals.
inline constexpr double kManyParts = 256, kSurroundings = 1.0;
/// Segments within the surroundings have at most so many parts.
inline constexpr double kMostBladeParts = 4096;
/// The front follows in steps of so many spacings of material; once the blade goes no further, of so many.
inline constexpr double kLeastMaterialStep = 0.1, kLeastLastStep = 1e-3;
/// A blade cuts on where it is ahead of the tip by this share of how far it is beside it.
inline constexpr double kCone = 0.5;
/// A blade that has left the body cuts on to where it is once it is so many spacings ahead (docs/decisions/0017).
inline constexpr double kExitLead = 0.3;
/// What the map of a tet says of a place outside it counts within so many spacings of what is expected.
inline constexpr double kTrust = 1.0;
/// A place so many spacings from the wall of a cut lies in it: in the plane of a wall, rounding decides what is inside
/// (docs/decisions/0028).
inline constexpr double kInCut = 0.02;
/// Material stretches by no more than this factor between the tip and the blade: what is found further on is in another
/// part of the body (docs/decisions/0017).
inline constexpr double kGreatestStretch = 1.5;
/// A point that is so many spacings from the tet that it left the body by goes with its neighbours, as before it
/// entered: what that tet says of its place counts no more.
inline constexpr double kAwayFromExit = 1.0;
/// A point that has left the body goes on by at most so many spacings to be outside of it at rest, too.
inline constexpr double kFurtherOut = 1.5;
/// Points outside stay so many spacings off the surface at least. Those that are off by so many from where it has them
/// are drawn there, by so many a step: less would only make the strip uneven.
inline constexpr double kOffSurface = 0.02, kDrawnFrom = 0.3, kDrawnBy = 0.1;
/// A walk from tet to tet gives up after so many.
inline constexpr unsigned kMostWalkedTets = 256;
/// A point that is outside while its front is in the way of the body waits until it is so many spacings on: longer, and
/// it would leave a thread of tissue behind (docs/decisions/0028).
inline constexpr double kWaitsOutside = 1.0;
/// The nearest surface is looked for within so many spacings.
inline constexpr double kSurfaceReach = 32.0;
/// Rounds of drawing nearer to the tet that a point belongs to.
inline constexpr unsigned kMostNearingRounds = 6;

// --- a blade far away (`far_blade`)

/// Beyond the box parts are longer by this share of their distance from it.
inline constexpr double kFarGrowth = 0.5;
/// Halvings from a million bodies down to a box, of the three sides of a triangle in turn.
inline constexpr unsigned kMostBoxHalvings = 64;
/// A step is halved at most so often, and has at most so many parts: a blade that slides through the body lengthwise
/// by many of its sizes goes in longer ones.
inline constexpr unsigned kMostDivisions = 40;
inline constexpr std::size_t kMostFarParts = 256;

// --- a blade that regions stop (`region_guard`): all but the last four in mean edges of the regions' surface

/// The margin that the edge keeps: more than snapping (0.2), which would take the surface into the cut
/// (docs/decisions/0058).
inline constexpr double kGuardMargin = 0.4;
/// Between points of the edge.
inline constexpr double kGuardPoints = 0.5;
/// Between places where the edge is looked at.
inline constexpr double kGuardSample = 0.15;
/// Between poses: no region is passed through, nor swept between two of them.
inline constexpr double kGuardRow = 0.125;
/// So much of the surface beside the blade's way is looked at.
inline constexpr double kGuardAround = 3;
/// The share of the edge that must be left from one pose to the next: else it lies flat on the region.
inline constexpr double kLeastLeft = 0.5;
/// Halvings to find where the edge would enter.
inline constexpr int kGuardHalvings = 10;
/// Points of the edge at most, and poses of a step.
inline constexpr std::size_t kMostGuardPoints = 512;
inline constexpr double kMostGuardRows = 10000;

}  // namespace v0
}  // namespace incise
