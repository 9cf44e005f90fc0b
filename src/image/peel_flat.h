// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "image/labelled_tets.h"

namespace incise {
inline namespace v0 {
namespace image {

/// Takes tets away that lie flat on the skin, with two sides on it: they keep their corners from lying on it. Only
/// where the edge that then comes to the skin was inside, so that the skin stays a manifold, and where what is below
/// has the same label. The mesh has no background. Returns how many went. Cost: O(tets).
std::uint64_t peel_flat_tets(LabelledTets& mesh);

}  // namespace image
}  // namespace v0
}  // namespace incise
