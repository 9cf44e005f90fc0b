// SPDX-License-Identifier: Apache-2.0
// The results of a batch as its workers write them: a file of JSON lines for each shard.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/jobs/batch_plan.h"
#include "app/jobs/batch_shard.h"
#include "incise/core/result.h"

namespace incise {
inline namespace v0 {
namespace app {

/// A line of an item, as far as the program reads it again.
struct BatchLine {
  std::uint64_t item = 0;
  std::string where;    ///< "FILE:LINE", for messages
  std::string program;  ///< that computed it: "incise VERSION"
  bool has_failed = false;
  std::string text;  ///< the whole line, with its newline
  std::string file;  ///< with the mesh after the cut, seen from the folder; may be empty
  std::uint64_t file_bytes = 0, file_hash = 0;
  std::string strokes_file;  ///< likewise
  std::string input_file;    ///< with the mesh before it; likewise
  std::uint64_t input_vertices = 0, input_tets = 0;
  std::uint64_t input_key = 0;  ///< of `BatchItemResult`: of the mesh before it; lines that have failed have none
  std::uint64_t hash = 0, state_hash = 0;
};

/// Which lines a folder has, of all its shards, and of which there may be several of one item.
struct BatchLines {
  std::vector<BatchLine> lines;  ///< by shard file, in the order of their names, then as they stand there
  std::size_t shards = 0;        ///< files
  std::uint64_t cut_off = 0;     ///< lines without an end: their workers were killed, or are writing them
};

/// What becomes of lines that are no results: a disk that was full, or a text editor, may have made some.
enum class BadLines : std::uint8_t { kAreErrors, kAreLeftOut };

/// "shard-00001-of-00004", of which the file is `.jsonl`.
[[nodiscard]] std::string name_of(const Shard& shard);

/// The shard that `name_of` calls `name`; nothing for any other name.
[[nodiscard]] std::optional<Shard> shard_named(std::string_view name);

/// Whether no worker is at the shard whose file is `name` with `.jsonl`. False as well where the file system has no
/// locks.
[[nodiscard]] bool is_free(const std::filesystem::path& folder, const std::string& name);

/// Errors: kIo where something else than a folder has the name of the folder for results; it need not be there.
[[nodiscard]] Status check_results_folder(const std::filesystem::path& folder);

/// Reads the lines of all shards in a folder; none where the folder is not there.
/// Errors: kBadFile "FILE:LINE: what; remedy" for a line that is no result (unless such are left out), or a result of
/// another plan; as `check_results_folder`. Cost: O(lines).
[[nodiscard]] Result<BatchLines> read_batch_lines(const BatchPlan& plan, const std::filesystem::path& folder,
                                                  BadLines bad = BadLines::kAreErrors);

/// The file of a shard, to which one worker at a time appends.
///
/// A line is in the hands of the operating system once `append` returns: a worker that is killed loses what it was
/// computing, and nothing else. Not thread-safe.
class ShardFile {
 public:
  /// Opens, or makes, the file, and takes a line off its end that a killed worker did not finish.
  /// Errors: kIo where it cannot be written; kBadArgument where another worker has it open.
  static Result<ShardFile> open(const std::filesystem::path& folder, const Shard& shard);
  ShardFile(ShardFile&& other) noexcept;
  ShardFile& operator=(ShardFile&& other) = delete;
  ShardFile(const ShardFile&) = delete;
  ShardFile& operator=(const ShardFile&) = delete;
  ~ShardFile();

  /// Appends a line, in one write. Errors: kIo, naming the file.
  Status append(std::string_view line);

  /// Takes off the lines that are no results; those of another plan stay. How many they were.
  /// Errors: kIo, kBadFile where the file cannot be read, and as `open`. Cost: O(lines).
  Result<std::uint64_t> take_off_bad_lines(const BatchPlan& plan);

 private:
  ShardFile(std::filesystem::path path, int file) : path_(std::move(path)), file_(file) {}
  static Result<ShardFile> open(const std::filesystem::path& path);
  Status take_off_unfinished();

  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
