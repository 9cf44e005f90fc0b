// SPDX-License-Identifier: Apache-2.0
// Maintenance in jobs: what it is measured by, how a budget bounds it, and what reports say of it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/jobs/cut_job.h"
#include "app/jobs/improve_job.h"
#include "cut/cutter.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/shapes.h"
#include "paper/paper_cut.h"

namespace maintenance_test {
namespace {

using namespace incise;
using nlohmann::json;

io::LoadedMesh load(TetSoup soup) {
  io::MeshFile file;
  file.data.soup = std::move(soup);
  return io::build_mesh(std::move(file), "made").value();
}

/// A cube whose cells are bent, so that cuts without snapping leave slivers.
TetSoup rough_cube() {
  TetSoup soup = kuhn_cube(6);
  jitter(soup, 0.15, 3);
  return soup;
}

app::CutJob three_cuts(Profile profile) {
  const Box box{Vec3(0, 0, 0), Vec3(1, 1, 1)};
  app::CutJob job;
  job.engine.cut = {profile, 0.0};
  job.strokes = {*plane_stroke(box, Vec3(1, 0.1, 0.2), 0.63), *plane_stroke(box, Vec3(0.2, 1, -0.1), 0.48),
                 *plane_stroke(box, Vec3(-0.1, 0.2, 1), 0.57)};
  return job;
}

app::JobResult cut(const app::CutJob& job) {
  return app::run_cut(load(rough_cube()), job, true).value();
}

app::CutJob without_maintenance(app::CutJob job) {
  job.engine.maintain.merge = job.engine.maintain.improve = false;
  return job;
}

/// Whether the built library leaves something to do after the first cut of `three_cuts`.
bool has_something_to_do() {
  app::CutJob job = three_cuts(Profile::kIncise);
  job.engine.maintain.work_units = 0;
  Engine engine = Engine::create(load(rough_cube()).mesh, job.engine).value();
  EXPECT_TRUE(engine.cut(job.strokes[0]).ok());
  return engine.has_maintenance();
}

TEST(Maintenance, switched_off_leaves_the_plain_cut) {
  for (const Profile profile : {Profile::kIncise, Profile::kPaper}) {
    const app::CutJob job = without_maintenance(three_cuts(profile));
    const app::JobReport report = cut(job).report;
    TetMesh mesh = load(rough_cube()).mesh;
    Journal journal;
    StageTimes times;
    Cutter cutter(job.engine.cut);
    for (std::uint32_t i = 0; i < 3; ++i) {
      const auto cut_it = profile == Profile::kPaper ? cut_as_paper(mesh, journal, job.strokes[i], i + 1, 1, times)
                                                     : cutter.cut(mesh, journal, job.strokes[i], i + 1, times);
      ASSERT_TRUE(cut_it.ok());
    }
    EXPECT_EQ(report.hash, mesh.hash());
    EXPECT_EQ(report.maintain.work_units, 0U);
    EXPECT_EQ(report.quality_cut.lr_max, report.quality_after.lr_max);
    EXPECT_EQ(static_cast<std::int64_t>(report.after.tets),
              static_cast<std::int64_t>(report.before.tets) + report.cut.created_tets);
  }
}

TEST(Maintenance, keeps_the_contract_and_its_own_account) {
  for (const Profile profile : {Profile::kIncise, Profile::kPaper}) {
    const app::JobReport report = cut(three_cuts(profile)).report;
    EXPECT_TRUE(report.change.ok) << app::to_text(report);
    EXPECT_EQ(report.after.components, 8U);
    const std::int64_t growth = report.cut.created_tets + report.maintain.created_tets;
    EXPECT_EQ(static_cast<std::int64_t>(report.after.tets), static_cast<std::int64_t>(report.before.tets) + growth);
    ASSERT_EQ(report.units_per_stroke.size(), 3U);
    EXPECT_EQ(report.units_per_stroke[0] + report.units_per_stroke[1] + report.units_per_stroke[2],
              report.maintain.work_units);
    EXPECT_EQ(report.step_ms.size(), 3U);
    EXPECT_GE(report.total_ms, report.times[Stage::kMerge] + report.times[Stage::kImprove]);
  }
}

TEST(Maintenance, never_makes_the_worst_tet_worse_than_the_last_cut_left_it) {
  const app::JobReport report = cut(three_cuts(Profile::kIncise)).report;
  EXPECT_LE(report.quality_after.lr_max, report.quality_cut.lr_max);
  EXPECT_LE(report.quality_incision.lr_max, report.quality_cut_incision.lr_max);
}

TEST(Maintenance, is_measured_right_after_the_last_cut_and_at_the_end) {
  app::CutJob job = three_cuts(Profile::kIncise);
  const app::JobReport all = cut(job).report;
  job.strokes.pop_back();
  const app::JobReport two = cut(job).report;
  EXPECT_EQ(static_cast<std::int64_t>(all.quality_cut.tets),
            static_cast<std::int64_t>(two.after.tets) + all.cut.created_tets - two.cut.created_tets);
  EXPECT_EQ(all.quality_after.tets, all.after.tets);
  EXPECT_GT(all.quality_cut_incision.tets, 0U);
}

TEST(Maintenance, with_a_budget_that_is_never_spent_is_the_same_as_without_one) {
  for (const Profile profile : {Profile::kIncise, Profile::kPaper}) {
    app::CutJob job = three_cuts(profile);
    const app::JobReport without = cut(job).report;
    job.budget_us = app::kMaxBudgetUs;
    const app::JobReport with = cut(job).report;
    EXPECT_EQ(with.hash, without.hash);
    EXPECT_EQ(with.units_per_stroke, without.units_per_stroke);
    EXPECT_EQ(with.maintain.waiting_tets, without.maintain.waiting_tets);
  }
}

TEST(Maintenance, beyond_the_budget_waits_and_is_reported) {
  app::CutJob job = three_cuts(Profile::kIncise);
  job.budget_us = 1;
  const app::JobReport report = cut(job).report;
  EXPECT_TRUE(report.change.ok);
  EXPECT_EQ(report.after.components, 8U);
  if (!has_something_to_do()) GTEST_SKIP() << "nothing to maintain";
  EXPECT_GT(report.maintain.waiting_tets, 0U);
  EXPECT_LT(report.maintain.work_units, cut(three_cuts(Profile::kIncise)).report.maintain.work_units);
  EXPECT_NE(app::to_text(report).find("wait for maintenance"), std::string::npos);
}

TEST(Maintenance, counted_in_work_units_needs_no_clock) {
  app::CutJob job = three_cuts(Profile::kIncise);
  job.engine.maintain.work_units = 1000;
  const app::JobReport once = cut(job).report, again = cut(job).report;
  EXPECT_EQ(once.hash, again.hash);
  EXPECT_EQ(once.units_per_stroke, again.units_per_stroke);
  EXPECT_TRUE(once.change.ok);
  if (!has_something_to_do()) GTEST_SKIP() << "nothing to maintain";
  EXPECT_GE(once.units_per_stroke[0], 1000U);
  EXPECT_GT(once.maintain.waiting_tets, 0U);
}

TEST(Maintenance, bounded_by_a_clock_can_be_done_again_from_the_report) {
  app::CutJob job = three_cuts(Profile::kIncise);
  job.budget_us = 2000;
  const app::JobReport report = cut(job).report;
  job.engine.maintain.work_units = 0;
  Engine engine = Engine::create(load(rough_cube()).mesh, job.engine).value();
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_TRUE(engine.cut(job.strokes[i]).ok());
    EXPECT_EQ(engine.maintain(report.units_per_stroke[i])->maintain.work_units, report.units_per_stroke[i]);
  }
  EXPECT_EQ(engine.mesh().hash(), report.hash);
}

TEST(Maintenance, of_the_paper_knows_no_budget) {
  app::CutJob job = three_cuts(Profile::kPaper);
  const std::uint64_t hash = cut(job).report.hash;
  job.budget_us = 1;
  const app::JobReport report = cut(job).report;
  EXPECT_EQ(report.hash, hash);
  EXPECT_EQ(report.options.budget_us, 1U);
}

TEST(Maintenance, may_change_the_volume_by_what_its_profile_says) {
  EngineOptions options;
  EXPECT_EQ(app::volume_tolerance(options), 1e-9);
  options.cut.profile = Profile::kPaper;
  EXPECT_EQ(app::volume_tolerance(options), 1e-2);
  options.maintain.merge = false;
  EXPECT_EQ(app::volume_tolerance(options), 1e-2);
  options.maintain.improve = false;
  EXPECT_EQ(app::volume_tolerance(options), 1e-12);
  options.cut.profile = Profile::kIncise;
  EXPECT_EQ(app::volume_tolerance(options), 1e-12);
}

TEST(Maintenance, report_repeats_what_was_asked_for) {
  app::CutJob job = three_cuts(Profile::kIncise);
  job.engine.maintain.merge = false;
  job.budget_us = 250;
  const json options = json::parse(app::to_json(cut(job).report))["options"];
  EXPECT_EQ(options["merge"], false);
  EXPECT_EQ(options["improve"], true);
  EXPECT_EQ(options["budget_us"], 250);
  const json plain = json::parse(app::to_json(cut(without_maintenance(three_cuts(Profile::kPaper))).report))["options"];
  EXPECT_EQ(plain["merge"], false);
  EXPECT_EQ(plain["improve"], false);
  EXPECT_TRUE(plain["budget_us"].is_null());
}

TEST(Maintenance, text_shows_the_quality_before_cut_and_after) {
  const std::string text = app::to_text(cut(three_cuts(Profile::kIncise)).report);
  for (const char* part : {"L/r mean", "\nbefore ", "\ncut ", "\nafter ", "\nat walls, cut ", "\nat walls, after "}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << text;
  }
}

// --- improve
// -----------------------------------------------------------------------------------------------------------------

/// A sound mesh with short edges and slivers: a cut one, read again.
TetSoup slivers() {
  return cut(without_maintenance(three_cuts(Profile::kIncise))).mesh.soup;
}

app::JobResult improve(const app::ImproveJob& job) {
  return app::run_improve(load(slivers()), job, true).value();
}

TEST(Improve, makes_no_mesh_worse_and_keeps_its_volume_and_pieces) {
  for (const Profile profile : {Profile::kIncise, Profile::kPaper}) {
    app::ImproveJob job;
    job.engine.cut.profile = profile;
    const app::JobResult result = improve(job);
    const app::JobReport& report = result.report;
    EXPECT_TRUE(report.change.ok) << app::to_text(report);
    EXPECT_EQ(report.after.components, 8U);
    EXPECT_EQ(report.strokes, 0U);
    EXPECT_EQ(report.units_per_stroke.size(), 1U);
    EXPECT_EQ(report.quality_cut.lr_max, report.quality_before.lr_max);
    EXPECT_EQ(result.mesh.soup.tets.size(), report.after.tets);
    EXPECT_EQ(static_cast<std::int64_t>(report.after.tets),
              static_cast<std::int64_t>(report.before.tets) + report.maintain.created_tets);
    if (profile == Profile::kIncise) {
      EXPECT_LE(report.quality_after.lr_max, report.quality_before.lr_max);
    }
  }
}

TEST(Improve, with_a_budget_that_is_never_spent_is_the_same_as_without_one) {
  app::ImproveJob job;
  const app::JobReport without = improve(job).report;
  job.budget_us = app::kMaxBudgetUs;
  EXPECT_EQ(improve(job).report.hash, without.hash);
  job.budget_us = 1;
  const app::JobReport little = improve(job).report;
  EXPECT_TRUE(little.change.ok);
  EXPECT_LE(little.maintain.work_units, without.maintain.work_units);
}

TEST(Improve, report_has_the_keys_of_a_report_and_none_about_cutting) {
  const json report = json::parse(app::to_json(improve({}).report));
  for (const char* key : {"options", "mesh", "cut", "maintain", "quality", "volume", "validity", "time_ms", "step_ms",
                          "stage_ms", "hash"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_EQ(report["strokes"], 0);
  EXPECT_EQ(report["cut"]["cut_tets"], 0);
  EXPECT_FALSE(report["options"].contains("snap"));
  EXPECT_EQ(app::to_text(improve({}).report).find("faces opened"), std::string::npos);
}

}  // namespace

}  // namespace maintenance_test
