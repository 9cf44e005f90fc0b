// SPDX-License-Identifier: Apache-2.0
#include "incise/app/simulation_recording.h"

#include <utility>

#include "app/append_file.h"
#include "app/line_reader.h"
#include "app/simulation_lines.h"

namespace incise::inline v0 {
namespace app {

class SimulationWriter::File : public AppendFile {
 public:
  using AppendFile::AppendFile;
};

class SimulationReader::Lines : public LineSource {
 public:
  explicit Lines(LineSource source) : LineSource(std::move(source)) {}
};

SimulationWriter::SimulationWriter(std::filesystem::path path, const SimulationHeader& header)
    : file_(std::make_unique<File>(std::move(path))), header_(to_line(header)) {}
SimulationWriter::SimulationWriter(SimulationWriter&&) noexcept = default;
SimulationWriter& SimulationWriter::operator=(SimulationWriter&&) noexcept = default;
SimulationWriter::~SimulationWriter() = default;

Status SimulationWriter::write(const SimulationCall& call) {
  return file_->append(std::exchange(header_, {}) + to_line(call));
}

SimulationReader::SimulationReader(std::unique_ptr<Lines> lines) : lines_(std::move(lines)) {}
SimulationReader::SimulationReader(SimulationReader&&) noexcept = default;
SimulationReader& SimulationReader::operator=(SimulationReader&&) noexcept = default;
SimulationReader::~SimulationReader() = default;

Result<SimulationReader> SimulationReader::open(const std::filesystem::path& path) {
  Result<LineSource> source = LineSource::open(path);
  if (!source.ok()) return source.error();
  SimulationReader reader(std::make_unique<Lines>(std::move(source).value()));
  return open(std::move(reader), path.parent_path());
}

Result<SimulationReader> SimulationReader::open(std::unique_ptr<std::istream> text, const std::filesystem::path& path) {
  SimulationReader reader(std::make_unique<Lines>(LineSource(std::move(text), path.string())));
  return open(std::move(reader), path.parent_path());
}

Result<SimulationReader> SimulationReader::open(SimulationReader reader, const std::filesystem::path& folder) {
  const Result<std::string> line = reader.lines_->header();
  if (!line.ok()) return line.error();
  Result<SimulationHeader> header = parse_simulation_header(*line, reader.file_name(), folder);
  if (!header.ok()) return header.error();
  reader.header_ = std::move(header).value();
  return reader;
}

const std::string& SimulationReader::file_name() const {
  return lines_->file_name();
}

std::uint64_t SimulationReader::bytes() const {
  return lines_->bytes();
}

Result<std::optional<SimulationCall>> SimulationReader::next() {
  std::string line;
  const Result<bool> got = lines_->next(line);
  if (!got.ok()) return got.error();
  if (!*got) return std::optional<SimulationCall>();
  Result<SimulationCall> call = parse_simulation_call(line, file_name(), lines_->number());
  if (!call.ok()) return call.error();
  return std::optional<SimulationCall>(std::move(call).value());
}

bool SimulationReader::is_cut_off() const {
  return lines_->is_cut_off();
}

bool is_simulation_recording(const std::filesystem::path& path) {
  Result<LineSource> source = LineSource::open(path);
  if (!source.ok()) return false;
  const Result<std::string> line = source->header();
  if (!line.ok()) return false;
  const Result<JsonValue> root = parse_json(*line, path.string(), kLineLimits);
  const JsonValue* format = root.ok() ? root->find("format") : nullptr;
  return format != nullptr && format->text == "incise-simulation";
}

}  // namespace app
}  // namespace incise::inline v0
