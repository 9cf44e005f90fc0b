// SPDX-License-Identifier: Apache-2.0
#include "incise/app/recording.h"

#include <utility>

#include "app/append_file.h"
#include "app/line_reader.h"
#include "app/recording_lines.h"

namespace incise::inline v0 {
namespace app {
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

RecordingReader::RecordingReader(LineSource lines) : lines_(std::make_unique<LineSource>(std::move(lines))) {}
RecordingReader::RecordingReader(RecordingReader&&) noexcept = default;
RecordingReader& RecordingReader::operator=(RecordingReader&&) noexcept = default;
RecordingReader::~RecordingReader() = default;

Result<RecordingReader> RecordingReader::open(const std::filesystem::path& path) {
  Result<LineSource> lines = LineSource::open(path);
  if (!lines.ok()) return lines.error();
  return open(std::move(lines).value());
}

Result<RecordingReader> RecordingReader::open(std::unique_ptr<std::istream> text, std::string file_name) {
  return open(LineSource(std::move(text), std::move(file_name)));
}

Result<RecordingReader> RecordingReader::open(LineSource lines) {
  RecordingReader reader(std::move(lines));
  const Result<std::string> line = reader.lines_->header();
  if (!line.ok()) return line.error();
  Result<RecordingHeader> header = parse_header(*line, reader.file_name());
  if (!header.ok()) return header.error();
  reader.header_ = std::move(header).value();
  return reader;
}

const std::string& RecordingReader::file_name() const {
  return lines_->file_name();
}

std::uint64_t RecordingReader::bytes() const {
  return lines_->bytes();
}

Result<std::optional<RecordedCall>> RecordingReader::next() {
  std::string line;
  const Result<bool> got = lines_->next(line);
  if (!got.ok()) return got.error();
  if (!*got) return std::optional<RecordedCall>();
  Result<RecordedCall> call = parse_call(line, file_name(), lines_->number());
  if (!call.ok()) return call.error();
  return std::optional<RecordedCall>(std::move(call).value());
}

bool RecordingReader::is_cut_off() const {
  return lines_->is_cut_off();
}

}  // namespace app
}  // namespace incise::inline v0
