// SPDX-License-Identifier: Apache-2.0
// One closed rim around the box, repeated outwards in rows whose heights draw the cloth over the edge of the opening
// and down beside the body.
#include "app/view/drapes.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr Finish kCloth{{62, 128, 124, 255}, 0};
constexpr int kAlongSide = 24, kAroundCorner = 6;

/// Outwards from the opening: how far, and how high above the body's top, in lengths of its longest side. The cloth
/// hangs down beside the body: where that draws back from the rim, cloth is seen, and not what lies behind the picture.
struct Row {
  double out, high, folds;
};
constexpr std::array<Row, 10> kRows = {{{0.004, -1, 0},
                                        {0.004, -0.05, 0},
                                        {0.004, 0.004, 0},
                                        {0.012, 0.016, 0},
                                        {0.026, 0.014, 0},
                                        {0.045, 0.000, 0.1},
                                        {0.16, -0.012, 0.8},
                                        {0.42, -0.04, 1},
                                        {0.9, -0.10, 1},
                                        {3.2, -0.45, 1}}};

/// A place of the opening's rim, and the way outwards from there.
struct RimPlace {
  double x, y, out_x, out_y;
};

std::vector<RimPlace> rim_of(double half_x, double half_y) {
  std::vector<RimPlace> rim;
  const std::array<std::array<double, 2>, 4> corners = {
      {{half_x, half_y}, {-half_x, half_y}, {-half_x, -half_y}, {half_x, -half_y}}};
  for (std::size_t side = 0; side < 4; ++side) {
    const auto& from = corners[side];
    const auto& to = corners[(side + 1) % 4];
    const double first = 0.5 * std::numbers::pi * static_cast<double>(side);
    for (int i = 0; i < kAroundCorner; ++i) {
      const double turn = first + 0.5 * std::numbers::pi * i / kAroundCorner;
      rim.push_back({from[0], from[1], std::cos(turn), std::sin(turn)});
    }
    const double turn = first + 0.5 * std::numbers::pi;
    for (int i = 0; i < kAlongSide; ++i) {
      const double share = static_cast<double>(i) / kAlongSide;
      rim.push_back(
          {from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1]), std::cos(turn), std::sin(turn)});
    }
  }
  return rim;
}

/// Gentle folds of the cloth, in [-1, 1].
double fold(double x, double y) {
  return 0.5 * std::sin(9 * x + 4 * std::sin(3 * y)) + 0.5 * std::sin(7 * y - 2.5 * std::sin(4 * x) + 1);
}

}  // namespace

std::vector<SolidCorner> drapes_around(const Box& body, const Vec3& up) {
  std::vector<SolidCorner> out;
  if (body.is_empty()) return out;
  const Vec3 size = body.hi - body.lo, middle = 0.5 * (body.lo + body.hi);
  const Vec3 x = up.cross(Vec3(up.z(), up.x(), up.y())).stableNormalized();
  const Vec3 y = up.cross(x);
  const double half_x = 0.5 * size.dot(x.cwiseAbs()), half_y = 0.5 * size.dot(y.cwiseAbs());
  const double top = 0.5 * size.dot(up.cwiseAbs()), length = 2 * std::max(half_x, half_y);
  const std::vector<RimPlace> rim = rim_of(half_x, half_y);
  const std::size_t n = rim.size();
  const auto place = [&](std::size_t row, std::size_t i) {
    const Row& r = kRows[row];
    const double px = rim[i].x + r.out * length * rim[i].out_x, py = rim[i].y + r.out * length * rim[i].out_y;
    const double high = top + length * (r.high + 0.03 * r.folds * fold(px / length, py / length));
    return Vec3(middle + px * x + py * y + high * up);
  };
  std::vector<Vec3> normals(kRows.size() * n, Vec3::Zero());
  const auto for_each_triangle = [&](const auto& use) {
    for (std::size_t row = 0; row + 1 < kRows.size(); ++row) {
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t next = (i + 1) % n;
        use(std::array<std::array<std::size_t, 2>, 3>{{{row, i}, {row + 1, i}, {row + 1, next}}});
        use(std::array<std::array<std::size_t, 2>, 3>{{{row, i}, {row + 1, next}, {row, next}}});
      }
    }
  };
  for_each_triangle([&](const auto& corners) {
    const Vec3 a = place(corners[0][0], corners[0][1]), b = place(corners[1][0], corners[1][1]),
               c = place(corners[2][0], corners[2][1]);
    for (const auto& [row, i] : corners) normals[row * n + i] += (b - a).cross(c - a);
  });
  for_each_triangle([&](const auto& corners) {
    for (const auto& [row, i] : corners) {
      out.push_back({place(row, i).template cast<float>(),
                     normals[row * n + i].stableNormalized().template cast<float>(), kCloth});
    }
  });
  return out;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
