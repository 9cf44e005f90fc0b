// SPDX-License-Identifier: Apache-2.0
// The walk from tet to tet, against a test of every tet.
#include "cut/contact_walk.h"

#include <gtest/gtest.h>

#include <set>

#include "cut/strips.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::contact_walk_test {
namespace {

using Corners = std::array<SosPoint, 4>;

Corners corners_of(const TetMesh& mesh, TetId tet) {
  Corners p;
  for (unsigned c = 0; c < 4; ++c) p[c] = {mesh.rest(mesh.vertices(tet)[c]), mesh.vertices(tet)[c].value};
  return p;
}

bool holds(const Corners& p, const SosPoint& point) {
  bool is_inside = true;
  for (const auto& k : kSideCorners) is_inside &= orient3d_sos(p[k[0]], p[k[1]], p[k[2]], point) < 0;
  return is_inside;
}

// --- locate ----------------------------------------------------------------------------------------------------------

std::set<TetId> tets_that_hold(const TetMesh& mesh, const SosPoint& point) {
  std::set<TetId> found;
  mesh.for_each_tet([&](TetId tet) {
    if (holds(corners_of(mesh, tet), point)) found.insert(tet);
  });
  return found;
}

std::vector<Vec3> random_places(Random& random) {
  std::vector<Vec3> result;
  for (unsigned run = 0; run < 200; ++run) result.push_back(random.point(-0.1, 1.1));
  return result;
}

/// Places on vertices, edges and faces.
std::vector<Vec3> special_places(const TetMesh& mesh) {
  std::vector<Vec3> result;
  mesh.for_each_tet([&](TetId tet) {
    const Corners p = corners_of(mesh, tet);
    result.push_back(p[0].position);
    result.push_back(0.5 * (p[0].position + p[1].position));
    result.push_back(0.25 * p[0].position + 0.25 * p[1].position + 0.5 * p[2].position);
  });
  return result;
}

void expect_located(const TetMesh& mesh, const std::vector<Vec3>& places) {
  SurfaceIndex surface;
  surface.follow(mesh, Journal());
  std::uint64_t key = kFirstBladeKey;
  for (const Vec3& place : places) {
    const SosPoint point{place, key++};
    const auto expected = tets_that_hold(mesh, point);
    const TetId found = locate(mesh, surface, point);
    EXPECT_EQ(found.is_valid(), !expected.empty()) << place.transpose();
    EXPECT_EQ(expected.count(found), expected.size()) << place.transpose();
  }
}

TEST(Locate, finds_the_tet_that_holds_a_point) {
  Random random(1);
  for (const TetSoup& soup : {kuhn_cube(3), jittered_cube(4, 1)}) {
    const TetMesh mesh = build(soup);
    expect_located(mesh, random_places(random));
    expect_located(mesh, special_places(mesh));
  }
}

TEST(Locate, finds_it_behind_walls) {
  Random random(2);
  for (const Profile profile : {Profile::kPaper, Profile::kIncise}) {
    Engine engine = make_engine(jittered_cube(4, 1), 0.2, profile);
    cut(engine, plane(engine, Vec3(1, 0, 0), 0.4));
    cut(engine, plane(engine, Vec3(0.3, 1, 0.2), 0.8));
    cut(engine, plane(engine, Vec3(1, -0.2, 0), 0.6));
    expect_located(engine.mesh(), random_places(random));
  }
}

// --- the walk --------------------------------------------------------------------------------------------------------

bool crosses_a_side(const Corners& p, const SosPoint& a, const SosPoint& b) {
  bool crosses = false;
  for (const auto& k : kSideCorners) crosses |= segment_crosses_triangle(a, b, p[k[0]], p[k[1]], p[k[2]]);
  return crosses;
}

/// Whether a triangle of a strip meets a tet: exact.
bool meets(const Corners& p, const Sheet& sheet, std::uint32_t t) {
  const SosPoint &a = sheet.point(t, 0), &b = sheet.point(t, 1), &c = sheet.point(t, 2);
  bool does_meet = holds(p, a) || crosses_a_side(p, a, b) || crosses_a_side(p, b, c) || crosses_a_side(p, c, a);
  for (const auto& [i, j] : kEdgeCorners) does_meet |= segment_crosses_triangle(p[i], p[j], a, b, c);
  return does_meet;
}

std::set<TetId> tets_that_meet(const TetMesh& mesh, const Sheet& sheet) {
  std::set<TetId> found;
  mesh.for_each_tet([&](TetId tet) {
    const Corners p = corners_of(mesh, tet);
    for (std::uint32_t t = 0; t < sheet.triangle_count(); ++t) {
      if (meets(p, sheet, t)) found.insert(tet);
    }
  });
  return found;
}

/// Follows a sheet strip by strip; nothing is cut.
void expect_walks(const TetMesh& mesh, const Rows& rows) {
  SurfaceIndex surface;
  surface.follow(mesh, Journal());
  SplitTemplates templates;
  ClosedComplex complex(templates);
  ContactWalk walk;
  for (std::uint32_t r = 1; r < rows.size(); ++r) {
    const auto strip = strip_to(rows, r);
    std::set<TetId> met;
    for (const std::uint32_t master : walk.find(mesh, *strip, surface, complex, r)) {
      EXPECT_EQ(complex[master].seen, r);
      EXPECT_TRUE(met.insert(complex.children(complex[master])[0]).second);
    }
    for (const TetId tet : tets_that_meet(mesh, strip->sheet)) EXPECT_EQ(met.count(tet), 1U) << tet.value;
  }
}

TEST(ContactWalk, meets_what_random_strips_meet) {
  Random random(3);
  for (unsigned run = 0; run < 30; ++run) {
    SCOPED_TRACE(run);
    const TetMesh mesh = build(run % 3 == 0 ? kuhn_cube(4) : jittered_cube(4, run));
    expect_walks(mesh, random_rows(random, 5, 2 + run % 4, random.real(0.3, 2)));
  }
}

TEST(ContactWalk, meets_a_body_of_several_pieces) {
  Random random(4);
  Engine engine = make_engine(jittered_cube(4, 1));
  cut(engine, plane(engine, Vec3(1, 0, 0), 0.4));
  cut(engine, plane(engine, Vec3(0.3, 1, 0.2), 0.8));
  for (unsigned run = 0; run < 15; ++run) {
    SCOPED_TRACE(run);
    expect_walks(engine.mesh(), random_rows(random, 4, 3, random.real(0.5, 2)));
  }
}

TEST(ContactWalk, starts_inside_where_a_sheet_does) {
  Random random(5);
  for (unsigned run = 0; run < 10; ++run) expect_walks(build(kuhn_cube(5)), random_rows(random, 4, 3, 0.2));
}

TEST(ContactWalk, looks_at_few_tets_beyond_those_met) {
  const TetMesh mesh = build(kuhn_cube(8));
  SurfaceIndex surface;
  surface.follow(mesh, Journal());
  SplitTemplates templates;
  ClosedComplex complex(templates);
  ContactWalk walk;
  const auto strip = strip_of_all({{Vec3(0.31, -1, -1), Vec3(0.32, -1, 2)}, {Vec3(0.33, 2, -1), Vec3(0.3, 2, 2)}});
  const auto& met = walk.find(mesh, *strip, surface, complex, 1);
  EXPECT_EQ(met.size(), complex.size());
  EXPECT_LE(met.size(), tets_that_meet(mesh, strip->sheet).size() * 11 / 10);
}

}  // namespace
}  // namespace incise::test::contact_walk_test
