// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "incise/geom/box.h"
#include "incise/mesh/transaction.h"

namespace incise {
inline namespace v0 {

/// A place in the body as it was before a rebuild: what stood there gives a new vertex its values.
struct MaterialPlace {
  TetVertices basis;
  std::array<double, 4> weights{};  ///< barycentric; below 0 where the place lies outside
  Vec3 current = Vec3::Zero();      ///< where the body stood there
  double inside = -1e300;           ///< the least of the weights; so low in a flat tet, where they are no numbers
};

/// The tets that a rebuild replaces, as they were, at rest and as the body stood.
class OldChildren {
 public:
  void clear() { tets_.clear(); }
  void add(const TetMesh& mesh, TetId tet);
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(tets_.size()); }
  [[nodiscard]] TetId id(std::uint32_t index) const { return tets_[index].id; }
  [[nodiscard]] const TetVertices& vertices(std::uint32_t index) const { return tets_[index].vertices; }

  /// The one of [first, last) that holds a rest point, or is nearest to holding it.
  [[nodiscard]] std::uint32_t holding(const Vec3& rest, std::uint32_t first, std::uint32_t last) const;
  /// A rest point in the coordinates of one of them.
  [[nodiscard]] MaterialPlace place_in(std::uint32_t index, const Vec3& rest) const;

 private:
  struct OldTet {
    TetId id;
    TetVertices vertices;
    std::array<Vec3, 4> rest, current;
    Box around;  ///< of the rest positions
  };
  static OldTet image_of(const TetMesh& mesh, TetId tet);
  static MaterialPlace place_in(const OldTet& tet, const Vec3& rest);
  friend MaterialPlace place_in(const TetMesh& mesh, TetId tet, const Vec3& rest);

  std::vector<OldTet> tets_;
};

/// A rest point in the coordinates of a live tet.
[[nodiscard]] MaterialPlace place_in(const TetMesh& mesh, TetId tet, const Vec3& rest);

/// Adds a vertex at a rest position with the values of a place; exact where the place is a corner.
VertexId add_vertex_at(Transaction& transaction, const Vec3& rest, const MaterialPlace& place);

}  // namespace v0
}  // namespace incise
