// SPDX-License-Identifier: Apache-2.0
// Separation along given faces: the paper's figures, the number of copies, and both algorithms side by side.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <set>

#include "cut/pinched_edges.h"
#include "paper/contact.h"
#include "paper/crossing.h"
#include "paper/dividable.h"
#include "paper/subdivide.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/star_separation.h"
#include "support/strokes.h"

namespace incise::test::separate_test {
namespace {

using Faces = std::vector<IncisionFace>;

/// The inner faces all of whose vertices satisfy `is_in`, and whose centre satisfies it too.
Faces faces_where(const TetMesh& mesh, const std::function<bool(const Vec3&)>& is_in) {
  Faces faces;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(tet)[s];
      if (link.is_boundary() || link.side() < Side(tet, s)) continue;
      const auto v = mesh.vertices(Side(tet, s));
      const Vec3 &a = mesh.rest(v[0]), &b = mesh.rest(v[1]), &c = mesh.rest(v[2]);
      if (is_in(a) && is_in(b) && is_in(c) && is_in((a + b + c) / 3.0)) faces.push_back({Side(tet, s), link.side()});
    }
  });
  return faces;
}

bool is_at(double x, double place) {
  return std::abs(x - place) < 1e-9;
}
bool is_between(double x, double low, double high) {
  return x > low - 1e-9 && x < high + 1e-9;
}

Separation separate_by_paper(TetMesh& mesh, Faces faces) {
  Transaction transaction(mesh);
  StarWalker walker;
  const Separation result = separate_as_paper(transaction, std::move(faces), 1, walker);
  transaction.commit();
  return result;
}

/// How many copies the faces ask for: at each vertex, the independent cycles of the graph that the faces draw in its
/// link, with all of the link's nodes on the body's surface taken as one.
std::uint64_t expected_copies(const TetMesh& mesh, const Faces& faces) {
  std::set<std::array<VertexId, 2>> surface_edges;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (!mesh.links(tet)[s].is_boundary()) continue;
      const auto v = mesh.vertices(Side(tet, s));
      for (unsigned k = 0; k < 3; ++k)
        surface_edges.insert({std::min(v[k], v[(k + 1) % 3]), std::max(v[k], v[(k + 1) % 3])});
    }
  });
  std::map<VertexId, std::vector<std::array<VertexId, 2>>> arcs;
  for (const IncisionFace& face : faces) {
    const auto v = mesh.vertices(face.a);
    for (unsigned k = 0; k < 3; ++k) arcs[v[k]].push_back({v[(k + 1) % 3], v[(k + 2) % 3]});
  }
  std::uint64_t copies = 0;
  for (const auto& [v, edges] : arcs) {
    const VertexId outside;  // the invalid id stands for the surface
    const auto node = [&, vertex = v](VertexId w) {
      return surface_edges.count({std::min(vertex, w), std::max(vertex, w)}) > 0 ? outside : w;
    };
    std::map<VertexId, VertexId> root;
    const std::function<VertexId(VertexId)> find = [&](VertexId w) {
      return root.try_emplace(w, w).first->second == w ? w : find(root[w]);
    };
    for (const auto& [from, to] : edges) {
      const VertexId a = find(node(from)), b = find(node(to));
      if (a == b) {
        ++copies;
      } else {
        root[a] = b;
      }
    }
  }
  return copies;
}

// --- the paper's figures
// -----------------------------------------------------------------------------------------------------

/// Two tets on one face, which is the incision.
TetSoup two_tets() {
  TetSoup soup;
  soup.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.3, 0.3, 1), Vec3(0.3, 0.3, -1)};
  soup.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  return soup;
}

TEST(PaperSeparation, figure_5_has_two_singleton_vertices_after_the_first_is_divided) {
  // Dividing one vertex of the face opens it. The other two, A and B, then join two tets without a face between.
  TetMesh mesh = build(two_tets());
  const double volume = volume_of(mesh);
  const Separation result = separate_by_paper(mesh, faces_where(mesh, [](const Vec3&) { return true; }));
  EXPECT_EQ(result.singleton_vertices, 2U);
  EXPECT_EQ(result.copied_vertices, 3U);
  EXPECT_EQ(result.opened_faces, 1U);
  EXPECT_EQ(find_components(mesh).count(), 2U);
  expect_valid(mesh, volume);
}

TEST(PaperSeparation, figure_4_a_sector_between_two_surface_edges_divides_its_vertex) {
  TetMesh mesh = build(kuhn_cube(4));
  // The faces of the plane x = ½ around a vertex on the skin, other than its neighbours': a half disc.
  const Faces faces = faces_where(mesh, [](const Vec3& p) {
    return is_at(p.x(), 0.5) && is_between(p.y(), 0.25, 0.75) && is_between(p.z(), 0.75, 1.0);
  });
  ASSERT_EQ(faces.size(), 4U);
  const Separation result = separate_by_paper(mesh, faces);
  EXPECT_EQ(result.copied_vertices, 1U);
  EXPECT_EQ(result.singleton_vertices, 0U);
  EXPECT_EQ(find_components(mesh).count(), 1U);
  expect_valid(mesh, 1.0);
}

TEST(PaperSeparation, figure_4_a_circle_of_faces_divides_its_vertex) {
  TetMesh mesh = build(kuhn_cube(4));
  const Faces faces = faces_where(mesh, [](const Vec3& p) {
    return is_at(p.x(), 0.5) && is_between(p.y(), 0.25, 0.75) && is_between(p.z(), 0.25, 0.75);
  });
  ASSERT_EQ(faces.size(), 8U);
  const Separation result = separate_by_paper(mesh, faces);
  EXPECT_EQ(result.copied_vertices, 1U);
  EXPECT_EQ(find_components(mesh).count(), 1U);
  expect_valid(mesh, 1.0);
}

TEST(PaperSeparation, figure_4_an_inner_vertex_follows_its_neighbour_on_the_surface) {
  TetMesh mesh = build(kuhn_cube(4));
  const Faces faces = faces_where(mesh, [](const Vec3& p) {
    return is_at(p.x(), 0.5) && is_between(p.y(), 0.25, 0.75) && is_between(p.z(), 0.5, 1.0);
  });
  ASSERT_EQ(faces.size(), 8U);
  const Separation result = separate_by_paper(mesh, faces);  // P1 on the skin, P2 below it
  EXPECT_EQ(result.copied_vertices, 2U);
  expect_valid(mesh, 1.0);
}

TEST(PaperSeparation, algorithm_1_finds_the_vertices_within_the_faces_and_none_on_their_rim) {
  TetMesh mesh = build(kuhn_cube(4));
  const Faces faces = faces_where(mesh, [](const Vec3& p) {
    return is_at(p.x(), 0.5) && is_between(p.y(), 0.25, 0.75) && is_between(p.z(), 0.5, 1.0);
  });
  Transaction transaction(mesh);
  StarWalker walker;
  std::vector<double> heights;
  for (const VertexId v : find_dividable_vertices(transaction, faces, walker)) {
    EXPECT_TRUE(is_at(mesh.rest(v).y(), 0.5));
    heights.push_back(mesh.rest(v).z());
  }
  std::sort(heights.begin(), heights.end());
  EXPECT_EQ(heights, (std::vector<double>{0.75, 1.0}));  // of nine vertices
  EXPECT_TRUE(transaction.new_vertices().empty());
}

/// "If a vertex not dividable is subdivided, problem would occur" (2.3): those of a face on its own, and on the rim of
/// several, stay.
TEST(PaperSeparation, divides_no_vertex_that_is_not_dividable) {
  for (const std::size_t count : {1U, 2U, 5U}) {
    SCOPED_TRACE(count);
    TetMesh mesh = build(kuhn_cube(4));
    Faces faces = faces_where(mesh, [](const Vec3& p) {
      return is_at(p.x(), 0.5) && is_between(p.y(), 0.25, 0.75) && is_between(p.z(), 0.25, 0.75);
    });
    ASSERT_EQ(faces.size(), 8U);
    faces.resize(count);
    const std::uint64_t hash = mesh.hash();
    const Separation result = separate_by_paper(mesh, faces);
    EXPECT_EQ(result.copied_vertices, 0U);
    EXPECT_EQ(result.opened_faces, 0U);
    EXPECT_EQ(result.latent_faces, count);
    EXPECT_EQ(mesh.hash(), hash);
    expect_valid(mesh, 1.0);
  }
}

// --- T22: sheets inside the body
// -----------------------------------------------------------------------------------------------

bool is_on_inner_box(const Vec3& p) {
  const double reach = std::max({std::abs(p.x() - 0.5), std::abs(p.y() - 0.5), std::abs(p.z() - 0.5)});
  return is_at(reach, 0.25);
}

TEST(Separate, a_closed_bubble_inside_gives_two_pieces) {
  TetMesh mesh = build(kuhn_cube(4));
  const Faces faces = faces_where(mesh, is_on_inner_box);
  ASSERT_EQ(faces.size(), 48U);
  const Separation result = separate_stars(mesh, faces);
  EXPECT_EQ(result.copied_vertices, 26U);
  EXPECT_EQ(result.opened_faces, 48U);
  expect_pieces(mesh, {0.125, 0.875}, 1e-15);
  expect_valid(mesh, 1.0);
}

/// "Type-I dividable vertex will always be converted to type-II" (2.3) is wrong here: no edge of the sheet is a surface
/// edge, and some vertex has to be divided as type I before any other.
TEST(PaperSeparation, takes_a_closed_bubble_out_by_vertices_of_type_1) {
  TetMesh mesh = build(kuhn_cube(4));
  const Faces faces = faces_where(mesh, is_on_inner_box);
  ASSERT_EQ(faces.size(), 48U);
  for (const IncisionFace& face : faces) {
    for (const VertexId v : mesh.vertices(face.a)) ASSERT_EQ(mesh.shape_of(v), 0U);  // inside
  }
  const Separation result = separate_by_paper(mesh, faces);
  EXPECT_EQ(result.copied_vertices, 26U);
  EXPECT_EQ(result.opened_faces, 48U);
  expect_pieces(mesh, {0.125, 0.875}, 1e-15);
  expect_valid(mesh, 1.0);
}

/// The triangles of the plane x = ½ around the point (½, y, z): six, on the Kuhn grid of `n` cells.
Faces disc_around(const TetMesh& mesh, double y, double z, double h) {
  return faces_where(mesh, [=](const Vec3& p) {
    const double dy = p.y() - y, dz = p.z() - z;
    return is_at(p.x(), 0.5) && is_between(dy, -h, h) && is_between(dz, -h, h) && is_between(dy - dz, -h, h);
  });
}

TEST(Separate, a_disc_inside_copies_its_inner_vertex_only) {
  TetMesh mesh = build(kuhn_cube(4));
  const Faces faces = disc_around(mesh, 0.5, 0.5, 0.25);
  ASSERT_EQ(faces.size(), 6U);
  const Separation result = separate_stars(mesh, faces);
  EXPECT_EQ(result.copied_vertices, 1U);
  EXPECT_EQ(result.opened_faces, 6U);
  EXPECT_EQ(result.pinched_edges, 0U);
  EXPECT_EQ(find_components(mesh).count(), 1U);
  expect_valid(mesh, 1.0);
}

TEST(Separate, a_square_inside_copies_its_inner_vertices_only) {
  for (const auto& [cells, inner] : {std::pair(2U, 1U), std::pair(4U, 9U)}) {
    TetMesh mesh = build(kuhn_cube(cells + 2));
    const double h = 1.0 / (cells + 2);
    const Faces faces = faces_where(mesh, [h = h](const Vec3& p) {
      return is_at(p.x(), 0.5) && is_between(p.y(), h, 1 - h) && is_between(p.z(), h, 1 - h);
    });
    ASSERT_EQ(faces.size(), 2U * cells * cells);
    const Separation result = separate_stars(mesh, faces);
    EXPECT_EQ(result.pinched_edges, 0U);
    EXPECT_EQ(result.copied_vertices, inner);
    EXPECT_EQ(find_components(mesh).count(), 1U);
    expect_valid(mesh, 1.0);
  }
}

TEST(Separate, bisects_a_skin_edge_that_a_disc_touches) {
  // Opened as it stands, the edge would have two faces of skin and two of wall.
  TetMesh mesh = build(kuhn_cube(4));
  const Faces faces = disc_around(mesh, 0.5, 0.75, 0.25);
  ASSERT_EQ(faces.size(), 6U);
  const Separation result = separate_stars(mesh, faces);
  EXPECT_EQ(result.pinched_edges, 1U);
  EXPECT_EQ(result.copied_vertices, 2U);
  EXPECT_EQ(find_components(mesh).count(), 1U);
  expect_valid(mesh, 1.0);
}

// --- T23: X, T, parallel planes, fins
// ----------------------------------------------------------------------------------------------

struct Layout {
  std::string name;
  std::function<bool(const Vec3&)> is_in;
  std::size_t pieces;
  std::uint64_t copies;
};

std::vector<Layout> layouts() {
  const auto x = [](double place) { return [place](const Vec3& p) { return is_at(p.x(), place); }; };
  return {
      {"one plane", x(0.5), 2, 25},
      {"X", [](const Vec3& p) { return is_at(p.x(), 0.5) || is_at(p.y(), 0.5); }, 4, 55},
      {"T", [](const Vec3& p) { return is_at(p.x(), 0.5) || (is_at(p.y(), 0.5) && p.x() > 0.5 - 1e-9); }, 3, 40},
      {"three parallel planes",
       [](const Vec3& p) { return is_at(p.x(), 0.25) || is_at(p.x(), 0.5) || is_at(p.x(), 0.75); }, 4, 75},
      {"plane and a fin that ends inside",
       [](const Vec3& p) {
         return is_at(p.x(), 0.5) || (is_at(p.y(), 0.5) && is_between(p.x(), 0.5, 0.75) &&
                                      is_between(p.z(), 0.25, 0.75) && p.x() - p.z() < 0.25 + 1e-9);
       },
       2, 26},
      {"half a plane", [](const Vec3& p) { return is_at(p.x(), 0.5) && p.z() > 0.5 - 1e-9; }, 1, 10},
      {"three planes", [](const Vec3& p) { return is_at(p.x(), 0.5) || is_at(p.y(), 0.5) || is_at(p.z(), 0.5); }, 8,
       91},
  };
}

/// The paper's algorithms themselves, against the count of cycles.
TEST(PaperSeparation, divides_each_vertex_as_often_as_its_faces_have_cycles) {
  for (const Layout& layout : layouts()) {
    SCOPED_TRACE(layout.name);
    TetMesh mesh = build(kuhn_cube(4));
    const Faces faces = faces_where(mesh, layout.is_in);
    ASSERT_EQ(expected_copies(mesh, faces), layout.copies);
    const Separation result = separate_by_paper(mesh, faces);
    EXPECT_EQ(result.copied_vertices, layout.copies);
    EXPECT_EQ(find_components(mesh).count(), layout.pieces);
    expect_valid(mesh, 1.0);
  }
}

TEST(Separate, gives_each_vertex_one_copy_per_part_of_its_star) {
  for (const Layout& layout : layouts()) {
    SCOPED_TRACE(layout.name);
    TetMesh mesh = build(kuhn_cube(4));
    const Faces faces = faces_where(mesh, layout.is_in);
    const std::uint64_t expected = expected_copies(mesh, faces);
    const Separation result = separate_stars(mesh, faces);
    EXPECT_EQ(result.copied_vertices, layout.copies);
    EXPECT_EQ(result.copied_vertices, expected);
    EXPECT_EQ(find_components(mesh).count(), layout.pieces);
    EXPECT_EQ(result.pinched_edges, 0U);
    expect_valid(mesh, 1.0);
  }
}

TEST(Separate, copies_as_many_vertices_as_the_cycles_of_random_faces) {
  unsigned compared = 0;
  for (unsigned run = 0; run < 200; ++run) {
    SCOPED_TRACE(run);
    Random random(run);
    const double share = 0.5 * std::pow(random.real(0, 1), 4);
    TetMesh mesh = build(kuhn_cube(3));
    Faces faces = faces_where(mesh, [](const Vec3&) { return true; });
    faces.erase(
        std::remove_if(faces.begin(), faces.end(), [&](const IncisionFace&) { return random.real(0, 1) > share; }),
        faces.end());
    const std::uint64_t expected = expected_copies(mesh, faces);
    const Separation result = separate_stars(mesh, faces);
    if (result.pinched_edges == 0) {
      EXPECT_EQ(result.copied_vertices, expected);
      ++compared;
    }
    EXPECT_EQ(result.opened_faces + result.latent_faces >= faces.size(), true);
    expect_valid(mesh, 1.0);
  }
  EXPECT_GT(compared, 10U);
}

// --- T24, T25
// -----------------------------------------------------------------------------------------------------------------------

TEST(Separate, bisects_a_neck_between_two_discs_that_share_an_edge) {
  // Both ends of the edge stay whole: opened as it stands it would have four faces of wall.
  TetMesh mesh = build(kuhn_cube(6));
  const double h = 1.0 / 6;
  Faces faces = disc_around(mesh, 2 * h, 3 * h, h);
  for (const IncisionFace& face : disc_around(mesh, 4 * h, 4 * h, h)) faces.push_back(face);
  ASSERT_EQ(faces.size(), 12U);
  const Separation result = separate_stars(mesh, faces);
  EXPECT_EQ(result.pinched_edges, 1U);
  EXPECT_EQ(result.copied_vertices, 3U);
  EXPECT_EQ(result.opened_faces, 14U);
  EXPECT_EQ(find_components(mesh).count(), 1U);
  expect_valid(mesh, 1.0);
}

TEST(Separate, leaves_two_faces_that_share_an_edge_valid) {
  TetMesh mesh = build(kuhn_cube(5));
  const Faces faces = faces_where(mesh, [](const Vec3& p) {
    return is_at(p.x(), 0.4) && is_between(p.y(), 0.4, 0.6) && is_between(p.z(), 0.4, 0.6);
  });
  ASSERT_EQ(faces.size(), 2U);
  const Separation result = separate_stars(mesh, faces);
  EXPECT_EQ(result.pinched_edges, 0U);
  EXPECT_EQ(result.copied_vertices, 0U);
  EXPECT_EQ(find_components(mesh).count(), 1U);
  expect_valid(mesh, 1.0);
}

TEST(Separate, leaves_a_single_face_joined) {
  TetMesh mesh = build(kuhn_cube(5));
  Faces faces = faces_where(mesh, [](const Vec3& p) {
    return is_between(p.x(), 0.3, 0.7) && is_between(p.y(), 0.3, 0.7) && is_between(p.z(), 0.3, 0.7);
  });
  faces.resize(1);
  const IncisionFace face = faces[0];
  const Separation result = separate_stars(mesh, faces);
  EXPECT_EQ(result.copied_vertices, 0U);
  EXPECT_EQ(result.opened_faces, 0U);
  EXPECT_EQ(result.latent_faces, 1U);
  EXPECT_EQ(mesh.link(face.a), Link(face.b));
  EXPECT_EQ(mesh.tet_count(), 750U);
  expect_valid(mesh, 1.0);
}

// --- the paper's algorithms and star components, side by side
// ---------------------------------------------------------------------------

/// Whether two meshes with the same tet slots give corners the same vertices up to the names of the vertices.
bool have_same_partition(const TetMesh& a, const TetMesh& b) {
  std::map<VertexId, VertexId> to_b, to_a;
  bool is_same = a.tet_slots() == b.tet_slots();
  a.for_each_tet([&](TetId tet) {
    if (!is_same || !b.is_live(tet)) {
      is_same = false;
      return;
    }
    for (unsigned c = 0; c < 4; ++c) {
      const VertexId v = a.vertices(tet)[c], w = b.vertices(tet)[c];
      is_same &= to_b.try_emplace(v, w).first->second == w && to_a.try_emplace(w, v).first->second == v;
    }
  });
  return is_same;
}

void expect_equal_separations(const TetMesh& mesh, const Faces& faces) {
  TetMesh stars = mesh, paper = mesh;
  const Separation a = separate_stars(stars, faces), b = separate_by_paper(paper, faces);
  EXPECT_EQ(a.pinched_edges, 0U);
  EXPECT_EQ(a.copied_vertices, b.copied_vertices);
  EXPECT_EQ(a.opened_faces, b.opened_faces);
  EXPECT_TRUE(have_same_partition(stars, paper));
  expect_valid(stars, volume_of(mesh));
  expect_valid(paper, volume_of(mesh));
}

/// The mesh subdivided along a stroke, not yet separated.
struct Subdivided {
  TetMesh mesh;
  Faces incision;
};

Subdivided subdivide_along(TetSoup soup, const Stroke& stroke) {
  Subdivided result{build(std::move(soup)), {}};
  const SweptSurface surface = sweep(stroke);
  std::vector<std::uint32_t> all(surface.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  const Sheet sheet(surface, all);
  Transaction transaction(result.mesh);
  Neighbourhood near;
  find_crossings(result.mesh, sheet, find_near_tets(result.mesh, sheet), near);
  SplitTemplates templates;
  plan_subdivision(result.mesh, templates, near);
  const Subdivision subdivision = subdivide(transaction, templates, near);
  result.incision = find_paper_incision(result.mesh, near, subdivision);
  transaction.commit();
  return result;
}

TEST(PaperSeparation, equals_star_components_on_faces_of_the_grid) {
  for (const Layout& layout : layouts()) {
    SCOPED_TRACE(layout.name);
    const TetMesh mesh = build(kuhn_cube(4));
    expect_equal_separations(mesh, faces_where(mesh, layout.is_in));
  }
}

TEST(PaperSeparation, equals_star_components_on_straight_oblique_and_coring_cuts) {
  const Box box{Vec3(0, 0, 0), Vec3(1, 1, 1)};
  for (const TetSoup& soup : {kuhn_cube(4), jittered_cube(5, 31)}) {
    for (const Stroke& stroke : {*plane_stroke(box, Vec3(1, 0, 0), 0.44), *plane_stroke(box, Vec3(0.3, 0.5, 0.8), 0.7),
                                 coring_stroke(Vec3(0.5, 0.5, 0), 0.31, 32, -0.2, 1.2)}) {
      const Subdivided subdivided = subdivide_along(soup, stroke);
      ASSERT_GT(subdivided.incision.size(), 0U);
      expect_equal_separations(subdivided.mesh, subdivided.incision);
    }
  }
}

/// Two bars that touch along an edge, x = y = 1, and nowhere else: a defect of the input.
TetSoup bars_that_touch() {
  TetSoup soup = kuhn_box(Vec3::Zero(), Vec3(2, 2, 1), {4, 4, 2});
  std::erase_if(soup.tets, [&](const auto& tet) {
    Vec3 centre = Vec3::Zero();
    for (const auto v : tet) centre += 0.25 * soup.points[v];
    return (centre.x() < 1) != (centre.y() < 1);
  });
  return soup;
}

TEST(PaperSeparation, divides_an_edge_that_two_fans_share_once_for_each) {
  Engine engine = make_engine(bars_that_touch(), 0.0, Profile::kPaper);
  const std::uint64_t singletons =
      validate(engine.mesh(), ValidateLevel::kTopology).count(ViolationKind::kSingletonVertex);
  ASSERT_GT(singletons, 0U);
  for (const double z : {0.3, 0.71}) ASSERT_TRUE(engine.cut(plane(engine, Vec3(0.1, -0.05, 1), z)).ok());
  const ValidityReport report = validate(engine.mesh(), ValidateLevel::kTopology);
  EXPECT_EQ(report.count(ViolationKind::kSingletonCutVertex), 0U);
  EXPECT_EQ(report.count(ViolationKind::kSingletonVertex), singletons);
  EXPECT_EQ(find_components(engine.mesh()).count(), 6U);
}

TEST(PaperSeparation, equals_star_components_on_random_planes) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Box box{Vec3(0, 0, 0), Vec3(1, 1, 1)};
    const Vec3 normal = random.point(-1, 1);
    const Subdivided subdivided =
        subdivide_along(jittered_cube(3, seed), *plane_stroke(box, normal, normal.dot(random.point(0.2, 0.8))));
    expect_equal_separations(subdivided.mesh, subdivided.incision);
  }
}

TEST(PaperSeparation, of_random_faces_never_copies_more_than_star_components_do) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double share = random.real(0.02, 0.5);
    TetMesh mesh = build(kuhn_cube(2));
    Faces faces = faces_where(mesh, [](const Vec3&) { return true; });
    faces.erase(
        std::remove_if(faces.begin(), faces.end(), [&](const IncisionFace&) { return random.real(0, 1) > share; }),
        faces.end());
    const std::uint64_t most = expected_copies(mesh, faces);
    EXPECT_LE(separate_by_paper(mesh, faces).copied_vertices, most);
    Transaction transaction(mesh);  // the paper leaves pinched edges; with the repair nothing is left
    StarWalker walker;
    part_pinched_edges(transaction, sides_of(faces), walker);
    transaction.commit();
    expect_valid(mesh, 1.0);
  }
}

}  // namespace
}  // namespace incise::test::separate_test
