// SPDX-License-Identifier: Apache-2.0
// One decoder for all types and byte orders: values get numbers as they come, and labels their places in rising order
// at the end.
#include "image/raw_voxels.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <unordered_map>

namespace incise {
inline namespace v0 {
namespace image {
namespace {

/// Bytes that are decoded at once: whole voxels of every type.
constexpr std::uint64_t kDecodedAtOnce = std::uint64_t{1} << 20U;
/// Steps that are so near a plane, relative to their lengths, span no volume.
constexpr double kFlatSteps = 1e-6;
/// Lengths of steps, mm: what lies outside is damage, not anatomy.
constexpr double kLeastStep = 1e-9, kGreatestStep = 1e9;

template <class T>
T swapped(T value) {
  std::array<char, sizeof(T)> bytes{};
  std::memcpy(bytes.data(), &value, sizeof(T));
  std::reverse(bytes.begin(), bytes.end());
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

/// A voxel's value as a label, or nothing where it is none.
template <class T>
std::optional<std::int32_t> to_label(T value, double slope, double intercept) {
  const double x = slope * static_cast<double>(value) + intercept;
  constexpr double kLeast = std::numeric_limits<std::int32_t>::min(), kMost = std::numeric_limits<std::int32_t>::max();
  if (!(x >= kLeast && x <= kMost) || std::floor(x) != x) return std::nullopt;
  return static_cast<std::int32_t>(x);
}

/// Gives numbers to values as they come; afterwards to labels in rising order.
template <class T>
class LabelTable {
 public:
  LabelTable(double slope, double intercept) : slope_(slope), intercept_(intercept) {}

  /// The number of a value; `kMostLabels` where it is no label, or there are too many.
  std::size_t number_of(T value) {
    if (has_last_ && value == last_) return last_number_;
    const auto found = numbers_.find(value);
    const std::size_t number = found != numbers_.end() ? found->second : add(value);
    has_last_ = true;
    last_ = value;
    return last_number_ = number;
  }
  [[nodiscard]] const std::vector<std::int32_t>& labels() const { return labels_; }

 private:
  std::size_t add(T value) {
    const std::optional<std::int32_t> label = to_label(value, slope_, intercept_);
    if (!label) return kMostLabels;
    const auto known = std::find(labels_.begin(), labels_.end(), *label);  // of -0.0 and 0.0, or scaled to the same
    const auto number = static_cast<std::size_t>(known - labels_.begin());
    if (number >= kMostLabels) return kMostLabels;
    if (known == labels_.end()) labels_.push_back(*label);
    numbers_.emplace(value, number);
    return number;
  }

  double slope_, intercept_;
  std::unordered_map<T, std::size_t> numbers_;
  std::vector<std::int32_t> labels_;
  T last_{};
  std::size_t last_number_ = 0;
  bool has_last_ = false;
};

/// Puts labels into rising order.
void sort_labels(LabelImage& image, const std::vector<std::int32_t>& labels) {
  image.labels = labels;
  std::sort(image.labels.begin(), image.labels.end());
  std::vector<std::uint16_t> rank;
  rank.reserve(labels.size());
  for (const std::int32_t label : labels) rank.push_back(static_cast<std::uint16_t>(image.find_label(label)));
  for (std::uint16_t& voxel : image.voxels) voxel = rank[voxel];
}

template <class T>
Error no_label(T value, std::size_t labels, const std::string& name) {
  const std::string remedy = "; this looks like a scan, give the segmentation of it (a label per voxel)";
  if (labels >= kMostLabels) {
    return {ErrorCode::kUnsupported, name + ": has more than " + std::to_string(kMostLabels) + " values" + remedy};
  }
  return {ErrorCode::kUnsupported,
          name + ": has the value " + std::to_string(value) + ", which is no whole number of 32 bits" + remedy};
}

/// Appends the voxels of one piece; false where one has no label, which `value` is then.
template <class T>
bool append_voxels(const VoxelLayout& layout, std::string_view bytes, LabelTable<T>& table, LabelImage& image,
                   T& value) {
  const std::size_t first = image.voxels.size(), n = bytes.size() / sizeof(T);
  image.voxels.resize(first + n);
  for (std::size_t v = 0; v < n; ++v) {
    std::memcpy(&value, bytes.data() + v * sizeof(T), sizeof(T));
    if (layout.is_big_endian) value = swapped(value);
    const std::size_t number = table.number_of(value);
    if (number >= kMostLabels) return false;
    image.voxels[first + v] = static_cast<std::uint16_t>(number);
  }
  return true;
}

template <class T>
Result<LabelImage> decode_as(const VoxelLayout& layout, VoxelBytes& bytes, const std::string& name) {
  LabelImage image;
  const std::uint64_t wanted = bytes_of(layout);
  image.voxels.reserve(static_cast<std::size_t>(std::min(wanted, bytes.most()) / sizeof(T)));
  LabelTable<T> table(layout.slope, layout.intercept);
  for (std::uint64_t left = wanted; left > 0;) {
    const auto size = static_cast<std::size_t>(std::min(left, kDecodedAtOnce));
    const Result<std::string_view> piece = bytes.next(size);
    if (!piece) return piece.error();
    if (piece->size() < size) return too_few(name, wanted - left + piece->size(), wanted);
    T value{};
    if (!append_voxels(layout, *piece, table, image, value)) return no_label(value, table.labels().size(), name);
    left -= size;
  }
  sort_labels(image, table.labels());
  return image;
}

Result<LabelImage> decode_any(const VoxelLayout& layout, VoxelBytes& bytes, const std::string& name) {
  switch (layout.type) {
    case VoxelType::kUint8:
      return decode_as<std::uint8_t>(layout, bytes, name);
    case VoxelType::kInt8:
      return decode_as<std::int8_t>(layout, bytes, name);
    case VoxelType::kUint16:
      return decode_as<std::uint16_t>(layout, bytes, name);
    case VoxelType::kInt16:
      return decode_as<std::int16_t>(layout, bytes, name);
    case VoxelType::kUint32:
      return decode_as<std::uint32_t>(layout, bytes, name);
    case VoxelType::kInt32:
      return decode_as<std::int32_t>(layout, bytes, name);
    case VoxelType::kUint64:
      return decode_as<std::uint64_t>(layout, bytes, name);
    case VoxelType::kInt64:
      return decode_as<std::int64_t>(layout, bytes, name);
    case VoxelType::kFloat32:
      return decode_as<float>(layout, bytes, name);
    case VoxelType::kFloat64:
      return decode_as<double>(layout, bytes, name);
    case VoxelType::kUnknown:
      break;
  }
  return Error{ErrorCode::kInternal, name + ": the type of the voxels was not found; report this"};
}

}  // namespace

std::size_t bytes_of(VoxelType type) {
  constexpr std::array<std::size_t, 11> kBytes = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8, 0};
  return kBytes[static_cast<std::size_t>(type)];
}

std::string name_of(VoxelType type) {
  const bool is_float = type == VoxelType::kFloat32 || type == VoxelType::kFloat64;
  return std::to_string(8 * bytes_of(type)) + (is_float ? "-bit floating point" : "-bit integers");
}

void turn_to_ras(VoxelLayout& layout) {
  const Vec3 turn(-1, -1, 1);
  for (Vec3& step : layout.step) step = step.cwiseProduct(turn);
  layout.origin = layout.origin.cwiseProduct(turn);
}

std::string problem_of(const VoxelLayout& layout) {
  std::uint64_t voxels = 1;
  for (const std::uint64_t n : layout.size) {
    if (n == 0 || n > kMostAlongAxis) return "has an axis of " + std::to_string(n) + " voxels; is the header damaged?";
    voxels *= n;
  }
  if (voxels > kMostVoxels) return "promises " + std::to_string(voxels) + " voxels; is the header damaged?";
  if (!std::isfinite(layout.slope) || !std::isfinite(layout.intercept)) {
    return "has a scaling that is not finite; write it anew";
  }
  double product = 1;
  for (const Vec3& step : layout.step) {
    const double length = step.norm();
    if (!(length >= kLeastStep && length <= kGreatestStep)) {
      return "has voxels of " + std::to_string(length) + " mm; mend the spacing";
    }
    product *= length;
  }
  const double volume = std::abs(layout.step[0].cross(layout.step[1]).dot(layout.step[2]));
  if (!(volume > kFlatSteps * product)) return "has axes that lie in one plane; mend the orientation";
  return layout.origin.allFinite() ? "" : "has an origin that is not finite; mend it";
}

std::uint64_t bytes_of(const VoxelLayout& layout) {
  return layout.size[0] * layout.size[1] * layout.size[2] * bytes_of(layout.type);
}

Error too_few(const std::string& name, std::uint64_t there, std::uint64_t wanted) {
  return {ErrorCode::kBadFile, name + ": has " + std::to_string(there) + " bytes of voxels, but its header promises " +
                                   std::to_string(wanted) + "; is it cut off?"};
}

Result<LabelImage> decode(const VoxelLayout& layout, VoxelBytes& bytes, const std::string& name) {
  Result<LabelImage> image = decode_any(layout, bytes, name);
  if (!image) return image;
  for (std::size_t a = 0; a < 3; ++a) image->size[a] = static_cast<std::size_t>(layout.size[a]);
  image->step = layout.step;
  image->origin = layout.origin;
  return image;
}

}  // namespace image
}  // namespace v0
}  // namespace incise
