// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "incise/geom/predicates.h"

namespace incise {
inline namespace v0 {

/// Finds whether two perturbed triangles cross: whether an edge of one passes through the other.
///
/// Exact, and never degenerate: triangles that only touch cross or do not, as their keys say, and every test on the
/// same points agrees. Triangles whose boxes are apart do not cross.
/// @param first, second  corners with six different keys: triangles that share a corner cannot be asked about.
/// Cost: three or six `orient3d_sos` where one triangle lies on one side of the other's plane, else up to 18.
/// **Source:** Edelsbrunner & Mücke 1990 (perturbation).
bool triangles_cross(const std::array<SosPoint, 3>& first, const std::array<SosPoint, 3>& second);

/// Whether two triangles that share a corner cross besides: the side of one that is opposite to it passes through the
/// other. Exact, and never degenerate, as above.
/// @param first, second  the corner that both have comes first; the other four keys differ.
/// Cost: two `segment_crosses_triangle`.
bool triangles_cross_besides(const std::array<SosPoint, 3>& first, const std::array<SosPoint, 3>& second);

}  // namespace v0
}  // namespace incise
