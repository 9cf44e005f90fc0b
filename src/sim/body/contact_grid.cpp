// SPDX-License-Identifier: Apache-2.0
// A counting sort of boxes by the cells that they meet, filled from behind so that each cell lists them in ascending
// order (docs/internals.md, 4).
#include "sim/body/contact_grid.h"

#include <algorithm>
#include <cmath>

#include "sim/body/constants.h"

namespace incise {
inline namespace v0 {
namespace detail {

std::array<std::uint32_t, 3> ContactGrid::cell_of(const Vec3& point) const {
  std::array<std::uint32_t, 3> cell;
  for (unsigned i = 0; i < 3; ++i) {
    const double along = (point.data()[i] - all_.lo.data()[i]) * per_length_;
    cell[i] = static_cast<std::uint32_t>(std::clamp(along, 0.0, cells_[i] - 1.0));
  }
  return cell;
}

template <class Visit>
void ContactGrid::for_each_cell(const Box& box, const Visit& visit) const {
  const auto from = cell_of(box.lo), to = cell_of(box.hi);
  for (std::uint32_t z = from[2]; z <= to[2]; ++z) {
    for (std::uint32_t y = from[1]; y <= to[1]; ++y) {
      for (std::uint32_t x = from[0]; x <= to[0]; ++x) visit(index(x, y, z));
    }
  }
}

void ContactGrid::build(std::span<const Box> boxes, double cell) {
  all_ = Box();
  for (const Box& box : boxes) all_.extend(box);
  first_.assign(2, 0);
  members_.clear();
  cells_ = {1, 1, 1};
  if (all_.is_empty() || !(cell > 0)) return;
  const Vec3 size = all_.hi - all_.lo;
  for (const double most = kCellsPerBox * static_cast<double>(boxes.size()) + 64;; cell *= 1.3) {
    double count = 1;
    for (unsigned i = 0; i < 3; ++i) count *= std::max(1.0, std::ceil(size.data()[i] / cell));
    if (count > most) continue;
    for (unsigned i = 0; i < 3; ++i) {
      cells_[i] = static_cast<std::uint32_t>(std::max(1.0, std::ceil(size.data()[i] / cell)));
    }
    break;
  }
  per_length_ = 1 / cell;
  first_.assign(index(0, 0, cells_[2]) + 1, 0);
  for (const Box& box : boxes) {
    if (!box.is_empty()) for_each_cell(box, [&](std::size_t at) { ++first_[at]; });
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& count : first_) sum += count, count = sum;  // where each cell ends
  members_.resize(sum);
  for (auto i = static_cast<std::uint32_t>(boxes.size()); i-- > 0;) {
    if (!boxes[i].is_empty()) for_each_cell(boxes[i], [&](std::size_t at) { members_[--first_[at]] = i; });
  }
}

std::span<const std::uint32_t> ContactGrid::near(const Vec3& point) const {
  if (members_.empty() || all_.distance2(point) > 0) return {};
  const auto cell = cell_of(point);
  const std::size_t at = index(cell[0], cell[1], cell[2]);
  return {members_.data() + first_[at], first_[at + 1] - first_[at]};
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
