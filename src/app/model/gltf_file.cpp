// SPDX-License-Identifier: Apache-2.0
// glTF 2.0, Khronos Group: a header, a chunk of JSON and a chunk of numbers, all little-endian and by words of 4 bytes.
#include "app/model/gltf_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "app/text/json_write.h"
#include "app/text/text_file.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// Numbers that the format gives meanings to.
constexpr int kFloat = 5126, kUnsigned = 5125;               // component types
constexpr int kArrayBuffer = 34962, kElementBuffer = 34963;  // targets of buffer views
constexpr std::uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinChunk = 0x004E4942;

void append_u32(std::string& out, std::uint32_t value) {
  for (unsigned i = 0; i < 4; ++i) out += static_cast<char>((value >> (8 * i)) & 255U);
}

void append_float(std::string& out, float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  append_u32(out, bits);
}

class GltfWriter {
 public:
  explicit GltfWriter(const GltfBody& body) : body_(body), drawn_(body.surface) {}

  std::string run() && {
    root_["asset"] = {{"version", "2.0"}, {"generator", "Incise"}};
    root_["scene"] = 0;
    root_["scenes"] = Json::array({{{"nodes", {0}}}});
    root_["nodes"] = Json::array({{{"mesh", 0}, {"name", body_.name}}});
    root_["materials"] =
        Json::array({material("skin", {0.78, 0.47, 0.40}, 0.55), material("wall", {0.55, 0.10, 0.09}, 0.35)});
    Json mesh = {{"name", body_.name}, {"primitives", Json::array()}};
    const auto skin = static_cast<std::uint32_t>(drawn_.skin_points);
    if (!drawn_.skin.empty()) mesh["primitives"].push_back(primitive(drawn_.skin, 0, skin, 0));
    if (!drawn_.walls.empty()) {
      mesh["primitives"].push_back(primitive(drawn_.walls, skin, static_cast<std::uint32_t>(drawn_.points.size()), 1));
    }
    if (!body_.moments.empty()) {
      mesh["weights"] = std::vector<double>(body_.moments.size(), 0);
      root_["animations"] = Json::array({animation()});
    }
    root_["meshes"] = Json::array({std::move(mesh)});
    root_["buffers"] = Json::array({{{"byteLength", numbers_.size()}}});
    return packed();
  }

 private:
  static Json material(const char* name, const std::array<double, 3>& color, double roughness) {
    return {{"name", name},
            {"doubleSided", true},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", {color[0], color[1], color[2], 1.0}},
              {"metallicFactor", 0.0},
              {"roughnessFactor", roughness}}}};
  }

  /// The points [first, end) and the triangles on them.
  Json primitive(const Triangles& triangles, std::uint32_t first, std::uint32_t end, int material) {
    Json result;
    result["material"] = material;
    const auto& base = body_.moments.empty() ? body_.positions : body_.moments.front().positions;
    Json& attributes = result["attributes"];
    attributes["POSITION"] = places(base, nullptr, first, end);
    attributes["NORMAL"] = directions(first, end);
    attributes["TEXCOORD_0"] = texture(first, end);
    if (material == 1) attributes["_REST"] = rests(first, end);
    result["indices"] = indices(triangles, first);
    for (const GltfMoment& moment : body_.moments) {
      result["targets"].push_back({{"POSITION", places(moment.positions, &base, first, end)}});
    }
    return result;
  }

  /// In metres; relative to `base` where there is one.
  std::size_t places(const std::vector<Vec3>& points, const std::vector<Vec3>* base, std::uint32_t first,
                     std::uint32_t end) {
    const std::size_t begin = numbers_.size();
    std::array<float, 3> low, high;
    low.fill(0);
    high.fill(0);
    for (std::uint32_t i = first; i < end; ++i) {
      const Vec3 p = body_.metres_per_unit * (base == nullptr ? points[i] : Vec3(points[i] - (*base)[i]));
      for (std::size_t k = 0; k < 3; ++k) {
        const auto value = static_cast<float>(p[static_cast<Eigen::Index>(k)]);
        low[k] = i == first ? value : std::min(low[k], value);
        high[k] = i == first ? value : std::max(high[k], value);
        append_float(numbers_, value);
      }
    }
    const std::size_t number = add_accessor(begin, kArrayBuffer, kFloat, "VEC3", end - first);
    root_["accessors"][number]["min"] = low;
    root_["accessors"][number]["max"] = high;
    return number;
  }

  std::size_t directions(std::uint32_t first, std::uint32_t end) {
    const std::size_t begin = numbers_.size();
    for (std::uint32_t i = first; i < end; ++i) append(body_.normals[i]);
    return add_accessor(begin, kArrayBuffer, kFloat, "VEC3", end - first);
  }

  std::size_t rests(std::uint32_t first, std::uint32_t end) {
    const std::size_t begin = numbers_.size();
    for (std::uint32_t i = first; i < end; ++i) append(drawn_.points[i].rest);
    return add_accessor(begin, kArrayBuffer, kFloat, "VEC3", end - first);
  }

  /// glTF's v goes down from the picture's upper edge, as other formats' goes up from its lower one.
  std::size_t texture(std::uint32_t first, std::uint32_t end) {
    const std::size_t begin = numbers_.size();
    for (std::uint32_t i = first; i < end; ++i) {
      append_float(numbers_, static_cast<float>(drawn_.points[i].texture[0]));
      append_float(numbers_, static_cast<float>(1 - drawn_.points[i].texture[1]));
    }
    return add_accessor(begin, kArrayBuffer, kFloat, "VEC2", end - first);
  }

  std::size_t indices(const Triangles& triangles, std::uint32_t first) {
    const std::size_t begin = numbers_.size();
    for (const auto& triangle : triangles) {
      for (const std::uint32_t i : triangle) append_u32(numbers_, i - first);
    }
    return add_accessor(begin, kElementBuffer, kUnsigned, "SCALAR", 3 * triangles.size());
  }

  void append(const Vec3& v) {
    for (int k = 0; k < 3; ++k) append_float(numbers_, static_cast<float>(v[k]));
  }

  /// Of the numbers from `begin` on. `target` 0: none.
  std::size_t add_accessor(std::size_t begin, int target, int component, const char* type, std::size_t count) {
    Json view = {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", numbers_.size() - begin}};
    if (target != 0) view["target"] = target;
    root_["bufferViews"].push_back(std::move(view));
    root_["accessors"].push_back({{"bufferView", root_["bufferViews"].size() - 1},
                                  {"componentType", component},
                                  {"count", count},
                                  {"type", type}});
    return root_["accessors"].size() - 1;
  }

  /// At each moment its own target counts alone.
  Json animation() {
    const std::size_t count = body_.moments.size();
    const std::size_t times_begin = numbers_.size();
    for (const GltfMoment& moment : body_.moments) append_float(numbers_, static_cast<float>(moment.seconds));
    const std::size_t times = add_accessor(times_begin, 0, kFloat, "SCALAR", count);
    root_["accessors"][times]["min"] = {static_cast<float>(body_.moments.front().seconds)};
    root_["accessors"][times]["max"] = {static_cast<float>(body_.moments.back().seconds)};
    const std::size_t weights_begin = numbers_.size();
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < count; ++k) append_float(numbers_, i == k ? 1.0F : 0.0F);
    }
    const std::size_t weights = add_accessor(weights_begin, 0, kFloat, "SCALAR", count * count);
    return {{"name", "simulation"},
            {"samplers", Json::array({{{"input", times}, {"output", weights}, {"interpolation", "LINEAR"}}})},
            {"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}})}};
  }

  [[nodiscard]] std::string packed() const {
    std::string json = root_.dump(-1, ' ', false, Json::error_handler_t::replace);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string out;
    append_u32(out, kMagic);
    append_u32(out, 2);
    append_u32(out, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + numbers_.size()));
    append_u32(out, static_cast<std::uint32_t>(json.size()));
    append_u32(out, kJsonChunk);
    out += json;
    append_u32(out, static_cast<std::uint32_t>(numbers_.size()));
    append_u32(out, kBinChunk);
    return out + numbers_;
  }

  const GltfBody& body_;
  const DrawnSurface& drawn_;
  Json root_;
  std::string numbers_;
};

}  // namespace

std::string to_glb(const GltfBody& body) {
  return GltfWriter(body).run();
}

Status write_glb(const std::filesystem::path& path, const GltfBody& body) {
  return write_text_file(path, to_glb(body));
}

}  // namespace app
}  // namespace v0
}  // namespace incise
