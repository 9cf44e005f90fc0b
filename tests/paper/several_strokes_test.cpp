// SPDX-License-Identifier: Apache-2.0
// Strokes of profile paper that meet earlier ones on the same sheet: they go on, come again, or come from elsewhere,
// and leave the pieces of one stroke, with no crumbs and no flat tets between its wall and their own sheet.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "paper_support.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/strokes.h"

namespace incise::test::several_strokes_test {
namespace {

using Row = std::vector<Vec3>;
using Rows = std::vector<Row>;

Engine cut(TetSoup body, const std::vector<Rows>& strokes, bool maintains) {
  EngineOptions options;
  options.cut.profile = Profile::kPaper;
  options.maintain.merge = options.maintain.improve = maintains;
  Engine engine = Engine::create(build(std::move(body)), options).value();
  for (const Rows& rows : strokes) {
    EXPECT_TRUE(engine.begin_stroke(BladePose{rows.front()}).ok());
    for (std::size_t k = 1; k < rows.size(); ++k) EXPECT_TRUE(engine.step(BladePose{rows[k]}).ok());
    EXPECT_TRUE(engine.end_stroke().ok());
  }
  expect_valid(engine.mesh(), volume_of(engine.mesh()), 1e-12);
  return engine;
}

double least_volume(const TetMesh& mesh) {
  double least = 1;
  mesh.for_each_tet([&](TetId tet) { least = std::min(least, mesh.rest_volume6(tet) / 6); });
  return least;
}

/// A sheet that bends by a height over its path, in a frame that is oblique to the body's.
class BentSheet {
 public:
  static constexpr int kRows = 20;
  explicit BentSheet(std::function<double(double)> height) : height_(std::move(height)) {}
  /// From one row to another, in either sense, and from one height of the blade to another.
  [[nodiscard]] Rows from(int first, int last, double low = -1.2, double high = 1.2) const {
    Rows rows;
    for (int k = first;; k += first < last ? 1 : -1) {
      rows.push_back({place(k, low), place(k, high)});
      if (k == last) return rows;
    }
  }

 private:
  [[nodiscard]] Vec3 place(int row, double along) const {
    const double s = 2.4 * row / kRows - 1.2;
    const Vec3 u = Vec3(0.9, 0.3, 0.1).normalized(), w = u.cross(Vec3(0.1, 1, 0.2)).normalized();
    return Vec3(0.52, 0.49, 0.51) + s * u + height_(s) * w.cross(u) + along * w;
  }
  std::function<double(double)> height_;
};

double arc(double s) {
  return 0.4 * (s * s - 0.4);
}
double wave(double s) {
  return 0.3 * s * (1 - s * s);
}

struct Case {
  const char* name;
  std::function<std::vector<Rows>(const BentSheet&)> strokes;
};

class SeveralStrokes : public ::testing::TestWithParam<Case> {};

TEST_P(SeveralStrokes, on_one_bent_sheet_leave_the_pieces_of_one) {
  for (const auto& [name, height] : {std::pair("arc", &arc), std::pair("wave", &wave)}) {
    for (const bool maintains : {false, true}) {
      for (const std::uint64_t seed : {0U, 1U, 2U}) {
        SCOPED_TRACE(std::string(name) + (maintains ? ", maintained, " : ", ") + std::to_string(seed));
        const BentSheet sheet(height);
        const Engine engine =
            cut(seed == 0 ? kuhn_cube(5) : jittered_cube(5, seed), GetParam().strokes(sheet), maintains);
        EXPECT_EQ(piece_volumes(engine.mesh()).size(), 2U);
        if (maintains) {
          EXPECT_GT(least_volume(engine.mesh()), 1e-12);
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Ways, SeveralStrokes,
    ::testing::Values(Case{"go_on",
                           [](const BentSheet& s) {
                             return std::vector{s.from(0, 6), s.from(6, 11), s.from(11, 20)};
                           }},
                      Case{"again",
                           [](const BentSheet& s) {
                             return std::vector{s.from(0, 9), s.from(0, 9), s.from(9, 20)};
                           }},
                      Case{"back",
                           [](const BentSheet& s) {
                             return std::vector{s.from(0, 9), s.from(9, 0), s.from(9, 20)};
                           }},
                      Case{"deeper",
                           [](const BentSheet& s) {
                             return std::vector{s.from(0, 20, -1.2, -0.2), s.from(20, 0, -1.2, 0.15), s.from(0, 20)};
                           }},
                      Case{"both_sides",
                           [](const BentSheet& s) {
                             return std::vector{s.from(0, 12), s.from(20, 8)};
                           }},
                      Case{"both_to_one_row",
                           [](const BentSheet& s) {
                             return std::vector{s.from(0, 10), s.from(20, 10)};
                           }},
                      Case{"from_the_middle",
                           [](const BentSheet& s) {
                             return std::vector{s.from(9, 20), s.from(0, 12)};
                           }}),
    [](const auto& test) { return test.param.name; });

/// Whether two strokes that go on from each other divide the body though another one has crossed them in between.
TEST(SeveralStrokes, go_on_behind_one_that_crosses) {
  for (const double behind : {0.04, 0.1, 0.18}) {
    SCOPED_TRACE(behind);
    const auto row = [&](double from, double to) {
      Rows rows;
      for (int k = 0; k <= 8; ++k) {
        const double x = from + (to - from) * k / 8;
        rows.push_back({Vec3(x, 0.53 + 0.1 * x, -0.3), Vec3(x, 0.53 + 0.1 * x, 1.3)});
      }
      return rows;
    };
    Rows across;
    for (int k = 0; k <= 8; ++k) {
      const double y = -0.3 + 0.2 * k, x = 0.57 - behind;
      across.push_back({Vec3(x + 0.1 * y, y, -0.3), Vec3(x + 0.1 * y, y, 1.3)});
    }
    for (const bool maintains : {false, true}) {
      const Engine engine = cut(jittered_cube(5, 3), {row(-0.3, 0.62), across, row(0.62, 1.3)}, maintains);
      EXPECT_EQ(piece_volumes(engine.mesh()).size(), 4U);
    }
  }
}

/// Two planes through the middle of the cube that enclose 14 to 18 degrees, the first of which is smoothed before the
/// second comes: beside their axis its wall passed for one of the second's, whose strips are short.
TEST(SeveralStrokes, cross_at_small_angles_in_many_frames) {
  for (const double angle : {14.0, 16.0, 18.0}) {
    const auto rows = [&](double turn) {
      const double slope = std::tan(turn * 3.14159265358979323846 / 180);
      Rows all;
      for (int k = 0; k <= 70; ++k) {
        const double y = -0.9 + 1.8 * k / 70;
        all.push_back({Vec3(0.5 + slope * y, 0.5 + y, -1.2), Vec3(0.5 + slope * y, 0.5 + y, 2.2)});
      }
      return all;
    };
    const Engine engine = cut(kuhn_cube(5), {rows(-angle / 2), rows(angle / 2)}, true);
    EXPECT_EQ(find_components(engine.mesh()).count(), 4U) << angle;
  }
}

/// Rows in so many strokes, each of which goes on from the one before.
void add_in_strokes(std::vector<Rows>& strokes, const Rows& rows, std::size_t count) {
  const auto steps = static_cast<std::ptrdiff_t>((rows.size() - 1) / count);
  for (auto from = rows.begin(); from + steps < rows.end(); from += steps) strokes.push_back({from, from + steps + 1});
}

/// Rows of a plane through a point, from so far before it to so far behind.
Rows plane_rows(const Vec3& middle, const Vec3& forwards, const Vec3& along) {
  Rows rows;
  for (int k = 0; k <= 28; ++k) {
    const Vec3 at = middle + 1.2 * (k / 14.0 - 1) * forwards;
    rows.push_back({at - 1.6 * along, at + 1.6 * along});
  }
  return rows;
}

/// In each of two planes that cross a stroke ends on their axis, and the next one goes on from there.
TEST(SeveralStrokes, that_end_on_the_axis_of_planes_leave_no_crumbs) {
  const Vec3 along = Vec3(0.1, 1, 0.2).normalized(), u = Vec3(0.9, 0.3, 0.1).cross(along).normalized(),
             w = along.cross(u), middle(0.52, 0.49, 0.51);
  for (const double degrees : {55.0, 70.0, 89.0}) {
    const double angle = degrees * 3.14159265358979323846 / 180;
    for (const std::size_t count : {2U, 4U, 14U}) {
      for (const std::uint64_t seed : {0U, 1U, 2U}) {
        SCOPED_TRACE(testing::Message() << degrees << " degrees, " << count << " strokes, seed " << seed);
        std::vector<Rows> strokes;
        add_in_strokes(strokes, plane_rows(middle, u, along), count);
        add_in_strokes(strokes, plane_rows(middle, std::cos(angle) * u + std::sin(angle) * w, along), count);
        const Engine engine = cut(seed == 0 ? kuhn_cube(5) : jittered_cube(5, seed), strokes, true);
        EXPECT_EQ(piece_volumes(engine.mesh()).size(), 4U);
      }
    }
  }
}

/// The last row of a stroke lies on an older wall, or its first one: they meet, however many strokes both take.
TEST(SeveralStrokes, that_end_or_begin_on_an_older_wall_meet_it) {
  const Vec3 along = Vec3(0.1, 1, 0.2).normalized(), u = Vec3(0.9, 0.3, 0.1).cross(along).normalized(),
             w = along.cross(u), middle(0.52, 0.49, 0.51);
  for (const double degrees : {50.0, 67.0, 90.0}) {
    const double angle = degrees * 3.14159265358979323846 / 180;
    const Rows whole = plane_rows(middle, std::cos(angle) * u + std::sin(angle) * w, along);
    for (const bool begins : {false, true}) {
      Rows half = begins ? Rows(whole.begin() + 14, whole.end()) : Rows(whole.begin(), whole.begin() + 15);
      for (const std::size_t count : {1U, 2U, 7U}) {
        for (const std::uint32_t seed : {0U, 1U, 2U, 3U}) {
          SCOPED_TRACE(testing::Message() << degrees << " degrees, " << count << " strokes, seed " << seed
                                          << (begins ? ", begins there" : ", ends there"));
          std::vector<Rows> strokes;
          add_in_strokes(strokes, plane_rows(middle, u, along), count);
          add_in_strokes(strokes, half, count);
          const Engine engine = cut(seed == 0 ? kuhn_cube(5) : jittered_cube(4 + seed, seed), strokes, true);
          EXPECT_EQ(piece_volumes(engine.mesh()).size(), 3U);
        }
      }
    }
  }
}

/// A plane crosses one half of a bent sheet, and its front, at an acute angle before the other half is cut.
TEST(SeveralStrokes, go_on_at_a_bent_front_that_a_plane_has_crossed) {
  for (const double degrees : {31.0, 44.0, 70.0}) {
    const double angle = degrees * 3.14159265358979323846 / 180;
    const BentSheet sheet([](double s) { return 0.1 * s * (1 - s * s); });
    const Row middle = sheet.from(10, 11).front(), next = sheet.from(10, 11).back();
    const Vec3 along = (middle[1] - middle[0]).normalized(), u = (next[0] - middle[0]).normalized(), n = along.cross(u);
    for (const std::size_t count : {1U, 2U, 7U, 28U}) {
      for (const std::uint64_t seed : {0U, 1U, 2U}) {
        SCOPED_TRACE(testing::Message() << degrees << " degrees, plane in " << count << " strokes, seed " << seed);
        std::vector<Rows> strokes;
        add_in_strokes(strokes, sheet.from(0, 10), count == 28 ? 10 : 1);
        const Vec3 axis = (u + along).normalized(), across = n.cross(axis);
        add_in_strokes(strokes, plane_rows(Vec3(0.5, 0.52, 0.48), std::sin(angle) * n + std::cos(angle) * across, axis),
                       count);
        add_in_strokes(strokes, sheet.from(10, 20), count == 28 ? 10 : 1);
        const Engine engine = cut(seed == 0 ? kuhn_cube(5) : jittered_cube(5, seed), strokes, true);
        EXPECT_EQ(piece_volumes(engine.mesh()).size(), 4U);
      }
    }
  }
}

/// A stroke that ends just behind a sharp corner of its way, and another one that goes on from there.
TEST(SeveralStrokes, go_on_just_behind_a_corner) {
  for (const double behind : {0.05, 0.1, 0.15}) {
    SCOPED_TRACE(behind);
    const Vec3 corner(0.52, 0.47, 0), way = Vec3(1, 0.3, 0).normalized(), on = Vec3(-0.4, 1, 0).normalized();
    const auto upright = [](const Vec3& foot) { return Row{foot - 0.3 * Vec3::UnitZ(), foot + 1.3 * Vec3::UnitZ()}; };
    Rows first, second;
    for (int k = 20; k >= 0; --k) first.push_back(upright(corner - 0.08 * k * way));
    first.push_back(upright(corner + behind * on));
    for (int k = 0; k <= 20; ++k) second.push_back(upright(corner + (behind + 0.08 * k) * on));
    for (const bool maintains : {false, true}) {
      const Engine engine = cut(jittered_cube(5, 2), {first, second}, maintains);
      EXPECT_EQ(piece_volumes(engine.mesh()).size(), 2U);
    }
  }
}

}  // namespace
}  // namespace incise::test::several_strokes_test
