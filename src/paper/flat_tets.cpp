// SPDX-License-Identifier: Apache-2.0
// A tet along the sheet is asked which lip it is on, by walls of incisions beside it; that lip's side is opened and
// the other stays joined (docs/internals.md, 3.12).
#include "paper/flat_tets.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "paper/beside_sheet.h"
#include "paper/constants.h"
#include "paper/paper_classes.h"

namespace incise {
inline namespace v0 {

namespace {

/// Which lip of an incision a tet along the sheet is on: that below the sheet, that above, both, as what is left
/// between two walls, or an older one that the stroke crosses there.
enum class Lip : std::uint8_t { kNone, kBelow, kAbove, kBoth, kCrossed };

/// Tets along a sheet, and which of their faces the incision passes.
class FlatTets {
 public:
  FlatTets(const TetMesh& mesh, const Neighbourhood& near, const std::vector<CollisionPoint>& points,
           const Sheet& sheet, std::uint32_t tag, StarWalker& walker)
      : mesh_(mesh), near_(near), points_(points), sheet_(sheet), tag_(tag), walker_(walker) {}

  /// Whether the incision passes between two tets, for all that they tell.
  [[nodiscard]] bool may_open(const IncisionFace& face) const {
    const Lip a = lip_of(face.a.tet()), b = lip_of(face.b.tet());
    if (is_known(a) && a == b) return false;
    return may_open(face.a, a) && may_open(face.b, b);
  }

 private:
  static bool is_known(Lip lip) { return lip == Lip::kBelow || lip == Lip::kAbove; }

  [[nodiscard]] bool are_on(TetId tet) const {
    const TetVertices& v = mesh_.vertices(tet);
    return std::all_of(v.begin(), v.end(), [&](VertexId w) { return near_.is_on[w.value] != 0; });
  }
  /// The lip that a tet along the sheet is on: none where no wall of an incision goes along it there.
  [[nodiscard]] Lip lip_of(TetId tet) const {
    if (!is_flat(tet)) return Lip::kNone;
    if (is_at_turn(tet)) return Lip::kCrossed;
    const double least = are_on(tet) ? 0 : kAlongCosine;
    const Vec3 normal = normal_at(tet);
    bool has_wall_above = false, has_wall_below = false, is_across = false;
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh_.links(tet)[s];
      if (!link.is_boundary() || link.tag() == 0) continue;
      const double height = height_of({tet, s}, normal);
      has_wall_above = has_wall_above || height > least;
      has_wall_below = has_wall_below || height < -least;
      is_across = is_across || (link.tag() != tag_ && std::abs(height) < kCrossingCosine);
    }
    if (is_across && is_crossed_now(tet)) return Lip::kCrossed;
    if (has_wall_above && has_wall_below) return Lip::kBoth;
    return has_wall_above ? Lip::kBelow : has_wall_below ? Lip::kAbove : Lip::kNone;
  }
  /// Whether the incision passes along a side of a tet, which is on a lip.
  [[nodiscard]] bool may_open(Side side, Lip lip) const {
    if (lip == Lip::kBoth) return false;
    if (lip == Lip::kCrossed || (lip == Lip::kNone && !are_on(side.tet()))) return true;
    const bool looks_up = height_of(side, normal_at(side.tet())) > 0;
    return looks_up ? lip != Lip::kAbove : lip == Lip::kAbove;
  }
  [[nodiscard]] double height_of(Side side, const Vec3& normal) const {
    return paper::area_vector(mesh_, side).normalized().dot(normal);
  }
  /// Whether the stroke has made a point of a tet, where it crosses tissue.
  [[nodiscard]] bool is_crossed_now(TetId tet) const {
    const TetVertices& v = mesh_.vertices(tet);
    return std::any_of(v.begin(), v.end(), [&](VertexId w) {
      const CollisionPoint* point = find(w);
      return point != nullptr && point->is_split;
    });
  }
  /// Whether the sheet turns sharply between the corners of a tet: it spans them, and does not lie along the sheet.
  [[nodiscard]] bool is_at_turn(TetId tet) const {
    const Vec3 normal = normal_at(tet);
    const TetVertices& v = mesh_.vertices(tet);
    return std::any_of(v.begin(), v.end(), [&](VertexId w) {
      const CollisionPoint* point = find(w);
      return point != nullptr && std::abs(point->normal.dot(normal)) < kJoinCosine;
    });
  }
  [[nodiscard]] bool is_flat(TetId tet) const {
    const TetVertices& v = mesh_.vertices(tet);
    return std::all_of(v.begin(), v.end(), [&](VertexId w) { return may_lie_on(w); });
  }
  [[nodiscard]] const CollisionPoint* find(VertexId vertex) const {
    const auto at = std::lower_bound(points_.begin(), points_.end(), vertex,
                                     [](const CollisionPoint& point, VertexId w) { return point.vertex < w; });
    return at != points_.end() && at->vertex == vertex ? &*at : nullptr;
  }
  /// The unit normal of the sheet at a tet: as it was at one of its collision points, or as it is nearby.
  [[nodiscard]] Vec3 normal_at(TetId tet) const {
    for (const VertexId v : mesh_.vertices(tet)) {
      if (const CollisionPoint* point = find(v)) return point->normal;
    }
    const auto hit = sheet_.tree().closest(mesh_.rest(mesh_.vertices(tet)[0]), std::numeric_limits<double>::max());
    return sheet_.normal(hit.triangle).normalized();
  }
  /// Whether a vertex is a collision point, or is one on a wall that this sheet goes along, or would if it went on.
  [[nodiscard]] bool may_lie_on(VertexId vertex) const {
    return near_.is_on[vertex.value] != 0 || ((mesh_.shape_of(vertex) & shape::kWall) != 0 &&
                                              incise::may_lie_on(mesh_, sheet_, vertex, kMostBend, walker_));
  }

  const TetMesh& mesh_;
  const Neighbourhood& near_;
  const std::vector<CollisionPoint>& points_;
  const Sheet& sheet_;
  std::uint32_t tag_;
  StarWalker& walker_;
};

}  // namespace

void keep_flat_tets_joined(const TetMesh& mesh, const Neighbourhood& near, const std::vector<CollisionPoint>& points,
                           const Sheet& sheet, std::uint32_t tag, StarWalker& walker,
                           std::vector<IncisionFace>& incision) {
  const FlatTets flat(mesh, near, points, sheet, tag, walker);
  std::erase_if(incision, [&](const IncisionFace& face) { return !flat.may_open(face); });
}

}  // namespace v0
}  // namespace incise
