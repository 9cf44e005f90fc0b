// SPDX-License-Identifier: Apache-2.0
// All frames are written into a folder beside the place, which is exchanged by renaming it: no moment has half a
// series.
#include "app/jobs/frame_series.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "app/text/formatted.h"
#include "app/text/markup.h"
#include "app/text/text_file.h"
#include "incise/io/mesh_file.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

namespace fs = std::filesystem;

Error series_error(const fs::path& path, const std::string& what) {
  return {ErrorCode::kIo, path.string() + ": " + what, {}};
}

std::string frame_name(std::size_t index) {
  return formatted("frame_{:05}.vtu", index);
}

/// "frame_", digits, ".vtu".
bool is_ours(const fs::directory_entry& entry) {
  const std::string name = entry.path().filename().string();
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::error_code code;
  return entry.is_regular_file(code) && name.size() > 10 && name.rfind("frame_", 0) == 0 &&
         name.compare(name.size() - 4, 4, ".vtu") == 0 && std::all_of(name.begin() + 6, name.end() - 4, is_digit);
}

/// Whether there is nothing, or nothing but a series.
bool is_free(const fs::path& folder) {
  std::error_code code;
  const fs::file_status status = fs::symlink_status(folder, code);
  if (!fs::exists(status)) return true;
  if (!fs::is_directory(status)) return false;
  const fs::directory_iterator entries(folder, code);
  return !code && std::all_of(begin(entries), end(entries), is_ours);
}

fs::path with(fs::path path, const char* suffix) {
  path += suffix;
  return path;
}

}  // namespace

FrameSeries::FrameSeries(fs::path path)
    : path_(std::move(path)),
      folder_(with(fs::path(path_).replace_extension(), "_frames")),
      beside_(with(folder_, ".incise-part")) {}

FrameSeries::FrameSeries(FrameSeries&& other) noexcept
    : path_(std::move(other.path_)),
      folder_(std::move(other.folder_)),
      beside_(std::move(other.beside_)),
      times_(std::move(other.times_)),
      is_open_(std::exchange(other.is_open_, false)) {}

FrameSeries::~FrameSeries() {
  std::error_code ignored;
  if (is_open_) fs::remove_all(beside_, ignored);
}

Result<FrameSeries> FrameSeries::begin(const fs::path& path) {
  FrameSeries series(path);
  for (const fs::path& folder : {series.folder_, series.beside_}) {
    if (is_free(folder)) continue;
    series.is_open_ = false;
    return series_error(folder, "is in the way of the series: it holds other files; move it, or name another output");
  }
  std::error_code code;
  fs::remove_all(series.beside_, code);
  if (fs::create_directory(series.beside_, code)) return series;
  return series_error(series.beside_, "cannot be made: " + code.message());
}

Status FrameSeries::add(double time, const io::MeshData& mesh) {
  Status status = io::write_mesh(beside_ / frame_name(times_.size()), mesh);
  if (status.ok()) times_.push_back(time);
  return status;
}

std::string FrameSeries::collection() const {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  const std::string folder = as_markup(folder_.filename().string());
  for (std::size_t i = 0; i < times_.size(); ++i) {
    text += formatted("<DataSet timestep=\"{}\" part=\"0\" file=\"{}/{}\"/>\n", times_[i], folder, frame_name(i));
  }
  return text + "</Collection>\n</VTKFile>\n";
}

Status FrameSeries::finish() {
  const fs::path old = with(folder_, ".incise-old");
  std::error_code code;
  const bool has_old = fs::exists(folder_, code);
  if (!is_free(folder_) || !is_free(old)) return series_error(folder_, "is in the way of the series by now");
  fs::remove_all(old, code);
  if (has_old) fs::rename(folder_, old, code);
  if (!code) fs::rename(beside_, folder_, code);
  Status status =
      code ? series_error(folder_, "cannot be written: " + code.message()) : write_text_file(path_, collection());
  is_open_ = false;
  std::error_code ignored;
  if (status.ok()) {
    fs::remove_all(old, ignored);
    return status;
  }
  fs::remove_all(beside_, ignored);
  if (!has_old || fs::exists(old, ignored)) fs::remove_all(folder_, ignored);
  if (fs::exists(old, ignored)) fs::rename(old, folder_, ignored);
  return status;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
