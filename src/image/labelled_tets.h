// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "image/label_volume.h"
#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {
namespace image {

inline constexpr std::uint32_t kNoTet = 0xFFFFFFFFU;

/// Tets under way: a label for each, background included until `drop_background`.
struct LabelledTets {
  using Corners = std::array<std::uint32_t, 4>;
  std::vector<Vec3> points;
  std::vector<Corners> tets;
  std::vector<LabelIndex> labels;

  /// Removes tets of the background, then points that no tet uses.
  void drop_background();
};

/// For each tet the tets behind its sides (that opposite a corner at the corner's place), `kNoTet` where there is none.
[[nodiscard]] std::vector<std::array<std::uint32_t, 4>> find_neighbours(const LabelledTets& mesh);

/// The tets around each point.
class Stars {
 public:
  explicit Stars(const LabelledTets& mesh);
  [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t point) const {
    return {tets_.data() + first_[point], first_[point + 1] - first_[point]};
  }
  [[nodiscard]] std::size_t size() const { return first_.size() - 1; }

 private:
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> tets_;
};

}  // namespace image
}  // namespace v0
}  // namespace incise
