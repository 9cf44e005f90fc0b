// SPDX-License-Identifier: Apache-2.0
// What the writers of all formats share.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "incise/io/mesh_file.h"
#include "io/text.h"

namespace incise {
inline namespace v0 {
namespace io {

using Labels = std::vector<std::int32_t>;

[[nodiscard]] inline std::int32_t label(const Labels& labels, std::size_t i) {
  return labels.empty() ? 0 : labels[i];
}

/// Text with numbers that read back exactly.
class Text {
 public:
  Text& operator<<(std::string_view text) {
    out_ += text;
    return *this;
  }
  Text& operator<<(char c) {
    out_ += c;
    return *this;
  }
  Text& operator<<(double value) {
    append_double(out_, value);
    return *this;
  }
  template <class Int>
  requires std::is_integral_v<Int> Text& operator<<(Int value) {
    append_int(out_, static_cast<std::int64_t>(value));
    return *this;
  }
  Text& operator<<(const Vec3& p) { return *this << p.x() << ' ' << p.y() << ' ' << p.z(); }
  /// Vertex numbers that count from `base`.
  template <std::size_t N>
  Text& row(const std::array<std::uint32_t, N>& vertices, std::uint32_t base) {
    for (std::size_t k = 0; k < N; ++k) *this << (k == 0 ? std::string_view() : " ") << vertices[k] + base;
    return *this;
  }

  std::string take() { return std::move(out_); }

 private:
  std::string out_;
};

/// Little-endian bytes on every machine.
template <class T>
void append_bytes(std::string& out, T value) {
  std::uint64_t bits = 0;
  if constexpr (sizeof(T) == 8) {
    std::memcpy(&bits, &value, sizeof value);
  } else {
    bits = static_cast<std::make_unsigned_t<T>>(value);
  }
  for (std::size_t i = 0; i < sizeof value; ++i) out += static_cast<char>((bits >> (8 * i)) & 255U);
}

[[nodiscard]] inline bool has_strokes(const MeshData& data) {
  return !data.triangle_stroke.empty() && !data.has_foreign_labels;
}

struct NamedLabels {
  std::string_view name;
  Labels values;
};

/// One array over all cells, tets first; the other kind has 0.
[[nodiscard]] Labels cell_array(const MeshData& data, const Labels& of_tets, const Labels& of_triangles);
/// The arrays over all cells that a mesh has.
[[nodiscard]] std::vector<NamedLabels> cell_arrays(const MeshData& data);
/// The labels of points that a mesh has.
[[nodiscard]] std::vector<NamedLabels> point_arrays(const MeshData& data);

/// The name of the data in a MSH file that say at which place each element stood, tets before triangles.
inline constexpr std::string_view kMshOrder = "incise:order";

/// A set of the tets of each label, as Vega and Abaqus have them; label 0 needs none.
void label_sets(Text& out, std::string_view opening, std::string_view prefix, const Labels& labels);

}  // namespace io
}  // namespace v0
}  // namespace incise
