// SPDX-License-Identifier: Apache-2.0
// The kernel is a product of three splines, and voxels of one label that lie side by side along i are summed up before
// their label is looked for.
#include "image/label_field.h"

#include <algorithm>
#include <cmath>

namespace incise {
inline namespace v0 {
namespace image {
namespace {

/// The cubic B-spline has variance 1/3 and reaches from -2 to 2.
const double kDeviation = 1 / std::sqrt(3.0);
constexpr double kReach = 2;
/// Voxels per standard deviation that wide kernels look at; they skip the others.
constexpr double kPerDeviation = 1.2;
constexpr std::size_t kMostTaps = 20;

double spline(double x) {
  x = std::abs(x);
  if (x >= 2) return 0;
  if (x >= 1) return (2 - x) * (2 - x) * (2 - x) / 6;
  return 2.0 / 3 - x * x * (1 - x / 2);
}

double spline_slope(double x) {
  const double sign = x < 0 ? -1 : 1;
  x = std::abs(x);
  if (x >= 2) return 0;
  if (x >= 1) return -sign * (2 - x) * (2 - x) / 2;
  return sign * (1.5 * x * x - 2 * x);
}

/// The kernel along one axis: which voxels, and their weights.
struct Taps {
  std::int64_t first = 0, stride = 1;
  std::size_t n = 0;
  std::array<double, kMostTaps> weight{}, slope{};  ///< slope: 1/mm

  /// `x`: the point along the axis, in voxels; `deviation` likewise.
  Taps(double x, double deviation, double spacing) {
    stride = std::max<std::int64_t>(1, static_cast<std::int64_t>(deviation / kPerDeviation));
    const double stretch = deviation / kDeviation;
    first = static_cast<std::int64_t>(std::floor(x - kReach * stretch)) + 1;
    double sum = 0, slopes = 0;
    for (auto i = static_cast<double>(first); n < kMostTaps && i < x + kReach * stretch;
         i += static_cast<double>(stride)) {
      const double at = (x - i) / stretch;
      weight[n] = spline(at);
      slope[n] = spline_slope(at) / (stretch * spacing);
      sum += weight[n];
      slopes += slope[n];
      ++n;
    }
    for (std::size_t t = 0; t < n; ++t) {
      weight[t] /= sum;
      slope[t] = (slope[t] - weight[t] * slopes) / sum;
    }
  }
};

/// What a run of one label along i adds.
struct RunSum {
  LabelIndex label = 0;
  double weight = 0, slope = 0;
};

void add(const RunSum& run, const Taps& y, std::size_t t, const Taps& z, std::size_t u, Shares& out) {
  Share* share = out.get(run.label);
  if (share == nullptr) return;
  share->value += run.weight * y.weight[t] * z.weight[u];
  share->slope += Vec3(run.slope * y.weight[t] * z.weight[u], run.weight * y.slope[t] * z.weight[u],
                       run.weight * y.weight[t] * z.slope[u]);
}

}  // namespace

const Share* Shares::find(LabelIndex label) const {
  const Share* share = std::find_if(begin(), end(), [&](const Share& s) { return s.label == label; });
  return share == end() ? nullptr : share;
}

Share* Shares::get(LabelIndex label) {
  for (Share& share : *this) {
    if (share.label == label) return &share;
  }
  if (n_ == kMost) return nullptr;
  share_[n_] = Share{label, 0, Vec3::Zero()};
  return &share_[n_++];
}

const Share& Shares::greatest() const {
  return *std::max_element(begin(), end(), [](const Share& a, const Share& b) {
    return a.value != b.value ? a.value < b.value : a.label > b.label;
  });
}

double LabelField::plane_slope(double width) const {
  return (2.0 / 3) * kDeviation / std::max(smooth_ * volume_.spacing().minCoeff(), width);
}

Vec3 LabelField::reach() const {
  return kReach / kDeviation * smooth_ * volume_.spacing();
}

void LabelField::sample(const Vec3& p, double width, Shares& out) const {
  const Vec3& spacing = volume_.spacing();
  const auto taps = [&](Eigen::Index a) {
    return Taps(p[a] / spacing[a], std::max(smooth_, width / spacing[a]), spacing[a]);
  };
  const Taps x = taps(0), y = taps(1), z = taps(2);
  const auto& size = volume_.size();
  out.clear();
  for (std::size_t u = 0; u < z.n; ++u) {
    const std::int64_t k = z.first + static_cast<std::int64_t>(u) * z.stride;
    for (std::size_t t = 0; t < y.n; ++t) {
      const std::int64_t j = y.first + static_cast<std::int64_t>(t) * y.stride;
      const bool is_in = j >= 0 && k >= 0 && j < size[1] && k < size[2];
      const LabelIndex* row = is_in ? volume_.row(j, k) : nullptr;
      RunSum run;
      for (std::size_t s = 0; s < x.n; ++s) {
        const std::int64_t i = x.first + static_cast<std::int64_t>(s) * x.stride;
        const LabelIndex label = is_in && i >= 0 && i < size[0] ? row[i] : LabelIndex{0};
        if (s == 0 || label != run.label) {
          if (s > 0) add(run, y, t, z, u, out);
          run = {label, 0, 0};
        }
        run.weight += x.weight[s];
        run.slope += x.slope[s];
      }
      add(run, y, t, z, u, out);
    }
  }
  for (Share& share : out) share.value += bias_[share.label];
}

}  // namespace image
}  // namespace v0
}  // namespace incise
