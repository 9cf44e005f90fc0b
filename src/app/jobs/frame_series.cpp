// SPDX-License-Identifier: Apache-2.0
// All frames are written into a folder beside the place, which is exchanged by renaming it: no moment has half a
// series. That folder is locked (flock) while its series is written: one that nobody holds was left by a killed run.
#include "app/jobs/frame_series.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
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
      lock_(std::exchange(other.lock_, -1)) {}

FrameSeries::~FrameSeries() {
  if (lock_ < 0) return;
  std::error_code ignored;
  fs::remove_all(beside_, ignored);
  ::close(lock_);
}

Result<FrameSeries> FrameSeries::begin(const fs::path& path) {
  FrameSeries series(path);
  for (const fs::path& folder : {series.folder_, series.beside_}) {
    if (is_free(folder)) continue;
    return series_error(folder, "is in the way of the series: it holds other files; move it, or name another output");
  }
  if (const Status status = series.take_beside(); !status.ok()) return status.error();
  return series;
}

/// Makes the folder beside the place, or takes over what a killed run left of one.
Status FrameSeries::take_beside() {
  constexpr int kTries = 100;  // it may be renamed or removed between two steps
  for (int i = 0; i < kTries; ++i) {
    std::error_code code;
    fs::create_directory(beside_, code);
    if (code) return series_error(beside_, "cannot be made: " + code.message());
    const int folder = ::open(beside_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0 && errno == ENOENT) continue;
    if (folder < 0)
      return series_error(beside_, "cannot be opened: " + std::error_code(errno, std::generic_category()).message());
    if (::flock(folder, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {  // file systems without locks do without
      ::close(folder);
      return series_error(path_, "another run is writing this series; wait for it, or name another output");
    }
    struct stat opened = {}, named = {};
    if (::fstat(folder, &opened) != 0 || ::stat(beside_.c_str(), &named) != 0 || opened.st_ino != named.st_ino) {
      ::close(folder);
      continue;
    }
    lock_ = folder;
    const fs::directory_iterator left(beside_, code);
    for (const fs::directory_entry& file : left) fs::remove(file.path(), code);
    return {};
  }
  return series_error(path_, "another run is writing this series; wait for it, or name another output");
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
  ::close(std::exchange(lock_, -1));
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
