// SPDX-License-Identifier: Apache-2.0
// Whether a face lies between the two sides is a parity: crossings of the way from one tet through the face to the
// other, with exact signs (docs/internals.md, 3.12).
#include "paper/sheet_sides.h"

#include <algorithm>
#include <cmath>

#include "cut/sheet_crossing.h"
#include "paper/constants.h"

namespace incise {
inline namespace v0 {

namespace {

/// The keys of centres: above those of vertices and of points of sheets.
constexpr std::uint64_t kFirstCentre = std::uint64_t{1} << 62U;

/// What the collision points of a cut tell of its faces.
class SheetSides {
 public:
  SheetSides(const TetMesh& mesh, const std::vector<CollisionPoint>& points, double coincidence,
             const SheetSoFar& sheet)
      : mesh_(mesh), points_(points), coincidence_(coincidence), sheet_(sheet) {}

  /// Whether the sheet turns sharply between the vertices of a face.
  [[nodiscard]] bool is_at_turn(Side side) const {
    std::vector<Vec3> normals;
    for (const VertexId v : mesh_.vertices(side)) {
      const auto at = std::lower_bound(points_.begin(), points_.end(), v,
                                       [](const CollisionPoint& point, VertexId w) { return point.vertex < w; });
      if (at == points_.end() || at->vertex != v) continue;
      for (const Vec3& normal : normals) {
        if (std::abs(normal.dot(at->normal)) < kJoinCosine) return true;
      }
      normals.push_back(at->normal);
    }
    return false;
  }
  /// Whether the sheet, as far as it is known, reaches all vertices of a face.
  [[nodiscard]] bool is_known_at(Side side) const {
    const auto v = mesh_.vertices(side);
    return std::all_of(v.begin(), v.end(), [&](VertexId w) {
      return sheet_.whole().tree().closest(mesh_.rest(w), coincidence_).is_valid();
    });
  }
  /// Whether the sheet passes between the tets on both sides of a face.
  [[nodiscard]] bool is_between_sides(const IncisionFace& face) const {
    const SosPoint through = middle_of(mesh_.vertices(face.a), kFirstCentre);
    const SosPoint a = place_of(face.a, kFirstCentre + 1), b = place_of(face.b, kFirstCentre + 2);
    const Sheet& sheet = sheet_.whole();
    return (count_crossings(sheet, a, through) + count_crossings(sheet, through, b)) % 2 != 0;
  }

 private:
  /// Where the tet of a side lies: the corner opposite, or, if that lies on the sheet, too, its centre.
  [[nodiscard]] SosPoint place_of(Side side, std::uint64_t key) const {
    const Vec3& corner = mesh_.rest(mesh_.vertices(side.tet())[side.side()]);
    if (!sheet_.whole().tree().closest(corner, coincidence_).is_valid()) return {corner, key};
    return middle_of(mesh_.vertices(side.tet()), key);
  }
  template <class Vertices>
  [[nodiscard]] SosPoint middle_of(const Vertices& vertices, std::uint64_t key) const {
    Vec3 sum = Vec3::Zero();
    for (const VertexId v : vertices) sum += mesh_.rest(v);
    return {sum / static_cast<double>(vertices.size()), key};
  }

  const TetMesh& mesh_;
  const std::vector<CollisionPoint>& points_;
  double coincidence_;
  const SheetSoFar& sheet_;
};

}  // namespace

void keep_between_sides(const TetMesh& mesh, const std::vector<CollisionPoint>& points, double coincidence,
                        const SheetSoFar& sheet, std::vector<IncisionFace>& incision) {
  const SheetSides sides(mesh, points, coincidence, sheet);
  std::erase_if(incision, [&](const IncisionFace& face) {
    return sides.is_at_turn(face.a) && sides.is_known_at(face.a) && !sides.is_between_sides(face);
  });
}

}  // namespace v0
}  // namespace incise
