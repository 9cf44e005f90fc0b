// SPDX-License-Identifier: Apache-2.0
// Exact sums and products of doubles as expansions: unevaluated sums of doubles that do not overlap, smallest first,
// without zeros. After J. R. Shewchuk 1997; theorem numbers are his. Exact while nothing overflows or underflows and
// rounding is to nearest even. No fused multiply-add, so that every target gives the same bits.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace incise {
inline namespace v0 {
namespace detail {

/// A rounded result and what rounding lost.
struct TwoTerm {
  double high, low;
};

/// a + b (Knuth; theorem 7).
inline TwoTerm two_sum(double a, double b) {
  const double sum = a + b;
  const double b_virtual = sum - a;
  return {sum, (a - (sum - b_virtual)) + (b - b_virtual)};
}

/// a + b where |a| >= |b| (Dekker; theorem 6).
inline TwoTerm fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a − b.
inline TwoTerm two_difference(double a, double b) {
  return two_sum(a, -b);
}

/// Halves of 26 bits each (Dekker; theorem 17).
inline TwoTerm split(double a) {
  constexpr double kSplitter = 134217729.0;  // 2^27 + 1
  const double c = kSplitter * a;
  const double high = c - (c - a);
  return {high, a - high};
}

/// a · b with the halves of b at hand (Dekker, Veltkamp; theorem 18).
inline TwoTerm two_product(double a, double b, const TwoTerm& b_halves) {
  const double product = a * b;
  const TwoTerm h = split(a);
  const double error = ((product - h.high * b_halves.high) - h.low * b_halves.high) - h.high * b_halves.low;
  return {product, h.low * b_halves.low - error};
}

/// Up to N doubles whose exact sum is the value; smallest magnitude first, no zeros (empty: 0).
template <std::size_t N>
class Expansion {
 public:
  Expansion() = default;
  explicit Expansion(const TwoTerm& t) {
    push(t.low);
    push(t.high);
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] double operator[](std::size_t i) const { return term_[i]; }
  void push(double term) {
    if (term != 0.0) {
      term_[size_++] = term;
    }
  }
  /// The largest term decides.
  [[nodiscard]] int sign() const {
    if (size_ == 0) {
      return 0;
    }
    return term_[size_ - 1] > 0.0 ? 1 : -1;
  }

 private:
  std::array<double, N> term_;
  std::size_t size_ = 0;
};

/// e + sign · f (FAST-EXPANSION-SUM with zero elimination, theorem 13).
template <std::size_t N, std::size_t M>
Expansion<N + M> add(const Expansion<N>& e, const Expansion<M>& f, double sign = 1.0) {
  Expansion<N + M> sum;
  std::size_t i = 0, j = 0;
  const auto next = [&] {
    if (j == f.size() || (i < e.size() && std::abs(e[i]) < std::abs(f[j]))) {
      return e[i++];
    }
    return sign * f[j++];
  };
  const std::size_t total = e.size() + f.size();
  if (total == 0) {
    return sum;
  }
  double carry = next();
  for (std::size_t k = 1; k < total; ++k) {
    const TwoTerm t = two_sum(carry, next());
    sum.push(t.low);
    carry = t.high;
  }
  sum.push(carry);
  return sum;
}

template <std::size_t N, std::size_t M>
Expansion<N + M> subtract(const Expansion<N>& e, const Expansion<M>& f) {
  return add(e, f, -1.0);
}

/// e · b (SCALE-EXPANSION with zero elimination, theorem 19).
template <std::size_t N>
Expansion<2 * N> scale(const Expansion<N>& e, double b) {
  Expansion<2 * N> result;
  if (e.size() == 0) {
    return result;
  }
  const TwoTerm halves = split(b);
  TwoTerm product = two_product(e[0], b, halves);
  result.push(product.low);
  double carry = product.high;
  for (std::size_t i = 1; i < e.size(); ++i) {
    product = two_product(e[i], b, halves);
    const TwoTerm t = two_sum(carry, product.low);
    result.push(t.low);
    const TwoTerm u = fast_two_sum(product.high, t.high);
    result.push(u.low);
    carry = u.high;
  }
  result.push(carry);
  return result;
}

/// e · f for a factor of at most two terms.
template <std::size_t N>
Expansion<4 * N> multiply(const Expansion<N>& e, const Expansion<2>& f) {
  if (f.size() == 0) {
    return {};
  }
  const Expansion<2 * N> low = scale(e, f[0]);
  return f.size() == 1 ? add(low, Expansion<2 * N>()) : add(low, scale(e, f[1]));
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
