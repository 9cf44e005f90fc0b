// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {
namespace paper {

/// The plane with the least sum of squared distances from some points: it passes through their mean.
struct FittedPlane {
  Vec3 centre;  ///< the mean of the points
  Vec3 normal;  ///< of length 1; its sign says nothing. Any one of several where the points do not tell them apart.
};

/// Fits a plane to at least one point. Uses + − × ÷ √ alone: the axes of the scatter by Jacobi's rotations.
/// Cost: O(points), and about 0.3 µs. **Source:** Paper §3.4 ("a fit plane is calculated using least squares").
FittedPlane fit_plane(std::span<const Vec3> points);

}  // namespace paper
}  // namespace v0
}  // namespace incise
