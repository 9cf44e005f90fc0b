// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cut/subdivide.h"

namespace incise::inline v0 {

/// A piece smaller than this share of the cubed edge length is a crumb: debris of a blade that grazes a vertex.
inline constexpr double kCrumbShare = 0.02;

/// Takes the incision faces of crumbs out of `incision`, so that a crumb stays attached to the piece that it shares
/// its faces with. Where it touches two pieces it stays with one, and they come apart. Returns how many crumbs.
/// Cost: O(incision faces) plus a search of a few tets around each small tet beside one.
std::uint64_t keep_crumbs(const Transaction& transaction, const Neighbourhood& neighbourhood,
                          std::vector<IncisionFace>& incision);

}  // namespace incise::inline v0
