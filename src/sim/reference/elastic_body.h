// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "incise/mesh/tet_mesh.h"
#include "incise/sim/reference.h"
#include "sim/reference/block_matrix.h"
#include "sim/reference/neo_hookean.h"

namespace incise {
inline namespace v0 {

/// A mesh as linear finite elements of stable neo-Hookean tissue, in SI units. Displacements: metres from rest, one for
/// each vertex slot.
class ElasticBody {
 public:
  struct Element {
    std::array<std::uint32_t, 4> vertices = {};  // slots
    Eigen::Matrix<double, 3, 4> gradients;       // of the four shape functions, 1/m
    double volume = 0;                           // m³
    NeoHookean tissue;
  };

  ElasticBody() = default;
  explicit ElasticBody(const ReferenceProblem& problem);

  [[nodiscard]] const std::vector<Element>& elements() const { return elements_; }
  [[nodiscard]] std::size_t slot_count() const { return masses_.size(); }
  /// kg; 0 for a slot that no element uses.
  [[nodiscard]] double mass(std::uint32_t slot) const { return masses_[slot]; }
  /// The number of a vertex that may move among all those; `kInvalidIndex` for the others. In elimination order.
  [[nodiscard]] std::uint32_t unknown(std::uint32_t slot) const { return unknowns_[slot]; }
  [[nodiscard]] std::uint32_t unknown_count() const { return hessian_pattern_.rows(); }

  /// J.
  [[nodiscard]] double energy(const std::vector<Vec3>& displacements) const;
  /// The energy's gradient for each slot, N: minus the elastic forces.
  [[nodiscard]] std::vector<Vec3> gradient(const std::vector<Vec3>& displacements) const;
  /// The energy's second derivatives by the unknowns, N/m. `is_projected`: of each element, the nearest without
  /// negative eigenvalues.
  [[nodiscard]] BlockMatrix hessian(const std::vector<Vec3>& displacements, bool is_projected) const;

  /// A slot of a part that fewer than three held vertices carry; `kInvalidIndex` where there is none. A part: elements
  /// joined by common vertices.
  [[nodiscard]] std::uint32_t find_loose(const std::vector<VertexId>& held) const;

 private:
  void add_element(const ReferenceProblem& problem, TetId tet);
  void number_unknowns(const std::vector<VertexId>& held);
  [[nodiscard]] std::vector<std::array<std::uint32_t, 4>> cliques() const;

  std::vector<Element> elements_;
  std::vector<double> masses_;
  std::vector<std::uint32_t> unknowns_;
  BlockMatrix hessian_pattern_;
};

}  // namespace v0
}  // namespace incise
