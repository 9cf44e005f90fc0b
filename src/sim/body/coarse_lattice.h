// SPDX-License-Identifier: Apache-2.0
// What goes through the whole body. A sweep carries a change on by about one cell, and brings a long bend near to its
// end in hundreds of sweeps: a body that is left there swings slowly, as if it were heavier than it is. So each substep
// begins with a step on a coarse lattice over the rest shape, whose nodes move what is around them (trilinear shape
// functions): forces are summed up at the nodes, a coarse elastic body answers, and the answer is taken as far as the
// slope of the true energy along it falls. Multigrid's coarse correction (Brandt 1977; for elastic bodies in real time
// Georgii and Westermann 2006), with one coarse level and an operator of its own instead of Galerkin's.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "incise/core/id_array.h"
#include "incise/sim/body.h"
#include "sim/body/band_matrix.h"

namespace incise {
inline namespace v0 {
namespace detail {

class CoarseLattice {
 public:
  /// Brings the lattice up to date before substeps of `h` seconds. Cost: O(1) as a rule; O(vertices) where there is
  /// none yet, pieces have come off or other vertices are held; every few calls O(vertices) to turn with the body.
  void prepare(DeformableBody::State& state, double h);
  /// Sets a vertex right that is new or has another place at rest.
  void locate(VertexId vertex, const Vec3& rest);
  /// Moves the awake vertices towards their balance. Cost: as three sweeps.
  void correct(DeformableBody::State& state);

 private:
  using Row = std::array<float, 4>;  // a vector, and a number unused

  /// Where a vertex is: its cell's first node, and how far it is from there, as shares of the cell.
  struct Location {
    std::uint32_t corner = 0;
    std::array<float, 3> share{};
  };
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  struct Cells;  // while the matrix is made

  [[nodiscard]] bool fits(const DeformableBody::State& state, double h) const;
  void build(DeformableBody::State& state, double h);
  void lay_out(const DeformableBody::State& state);
  void number_nodes(const DeformableBody::State& state, Cells& cells);
  void assemble(const DeformableBody::State& state, const Cells& cells, double h);
  void add_cells(const Cells& cells);
  void add_vertices(const DeformableBody::State& state, double h);
  [[nodiscard]] Location location_of(const Vec3& rest) const;

  void turn(const DeformableBody::State& state);
  void gather(const DeformableBody::State& state);
  void answer();
  [[nodiscard]] double spread(const DeformableBody::State& state);
  [[nodiscard]] double slope_along(DeformableBody::State& state);
  void go(DeformableBody::State& state, double share);

  [[nodiscard]] const std::uint32_t* nodes_of(std::uint32_t piece) const;
  /// Calls `visit(node, weight)` for the nodes that move a vertex.
  template <class Visit>
  void for_each_node(std::uint32_t piece, const Location& location, Visit&& visit) const;

  Vec3 low_ = Vec3::Zero(), spacing_ = Vec3::Zero();
  std::array<std::uint32_t, 3> cells_{};
  std::array<std::uint32_t, 3> strides_{};  // of nodes: the longest axis has the greatest
  std::array<std::uint32_t, 8> offsets_{};  // of a cell's nodes from its first one
  std::uint32_t grid_ = 0;                  // nodes of the whole lattice

  std::vector<std::uint32_t> numbers_;         // of the nodes in use, by piece and place; kNone elsewhere
  std::vector<std::uint32_t> first_of_piece_;  // in `numbers_`; kNone: the piece has none
  std::uint32_t node_count_ = 0;
  IdArray<VertexId, Location> locations_;
  BandMatrix matrix_;
  std::vector<Mat3> turns_;  // of the body around each node
  std::vector<Row> nodes_;   // forces, then moves
  std::vector<double> solution_;
  std::vector<Row> slopes_, before_, steps_;  // by vertex slot

  // what it was built for
  std::size_t pieces_ = 0, holds_ = 0;
  double h_ = 0;
  unsigned age_ = 0;  // calls of `prepare` since it was turned
};

}  // namespace detail
}  // namespace v0
}  // namespace incise
