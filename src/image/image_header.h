// SPDX-License-Identifier: Apache-2.0
// The headers of the formats. Each `read_…_header` takes the beginning of a file, of at least the whole header.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "image/raw_voxels.h"
#include "incise/core/result.h"

namespace incise {
inline namespace v0 {
namespace image {

/// Where the voxels are, and what they mean.
struct ImageHeader {
  VoxelLayout layout;
  std::string format_name, placed_by;
  std::vector<std::string> notes;
  std::string data_file;        ///< that has the voxels, beside the header; empty: they follow the header
  std::uint64_t offset = 0;     ///< of the voxels in their file; in bytes
  std::uint64_t line_skip = 0;  ///< lines to pass over from there
  std::uint64_t byte_skip = 0;  ///< bytes to pass over after these
  bool is_at_end = false;       ///< the voxels are the last bytes of their file, whatever `offset` says
  bool is_deflated = false;     ///< the voxels are a gzip or zlib stream from there on
};

[[nodiscard]] bool is_nifti(std::string_view bytes);
[[nodiscard]] Result<ImageHeader> read_nifti_header(std::string_view bytes, const std::string& name);

[[nodiscard]] bool is_nrrd(std::string_view bytes);
[[nodiscard]] Result<ImageHeader> read_nrrd_header(std::string_view bytes, const std::string& name);

[[nodiscard]] bool is_meta_image(std::string_view bytes);
[[nodiscard]] Result<ImageHeader> read_meta_header(std::string_view bytes, const std::string& name);

[[nodiscard]] bool is_inrimage(std::string_view bytes);
[[nodiscard]] Result<ImageHeader> read_inr_header(std::string_view bytes, const std::string& name);

// For headers of text.

[[nodiscard]] std::string_view trimmed(std::string_view text);
[[nodiscard]] std::string lower_case(std::string_view text);
/// The next line without its end, which may be CR LF; moves `at` behind it.
[[nodiscard]] std::string_view next_line(std::string_view bytes, std::size_t& at);
/// All numbers of a text that white space, commas or brackets part; empty where a word is no number.
[[nodiscard]] std::vector<double> numbers_of(std::string_view text);
/// `size` of whole numbers of at least 0; false where one is not.
[[nodiscard]] bool to_sizes(const std::vector<double>& numbers, std::vector<std::uint64_t>& sizes);
/// Drops axes of one element until three are left, and adds some where there are fewer. `keep` gets the axes that stay.
/// False where more than three have more than one element.
[[nodiscard]] bool find_three_axes(const std::vector<std::uint64_t>& sizes, std::array<std::size_t, 3>& keep);

}  // namespace image
}  // namespace v0
}  // namespace incise
