// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cut/surface_index.h"
#include "incise/cut/stroke.h"
#include "incise/mesh/transaction.h"

namespace incise {
inline namespace v0 {

/// Opens what the sheets of one stroke left joined where they meet.
///
/// Each sheet has a front of its own, some share of an element off its blade. Where one begins beside the end of
/// another, a few faces may stay joined between the two fronts, though the blade has passed there. Around each place of
/// `joints` the sides of the cut are looked for in the rest shape: what hangs together without the faces that lie on
/// the sweep and are closed off by the surface all around. Where there are two, the faces between them are opened, as
/// walls of `tag`. Crumbs stay with the side that they share the largest face with. Where the cut ends nearby, the
/// sides hang together, and nothing is opened. `surface` must be up to date. `swept`: what the stroke has swept;
/// `joints`: the parts of it where sheets meet, flat triangles for lines; both in the rest shape, length units.
/// `spacing`: the length of a typical edge, above 0. Cost: O(walls in the box of the joints + tets within 2.5 spacings
/// of them). Source: docs/decisions/0145.
/// @return the sides that were opened, both of each face.
std::vector<Side> cut_bridges(Transaction& transaction, const SurfaceIndex& surface, const SweptTriangles& swept,
                              const SweptTriangles& joints, double spacing, std::uint32_t tag);

}  // namespace v0
}  // namespace incise
