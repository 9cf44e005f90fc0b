// SPDX-License-Identifier: Apache-2.0
// Each file is written under a name of its own process beside its place, and all are renamed once all are written;
// what processes that are gone have left there is taken away.
#include "io/files.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "incise/io/part_file.h"
#include "io/gzip.h"
#include "io/text.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

namespace fs = std::filesystem;

struct Closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Closer>;

Error io_error(ErrorCode code, const fs::path& path, const std::string& what) {
  return {code, path.string() + ": " + what};
}

Error too_large(const fs::path& path, const ReadLimits& limits) {
  return io_error(ErrorCode::kOutOfMemory, path,
                  "is larger than " + size_text(limits.max_inflated_bytes) + "; cut it into parts");
}

// A new file beside `path`, of a name that nobody has.
File open_beside(const fs::path& path, fs::path& temporary) {
  remove_stale_parts(path);
  for (unsigned i = 0; i < 1000; ++i) {
    temporary = part_file(path, i);
    File file(std::fopen(temporary.string().c_str(), "wbx"));
    if (file || errno != EEXIST) return file;
  }
  return nullptr;
}

// Pipes and devices take the bytes themselves: nothing can be put in their place.
bool is_written_in_place(const fs::path& path) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  return fs::is_fifo(status) || fs::is_character_file(status) || fs::is_socket(status);
}

Status write_all(const fs::path& path, std::string_view bytes, fs::path& temporary) {
  File file = is_written_in_place(path) ? File(std::fopen(path.string().c_str(), "wb")) : open_beside(path, temporary);
  if (!file) {
    const std::string why = std::strerror(errno);
    temporary.clear();
    return io_error(ErrorCode::kIo, path, "cannot be written (" + why + "); choose a folder that you may write to");
  }
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size() &&
                       std::fflush(file.get()) == 0 && std::ferror(file.get()) == 0;
  if (std::fclose(file.release()) == 0 && written) return {};
  return io_error(ErrorCode::kIo, path, "writing failed; is the disk full?");
}

}  // namespace

Result<std::string> load_file(const fs::path& path, const ReadLimits& limits) {
  return load_file_if(path, limits, {});
}

Result<std::string> load_mesh_or_surface(const fs::path& path, const ReadLimits& limits) {
  return load_file_if(path, limits, [&path](std::string_view beginning) {
    std::optional<Error> error = check_mesh_beginning(beginning, path.string());
    return error && check_surface_beginning(beginning, path.string()) ? error : std::nullopt;
  });
}

Result<std::string> load_file_if(const fs::path& path, const ReadLimits& limits, const BeginningCheck& check) {
  if (path.empty()) return Error{ErrorCode::kBadFile, "the name of the file is empty; give one"};
  std::error_code code;
  if (fs::is_directory(path, code)) {
    return io_error(ErrorCode::kBadFile, path, "is a folder; give the file in it");
  }
  if (fs::is_character_file(path, code) || fs::is_block_file(path, code)) {
    return io_error(ErrorCode::kBadFile, path, "is a device, which may have no end; give a file, or a pipe");
  }
  const File file(std::fopen(path.string().c_str(), "rb"));
  if (!file && errno == ENOENT) return io_error(ErrorCode::kBadFile, path, "no such file; check the path");
  if (!file) {
    const char* remedy = errno == EACCES ? "); make it readable for you" : "); check the name";
    return io_error(ErrorCode::kBadFile, path, std::string("cannot be opened (") + std::strerror(errno) + remedy);
  }
  const bool is_endless = !fs::is_regular_file(path, code);  // or may be
  const auto size = fs::file_size(path, code);
  std::string bytes;
  if (!code && !is_endless && size > limits.max_inflated_bytes) return too_large(path, limits);
  if (!code && size <= limits.max_inflated_bytes) bytes.reserve(static_cast<std::size_t>(size) + 1);
  std::vector<char> chunk(std::size_t{1} << 18U);
  for (std::size_t got = 0; (got = std::fread(chunk.data(), 1, chunk.size(), file.get())) > 0;) {
    if (check && is_endless && bytes.empty() && got == chunk.size()) {
      if (std::optional<Error> error = check({chunk.data(), got})) return *std::move(error);
    }
    if (bytes.size() + got > limits.max_inflated_bytes) return too_large(path, limits);
    bytes.append(chunk.data(), got);
  }
  if (std::ferror(file.get()) != 0) return io_error(ErrorCode::kBadFile, path, "reading failed; check the disk");
  return bytes;
}

Result<std::string> load_either(const fs::path& path, const ReadLimits& limits) {
  std::error_code code;
  fs::path zipped = path;
  zipped += ".gz";
  const bool plain = fs::exists(path, code) || !fs::exists(zipped, code);
  Result<std::string> bytes = load_file(plain ? path : zipped, limits);
  if (!bytes || !is_gzip(*bytes)) return bytes;
  std::string out;
  std::string why;
  if (!gunzip(*bytes, limits.max_inflated_bytes, out, why)) return io_error(ErrorCode::kBadFile, path, why);
  return out;
}

Status check_place(const fs::path& path) {
  if (path.empty()) return Error{ErrorCode::kBadArgument, "the name of the file is empty; give one"};
  std::error_code code;
  if (fs::is_directory(path, code)) return io_error(ErrorCode::kIo, path, "is a folder; give the name of a file in it");
  if (!is_protected(path)) return {};
  return io_error(ErrorCode::kIo, path, "is write-protected; allow writing to it, or name another file");
}

Status store_files(const std::vector<std::pair<fs::path, std::string_view>>& files) {
  std::vector<fs::path> temporary(files.size());
  Status status;
  for (std::size_t i = 0; i < files.size() && status.ok(); ++i) {
    status = write_all(files[i].first, files[i].second, temporary[i]);
  }
  for (std::size_t i = 0; i < files.size() && status.ok(); ++i) {
    if (temporary[i].empty()) continue;  // written in place
    const std::error_code code = put_in_place(temporary[i], files[i].first);
    if (code)
      status = io_error(ErrorCode::kIo, files[i].first, "cannot be replaced (" + code.message() + "); is it a folder?");
  }
  std::error_code ignored;
  for (const fs::path& path : temporary) {
    if (!status.ok() && !path.empty()) fs::remove(path, ignored);
  }
  return status;
}

Status store_packed(const std::vector<fs::path>& paths, std::vector<std::string> contents, bool gzipped) {
  std::vector<std::pair<fs::path, std::string_view>> files;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    std::string packed;
    if (gzipped) {
      if (!gzip(contents[i], packed)) {
        return io_error(ErrorCode::kUnsupported, paths[i], "this build writes no gzip; leave .gz off the name");
      }
      contents[i] = std::move(packed);
    }
    files.emplace_back(paths[i], contents[i]);
  }
  return store_files(files);
}

Extension extension_of(const fs::path& path) {
  Extension found;
  found.name = to_lower(path.extension().string());
  found.gzipped = found.name == ".gz";
  if (found.gzipped) found.name = to_lower(path.stem().extension().string());
  return found;
}

}  // namespace io
}  // namespace v0
}  // namespace incise
