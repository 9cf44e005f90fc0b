// SPDX-License-Identifier: Apache-2.0
#include "app/scene/blade_file.h"

#include "app/scene/stroke_reader.h"
#include "app/text/json_tree.h"
#include "app/text/text_file.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr std::uint32_t kVersion = 1;

class BladeReader {
 public:
  explicit BladeReader(std::string_view file_name) : read_(file_name) {}

  Result<std::vector<Stroke>> run(const JsonValue& root) {
    std::vector<Stroke> strokes;
    if (!read_header(root) || !read_strokes(read_, *root.find("strokes"), "strokes", strokes)) return read_.error();
    return strokes;
  }

 private:
  bool read_header(const JsonValue& root) {
    return read_.is_format(root, "incise-blade", kVersion) &&
           read_.is_object(root, "", {"format", "version", "strokes"}) && read_.member(root, "", "strokes") != nullptr;
  }

  JsonReader read_;
};

}  // namespace

Result<std::vector<Stroke>> parse_blade(std::string_view json, std::string_view file_name) {
  Result<JsonValue> root = parse_json(json, file_name);
  if (!root.ok()) return root.error();
  return BladeReader(file_name).run(*root);
}

Result<std::vector<Stroke>> read_blade(const std::filesystem::path& path) {
  Result<std::string> text = read_text_file(path, JsonLimits{}.max_bytes);
  if (!text.ok()) return text.error();
  return parse_blade(*text, path.string());
}

}  // namespace app
}  // namespace v0
}  // namespace incise
