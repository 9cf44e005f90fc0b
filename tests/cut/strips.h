// SPDX-License-Identifier: Apache-2.0
// Sheets of random blades, strip by strip.
#pragma once

#include <memory>
#include <set>

#include "cut/strip.h"
#include "support/random_strokes.h"

namespace incise::test {

using Row = std::vector<Vec3>;
using Rows = std::vector<Row>;
using SegmentKeys = std::array<std::uint64_t, 2>;

inline SegmentKeys keys_of(const SosPoint& a, const SosPoint& b) {
  return {std::min(a.key, b.key), std::max(a.key, b.key)};
}

inline std::set<SegmentKeys> keys_of(const std::vector<Strip::Segment>& segments) {
  std::set<SegmentKeys> keys;
  for (const Strip::Segment& s : segments) keys.insert(keys_of(s[0], s[1]));
  return keys;
}

/// A point of a blade, numbered by row and column.
inline SosPoint point_of(const Rows& rows, std::size_t row, std::size_t column) {
  return {rows[row][column], kFirstBladeKey + row * rows[0].size() + column};
}

/// What the blade sweeps from one row to a later one.
inline SweptSurface surface_between(const Rows& rows, std::size_t from, std::size_t to) {
  SweptSurface surface;
  const auto columns = static_cast<std::uint32_t>(rows[0].size());
  for (std::size_t r = from; r <= to; ++r) {
    for (std::size_t c = 0; c < columns; ++c) surface.points.push_back(point_of(rows, r, c));
  }
  for (std::uint32_t r = 0; r + from < to; ++r) {
    for (std::uint32_t c = 0; c + 1 < columns; ++c) {
      const std::uint32_t a = r * columns + c, d = a + columns;
      surface.triangles.push_back({{a, a + 1, d + 1}, r, c});
      surface.triangles.push_back({{a, d + 1, d}, r, c});
    }
  }
  return surface;
}

/// The strip that ends at a row; all but the first share a front with the one before.
inline std::unique_ptr<Strip> strip_to(const Rows& rows, std::size_t row) {
  std::vector<SegmentKeys> inner;
  for (std::size_t c = 0; row > 1 && c + 1 < rows[0].size(); ++c) {
    inner.push_back(keys_of(point_of(rows, row - 1, c), point_of(rows, row - 1, c + 1)));
  }
  return std::make_unique<Strip>(surface_between(rows, row - 1, row), inner);
}

/// All strips as one.
inline std::unique_ptr<Strip> strip_of_all(const Rows& rows) {
  return std::make_unique<Strip>(surface_between(rows, 0, rows.size() - 1), std::vector<SegmentKeys>());
}

/// A wavy sheet `size` wide somewhere around the unit cube.
inline Rows random_rows(Random& random, std::size_t rows, std::size_t columns, double size) {
  const Placement placement(random, {Vec3(0, 0, 0), Vec3(1, 1, 1)});
  Rows result(rows, Row(columns));
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < columns; ++c) {
      const double x = static_cast<double>(r) / static_cast<double>(rows - 1) - 0.5;
      const double y = static_cast<double>(c) / static_cast<double>(columns - 1) - 0.5;
      result[r][c] =
          placement.centre + size * (x * placement.u + y * placement.v + random.real(-0.05, 0.05) * placement.w);
    }
  }
  return result;
}

}  // namespace incise::test
