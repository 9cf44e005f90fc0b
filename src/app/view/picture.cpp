// SPDX-License-Identifier: Apache-2.0
// Bounds in single precision, as positions are drawn: what is measured is what is seen.
#include "app/view/picture.h"

namespace incise {
inline namespace v0 {
namespace app {

Box bounds_of(const SurfaceFrame& frame) {
  constexpr float kMost = std::numeric_limits<float>::infinity();
  Eigen::Vector3f low = Eigen::Vector3f::Constant(kMost), high = Eigen::Vector3f::Constant(-kMost);
  for (const Eigen::Vector3f& p : frame.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return {low.cast<double>(), high.cast<double>()};
}

}  // namespace app
}  // namespace v0
}  // namespace incise
