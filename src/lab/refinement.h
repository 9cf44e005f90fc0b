// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "cut/incision_face.h"
#include "incise/mesh/star.h"
#include "incise/mesh/transaction.h"
#include "lab/filling.h"
#include "paper/neighbourhood.h"

namespace incise {
inline namespace v0 {
namespace lab {

/// How a tet that the sheet crosses completely is divided.
enum class Scheme : std::uint8_t {
  kSeventeen,  ///< with points on all edges and sides
  kAdaptive,   ///< with points on crossed edges, and on the sides between them
};

/// Points put on edges and sides of the tets that a sheet crosses completely, and the parts that take the place of
/// these tets and of those beside them, which then have points on their edges or sides as well.
class Refinement {
 public:
  /// Plans it: `near` as `find_crossings` has left it. Where a part would have no volume, the edges of its tet stay
  /// whole. Cost: O(crossed tets · log) a round, and a round more for each layer of such tets.
  Refinement(const TetMesh& mesh, const Neighbourhood& near, Scheme scheme);

  /// How many tets the sheet crosses completely and will be divided.
  [[nodiscard]] std::uint64_t divided_tets() const { return divided_.size(); }
  /// How many tets get new parts, those beside them included.
  [[nodiscard]] std::uint64_t filled_tets() const { return filled_.size(); }
  /// How many edges stay whole.
  [[nodiscard]] std::uint64_t blocked_edges() const { return blocked_.size(); }

  /// Carries it out. Returns the faces between parts on different sides of the sheet. Cost: O(parts · log).
  std::vector<IncisionFace> apply(Transaction& transaction);

 private:
  using Ends = std::pair<VertexId, VertexId>;
  struct EdgePoint {
    Ends ends;  // rising
    double t = 0.5;
    TetId tet;  // one at it
    VertexId vertex;
  };
  struct SidePoint {
    Side side;  // the lower of two
    std::array<double, 3> weights{};
    VertexId vertex;
  };
  /// A tet that the sheet crosses completely. `beyond`: bits of the corners on one side.
  struct Divided {
    std::uint32_t near;
    std::uint8_t beyond;
  };
  /// A side of a part that lies on a side of the whole tet.
  struct OuterSide {
    std::array<VertexId, 3> face;  // rising
    Side side;
    unsigned whole;
  };
  struct Filled {
    TetId tet;
    std::vector<Child> children;
    std::vector<TetId> tets;       // of the children, once made
    std::vector<OuterSide> outer;  // by face
  };

  void find_divided();
  [[nodiscard]] bool is_blocked(const NearTet& tet) const;
  void place_points();
  void place_side_points(const Divided& divided);
  [[nodiscard]] std::array<double, 3> weights_of(const NearTet& tet, unsigned side) const;
  void find_filled();
  void number_points();
  bool block_unsound();
  [[nodiscard]] bool is_sound(const Filled& filled) const;
  [[nodiscard]] Vec3 place_of(TetId tet, PointCode code) const;
  [[nodiscard]] const EdgePoint* find_edge(VertexId a, VertexId b) const;
  [[nodiscard]] const SidePoint* find_side(Side side) const;
  [[nodiscard]] PointVertices points_of(TetId tet) const;

  void make_points(Transaction& transaction);
  void make_children(Transaction& transaction, Filled& filled);
  VertexId make_inside(Transaction& transaction, TetId tet);
  void link_inner(Transaction& transaction, Filled& filled, std::vector<IncisionFace>& incision) const;
  void link_outer(Transaction& transaction, const Filled& filled, const OuterSide& outer) const;
  [[nodiscard]] std::optional<Side> side_behind(TetId neighbour, const OuterSide& outer) const;

  const TetMesh& mesh_;
  const Neighbourhood& near_;
  Scheme scheme_;
  std::vector<Ends> blocked_;     // ascending
  std::vector<Divided> divided_;  // in the order of `near_`
  std::vector<EdgePoint> edges_;  // by ends
  std::vector<SidePoint> sides_;  // by side
  std::vector<Filled> filled_;    // by tet
};

}  // namespace lab
}  // namespace v0
}  // namespace incise
