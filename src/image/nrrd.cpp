// SPDX-License-Identifier: Apache-2.0
// NRRD, versions 1 to 5. Source: "Definition of NRRD File Format", the Teem project.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "image/image_header.h"

namespace incise {
inline namespace v0 {
namespace image {
namespace {

using NrrdFields = std::map<std::string, std::string>;

Error bad(const std::string& name, const std::string& what) {
  return {ErrorCode::kBadFile, name + ": " + what};
}

/// The fields of the header; `end` gets where it ends.
NrrdFields fields_of(std::string_view bytes, std::size_t& end) {
  NrrdFields fields;
  end = 0;
  (void)next_line(bytes, end);  // the magic
  while (end < bytes.size()) {
    const std::string_view line = next_line(bytes, end);
    if (line.empty()) return fields;
    const std::size_t colon = line.find(':');
    if (line[0] == '#' || colon == std::string_view::npos) continue;
    if (colon + 1 < line.size() && line[colon + 1] == '=') continue;  // a key of somebody's own
    fields[lower_case(trimmed(line.substr(0, colon)))] = std::string(trimmed(line.substr(colon + 1)));
  }
  return fields;
}

std::string field(const NrrdFields& fields, const std::string& name, const std::string& other = "") {
  auto found = fields.find(name);
  if (found == fields.end() && !other.empty()) found = fields.find(other);
  return found == fields.end() ? "" : found->second;
}

VoxelType nrrd_type(const std::string& text) {
  static const std::map<std::string, VoxelType> kTypes = {{"uchar", VoxelType::kUint8},
                                                          {"unsigned char", VoxelType::kUint8},
                                                          {"uint8", VoxelType::kUint8},
                                                          {"uint8_t", VoxelType::kUint8},
                                                          {"signed char", VoxelType::kInt8},
                                                          {"int8", VoxelType::kInt8},
                                                          {"int8_t", VoxelType::kInt8},
                                                          {"ushort", VoxelType::kUint16},
                                                          {"unsigned short", VoxelType::kUint16},
                                                          {"unsigned short int", VoxelType::kUint16},
                                                          {"uint16", VoxelType::kUint16},
                                                          {"uint16_t", VoxelType::kUint16},
                                                          {"short", VoxelType::kInt16},
                                                          {"short int", VoxelType::kInt16},
                                                          {"signed short", VoxelType::kInt16},
                                                          {"signed short int", VoxelType::kInt16},
                                                          {"int16", VoxelType::kInt16},
                                                          {"int16_t", VoxelType::kInt16},
                                                          {"uint", VoxelType::kUint32},
                                                          {"unsigned int", VoxelType::kUint32},
                                                          {"uint32", VoxelType::kUint32},
                                                          {"uint32_t", VoxelType::kUint32},
                                                          {"int", VoxelType::kInt32},
                                                          {"signed int", VoxelType::kInt32},
                                                          {"int32", VoxelType::kInt32},
                                                          {"int32_t", VoxelType::kInt32},
                                                          {"ulonglong", VoxelType::kUint64},
                                                          {"unsigned long long", VoxelType::kUint64},
                                                          {"unsigned long long int", VoxelType::kUint64},
                                                          {"uint64", VoxelType::kUint64},
                                                          {"uint64_t", VoxelType::kUint64},
                                                          {"longlong", VoxelType::kInt64},
                                                          {"long long", VoxelType::kInt64},
                                                          {"long long int", VoxelType::kInt64},
                                                          {"signed long long", VoxelType::kInt64},
                                                          {"signed long long int", VoxelType::kInt64},
                                                          {"int64", VoxelType::kInt64},
                                                          {"int64_t", VoxelType::kInt64},
                                                          {"float", VoxelType::kFloat32},
                                                          {"double", VoxelType::kFloat64}};
  const auto found = kTypes.find(lower_case(text));
  return found == kTypes.end() ? VoxelType::kUnknown : found->second;
}

/// The vectors of "space directions", one per axis; nothing for "none". Empty where one is no vector.
std::vector<std::optional<Vec3>> directions_of(const std::string& text) {
  std::vector<std::optional<Vec3>> out;
  for (std::size_t at = 0; (at = text.find_first_not_of(" \t", at)) != std::string::npos;) {
    if (text.compare(at, 4, "none") == 0) {
      out.emplace_back(std::nullopt);
      at += 4;
      continue;
    }
    const std::size_t end = text.find(')', at);
    if (text[at] != '(' || end == std::string::npos) return {};
    const std::vector<double> n = numbers_of(std::string_view(text).substr(at, end - at));
    if (n.size() != 3) return {};
    out.emplace_back(Vec3(n[0], n[1], n[2]));
    at = end + 1;
  }
  return out;
}

/// What turns a space's coordinates into RAS; nothing where its axes are not those of a patient.
std::optional<Vec3> turn_of(const std::string& space) {
  const std::string s = lower_case(space);
  if (s == "right-anterior-superior" || s == "ras") return Vec3(1, 1, 1);
  if (s == "left-anterior-superior" || s == "las") return Vec3(-1, 1, 1);
  if (s == "left-posterior-superior" || s == "lps") return Vec3(-1, -1, 1);
  return std::nullopt;
}

struct Axes {
  std::vector<std::uint64_t> sizes;
  std::array<std::size_t, 3> keep = {0, 1, 2};  ///< those that are of space
};

/// Finds the three axes of space: those with a direction, or those that are not of one element.
std::string find_axes(const NrrdFields& fields, const std::vector<std::optional<Vec3>>& directions, Axes& axes) {
  const std::vector<double> dimension = numbers_of(field(fields, "dimension"));
  if (!to_sizes(numbers_of(field(fields, "sizes")), axes.sizes) || axes.sizes.empty() || axes.sizes.size() > 16 ||
      dimension.size() != 1 || dimension[0] != static_cast<double>(axes.sizes.size())) {
    return "has no sizes, or not as many as its dimension; is the header damaged?";
  }
  std::vector<std::uint64_t> in_space = axes.sizes;
  if (directions.size() == axes.sizes.size()) {
    for (std::size_t a = 0; a < directions.size(); ++a) {
      if (!directions[a] && axes.sizes[a] != 1) {
        return "has " + std::to_string(axes.sizes[a]) + " layers of labels; save them as one label per voxel";
      }
    }
    std::vector<std::size_t> kept;
    for (std::size_t a = 0; a < directions.size(); ++a) {
      if (directions[a]) kept.push_back(a);
    }
    if (kept.size() == 3) return axes.keep = {kept[0], kept[1], kept[2]}, "";
  }
  return find_three_axes(in_space, axes.keep) ? "" : "has more than three axes; save one volume alone";
}

/// "spacings", one per axis: those of axes that are none of space may be no numbers. Empty where one cannot be read.
std::vector<double> spacings_of(const std::string& text) {
  std::vector<double> out;
  for (std::size_t at = 0; (at = text.find_first_not_of(" \t", at)) != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_of(" \t", at), text.size());
    const std::string word = lower_case(text.substr(at, end - at));
    const std::vector<double> number = numbers_of(word);
    if (word != "nan" && number.size() != 1) return {};
    out.push_back(word == "nan" ? std::numeric_limits<double>::quiet_NaN() : number[0]);
    at = end;
  }
  return out;
}

/// What of where the voxels lie is there and cannot be read.
std::string find_place_problem(const NrrdFields& fields, const std::vector<std::optional<Vec3>>& directions,
                               const Axes& axes) {
  const auto unreadable = [](const std::string& what) {
    return "has '" + what + "' that cannot be read; mend that line of its header";
  };
  if (!field(fields, "space directions").empty() && directions.size() != axes.sizes.size())
    return unreadable("space directions");
  if (!field(fields, "space origin").empty() && numbers_of(field(fields, "space origin")).size() != 3)
    return unreadable("space origin");
  const std::string spacings = field(fields, "spacings");
  if (spacings.empty()) return {};
  const std::vector<double> steps = spacings_of(spacings);
  const bool is_sound =
      steps.size() == axes.sizes.size() && std::all_of(axes.keep.begin(), axes.keep.end(), [&](auto a) {
        return a >= steps.size() || (std::isfinite(steps[a]) && steps[a] != 0);
      });
  return is_sound ? std::string() : unreadable("spacings");
}

/// Lengths are taken for millimetres: a file that says that they are not is told of.
void note_units(const NrrdFields& fields, ImageHeader& header) {
  const std::string units = lower_case(field(fields, "space units"));
  std::string rest = units;
  for (std::size_t at; (at = rest.find("\"mm\"")) != std::string::npos;) rest.erase(at, 4);
  if (rest.find_first_not_of(" \t\"") != std::string::npos) {
    header.notes.push_back("says that its lengths are in " + units.substr(0, 40) + ": they are taken for millimetres");
  }
}

void place_by_directions(const NrrdFields& fields, const std::vector<std::optional<Vec3>>& directions, const Axes& axes,
                         ImageHeader& header) {
  const std::string space = field(fields, "space");
  const std::optional<Vec3> turn = turn_of(space);
  for (std::size_t a = 0; a < 3; ++a) header.layout.step[a] = *directions[axes.keep[a]];
  const std::vector<double> origin = numbers_of(field(fields, "space origin"));
  if (origin.size() == 3) header.layout.origin = Vec3(origin[0], origin[1], origin[2]);
  header.placed_by = "space directions, " + (space.empty() ? "no space named" : space);
  if (!turn) {
    header.notes.emplace_back("names no space of a patient: its axes are taken for right, front and head");
    return;
  }
  for (Vec3& step : header.layout.step) step = step.cwiseProduct(*turn);
  header.layout.origin = header.layout.origin.cwiseProduct(*turn);
}

void place(const NrrdFields& fields, const std::vector<std::optional<Vec3>>& directions, const Axes& axes,
           ImageHeader& header) {
  bool has_all = directions.size() == axes.sizes.size();
  for (std::size_t a = 0; a < 3 && has_all; ++a) {
    has_all = axes.keep[a] < directions.size() && directions[axes.keep[a]].has_value();
  }
  if (has_all) return place_by_directions(fields, directions, axes, header);
  const std::vector<double> spacings = spacings_of(field(fields, "spacings"));
  for (std::size_t a = 0; a < 3; ++a) {
    if (axes.keep[a] < spacings.size()) header.layout.step[a] *= spacings[axes.keep[a]];
  }
  header.placed_by = "spacing alone";
  header.notes.emplace_back("has no orientation: its axes are taken for right, front and head");
}

/// How the voxels are stored; says what is wrong.
std::string find_voxels(const NrrdFields& fields, ImageHeader& header) {
  const std::string encoding = lower_case(field(fields, "encoding"));
  header.is_deflated = encoding == "gzip" || encoding == "gz";
  if (!header.is_deflated && encoding != "raw") {
    return "has voxels of encoding '" + encoding + "'; save it raw or with gzip";
  }
  const std::string endian = lower_case(field(fields, "endian"));
  header.layout.is_big_endian = endian == "big";
  if (bytes_of(header.layout.type) > 1 && endian != "big" && endian != "little") {
    return "does not say its byte order; add a line 'endian: little' or 'endian: big'";
  }
  const std::vector<double> lines = numbers_of(field(fields, "line skip", "lineskip"));
  std::vector<double> skip = numbers_of(field(fields, "byte skip", "byteskip"));
  std::vector<std::uint64_t> sizes;
  if (!lines.empty() && to_sizes(lines, sizes)) header.line_skip = sizes[0];
  header.is_at_end = !skip.empty() && skip[0] == -1;
  if (header.is_at_end) skip.clear();
  if (!to_sizes(skip, sizes)) return "has a byte skip that is no number of bytes; mend it";
  if (!sizes.empty()) header.byte_skip = sizes[0];
  return {};
}

}  // namespace

bool is_nrrd(std::string_view bytes) {
  return bytes.substr(0, 7) == "NRRD000";
}

Result<ImageHeader> read_nrrd_header(std::string_view bytes, const std::string& name) {
  std::size_t end = 0;
  const NrrdFields fields = fields_of(bytes, end);
  ImageHeader header;
  header.format_name = "NRRD";
  header.layout.type = nrrd_type(field(fields, "type"));
  if (header.layout.type == VoxelType::kUnknown) {
    return Error{ErrorCode::kUnsupported, name + ": has voxels of type '" + field(fields, "type").substr(0, 40) +
                                              "', which are no labels; save it as unsigned short"};
  }
  header.data_file = field(fields, "data file", "datafile");
  if (header.data_file.empty()) header.offset = end;
  if (header.data_file.substr(0, 4) == "LIST" || header.data_file.find('%') != std::string::npos) {
    return Error{ErrorCode::kUnsupported, name + ": has its voxels in several files; save it as one"};
  }
  const std::vector<std::optional<Vec3>> directions = directions_of(field(fields, "space directions"));
  Axes axes;
  if (const std::string problem = find_axes(fields, directions, axes); !problem.empty()) return bad(name, problem);
  for (std::size_t a = 0; a < 3; ++a) {
    if (axes.keep[a] < axes.sizes.size()) header.layout.size[a] = axes.sizes[axes.keep[a]];
  }
  if (const std::string problem = find_voxels(fields, header); !problem.empty()) return bad(name, problem);
  if (const std::string problem = find_place_problem(fields, directions, axes); !problem.empty())
    return bad(name, problem);
  note_units(fields, header);
  place(fields, directions, axes, header);
  return header;
}

}  // namespace image
}  // namespace v0
}  // namespace incise
