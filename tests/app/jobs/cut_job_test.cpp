// SPDX-License-Identifier: Apache-2.0
// Loading, cutting, reporting and packing, without the command.
#include "app/jobs/cut_job.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/jobs/improve_job.h"
#include "app/jobs/job_internal.h"
#include "app/model/mesh_info.h"
#include "incise/io/mesh_export.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/shapes.h"

namespace cut_job_test {
namespace {

using namespace incise;
using nlohmann::json;

io::MeshFile cube_file() {
  io::MeshFile file;
  file.format_name = "test";
  file.data.soup = kuhn_cube(5);
  file.file_vertices = file.data.soup.points.size();
  file.file_tets = file.data.soup.tets.size();
  return file;
}

/// The paper's cube, cut in half and not maintained.
app::JobResult cut_cube(Profile profile) {
  Result<io::LoadedMesh> loaded = io::build_mesh(cube_file(), "cube");
  EXPECT_TRUE(loaded.ok());
  app::CutJob job;
  job.engine.cut.profile = profile;
  job.engine.maintain.merge = job.engine.maintain.improve = false;
  job.strokes.push_back(*plane_stroke(rest_bounds(loaded->mesh), Vec3(2, 0, 0), 1));
  Result<app::JobResult> result = app::run_cut(std::move(loaded).value(), job, true);
  EXPECT_TRUE(result.ok());
  return std::move(result).value();
}

struct RecordedEngineOf {
  RecordedEngineOf(TetMesh mesh, EngineOptions options)
      : engine(app::RecordedEngine::create(std::move(mesh), std::move(options)).value()) {}
  app::RecordedEngine engine;
};

/// What a job tells of its stages, each once.
struct ToldStages {
  std::vector<std::string> names;
  unsigned percent = 0;

  app::StageSink sink() {
    return [this](std::string_view name, unsigned gone) {
      if (names.empty() || name != names.back()) names.emplace_back(name);
      EXPECT_TRUE(names.size() == 1 ? gone == 0 : gone >= percent && gone < 100) << name << " " << gone;
      percent = gone;
    };
  }
};

TEST(Stages, of_a_plane_cut_and_of_improvement_are_told_one_after_the_other) {
  ToldStages cut, improved;
  Result<io::LoadedMesh> loaded = io::build_mesh(cube_file(), "cube");
  app::CutJob job;
  job.strokes.push_back(*plane_stroke(rest_bounds(loaded->mesh), Vec3(2, 1, 0), 1.3));
  job.stage = cut.sink();
  ASSERT_TRUE(app::run_cut(std::move(loaded).value(), job, false).ok());
  EXPECT_EQ(cut.names, (std::vector<std::string>{"measuring", "cutting", "improving the mesh at the cut",
                                                 "measuring the result"}));
  app::ImproveJob improve;
  improve.stage = improved.sink();
  io::MeshFile file = cube_file();
  file.data.soup.points[file.data.soup.tets[300][2]] += Vec3(0.05, 0.03, 0.04);
  ASSERT_TRUE(app::run_improve(io::build_mesh(file, "cube").value(), improve, false).ok());
  EXPECT_EQ(improved.names,
            (std::vector<std::string>{"measuring", "finding bad tets", "improving", "measuring the result"}));
}

TEST(Stages, of_a_check_go_up_to_the_whole) {
  std::vector<std::size_t> told;
  const auto check = app::check_mesh(cube_file(), "cube", [&](std::size_t done, std::size_t total) {
    EXPECT_EQ(total, 100U);
    told.push_back(done);
  });
  ASSERT_TRUE(check.ok());
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.front(), 0U);
  EXPECT_EQ(told.back(), 100U);
}

TEST(Percentiles, are_nearest_ranks) {
  std::vector<double> sample;
  for (int i = 1000; i >= 1; --i) sample.push_back(i);
  const app::Percentiles p = app::percentiles(sample);
  EXPECT_EQ(p.p50, 500);
  EXPECT_EQ(p.p99, 990);
  EXPECT_EQ(p.p999, 999);
  EXPECT_EQ(p.max, 1000);
  EXPECT_EQ(app::percentiles({}).max, 0);
  EXPECT_EQ(app::percentiles({7}).p50, 7);
}

TEST(CutJob, cuts_the_papers_cube_with_both_profiles) {
  for (const Profile profile : {Profile::kPaper, Profile::kIncise}) {
    const app::JobResult result = cut_cube(profile);
    const app::JobReport& report = result.report;
    EXPECT_EQ(report.before.tets, 750U);
    EXPECT_EQ(report.after.tets, 1300U);
    EXPECT_EQ(report.after.components, 2U);
    EXPECT_EQ(report.cut.incision_faces, 200U);
    EXPECT_EQ(report.cut.copied_vertices, 121U);
    EXPECT_TRUE(report.change.ok);
    ASSERT_EQ(report.pieces.size(), 2U);
    EXPECT_NEAR(report.pieces[0].volume, 0.5, 1e-12);
    EXPECT_GT(report.quality_incision.tets, 0U);
  }
}

TEST(CutJob, packs_labels_that_say_where_things_come_from) {
  const io::MeshData mesh = cut_cube(Profile::kIncise).mesh;
  ASSERT_EQ(mesh.soup.tets.size(), 1300U);
  ASSERT_EQ(mesh.piece.size(), 1300U);
  ASSERT_EQ(mesh.soup.regions.size(), 1300U);
  ASSERT_EQ(mesh.origin_vertex.size(), mesh.soup.points.size());
  EXPECT_EQ(mesh.triangles.size(), 400U);  // both walls
  EXPECT_EQ(mesh.triangle_stroke, std::vector<std::int32_t>(400, 1));
  EXPECT_EQ(std::count(mesh.origin_vertex.begin(), mesh.origin_vertex.end(), -1), 242);
  const TetSoup input = kuhn_cube(5);
  for (std::size_t v = 0; v < mesh.origin_vertex.size(); ++v) {
    if (mesh.origin_vertex[v] < 0) {
      EXPECT_EQ(mesh.soup.points[v].x(), 0.5);
    } else {
      EXPECT_EQ(mesh.soup.points[v], input.points[static_cast<std::size_t>(mesh.origin_vertex[v])]);
    }
  }
}

TEST(CutJob, report_has_every_key_of_the_contract) {
  const json report = json::parse(app::to_json(cut_cube(Profile::kIncise).report));
  EXPECT_EQ(report["format"], "incise-report");
  EXPECT_EQ(report["version"], 1);
  for (const char* key : {"program", "options", "mesh", "cut", "maintain", "quality", "volume", "validity", "time_ms",
                          "step_ms", "stage_ms", "hash"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  const auto expect_keys = [&](const char* pointer, std::vector<std::string> keys) {
    for (const std::string& key : keys)
      EXPECT_TRUE(report[json::json_pointer(pointer)].contains(key)) << pointer << key;
  };
  const std::vector<std::string> quality = {"lr_min",          "lr_mean",          "lr_p99",          "lr_max",
                                            "lr_over_200_pct", "dihedral_min_deg", "dihedral_max_deg"};
  for (const char* at :
       {"/quality/before", "/quality/cut", "/quality/cut/incision", "/quality/after", "/quality/after/incision"}) {
    expect_keys(at, quality);
  }
  for (const char* at : {"/mesh/before", "/mesh/after"}) expect_keys(at, {"vertices", "tets", "components"});
  expect_keys("/cut", {"steps", "cut_tets", "created_tets", "new_vertices", "incision_faces", "snapped_vertices",
                       "bent_vertices", "blocked_edges"});
  expect_keys("/maintain", {"work_units", "collapsed_edges", "moved_vertices", "removed_edges", "removed_faces",
                            "peeled_tets", "inserted_vertices", "waiting_tets", "created_tets", "units_per_stroke"});
  expect_keys("/options", {"profile", "snap", "merge", "improve", "budget_us", "threads", "seed"});
  expect_keys("/volume", {"before", "after", "relative_error"});
  expect_keys("/time_ms", {"collision", "subdivide", "separate", "merge", "improve", "relax", "total"});
  expect_keys("/step_ms", {"p50", "p99", "p999", "max"});
  for (const char* at : {"/stage_ms/subdivide", "/stage_ms/merge", "/stage_ms/improve"}) {
    expect_keys(at, {"p50", "p99", "p999", "max"});
  }
  EXPECT_EQ(report["validity"]["ok"], true);
  EXPECT_EQ(report["hash"].get<std::string>().size(), 16U);
}

TEST(CutJob, takes_strokes_back_until_the_mesh_is_valid) {
  TetMesh mesh = io::build_mesh(cube_file(), "cube")->mesh;
  const Box box = rest_bounds(mesh);
  EngineOptions options;
  options.maintain.merge = options.maintain.improve = false;
  RecordedEngineOf cut(std::move(mesh), options);
  std::vector<std::uint64_t> hashes = {cut.engine.mesh().hash()};
  for (const double offset : {0.21, 0.43, 0.67}) {
    ASSERT_TRUE(cut.engine.cut(*plane_stroke(box, Vec3(1, 0, 0), offset)).ok());
    hashes.push_back(cut.engine.mesh().hash());
  }
  const auto has_at_most = [](std::size_t pieces) {
    return [pieces](const TetMesh& m) { return find_components(m).count() <= pieces; };
  };
  EXPECT_EQ(*app::detail::take_back_until(cut.engine, has_at_most(9)), 2U) << "the last one in any case";
  EXPECT_EQ(cut.engine.mesh().hash(), hashes[2]);
  EXPECT_EQ(*app::detail::take_back_until(cut.engine, has_at_most(1)), 0U);
  EXPECT_EQ(cut.engine.mesh().hash(), hashes[0]);
  EXPECT_EQ(*app::detail::take_back_until(cut.engine, has_at_most(0)), 0U) << "nothing is left to take back";
}

TEST(CutJob, refuses_a_blade_out_of_reach_before_anything_is_cut) {
  Result<io::LoadedMesh> loaded = io::build_mesh(cube_file(), "cube");
  app::CutJob job;
  const Box box = rest_bounds(loaded->mesh);
  job.strokes = {*plane_stroke(box, Vec3(1, 0, 0), 0.5), *plane_stroke(box, Vec3(1, 0, 0), 1e8)};
  std::size_t begun = 0;
  job.progress = [&](std::size_t, std::size_t) { ++begun; };
  const Result<app::JobResult> result = app::run_cut(std::move(loaded).value(), job, false);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::kBadArgument);
  EXPECT_NE(result.error().message.find("stroke 1 \"plane\": point 0 at time 0"), std::string::npos)
      << result.error().message;
  EXPECT_EQ(begun, 0U);
}

TEST(MeshLoader, leaves_mid_edge_nodes_out_and_remembers_the_files_numbers) {
  io::MeshFile file;
  file.ten_node = true;
  file.data.soup = {{Vec3(0, 0, 0), Vec3(9, 9, 9), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}, {{0, 2, 4, 3}}, {}};
  file.data.triangles = {{0, 2, 3}, {0, 1, 2}};
  file.data.triangle_stroke = {4, 5};
  file.mid_nodes = {1};
  EXPECT_EQ(io::find_file_defects(file).unreferenced_vertices, 0U);
  const auto loaded = io::build_mesh(file, "x");
  ASSERT_TRUE(loaded.ok());
  EXPECT_EQ(loaded->file_vertex, (std::vector<std::uint32_t>{0, 2, 3, 4}));
  EXPECT_GT(loaded->mesh.rest_volume(TetId(0)), 0);
  EXPECT_EQ(loaded->source.notes.size(), 2U);  // the mid-edge node, and the tet that was turned
  io::drop_mid_nodes(file);
  ASSERT_EQ(file.data.triangles.size(), 1U);
  EXPECT_EQ(file.data.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(file.data.triangle_stroke, (std::vector<std::int32_t>{4}));
}

TEST(MeshInfo, says_what_a_file_has_and_whether_it_is_valid) {
  io::MeshFile file = cube_file();
  std::swap(file.data.soup.tets[3][0], file.data.soup.tets[3][1]);
  file.data.soup.regions.assign(750, 7);
  file.data.soup.regions[0] = -1;
  const app::MeshInfo info = app::inspect(file, "cube");
  EXPECT_NEAR(info.volume, 1, 1e-12);
  EXPECT_EQ(info.regions.size(), 2U);
  const json report = json::parse(app::to_json(info));
  EXPECT_EQ(report["defects"]["inverted"], 1);
  EXPECT_EQ(report["tets"], 750);
  EXPECT_EQ(report["components"], 1);
  EXPECT_FALSE(app::check_mesh(file, "cube")->ok);
  EXPECT_TRUE(app::check_mesh(cube_file(), "cube")->ok);
}

TEST(MeshExport, surface_of_a_cube_is_closed) {
  const auto loaded = io::build_mesh(cube_file(), "cube");
  const io::SurfaceSoup surface = io::to_surface(loaded->mesh);
  EXPECT_EQ(surface.triangles.size(), 300U);
  EXPECT_EQ(surface.points.size(), 152U);
}

}  // namespace

}  // namespace cut_job_test
