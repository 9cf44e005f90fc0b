// SPDX-License-Identifier: Apache-2.0
// The strokes are read by what scenes share with blade files; regions are looked up once the mesh is known, and the
// edge is then held outside of them.
#include "app/scene/blade_file.h"

#include <utility>

#include "app/model/find_regions.h"
#include "app/scene/stroke_reader.h"
#include "app/text/json_tree.h"
#include "app/text/text_file.h"
#include "incise/cut/region_guard.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr std::uint32_t kBladeVersion = 1;

class BladeReader {
 public:
  explicit BladeReader(std::string_view file_name) : read_(file_name) {}

  Result<std::vector<BladeStroke>> run(const JsonValue& root) {
    std::vector<BladeStroke> strokes;
    if (!read_header(root) || !read_strokes(read_, *root.find("strokes"), "strokes", strokes)) return read_.error();
    return strokes;
  }

 private:
  bool read_header(const JsonValue& root) {
    return read_.is_format(root, "incise-blade", kBladeVersion) &&
           read_.is_object(root, "", {"format", "version", "strokes"}) && read_.member(root, "", "strokes") != nullptr;
  }

  JsonReader read_;
};

/// "stroke 2 (cut)".
std::string stroke_name(const std::vector<BladeStroke>& blade, std::size_t index) {
  const std::string& name = blade[index].stroke.name;
  return "stroke " + std::to_string(index) + (name.empty() ? "" : " (" + name + ")");
}

bool stops(const BladeStroke& stroke) {
  return !stroke.stop_at.empty() || !stroke.stop_names.empty();
}

Result<std::vector<Stroke>> without_stops(Result<std::vector<BladeStroke>> blade, std::string_view file_name) {
  if (!blade.ok()) return blade.error();
  std::vector<Stroke> strokes;
  for (std::size_t i = 0; i < blade->size(); ++i) {
    if (stops((*blade)[i])) {
      return Error{ErrorCode::kBadFile,
                   std::string(file_name) + ": " + stroke_name(*blade, i) +
                       " has stop_at, which is not known here; incise cut --blade, scenes and batches stop at regions",
                   {i}};
    }
    strokes.push_back(std::move((*blade)[i].stroke));
  }
  return strokes;
}

}  // namespace

Result<std::vector<BladeStroke>> parse_blade_file(std::string_view json, std::string_view file_name) {
  Result<JsonValue> root = parse_json(json, file_name);
  if (!root.ok()) return root.error();
  return BladeReader(file_name).run(*root);
}

Result<std::vector<BladeStroke>> read_blade_file(const std::filesystem::path& path) {
  Result<std::string> text = read_text_file(path, JsonLimits{}.max_bytes);
  if (!text.ok()) return text.error();
  return parse_blade_file(*text, path.string());
}

Result<std::vector<Stroke>> parse_blade(std::string_view json, std::string_view file_name) {
  return without_stops(parse_blade_file(json, file_name), file_name);
}

Result<std::vector<Stroke>> read_blade(const std::filesystem::path& path) {
  return without_stops(read_blade_file(path), path.string());
}

Result<std::vector<Stroke>> held_strokes(const std::vector<BladeStroke>& blade, const TetMesh& mesh,
                                         const io::RegionNames& names) {
  std::vector<Stroke> strokes;
  for (std::size_t i = 0; i < blade.size(); ++i) {
    strokes.push_back(blade[i].stroke);
    if (!stops(blade[i])) continue;
    std::vector<std::int32_t> regions = blade[i].stop_at;
    if (const Status there = check_regions(regions, mesh); !there.ok()) {
      return Error{ErrorCode::kBadFile, stroke_name(blade, i) + ": stop_at: " + there.error().message, {i}};
    }
    for (const std::string& name : blade[i].stop_names) {
      const Result<std::vector<std::int32_t>> found = find_regions(name, names);
      if (!found.ok())
        return Error{ErrorCode::kBadFile, stroke_name(blade, i) + ": stop_at: " + found.error().message, {i}};
      regions.insert(regions.end(), found->begin(), found->end());
    }
    Result<Stroke> held = hold_outside(mesh, blade[i].stroke, regions);
    if (!held.ok()) return Error{ErrorCode::kBadFile, stroke_name(blade, i) + ": " + held.error().message, {i}};
    strokes.back() = std::move(held).value();
  }
  return strokes;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
