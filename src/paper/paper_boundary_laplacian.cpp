// SPDX-License-Identifier: Apache-2.0
// Contours move beside the middle of their two neighbours, walls parallel to the plane that fits theirs: first all
// contours, then all walls (docs/paper_map.md, section 3.4).
#include "paper/paper_boundary_laplacian.h"

#include "paper/least_squares_plane.h"
#include "paper/paper_classes.h"
#include "paper/paper_move.h"
#include "paper/paper_stage.h"

namespace incise {
inline namespace v0 {
namespace paper {

Vec3 smooth_on_contour(const Vec3& c, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length2 = along.squaredNorm();
  if (!(length2 > 0)) {
    return c;
  }
  const Vec3 middle = 0.5 * (a + b);
  return c - ((c - middle).dot(along) / length2) * along;
}

Vec3 smooth_on_wall(const Vec3& place, std::span<const Vec3> neighbours) {
  const FittedPlane plane = fit_plane(neighbours);
  const Vec3 way = plane.centre - place;
  return place + (way - way.dot(plane.normal) * plane.normal);
}

namespace {

class BoundarySmoother : private PaperStage {
 public:
  BoundarySmoother(Transaction& transaction, const Held& held) : PaperStage(transaction, held) {}

  MaintainStatistics run(const std::vector<VertexId>& vertices) {
    smooth_all(vertices, VertexClass::kContour);
    smooth_all(vertices, VertexClass::kSurface);
    return done();
  }

 private:
  void smooth_all(const std::vector<VertexId>& vertices, VertexClass which) {
    for (const VertexId v : vertices) {
      const bool is_on_incision = mesh_.is_live(v) && (mesh_.shape_of(v) & shape::kWall) != 0;
      if (is_on_incision && classes_.classify(mesh_, v) == which &&
          move_towards(transaction_, v, which == VertexClass::kContour ? on_contour(v) : on_wall(v), meter_, walker_)) {
        ++done_.moved_vertices;
      }
    }
  }
  [[nodiscard]] Vec3 on_contour(VertexId v) const {
    return smooth_on_contour(mesh_.rest(v), mesh_.rest(classes_.contour()[0]), mesh_.rest(classes_.contour()[1]));
  }
  Vec3 on_wall(VertexId v) {
    neighbours_.clear();
    for (const VertexId other : classes_.rim()) {
      neighbours_.push_back(mesh_.rest(other));
    }
    return smooth_on_wall(mesh_.rest(v), neighbours_);
  }

  ClassFinder classes_{&held_};
  std::vector<Vec3> neighbours_;
};

}  // namespace

MaintainStatistics smooth_boundary(Transaction& transaction, const std::vector<VertexId>& vertices, const Held& held) {
  return BoundarySmoother(transaction, held).run(vertices);
}

}  // namespace paper
}  // namespace v0
}  // namespace incise
