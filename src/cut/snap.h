// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cut/neighbourhood.h"
#include "cut/sweep.h"
#include "incise/mesh/star.h"
#include "incise/mesh/transaction.h"

namespace incise::inline v0 {

/// A vertex that takes part in a cut, with its place on the sheet.
struct OnVertex {
  VertexId vertex;
  double spacing;          ///< mean length of its edges at rest
  double distance;         ///< to the sheet
  Vec3 target;             ///< nearest point of the sheet
  std::uint32_t triangle;  ///< that holds `target`
};

/// Chooses the vertices that take part in the cut themselves, instead of being split beside.
///
/// A vertex with a flagged edge is chosen where its distance to the sheet is at most `snap` times its mean edge length
/// (half of that where it cannot be moved onto the sheet), nearest first, unless (i) a tet would get four such
/// vertices, (ii) its flagged or unflagged neighbours are not connected in its link (two sheets pass near it, or a
/// bubble), or its star was not face-connected at load. Vertices within `kCoincident` are chosen regardless of (ii).
/// Marks them in `neighbourhood`. Source: snapping before splitting as in Labelle & Shewchuk 2007 and level-set
/// discretisation in Mmg; not in the paper, whose edge merging (§2.5) repairs afterwards what this avoids. Cost: one
/// star per vertex with a flagged edge.
std::vector<OnVertex> choose_on_vertices(const TetMesh& mesh, const Sheet& sheet, double snap,
                                         Neighbourhood& neighbourhood, StarWalker& walker);

/// Moves the chosen vertices onto the sheet where that keeps the body's shape: interior ones freely, those on a flat
/// part of a surface within it, those on a straight feature along it, others not at all (the wall then bends to them).
/// A move that would leave a tet of the star less than a quarter of its volume or flat, change the volume of the star,
/// or be longer than 1.5·snap·spacing, is refused. Returns how many vertices stay off the sheet.
std::uint64_t move_on_vertices(Transaction& transaction, const Sheet& sheet, double snap,
                               const std::vector<OnVertex>& chosen, StarWalker& walker);

}  // namespace incise::inline v0
