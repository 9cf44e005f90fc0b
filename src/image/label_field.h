// SPDX-License-Identifier: Apache-2.0
// Smoothed indicators: how much of each label is around a point. The interface of two labels is where both are alike.
#pragma once

#include <array>
#include <cstddef>

#include "image/label_volume.h"

namespace incise {
inline namespace v0 {
namespace image {

/// One label at a point.
struct Share {
  LabelIndex label = 0;
  double value = 0;           ///< in [0, 1]; with the label's bias
  Vec3 slope = Vec3::Zero();  ///< 1/mm
};

/// The labels at a point, at most `kMost` (others, of the least, are passed over).
class Shares {
 public:
  static constexpr std::size_t kMost = 12;
  void clear() { n_ = 0; }
  [[nodiscard]] std::size_t size() const { return n_; }
  [[nodiscard]] const Share* begin() const { return share_.data(); }
  [[nodiscard]] const Share* end() const { return share_.data() + n_; }
  Share* begin() { return share_.data(); }
  Share* end() { return share_.data() + n_; }
  /// The share of a label, or null.
  [[nodiscard]] const Share* find(LabelIndex label) const;
  /// The same, made where it is missing; null where there is no room.
  Share* get(LabelIndex label);
  /// The label of the greatest value, the first of equal ones.
  [[nodiscard]] const Share& greatest() const;

 private:
  std::array<Share, kMost> share_;
  std::size_t n_ = 0;
};

/// The volume convolved with cubic B-splines along its axes: polynomials alone, so that bits agree everywhere.
class LabelField {
 public:
  /// `smooth`: the kernel's standard deviation in voxels, along each axis.
  LabelField(const LabelVolume& volume, double smooth)
      : volume_(volume), smooth_(smooth), bias_(volume.labels().size(), 0) {}

  /// Adds a constant to a label's value wherever it is: its interfaces move outwards.
  void set_bias(LabelIndex label, double bias) { bias_[label] = bias; }
  [[nodiscard]] double bias(LabelIndex label) const { return bias_[label]; }
  [[nodiscard]] const LabelVolume& volume() const { return volume_; }
  /// How fast the value of a label changes across a plane interface, 1/mm: along the axis of the smallest voxels.
  [[nodiscard]] double plane_slope(double width) const;

  /// How far the kernel of width 0 reaches along each axis, mm.
  [[nodiscard]] Vec3 reach() const;

  /// The shares at a point, mm. `width`: the kernel is at least so wide, mm (standard deviation); 0: as smooth as ever.
  /// Cost: about 0.5 µs.
  void sample(const Vec3& p, double width, Shares& out) const;

 private:
  const LabelVolume& volume_;
  double smooth_;
  std::vector<double> bias_;
};

}  // namespace image
}  // namespace v0
}  // namespace incise
