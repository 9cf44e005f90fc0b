// SPDX-License-Identifier: Apache-2.0
// The boundary of a body as contact sees it; follows the mesh through what its journal names.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "incise/core/grow_array.h"
#include "incise/core/id_array.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// A boundary side.
struct ContactFace {
  Side side;
  std::array<std::uint32_t, 3> corners{};  ///< seen from outside against the clock
  bool is_at_front = false;                ///< a corner is where a cut ends
};

class ContactSurface {
 public:
  /// A vertex of the surface. Area at rest: a third of its faces'.
  struct Vertex {
    double area = 0;           ///< 0: not on the surface; squared length unit
    bool is_at_front = false;  ///< where a cut ends: in no contact
    bool is_beside_front = false;
  };

  /// Reads a tet's sides anew. `is_part`: whether it is live and has a part in the body. To be called for whatever tet
  /// a step names. Cost: O(1).
  void set(const TetMesh& mesh, TetId tet, bool is_part);
  /// Forgets the tets from a slot on: undo has taken their slots back.
  void keep(std::uint32_t tet_slots);
  /// Lists faces and vertices anew where any side has changed; returns whether it did. Cost then: O(faces), and O(tet
  /// slots / 8) very cheap.
  bool refresh(const TetMesh& mesh);

  /// By side.
  [[nodiscard]] std::span<const ContactFace> faces() const { return faces_; }
  /// Slots, in ascending order.
  [[nodiscard]] std::span<const std::uint32_t> vertices() const { return vertices_; }
  [[nodiscard]] const Vertex& vertex(std::uint32_t slot) const { return of_vertex_[VertexId(slot)]; }
  /// Whether a side is still one of the boundary.
  [[nodiscard]] bool has(Side side) const {
    const TetId t = side.tet();
    return t.value < sides_.size() && (unsigned{sides_[t]} >> side.side() & 1U) != 0;
  }
  /// The mean length of the faces' edges at rest, length unit.
  [[nodiscard]] double spacing() const { return spacing_; }

 private:
  void list_faces(const TetMesh& mesh);

  IdArray<TetId, std::uint8_t> sides_;  // bits
  std::vector<ContactFace> faces_;
  std::vector<std::uint32_t> vertices_;
  IdArray<VertexId, Vertex> of_vertex_;
  double spacing_ = 0;
  bool is_stale_ = false;
};

}  // namespace detail
}  // namespace v0
}  // namespace incise
