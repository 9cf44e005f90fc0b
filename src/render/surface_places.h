// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "app/view/surface_view.h"

namespace incise {
inline namespace v0 {
namespace render {

/// What patterns of tissue stick to: for each point of a surface its place in the rest shape and its depth below the
/// skin, both in extents of the body at rest.
class SurfacePlaces {
 public:
  /// A surface without a rest shape is at rest as it is first seen. Cost: O(points).
  void find(const app::SurfaceFrame& frame);

  [[nodiscard]] const std::vector<Eigen::Vector4f>& of_points() const { return places_; }
  /// The diagonal of the rest shape's box, length units; 1 where there is none.
  [[nodiscard]] float extent() const { return extent_; }

 private:
  std::vector<Eigen::Vector4f> places_;
  float extent_ = 1;
};

}  // namespace render
}  // namespace v0
}  // namespace incise
