// SPDX-License-Identifier: Apache-2.0
// Places are divided by the extent of the body at rest, so that patterns have the same size on every body.
#include "render/surface_places.h"

#include <Eigen/Geometry>
#include <cstddef>

namespace incise {
inline namespace v0 {
namespace render {

void SurfacePlaces::find(const app::SurfaceFrame& frame) {
  const app::SurfaceTopology& topology = *frame.topology;
  const std::size_t points = frame.positions.size();
  const std::vector<Eigen::Vector3f>& rest = topology.rest.size() == points ? topology.rest : frame.positions;
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& at : rest) box.extend(at);
  extent_ = box.isEmpty() || !(box.diagonal().norm() > 0) ? 1.0F : box.diagonal().norm();
  places_.resize(points);
  for (std::size_t i = 0; i < points; ++i) {
    const float depth = topology.depths.size() == points ? topology.depths[i] : 0.0F;
    places_[i] << rest[i] / extent_, depth / extent_;
  }
}

}  // namespace render
}  // namespace v0
}  // namespace incise
