// SPDX-License-Identifier: Apache-2.0
#include "incise/app/recording.h"

#include <fstream>
#include <utility>

#include "app/append_file.h"
#include "app/recording_lines.h"
#include "incise/app/text_file.h"

namespace incise::inline v0 {
namespace app {
namespace {

constexpr std::size_t kMaxLineBytes = std::size_t{1} << 30U;

}  // namespace

class RecordingWriter::File : public AppendFile {
 public:
  using AppendFile::AppendFile;
};

RecordingWriter::RecordingWriter(std::filesystem::path path, const RecordingHeader& header)
    : file_(std::make_unique<File>(std::move(path))), header_(to_line(header)) {}
RecordingWriter::RecordingWriter(RecordingWriter&&) noexcept = default;
RecordingWriter& RecordingWriter::operator=(RecordingWriter&&) noexcept = default;
RecordingWriter::~RecordingWriter() = default;

Status RecordingWriter::write(const RecordedCall& call) {
  return file_->append(std::exchange(header_, {}) + to_line(call));
}

RecordingReader::RecordingReader(std::unique_ptr<std::istream> text, std::string file_name)
    : text_(std::move(text)), file_name_(std::move(file_name)) {}

Result<RecordingReader> RecordingReader::open(const std::filesystem::path& path) {
  if (const Status status = check_readable(path); !status.ok()) return status.error();
  return open(std::make_unique<std::ifstream>(path, std::ios::binary), path.string());
}

Result<RecordingReader> RecordingReader::open(std::unique_ptr<std::istream> text, std::string file_name) {
  RecordingReader reader(std::move(text), std::move(file_name));
  std::string line;
  if (const Result<bool> got = reader.read_line(line); !got.ok()) return got.error();
  if (!reader.has_line_end_ && !line.empty() && line.front() == '{' && !is_whole_json(line)) {
    return Error{ErrorCode::kBadFile,
                 reader.file_name_ + ":1: the header is cut off, so nothing can be replayed; record again",
                 {}};
  }
  Result<RecordingHeader> header = parse_header(line, reader.file_name_);
  if (!header.ok()) return header.error();
  reader.header_ = std::move(header).value();
  return reader;
}

Result<std::optional<RecordedCall>> RecordingReader::next() {
  std::string line;
  const Result<bool> got = read_line(line);
  if (!got.ok()) return got.error();
  is_cut_off_ = *got && !has_line_end_ && !is_whole_json(line);
  if (!*got || is_cut_off_) return std::optional<RecordedCall>();
  Result<RecordedCall> call = parse_call(line, file_name_, line_);
  if (!call.ok()) return call.error();
  return std::optional<RecordedCall>(std::move(call).value());
}

/// Reads up to the next newline or the end; false where nothing is left.
Result<bool> RecordingReader::read_line(std::string& line) {
  using Traits = std::istream::traits_type;
  std::streambuf& bytes = *text_->rdbuf();
  ++line_;
  has_line_end_ = false;
  for (auto byte = bytes.sbumpc(); !Traits::eq_int_type(byte, Traits::eof()); byte = bytes.sbumpc()) {
    if (byte == '\n') {
      has_line_end_ = true;
      return true;
    }
    if (line.size() == kMaxLineBytes) {
      return Error{ErrorCode::kBadFile,
                   file_name_ + ":" + std::to_string(line_) + ": the line is longer than 1 GiB; is this a recording?",
                   {}};
    }
    line += Traits::to_char_type(byte);
  }
  return !line.empty();
}

}  // namespace app
}  // namespace incise::inline v0
