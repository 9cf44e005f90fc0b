// SPDX-License-Identifier: Apache-2.0
// The energy of a star, and what smoothing may and may not do to a vertex.
#include "improve/smooth.h"

#include <Eigen/Cholesky>
#include <limits>

#include "improve/support.h"
#include "incise/geom/quality.h"

namespace incise::test::smooth_test {
namespace {

// --- the energy of a star
// ----------------------------------------------------------------------------------------------------

/// An octahedron's faces around its centre, stretched by `scale`.
StarEnergy octahedron(const Vec3& scale) {
  StarEnergy energy;
  for (const double x : {1.0, -1.0}) {
    for (const double y : {1.0, -1.0}) {
      for (const double z : {1.0, -1.0}) {
        const Vec3 p(x * scale.x(), 0, 0), q(0, y * scale.y(), 0), r(0, 0, z * scale.z());
        // Seen from the centre: its normal points inwards.
        x* y* z > 0 ? energy.add(p, r, q) : energy.add(p, q, r);
      }
    }
  }
  return energy;
}

StarEnergy lopsided() {
  return octahedron(Vec3(1, 0.6, 1.7));
}

TEST(StarEnergy, is_the_sum_of_the_mean_ratios_to_the_power_of_minus_six) {
  const Vec3 p(0.1, 0, 0), q(1, 0.2, 0.1), r(0.3, 0.9, -0.1), centre(0.4, 0.3, 0.8);
  StarEnergy energy;
  energy.add(p, q, r);
  ASSERT_EQ(energy.size(), 1U);
  const double q3 = mean_ratio_cubed(p, q, r, centre);
  ASSERT_GT(q3, 0);
  EXPECT_NEAR(energy.energy(centre) * q3 * q3 / (432.0 * 432.0), 1.0, 1e-12);
  energy.add(p, q, r);
  EXPECT_NEAR(energy.energy(centre) * q3 * q3 / (432.0 * 432.0), 2.0, 1e-12);
  EXPECT_NEAR(energy.evaluate(centre).energy / energy.energy(centre), 1.0, 1e-14);
}

TEST(StarEnergy, is_infinite_where_a_tet_has_no_volume) {
  const StarEnergy energy = lopsided();
  EXPECT_LT(energy.energy(Vec3(0.1, 0.1, 0.1)), std::numeric_limits<double>::infinity());
  EXPECT_EQ(energy.energy(Vec3(2, 0, 0)), std::numeric_limits<double>::infinity());
  StarEnergy flat;
  flat.add(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  EXPECT_EQ(flat.energy(Vec3(0.3, 0.3, 0)), std::numeric_limits<double>::infinity());
  EXPECT_LT(flat.energy(Vec3(0.3, 0.3, 1)), std::numeric_limits<double>::infinity());
}

TEST(StarEnergy, has_the_gradient_of_its_differences) {
  const StarEnergy energy = lopsided();
  Random random(1);
  for (unsigned i = 0; i < 50; ++i) {
    const Vec3 at = random.point(-0.15, 0.15);
    const Vec3 gradient = energy.evaluate(at).gradient;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 h = Vec3::Zero();
      h[axis] = 1e-5;
      const double difference = (energy.energy(at + h) - energy.energy(at - h)) / 2e-5;
      EXPECT_NEAR(gradient[axis], difference, 1e-5 * gradient.norm() + 1e-3);
    }
  }
}

TEST(StarEnergy, has_a_positive_definite_hessian_that_bounds_the_curvature) {
  const StarEnergy energy = lopsided();
  Random random(2);
  for (unsigned i = 0; i < 50; ++i) {
    const Vec3 at = random.point(-0.2, 0.2);
    const Eigen::Matrix3d hessian = energy.evaluate(at).hessian;
    EXPECT_LT((hessian - hessian.transpose()).norm(), 1e-12 * hessian.norm());
    ASSERT_EQ(hessian.llt().info(), Eigen::Success);
    const Vec3 d = random.point(-1, 1);
    const double h = 1e-4;
    const double curvature = (energy.energy(at + h * d) - 2 * energy.energy(at) + energy.energy(at - h * d)) / (h * h);
    EXPECT_GT(d.dot(hessian * d), 0.99 * curvature) << "what is left out is negative";
  }
}

TEST(StarEnergy, of_one_face_is_least_at_the_apex_of_the_regular_tet) {
  const Vec3 p(1, 0, 0), q(-0.5, std::sqrt(0.75), 0), r(-0.5, -std::sqrt(0.75), 0), apex(0, 0, std::sqrt(2.0));
  StarEnergy energy;
  energy.add(p, q, r);
  EXPECT_NEAR(energy.energy(apex), 432.0 * 432.0, 1e-6);
  EXPECT_LT(energy.evaluate(apex).gradient.norm(), 1e-8 * energy.energy(apex));
  Vec3 at(0.3, -0.2, 0.5);
  for (unsigned i = 0; i < 60; ++i) {
    const Vec3 step = newton_step(energy.evaluate(at), {});
    double share = 1;
    while (!(energy.energy(at + share * step) < energy.energy(at)) && share > 1e-6) share /= 2;
    at += share * step;
  }
  EXPECT_LT((at - apex).norm(), 1e-4);
}

TEST(StarEnergy, of_an_octahedron_is_least_at_its_centre) {
  const StarEnergy energy = octahedron(Vec3(1, 1, 1));
  EXPECT_LT(energy.evaluate(Vec3::Zero()).gradient.norm(), 1e-8);
  Random random(3);
  for (unsigned i = 0; i < 20; ++i) {
    EXPECT_GT(energy.energy(random.point(-0.2, 0.2)), energy.energy(Vec3::Zero()));
  }
}

TEST(NewtonStep, goes_downhill_within_what_the_vertex_may_do) {
  const StarEnergy::Value here = lopsided().evaluate(Vec3(0.1, -0.07, 0.2));
  VertexSurfaces surfaces;
  EXPECT_LT(newton_step(here, surfaces).dot(here.gradient), 0);
  surfaces.along = Vec3(2, -1, 3).normalized();
  surfaces.mobility = Mobility::kSurface;
  const Vec3 sliding = newton_step(here, surfaces);
  EXPECT_LT(sliding.dot(here.gradient), 0);
  EXPECT_NEAR(sliding.dot(surfaces.along), 0, 1e-15);
  surfaces.mobility = Mobility::kLine;
  const Vec3 along = newton_step(here, surfaces);
  EXPECT_LT(along.dot(here.gradient), 0);
  EXPECT_LT(along.cross(surfaces.along).norm(), 1e-15);
  surfaces.mobility = Mobility::kFixed;
  EXPECT_EQ(newton_step(here, surfaces), Vec3::Zero());
}

// --- smoothing
// ---------------------------------------------------------------------------------------------------------------

/// A cube of 2³ cells with one of its vertices somewhere else.
TetMesh cube_with(const Vec3& home, const Vec3& place) {
  TetSoup soup = kuhn_cube(2);
  for (Vec3& p : soup.points) {
    if (p == home) p = place;
  }
  return build(std::move(soup));
}

/// Tries to smooth the vertex at a place; returns where it went.
Vec3 smooth_at(TetMesh& mesh, const Vec3& place, bool expected = true) {
  const VertexId v = nearest_vertex(mesh, place);
  const double before = worst_ratio(mesh, star_of(mesh, v));
  CareOf care(mesh);
  Smoother smoother;
  EXPECT_EQ(smoother.improve(care.care, v), expected);
  EXPECT_EQ(care.statistics.moved_vertices, expected ? 1U : 0U);
  if (expected) {
    EXPECT_EQ(care.changed, star_of(mesh, v));
    EXPECT_GT(worst_ratio(mesh, care.changed), before);
    EXPECT_GT(care.statistics.work_units, care.changed.size());
  }
  care.commit();
  expect_valid(mesh, 1.0);
  return mesh.rest(v);
}

TEST(Smoothing, brings_an_interior_vertex_towards_the_middle) {
  TetMesh mesh = cube_with(Vec3(0.5, 0.5, 0.5), Vec3(0.75, 0.62, 0.55));
  EXPECT_LT((smooth_at(mesh, Vec3(0.75, 0.62, 0.55)) - Vec3(0.5, 0.5, 0.5)).norm(), 0.1);
}

TEST(Smoothing, leaves_a_vertex_in_the_best_place_alone) {
  TetMesh mesh = build(kuhn_cube(2));
  EXPECT_EQ(smooth_at(mesh, Vec3(0.5, 0.5, 0.5), false), Vec3(0.5, 0.5, 0.5));
}

TEST(Smoothing, slides_a_vertex_of_flat_skin_in_its_plane) {
  TetMesh mesh = cube_with(Vec3(0.5, 0.5, 0), Vec3(0.8, 0.65, 0));
  const Vec3 place = smooth_at(mesh, Vec3(0.8, 0.65, 0));
  EXPECT_EQ(place.z(), 0.0);
  EXPECT_LT((place - Vec3(0.5, 0.5, 0)).norm(), 0.25);
}

TEST(Smoothing, slides_a_vertex_of_an_edge_along_it) {
  TetMesh mesh = cube_with(Vec3(0.5, 0, 0), Vec3(0.85, 0, 0));
  const Vec3 place = smooth_at(mesh, Vec3(0.85, 0, 0));
  EXPECT_EQ(place.y(), 0.0);
  EXPECT_EQ(place.z(), 0.0);
  EXPECT_LT(place.x(), 0.75);
}

TEST(Smoothing, leaves_corners_alone) {
  TetMesh mesh = cube_with(Vec3(0.5, 0.5, 0.5), Vec3(0.25, 0.25, 0.2));
  EXPECT_EQ(smooth_at(mesh, Vec3(0, 0, 0), false), Vec3(0, 0, 0));
}

/// Smooths every vertex a few times; every accepted move makes the worst of its star better.
unsigned smooth_all(TetMesh& mesh) {
  unsigned moved = 0;
  Smoother smoother;
  for (unsigned round = 0; round < 4; ++round) {
    CareOf care(mesh);
    for (const VertexId v : vertices_of(mesh)) {
      const double before = worst_ratio(mesh, star_of(mesh, v));
      if (!smoother.improve(care.care, v)) continue;
      EXPECT_GT(worst_ratio(mesh, star_of(mesh, v)), before);
      ++moved;
    }
    care.commit();
  }
  return moved;
}

TEST(Smoothing, keeps_plane_walls_skin_and_contours_in_place) {
  const Vec3 normal = Vec3(0.3, 0.5, 0.9).normalized();
  const double offset = 0.8 / Vec3(0.3, 0.5, 0.9).norm();
  TetMesh mesh = cut_mesh(jittered_cube(5, 3), {{normal, offset}});
  const double skin = boundary_area(mesh, 0), wall = boundary_area(mesh, 1);
  const std::vector<double> volumes = piece_volumes(mesh);
  EXPECT_GT(smooth_all(mesh), 100U);
  EXPECT_NEAR(boundary_area(mesh, 0), skin, 1e-12);
  EXPECT_NEAR(boundary_area(mesh, 1), wall, 1e-12);
  mesh.for_each_vertex([&](VertexId v) {
    const Vec3& p = mesh.rest(v);
    if ((mesh.shape_of(v) & shape::kWall) != 0) {
      EXPECT_NEAR(normal.dot(p), offset, 1e-13);
    }
    if ((mesh.shape_of(v) & shape::kSkin) != 0) {
      EXPECT_LT(std::min({p.x(), p.y(), p.z(), 1 - p.x(), 1 - p.y(), 1 - p.z()}), 1e-14);
    }
  });
  expect_pieces(mesh, volumes, 1e-13);
  expect_valid(mesh, 1.0);
}

TEST(Smoothing, keeps_the_volume_under_curved_walls_and_skin) {
  for (TetMesh mesh : {cut_mesh(ball(8), {{Vec3(0.3, 0.5, 0.9), 0.1}}),
                       cut_mesh(jittered_cube(6, 6), coring_stroke(Vec3(0.5, 0.5, 0), 0.3, 24, -0.2, 1.2))}) {
    const std::vector<double> volumes = piece_volumes(mesh);
    const double skin = boundary_area(mesh, 0), wall = boundary_area(mesh, 1);
    EXPECT_GT(smooth_all(mesh), 100U);
    expect_pieces(mesh, volumes, 1e-12);
    EXPECT_NEAR(boundary_area(mesh, 0), skin, 0.01 * skin);
    EXPECT_NEAR(boundary_area(mesh, 1), wall, 0.01 * wall);
    expect_valid(mesh, volume_of(mesh));
  }
}

TEST(Smoothing, keeps_borders_between_regions) {
  TetSoup soup = jittered_cube(4, 7);
  for (const auto& [a, b, c, d] : soup.tets) {
    soup.regions.push_back(std::max({a % 5, b % 5, c % 5, d % 5}) <= 2 ? 1 : 2);
  }
  TetMesh mesh = build(std::move(soup));
  const auto volume_of_one = [&] {
    double sum = 0;
    mesh.for_each_tet([&](TetId tet) { sum += mesh.region(tet) == 1 ? mesh.rest_volume(tet) : 0.0; });
    return sum;
  };
  const double before = volume_of_one();
  EXPECT_GT(smooth_all(mesh), 20U);
  EXPECT_NEAR(volume_of_one(), before, 1e-13);
  expect_valid(mesh, 1.0);
}

// --- on a body that stands deformed
// ------------------------------------------------------------------------------------------

/// Puts a vertex to a place as the mesh stands, at rest it stays: a twin takes its part.
VertexId deform(TetMesh& mesh, VertexId vertex, const Vec3& place) {
  const std::vector<TetId> star = star_of(mesh, vertex);
  Transaction transaction(mesh);
  const VertexId twin = transaction.add_vertex(std::array{vertex}, std::array{1.0}, mesh.rest(vertex), place);
  for (const TetId tet : star) transaction.set_corner(tet, mesh.corner_of(tet, vertex), twin);
  transaction.set_tet_of(twin, star.front());
  transaction.set_shape(twin, mesh.shape_of(vertex));
  transaction.remove_vertex(vertex);
  transaction.commit();
  return twin;
}

double least_current_volume(const TetMesh& mesh, const std::vector<TetId>& tets) {
  double least = std::numeric_limits<double>::infinity();
  for (const TetId tet : tets) {
    const TetVertices& v = mesh.vertices(tet);
    least =
        std::min(least, signed_volume6(mesh.current(v[0]), mesh.current(v[1]), mesh.current(v[2]), mesh.current(v[3])));
  }
  return least;
}
double least_current_volume(const TetMesh& mesh) {
  return least_current_volume(mesh, tets_of(mesh));
}

TEST(SmoothingDeformed, takes_the_current_place_of_the_material_that_it_goes_to) {
  TetMesh mesh = cube_with(Vec3(0.5, 0.5, 0.5), Vec3(0.7, 0.6, 0.55));
  const auto bend = [](const Vec3& p) { return Vec3(2 * p.x() + 1, p.y() - 0.3 * p.x(), 0.5 * p.z() + 0.2 * p.y()); };
  for (const VertexId v : vertices_of(mesh)) deform(mesh, v, bend(mesh.rest(v)));
  const VertexId centre = nearest_vertex(mesh, Vec3(0.7, 0.6, 0.55));
  smooth_at(mesh, mesh.rest(centre));
  EXPECT_GT(least_current_volume(mesh), 0);
  EXPECT_LT((mesh.current(centre) - bend(mesh.rest(centre))).norm(), 1e-14);
}

TEST(SmoothingDeformed, inverts_no_tet_that_stands_upright) {
  TetMesh mesh = build(jittered_cube(5, 8));
  Random random(9);
  for (const VertexId v : vertices_of(mesh)) deform(mesh, v, mesh.rest(v) + random.point(-0.04, 0.04));
  const auto inverted = [&] {
    std::vector<TetId> list;
    for (const TetId tet : tets_of(mesh)) {
      if (!is_sound_now(mesh, mesh.vertices(tet))) list.push_back(tet);
    }
    return list;
  };
  const std::vector<TetId> before = inverted();
  EXPECT_GT(smooth_all(mesh), 50U);
  const std::vector<TetId> after = inverted();
  EXPECT_TRUE(std::includes(before.begin(), before.end(), after.begin(), after.end()));
  expect_valid(mesh, 1.0);
}

TEST(SmoothingDeformed, is_refused_where_it_would_invert_a_tet) {
  const Vec3 place(0.85, 0.62, 0.55);
  const TetMesh mesh = cube_with(Vec3(0.5, 0.5, 0.5), place);
  TetMesh upright = mesh;
  smooth_at(upright, place);
  unsigned refused = 0, accepted = 0;
  Random random(10);
  for (unsigned i = 0; i < 100; ++i) {
    // The star's vertices stand nearer to its centre, or further away: seen from there nothing overlaps.
    TetMesh bent = mesh;
    for (const VertexId v : vertices_of(mesh)) {
      deform(bent, v, place + Vec3(1, 2, 3) + random.real(0.3, 3) * (mesh.rest(v) - place));
    }
    const VertexId centre = nearest_vertex(bent, place);
    const std::vector<TetId> star = star_of(bent, centre);
    ASSERT_GT(least_current_volume(bent, star), 0);
    CareOf care(bent);
    Smoother smoother;
    ++(smoother.improve(care.care, centre) ? accepted : refused);
    care.commit();
    EXPECT_GT(least_current_volume(bent, star), 0);
    expect_valid(bent, 1.0);
  }
  EXPECT_GT(refused, 0U);
  EXPECT_GT(accepted, 0U);
}

// --- material points
// ---------------------------------------------------------------------------------------------------------

TEST(MaterialPoint, is_found_in_the_tet_that_holds_it) {
  const TetMesh mesh = build(jittered_cube(3, 4));
  Random random(5);
  const std::vector<TetId> tets = tets_of(mesh);
  for (unsigned i = 0; i < 50; ++i) {
    const Vec3 place = random.point(0.05, 0.95);
    const MaterialPoint point = locate(mesh, place, tets);
    Vec3 sum = Vec3::Zero();
    for (unsigned c = 0; c < 4; ++c) {
      EXPECT_GE(point.weights[c], -1e-12);
      sum += point.weights[c] * mesh.rest(point.basis[c]);
    }
    EXPECT_LT((sum - place).norm(), 1e-13);
    EXPECT_LT((current_at(mesh, point) - place).norm(), 1e-13);
  }
}

}  // namespace
}  // namespace incise::test::smooth_test
