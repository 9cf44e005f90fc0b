// SPDX-License-Identifier: Apache-2.0
// Exact determinants as expansions, after scaling by a power of two; under perturbation the minors of the matrix are
// tried in the order of their monomials, from a table made by the compiler.
#include "incise/geom/predicates.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <initializer_list>
#include <utility>

#include "geom/expansion_internal.h"

namespace incise {
inline namespace v0 {

namespace detail {

namespace {

/// The power of two that brings the largest of some coordinates near 2^338: products of three differences then just
/// do not overflow, and have the most room above underflow. Scaling one axis by a positive factor keeps every sign.
double scale_of(std::initializer_list<double> coordinates) {
  constexpr int kTarget = 338, kBias = 1023, kMantissaBits = 52, kLargest = 1000;
  double largest = 0.0;
  for (const double x : coordinates) {
    largest = std::max(largest, std::abs(x));
  }
  std::uint64_t bits = 0;
  std::memcpy(&bits, &largest, sizeof bits);
  const int exponent = static_cast<int>(bits >> kMantissaBits) - kBias;
  bits = static_cast<std::uint64_t>(std::min(kTarget - exponent, kLargest) + kBias) << kMantissaBits;
  double scale = 0.0;
  std::memcpy(&scale, &bits, sizeof scale);
  return scale;
}

Expansion<2> difference(double a, double b, double scale) {
  return Expansion<2>(two_difference(scale * a, scale * b));
}

/// a·d − b·c.
Expansion<16> minor(const Expansion<2>& a, const Expansion<2>& b, const Expansion<2>& c, const Expansion<2>& d) {
  return subtract(multiply(a, d), multiply(b, c));
}

}  // namespace

int orient2d_exact(double ax, double ay, double bx, double by, double cx, double cy) {
  const double sx = scale_of({ax, bx, cx}), sy = scale_of({ay, by, cy});
  return minor(difference(bx, ax, sx), difference(by, ay, sy), difference(cx, ax, sx), difference(cy, ay, sy)).sign();
}

int orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  std::array<Expansion<2>, 3> u, v, w;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double s = scale_of({a[k], b[k], c[k], d[k]});
    u[i] = difference(b[k], a[k], s);
    v[i] = difference(c[k], a[k], s);
    w[i] = difference(d[k], a[k], s);
  }
  const Expansion<64> x = multiply(minor(u[1], u[2], v[1], v[2]), w[0]);
  const Expansion<64> y = multiply(minor(u[2], u[0], v[2], v[0]), w[1]);
  const Expansion<64> z = multiply(minor(u[0], u[1], v[0], v[1]), w[2]);
  return add(add(x, y), z).sign();
}

}  // namespace detail

namespace {

// With rows (1, x, y, z) of the points by ascending key, the perturbed determinant is a polynomial in the twelve
// perturbations. Each is of degree one in every monomial, and a monomial takes at most one perturbation from a row and
// from a column. Its coefficient is the determinant of the rows and columns that it leaves, with the sign of a Laplace
// expansion. Number the perturbation of coordinate j of row i as bit 3i + j: since perturbation number n is
// ε^(2^n), the powers of ε rank as the monomials' bit patterns do, and the first non-zero coefficient has the sign.

constexpr unsigned kRows = 4, kAxes = 3;

/// The coefficient of one monomial: ± the determinant of (1, axes) over the rows that remain.
struct Minor {
  int sign = 0;
  unsigned size = 0;  // of the determinant: rows 3 (orient2d), 2 (difference) or 1 (constant)
  std::array<std::uint8_t, 3> rows = {};
  std::array<std::uint8_t, 2> axes = {};
};

constexpr unsigned kMaxMinors = 32;
struct MinorTable {
  std::array<Minor, kMaxMinors> minors = {};
  unsigned count = 0;
};

/// The coefficient of the monomial with these bits, or one of sign 0 where no such monomial exists.
constexpr Minor minor_of(unsigned bits) {
  Minor m;
  unsigned used_axes = 0, exponent = 0, taken = 0;
  std::array<unsigned, kAxes> axis_taken = {};
  for (unsigned row = 0; row < kRows; ++row) {
    const unsigned of_row = (bits >> (kAxes * row)) & 7U;
    if (of_row == 0) {
      if (m.size < 3) m.rows[m.size] = static_cast<std::uint8_t>(row);
      ++m.size;
      continue;
    }
    if ((of_row & (of_row - 1U)) != 0 || (used_axes & of_row) != 0) {
      return {};
    }
    const unsigned axis = of_row == 1U ? 0U : (of_row == 2U ? 1U : 2U);
    used_axes |= of_row;
    exponent += row + axis + 1;  // column 0 holds the ones
    for (unsigned k = 0; k < taken; ++k) exponent += axis_taken[k] > axis ? 1U : 0U;
    axis_taken[taken++] = axis;
  }
  unsigned left = 0;
  for (unsigned axis = 0; axis < kAxes; ++axis) {
    if ((used_axes >> axis & 1U) == 0 && left < 2) m.axes[left++] = static_cast<std::uint8_t>(axis);
  }
  m.sign = exponent % 2 == 0 ? 1 : -1;
  return m;
}

/// The coefficients by falling size of their monomials, up to the first that is constant.
constexpr MinorTable make_minors() {
  MinorTable table;
  for (unsigned bits = 1;; ++bits) {
    const Minor m = minor_of(bits);
    if (m.sign == 0) {
      continue;
    }
    table.minors[table.count++] = m;
    if (m.size == 1) {
      return table;
    }
  }
}

constexpr MinorTable kMinors = make_minors();
static_assert(kMinors.count == 17);

using Rows = std::array<const SosPoint*, 4>;

int evaluate(const Minor& m, const Rows& p) {
  const auto at = [&](unsigned row, unsigned axis) {
    return p[m.rows[row]]->position[static_cast<Eigen::Index>(m.axes[axis])];
  };
  switch (m.size) {
    case 3:
      return m.sign * orient2d(at(0, 0), at(0, 1), at(1, 0), at(1, 1), at(2, 0), at(2, 1));
    case 2:
      return m.sign * (static_cast<int>(at(1, 0) > at(0, 0)) - static_cast<int>(at(1, 0) < at(0, 0)));
    default:
      return m.sign;
  }
}

/// Sorts by key; returns the sign of the permutation, or 0 where two keys are equal.
int sort_by_key(Rows& p) {
  int parity = 1;
  const auto order = [&](std::size_t i, std::size_t j) {
    if (p[j]->key < p[i]->key) {
      std::swap(p[i], p[j]);
      parity = -parity;
    }
  };
  order(0, 1);
  order(2, 3);
  order(0, 2);
  order(1, 3);
  order(1, 2);
  const bool is_distinct = p[0]->key != p[1]->key && p[1]->key != p[2]->key && p[2]->key != p[3]->key;
  return is_distinct ? parity : 0;
}

}  // namespace

int orient3d_sos_tie(const SosPoint& a, const SosPoint& b, const SosPoint& c, const SosPoint& d) {
  Rows p = {&a, &b, &c, &d};
  const int parity = sort_by_key(p);
  if (parity == 0) {
    return 0;
  }
  for (unsigned i = 0; i < kMinors.count; ++i) {
    const int sign = evaluate(kMinors.minors[i], p);
    if (sign != 0) {
      return parity * sign;
    }
  }
  return parity;  // not reached: the last minor is constant
}

}  // namespace v0
}  // namespace incise
