// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "app/view/surface_view.h"

namespace incise {
inline namespace v0 {
namespace render {

/// The rims of a surface's wounds as stretches that know how the rim goes on at both of their ends.
class RimStrip {
 public:
  /// Points: before it, its two ends, after it. Where a rim ends, or more than two stretches meet, the point before or
  /// after it is its own end.
  using Stretch = std::array<std::uint32_t, 4>;

  /// Where the topology is another than the last one. None: null. Edges at points that there are not are left out.
  /// Cost: O(points + edges).
  void find(const std::shared_ptr<const app::SurfaceTopology>& topology);

  [[nodiscard]] const std::vector<Stretch>& stretches() const { return stretches_; }

 private:
  using Edge = std::array<std::uint32_t, 2>;

  void join(const Edge& edge);
  [[nodiscard]] std::uint32_t beyond(std::uint32_t end, std::uint32_t other) const;

  /// Of a point: how many stretches there are at it, and the sum of their other ends.
  struct Joint {
    std::uint32_t count = 0;
    std::uint64_t sum = 0;
  };

  std::shared_ptr<const app::SurfaceTopology> topology_;
  std::vector<Stretch> stretches_;
  std::vector<Joint> joints_;  // scratch: per point
};

}  // namespace render
}  // namespace v0
}  // namespace incise
