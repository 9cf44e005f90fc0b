// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "incise/geom/vec.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// Which of its two shapes a body is looked at in.
enum class BodyShape : std::uint8_t { kRest, kCurrent };

/// A point of the material: it moves with the tet that it is in.
struct TissuePoint {
  TetId tet;                        ///< the tet that it is in
  TetVertices vertices{};           ///< of the tet when the point was found: they tell whether it is still the same
  std::array<double, 4> weights{};  ///< barycentric, sum 1

  /// Where it is in one of the two shapes; only where `holds`.
  [[nodiscard]] Vec3 place(const TetMesh& mesh, BodyShape shape = BodyShape::kCurrent) const;
  /// Whether the tet is as it was.
  [[nodiscard]] bool holds(const TetMesh& mesh) const;

  /// Whether both are the same in all numbers.
  friend bool operator==(const TissuePoint&, const TissuePoint&) = default;
};

/// Finds the tissue at a place, walking from tet to tet.
///
/// @param near  a live tet to start from; the nearer the faster.
/// @return nothing where the walk leaves the body, or goes astray among tets that are turned inside out: in a body that
///   is not convex it may leave and the place be inside all the same.
/// Cost: O(tets on the way), about 50 ns each. Thread-safe. **Source:** the visibility walk of Devillers et al. 2001.
[[nodiscard]] std::optional<TissuePoint> walk_to(const TetMesh& mesh, BodyShape shape, const Vec3& place, TetId near);

/// The first of some tets that holds a place; those that are not live are passed over. Cost: about 10 ns each.
[[nodiscard]] std::optional<TissuePoint> find_among(const TetMesh& mesh, BodyShape shape, const Vec3& place,
                                                    std::span<const TetId> tets);

/// The first tet that holds a place, of those that are near some vertices: at most `most`, nearest by neighbourhood
/// first. Vertices that are not live are passed over. Cost: about 30 ns per tet.
[[nodiscard]] std::optional<TissuePoint> find_around(const TetMesh& mesh, BodyShape shape, const Vec3& place,
                                                     std::span<const VertexId> vertices, std::size_t most);

/// Finds the tissue at each of some places, or nothing where there is none. Cost: O(tets), about 5 ns each where they
/// are far from all places.
[[nodiscard]] std::vector<std::optional<TissuePoint>> find_tissue(const TetMesh& mesh, BodyShape shape,
                                                                  std::span<const Vec3> places);

/// Finds the tissue nearest to a place, or nothing where none is within `farthest` (length unit, at least 0). Where
/// the place is inside, that is the first tet that holds it, in the order of ids; of tets equally near, the first.
/// Cost: O(tets), about 5 ns each where they are far from the place.
[[nodiscard]] std::optional<TissuePoint> find_nearest(const TetMesh& mesh, BodyShape shape, const Vec3& place,
                                                      double farthest);

}  // namespace v0
}  // namespace incise
