// SPDX-License-Identifier: Apache-2.0
// Area of walls now less area before, over the tets that the steps touched: a tet counts as it was before the first of
// them. Steps are walked back from what there is now.
#include "engine/wall_area.h"

#include <algorithm>
#include <vector>

#include "incise/mesh/tet_tables.h"

namespace incise {
inline namespace v0 {
namespace detail {

namespace {

/// Half the area of a tet's sides that are walls of cuts: the other half is across the wound.
double wall_share(const TetMesh& mesh, const TetVertices& vertices, const TetLinks& links) {
  double area = 0;
  for (unsigned side = 0; side < 4; ++side) {
    if (!links[side].is_boundary() || links[side].tag() == 0) continue;
    const auto& [a, b, c] = kSideCorners[side];
    const Vec3& p = mesh.rest(vertices[a]);
    area += 0.25 * (mesh.rest(vertices[b]) - p).cross(mesh.rest(vertices[c]) - p).norm();
  }
  return area;
}

}  // namespace

namespace {

/// Tets that steps touched, first as they are and then, step by step, as they were.
class TouchedTets {
 public:
  TouchedTets(const Journal& journal, std::size_t first_step, const TetMesh& mesh) {
    for (std::size_t i = first_step; i < journal.position(); ++i) {
      const Step& step = journal.step(i);
      step.for_each_tet_before([this](TetId tet) { ids_.push_back(tet); });
      made_.insert(made_.end(), step.new_tets.begin(), step.new_tets.end());
    }
    ids_.insert(ids_.end(), made_.begin(), made_.end());
    std::sort(ids_.begin(), ids_.end());
    ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
    for (const TetId tet : ids_) {
      const bool is_live = mesh.is_live(tet);
      images_.push_back(is_live ? TetImage{tet, mesh.vertices(tet), mesh.links(tet), mesh.region(tet)} : TetImage{});
    }
  }

  void go_back(const Step& step) {
    for (const TetId tet : step.new_tets) at(tet) = {};
    for (std::size_t i = 0; i < step.consumed.size(); ++i) at(step.consumed[i].id) = step.consumed_image(i);
    for (const RewiredTet& tet : step.rewired) at(tet.id).vertices = tet.old_vertices;
    for (const SideImage& image : step.before.sides) at(image.side.tet()).links[image.side.side()] = image.link;
  }
  /// Those in whose slots the steps put others do not count: their vertices' slots may be others' as well.
  void leave_out_made() {
    for (const TetId tet : made_) at(tet) = {};
  }

  [[nodiscard]] double wall_share(const TetMesh& mesh) const {
    double area = 0;
    for (const TetImage& image : images_) {
      if (image.id.is_valid()) area += detail::wall_share(mesh, image.vertices, image.links);
    }
    return area;
  }

 private:
  TetImage& at(TetId tet) {
    return images_[static_cast<std::size_t>(std::lower_bound(ids_.begin(), ids_.end(), tet) - ids_.begin())];
  }

  std::vector<TetId> ids_;        // ascending
  std::vector<TetId> made_;       // by the steps
  std::vector<TetImage> images_;  // beside them; without an id where no tet was
};

}  // namespace

double wall_growth(const Journal& journal, std::size_t first_step, const TetMesh& mesh) {
  TouchedTets tets(journal, first_step, mesh);
  const double now = tets.wall_share(mesh);
  for (std::size_t i = journal.position(); i-- > first_step;) tets.go_back(journal.step(i));
  tets.leave_out_made();
  return now - tets.wall_share(mesh);
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
