// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "app/view/picture.h"

namespace incise {
inline namespace v0 {
namespace render {

/// The triangles of what is solid in a picture: what lies around the body, then instruments, then those seen through.
class SolidRows {
 public:
  void gather(const app::Picture& picture);

  [[nodiscard]] const std::vector<app::SolidCorner>& corners() const { return corners_; }
  /// How many corners lie around the body; how many come before those that are seen through.
  [[nodiscard]] std::size_t ground() const { return ground_; }
  [[nodiscard]] std::size_t opaque() const { return opaque_; }

 private:
  std::vector<app::SolidCorner> corners_;
  std::size_t ground_ = 0, opaque_ = 0;
};

}  // namespace render
}  // namespace v0
}  // namespace incise
