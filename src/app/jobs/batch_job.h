// SPDX-License-Identifier: Apache-2.0
// Batches: many cuts, by workers that share nothing but a folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/jobs/batch_plan.h"
#include "app/jobs/batch_shard.h"
#include "incise/core/log.h"
#include "incise/core/result.h"

namespace incise {
inline namespace v0 {
namespace app {

/// What one worker does.
struct BatchJob {
  std::filesystem::path folder;  ///< made where it is not there, but for the folder that it is in
  Shard shard;
  /// Items that have failed are tried again, files are read, not only looked at, and lines that are no results taken
  /// off.
  bool retry = false;
  unsigned threads = 1;  ///< the result does not depend on them
  LogSink log = {};
  /// Called before each item and after the last: items done, items of the shard. May be empty.
  std::function<void(std::size_t done, std::size_t total)> progress = {};
  /// Asked before each item and each frame of a scene; true ends the job. May be empty.
  std::function<bool()> should_stop = {};
};

/// What one worker did.
struct BatchReport {
  std::string plan;  ///< its name
  Shard shard;
  std::uint64_t items = 0;          ///< of the shard
  std::uint64_t skipped = 0;        ///< that were there before
  std::uint64_t done = 0;           ///< computed, those that failed included
  std::vector<std::string> failed;  ///< of those: "NAME: why"
  bool was_stopped = false;         ///< by `should_stop`
};

/// Computes the items of a shard that no worker has done yet, in the order of the plan.
///
/// After each item its files are whole, and its line is at the end of the shard's file: a worker that is killed loses
/// the item that it was at and nothing else, and the next run goes on there, whatever the number of shards is then.
/// Items whose files are gone or cut off are computed again. Errors: kIo, kOutOfMemory; kBadArgument where another
/// worker is at the same shard; kBadFile where the folder has results of another plan, another version of the program
/// or other meshes, or a line that is none. Cost: that of the items.
[[nodiscard]] Result<BatchReport> run_batch(const BatchPlan& plan, const BatchJob& job);

/// What a merge found.
struct MergeReport {
  std::string plan;  ///< its name
  std::uint64_t items = 0;
  std::uint64_t failed = 0;                ///< with a line that says why
  std::uint64_t repeated = 0;              ///< lines of items that were computed more than once, with the same result
  std::vector<std::string> missing;        ///< names of items without a line
  std::vector<std::string> contradictory;  ///< names of items with different lines
  std::vector<std::string> broken_files;   ///< that a line names, and that are not there, or not as they were written
  std::size_t shards = 0;                  ///< files that were read
  std::filesystem::path file;              ///< the result; empty where something is wrong

  [[nodiscard]] bool is_whole() const { return missing.empty() && contradictory.empty() && broken_files.empty(); }
};

/// Puts the lines of all shards into one file, `results.jsonl`, in the order of the plan.
///
/// It is written only where each item has one result and all files are there as they were written: meshes after cuts
/// byte for byte, meshes before them and strokes as far as they can be read. Its bytes do not depend on the shards, nor
/// on how often workers were killed; files that these left half-written are taken away. Errors: kBadFile for lines of
/// another plan or none at all, for a line that is no result, naming file, line and remedy, and for results of two
/// versions of the program or two meshes under one name, naming both; kIo. Cost: O(bytes of all files).
[[nodiscard]] Result<MergeReport> merge_batch(const BatchPlan& plan, const std::filesystem::path& folder);

/// What is computed again.
struct VerifyJob {
  std::filesystem::path folder;
  std::uint64_t items = 1;  ///< how many, of those that have a result
  std::uint64_t seed = 0;   ///< which
  unsigned threads = 1;
  LogSink log = {};
  std::function<void(std::size_t done, std::size_t total)> progress = {};  ///< as in `BatchJob`
  std::function<bool()> should_stop = {};                                  ///< as in `BatchJob`
};

struct VerifyReport {
  std::string plan;                      ///< its name
  std::uint64_t items = 0;               ///< computed again
  std::vector<std::string> differences;  ///< "NAME: FIELD X now, Y in the results", of the first that differs
  bool was_stopped = false;
};

/// Computes items again that workers have done, chosen at random, and compares all of their lines but `program`, and
/// but `file_bytes` and `file_hash` of meshes that zlib packs (.vtu). Writes nothing. Errors: as `run_batch`. Cost:
/// that of the items.
[[nodiscard]] Result<VerifyReport> verify_batch(const BatchPlan& plan, const VerifyJob& job);

/// As JSON, format "incise-batch" version 1, with a newline at the end; lists have at most 100 entries.
[[nodiscard]] std::string to_json(const BatchReport& report);
[[nodiscard]] std::string to_json(const MergeReport& report);
[[nodiscard]] std::string to_json(const VerifyReport& report);

}  // namespace app
}  // namespace v0
}  // namespace incise
