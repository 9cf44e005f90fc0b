// SPDX-License-Identifier: Apache-2.0
// A shard's file is locked while its worker lives (flock), and only ever grows by whole lines: what a killed worker
// left of one is cut off by the next.
#include "app/jobs/batch_lines.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "app/jobs/batch_line_reader.h"
#include "app/text/formatted.h"
#include "app/text/json_tree.h"
#include "app/text/line_source.h"
#include "app/text/text_file.h"
#include "app/text/write_all.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kShardMode = 0666;
constexpr off_t kChunk = 4096;

bool is_shard_file(const fs::path& path) {
  return path.filename().string().rfind("shard-", 0) == 0 && path.extension() == ".jsonl";
}

/// What to do about a line that is no result.
std::string remedy(const fs::path& shard_file) {
  const std::optional<Shard> shard = is_shard_file(shard_file) ? shard_named(shard_file.stem().string()) : std::nullopt;
  if (!shard) return "; take the line out of the file";
  return formatted(
      "; run incise batch with --shard {}/{} --retry, which takes the line off and computes its item again",
      shard->index, shard->count);
}

/// A line, or why it is none.
struct ReadLine {
  BatchLine line;
  std::optional<Error> error;
  bool is_of_another_plan = false;  ///< that is why
};

ReadLine read_line(const BatchPlan& plan, const std::string& text, const LineSource& source) {
  ReadLine read;
  const Result<JsonValue> root = parse_json(text, source.file_name(), {}, source.number());
  BatchLineReader reader(plan, source.file_name());
  if (!root.ok()) {
    read.error = root.error();
  } else if (!reader.run(*root, read.line)) {
    read.error = reader.error();
    read.is_of_another_plan = reader.is_of_another_plan();
  }
  if (read.error && !read.is_of_another_plan) read.error->message += remedy(source.file_name());
  read.line.where = source.file_name() + ":" + std::to_string(source.number());
  read.line.text = text + "\n";
  return read;
}

/// Hands each line of a shard's file to `take(ReadLine)`, until it fails. Whether the last line was cut off.
Result<bool> for_each_line(const BatchPlan& plan, const fs::path& path, const auto& take) {
  Result<LineSource> source = LineSource::open(path);
  if (!source.ok()) return source.error();
  std::string text;
  while (true) {
    const Result<bool> got = source->next(text);
    if (!got.ok()) return got.error();
    if (!*got) return source->is_cut_off();
    if (const Status status = take(read_line(plan, text, *source)); !status.ok()) return status.error();
  }
}

Status read_shard_file(const BatchPlan& plan, const fs::path& path, BadLines bad, BatchLines& out) {
  const Result<bool> is_cut_off = for_each_line(plan, path, [&](ReadLine read) -> Status {
    const bool is_left_out = read.error && !read.is_of_another_plan && bad == BadLines::kAreLeftOut;
    if (read.error && !is_left_out) return *read.error;
    if (!is_left_out) out.lines.push_back(std::move(read.line));
    return {};
  });
  if (!is_cut_off.ok()) return is_cut_off.error();
  if (*is_cut_off) ++out.cut_off;
  return {};
}

/// Of what is called like a shard's file and is none: a pipe would let a worker wait for ever.
Error no_file(const fs::path& path, ErrorCode code) {
  return {code, path.string() + ": is no regular file; take it away", {}};
}

}  // namespace

std::string name_of(const Shard& shard) {
  return formatted("shard-{:05}-of-{:05}", shard.index, shard.count);
}

std::optional<Shard> shard_named(std::string_view name) {
  if (name.size() != name_of(Shard()).size()) return std::nullopt;
  Shard shard;
  std::from_chars(name.data() + 6, name.data() + 11, shard.index);
  std::from_chars(name.data() + 15, name.data() + 20, shard.count);
  return name_of(shard) == name ? std::optional(shard) : std::nullopt;
}

bool is_free(const fs::path& folder, const std::string& name) {
  const int file = ::open((folder / (name + ".jsonl")).c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return errno == ENOENT;  // a worker makes it before anything else
  const bool is_free = ::flock(file, LOCK_EX | LOCK_NB) == 0;
  ::close(file);
  return is_free;
}

Status check_results_folder(const fs::path& folder) {
  std::error_code code;
  const fs::file_status status = fs::status(folder, code);
  if (!fs::exists(status) || fs::is_directory(status)) return {};
  return Error{ErrorCode::kIo, folder.string() + ": is a file; results go into a folder: name one with -o", {}};
}

Result<BatchLines> read_batch_lines(const BatchPlan& plan, const fs::path& folder, BadLines bad) {
  if (const Status status = check_results_folder(folder); !status.ok()) return status.error();
  std::vector<fs::path> files;
  std::error_code code;
  for (fs::directory_iterator at(folder, code), end; !code && at != end; at.increment(code)) {
    if (is_shard_file(at->path())) files.push_back(at->path());
  }
  std::sort(files.begin(), files.end());
  BatchLines lines;
  lines.shards = files.size();
  for (const fs::path& file : files) {
    if (!fs::is_regular_file(file, code)) return no_file(file, ErrorCode::kBadFile);
    if (const Status status = read_shard_file(plan, file, bad, lines); !status.ok()) return status.error();
  }
  return lines;
}

Result<ShardFile> ShardFile::open(const fs::path& folder, const Shard& shard) {
  return open(folder / (name_of(shard) + ".jsonl"));
}

Result<ShardFile> ShardFile::open(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, kShardMode);
  if (file < 0) return write_error(path);
  ShardFile opened(path, file);
  struct stat about = {};
  if (::fstat(file, &about) != 0 || !S_ISREG(about.st_mode)) return no_file(path, ErrorCode::kIo);
  if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {  // file systems without locks do without
    return Error{ErrorCode::kBadArgument,
                 path.string() + ": another worker is at this shard; wait for it, or give this one another",
                 {}};
  }
  if (const Status status = opened.take_off_unfinished(); !status.ok()) return status.error();
  return opened;
}

ShardFile::ShardFile(ShardFile&& other) noexcept
    : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)) {}

ShardFile::~ShardFile() {
  if (file_ >= 0) ::close(file_);
}

Status ShardFile::take_off_unfinished() {
  const off_t size = ::lseek(file_, 0, SEEK_END);
  off_t end = size;  // behind the last newline
  char chunk[kChunk];
  while (end > 0) {
    const off_t begin = std::max<off_t>(0, end - kChunk);
    const ssize_t got = ::pread(file_, chunk, static_cast<std::size_t>(end - begin), begin);
    if (got != end - begin) return write_error(path_);
    const auto* found = static_cast<const char*>(::memrchr(chunk, '\n', static_cast<std::size_t>(got)));
    if (found != nullptr) {
      end = begin + (found - chunk) + 1;
      break;
    }
    end = begin;
  }
  return end == size || ::ftruncate(file_, end) == 0 ? Status() : Status(write_error(path_));
}

Status ShardFile::append(std::string_view line) {
  return write_all(file_, line, path_);
}

/// The file that takes this one's place is opened while this one is still locked: no other worker comes in between
/// but one that begins just then, and gets the place.
Result<std::uint64_t> ShardFile::take_off_bad_lines(const BatchPlan& plan) {
  std::uint64_t bad = 0;
  std::string kept;
  const Result<bool> read = for_each_line(plan, path_, [&](const ReadLine& line) -> Status {
    const bool is_kept = !line.error || line.is_of_another_plan;
    if (is_kept) kept += line.line.text;
    if (!is_kept) ++bad;
    return {};
  });
  if (!read.ok()) return read.error();
  if (bad == 0) return bad;
  if (const Status status = write_text_file(path_, kept); !status.ok()) return status.error();
  Result<ShardFile> renewed = open(path_);
  if (!renewed.ok()) return renewed.error();
  std::swap(file_, renewed->file_);
  return bad;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
