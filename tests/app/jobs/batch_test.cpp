// SPDX-License-Identifier: Apache-2.0
// Batches without the command: workers, restarts, merging, computing again.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/jobs/batch_job.h"
#include "app/jobs/batch_lines.h"
#include "app/text/text_file.h"
#include "incise/io/mesh_loader.h"
#include "incise/mesh/bounds.h"
#include "support/folder.h"

namespace batch_test {
namespace {

using namespace incise;
using incise_test::read;
using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t kItems = 10;

json small_scene() {
  return json::parse(R"({"format": "incise-scene", "version": 1, "model": {"box": {"cells": [3, 3, 3]}},
    "length_unit": 0.01, "materials": {"default": {"toughness": 100}}, "attachments": [{"below": [0, 0, 1, 0.01]}],
    "frames": 4})");
}

json small_plan() {
  return {{"format", "incise-plan"},
          {"version", 1},
          {"name", "small"},
          {"defaults", {{"mesh", "cube.mesh"}}},
          {"items",
           {{{"name", "half"}, {"plane", {1, 0, 0, 0.5}}, {"label", "train"}},
            {{"name", "random"}, {"repeat", kItems - 2}, {"random", {{"seed", 5}, {"strokes", 2}}}},
            {{"name", "pressed"},
             {"mesh", ""},
             {"scene", small_scene()},
             {"random", {{"kinds", {"slit"}}, {"seconds", 0.2}}}}}}};
}

/// A tet of a region with a name.
std::string one_tet(const std::string& region) {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"" + region +
         "\"\n$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
         "$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n";
}

class Batch : public testing::Test {
 protected:
  [[nodiscard]] app::BatchPlan plan(const json& text) const {
    const auto read = app::parse_batch_plan(text.dump(), "plan.json", (folder_ / "cube.mesh").substr(0, root_.size()));
    EXPECT_TRUE(read.ok()) << read.error().message;
    return read.ok() ? *read : app::BatchPlan();
  }
  app::BatchReport run(const std::string& name, app::Shard shard = {}, bool retry = false) {
    app::BatchJob job;
    job.folder = folder_ / name;
    job.shard = shard;
    job.retry = retry;
    const auto report = app::run_batch(plan_, job);
    EXPECT_TRUE(report.ok()) << report.error().message;
    return report.ok() ? *report : app::BatchReport();
  }
  /// The merged results of a folder, empty where it is not whole.
  std::string merged(const std::string& name) {
    const auto report = app::merge_batch(plan_, folder_ / name);
    EXPECT_TRUE(report.ok()) << report.error().message;
    return report.ok() && report->is_whole() ? read(report->file) : "";
  }
  static std::vector<json> lines_of(const std::string& text) {
    std::vector<json> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(json::parse(line));
    return lines;
  }

  incise_test::Folder folder_;
  std::string root_ = fs::path(folder_ / "x").parent_path().string();
  std::string cube_ = folder_.write("cube.mesh", incise_test::cube_mesh(3, 0.1));
  app::BatchPlan plan_ = plan(small_plan());
};

TEST_F(Batch, results_are_the_same_whatever_the_shards_were) {
  EXPECT_EQ(run("one").done, kItems);
  const std::string whole = merged("one");
  EXPECT_EQ(lines_of(whole).size(), kItems);
  for (std::uint32_t i = 3; i-- > 0;) run("three", {i, 3});
  EXPECT_EQ(merged("three"), whole);
  for (const auto& at : fs::directory_iterator(folder_ / "one/after")) {
    EXPECT_EQ(read(at.path()), read(fs::path(folder_ / "three/after") / at.path().filename()));
  }
}

TEST_F(Batch, a_line_says_what_came_out) {
  run("out");
  const std::vector<json> lines = lines_of(merged("out"));
  ASSERT_EQ(lines.size(), kItems);
  EXPECT_EQ(lines[0]["name"], "half");
  EXPECT_EQ(lines[0]["label"], "train");
  EXPECT_EQ(lines[0]["pieces"], 2);
  EXPECT_EQ(lines[0]["input"]["tets"], 162);
  EXPECT_NEAR(lines[0]["volumes"][0].get<double>(), 0.5, 1e-12);
  EXPECT_TRUE(lines[0]["valid"]);
  EXPECT_GT(lines[0]["quality"]["after"]["lr_mean"], 4.8);
  EXPECT_EQ(lines[1]["name"], "random-0000");
  EXPECT_EQ(lines[1]["strokes"], 2);
  const json& pressed = lines[kItems - 1];
  EXPECT_GT(pressed["forces"]["peak_force"], 0);
  EXPECT_TRUE(pressed.contains("state_hash"));
  const std::string page = read(INCISE_DOCS "/batches.md");
  for (const auto& field : pressed.items()) EXPECT_NE(page.find("`" + field.key() + "`"), page.npos) << field.key();
  for (const json& line : lines) {
    const auto mesh = io::load_mesh(folder_ / ("out/" + line["file"].get<std::string>()));
    ASSERT_TRUE(mesh.ok()) << mesh.error().message;
    EXPECT_EQ(mesh->mesh.tet_count(), line["tets"]);
    const auto before = io::load_mesh(folder_ / ("out/" + line["input"]["file"].get<std::string>()));
    EXPECT_EQ(before->mesh.tet_count(), line["input"]["tets"]);
  }
}

TEST_F(Batch, the_strokes_that_were_written_make_the_same_cut) {
  run("out");
  const json line = lines_of(merged("out"))[3];
  json text = {{"format", "incise-plan"},
               {"version", 1},
               {"items",
                {{{"mesh", "out/" + line["input"]["file"].get<std::string>()},
                  {"blade", "out/" + line["strokes_file"].get<std::string>()}}}}};
  plan_ = plan(text);
  run("again");
  EXPECT_EQ(lines_of(merged("again"))[0]["tets"], line["tets"]);
}

TEST_F(Batch, a_second_run_computes_nothing) {
  run("out", {0, 2});
  const app::BatchReport other = run("out");  // another number of shards
  EXPECT_EQ(other.skipped, kItems / 2);
  EXPECT_EQ(other.done, kItems / 2);
  EXPECT_EQ(run("out").skipped, kItems);
  EXPECT_EQ(run("out", {4, 7}).done, 0U);
}

TEST_F(Batch, a_line_that_was_cut_off_is_computed_again) {
  run("whole");
  run("out");
  const std::string file = folder_ / "out/shard-00000-of-00001.jsonl";
  const std::string text = read(file);
  for (const std::size_t left :
       {text.size() - 1, text.size() - 40, text.find('\n') + 1, std::size_t{7}, std::size_t{0}}) {
    fs::resize_file(file, left);
    run("out");
    EXPECT_EQ(read(file), text) << left;
  }
  EXPECT_EQ(merged("out"), merged("whole"));
}

TEST_F(Batch, a_shard_has_one_worker_at_a_time) {
  fs::create_directory(folder_ / "out");
  const auto file = app::ShardFile::open(folder_ / "out", {1, 2});
  ASSERT_TRUE(file.ok());
  app::BatchJob job;
  job.folder = folder_ / "out";
  job.shard = {1, 2};
  const auto refused = app::run_batch(plan_, job);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("another worker is at this shard"), std::string::npos);
  job.shard = {0, 2};
  EXPECT_TRUE(app::run_batch(plan_, job).ok());
}

/// A worker would wait for ever for what comes out of it.
TEST_F(Batch, a_pipe_is_no_file_of_a_shard) {
  fs::create_directory(folder_ / "out");
  const std::string pipe = folder_ / "out/shard-00000-of-00001.jsonl";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0666), 0);
  app::BatchJob job;
  job.folder = folder_ / "out";
  const auto as_run = app::run_batch(plan_, job);
  const auto as_merged = app::merge_batch(plan_, job.folder);
  ASSERT_FALSE(as_run.ok());
  ASSERT_FALSE(as_merged.ok());
  EXPECT_EQ(as_run.error().message, pipe + ": is no regular file; take it away");
  EXPECT_EQ(as_merged.error().message, as_run.error().message);
}

TEST_F(Batch, a_folder_that_cannot_be_made_is_named) {
  app::BatchJob job;
  job.folder = folder_ / "no/no";
  const auto refused = app::run_batch(plan_, job);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kIo);
  EXPECT_EQ(refused.error().message.rfind(job.folder.string() + ": cannot be written: ", 0), 0U)
      << refused.error().message;
}

TEST_F(Batch, results_of_another_plan_are_refused) {
  run("out");
  json other = small_plan();
  other["items"][1]["random"]["seed"] = 6;
  plan_ = plan(other);
  app::BatchJob job;
  job.folder = folder_ / "out";
  for (const std::string& message :
       {app::run_batch(plan_, job).error().message, app::merge_batch(plan_, job.folder).error().message}) {
    EXPECT_NE(message.find("shard-00000-of-00001.jsonl:2: item 1 is of another plan"), std::string::npos) << message;
  }
}

/// Workers of two machines may see two meshes under one path.
TEST_F(Batch, results_of_two_meshes_under_one_path_are_not_mixed) {
  const std::string first = read(cube_);
  run("out", {0, 2});
  folder_.write("cube.mesh", incise_test::cube_mesh(4));
  run("other", {1, 2});
  fs::copy_file(folder_ / "other/shard-00001-of-00002.jsonl", folder_ / "out/shard-00001-of-00002.jsonl");
  fs::copy(folder_ / "other/after", folder_ / "out/after");
  const auto merged_two = app::merge_batch(plan_, folder_ / "out");
  ASSERT_FALSE(merged_two.ok());
  EXPECT_EQ(merged_two.error().code, ErrorCode::kBadFile);
  for (const char* part :
       {"out/shard-00001-of-00002.jsonl:1: the mesh \"cube.mesh\" of item \"random-0000\" has the key ",
        "out/shard-00000-of-00002.jsonl:1", "they are two meshes"}) {
    EXPECT_NE(merged_two.error().message.find(part), std::string::npos) << merged_two.error().message;
  }
  fs::remove(folder_ / "out/shard-00001-of-00002.jsonl");
  app::BatchJob job;
  job.folder = folder_ / "out";
  job.shard = {1, 2};
  const auto refused = app::run_batch(plan_, job);
  ASSERT_FALSE(refused.ok()) << "a worker looks at its mesh before it computes";
  EXPECT_NE(refused.error().message.find("shard-00000-of-00002.jsonl:1"), std::string::npos);
  EXPECT_EQ(read(folder_ / "out/shard-00001-of-00002.jsonl"), "");
  folder_.write("cube.mesh", first);
  run("out", {1, 2});
  EXPECT_NE(merged("out"), "");
}

/// Of a file that says the same about all tets, and calls a region by another name.
TEST_F(Batch, names_of_regions_make_another_mesh) {
  plan_ = plan({{"format", "incise-plan"},
                {"version", 1},
                {"items", {{{"mesh", folder_.write("tet.msh", one_tet("fat"))}, {"plane", {1, 0, 0, 0.3}}}}}});
  run("out");
  folder_.write("tet.msh", one_tet("skin"));
  app::VerifyJob job;
  job.folder = folder_ / "out";
  const auto report = app::verify_batch(plan_, job);
  ASSERT_TRUE(report.ok()) << report.error().message;
  ASSERT_EQ(report->differences.size(), 1U);
  EXPECT_EQ(report->differences[0].rfind("item-000000: another mesh: key ", 0), 0U) << report->differences[0];
}

TEST_F(Batch, results_of_two_versions_of_the_program_are_not_mixed) {
  run("out");
  const std::string file = folder_ / "out/shard-00000-of-00001.jsonl", name = "\"program\":\"incise ";
  std::string text = read(file);
  text.insert(text.find(name, text.find('\n')) + name.size(), "9");
  folder_.write("out/shard-00000-of-00001.jsonl", text);
  app::BatchJob job;
  job.folder = folder_ / "out";
  const auto as_merged = app::merge_batch(plan_, job.folder);
  const auto as_run = app::run_batch(plan_, job);
  ASSERT_FALSE(as_merged.ok());
  ASSERT_FALSE(as_run.ok());
  for (const std::string& message : {as_merged.error().message, as_run.error().message}) {
    EXPECT_NE(message.find("shard-00000-of-00001.jsonl:2: was made by incise 9"), std::string::npos) << message;
    EXPECT_NE(message.find(" by incise "), std::string::npos) << message;
  }
}

/// A text editor, or a disk that was full, may leave lines that are no results.
TEST_F(Batch, a_line_that_is_no_result_is_told_with_its_remedy_and_taken_off_by_a_retry) {
  run("whole", {0, 2});
  run("whole", {1, 2});
  run("out", {0, 2});
  run("out", {1, 2});
  const std::string name = "out/shard-00001-of-00002.jsonl", text = read(folder_ / name);
  const std::size_t second = text.find('\n') + 1, third = text.find('\n', second) + 1;
  for (const std::string garbage : {"garbage\n", "{}\n", "\n", "[1, 2]\n", "{\"item\": 3}\n", "\xff\xfe\n"}) {
    folder_.write(name, text.substr(0, second) + garbage + text.substr(third));
    const auto report = app::merge_batch(plan_, folder_ / "out");
    ASSERT_FALSE(report.ok()) << garbage;
    const std::string& message = report.error().message;
    EXPECT_EQ(message.rfind(folder_ / name + ":2: ", 0), 0U) << message;
    EXPECT_NE(message.find("; run incise batch with --shard 1/2 --retry, which takes the line off"), std::string::npos)
        << message;
    EXPECT_EQ(run("out", {0, 2}, true).done, 0U) << "not its own";
    EXPECT_EQ(run("out", {1, 2}, true).done, 1U) << garbage;
    EXPECT_EQ(merged("out"), merged("whole"));
  }
}

/// All places of a line, but for those in lists.
std::vector<json::json_pointer> places_of(const json& value, const json::json_pointer& at = json::json_pointer("")) {
  std::vector<json::json_pointer> places;
  for (const auto& field : value.items()) {
    places.push_back(at / field.key());
    if (!field.value().is_object()) continue;
    for (const auto& place : places_of(field.value(), at / field.key())) places.push_back(place);
  }
  return places;
}

/// The line without what is at a place, and with other values there, that no such line has.
std::vector<json> spoiled(const json& line, const json::json_pointer& place) {
  std::vector<json> lines(3, line);
  lines[0][place.parent_pointer()].erase(place.back());
  lines[1][place] = json::object();
  lines[2][place] = {1, 2, 3};
  if (place.back() != "message") {
    lines.push_back(line);
    lines.back()[place] = "zzz";
  }
  const bool is_force = place.to_string().rfind("/forces/", 0) == 0;  // work may be below zero, and not finite
  if (!line[place].is_null() && !(is_force && line[place].is_number_float())) {
    lines.push_back(line);
    lines.back()[place] = nullptr;
    lines.push_back(line);
    lines.back()[place] = -7;
  }
  return lines;
}

/// Whatever a line lacks, or has of another type, it is no result.
TEST_F(Batch, a_line_is_checked_as_a_whole) {
  json text = small_plan();
  text["items"].push_back({{"name", "bad"}, {"mesh", folder_.write("bad.mesh", "x")}, {"plane", {1, 0, 0, 0.5}}});
  plan_ = plan(text);
  run("out");
  const std::string shard = "out/shard-00000-of-00001.jsonl", whole = read(folder_ / shard);
  std::vector<json> lines = lines_of(whole);
  for (const std::size_t index : {std::size_t{0}, kItems - 1, kItems}) {
    for (const auto& place : places_of(lines[index])) {
      for (const json& other : spoiled(lines[index], place)) {
        std::string file;
        for (std::size_t i = 0; i < lines.size(); ++i) file += (i == index ? other : lines[i]).dump() + "\n";
        folder_.write(shard, file);
        EXPECT_FALSE(app::merge_batch(plan_, folder_ / "out").ok()) << place << ": " << other.dump();
      }
    }
  }
}

TEST_F(Batch, a_line_has_the_name_and_files_of_its_item_and_no_other_fields) {
  run("out");
  const std::string shard = "out/shard-00000-of-00001.jsonl", whole = read(folder_ / shard);
  const json first = lines_of(whole)[0];
  const auto told = [&](const json& changes, const std::string& part) {
    json line = first;
    line.merge_patch(changes);
    folder_.write(shard, line.dump() + whole.substr(whole.find('\n')));
    const auto report = app::merge_batch(plan_, folder_ / "out");
    ASSERT_FALSE(report.ok()) << changes;
    EXPECT_NE(report.error().message.find(part), std::string::npos) << report.error().message;
    EXPECT_NE(report.error().message.find("with --shard 0/1 --retry"), std::string::npos) << report.error().message;
    EXPECT_EQ(run("out", {}, true).done, 1U) << changes;
  };
  told({{"name", "wrong"}}, "name is \"wrong\"; the plan has \"half\"");
  told({{"label", "test"}}, "label is \"test\"; the plan has \"train\"");
  told({{"file", nullptr}}, "lacks the key \"file\"");
  told({{"strokes_file", nullptr}}, "lacks the key \"strokes_file\"");
  told({{"file", "after/random-0000.vtu"}}, "must name a file in the batch's folder as the plan has it");
  told({{"more", 1}}, "has the unknown key \"more\"");
  told({{"forces", 1}}, "has the unknown key \"forces\"");
}

TEST_F(Batch, scenes_may_have_materials_by_the_names_of_regions) {
  json scene = small_scene();
  scene["model"] = {{"file", folder_.write("tet.msh", one_tet("fat"))}};
  scene["materials"] = {{"regions", {{{"region", "fat"}, {"young", 2000}}}}};
  scene["attachments"] = json::array();
  plan_ = plan({{"format", "incise-plan"},
                {"version", 1},
                {"items", {{{"scene", scene}, {"random", {{"kinds", {"plane"}}, {"seconds", 0.1}}}}}}});
  EXPECT_TRUE(run("out").failed.empty());
  EXPECT_EQ(lines_of(merged("out"))[0]["valid"], true);
}

TEST_F(Batch, a_merge_tells_what_is_missing) {
  run("out", {0, 3});
  run("out", {2, 3});
  const auto report = app::merge_batch(plan_, folder_ / "out");
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->missing, (std::vector<std::string>{"random-0000", "random-0003", "random-0006"}));
  EXPECT_FALSE(report->is_whole());
  EXPECT_FALSE(fs::exists(folder_ / "out/results.jsonl"));
}

TEST_F(Batch, a_merge_takes_an_item_that_was_computed_twice_once) {
  run("out");
  const std::string whole = merged("out");
  fs::copy_file(folder_ / "out/shard-00000-of-00001.jsonl", folder_ / "out/shard-00001-of-00002.jsonl");
  const auto report = app::merge_batch(plan_, folder_ / "out");
  EXPECT_EQ(report->repeated, kItems);
  EXPECT_TRUE(report->is_whole());
  EXPECT_EQ(read(report->file), whole);
}

TEST(BatchShard, is_known_by_its_name_alone) {
  for (const app::Shard shard : {app::Shard{0, 1}, app::Shard{7, 12}, app::Shard{99'998, 99'999}}) {
    const auto named = app::shard_named(app::name_of(shard));
    ASSERT_TRUE(named.has_value());
    EXPECT_EQ(named->index, shard.index);
    EXPECT_EQ(named->count, shard.count);
  }
  for (const char* name :
       {"", "shard-", "shard-00001-of-0000x", "shard-1-of-2", "shard-+0001-of-00002", "shard-00001-of-00002x",
        "Shard-00001-of-00002", "shard-00001-to-00002", "shard- 0001-of-00002"}) {
    EXPECT_FALSE(app::shard_named(name).has_value()) << name;
  }
}

TEST_F(Batch, a_merge_takes_away_what_killed_workers_left_half_written) {
  run("out", {0, 3});
  run("out", {1, 3});
  run("out", {2, 3});
  const std::string of_killed = folder_.write("out/after/half.vtu.shard-00001-of-00003.incise-part", "<VTK");
  const std::string of_part = folder_.write("out/after/half.vtu.shard-00001-of-00003.99999.0.incise-part", "<VTK");
  const std::string of_gone = folder_.write("out/before/0.vtu.shard-00007-of-00009", "<VTK");
  const std::string of_live = folder_.write("out/strokes/half.json.shard-00002-of-00003.incise-part", "{");
  const std::string of_other = folder_.write("out/after/notes.txt", "mine");
  const std::string of_nobody = folder_.write("out/after/.shard-00001-of-00003", "mine");
  const std::string longer = folder_.write("out/after/half.vtu.shard-000010-of-00003.incise-part", "mine");
  const auto live = app::ShardFile::open(folder_ / "out", {2, 3});
  ASSERT_TRUE(live.ok());
  EXPECT_NE(merged("out"), "");
  EXPECT_FALSE(fs::exists(of_killed));
  EXPECT_FALSE(fs::exists(of_part));
  EXPECT_FALSE(fs::exists(of_gone));
  EXPECT_TRUE(fs::exists(of_live));
  EXPECT_TRUE(fs::exists(of_other));
  EXPECT_TRUE(fs::exists(of_nobody));
  EXPECT_TRUE(fs::exists(longer));
  EXPECT_TRUE(fs::exists(folder_ / "out/after/half.vtu"));
}

TEST_F(Batch, a_merge_refuses_results_that_differ) {
  run("out");
  std::string text = read(folder_ / "out/shard-00000-of-00001.jsonl");
  const std::size_t at = text.find("\"tets\":", text.find("\"pieces\"") - 40) + 7;
  text[at] = text[at] == '9' ? '8' : '9';
  folder_.write("out/shard-00000-of-00002.jsonl", text.substr(0, text.find('\n') + 1));
  const auto report = app::merge_batch(plan_, folder_ / "out");
  EXPECT_EQ(report->contradictory, std::vector<std::string>{"half"});
  EXPECT_FALSE(report->is_whole());
}

TEST_F(Batch, a_merge_looks_at_the_files) {
  run("out");
  const std::string mesh = "after/random-0002.vtu";
  std::string bytes = read(folder_ / ("out/" + mesh));
  bytes[bytes.size() / 2] ^= 1;
  folder_.write("out/" + mesh, bytes);
  fs::remove(folder_ / "out/after/pressed.vtu");
  const auto report = app::merge_batch(plan_, folder_ / "out");
  EXPECT_EQ(report->broken_files, (std::vector<std::string>{mesh, "after/pressed.vtu"}));
}

/// A disk that was full, or lost power, keeps lines whose files are not whole.
TEST_F(Batch, files_that_are_gone_or_cut_off_are_made_again) {
  run("whole");
  const std::string whole = merged("whole");
  run("out");
  const std::string before = lines_of(whole)[0]["input"]["file"];
  fs::resize_file(folder_ / "out/after/random-0002.vtu", 100);
  fs::remove(folder_ / "out/after/pressed.vtu");
  fs::remove(folder_ / "out/strokes/random-0003.json");
  fs::resize_file(folder_ / ("out/" + before), 0);
  const auto told = app::merge_batch(plan_, folder_ / "out");
  EXPECT_EQ(told->broken_files, (std::vector<std::string>{before, "after/random-0002.vtu", "strokes/random-0003.json",
                                                          "after/pressed.vtu"}));
  EXPECT_EQ(run("out").done, 4U);
  EXPECT_EQ(merged("out"), whole);
  for (const std::string& file : told->broken_files) {
    EXPECT_EQ(read(folder_ / ("out/" + file)), read(folder_ / ("whole/" + file))) << file;
  }
}

TEST_F(Batch, files_with_other_bytes_are_made_again_where_a_retry_reads_them) {
  run("out");
  const std::string whole = merged("out"), before = lines_of(whole)[0]["input"]["file"];
  fs::remove(folder_ / "out/results.jsonl");
  std::string bytes = read(folder_ / "out/after/random-0002.vtu");
  bytes[bytes.size() / 2] ^= 1;
  folder_.write("out/after/random-0002.vtu", bytes);
  for (const std::string& file : {before, std::string("strokes/half.json")}) {
    fs::resize_file(folder_ / ("out/" + file), fs::file_size(folder_ / ("out/" + file)) / 2);
  }
  EXPECT_EQ(run("out").done, 0U);
  EXPECT_EQ(app::merge_batch(plan_, folder_ / "out")->broken_files.size(), 3U);
  EXPECT_EQ(run("out", {}, true).done, 2U) << "the mesh before it is that of the item whose strokes are broken";
  EXPECT_EQ(merged("out"), whole);
}

/// What is broken is removed: lines from elsewhere must not name what is not the batch's.
TEST_F(Batch, lines_name_files_of_the_batch_alone) {
  run("out");
  const std::string shard = "out/shard-00000-of-00001.jsonl", text = read(folder_ / shard);
  for (const std::string own : {"after/half.vtu", "strokes/half.json", "before/"}) {
    for (const std::string other :
         {"../cube.mesh", "after/../../cube.mesh", "before/..", "/etc/passwd", "after/", ""}) {
      const std::size_t at = text.find(own), end = text.find('"', at);
      folder_.write(shard, text.substr(0, at) + other + text.substr(end));
      const auto report = app::merge_batch(plan_, folder_ / "out");
      ASSERT_FALSE(report.ok()) << own << " " << other;
      EXPECT_NE(report.error().message.find("must name a file in"), std::string::npos) << report.error().message;
      EXPECT_EQ(run("out", {}, true).done, 1U) << "the line is none: it was taken off";
    }
  }
  EXPECT_FALSE(read(cube_).empty());
}

TEST_F(Batch, an_item_that_fails_does_not_stop_the_others) {
  json text = small_plan();
  text["items"][0]["mesh"] = folder_.write("bad.mesh", "MeshVersionFormatted 2\nDimension 3\n");
  plan_ = plan(text);
  const app::BatchReport report = run("out");
  EXPECT_EQ(report.done, kItems);
  ASSERT_EQ(report.failed.size(), 1U);
  EXPECT_EQ(report.failed[0].rfind("half: ", 0), 0U) << report.failed[0];
  EXPECT_EQ(lines_of(merged("out"))[0]["error"]["code"], "bad_file");
  EXPECT_EQ(run("out").skipped, kItems);
  folder_.write("bad.mesh", read(cube_));
  EXPECT_EQ(run("out", {}, true).done, 1U);
  EXPECT_FALSE(lines_of(merged("out"))[0].contains("error"));
}

/// Messages name paths as the worker was given them.
TEST_F(Batch, an_item_may_fail_twice_in_other_words) {
  folder_.write("cube.mesh", read(cube_).substr(0, 100));
  run("out");
  const std::string file = folder_ / "out/shard-00000-of-00001.jsonl";
  std::string text = read(file);
  for (std::size_t at = 0; (at = text.find(root_, at)) != std::string::npos;)
    text.replace(at, root_.size(), "/elsewhere");
  folder_.write("out/shard-00001-of-00002.jsonl", text);
  const auto report = app::merge_batch(plan_, folder_ / "out");
  ASSERT_TRUE(report.ok()) << report.error().message;
  EXPECT_TRUE(report->is_whole());
  EXPECT_EQ(report->failed, kItems - 1);
  EXPECT_EQ(report->repeated, kItems);
  EXPECT_NE(lines_of(read(report->file))[0]["error"]["message"].get<std::string>().find("/elsewhere"),
            std::string::npos);
  folder_.write("cube.mesh", incise_test::cube_mesh(3, 0.1));
  EXPECT_EQ(run("out", {}, true).done, kItems - 1);
  EXPECT_EQ(app::merge_batch(plan_, folder_ / "out")->failed, 0U);
}

TEST_F(Batch, stops_where_asked_to_and_goes_on_later) {
  app::BatchJob job;
  job.folder = folder_ / "out";
  int asked = 0;
  job.should_stop = [&] { return ++asked > 3; };
  const auto report = app::run_batch(plan_, job);
  ASSERT_TRUE(report.ok());
  EXPECT_TRUE(report->was_stopped);
  EXPECT_EQ(report->done, 3U);
  run("out");
  run("whole");
  EXPECT_EQ(merged("out"), merged("whole"));
}

TEST_F(Batch, items_that_are_computed_again_have_the_same_hashes) {
  run("out");
  app::VerifyJob job;
  job.folder = folder_ / "out";
  job.items = 100;
  job.threads = 2;
  const auto report = app::verify_batch(plan_, job);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->items, kItems);
  EXPECT_TRUE(report->differences.empty());
  job.items = 3;
  EXPECT_EQ(app::verify_batch(plan_, job)->items, 3U);
}

TEST_F(Batch, a_hash_that_differs_is_told) {
  run("out");
  std::string text = read(folder_ / "out/shard-00000-of-00001.jsonl");
  const std::size_t at = text.find("\"state_hash\":\"") + 14;
  text[at] = text[at] == '0' ? '1' : '0';
  folder_.write("out/shard-00000-of-00001.jsonl", text);
  app::VerifyJob job;
  job.folder = folder_ / "out";
  job.items = 100;
  const auto report = app::verify_batch(plan_, job);
  ASSERT_EQ(report->differences.size(), 1U);
  EXPECT_EQ(report->differences[0].rfind("pressed: state_hash ", 0), 0U) << report->differences[0];
}

TEST_F(Batch, any_figure_that_comes_out_differently_is_told) {
  run("out");
  const std::string shard = "out/shard-00000-of-00001.jsonl", whole = read(folder_ / shard);
  const json first = lines_of(whole)[0];
  app::VerifyJob job;
  job.folder = folder_ / "out";
  job.items = 100;
  const json changes = {{"/tets", 7},
                        {"/volumes", {1, 2}},
                        {"/quality/after/lr_mean", 3.5},
                        {"/valid", false},
                        {"/stroke_names", {"x"}},
                        {"/input/tets", 5},
                        {"/cut_tets", 1000000},
                        {"/quality/before/lr_max", 12.5}};
  for (const auto& change : changes.items()) {
    json line = first;
    line[json::json_pointer(change.key())] = change.value();
    folder_.write(shard, line.dump() + whole.substr(whole.find('\n')));
    const auto report = app::verify_batch(plan_, job);
    ASSERT_TRUE(report.ok()) << report.error().message;
    ASSERT_EQ(report->differences.size(), 1U) << change.key();
    std::string name = change.key().substr(1);
    std::replace(name.begin(), name.end(), '/', '.');
    EXPECT_EQ(report->differences[0].rfind("half: " + name + " ", 0), 0U) << report->differences[0];
    EXPECT_NE(report->differences[0].find(" in the results"), std::string::npos) << report->differences[0];
  }
}

// --- what cannot be written

TEST_F(Batch, says_that_results_go_into_a_folder) {
  app::BatchJob job;
  job.folder = cube_;
  const auto as_run = app::run_batch(plan_, job);
  const auto as_merged = app::merge_batch(plan_, job.folder);
  ASSERT_FALSE(as_run.ok());
  ASSERT_FALSE(as_merged.ok());
  for (const std::string& message : {as_run.error().message, as_merged.error().message}) {
    EXPECT_EQ(message, cube_ + ": is a file; results go into a folder: name one with -o");
  }
}

TEST_F(Batch, says_what_to_do_where_nothing_can_be_written) {
  app::BatchJob job;
  for (const std::string& folder : {folder_ / "no/no", std::string("/proc/foo"), cube_ + "/out"}) {
    job.folder = folder;
    const auto refused = app::run_batch(plan_, job);
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().message.find("; "), std::string::npos) << refused.error().message;
  }
  const Status full = app::write_text_file("/dev/full", "results");
  ASSERT_FALSE(full.ok());
  EXPECT_NE(full.error().message.find("; make room on the disk"), std::string::npos) << full.error().message;
}

// --- shards

TEST(BatchShard, may_be_counted_from_0_or_from_1) {
  EXPECT_EQ(app::parse_shard("0/4")->index, 0U);
  EXPECT_EQ(app::parse_shard("3/4")->index, 3U);
  EXPECT_EQ(app::parse_shard("4/4")->index, 0U);
  EXPECT_EQ(app::parse_shard("1/1")->index, 0U);
  for (const char* text : {"", "/", "1", "1/", "/4", "5/4", "0/0", "-1/4", "1/4 ", "1/100000", "99999999999/3"}) {
    EXPECT_FALSE(app::parse_shard(text).ok()) << text;
  }
}

Result<std::optional<app::Shard>> slurm(const std::map<std::string, std::string>& variables) {
  return app::slurm_shard([&](const char* name) {
    const auto found = variables.find(name);
    return found == variables.end() ? std::nullopt : std::optional<std::string>(found->second);
  });
}

TEST(BatchShard, of_a_slurm_array_is_its_tasks_place) {
  const auto task = [](const char* id, const char* low, const char* high, const char* step, const char* count) {
    return slurm({{"SLURM_ARRAY_TASK_ID", id},
                  {"SLURM_ARRAY_TASK_MIN", low},
                  {"SLURM_ARRAY_TASK_MAX", high},
                  {"SLURM_ARRAY_TASK_STEP", step},
                  {"SLURM_ARRAY_TASK_COUNT", count}});
  };
  EXPECT_FALSE(slurm({})->has_value());
  EXPECT_EQ((*task("7", "4", "7", "1", "4"))->index, 3U);
  EXPECT_EQ((*task("4", "0", "8", "2", "5"))->index, 2U);
  EXPECT_EQ((*task("4", "0", "8", "2", "5"))->count, 5U);
  EXPECT_FALSE(task("5", "1", "5", "1", "3").ok());  // --array=1,3,5
  EXPECT_FALSE(task("1", "1", "5", "1", "3").ok());
  EXPECT_FALSE(slurm({{"SLURM_ARRAY_TASK_ID", "1"}}).ok());
}

// --- random strokes

TEST(RandomStrokes, are_the_same_everywhere) {
  StateHash hash;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    app::RandomStrokes wanted;
    wanted.seed = seed;
    wanted.strokes = 3;
    for (const Stroke& stroke : app::random_strokes(wanted, {Vec3::Zero(), Vec3(3, 2, 1)})) {
      EXPECT_TRUE(check(stroke).ok());
      for (const auto& edge : stroke.edges) {
        for (const Vec3& p : edge) {
          for (int k = 0; k < 3; ++k) hash.add(p[k]);
        }
      }
    }
  }
  EXPECT_EQ(hash.value(), 0xd6fa1983b99807feU);  // plans that are published rely on it
}

TEST(RandomStrokes, planes_go_through_the_whole_body) {
  app::RandomStrokes wanted;
  wanted.kinds = {app::RandomKind::kPlane, app::RandomKind::kArc};
  const Box body{Vec3(-1, -2, -3), Vec3(4, 3, 2)};
  for (wanted.seed = 0; wanted.seed < 50; ++wanted.seed) {
    const Stroke stroke = app::random_strokes(wanted, body).front();
    for (const auto& edge : {stroke.edges.front(), stroke.edges.back()}) {
      for (const Vec3& end : {edge.front(), edge.back()}) {
        EXPECT_FALSE((end.array() >= body.lo.array()).all() && (end.array() <= body.hi.array()).all());
      }
    }
  }
}

}  // namespace

}  // namespace batch_test
