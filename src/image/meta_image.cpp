// SPDX-License-Identifier: Apache-2.0
// MetaImage (.mha, .mhd) and INRIMAGE (.inr): headers of "key = value". Source: MetaIO documentation of ITK;
// "Inrimage format", INRIA.
#include <map>

#include "image/image_header.h"

namespace incise {
inline namespace v0 {
namespace image {
namespace {

using Keys = std::map<std::string, std::string>;

/// Adds the line "key = value", if it is one.
bool add_line(Keys& keys, std::string_view line) {
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) return false;
  keys[lower_case(trimmed(line.substr(0, equals)))] = std::string(trimmed(line.substr(equals + 1)));
  return true;
}

std::string value_of(const Keys& keys, const std::string& name, const std::string& other = "") {
  auto found = keys.find(name);
  if (found == keys.end() && !other.empty()) found = keys.find(other);
  return found == keys.end() ? "" : found->second;
}

bool is_true(const std::string& text) {
  return !text.empty() && (text[0] == 'T' || text[0] == 't' || text[0] == '1');
}

VoxelType meta_type(const std::string& text) {
  static const std::map<std::string, VoxelType> kTypes = {
      {"met_uchar", VoxelType::kUint8},     {"met_char", VoxelType::kInt8},     {"met_ushort", VoxelType::kUint16},
      {"met_short", VoxelType::kInt16},     {"met_uint", VoxelType::kUint32},   {"met_int", VoxelType::kInt32},
      {"met_ulong", VoxelType::kUint32},    {"met_long", VoxelType::kInt32},    {"met_ulong_long", VoxelType::kUint64},
      {"met_long_long", VoxelType::kInt64}, {"met_float", VoxelType::kFloat32}, {"met_double", VoxelType::kFloat64}};
  const auto found = kTypes.find(lower_case(text));
  return found == kTypes.end() ? VoxelType::kUnknown : found->second;
}

/// Keys up to the one that ends the header.
Keys meta_keys(std::string_view bytes, std::size_t& end) {
  Keys keys;
  end = 0;
  while (end < bytes.size() && keys.find("elementdatafile") == keys.end()) {
    if (!add_line(keys, next_line(bytes, end))) break;
  }
  return keys;
}

/// What of the header this reader cannot take; empty where it can.
std::string unsupported(const Keys& keys, VoxelType type) {
  const std::string file = value_of(keys, "elementdatafile");
  if (type == VoxelType::kUnknown) {
    return "has voxels of type '" + value_of(keys, "elementtype").substr(0, 40) +
           "', which are no labels; save it as MET_USHORT";
  }
  if (file.substr(0, 4) == "LIST" || file.find('%') != std::string::npos) {
    return "has its voxels in several files; save it as one";
  }
  const std::string channels = value_of(keys, "elementnumberofchannels");
  if (!channels.empty() && channels != "1")
    return "has " + channels.substr(0, 40) + " channels; save one of them alone";
  const std::string binary = value_of(keys, "binarydata");
  return !binary.empty() && !is_true(binary) ? "has its voxels as text; save it with BinaryData = True" : "";
}

std::string place_meta(const Keys& keys, const std::vector<std::uint64_t>& sizes,
                       const std::array<std::size_t, 3>& keep, ImageHeader& header) {
  const std::size_t n = sizes.size();
  std::vector<double> spacing = numbers_of(value_of(keys, "elementspacing", "elementsize"));
  std::vector<double> matrix =
      numbers_of(value_of(keys, "transformmatrix", keys.count("rotation") > 0 ? "rotation" : "orientation"));
  std::vector<double> offset = numbers_of(value_of(keys, "offset", keys.count("position") > 0 ? "position" : "origin"));
  if (matrix.empty()) header.notes.emplace_back("has no orientation: its axes are taken for left, back and head");
  if (spacing.empty()) spacing.assign(n, 1);
  if (offset.empty()) offset.assign(n, 0);
  if (matrix.empty()) {
    matrix.assign(n * n, 0);
    for (std::size_t a = 0; a < n; ++a) matrix[a * n + a] = 1;
  }
  if (spacing.size() != n || offset.size() != n || matrix.size() != n * n) {
    return "has a spacing, offset or matrix of another dimension than NDims; mend the header";
  }
  for (std::size_t a = 0; a < 3 && n >= 3; ++a) {
    const std::size_t axis = keep[a];
    for (std::size_t c = 0; c < 3; ++c) {
      header.layout.step[a][static_cast<Eigen::Index>(c)] = spacing[axis] * matrix[axis * n + keep[c]];
    }
    header.layout.origin[static_cast<Eigen::Index>(a)] = offset[axis];
  }
  for (std::size_t a = 0; a < n && n < 3; ++a) header.layout.step[a] *= spacing[a];
  turn_to_ras(header.layout);
  header.placed_by = "transform matrix and offset, LPS";
  return {};
}

/// The place of the voxels.
std::string find_meta_voxels(const Keys& keys, std::size_t end, ImageHeader& header) {
  header.is_deflated = is_true(value_of(keys, "compresseddata"));
  header.layout.is_big_endian = is_true(value_of(keys, "elementbyteordermsb", "binarydatabyteordermsb"));
  const std::string file = value_of(keys, "elementdatafile");
  const bool is_attached = lower_case(file) == "local";
  if (!is_attached) header.data_file = file;
  if (is_attached) header.offset = end;
  const std::vector<double> skip = numbers_of(value_of(keys, "headersize"));
  if (skip.empty()) return {};
  header.is_at_end = skip[0] == -1;
  std::vector<std::uint64_t> sizes;
  if (!header.is_at_end && !to_sizes(skip, sizes)) return "has a HeaderSize that is no number of bytes; mend it";
  if (!header.is_at_end) header.offset += sizes[0];
  return {};
}

}  // namespace

bool is_meta_image(std::string_view bytes) {
  std::size_t at = 0;
  const std::string line = lower_case(next_line(bytes.substr(0, 200), at));
  return line.find('=') != std::string::npos && (line.rfind("objecttype", 0) == 0 || line.rfind("ndims", 0) == 0);
}

Result<ImageHeader> read_meta_header(std::string_view bytes, const std::string& name) {
  std::size_t end = 0;
  const Keys keys = meta_keys(bytes, end);
  ImageHeader header;
  header.format_name = "MetaImage";
  if (value_of(keys, "elementdatafile").empty()) {
    return Error{ErrorCode::kBadFile, name + ": has no ElementDataFile; is the header cut off?"};
  }
  header.layout.type = meta_type(value_of(keys, "elementtype"));
  if (const std::string what = unsupported(keys, header.layout.type); !what.empty()) {
    return Error{ErrorCode::kUnsupported, name + ": " + what};
  }
  std::vector<std::uint64_t> sizes;
  std::array<std::size_t, 3> keep{};
  const std::vector<double> dimension = numbers_of(value_of(keys, "ndims"));
  if (!to_sizes(numbers_of(value_of(keys, "dimsize")), sizes) || sizes.empty() || sizes.size() > 10 ||
      dimension.size() != 1 || dimension[0] != static_cast<double>(sizes.size())) {
    return Error{ErrorCode::kBadFile, name + ": has no DimSize, or not as many as NDims; is the header damaged?"};
  }
  if (!find_three_axes(sizes, keep)) {
    return Error{ErrorCode::kUnsupported, name + ": has more than three axes; save one volume alone"};
  }
  for (std::size_t a = 0; a < 3; ++a) header.layout.size[a] = keep[a] < sizes.size() ? sizes[keep[a]] : 1;
  std::string problem = place_meta(keys, sizes, keep, header);
  if (problem.empty()) problem = find_meta_voxels(keys, end, header);
  if (!problem.empty()) return Error{ErrorCode::kBadFile, name + ": " + problem};
  return header;
}

bool is_inrimage(std::string_view bytes) {
  return bytes.substr(0, 12) == "#INRIMAGE-4#";
}

Result<ImageHeader> read_inr_header(std::string_view bytes, const std::string& name) {
  const std::size_t length = bytes.find("##}");
  if (length == std::string_view::npos) {
    return Error{ErrorCode::kBadFile, name + ": the end of the header, ##}, is missing; is the file cut off?"};
  }
  Keys keys;
  for (std::size_t at = 0; at < length;) (void)add_line(keys, next_line(bytes.substr(0, length), at));
  ImageHeader header;
  header.format_name = "INRIMAGE";
  header.offset = length + 4;  // with a line end
  header.placed_by = "spacing alone";
  header.notes.emplace_back("has no orientation: its axes are taken for right, front and head");
  constexpr std::array<const char*, 3> kSizes = {"xdim", "ydim", "zdim"}, kSteps = {"vx", "vy", "vz"};
  for (std::size_t a = 0; a < 3; ++a) {
    std::vector<std::uint64_t> size;
    if (!to_sizes(numbers_of(value_of(keys, kSizes[a])), size) || size.size() != 1) {
      return Error{ErrorCode::kBadFile, name + ": has no sizes XDIM, YDIM and ZDIM; is the header damaged?"};
    }
    header.layout.size[a] = size[0];
    const std::vector<double> step = numbers_of(value_of(keys, kSteps[a]));
    if (step.size() == 1) header.layout.step[a] *= step[0];
  }
  const std::string kind = lower_case(value_of(keys, "type"));
  const std::string bits = value_of(keys, "pixsize");
  const std::string channels = value_of(keys, "vdim");
  static const std::map<std::string, VoxelType> kTypes = {
      {"unsigned fixed 8", VoxelType::kUint8},   {"signed fixed 8", VoxelType::kInt8},
      {"unsigned fixed 16", VoxelType::kUint16}, {"signed fixed 16", VoxelType::kInt16},
      {"unsigned fixed 32", VoxelType::kUint32}, {"signed fixed 32", VoxelType::kInt32},
      {"float 32", VoxelType::kFloat32},         {"float 64", VoxelType::kFloat64}};
  const auto type = kTypes.find(kind + " " + bits.substr(0, bits.find(' ')));
  if (type == kTypes.end() || (!channels.empty() && channels != "1")) {
    return Error{ErrorCode::kUnsupported, name + ": has voxels that are no labels; save it as 'unsigned fixed'"};
  }
  header.layout.type = type->second;
  const std::string order = lower_case(value_of(keys, "cpu"));
  header.layout.is_big_endian = order == "sun" || order == "sgi";
  return header;
}

}  // namespace image
}  // namespace v0
}  // namespace incise
