// SPDX-License-Identifier: Apache-2.0
// Columns of the band while it is factored, rows beside them for solving: both ways go through memory in order
// (docs/internals.md, 4).
#include "sim/body/band_matrix.h"

#include <algorithm>
#include <cmath>

namespace incise {
inline namespace v0 {
namespace detail {

BandMatrix::BandMatrix(std::size_t size, std::size_t reach)
    : size_(size), reach_(reach), columns_(size * (reach + 1)), rows_(size * (reach + 1)) {}

bool BandMatrix::factor() {
  const std::size_t stride = reach_ + 1;
  for (std::size_t j = 0; j < size_; ++j) {
    double* column = columns_.data() + j * stride;
    if (!(column[0] > 0)) return false;
    const std::size_t count = std::min(stride, size_ - j);
    column[0] = std::sqrt(column[0]);
    for (std::size_t k = 1; k < count; ++k) column[k] /= column[0];
    for (std::size_t k = 1; k < count; ++k) {
      double* later = columns_.data() + (j + k) * stride;
      for (std::size_t i = k; i < count; ++i) later[i - k] -= column[k] * column[i];
    }
    for (std::size_t k = 0; k < count; ++k) rows_[(j + k) * stride + reach_ - k] = column[k];
  }
  return true;
}

/// Both ways entry by entry of the result, so that no sum waits for the one before it.
void BandMatrix::solve(std::vector<double>& x) const {
  const std::size_t stride = reach_ + 1;
  for (std::size_t j = 0; j < size_; ++j) {
    const double* column = columns_.data() + j * stride;
    const std::size_t count = std::min(stride, size_ - j);
    const double value = x[j] / column[0];
    x[j] = value;
    for (std::size_t k = 1; k < count; ++k) x[j + k] -= column[k] * value;
  }
  for (std::size_t i = size_; i-- > 0;) {
    const double* row = rows_.data() + i * stride;
    const std::size_t count = std::min(reach_, i);
    const double value = x[i] / row[reach_];
    x[i] = value;
    for (std::size_t k = 0; k < count; ++k) x[i - count + k] -= row[reach_ - count + k] * value;
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
