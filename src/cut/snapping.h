// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "cut/closed_complex.h"
#include "cut/strip.h"
#include "incise/mesh/transaction.h"

namespace incise {
inline namespace v0 {

/// A vertex that takes part in a cut, with its place on the sheet.
struct OnVertex {
  VertexId vertex;
  double spacing = 0;          ///< mean length of its edges at rest
  double distance = 0;         ///< to the sheet
  Vec3 target = Vec3::Zero();  ///< nearest point of the sheet
  Vec3 normal = Vec3::Zero();  ///< of the sheet there
  std::uint32_t master = 0;    ///< one that has the vertex
};

/// How far vertices snap.
struct SnapRules {
  double snap = 0.2;     ///< reach, as a share of the mean length of a vertex's edges
  double spacing = 0.0;  ///< the length of a typical edge of the mesh
  /// Where set, vertices that do not coincide with the sheet are chosen only if what some masters are divided into
  /// hangs together: those around the vertex.
  std::function<bool(std::span<const std::uint32_t>)> hangs_together;
};

/// Memory that snapping keeps between the steps of a stroke.
struct SnapScratch {
  ZeroedArray<std::uint32_t> index_of_vertex;  ///< all zero between steps
  std::vector<VertexId> coincident;            ///< with the sheet, ascending
};

/// Chooses the vertices that take part in the cut themselves, instead of being split beside, among those of `masters`.
///
/// A vertex with a flagged edge, around which the blade has passed (no face of its star is pierced by the border of
/// the sheet), is chosen where its distance to the sheet is at most `snap` times its mean edge length (half of that
/// where it is of skin alone and cannot be moved onto the sheet), nearest first, unless (i) a tet would get four such
/// vertices, (ii) its flagged or unflagged neighbours are not connected in its link (two sheets pass near it, or a
/// bubble), be it without all that are close or without those chosen already, or its star was not face-connected at
/// load. Vertices within `kCoincident` are chosen regardless of (ii); at once where skin or a wall lies along the
/// sheet, and where `snap` is 0. Vertices of an older wall that runs along the sheet within `snap` are the cut already:
/// they are chosen at once and regardless of (i) and (ii), so that no tet comes between. In a wound whose two sides
/// have come apart (`hangs_together`) none is chosen any more: what lies between a vertex and the sheet would go over
/// from one piece to the other. Marks them in the complex. Source: snapping before splitting as in Labelle & Shewchuk
/// 2007 and level-set discretisation in Mmg; not in the paper, whose edge merging (§2.5) repairs afterwards what this
/// avoids. Cost: one star per vertex close to the sheet.
std::vector<OnVertex> choose_on_vertices(const TetMesh& mesh, const OwnSheet& sheet, const SnapRules& rules,
                                         std::span<const std::uint32_t> masters, ClosedComplex& complex,
                                         SnapScratch& scratch);

/// Moves the chosen vertices onto the sheet, their copies with them, while the body keeps its shape: interior ones
/// freely, those on a flat part of a surface within it, those on a straight feature along it, others not at all (the
/// wall then bends to them). A move that would leave a tet of the star less than a quarter of its volume or flat,
/// change the volume of the star, or be longer than 1.5·snap·spacing, is refused. Only once the blade has gone: edges
/// around a vertex that has moved cannot be told on which side of earlier strips they are. Returns how many stay off
/// the sheet.
std::uint64_t move_on_vertices(Transaction& transaction, const OwnSheet& sheet, double snap,
                               const std::vector<OnVertex>& chosen, ClosedComplex& complex);

}  // namespace v0
}  // namespace incise
