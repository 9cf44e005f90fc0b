// SPDX-License-Identifier: Apache-2.0
// Which vertex may merge into which, and what a merge keeps.
#include "improve/edge_collapse.h"

#include <optional>

#include "improve/maintainer_cases.h"

namespace incise::test::edge_collapse_test {
namespace {

/// A cube of 2³ cells whose vertices are at multiples of a half, cut along x = 0.5 on faces of the mesh.
TetMesh half_cube() {
  return cut_mesh(kuhn_cube(2), {{Vec3(1, 0, 0), 0.5}}, 0.2);
}

struct Merged {
  bool is_done = false;
  Step step;
};

/// Tries the edges of the worst tet at a vertex.
Merged improve_at(TetMesh& mesh, VertexId v) {
  const std::vector<TetId> star = star_of(mesh, v);
  const TetId worst = *std::min_element(star.begin(), star.end(),
                                        [&](TetId a, TetId b) { return ratio_of(mesh, a) < ratio_of(mesh, b); });
  CareOf care(mesh);
  EdgeCollapser collapser;
  const bool is_done = collapser.improve(care.care, worst);
  EXPECT_EQ(care.statistics.collapsed_edges, is_done ? 1U : 0U);
  return {is_done, care.commit()};
}

/// A vertex put near one end of an edge is merged away, and the mesh is as it was.
void expect_undone(TetMesh mesh, const Vec3& end, const Vec3& other) {
  const std::size_t tets = mesh.tet_count();
  const double volume = volume_of(mesh);
  const auto shapes = shape_list(mesh);
  const VertexId extra = split_edge_at(mesh, end, other, 0.05);
  ASSERT_GT(mesh.tet_count(), tets);
  const Merged merged = improve_at(mesh, extra);
  ASSERT_TRUE(merged.is_done);
  EXPECT_EQ(merged.step.died, std::vector<VertexId>{extra});
  EXPECT_TRUE(shape_list(mesh) == shapes);
  expect_valid(mesh, volume);
}

TEST(EdgeCollapse, takes_a_vertex_beside_a_corner_into_the_corner) {
  const TetMesh mesh = build(kuhn_cube(2));
  expect_undone(mesh, Vec3(0, 0, 0), Vec3(0.5, 0, 0));      // along the cube's edge
  expect_undone(mesh, Vec3(0, 0, 0), Vec3(0.5, 0.5, 0));    // in its face
  expect_undone(mesh, Vec3(0, 0, 0), Vec3(0.5, 0.5, 0.5));  // inside
}

TEST(EdgeCollapse, takes_an_interior_vertex_into_skin_edges_and_other_interior_ones) {
  const TetMesh mesh = build(kuhn_cube(2));
  expect_undone(mesh, Vec3(0.5, 0.5, 0), Vec3(0.5, 0.5, 0.5));
  expect_undone(mesh, Vec3(0.5, 0, 0), Vec3(0.5, 0.5, 0.5));
  expect_undone(mesh, Vec3(0.5, 0.5, 0.5), Vec3(0.5, 0.5, 0));
}

TEST(EdgeCollapse, takes_a_vertex_of_the_skin_along_the_skin_alone) {
  const TetMesh mesh = build(kuhn_cube(2));
  expect_undone(mesh, Vec3(0.5, 0.5, 0), Vec3(0.5, 0, 0));
  expect_undone(mesh, Vec3(0.5, 0, 0), Vec3(0.5, 0.5, 0));
}

TEST(EdgeCollapse, takes_a_contour_vertex_along_the_contour) {
  const TetMesh mesh = half_cube();
  expect_undone(mesh, Vec3(0.5, 0.5, 0), Vec3(0.5, 0, 0));
  expect_undone(mesh, Vec3(0.5, 0, 0), Vec3(0.5, 0.5, 0));
}

TEST(EdgeCollapse, takes_a_vertex_of_a_wall_along_the_wall) {
  const TetMesh mesh = half_cube();
  expect_undone(mesh, Vec3(0.5, 0.5, 0.5), Vec3(0.5, 0, 0.5));
  expect_undone(mesh, Vec3(0.5, 0.5, 0), Vec3(0.5, 0.5, 0.5));
}

TEST(EdgeCollapse, does_not_cross_borders_between_regions) {
  TetSoup soup = kuhn_cube(2);
  for (const auto& tet : soup.tets) {
    soup.regions.push_back(soup.points[tet[0]].x() + soup.points[tet[3]].x() < 1 ? 1 : 2);
  }
  TetMesh mesh = build(std::move(soup));
  const VertexId extra = split_edge_at(mesh, Vec3(0.5, 0.5, 0.5), Vec3(0.5, 0.5, 0), 0.05);
  const std::uint64_t hash = mesh.hash();
  EXPECT_FALSE(improve_at(mesh, extra).is_done);
  EXPECT_EQ(mesh.hash(), hash);
  expect_valid(mesh, 1.0);
}

TEST(EdgeCollapse, leaves_a_good_mesh_alone) {
  TetMesh mesh = build(kuhn_cube(3));
  const std::uint64_t hash = mesh.hash();
  for (const VertexId v : vertices_of(mesh)) {
    EXPECT_FALSE(improve_at(mesh, v).is_done);
    CareOf care(mesh);
    EXPECT_FALSE(EdgeCollapser().thin_out(care.care, v));
    care.commit();
  }
  EXPECT_EQ(mesh.hash(), hash);
  expect_valid(mesh, 1.0);
}

TEST(ThinningOut, takes_a_vertex_that_is_in_nobodys_way) {
  TetMesh mesh = build(kuhn_cube(2));
  const auto shapes = shape_list(mesh);
  const VertexId extra = split_edge_at(mesh, Vec3(0, 0, 0), Vec3(0.5, 0.5, 0.5), 0.3);
  CareOf care(mesh);
  EXPECT_TRUE(EdgeCollapser().thin_out(care.care, extra));
  care.commit();
  EXPECT_TRUE(shape_list(mesh) == shapes);
  expect_valid(mesh, 1.0);
}

// --- every merge on cut bodies
// -----------------------------------------------------------------------------------------------

/// One merge, looked at from all sides.
class Merge {
 public:
  Merge(const TetMesh& mesh, VertexId from)
      : mesh_(mesh), from_(from), place_(mesh.rest(from)), bits_(mesh.shape_of(from)), star_(star_of(mesh, from)) {
    surfaces_ = surfaces_at(mesh, from, star_);
    for (const TetId tet : star_) longest_ = std::max(longest_, longest_from(tet, from));
    volume_ = volume_of(mesh);
    for (const TetId tet : star_) {
      for (const VertexId v : mesh.vertices(tet)) worst_around_.emplace_back(v, worst_ratio(mesh, star_of(mesh, v)));
    }
    worst_ = worst_ratio(mesh, star_);
  }

  void expect_allowed(const Step& step) const {
    const VertexId into = find_into(step);
    ASSERT_TRUE(into.is_valid());
    EXPECT_NE(surfaces_.mobility, Mobility::kFixed) << "a corner is gone";
    EXPECT_EQ(bits_ & ~mesh_.shape_of(into), 0) << "a surface was left";
    const VertexSurfaces found = surfaces_at(mesh_, into, star_of(mesh_, into));
    EXPECT_GE(found.count, surfaces_.count);
    if (surfaces_.is_front()) {
      EXPECT_NE(mesh_.shape_of(into) & shape::kFront, 0);
    }
    if (surfaces_.mobility == Mobility::kLine && surfaces_.is_flat() && !surfaces_.is_front()) {
      EXPECT_LT((mesh_.rest(into) - place_).cross(surfaces_.along).norm(), 1e-12) << "the line was left";
    }
    if (surfaces_.mobility == Mobility::kSurface && surfaces_.is_flat()) {
      EXPECT_NEAR((mesh_.rest(into) - place_).dot(surfaces_.along), 0, 1e-12) << "the plane was left";
    }
    EXPECT_NEAR(volume_of(mesh_), volume_, 1e-12 * volume_);
    for (const ProducedTet& tet : step.edit_produced) {
      EXPECT_LE(longest_from(tet.id, into), 1.5 * longest_ * (1 + 1e-12));
    }
    expect_no_worse(into);
  }

 private:
  void expect_no_worse(VertexId into) const {
    double before = worst_;
    for (const auto& [v, worst] : worst_around_) before = v == into ? std::min(before, worst) : before;
    EXPECT_GE(worst_ratio(mesh_, star_of(mesh_, into)), before);
  }
  [[nodiscard]] double longest_from(TetId tet, VertexId v) const {
    double longest = 0;
    for (const VertexId w : mesh_.vertices(tet)) longest = std::max(longest, (mesh_.rest(w) - mesh_.rest(v)).norm());
    return longest;
  }
  /// The vertex that took the place of the one that is gone.
  [[nodiscard]] VertexId find_into(const Step& step) const {
    for (const ConsumedTet& old : step.edit_consumed) {
      const auto same = std::find_if(step.edit_produced.begin(), step.edit_produced.end(),
                                     [&](const ProducedTet& tet) { return tet.id == old.id; });
      const auto at = std::find(old.vertices.begin(), old.vertices.end(), from_);
      if (same != step.edit_produced.end() && at != old.vertices.end()) {
        return same->vertices[static_cast<std::size_t>(at - old.vertices.begin())];
      }
    }
    return {};
  }

  const TetMesh& mesh_;
  VertexId from_;
  Vec3 place_;
  unsigned bits_;
  std::vector<TetId> star_;
  VertexSurfaces surfaces_;
  double longest_ = 0, volume_ = 0, worst_ = 0;
  std::vector<std::pair<VertexId, double>> worst_around_;
};

/// Thins out what a cut made, vertex by vertex.
unsigned thin_out_all(TetMesh& mesh) {
  unsigned merged = 0;
  EdgeCollapser collapser;
  for (const VertexId v : vertices_of(mesh)) {
    if (!mesh.is_live(v) || (mesh.origin(v).is_valid() && mesh.shape_of(v) == 0)) continue;
    const Merge merge(mesh, v);
    CareOf care(mesh);
    const bool is_done = collapser.thin_out(care.care, v);
    const Step step = care.commit();
    if (!is_done) continue;
    merge.expect_allowed(step);
    for (const MovedVertex& moved : step.moved) {
      for (const TetId tet : star_of(mesh, moved.id)) {
        EXPECT_NE(std::find(care.changed.begin(), care.changed.end(), tet), care.changed.end()) << "to be judged anew";
      }
    }
    ++merged;
  }
  return merged;
}

TEST(ThinningOut, of_plane_cuts_keeps_classes_lengths_volumes_and_the_worst) {
  TetMesh mesh = cut_mesh(jittered_cube(4, 5), {{Vec3(1, 0.2, 0.1), 0.6}, {Vec3(0.1, 1, 0.2), 0.6}});
  const double skin = boundary_area(mesh, 0), first = boundary_area(mesh, 1), second = boundary_area(mesh, 2);
  const std::vector<double> volumes = piece_volumes(mesh);
  const std::vector<int> shapes = euler_characteristics(mesh);
  EXPECT_GT(thin_out_all(mesh), 50U);
  EXPECT_NEAR(boundary_area(mesh, 0), skin, 1e-12);
  EXPECT_NEAR(boundary_area(mesh, 1), first, 1e-12);
  EXPECT_NEAR(boundary_area(mesh, 2), second, 1e-12);
  EXPECT_EQ(euler_characteristics(mesh), shapes);
  expect_pieces(mesh, volumes, 1e-13);
  expect_valid(mesh, 1.0);
}

TEST(ThinningOut, of_a_round_body_keeps_classes_lengths_volumes_and_the_worst) {
  TetMesh mesh = cut_mesh(ball(6), {{Vec3(0.3, 0.5, 0.9), 0.1}});
  const std::vector<double> volumes = piece_volumes(mesh);
  const double skin = boundary_area(mesh, 0);
  EXPECT_GT(thin_out_all(mesh), 50U);
  EXPECT_NEAR(boundary_area(mesh, 0), skin, 0.02 * skin);
  expect_pieces(mesh, volumes, 1e-12);
  expect_valid(mesh, volume_of(mesh));
}

TEST(ThinningOut, of_a_cut_that_ends_inside_keeps_the_front) {
  TetMesh mesh = cut_mesh(jittered_cube(4, 4), partial_stroke());
  const double wall = boundary_area(mesh, 1);
  EXPECT_GT(thin_out_all(mesh), 20U);
  EXPECT_NEAR(boundary_area(mesh, 1), wall, 0.02 * wall);
  EXPECT_EQ(piece_volumes(mesh).size(), 1U);
  expect_valid(mesh, 1.0);
}

}  // namespace
}  // namespace incise::test::edge_collapse_test
