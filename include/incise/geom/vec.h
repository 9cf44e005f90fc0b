// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace incise {
inline namespace v0 {

/// A point or a vector in space; unit: the mesh's length unit.
using Vec3 = Eigen::Vector3d;
/// A 3×3 matrix of doubles, by columns.
using Mat3 = Eigen::Matrix3d;

}  // namespace v0
}  // namespace incise
