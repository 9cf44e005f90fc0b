// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {

using Mat3 = Eigen::Matrix3d;
using VecX = Eigen::VectorXd;

/// A symmetric sparse matrix of 3×3 blocks; both halves are stored. Reals: three rows to each row of blocks.
class BlockMatrix {
 public:
  BlockMatrix() = default;
  /// The pattern with every diagonal block, and a block for each pair of members of a clique; `kInvalidIndex` is
  /// skipped.
  BlockMatrix(std::uint32_t rows, const std::vector<std::array<std::uint32_t, 4>>& cliques);

  [[nodiscard]] std::uint32_t rows() const { return static_cast<std::uint32_t>(starts_.size() - 1); }
  void set_zero();
  /// A block of the pattern. Cost: O(log of its row).
  Mat3& at(std::uint32_t row, std::uint32_t column);
  [[nodiscard]] const Mat3& at(std::uint32_t row, std::uint32_t column) const;

  [[nodiscard]] VecX operator*(const VecX& x) const;
  /// The lower triangle by columns.
  [[nodiscard]] Eigen::SparseMatrix<double> to_lower() const;
  /// An order of the rows that keeps Cholesky's factor small: `order[row]` is the new place. Approximate minimum
  /// degree.
  [[nodiscard]] std::vector<std::uint32_t> elimination_order() const;

 private:
  [[nodiscard]] std::size_t find(std::uint32_t row, std::uint32_t column) const;

  std::vector<std::size_t> starts_ = {0};  // rows + 1
  std::vector<std::uint32_t> columns_;     // ascending in each row
  std::vector<Mat3> blocks_;
};

/// Solves A x = b by a sparse Cholesky factor, in the order that the rows have. The pattern is read once.
class CholeskySolver {
 public:
  /// Nothing where A is not positive definite.
  std::optional<VecX> solve(const BlockMatrix& a, const VecX& b);

 private:
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>> factor_;
  bool has_pattern_ = false;
};

/// Conjugate gradients, preconditioned by the inverses of the diagonal blocks.
struct ConjugateGradients {
  double tolerance = 1e-8;  ///< on the norm of the residual, as a share of that of b
  std::size_t max_iterations = 20000;
  std::size_t iterations = 0;  ///< spent so far, over all solves

  /// Nothing where a direction shows that A is not positive definite. Out of iterations: the last iterate.
  std::optional<VecX> solve(const BlockMatrix& a, const VecX& b);
};

}  // namespace v0
}  // namespace incise
