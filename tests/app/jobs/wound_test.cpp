// SPDX-License-Identifier: Apache-2.0
// A cut mesh that was written and read again is the same wound.
#include <gtest/gtest.h>

#include <set>

#include "incise/engine/engine.h"
#include "incise/io/mesh_export.h"
#include "incise/io/mesh_loader.h"
#include "incise/mesh/validate.h"
#include "support/bodies.h"
#include "support/strokes.h"

namespace incise::test::wound_test {
namespace {

constexpr std::array<const char*, 4> kFormats = {".mesh", ".msh", ".vtk", ".vtu"};

struct Case {
  const char* name;
  TetSoup soup;
  std::vector<Stroke> strokes;
  Profile profile = Profile::kIncise;
  bool maintains = false;
};

void PrintTo(const Case& tried, std::ostream* out) {  // NOLINT(readability-identifier-naming): GoogleTest's
  *out << tried.name;
}

/// Across y, down from above the unit cube to `z`; within it where it is shorter.
Stroke down_to(double x, double z, double from = -0.2, double to = 1.2) {
  return quad_stroke({x, from, 1.2}, {x, to, 1.2}, {x, from, z}, {x, to, z}, 3);
}
Stroke along_x(double y, double z) {
  return quad_stroke({-0.2, y, 1.2}, {1.2, y, 1.2}, {-0.2, y, z}, {1.2, y, z});
}
/// Within the body: its skin stays whole.
Stroke inner() {
  return quad_stroke({0.3, 0.2, 0.52}, {0.7, 0.25, 0.5}, {0.35, 0.8, 0.5}, {0.7, 0.75, 0.53});
}

std::vector<Case> cases() {
  std::vector<Case> all = {
      {"through", jittered_cube(5, 1), {down_to(0.5, -0.2)}},
      {"partial", jittered_cube(5, 2), {down_to(0.47, 0.43)}},
      {"shorter_than_the_body", jittered_cube(5, 3), {down_to(0.52, 0.41, 0.22, 0.77)}},
      {"inner", jittered_cube(6, 4), {inner()}},
      {"two_that_cross", jittered_cube(5, 5), {down_to(0.47, 0.33), along_x(0.52, 0.44)}},
      {"core", jittered_cube(6, 6), {coring_stroke({0.5, 0.5, 0}, 0.3, 24, 1.2, 0.4)}},
      {"regular", kuhn_cube(4), {down_to(0.5, 0.5), along_x(0.5, 0.25)}},
  };
  for (std::size_t i = 0, n = all.size(); i < n; ++i) {
    all.push_back(all[i]);
    all.back().maintains = true;
    all.push_back(all[i]);
    all.back().profile = Profile::kPaper;
    all.push_back(all.back());
    all.back().maintains = true;
  }
  return all;
}

Engine engine_of(TetMesh mesh, const Case& tried) {
  EngineOptions options;
  options.cut.profile = tried.profile;
  options.maintain.merge = options.maintain.improve = tried.maintains;
  return Engine::create(std::move(mesh), options).value();
}

Engine cut_body(const Case& tried) {
  Engine engine = engine_of(TetMesh::build(tried.soup).value(), tried);
  for (const Stroke& stroke : tried.strokes) EXPECT_TRUE(engine.cut(stroke).ok());
  return engine;
}

io::MeshData packed(const TetMesh& mesh) {
  return io::to_mesh_data(mesh, find_components(mesh));
}

io::LoadedMesh written_and_read(const io::MeshData& data, const char* extension) {
  const Result<std::string> bytes = io::write_mesh_bytes(extension, data);
  EXPECT_TRUE(bytes.ok());
  Result<io::MeshFile> file = io::read_mesh_bytes(*bytes);
  EXPECT_TRUE(file.ok()) << file.error().message;
  Result<io::LoadedMesh> loaded = io::build_mesh(std::move(file).value(), "again");
  EXPECT_TRUE(loaded.ok()) << loaded.error().message;
  return std::move(loaded).value();
}

/// Live slots in order: position in a file.
template <class Id, class ForEach>
std::vector<Id> in_order(const ForEach& for_each) {
  std::vector<Id> ids;
  for_each([&](Id id) { ids.push_back(id); });
  return ids;
}

struct Differences {
  std::size_t places = 0, corners = 0, tags = 0, surfaces = 0, fronts = 0, origins = 0;
};

Differences compare(const TetMesh& before, const TetMesh& after) {
  Differences found;
  const auto vertices = in_order<VertexId>([&](auto visit) { before.for_each_vertex(visit); });
  const auto tets = in_order<TetId>([&](auto visit) { before.for_each_tet(visit); });
  EXPECT_EQ(vertices.size(), after.vertex_slots());
  EXPECT_EQ(tets.size(), after.tet_slots());
  if (vertices.size() != after.vertex_slots() || tets.size() != after.tet_slots()) return found;
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    const VertexId is(i), was = vertices[i];
    const unsigned bits = before.shape_of(was) ^ after.shape_of(is);
    found.places += before.rest(was) != after.rest(is) ? 1U : 0U;
    found.surfaces += (bits & ~unsigned{shape::kFront}) != 0 ? 1U : 0U;
    found.fronts += (bits & shape::kFront) != 0 ? 1U : 0U;
    found.origins += before.origin(was) != after.origin(is) ? 1U : 0U;
  }
  for (std::uint32_t i = 0; i < tets.size(); ++i) {
    for (unsigned s = 0; s < 4; ++s) {
      const VertexId is = after.vertices(TetId(i))[s];
      found.corners += vertices[is.value] != before.vertices(tets[i])[s] ? 1U : 0U;
      const Link link = after.links(TetId(i))[s], old = before.links(tets[i])[s];
      const bool is_same = link.is_boundary() == old.is_boundary() && (!link.is_boundary() || link == old);
      found.tags += is_same ? 0U : 1U;
    }
  }
  return found;
}

std::size_t front_size(const TetMesh& mesh) {
  std::size_t count = 0;
  mesh.for_each_vertex([&](VertexId v) { count += (mesh.shape_of(v) & shape::kFront) != 0 ? 1U : 0U; });
  return count;
}

std::set<std::uint32_t> strokes_of(const TetMesh& mesh) {
  std::set<std::uint32_t> strokes;
  mesh.for_each_tet([&](TetId tet) {
    for (const Link link : mesh.links(tet)) {
      if (link.is_boundary() && link.tag() > 0) strokes.insert(link.tag());
    }
  });
  return strokes;
}

class Wound : public testing::TestWithParam<Case> {};

TEST_P(Wound, is_the_same_after_it_was_written_and_read) {
  const Engine engine = cut_body(GetParam());
  const TetMesh& mesh = engine.mesh();
  EXPECT_EQ(strokes_of(mesh).size(), GetParam().strokes.size());
  for (const char* format : kFormats) {
    const io::LoadedMesh again = written_and_read(packed(mesh), format);
    const Differences found = compare(mesh, again.mesh);
    EXPECT_EQ(found.places + found.corners, 0U) << format;
    EXPECT_EQ(found.tags, 0U) << format;
    EXPECT_EQ(found.surfaces, 0U) << format;
    EXPECT_EQ(found.fronts, 0U) << format;
    EXPECT_EQ(found.origins, 0U) << format;
    EXPECT_TRUE(again.source.notes.empty()) << format;
    EXPECT_TRUE(validate(again.mesh, ValidateLevel::kGeometry).ok) << format;
  }
}

// Where a later stroke divides a vertex at the end of an earlier cut, the mesh forgets that the cut goes on ending
// there.
TEST_P(Wound, ends_where_its_lips_meet_if_the_file_does_not_say) {
  const Engine engine = cut_body(GetParam());
  io::MeshData data = packed(engine.mesh());
  data.cut_front.clear();
  const io::LoadedMesh again = written_and_read(data, ".vtk");
  const Differences found = compare(engine.mesh(), again.mesh);
  EXPECT_EQ(found.tags + found.surfaces, 0U);
  EXPECT_EQ(front_size(again.mesh), front_size(engine.mesh()) + found.fronts);  // none is missing
  EXPECT_LE(found.fronts, 2 * (GetParam().strokes.size() - 1));
}

INSTANTIATE_TEST_SUITE_P(Cuts, Wound, testing::ValuesIn(cases()), [](const auto& tested) {
  const Case& tried = tested.param;
  return std::string(tried.name) + (tried.profile == Profile::kPaper ? "_as_paper" : "") +
         (tried.maintains ? "_maintained" : "");
});

TEST(Strokes, go_on_from_the_walls_of_the_file) {
  const Case first = {"first", jittered_cube(5, 7), {down_to(0.47, 0.33)}};
  const io::MeshData data = packed(cut_body(first).mesh());
  Engine engine = engine_of(written_and_read(data, ".mesh").mesh, first);
  EXPECT_EQ(engine.stroke_count(), 0U);
  EXPECT_EQ(engine.next_stroke(), 2U);
  const std::uint64_t before = engine.mesh().hash();
  const Result<StrokeReport> second = engine.cut(along_x(0.52, 0.44));
  ASSERT_TRUE(second.ok());
  EXPECT_EQ(second->stroke, 2U);
  EXPECT_EQ(strokes_of(engine.mesh()), (std::set<std::uint32_t>{1, 2}));
  EXPECT_TRUE(engine.undo());
  EXPECT_EQ(engine.mesh().hash(), before);
  EXPECT_FALSE(engine.undo());
  ASSERT_TRUE(engine.begin_stroke({{Vec3(0.2, -0.2, 1.2), Vec3(0.2, 1.2, 1.2)}}).ok());
  EXPECT_EQ(engine.next_stroke(), 2U);
  ASSERT_TRUE(engine.step({{Vec3(0.2, -0.2, 0.6), Vec3(0.2, 1.2, 0.6)}}).ok());
  EXPECT_EQ(engine.end_stroke()->stroke, 2U);
  EXPECT_EQ(engine.next_stroke(), 3U);
  EXPECT_TRUE(validate(engine.mesh(), ValidateLevel::kGeometry).ok);
}

TEST(Origins, name_the_vertices_before_the_first_cut) {
  const Case tried = {"first", jittered_cube(5, 8), {down_to(0.47, 0.33)}};
  for (const char* format : {".mesh", ".msh", ".vtk", ".vtu"}) {
    Engine engine = engine_of(written_and_read(packed(cut_body(tried).mesh()), format).mesh, tried);
    ASSERT_TRUE(engine.cut(along_x(0.52, 0.44)).ok());
    const io::MeshData twice = packed(engine.mesh());
    std::size_t named = 0;
    for (std::size_t i = 0; i < twice.origin_vertex.size(); ++i) {
      if (twice.origin_vertex[i] < 0) continue;
      ++named;
      ASSERT_LT(static_cast<std::size_t>(twice.origin_vertex[i]), tried.soup.points.size());
      const Vec3 moved = twice.soup.points[i] - tried.soup.points[static_cast<std::size_t>(twice.origin_vertex[i])];
      EXPECT_LT(moved.norm(), 0.1);  // snapped at most
    }
    EXPECT_GE(named, tried.soup.points.size());
  }
}

io::MeshFile two_tets() {
  io::MeshFile file;
  file.data.soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1.5}};
  file.data.soup.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  return file;
}

TEST(Walls, that_are_no_boundary_faces_are_left_out_with_a_note) {
  io::MeshFile file = two_tets();
  file.data.triangles = {{1, 2, 3}, {0, 2, 1}, {0, 1, 4}, {0, 1, 3}};
  file.data.triangle_stroke = {1, 7, 2, -3};
  const Result<io::LoadedMesh> loaded = io::build_mesh(file, "x");
  ASSERT_TRUE(loaded.ok());
  EXPECT_EQ(strokes_of(loaded->mesh), (std::set<std::uint32_t>{7}));
  ASSERT_EQ(loaded->source.notes.size(), 1U);
  EXPECT_EQ(loaded->source.notes[0].substr(0, 2), "2 ");
}

TEST(Walls, of_other_programs_labels_are_skin) {
  io::MeshFile file = two_tets();
  file.data.triangles = {{0, 2, 1}, {0, 1, 3}};
  file.data.triangle_stroke = {1, 2};
  file.data.has_foreign_labels = true;
  const Result<io::LoadedMesh> loaded = io::build_mesh(file, "x");
  ASSERT_TRUE(loaded.ok());
  EXPECT_TRUE(strokes_of(loaded->mesh).empty());
  EXPECT_TRUE(loaded->source.notes.empty());
  EXPECT_EQ(loaded->mesh.hash(), io::build_mesh(two_tets(), "x")->mesh.hash());
}

TEST(Walls, of_strokes_beyond_the_highest_number_name_the_file) {
  io::MeshFile file = two_tets();
  file.data.triangles = {{0, 2, 1}};
  file.data.triangle_stroke = {2147483647};
  const Result<io::LoadedMesh> loaded = io::build_mesh(file, "some.vtu");
  ASSERT_FALSE(loaded.ok());
  EXPECT_EQ(loaded.error().message.substr(0, 17), "some.vtu: wall 0 ");
}

}  // namespace
}  // namespace incise::test::wound_test
