// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// Collects the tets around a vertex by flooding through the sides that contain it. Reusable scratch.
///
/// Paper §2.4, Algorithm 2 lines 1-3. Differs: its loop condition is misprinted ("while no new tets were added").
class StarWalker {
 public:
  /// The tets that can be reached from `seed` through sides that contain `vertex`, never through a side for which
  /// `is_blocked(Side)` holds; `seed` first, then in breadth-first order. Cost: O(star). Valid until the next call.
  template <class IsBlocked>
  const std::vector<TetId>& flood(const TetMesh& mesh, VertexId vertex, TetId seed, IsBlocked&& is_blocked) {
    star_.clear();
    ++epoch_;
    push(seed);
    for (std::size_t i = 0; i < star_.size(); ++i) {
      const TetId tet = star_[i];
      const TetVertices& corners = mesh.vertices(tet);
      for (unsigned s = 0; s < 4; ++s) {
        const Link link = mesh.links(tet)[s];
        if (corners[s] != vertex && !link.is_boundary() && !is_seen(link.side().tet()) && !is_blocked(Side(tet, s))) {
          push(link.side().tet());
          prefetch(mesh, link.side().tet());
        }
      }
    }
    return star_;
  }
  /// The star of `vertex` in the mesh as it stands; empty for a vertex without tets.
  const std::vector<TetId>& star(const TetMesh& mesh, VertexId vertex) {
    const TetId seed = mesh.tet_of(vertex);
    if (!seed.is_valid()) {
      star_.clear();
      return star_;
    }
    return flood(mesh, vertex, seed, [](Side) { return false; });
  }
  /// Whether the last flood reached `tet`.
  [[nodiscard]] bool is_seen(TetId tet) const { return tet.value < marks_.capacity() && marks_[tet.value] == epoch_; }

 private:
  void push(TetId tet) {
    marks_.ensure(std::size_t{tet.value} + 1);
    marks_[tet.value] = epoch_;
    star_.push_back(tet);
  }
  /// Prefetches the memory that the search will read when it comes to `tet`.
  static void prefetch(const TetMesh& mesh, TetId tet) {
    __builtin_prefetch(&mesh.vertices(tet));
    __builtin_prefetch(&mesh.links(tet));
  }

  std::vector<TetId> star_;
  ZeroedArray<std::uint32_t> marks_;
  std::uint32_t epoch_ = 0;
};

/// The shape bits of a vertex, with those for skin and walls as the faces in its star tell. Cost: O(star).
inline std::uint8_t shape_by_faces(const TetMesh& mesh, VertexId vertex, const std::vector<TetId>& star) {
  unsigned bits = mesh.shape_of(vertex) & ~unsigned{shape::kSkin | shape::kWall};
  for (const TetId tet : star) {
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(tet)[s];
      if (mesh.vertices(tet)[s] != vertex && link.is_boundary()) {
        bits |= link.tag() == 0 ? shape::kSkin : shape::kWall;
      }
    }
  }
  return static_cast<std::uint8_t>(bits);
}

/// Calls `visit(tet, side_in, side_out)` for the tets around the edge (a, b), starting at `seed` (which contains both)
/// and turning one way until the ring closes or `is_blocked(Side)` or the boundary stops it; then, where it did not
/// close, the other way from `seed`. Returns whether the ring closed. Cost: O(ring).
template <class Visit, class IsBlocked>
bool walk_edge_ring(const TetMesh& mesh, VertexId a, VertexId b, TetId seed, IsBlocked&& is_blocked, Visit&& visit) {
  const auto other_sides = [&](TetId tet) {
    std::array<unsigned, 2> sides{};
    unsigned count = 0;
    for (unsigned c = 0; c < 4 && count < 2; ++c) {
      const VertexId v = mesh.vertices(tet)[c];
      if (v != a && v != b) sides[count++] = c;
    }
    return sides;
  };
  visit(seed);
  const std::array<unsigned, 2> first = other_sides(seed);
  for (unsigned direction = 0; direction < 2; ++direction) {
    Side out(seed, first[direction]);
    while (true) {
      const Link link = mesh.link(out);
      if (link.is_boundary() || is_blocked(out)) break;
      const TetId next = link.side().tet();
      if (next == seed) return true;
      visit(next);
      const std::array<unsigned, 2> sides = other_sides(next);
      out = Side(next, sides[0] == link.side().side() ? sides[1] : sides[0]);
    }
  }
  return false;
}

}  // namespace v0
}  // namespace incise
