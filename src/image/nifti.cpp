// SPDX-License-Identifier: Apache-2.0
// NIfTI-1 (348 bytes) and NIfTI-2 (540 bytes). Source: nifti1.h and nifti2.h of the NIfTI data format working group.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "image/image_header.h"

namespace incise {
inline namespace v0 {
namespace image {
namespace {

constexpr std::int32_t kSize1 = 348, kSize2 = 540;

/// Where the fields of a header stand: those of the same name in both versions.
struct Fields {
  std::size_t magic, dim, datatype, pixdim, vox_offset, slope, inter, units, qform_code, sform_code, quatern, qoffset,
      srow;
};
constexpr Fields kFields1 = {344, 40, 70, 76, 108, 112, 116, 123, 252, 254, 256, 268, 280};
constexpr Fields kFields2 = {4, 16, 12, 104, 168, 176, 184, 500, 344, 348, 352, 376, 400};

template <class T>
T load(std::string_view bytes, std::size_t at, bool is_swapped) {
  std::array<char, sizeof(T)> raw{};
  std::memcpy(raw.data(), bytes.data() + at, sizeof(T));
  if (is_swapped) std::reverse(raw.begin(), raw.end());
  T value;
  std::memcpy(&value, raw.data(), sizeof(T));
  return value;
}

/// The version of a header, 0 where it is none, and its byte order.
int version_of(std::string_view bytes, bool& is_big_endian) {
  for (const bool is_swapped : {false, true}) {
    is_big_endian = is_swapped;
    if (bytes.size() < static_cast<std::size_t>(kSize1)) return 0;
    const auto size = load<std::int32_t>(bytes, 0, is_swapped);
    const std::string_view magic1 = bytes.substr(kFields1.magic, 4), magic2 = bytes.substr(kFields2.magic, 4);
    if (size == kSize1 && (magic1.substr(0, 3) == "n+1" || magic1.substr(0, 3) == "ni1")) return 1;
    const bool is_second = magic2.substr(0, 3) == "n+2" || magic2.substr(0, 3) == "ni2";
    if (size == kSize2 && is_second && bytes.size() >= static_cast<std::size_t>(kSize2)) return 2;
  }
  return 0;
}

/// Reads the fields of either version as numbers of 64 bits.
class Reader {
 public:
  Reader(std::string_view bytes, int version, bool is_swapped)
      : bytes_(bytes), version_(version), is_swapped_(is_swapped), at_(version == 1 ? kFields1 : kFields2) {}

  [[nodiscard]] const Fields& at() const { return at_; }
  /// The i-th number from a field on: float in the first version, double in the second.
  [[nodiscard]] double real(std::size_t field, std::size_t i = 0) const {
    return version_ == 1 ? static_cast<double>(load<float>(bytes_, field + 4 * i, is_swapped_))
                         : load<double>(bytes_, field + 8 * i, is_swapped_);
  }
  [[nodiscard]] std::int64_t dim(std::size_t i) const {
    return version_ == 1 ? load<std::int16_t>(bytes_, at_.dim + 2 * i, is_swapped_)
                         : load<std::int64_t>(bytes_, at_.dim + 8 * i, is_swapped_);
  }
  [[nodiscard]] int code(std::size_t field) const {
    return version_ == 1 ? load<std::int16_t>(bytes_, field, is_swapped_)
                         : load<std::int32_t>(bytes_, field, is_swapped_);
  }
  [[nodiscard]] int datatype() const { return load<std::int16_t>(bytes_, at_.datatype, is_swapped_); }
  [[nodiscard]] double voxel_offset() const {
    return version_ == 1 ? static_cast<double>(load<float>(bytes_, at_.vox_offset, is_swapped_))
                         : static_cast<double>(load<std::int64_t>(bytes_, at_.vox_offset, is_swapped_));
  }
  /// Millimetres per unit of length.
  [[nodiscard]] double unit_mm() const {
    const int unit = (version_ == 1 ? static_cast<unsigned char>(bytes_[at_.units]) : code(at_.units)) & 7;
    return unit == 1 ? 1000.0 : (unit == 3 ? 0.001 : 1.0);
  }
  [[nodiscard]] bool is_detached() const { return bytes_[at_.magic + 1] == 'i'; }

 private:
  std::string_view bytes_;
  int version_;
  bool is_swapped_;
  const Fields& at_;
};

VoxelType type_of(int datatype) {
  switch (datatype) {
    case 2:
      return VoxelType::kUint8;
    case 256:
      return VoxelType::kInt8;
    case 512:
      return VoxelType::kUint16;
    case 4:
      return VoxelType::kInt16;
    case 768:
      return VoxelType::kUint32;
    case 8:
      return VoxelType::kInt32;
    case 1280:
      return VoxelType::kUint64;
    case 1024:
      return VoxelType::kInt64;
    case 16:
      return VoxelType::kFloat32;
    case 64:
      return VoxelType::kFloat64;
    default:
      return VoxelType::kUnknown;
  }
}

void place_by_sform(const Reader& in, ImageHeader& header) {
  for (std::size_t row = 0; row < 3; ++row) {
    const auto r = static_cast<Eigen::Index>(row);
    for (std::size_t a = 0; a < 3; ++a) header.layout.step[a][r] = in.real(in.at().srow, 4 * row + a);
    header.layout.origin[r] = in.real(in.at().srow, 4 * row + 3);
  }
  header.placed_by = "sform, RAS";
}

void place_by_qform(const Reader& in, ImageHeader& header) {
  const double b = in.real(in.at().quatern, 0), c = in.real(in.at().quatern, 1), d = in.real(in.at().quatern, 2);
  const double a = std::sqrt(std::max(0.0, 1 - (b * b + c * c + d * d)));
  const double left = in.real(in.at().pixdim, 0) < 0 ? -1.0 : 1.0;
  header.layout.step[0] = Vec3(a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c));
  header.layout.step[1] = Vec3(2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b));
  header.layout.step[2] = left * Vec3(2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - b * b - c * c);
  for (std::size_t i = 0; i < 3; ++i) {
    header.layout.step[i] *= in.real(in.at().pixdim, i + 1);
    header.layout.origin[static_cast<Eigen::Index>(i)] = in.real(in.at().qoffset, i);
  }
  header.placed_by = "qform, RAS";
}

void place(const Reader& in, ImageHeader& header) {
  if (in.code(in.at().sform_code) > 0) {
    place_by_sform(in, header);
  } else if (in.code(in.at().qform_code) > 0) {
    place_by_qform(in, header);
  } else {
    for (std::size_t a = 0; a < 3; ++a) header.layout.step[a] *= std::abs(in.real(in.at().pixdim, a + 1));
    header.placed_by = "spacing alone";
    header.notes.emplace_back("has no orientation: its axes are taken for right, front and head");
  }
  for (Vec3& step : header.layout.step) step *= in.unit_mm();
  header.layout.origin *= in.unit_mm();
}

/// Beside a.hdr, or a.hdr.gz, lies a.img.
std::string name_of_images(const std::string& header) {
  std::filesystem::path name = header;
  if (lower_case(name.extension().string()) == ".gz") name.replace_extension();
  return name.stem().string() + ".img";
}

}  // namespace

bool is_nifti(std::string_view bytes) {
  bool is_big_endian = false;
  return version_of(bytes, is_big_endian) != 0;
}

Result<ImageHeader> read_nifti_header(std::string_view bytes, const std::string& name) {
  ImageHeader header;
  const int version = version_of(bytes, header.layout.is_big_endian);
  const Reader in(bytes, version, header.layout.is_big_endian);
  header.format_name = "NIfTI-" + std::to_string(version);
  const std::int64_t axes = in.dim(0);
  if (axes < 1 || axes > 7) {
    return Error{ErrorCode::kBadFile, name + ": has " + std::to_string(axes) + " axes; is the header damaged?"};
  }
  for (std::int64_t a = 1; a <= axes; ++a) {
    const std::int64_t n = in.dim(static_cast<std::size_t>(a));
    if (a > 3 && n > 1) {
      return Error{ErrorCode::kUnsupported, name + ": has " + std::to_string(n) + " volumes (axis " +
                                                std::to_string(a) + "); save one of them alone"};
    }
    if (a <= 3) header.layout.size[static_cast<std::size_t>(a - 1)] = n < 0 ? 0 : static_cast<std::uint64_t>(n);
  }
  header.layout.type = type_of(in.datatype());
  if (header.layout.type == VoxelType::kUnknown) {
    return Error{ErrorCode::kUnsupported, name + ": has voxels of NIfTI type " + std::to_string(in.datatype()) +
                                              ", which are no labels; save it as 16-bit integers"};
  }
  if (const double slope = in.real(in.at().slope); slope != 0) {  // 0: not scaled
    header.layout.slope = slope;
    header.layout.intercept = in.real(in.at().inter);
  }
  const double offset = in.voxel_offset();
  if (!(offset >= 0 && offset <= 1e15)) {
    return Error{ErrorCode::kBadFile, name + ": its voxels begin at no place in the file; is the header damaged?"};
  }
  header.offset = static_cast<std::uint64_t>(offset);
  if (in.is_detached()) {
    header.data_file = name_of_images(name);
  } else {
    header.offset = std::max<std::uint64_t>(header.offset, static_cast<std::uint64_t>(version == 1 ? kSize1 : kSize2));
  }
  place(in, header);
  return header;
}

}  // namespace image
}  // namespace v0
}  // namespace incise
