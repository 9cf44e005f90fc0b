// SPDX-License-Identifier: Apache-2.0
// Rows of blocks in the order of their columns. Eigen factors the lower half; conjugate gradients need the product and
// the diagonal alone (docs/internals.md, 4).
#include "sim/reference/block_matrix.h"

#include <Eigen/Cholesky>
#include <Eigen/OrderingMethods>
#include <algorithm>
#include <limits>

#include "incise/core/id.h"

namespace incise {
inline namespace v0 {

namespace {

Eigen::Index first_real(std::uint32_t row) {
  return 3 * static_cast<Eigen::Index>(row);
}

/// The inverses of the diagonal blocks; nothing where one is not positive definite.
std::optional<std::vector<Mat3>> inverse_diagonal(const BlockMatrix& a) {
  std::vector<Mat3> result(a.rows());
  for (std::uint32_t row = 0; row < a.rows(); ++row) {
    const Eigen::LLT<Mat3> factor(a.at(row, row));
    if (factor.info() != Eigen::Success) return std::nullopt;
    result[row] = factor.solve(Mat3::Identity());
  }
  return result;
}

VecX scaled(const std::vector<Mat3>& diagonal, const VecX& x) {
  VecX result(x.size());
  for (std::uint32_t row = 0; row < diagonal.size(); ++row) {
    result.segment<3>(first_real(row)) = diagonal[row] * x.segment<3>(first_real(row));
  }
  return result;
}

}  // namespace

BlockMatrix::BlockMatrix(std::uint32_t rows, const std::vector<std::array<std::uint32_t, 4>>& cliques) {
  std::vector<std::vector<std::uint32_t>> neighbours(rows);
  for (std::uint32_t row = 0; row < rows; ++row) neighbours[row].push_back(row);
  for (const auto& clique : cliques) {
    for (const std::uint32_t a : clique) {
      for (const std::uint32_t b : clique) {
        if (a != kInvalidIndex && b != kInvalidIndex && a != b) neighbours[a].push_back(b);
      }
    }
  }
  for (auto& row : neighbours) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    columns_.insert(columns_.end(), row.begin(), row.end());
    starts_.push_back(columns_.size());
  }
  blocks_.assign(columns_.size(), Mat3::Zero());
}

void BlockMatrix::set_zero() {
  std::fill(blocks_.begin(), blocks_.end(), Mat3::Zero());
}

std::size_t BlockMatrix::find(std::uint32_t row, std::uint32_t column) const {
  const auto first = columns_.begin() + static_cast<std::ptrdiff_t>(starts_[row]);
  const auto last = columns_.begin() + static_cast<std::ptrdiff_t>(starts_[row + 1]);
  return static_cast<std::size_t>(std::lower_bound(first, last, column) - columns_.begin());
}

Mat3& BlockMatrix::at(std::uint32_t row, std::uint32_t column) {
  return blocks_[find(row, column)];
}

const Mat3& BlockMatrix::at(std::uint32_t row, std::uint32_t column) const {
  return blocks_[find(row, column)];
}

VecX BlockMatrix::operator*(const VecX& x) const {
  VecX result(x.size());
  for (std::uint32_t row = 0; row < rows(); ++row) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = starts_[row]; k < starts_[row + 1]; ++k) {
      sum += blocks_[k] * x.segment<3>(first_real(columns_[k]));
    }
    result.segment<3>(first_real(row)) = sum;
  }
  return result;
}

Eigen::SparseMatrix<double> BlockMatrix::to_lower() const {
  Eigen::SparseMatrix<double> result(first_real(rows()), first_real(rows()));
  std::vector<int> heights;
  heights.reserve(static_cast<std::size_t>(result.cols()));
  for (std::uint32_t row = 0; row < rows(); ++row) {
    const int below = 3 * static_cast<int>(starts_[row + 1] - find(row, row) - 1);
    for (int c = 0; c < 3; ++c) heights.push_back(below + 3 - c);
  }
  result.reserve(heights);
  // By symmetry the column below the diagonal is the row beyond it.
  for (std::uint32_t row = 0; row < rows(); ++row) {
    for (Eigen::Index c = 0; c < 3; ++c) {
      for (std::size_t k = find(row, row); k < starts_[row + 1]; ++k) {
        for (Eigen::Index r = columns_[k] == row ? c : 0; r < 3; ++r) {
          result.insert(first_real(columns_[k]) + r, first_real(row) + c) = blocks_[k](c, r);
        }
      }
    }
  }
  result.makeCompressed();
  return result;
}

std::vector<std::uint32_t> BlockMatrix::elimination_order() const {
  const auto size = static_cast<Eigen::Index>(rows());
  Eigen::SparseMatrix<double> graph(size, size);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(columns_.size());
  for (std::uint32_t row = 0; row < rows(); ++row) {
    for (std::size_t k = starts_[row]; k < starts_[row + 1]; ++k) {
      entries.emplace_back(static_cast<int>(row), static_cast<int>(columns_[k]), 1.0);
    }
  }
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::AMDOrdering<int>::PermutationType inverse;
  Eigen::AMDOrdering<int>()(graph, inverse);
  std::vector<std::uint32_t> result(rows());
  for (std::uint32_t place = 0; place < rows(); ++place) {
    result[static_cast<std::size_t>(inverse.indices()[static_cast<Eigen::Index>(place)])] = place;
  }
  return result;
}

std::optional<VecX> CholeskySolver::solve(const BlockMatrix& a, const VecX& b) {
  const Eigen::SparseMatrix<double> lower = a.to_lower();
  if (!has_pattern_) factor_.analyzePattern(lower);
  has_pattern_ = true;
  factor_.factorize(lower);
  if (factor_.info() != Eigen::Success) return std::nullopt;
  return VecX(factor_.solve(b));
}

std::optional<VecX> ConjugateGradients::solve(const BlockMatrix& a, const VecX& b) {
  const auto diagonal = inverse_diagonal(a);
  if (!diagonal) return std::nullopt;
  const double goal = tolerance * b.norm();
  VecX x = VecX::Zero(b.size());
  VecX residual = b;
  VecX z = scaled(*diagonal, residual);
  VecX direction = z;
  double product = residual.dot(z);
  for (std::size_t i = 0; i < max_iterations && residual.norm() > goal; ++i) {
    const VecX image = a * direction;
    const double curvature = direction.dot(image);
    if (!(curvature > 0)) return std::nullopt;
    const double step = product / curvature;
    x += step * direction;
    residual -= step * image;
    z = scaled(*diagonal, residual);
    const double next = residual.dot(z);
    direction = z + (next / product) * direction;
    product = next;
    ++iterations;
  }
  return x;
}

}  // namespace v0
}  // namespace incise
