// SPDX-License-Identifier: Apache-2.0
// Workers append lines to files of their own and agree on nothing else; the merge chooses among lines of one item and
// looks at their files; the check computes a sample again and compares field by field.
#include "app/jobs/batch_job.h"

#include <algorithm>
#include <map>
#include <system_error>
#include <utility>

#include "app/jobs/batch_files.h"
#include "app/jobs/batch_item.h"
#include "app/jobs/batch_lines.h"
#include "app/jobs/batch_origins.h"
#include "app/text/counted.h"
#include "app/text/json_write.h"
#include "app/text/text_file.h"
#include "app/text/write_all.h"
#include "incise/core/hash.h"
#include "incise/version.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxListedNames = 100;
constexpr const char* kResults = "results.jsonl";

// --- one worker

class Worker {
 public:
  Worker(const BatchPlan& plan, const BatchJob& job) : plan_(plan), job_(job), origins_(plan) {
    report_.plan = plan.name;
    report_.shard = job.shard;
  }

  Result<BatchReport> run() {
    std::error_code code;
    if (!fs::create_directory(job_.folder, code) && code) {
      std::error_code ignored;
      if (!fs::exists(job_.folder, ignored)) return write_error(job_.folder, code);
    }
    if (const Status status = check_results_folder(job_.folder); !status.ok()) return status.error();
    Result<ShardFile> file = ShardFile::open(job_.folder, job_.shard);
    if (!file.ok()) return file.error();
    if (job_.retry) {
      if (const Status status = take_off_bad_lines(*file); !status.ok()) return status.error();
    }
    const Result<std::vector<std::size_t>> left = items_left();
    if (!left.ok()) return left.error();
    for (const std::size_t index : *left) {
      if (job_.progress)
        job_.progress(static_cast<std::size_t>(report_.skipped + report_.done),
                      static_cast<std::size_t>(report_.items));
      if (job_.should_stop && job_.should_stop()) report_.was_stopped = true;
      if (report_.was_stopped) break;
      if (const Status status = run_one(index, *file); !status.ok()) return status.error();
    }
    if (job_.progress)
      job_.progress(static_cast<std::size_t>(report_.skipped + report_.done), static_cast<std::size_t>(report_.items));
    return std::move(report_);
  }

 private:
  Status take_off_bad_lines(ShardFile& file) {
    const Result<std::uint64_t> bad = file.take_off_bad_lines(plan_);
    if (!bad.ok()) return bad.error();
    if (*bad > 0 && job_.log) {
      job_.log(LogLevel::kWarning, name_of(job_.shard) + ".jsonl: took off " + counted(*bad, "line") +
                                       " that were no results; their items are computed again");
    }
    return {};
  }
  /// Of the shard, without those that any worker has done.
  Result<std::vector<std::size_t>> items_left() {
    // Bad lines of other shards are for a retry of those to mend.
    const Result<BatchLines> lines =
        read_batch_lines(plan_, job_.folder, job_.retry ? BadLines::kAreLeftOut : BadLines::kAreErrors);
    if (!lines.ok()) return lines.error();
    if (const Status status = origins_.add_program(kBatchProgram, "this program"); !status.ok()) return status.error();
    for (const BatchLine& line : lines->lines) {
      if (const Status status = origins_.add(line); !status.ok()) return status.error();
    }
    std::vector<bool> is_done(plan_.items.size()), is_broken(plan_.items.size());
    BatchFiles files(job_.folder, job_.retry ? BatchFiles::Care::kContent : BatchFiles::Care::kSizes);
    for (const BatchLine& line : lines->lines) {
      const auto item = static_cast<std::size_t>(line.item);
      if (!job_.shard.has(item)) continue;
      if (!line.has_failed || !job_.retry) is_done[item] = true;
      if (take_away_broken(files, line)) is_broken[item] = true;
    }
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < is_done.size(); ++i) {
      if (!job_.shard.has(i)) continue;
      ++report_.items;
      if (!is_done[i] || is_broken[i]) left.push_back(i);
    }
    report_.skipped = report_.items - left.size();
    return left;
  }
  /// Files that are not as a line has them give way to new ones. Whether there were any.
  bool take_away_broken(BatchFiles& files, const BatchLine& line) const {
    const std::vector<std::string> broken = files.broken(line);
    std::error_code ignored;
    for (const std::string& name : broken) fs::remove(job_.folder / name, ignored);
    return !broken.empty();
  }
  Status run_one(std::size_t index, ShardFile& file) {
    BatchItemJob item_job{job_.folder, name_of(job_.shard), job_.threads, job_.log, job_.should_stop, {}};
    Status origin;
    item_job.takes_input = [&](std::uint64_t key) {
      origin = origins_.add_input(index, key, "this worker");
      return origin.ok();
    };
    const Result<BatchItemResult> result = run_item(plan_, index, item_job);
    if (!result.ok()) return result.error();
    if (result->was_refused) return origin;
    report_.was_stopped = result->was_stopped;
    if (report_.was_stopped) return {};
    if (Status status = file.append(result->line); !status.ok()) return status;
    ++report_.done;
    if (result->has_failed) {
      const Json line = Json::parse(result->line);
      report_.failed.push_back(plan_.items[index].name + ": " + line["error"]["message"].get<std::string>());
    }
    return {};
  }

  const BatchPlan& plan_;
  const BatchJob& job_;
  BatchReport report_;
  BatchOrigins origins_;
};

// --- the merge

class Merger {
 public:
  Merger(const BatchPlan& plan, const fs::path& folder)
      : plan_(plan), folder_(folder), files_(folder, BatchFiles::Care::kContent) {
    report_.plan = plan.name;
    report_.items = plan.items.size();
  }

  Result<MergeReport> run() {
    Result<BatchLines> lines = read_batch_lines(plan_, folder_);
    if (!lines.ok()) return lines.error();
    report_.shards = lines->shards;
    if (lines->shards == 0) {
      return Error{
          ErrorCode::kBadFile, folder_.string() + ": has no results; run incise batch with -o there first", {}};
    }
    chosen_.assign(plan_.items.size(), nullptr);
    BatchOrigins origins(plan_);
    for (const BatchLine& line : lines->lines) {
      if (const Status status = origins.add(line); !status.ok()) return status.error();
      choose(line);
    }
    for (std::size_t i = 0; i < chosen_.size(); ++i) look_at(i);
    if (!report_.is_whole()) return std::move(report_);
    return write();
  }

 private:
  /// A result takes the place of a failure, and a failure that of an earlier one: their messages name paths as the
  /// worker was given them. Of two results, which must be equal, the first stays.
  void choose(const BatchLine& line) {
    const BatchLine*& chosen = chosen_[static_cast<std::size_t>(line.item)];
    if (chosen == nullptr || chosen->has_failed) {
      if (chosen != nullptr && line.has_failed) ++report_.repeated;
      chosen = &line;
    } else if (!line.has_failed) {
      ++report_.repeated;
      const std::string& name = plan_.items[static_cast<std::size_t>(line.item)].name;
      const bool is_told = !report_.contradictory.empty() && report_.contradictory.back() == name;
      if (chosen->text != line.text && !is_told) report_.contradictory.push_back(name);
    }
  }
  void look_at(std::size_t index) {
    const BatchLine* line = chosen_[index];
    if (line == nullptr) return report_.missing.push_back(plan_.items[index].name);
    report_.failed += line->has_failed ? 1 : 0;
    for (std::string& name : files_.broken(*line)) report_.broken_files.push_back(std::move(name));
  }
  Result<MergeReport> write() {
    std::string text;
    for (const BatchLine* line : chosen_) text += line->text;
    report_.file = folder_ / kResults;
    if (const Status status = write_text_file(report_.file, text); !status.ok()) return status.error();
    remove_leftovers(folder_);
    return std::move(report_);
  }

  const BatchPlan& plan_;
  const fs::path& folder_;
  MergeReport report_;
  BatchFiles files_;
  std::vector<const BatchLine*> chosen_;
};

// --- computing again

/// `count` of the lines with a result, one of each item, in the order of the plan: those with the least hashes.
std::vector<const BatchLine*> sample(const std::vector<BatchLine>& lines, std::uint64_t count, std::uint64_t seed) {
  std::map<std::uint64_t, const BatchLine*> by_item;
  for (const BatchLine& line : lines) {
    if (!line.has_failed) by_item.emplace(line.item, &line);
  }
  std::vector<std::pair<std::uint64_t, const BatchLine*>> drawn;
  for (const auto& [item, line] : by_item) {
    StateHash hash;
    hash.add(seed);
    hash.add(item);
    drawn.emplace_back(hash.value(), line);
  }
  std::sort(drawn.begin(), drawn.end());
  if (drawn.size() > count) drawn.resize(static_cast<std::size_t>(count));
  std::vector<const BatchLine*> chosen;
  for (const auto& [hash, line] : drawn) chosen.push_back(line);
  std::sort(chosen.begin(), chosen.end(), [](const auto* a, const auto* b) { return a->item < b->item; });
  return chosen;
}

/// A value as messages have it.
std::string shown(const Json* value) {
  constexpr std::size_t kLongest = 60;
  if (value == nullptr) return "nothing";
  std::string text =
      value->is_string() ? value->get<std::string>() : value->dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > kLongest) text = text.substr(0, kLongest) + " ...";
  return text;
}

const Json* member(const Json& object, const std::string& key) {
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

std::string first_difference(const Json& now, const Json& then, const std::string& path);

/// Of one field, which may be missing on one side.
std::string difference_of(const Json* now, const Json* then, const std::string& path) {
  const bool are_objects = now != nullptr && then != nullptr && now->is_object() && then->is_object();
  if (are_objects) return first_difference(*now, *then, path + ".");
  if (now != nullptr && then != nullptr && *now == *then) return {};
  return path + " " + shown(now) + " now, " + shown(then) + " in the results";
}

/// The first field in which two lines differ, in the order of the new one; empty where none does.
std::string first_difference(const Json& now, const Json& then, const std::string& path) {
  for (const auto& [key, value] : now.items()) {
    std::string text = difference_of(&value, member(then, key), path + key);
    if (!text.empty()) return text;
  }
  for (const auto& [key, value] : then.items()) {
    if (!now.contains(key)) return difference_of(nullptr, &value, path + key);
  }
  return {};
}

/// What of a line has to come out again: all but the version that computed it, and the bytes of a mesh that zlib
/// packed, which may be another one here; a merge compares them with the file.
Json comparable(const std::string& line, const BatchPlan& plan) {
  Json root = Json::parse(line);
  root.erase("program");
  if (plan.output.mesh.extension != ".vtu") return root;
  root.erase("file_bytes");
  root.erase("file_hash");
  return root;
}

/// How an item differs from its line; empty where it does not.
std::string difference(const BatchPlan& plan, const BatchItemResult& now, const BatchLine& line) {
  if (now.was_refused) {
    return "another mesh: key " + hash_text(now.input_key) + " now, " + hash_text(line.input_key) + " in the results";
  }
  if (now.has_failed) return "it fails now: " + now.line;
  if (now.line == line.text) return {};
  return first_difference(comparable(now.line, plan), comparable(line.text, plan), "");
}

Json head(const char* what, const std::string& plan, std::uint64_t items) {
  return {{"format", "incise-batch"},
          {"version", 1},
          {"program", "incise " INCISE_VERSION},
          {"what", what},
          {"plan", plan},
          {"items", items}};
}

Json listed(const std::vector<std::string>& names) {
  Json list = Json::array();
  for (std::size_t i = 0; i < names.size() && i < kMaxListedNames; ++i) list.push_back(names[i]);
  return {{"count", names.size()}, {"first", std::move(list)}};
}

std::string text_of(const Json& root) {
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

Result<BatchReport> run_batch(const BatchPlan& plan, const BatchJob& job) {
  return Worker(plan, job).run();
}

Result<MergeReport> merge_batch(const BatchPlan& plan, const fs::path& folder) {
  return Merger(plan, folder).run();
}

Result<VerifyReport> verify_batch(const BatchPlan& plan, const VerifyJob& job) {
  const Result<BatchLines> lines = read_batch_lines(plan, job.folder);
  if (!lines.ok()) return lines.error();
  const std::vector<const BatchLine*> chosen = sample(lines->lines, job.items, job.seed);
  if (chosen.empty()) {
    return Error{
        ErrorCode::kBadFile, job.folder.string() + ": has no results to compare with; run the batch first", {}};
  }
  VerifyReport report;
  report.plan = plan.name;
  BatchItemJob item_job{{}, {}, job.threads, job.log, job.should_stop, {}};
  for (const BatchLine* line : chosen) {
    if (job.progress) job.progress(static_cast<std::size_t>(report.items), chosen.size());
    if (job.should_stop && job.should_stop()) report.was_stopped = true;
    if (report.was_stopped) return report;
    const auto index = static_cast<std::size_t>(line->item);
    item_job.takes_input = [&](std::uint64_t key) { return key == line->input_key; };
    const Result<BatchItemResult> now = run_item(plan, index, item_job);
    if (!now.ok()) return now.error();
    report.was_stopped = now->was_stopped;
    if (report.was_stopped) return report;
    ++report.items;
    const std::string text = difference(plan, *now, *line);
    if (!text.empty()) report.differences.push_back(plan.items[index].name + ": " + text);
  }
  if (job.progress) job.progress(chosen.size(), chosen.size());
  return report;
}

std::string to_json(const BatchReport& report) {
  Json root = head("run", report.plan, report.items);
  root["shard"] = {{"index", report.shard.index}, {"count", report.shard.count}};
  root["skipped"] = report.skipped;
  root["done"] = report.done;
  root["stopped"] = report.was_stopped;
  root["failed"] = listed(report.failed);
  return text_of(root);
}

std::string to_json(const MergeReport& report) {
  Json root = head("merge", report.plan, report.items);
  root["ok"] = report.is_whole();
  root["file"] = report.file.string();
  root["shards"] = report.shards;
  root["failed"] = report.failed;
  root["repeated"] = report.repeated;
  root["missing"] = listed(report.missing);
  root["contradictory"] = listed(report.contradictory);
  root["broken_files"] = listed(report.broken_files);
  return text_of(root);
}

std::string to_json(const VerifyReport& report) {
  Json root = head("verify", report.plan, report.items);
  root["ok"] = report.differences.empty();
  root["stopped"] = report.was_stopped;
  root["differences"] = listed(report.differences);
  return text_of(root);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
