// SPDX-License-Identifier: Apache-2.0
// A recording is a text file: a header, then one line for each call. What the lines say is the codec's.
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/text/append_file.h"
#include "app/text/line_source.h"
#include "incise/core/result.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Writes a recording while it is made: after each call its line is in the hands of the operating system.
///
/// A program that is killed loses at most the line that it was writing. (A computer that loses power may lose more:
/// nothing waits for the disk.) The file takes its place with the first call, header and line at once; what had its
/// name before is whole until then. Not thread-safe.
///
/// `Codec` names the types `Header` and `Call`, for which there is `to_line`.
template <class Codec>
class BasicRecordingWriter {
 public:
  /// Opens nothing yet. Cost: that of the header's line.
  BasicRecordingWriter(std::filesystem::path path, const typename Codec::Header& header)
      : file_(std::make_unique<AppendFile>(std::move(path))), header_(to_line(header)) {}

  /// Appends one call as one line, in one write. Errors: kIo, naming the file; all later calls then fail likewise,
  /// since a line may be missing. Cost: O(line).
  Status write(const typename Codec::Call& call) { return file_->append(std::exchange(header_, {}) + to_line(call)); }
  /// Makes a recording of no calls, where none was written. Errors: as `write`. Cost: O(header).
  Status write_header() { return header_.empty() ? Status() : file_->append(std::exchange(header_, {})); }

 private:
  std::unique_ptr<AppendFile> file_;
  std::string header_;  // until it has been written
};

/// Reads a recording line by line, so that it may be longer than memory.
///
/// The last line may be cut off anywhere: it is left out, and `is_cut_off` says so. All else is strict.
///
/// `Codec` names the types `Header` and `Call`, and has `parse_header(text, file_name, folder)` and
/// `parse_call(text, file_name, line)`, whose errors are kBadFile "FILE:LINE: what".
template <class Codec>
class BasicRecordingReader {
 public:
  using Header = typename Codec::Header;
  using Call = typename Codec::Call;

  /// Opens a file and reads its header. Errors: kBadFile "FILE:LINE: what; remedy" where it cannot be read, the header
  /// is not whole, of another format or version, or has an unknown key. Cost: that of the header.
  static Result<BasicRecordingReader> open(const std::filesystem::path& path) {
    Result<LineSource> lines = LineSource::open(path);
    if (!lines.ok()) return lines.error();
    return open(std::move(lines).value(), path.parent_path());
  }
  /// The same for text in memory or elsewhere; `path` stands for FILE in messages, and its folder for the file's.
  static Result<BasicRecordingReader> open(std::unique_ptr<std::istream> text, const std::filesystem::path& path) {
    return open(LineSource(std::move(text), path.string()), path.parent_path());
  }

  /// The same for lines of which the header alone may have been read.
  static Result<BasicRecordingReader> open(LineSource lines, const std::filesystem::path& folder) {
    BasicRecordingReader reader(std::move(lines));
    const Result<std::string> line = reader.lines_.header();
    if (!line.ok()) return line.error();
    Result<Header> header = Codec::parse_header(*line, reader.file_name(), folder);
    if (!header.ok()) return header.error();
    reader.header_ = std::move(header).value();
    return reader;
  }

  [[nodiscard]] const Header& header() const { return header_; }
  [[nodiscard]] const std::string& file_name() const { return lines_.file_name(); }
  /// Bytes of the file that were read so far.
  [[nodiscard]] std::uint64_t bytes() const { return lines_.bytes(); }

  /// The next call, or nothing at the end. Errors: kBadFile "FILE:LINE: what", for instance for an unknown call or key,
  /// a number that is not finite, or a line of more than 1 GiB. Cost: O(line).
  Result<std::optional<Call>> next() {
    std::string line;
    const Result<bool> got = lines_.next(line);
    if (!got.ok()) return got.error();
    if (!*got) return std::optional<Call>();
    Result<Call> call = Codec::parse_call(line, file_name(), lines_.number());
    if (!call.ok()) return call.error();
    return std::optional<Call>(std::move(call).value());
  }
  /// Whether the end, once it was reached, was within a line.
  [[nodiscard]] bool is_cut_off() const { return lines_.is_cut_off(); }

 private:
  explicit BasicRecordingReader(LineSource lines) : lines_(std::move(lines)) {}

  LineSource lines_;
  Header header_;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
