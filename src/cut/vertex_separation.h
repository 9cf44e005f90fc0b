// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cut/incision_faces.h"
#include "cut/incision_table.h"
#include "cut/master_star.h"
#include "cut/old_material.h"
#include "cut/star_parts.h"

namespace incise {
inline namespace v0 {

/// Sixth stage of a rebuild: every vertex of the cut in a dirty master gets one copy per part of its star, the incision
/// faces taken away. Where faces are closed afterwards it runs again, as another round.
///
/// Reads the links of the children, the faces between two pieces, and the old material. Changes the corners of the tets
/// around these vertices, their copies, and the names of vertices in the complex. Paper §2.3 and §2.4.
class VertexSeparation {
 public:
  /// A corner that goes by another name now.
  struct Renamed {
    VertexId from, to;
  };
  /// What is kept from run to run, for its storage; `renamed` are those of the last run.
  struct Memory {
    std::vector<Renamed> renamed;
    StarParts parts;
    MasterStar::Memory star;
    std::vector<Side> surface;
    ZeroedArray<std::uint32_t> visited;  // by vertex slot: the round that divided its star
    std::uint32_t round = 0;
  };

  VertexSeparation(RebuildState& state, OldMaterial& material, IncisionFaces& faces, IncisionTable& table,
                   Memory& memory);

  /// Divides the stars, each once. Cost: O(dirty masters and the stars of their vertices).
  void separate();

  /// Boundary sides around the vertices of the last round where two fans of tets might touch along an edge, or a face
  /// of the cut that is not rebuilt might be separated no more. Ascending, each once.
  [[nodiscard]] const std::vector<Side>& surface() const { return memory_.surface; }
  /// Whether the last round divided the star that a vertex belongs to.
  [[nodiscard]] bool has_visited(VertexId vertex) const;

 private:
  void divide_around(std::uint32_t index);
  [[nodiscard]] bool has_gone_over(const Master& master, unsigned corner) const;
  void divide_apart();
  void divide_corner(std::uint32_t master, VertexId vertex);
  void divide_split_point(std::uint32_t at);
  void divide_front_point(FrontPoint& point);
  void divide_middle(std::uint32_t index);
  [[nodiscard]] bool may_skip() const;
  [[nodiscard]] bool is_as_before(std::uint32_t edge) const;
  [[nodiscard]] bool is_as_before(const FrontPoint& point) const;
  [[nodiscard]] bool takes_whole_middle(const Master& master);
  VertexId divide(VertexId vertex, const StarParts::Home& home, bool makes_twins, bool may_be_named);
  [[nodiscard]] bool is_first(VertexId vertex);
  void note_visited(VertexId vertex);
  void find_across(std::span<const std::uint32_t> masters, VertexId vertex);
  [[nodiscard]] bool was_home(const StarTet& tet, VertexId vertex) const;
  [[nodiscard]] VertexId home_of_corner(VertexId vertex, std::span<const StarTet> part) const;
  void note_halves(ClosedEdge& edge);
  void note_surface_around(VertexId vertex);
  [[nodiscard]] bool has_plain_sides(const StarTet& tet) const;

  RebuildState& state_;
  OldMaterial& material_;
  IncisionFaces& faces_;
  IncisionTable& table_;
  Memory& memory_;
  unsigned rounds_ = 0;           // of this rebuild
  MasterStar star_;               // of the vertex that is being divided
  std::vector<VertexId> across_;  // of the corner that is being divided, see `find_across`
};

}  // namespace v0
}  // namespace incise
