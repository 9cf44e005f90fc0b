// SPDX-License-Identifier: Apache-2.0
// A mesh after its cuts is judged by the size and hash that its line has; one before its cuts and strokes, whose bytes
// no line has, by whether they can be read.
#include "app/jobs/batch_files.h"

#include <limits>
#include <system_error>

#include "app/scene/blade_file.h"
#include "app/text/text_file.h"
#include "incise/io/mesh_loader.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

namespace fs = std::filesystem;

/// 0 as well where it is not there.
std::uintmax_t size_of(const fs::path& path) {
  std::error_code code;
  const std::uintmax_t size = fs::is_regular_file(path, code) ? fs::file_size(path, code) : 0;
  return code ? 0 : size;
}

bool is_numbered(const fs::path& name) {
  const std::string ending = name.extension().string();
  return ending.size() > 1 && ending.find_first_not_of("0123456789", 1) == std::string::npos;
}

/// The shard whose worker writes NAME.shard-I-of-N or, as `io::part_file` names it until it is whole,
/// NAME.shard-I-of-N.PROCESS.NUMBER.incise-part; nothing for any other file.
std::optional<Shard> shard_of_leftover(const fs::path& file) {
  fs::path name = file.filename();
  if (name.extension() == ".incise-part") {
    name = name.stem();
    while (is_numbered(name)) name = name.stem();
  }
  const std::string ending = name.extension().string();
  return ending.empty() ? std::nullopt : shard_named(std::string_view(ending).substr(1));
}

}  // namespace

std::vector<std::string> BatchFiles::broken(const BatchLine& line) {
  std::vector<std::string> names;
  if (!line.file.empty() && !is_mesh_as_written(line)) names.push_back(line.file);
  if (!line.strokes_file.empty() && !are_strokes_sound(line.strokes_file)) names.push_back(line.strokes_file);
  if (!line.input_file.empty() && inputs_.insert(line.input_file).second && !is_input_sound(line)) {
    names.push_back(line.input_file);
  }
  return names;
}

bool BatchFiles::is_mesh_as_written(const BatchLine& line) const {
  const fs::path path = folder_ / line.file;
  if (size_of(path) != line.file_bytes) return false;
  if (care_ == Care::kSizes) return true;
  const Result<std::string> text = read_text_file(path, std::numeric_limits<std::size_t>::max());
  return text.ok() && hash_of_text(*text) == line.file_hash;
}

/// Its bytes are in no line: they may depend on the machine's zlib, and workers of several machines share it.
bool BatchFiles::is_input_sound(const BatchLine& line) const {
  const fs::path path = folder_ / line.input_file;
  if (size_of(path) == 0) return false;
  if (care_ == Care::kSizes) return true;
  const Result<io::LoadedMesh> loaded = io::load_mesh(path);
  return loaded.ok() && loaded->mesh.vertex_count() == line.input_vertices &&
         loaded->mesh.tet_count() == line.input_tets;
}

bool BatchFiles::are_strokes_sound(const std::string& file) const {
  const fs::path path = folder_ / file;
  if (size_of(path) == 0) return false;
  return care_ == Care::kSizes || read_blade_file(path).ok();
}

void remove_leftovers(const fs::path& folder) {
  for (const char* part : {"before", "after", "strokes"}) {
    std::error_code code;
    for (fs::directory_iterator at(folder / part, code), end; !code && at != end; at.increment(code)) {
      const std::optional<Shard> shard = shard_of_leftover(at->path());
      std::error_code ignored;
      if (shard && is_free(folder, name_of(*shard))) fs::remove(at->path(), ignored);
    }
  }
}

}  // namespace app
}  // namespace v0
}  // namespace incise
