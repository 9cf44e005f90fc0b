// SPDX-License-Identifier: Apache-2.0
// The constants of maintenance, with what each is a share of, and what goes wrong where it is changed. Where no source
// is named a value was chosen by hand, and changing it changes hashes. Documents cite names.
#pragma once

#include <cstddef>
#include <cstdint>

#include "improve/inradius_ratio.h"

namespace incise {
inline namespace v0 {

// --- which tets are worked on: shares of the quality of the regular tet, 1 the best

/// Tets at the cut with an L/r of more than 11 are worked on, in trials too. A better goal costs more work per step and
/// gains less; a worse one leaves more tets that are slow to simulate.
inline constexpr double kGoal = kRegularLr / 11.0;
/// Tets with an L/r above 18 are bad: they come first, those beside the cut are worked on too, and surfaces may give
/// way more to mend them. To this L/r thinning out may cost shape where a cut goes on from an older one: there all is
/// in good shape already, and nothing would be thinned out at all.
inline constexpr double kBadQuality = kRegularLr / 18.0;
/// Tets with an L/r above 22 that no single operation mends are split for trial. More tets take more work in vain.
inline constexpr double kTried = kRegularLr / 22.0;
/// Tets with an L/r above 24.5 are tried harder: their trials split more edges, and merge vertices, for which walls may
/// bend. A better one costs vertices for tets that are good enough.
inline constexpr double kTriedHard = kRegularLr / 24.5;

// --- what an operation must gain, as a share of the worst quality before it

/// An operation is accepted where the worst tet after it is better by more than this: less, and rounding decides, and
/// two operations may undo each other for ever.
inline constexpr double kLeastGain = 1e-3;
/// A move of a vertex: smaller gains cost more than they are worth.
inline constexpr double kLeastSmoothingGain = 0.03;
/// A trial: all that it has touched must be better than the tet was.
inline constexpr double kLeastTrialGain = 0.1;
/// A vertex put in makes the mesh larger for good. Less, and meshes grow under maintenance.
inline constexpr double kLeastInsertionGain = 0.25;
/// No operation may leave a tet of less quality than this, of the regular tet's: what rounding could take for positive.
inline constexpr double kLeastRatio = 1e-9;

// --- how far surfaces may leave their place, as shares of the local edge: more, and skin and walls drift visibly over
// many cuts; less, and bad tets at surfaces stay bad

/// Skin, in one operation; by the greater one where a bad tet is mended.
inline constexpr double kFineTolerance = 0.01, kCoarseTolerance = 0.04;
/// Skin from where it was before all, however often it is maintained; more where seams are thinned out. To mend bad
/// tets it may by the last share of the edges that it had.
inline constexpr double kSkinTolerance = 0.01, kSeamSkinTolerance = 0.015, kBadSkinTolerance = 0.019;
/// To mend bad tets walls and skin may leave their place by this share of the edges that the body came with, however
/// short cuts have made those that stand there now.
inline constexpr double kOriginalTolerance = 0.03;
/// Walls, fronts and rims of skin where tets are tried harder: as far as snapping bends a wall. It is a share of
/// the edges that the body came with, as is the next one.
inline constexpr double kBentWall = 0.1;
/// A vertex that gives back volume that a merge for trial took.
inline constexpr double kReturn = 0.03;
/// Cut walls from the sweep of their stroke.
inline constexpr double kWallTolerance = 0.012;
/// However coarse a wall is.
inline constexpr double kGreatestTolerance = 2.25 * kWallTolerance;
/// What a piece of wall may go beyond where it was, as a share of the tolerance.
inline constexpr double kSlack = 0.3;
/// Distance in tolerances within which original vertices count as a piece's own.
inline constexpr double kOwn = 3.0;
/// Distance in tolerances to which pieces that lie further off are held.
inline constexpr double kFarthest = 8.0;
/// Where the cut ends there is no reference for the front: it may move by this share of the mean edge.
inline constexpr double kFrontReach = 0.06;
/// The step that restores the volume behind a collapse, as a share of the longest edge of the vertex, or of the mean
/// edge around a short edge that is merged.
inline constexpr double kGreatestStep = 0.05;

// --- how fresh walls are measured

/// Facets of a fresh wall that are measured at most, and shares that are kept. More take time, and tell no more.
inline constexpr std::size_t kMostSamples = 200, kMostShares = 1000;
/// The share of them that counts as typical.
inline constexpr double kTypicalShare = 0.9;
/// By this share of them chords are told from bends: in a plane nothing lies off it that has not bent. Slack is a
/// factor, the greatest chord a share of the local edge.
inline constexpr double kChordShare = 0.25, kChordSlack = 6.0, kGreatestChord = 0.07;

// --- what is one surface: cosines and sines of angles between unit normals; what is one plane, `kOnePlane` of geom
// says

/// Faces whose normals have at least this cosine with the first of a surface are part of it: 75 degrees.
inline constexpr double kSmoothCosine = 0.26;
/// Walls of different strokes whose normals have at least this cosine go on from each other: 20 degrees. Where they
/// cross at a larger angle there is a crease, to be kept.
inline constexpr double kSeamCosine = 0.94;
/// Two surfaces that meet at less than this sine have no line to slide along: 10 degrees.
inline constexpr double kLeastSine = 0.17;
/// A vertex at a front slides along it, not across: what keeps the volume must turn it from there by no more than this
/// cosine tells, 2.5 degrees.
inline constexpr double kAlongFront = 0.999;
/// New faces turn away from their surface by less than the angle with this cosine: 60 degrees. Less, and surfaces fold.
inline constexpr double kFaceCosine = 0.5;

// --- which edges are merged

/// Edges of a tet that are tried, shortest first.
inline constexpr std::size_t kEdgesTried = 3;
/// Tets around an edge that is removed, at most: rings up to so many cost 0.5 µs per edge.
inline constexpr unsigned kMostRing = 8;
/// Neighbours of a vertex that thinning out tries, nearest first.
inline constexpr std::size_t kNeighboursTried = 8;
/// No new edge is longer than the longest of the vertex by more than this factor: else the mesh coarsens without end.
inline constexpr double kLengthCap = 1.5;
/// What a lip may lose to the other at a front: six times the volume, as a share of the longest edge cubed. Rounding.
inline constexpr double kFrontVolume = 1e-12;
/// Edges of at most this share of the mean edge around them are short.
inline constexpr double kShort = 0.15;
/// A facet whose height is below this share of the mean edge may turn as it likes: it has no direction to speak of.
inline constexpr double kLeastHeight = 0.05;
/// A loss of volume below this share of the mean edge cubed is rounding.
inline constexpr double kNoVolume = 1e-13;
/// Vector areas shorter than this share of what they are the sum of give no way to restore the volume.
inline constexpr double kLeastArea = 0.05;

// --- how a vertex is moved or put in

/// Newton steps per move; further ones gain little.
inline constexpr unsigned kMaxSteps = 5;
/// A step is halved so often before it is given up.
inline constexpr unsigned kMaxHalvings = 5;
/// A step that would take a curved surface too far from its place is halved so often.
inline constexpr unsigned kShortenings = 3;
/// A step that gains less than this share of the energy is the last.
inline constexpr double kLeastDescent = 1e-2;
/// The most tets of a cavity that a new vertex fills, and Newton steps for its place.
inline constexpr std::size_t kMostTets = 16;
inline constexpr unsigned kNewtonSteps = 6;

// --- how much work

/// The trials of a tet: merges along its six edges, both ways, and splits of them.
inline constexpr unsigned kMergeTrials = 12, kTrials = 18;
/// A tet with a vertex that so many trials in turn led to is left as it is: nothing may be refined for ever.
inline constexpr unsigned kMostSplits = 4;
/// So many edges are split in one trial, for a tet that is tried harder and for others. Around an edge that is short
/// for good all that lead away from it must be.
inline constexpr unsigned kSplits = 8, kFewSplits = 2;
/// Units of work after which a trial ends, 3 ms.
inline constexpr std::uint64_t kMostWork = 30'000;
/// Trials may take this share of the work that all else took, and so many units besides, 40 ms: where a body was bad
/// before it was cut, few of them help.
inline constexpr double kTrialShare = 0.5;
inline constexpr std::uint64_t kTrialWork = 400'000;
/// Vertices that cuts made are tried so often: a merge makes room for others.
inline constexpr unsigned kThinningRounds = 3;
/// The end of an older cut is dense so many rings of vertices behind the seam.
inline constexpr unsigned kSeamRings = 4;
/// Changes per journal step: what they free is used again from the next one on.
inline constexpr std::uint64_t kChangesPerStep = 4096;

// --- how the sizes of the body's elements are found again

/// Cells that sizes are averaged over are at least so many edges wide: less, and places between vertices have none;
/// more, and the sizes of a graded mesh are smeared.
inline constexpr double kSizeCell = 4.0;
/// A vertex counts in cells of so many levels, each twice as wide as the one before: for places in cells without a
/// vertex.
inline constexpr int kSizeLevels = 3;
/// Cells are counted from the origin by whole numbers of so many bits.
inline constexpr int kMostBits = 52;

}  // namespace v0
}  // namespace incise
