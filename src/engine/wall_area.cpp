// SPDX-License-Identifier: Apache-2.0
// Area of walls now less area before, over the tets that the steps touched: a tet counts as it was before the first of
// them.
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

double wall_growth(const Journal& journal, std::size_t first_step, const TetMesh& mesh) {
  std::vector<const TetImage*> before;  // as they were before the first step that touched them
  std::vector<TetId> touched, made;     // by the steps themselves: these had no wall before them
  for (std::size_t i = first_step; i < journal.position(); ++i) {
    for (const TetImage& image : journal.step(i).before.tets) {
      before.push_back(&image);
      touched.push_back(image.id);
    }
    const std::vector<TetId>& news = journal.step(i).new_tets;
    made.insert(made.end(), news.begin(), news.end());
  }
  touched.insert(touched.end(), made.begin(), made.end());
  const auto has_lower_id = [](const TetImage* a, const TetImage* b) { return a->id.value < b->id.value; };
  std::stable_sort(before.begin(), before.end(), has_lower_id);
  const auto has_same_id = [](const TetImage* a, const TetImage* b) { return a->id == b->id; };
  before.erase(std::unique(before.begin(), before.end(), has_same_id), before.end());
  const auto is_lower = [](TetId a, TetId b) { return a.value < b.value; };
  std::sort(touched.begin(), touched.end(), is_lower);
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());

  double growth = 0;
  for (const TetId id : touched) {
    if (mesh.is_live(id)) growth += wall_share(mesh, mesh.vertices(id), mesh.links(id));
  }
  std::sort(made.begin(), made.end(), is_lower);
  const auto was_new = [&](TetId id) { return std::binary_search(made.begin(), made.end(), id, is_lower); };
  for (const TetImage* image : before) {
    if (image->vertices[0].is_valid() && !was_new(image->id)) {
      growth -= wall_share(mesh, image->vertices, image->links);
    }
  }
  return growth;
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
