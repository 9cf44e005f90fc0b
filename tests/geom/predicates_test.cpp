// SPDX-License-Identifier: Apache-2.0
#include "incise/geom/predicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "support/random.h"

namespace incise::predicates_test {
namespace {

using test::Random;
__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 Uint128;

using Points = std::array<Vec3, 4>;
using SosPoints = std::array<SosPoint, 4>;

int sign_of(Int128 value) {
  return static_cast<int>(value > 0) - static_cast<int>(value < 0);
}

// Exact where coordinates / unit are below 2^53 and the determinant fits 127 bits: what goes beyond on the way wraps
// around and comes back.
int exact_orient3d(const Points& p, double unit = 1.0) {
  const auto integer = [unit](double x) { return static_cast<Uint128>(static_cast<std::int64_t>(x / unit)); };
  std::array<std::array<Uint128, 3>, 3> m;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      m[row][k] = integer(p[row + 1][axis]) - integer(p[0][axis]);
    }
  }
  const Uint128 det = m[2][0] * (m[0][1] * m[1][2] - m[0][2] * m[1][1]) +
                      m[2][1] * (m[0][2] * m[1][0] - m[0][0] * m[1][2]) +
                      m[2][2] * (m[0][0] * m[1][1] - m[0][1] * m[1][0]);
  return sign_of(static_cast<Int128>(det));
}

int exact_orient2d(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto integer = [](double x) { return static_cast<Int128>(static_cast<std::int64_t>(x)); };
  return sign_of((integer(b.x()) - integer(a.x())) * (integer(c.y()) - integer(a.y())) -
                 (integer(b.y()) - integer(a.y())) * (integer(c.x()) - integer(a.x())));
}

int orientation(const Points& p) {
  return orient3d(p[0], p[1], p[2], p[3]);
}
int orientation(const SosPoints& p) {
  return orient3d_sos(p[0], p[1], p[2], p[3]);
}

Points random_grid_points(Random& random, std::int64_t extent) {
  Points p;
  for (Vec3& v : p) v = random.grid_point(-extent, extent);
  return p;
}

// Calls visit(permutation, parity) for all 24 permutations of 0..3.
template <class Visit>
void for_each_permutation(Visit visit) {
  std::array<std::size_t, 4> order = {0, 1, 2, 3};
  do {
    int parity = 1;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) parity = order[i] > order[j] ? -parity : parity;
    }
    visit(order, parity);
  } while (std::next_permutation(order.begin(), order.end()));
}

// A polynomial in ε: exponent → coefficient.
using Polynomial = std::map<std::uint32_t, Int128>;

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial product;
  for (const auto& [i, x] : a) {
    for (const auto& [j, y] : b) product[i + j] += x * y;
  }
  return product;
}

void add_to(Polynomial& sum, const Polynomial& term, int sign) {
  for (const auto& [exponent, coefficient] : term) sum[exponent] += sign * coefficient;
}

// Coordinate j of the point of rank r plus ε^(2^(3r+j)), as the definition of SosPoint has it.
Polynomial perturbed(const Vec3& position, unsigned rank, unsigned j) {
  Polynomial p;
  p[0] = static_cast<std::int64_t>(position[static_cast<Eigen::Index>(j)]);
  p[1U << (3 * rank + j)] += 1;
  return p;
}

// The sign of the determinant for ε → 0+ by multiplying it all out; rows as for orient3d.
int sign_of_determinant(const std::array<std::array<Polynomial, 3>, 3>& m) {
  Polynomial det;
  for (std::size_t j = 0; j < 3; ++j) {
    const std::size_t k = (j + 1) % 3, l = (j + 2) % 3;
    add_to(det, m[2][j] * m[0][k] * m[1][l], 1);
    add_to(det, m[2][j] * m[0][l] * m[1][k], -1);
  }
  for (const auto& [exponent, coefficient] : det) {
    if (coefficient != 0) return sign_of(coefficient);
  }
  return 0;
}

// The sign of orient3d of points whose coordinate j of point i is coordinate(i, j).
template <class Coordinate>
int symbolic_orient3d(Coordinate coordinate) {
  std::array<std::array<Polynomial, 3>, 3> m;
  for (std::size_t row = 0; row < 3; ++row) {
    for (unsigned j = 0; j < 3; ++j) {
      m[row][j] = coordinate(row + 1, j);
      add_to(m[row][j], coordinate(std::size_t{0}, j), -1);
    }
  }
  return sign_of_determinant(m);
}

TEST(Orient2d, SignIsPositiveWhereThePointsTurnLeft) {
  EXPECT_EQ(orient2d(0, 0, 1, 0, 0, 1), 1);
  EXPECT_EQ(orient2d(0, 0, 0, 1, 1, 0), -1);
  EXPECT_EQ(orient2d(0, 0, 1, 1, 2, 2), 0);
}

TEST(Orient2d, AgreesWithIntegersOnGrids) {
  Random random(1);
  for (const std::int64_t extent : {1LL, 3LL, 100LL, 1LL << 40U}) {
    for (int i = 0; i < 20000; ++i) {
      const Vec3 a = random.grid_point(-extent, extent), b = random.grid_point(-extent, extent);
      // Half of the points lie on the line a b, or next to it.
      Vec3 c = random.grid_point(-extent, extent);
      if (i % 2 == 0) c = 2 * b - a + (i % 4 == 0 ? random.grid_point(-1, 1) : Vec3(Vec3::Zero()));
      EXPECT_EQ(orient2d(a.x(), a.y(), b.x(), b.y(), c.x(), c.y()), exact_orient2d(a, b, c));
    }
  }
}

TEST(Orient2d, IsExactWhereRoundingWouldDecide) {
  // Kettner et al. 2008, figure 2: p = (0.5 + i·u, 0.5 + j·u) against the line from (12, 12) to (24, 24).
  constexpr double kUnit = 0x1p-53;
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j) {
      const int expected = j > i ? 1 : (j < i ? -1 : 0);
      EXPECT_EQ(orient2d(12, 12, 24, 24, 0.5 + i * 2 * kUnit, 0.5 + j * 2 * kUnit), expected);
    }
  }
}

TEST(Orient3d, SignIsPositiveForAPositiveTet) {
  EXPECT_EQ(orient3d(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)), 1);
  EXPECT_EQ(orient3d(Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 1)), -1);
  EXPECT_EQ(orient3d(Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(7, 9, 0)), 0);
}

TEST(Orient3d, AgreesWithIntegersOnGrids) {
  Random random(2);
  for (const std::int64_t extent : {1LL, 2LL, 10LL, 1000LL, 1LL << 20U, 1LL << 39U}) {
    for (int i = 0; i < 20000; ++i) {
      const Points p = random_grid_points(random, extent);
      EXPECT_EQ(orientation(p), exact_orient3d(p));
    }
  }
}

TEST(Orient3d, AgreesWithIntegersNextToAPlane) {
  Random random(3);
  for (const std::int64_t extent : {5LL, 1000LL, 1LL << 19U, 1LL << 37U}) {
    for (int i = 0; i < 20000; ++i) {
      Points p = random_grid_points(random, extent);
      p[3] = p[1] + p[2] - p[0] + (i % 2 == 0 ? random.grid_point(-1, 1) : Vec3(Vec3::Zero()));
      EXPECT_EQ(orientation(p), exact_orient3d(p));
    }
  }
}

TEST(Orient3d, IsExactBelowAnUlp) {
  // The plane x + y + z = 1.5 through points whose last bits vary; the rounded determinant is noise.
  constexpr double kUnit = 0x1p-52;
  Random random(4);
  int zeros = 0;
  for (int i = 0; i < 50000; ++i) {
    Points p = {Vec3(0.5, 0.5, 0.5), Vec3(0.75, 0.5, 0.25), Vec3(0.25, 0.75, 0.5), Vec3(0.75, 0.25, 0.5)};
    for (Vec3& v : p) v += kUnit * random.grid_point(-1, 1);
    const int expected = exact_orient3d(p, kUnit);
    EXPECT_EQ(orientation(p), expected);
    zeros += static_cast<int>(expected == 0);
  }
  EXPECT_GT(zeros, 100);
}

TEST(Orient3d, ChangesSignWithOddPermutations) {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const Points p = i % 2 == 0
                         ? random_grid_points(random, 2)
                         : Points{random.point(0, 1), random.point(0, 1), random.point(0, 1), random.point(0, 1)};
    const int reference = orientation(p);
    for_each_permutation([&](const auto& o, int parity) {
      EXPECT_EQ(orient3d(p[o[0]], p[o[1]], p[o[2]], p[o[3]]), parity * reference);
    });
  }
}

TEST(Orient3d, DoesNotDependOnScale) {
  Random random(6);
  for (int i = 0; i < 2000; ++i) {
    Points p = random_grid_points(random, 3);
    if (i % 2 == 0) p[3] += 0x1p-40 * random.grid_point(-1, 1);
    const int reference = orientation(p);
    // From denormals (multiples of 2^-1074) to the largest doubles; 2^±498 is 1e±150.
    for (const double scale : {0x1p-1030, 0x1p-700, 0x1p-498, 0x1p-300, 0x1p300, 0x1p498, 0x1p1020}) {
      const Points q = {scale * p[0], scale * p[1], scale * p[2], scale * p[3]};
      EXPECT_EQ(orientation(q), reference) << scale;
    }
    // Axes of different scale.
    Points q = p;
    for (Vec3& v : q) v = v.cwiseProduct(Vec3(0x1p-498, 0x1p100, 0x1p140));
    EXPECT_EQ(orientation(q), reference);
  }
}

TEST(Orient3d, IsExactOverTheWholeDocumentedRange) {
  // a flat tet, then one corner moved by the smallest part of the range.
  constexpr double kLarge = 0x1p300, kSmall = 0x1p-340;
  const Vec3 a(0, 0, 0), b(kLarge, 0, 0), c(0, kLarge, 0);
  EXPECT_EQ(orient3d(a, b, c, Vec3(kLarge, kLarge, 0)), 0);
  EXPECT_EQ(orient3d(a, b, c, Vec3(kLarge, kLarge, kSmall)), 1);
  EXPECT_EQ(orient3d(a, b, c, Vec3(kLarge, kLarge, -kSmall)), -1);
  EXPECT_EQ(orient3d(a, Vec3(kLarge, kLarge, kSmall), Vec3(kSmall, kSmall, kLarge), Vec3(kLarge, kLarge, kLarge)), 0);
}

TEST(Orient3d, IsExactWhereLargeAndSmallCoordinatesMeet) {
  // Every coordinate is a small multiple of L or of S = 2^-638 L: as polynomials, of 1 or of ε.
  Random random(12);
  int zeros = 0;
  for (int i = 0; i < 20000; ++i) {
    std::array<std::array<std::int64_t, 3>, 4> factor;
    std::array<std::array<bool, 3>, 4> is_small;
    const double large = i % 3 == 0 ? 0x1p300 : (i % 3 == 1 ? 0x1p-380 : 0x1p1018), small = 0x1p-638 * large;
    Points p;
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t j = 0; j < 3; ++j) {
        factor[k][j] = random.integer(-2, 2);
        is_small[k][j] = random.bits() % 2 == 0;
        p[k][static_cast<Eigen::Index>(j)] = (is_small[k][j] ? small : large) * static_cast<double>(factor[k][j]);
      }
    }
    const int expected = symbolic_orient3d([&](std::size_t k, unsigned j) {
      return Polynomial{{is_small[k][j] ? 1U : 0U, factor[k][j]}};
    });
    ASSERT_EQ(orientation(p), expected);
    zeros += static_cast<int>(expected == 0);
  }
  EXPECT_GT(zeros, 100);
}

TEST(Orient3d, IsExactWhereProductsUnderflow) {
  // Integers next to a plane, scaled so that the products of three lose their last bits, or all.
  Random random(13);
  for (const double scale : {0x1p-365, 0x1p-370, 0x1p-375, 0x1p-379, 0x1p-385, 0x1p-520, 0x1p-540}) {
    for (int i = 0; i < 5000; ++i) {
      Points p = random_grid_points(random, 1LL << 20U);
      const std::int64_t s = random.integer(-3, 3), t = random.integer(-3, 3);
      p[3] = p[0] + static_cast<double>(s) * (p[1] - p[0]) + static_cast<double>(t) * (p[2] - p[0]) +
             random.grid_point(-1, 1);
      const int expected = exact_orient3d(p);
      ASSERT_EQ(orientation({scale * p[0], scale * p[1], scale * p[2], scale * p[3]}), expected) << scale;
    }
  }
}

TEST(Orient2d, IsExactWhereProductsUnderflow) {
  Random random(14);
  for (const double scale : {0x1p-545, 0x1p-555, 0x1p-560, 0x1p-900}) {
    for (int i = 0; i < 5000; ++i) {
      const Vec3 a = random.grid_point(-1000000, 1000000), b = random.grid_point(-1000000, 1000000);
      const Vec3 c = 2 * b - a + random.grid_point(-1, 1);
      ASSERT_EQ(orient2d(scale * a.x(), scale * a.y(), scale * b.x(), scale * b.y(), scale * c.x(), scale * c.y()),
                exact_orient2d(a, b, c));
    }
  }
}

TEST(Orient3d, FilterNeverContradictsTheExactSign) {
  Random random(7);
  for (int i = 0; i < 20000; ++i) {
    Points p = {random.point(0, 1), random.point(0, 1), random.point(0, 1), Vec3::Zero()};
    const double s = random.real(-1, 2), t = random.real(-1, 2);
    p[3] = p[0] + s * (p[1] - p[0]) + t * (p[2] - p[0]);
    const int filtered = orient3d_filter(p[0], p[1], p[2], p[3]);
    const int exact = detail::orient3d_exact(p[0], p[1], p[2], p[3]);
    EXPECT_TRUE(filtered == 0 || filtered == exact);
    EXPECT_EQ(exact, -detail::orient3d_exact(p[1], p[0], p[2], p[3]));
  }
}

TEST(SimulationOfSimplicity, EqualsTheDeterminantOfPerturbedPoints) {
  Random random(8);
  for (const std::int64_t extent : {0LL, 1LL, 2LL, 5LL}) {
    for (int i = 0; i < 4000; ++i) {
      // Ranks among six points, so that the order of four must do; keys far apart and in any order.
      std::array<unsigned, 6> ranks = {0, 1, 2, 3, 4, 5};
      for (std::size_t k = 5; k > 0; --k) std::swap(ranks[k], ranks[random.bits() % (k + 1)]);
      SosPoints p;
      for (std::size_t k = 0; k < 4; ++k) {
        p[k] = {random.grid_point(-extent, extent), (std::uint64_t{ranks[k]} << 40U) + 7};
      }
      if (i % 4 == 1) p[1].position = p[0].position;
      if (i % 4 == 2) p[3].position = p[2].position;
      if (i % 4 == 3) p[2].position = 2 * p[1].position - p[0].position;
      const int expected =
          symbolic_orient3d([&](std::size_t row, unsigned j) { return perturbed(p[row].position, ranks[row], j); });
      ASSERT_NE(expected, 0);
      ASSERT_EQ(orientation(p), expected);
    }
  }
}

TEST(SimulationOfSimplicity, ChangesSignWithOddPermutations) {
  Random random(9);
  for (int i = 0; i < 2000; ++i) {
    SosPoints p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = {random.grid_point(0, 1), random.bits()};
    const int reference = orientation(p);
    EXPECT_NE(reference, 0);
    for_each_permutation([&](const auto& o, int parity) {
      EXPECT_EQ(orient3d_sos(p[o[0]], p[o[1]], p[o[2]], p[o[3]]), parity * reference);
    });
  }
}

TEST(SimulationOfSimplicity, IsZeroOnlyForEqualKeys) {
  const Vec3 origin = Vec3::Zero();
  EXPECT_EQ(orient3d_sos({origin, 1}, {origin, 2}, {origin, 3}, {origin, 2}), 0);
  EXPECT_NE(orient3d_sos({origin, 1}, {origin, 2}, {origin, 3}, {origin, 4}), 0);
}

TEST(SimulationOfSimplicity, KeepsTheSignOfPointsInGeneralPosition) {
  Random random(10);
  for (int i = 0; i < 5000; ++i) {
    SosPoints p;
    for (SosPoint& v : p) v = {random.point(-1, 1), random.bits()};
    const int plain = orient3d(p[0].position, p[1].position, p[2].position, p[3].position);
    EXPECT_TRUE(plain == 0 || plain == orientation(p));
  }
}

// A closed surface and its inside, both of perturbed points.
struct Solid {
  std::vector<std::array<SosPoint, 3>> faces;
  std::vector<SosPoints> tets;  // inside: in an odd number of these

  [[nodiscard]] bool holds(const SosPoint& p) const {
    bool is_inside = false;
    for (const SosPoints& t : tets) {
      const int side = orientation(t);
      const bool is_in = orient3d_sos(p, t[1], t[2], t[3]) == side && orient3d_sos(t[0], p, t[2], t[3]) == side &&
                         orient3d_sos(t[0], t[1], p, t[3]) == side && orient3d_sos(t[0], t[1], t[2], p) == side;
      is_inside = is_inside != is_in;
    }
    return is_inside;
  }
  [[nodiscard]] int crossings(const SosPoint& p, const SosPoint& q) const {
    int count = 0;
    for (const auto& f : faces) count += static_cast<int>(segment_crosses_triangle(p, q, f[0], f[1], f[2]));
    return count;
  }
};

Solid tetrahedron(const SosPoints& p) {
  return {{{p[1], p[2], p[3]}, {p[0], p[3], p[2]}, {p[0], p[1], p[3]}, {p[0], p[2], p[1]}}, {p}};
}

// North and south pole, then four corners of the equator: any positions.
Solid octahedron(const std::array<SosPoint, 6>& p) {
  Solid solid;
  for (std::size_t i = 0; i < 4; ++i) {
    const SosPoint &a = p[2 + i], &b = p[2 + (i + 1) % 4];
    solid.faces.push_back({p[0], a, b});
    solid.faces.push_back({p[1], b, a});
    solid.tets.push_back({p[0], p[1], a, b});
  }
  return solid;
}

TEST(SegmentCrossesTriangle, CrossingsOfAClosedSurfaceAreEvenExactlyBetweenPointsOfOneSide) {
  Random random(11);
  int odd = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::int64_t extent = i % 3 + 1;
    std::uint64_t key = random.bits() % 1000;
    const auto next = [&] { return SosPoint{random.grid_point(0, extent), key = (key * 7 + 3) % 1009}; };
    SosPoints corners;
    std::array<SosPoint, 6> six;
    for (SosPoint& p : corners) p = next();
    for (SosPoint& p : six) p = next();
    for (const Solid& solid : {tetrahedron(corners), octahedron(six)}) {
      for (int s = 0; s < 10; ++s) {
        const SosPoint p{random.grid_point(0, extent), 2000 - 2 * static_cast<std::uint64_t>(s)};
        const SosPoint q{random.grid_point(0, extent), i % 2 == 0 ? 3000U : 5000U};
        const bool is_odd = solid.crossings(p, q) % 2 != 0;
        ASSERT_EQ(is_odd, solid.holds(p) != solid.holds(q));
        odd += static_cast<int>(is_odd);
      }
    }
  }
  EXPECT_GT(odd, 1000);
}

TEST(SegmentCrossesTriangle, OneOfTwoTrianglesCatchesASegmentThroughTheirSharedEdge) {
  // A square in z = 0, split along its diagonal; segments through points of the diagonal.
  const SosPoint a{Vec3(0, 0, 0), 10}, b{Vec3(4, 0, 0), 11}, c{Vec3(4, 4, 0), 12}, d{Vec3(0, 4, 0), 13};
  for (int k = 1; k <= 3; ++k) {
    for (const std::uint64_t key : {1U, 20U}) {
      const SosPoint p{Vec3(k, k, 1), key}, q{Vec3(k, k, -1), key + 1};
      EXPECT_EQ(segment_crosses_triangle(p, q, a, b, c) + segment_crosses_triangle(p, q, a, c, d), 1);
    }
  }
}

TEST(SegmentCrossesTriangle, TellsTheSideOfTheFirstEnd) {
  const SosPoint a{Vec3(0, 0, 0), 1}, b{Vec3(4, 0, 0), 2}, c{Vec3(0, 4, 0), 3};
  int side = 0;
  EXPECT_TRUE(segment_crosses_triangle({Vec3(1, 1, 1), 4}, {Vec3(1, 1, -1), 5}, a, b, c, &side));
  EXPECT_EQ(side, 1);
  EXPECT_TRUE(segment_crosses_triangle({Vec3(1, 1, -1), 4}, {Vec3(1, 1, 1), 5}, a, b, c, &side));
  EXPECT_EQ(side, -1);
  EXPECT_FALSE(segment_crosses_triangle({Vec3(3, 3, -1), 4}, {Vec3(3, 3, 1), 5}, a, b, c, &side));
  EXPECT_EQ(side, -1);
  EXPECT_FALSE(segment_crosses_triangle({Vec3(1, 1, 2), 4}, {Vec3(1, 1, 1), 5}, a, b, c));
}

TEST(SegmentCrossesTriangle, AFlatTriangleOrAPointSegmentIsNoSpecialCase) {
  const Vec3 origin = Vec3::Zero();
  const SosPoint a{origin, 1}, b{Vec3(1, 0, 0), 2}, c{Vec3(2, 0, 0), 3};
  EXPECT_FALSE(segment_crosses_triangle({Vec3(1, 1, 1), 4}, {Vec3(1, 1, -1), 5}, a, b, c));
  const SosPoint d{Vec3(0, 4, 0), 6};
  EXPECT_FALSE(segment_crosses_triangle({Vec3(1, 1, 1), 4}, {Vec3(1, 1, 1), 5}, a, c, d));
}

}  // namespace
}  // namespace incise::predicates_test
