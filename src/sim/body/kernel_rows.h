// SPDX-License-Identifier: Apache-2.0
// The descent's own numbers of vertices: in the order of the sweeps, whatever the order of the file. What visits read
// lies together where it is read together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "incise/core/grow_array.h"
#include "incise/core/id_array.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// Rows of vertex slots, and slots of rows: as many of each. A slot keeps its row for good; slots that come later have
/// their own number.
class KernelRows {
 public:
  /// Makes room for as many slots. Cost: O(new ones).
  void ensure(std::uint32_t slots) {
    for (std::uint32_t slot = static_cast<std::uint32_t>(slots_.size()); slot < slots; ++slot) {
      rows_.push_back(slot);
      slots_.push_back(slot);
    }
  }
  /// Gives the first rows to vertices, each listed once, in this order. To be called before anything lies by row.
  void arrange(std::span<const std::uint32_t> order) {
    for (std::uint32_t row = 0; row < order.size(); ++row) {
      const std::uint32_t slot = order[row], other = slots_[row], from = rows_[VertexId(slot)];
      slots_[row] = slot, rows_[VertexId(slot)] = row;
      slots_[from] = other, rows_[VertexId(other)] = from;
    }
  }

  [[nodiscard]] std::uint32_t of(VertexId vertex) const { return rows_[vertex]; }
  /// By slot.
  [[nodiscard]] const std::uint32_t* rows() const { return rows_.data(); }
  /// By row.
  [[nodiscard]] const std::uint32_t* slots() const { return slots_.data(); }
  /// The rows of slots, in their order.
  void find(std::span<const std::uint32_t> slots, std::vector<std::uint32_t>& found) const {
    found.resize(slots.size());
    for (std::size_t i = 0; i < slots.size(); ++i) found[i] = rows_[VertexId(slots[i])];
  }

 private:
  IdArray<VertexId, std::uint32_t> rows_;
  GrowArray<std::uint32_t> slots_;
};

/// Values of vertices that lie by row.
template <class T>
class ByRow {
 public:
  explicit ByRow(const KernelRows& rows) : rows_(&rows) {}

  void resize(std::size_t count) { values_.resize(count); }
  [[nodiscard]] std::size_t size() const { return values_.size(); }
  T& operator[](VertexId vertex) { return values_[rows_->of(vertex)]; }
  const T& operator[](VertexId vertex) const { return values_[rows_->of(vertex)]; }
  /// By row.
  T* data() { return values_.data(); }
  [[nodiscard]] const T* data() const { return values_.data(); }

 private:
  const KernelRows* rows_;
  GrowArray<T> values_;
};

}  // namespace detail
}  // namespace v0
}  // namespace incise
