// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace incise {
inline namespace v0 {
namespace io {

inline constexpr std::size_t kStlHeader = 84;    ///< 80 bytes of text and a count
inline constexpr std::size_t kStlTriangle = 50;  ///< normal, three points, two spare bytes

/// A number of four bytes, the least first.
[[nodiscard]] inline std::uint32_t load_u32(const char* p) {
  std::uint32_t bits = 0;
  for (std::size_t i = 4; i-- > 0;) bits = (bits << 8U) | static_cast<unsigned char>(p[i]);
  return bits;
}

/// Whether a file is as long as a binary STL file with its count.
[[nodiscard]] inline bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= kStlHeader &&
         bytes.size() - kStlHeader == std::size_t{load_u32(bytes.data() + kStlHeader - 4)} * kStlTriangle;
}

/// What archives, pictures and other files are that are neither meshes nor surfaces, by their first bytes; null where
/// they are none that is known here.
[[nodiscard]] inline const char* foreign_kind(std::string_view bytes) {
  using std::string_view_literals::operator""sv;
  struct Mark {
    std::size_t at;
    std::string_view bytes;
    const char* kind;
  };
  constexpr Mark kMarks[] = {{0, "PK\3\4"sv, "a zip archive"},
                             {0, "\4\x22M\x18"sv, "an LZ4 archive"},
                             {0,
                              "\xFD"
                              "7zXZ"sv,
                              "an xz archive"},
                             {0, "BZh"sv, "a bzip2 archive"},
                             {0, "\x28\xB5\x2F\xFD"sv, "a Zstandard archive"},
                             {0, "7z\xBC\xAF"sv, "a 7z archive"},
                             {0, "Rar!"sv, "a RAR archive"},
                             {0, "\x1F\x9D"sv, "a file packed by compress (.Z)"},
                             {0, "LZIP"sv, "an lzip archive"},
                             {257, "ustar"sv, "a tar archive"},
                             {0, "glTF"sv, "glTF (.glb)"},
                             {0, "\x89PNG"sv, "a PNG picture"},
                             {0, "\xFF\xD8\xFF"sv, "a JPEG picture"},
                             {0, "%PDF"sv, "PDF"},
                             {0, "ISO-10303-21"sv, "STEP"},
                             {0, "mesh3d"sv, "a Netgen mesh (.vol)"},
                             {0, "*KEYWORD"sv, "LS-DYNA (.k)"},
                             {0, "(0 \""sv, "a Fluent mesh (.msh)"},
                             {0, "(1 \""sv, "a Fluent mesh (.msh)"},
                             {0, "(2 3)"sv, "a Fluent mesh (.msh)"},
                             {0, "CDF"sv, "NetCDF (.nc, .exo)"},
                             {0, "\xFF\xFE"sv, "text in UTF-16 (save it as UTF-8)"},
                             {0, "\xFE\xFF"sv, "text in UTF-16 (save it as UTF-8)"},
                             {0, "version https://git-lfs"sv, "a pointer of Git LFS (git lfs pull fetches the file)"}};
  for (const Mark& mark : kMarks) {
    if (bytes.size() >= mark.at && bytes.substr(mark.at).starts_with(mark.bytes)) return mark.kind;
  }
  return nullptr;
}

/// Whether it begins as NIfTI or MetaImage does.
[[nodiscard]] inline bool is_image(std::string_view bytes) {
  using std::string_view_literals::operator""sv;
  const bool is_nifti = bytes.size() >= 348 && (bytes.substr(344, 4) == "n+1\0"sv || bytes.substr(344, 4) == "ni1\0"sv);
  return is_nifti || bytes.starts_with("ObjectType") || bytes.starts_with("NDims");
}

/// Whether a file of at most `limit` bytes that begins so may be as long as its count says; it begins with more than a
/// header.
[[nodiscard]] inline bool may_be_binary_stl(std::string_view beginning, std::uint64_t limit) {
  if (beginning.size() < kStlHeader) return false;
  const std::uint64_t size = kStlHeader + std::uint64_t{load_u32(beginning.data() + kStlHeader - 4)} * kStlTriangle;
  return size >= beginning.size() && size <= limit;
}

}  // namespace io
}  // namespace v0
}  // namespace incise
