// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "incise/mesh/star.h"
#include "paper/constants.h"
#include "paper/held.h"

namespace incise {
inline namespace v0 {
namespace paper {

/// How freely a vertex may move, the freest first.
enum class VertexClass : std::uint8_t {
  kInside,   ///< no boundary: anywhere
  kSurface,  ///< one smooth surface: along it
  kContour,  ///< two surfaces meet, or one folds: along the line
  kCorner,   ///< more than two lines, a line that ends or turns, or an unclear place: nowhere
};

/// Finds on what a vertex lies. Keeps scratch memory and the last answer.
///
/// A boundary edge belongs to a contour where its two faces carry different tags (skin and wall, walls of two strokes)
/// or meet at a sharp angle; that makes the front, where both sides of a wall meet, a contour too. Vertices on a
/// border between regions, pinched ones and those where two cavities touch are corners.
/// **Source:** Paper §2.5 (inside, surface and contour vertices). Differs: corners, which the paper does not name.
class ClassFinder {
 public:
  /// Vertices that are held count as corners; `held` must outlive the finder.
  explicit ClassFinder(const Held* held = nullptr) : held_(held) {}
  /// Cost: O(star), about 0.5 µs.
  VertexClass classify(const TetMesh& mesh, VertexId vertex);

  /// Of the last vertex, where it has boundary and was no unclear place: its neighbours along the boundary, in the
  /// order of its fan, and those of them that contours join to it.
  [[nodiscard]] const std::vector<VertexId>& rim() const { return rim_; }
  [[nodiscard]] const std::vector<VertexId>& contour() const { return contour_; }

 private:
  bool walk_fan(const TetMesh& mesh, VertexId vertex, Side first);
  void find_contour(const TetMesh& mesh);
  [[nodiscard]] bool turns_sharply(const TetMesh& mesh, VertexId vertex) const;

  const Held* held_;
  StarWalker walker_;
  std::vector<Side> fan_;      // boundary faces around the vertex, in order
  std::vector<VertexId> rim_;  // fan_[i] lies between rim_[i] and rim_[i + 1]
  std::vector<VertexId> contour_;
};

/// The boundary faces of a vertex in its star: the first one, and their number.
struct BoundaryFaces {
  Side first;
  unsigned count = 0;
};
BoundaryFaces find_boundary_faces(const TetMesh& mesh, VertexId vertex, const std::vector<TetId>& star);

/// Twice the area of a face, as a vector that points outwards.
Vec3 area_vector(const TetMesh& mesh, Side face);

/// Whether two faces with these area vectors lie on one smooth surface. Faces without area are on none.
inline bool is_smooth(const Vec3& a, const Vec3& b) {
  return a.dot(b) > kSharpCosine * a.norm() * b.norm();
}

}  // namespace paper
}  // namespace v0
}  // namespace incise
