// SPDX-License-Identifier: Apache-2.0
// Opaque bodies beside the tissue, as lit triangles: instruments, cloths.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {
namespace app {

/// What a solid is made of.
struct Finish {
  std::array<std::uint8_t, 4> color{200, 205, 212, 255};  ///< sRGB; an opacity below 255 lets what is behind be seen
  float gloss = 0;                                        ///< 0: cloth; 1: polished steel
};

/// A corner of a triangle: three of them stand together, counter-clockwise seen from outside.
struct SolidCorner {
  Eigen::Vector3f at, normal;  ///< the normal is unit
  Finish finish;
};

/// One place of a bar that is drawn along a way: how wide it is to both sides there.
struct BarSection {
  Vec3 at = Vec3::Zero();
  double wide = 0;   ///< half of the width along `side` of the bar
  double thick = 0;  ///< likewise across it
};

/// Adds a bar through some places, closed at both ends.
///
/// @param way      at least two places, apart from their neighbours.
/// @param side     that the width is measured along; not along the way.
/// @param corners  of its section, at least 3: 4 is a flat bar with edges, more a smooth tube.
void add_bar(std::span<const BarSection> way, const Vec3& side, int corners, const Finish& finish,
             std::vector<SolidCorner>& out);

/// Adds a plate: a flat outline that is star-shaped around its mean, `thickness` thick to both sides together.
/// @param along, across  unit, at right angles: what the outline's two coordinates go along.
void add_plate(std::span<const Eigen::Vector2d> outline, const Vec3& origin, const Vec3& along, const Vec3& across,
               double thickness, const Finish& finish, std::vector<SolidCorner>& out);

}  // namespace app
}  // namespace v0
}  // namespace incise
