// SPDX-License-Identifier: Apache-2.0
// Background that is connected with the image's border lies around the body; a surface net over the smoothed body goes
// slice by slice, so that two slices of values suffice.
#include "image/outer_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "image/label_field.h"
#include "incise/core/parallel.h"

namespace incise {
inline namespace v0 {
namespace image {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
/// Half the width of the smoothing kernel, in its standard deviations.
constexpr double kKernelReach = 3.4642;

/// Which voxels lie around the body: those of the background that are connected with the border of the image.
class Outside {
 public:
  explicit Outside(const LabelImage& image) : image_(image), is_out_(image.voxels.size(), 0) {
    background_ = static_cast<std::uint16_t>(image.find_label(0));
    if (background_ == image.labels.size()) return;
    const auto& n = image.size;
    for (std::size_t v = 0; v < image.voxels.size(); ++v) {
      if (is_border(v % n[0], v / n[0] % n[1], v / (n[0] * n[1]))) reach(v);
    }
    while (!front_.empty()) {
      const std::size_t v = front_.back();
      front_.pop_back();
      spread(v);
    }
  }

  [[nodiscard]] bool is_out(std::size_t voxel) const { return is_out_[voxel] != 0; }
  [[nodiscard]] bool is_border(std::size_t i, std::size_t j, std::size_t k) const {
    const auto& n = image_.size;
    return i == 0 || j == 0 || k == 0 || i + 1 == n[0] || j + 1 == n[1] || k + 1 == n[2];
  }
  [[nodiscard]] std::uint64_t count_cut_off() const {
    const auto& n = image_.size;
    std::uint64_t count = 0;
    for (std::size_t v = 0; v < is_out_.size(); ++v) {
      const bool is_cut = is_out_[v] == 0 && is_border(v % n[0], v / n[0] % n[1], v / (n[0] * n[1]));
      count += is_cut ? 1U : 0U;
    }
    return count;
  }

 private:
  void reach(std::size_t voxel) {
    if (is_out_[voxel] != 0 || image_.voxels[voxel] != background_) return;
    is_out_[voxel] = 1;
    front_.push_back(voxel);
  }

  void spread(std::size_t v) {
    const auto& n = image_.size;
    const std::size_t plane = n[0] * n[1], i = v % n[0], j = v / n[0] % n[1], k = v / plane;
    if (i > 0) reach(v - 1);
    if (i + 1 < n[0]) reach(v + 1);
    if (j > 0) reach(v - n[0]);
    if (j + 1 < n[1]) reach(v + n[0]);
    if (k > 0) reach(v - plane);
    if (k + 1 < n[2]) reach(v + plane);
  }

  const LabelImage& image_;
  std::uint16_t background_ = 0;
  std::vector<char> is_out_;
  std::vector<std::size_t> front_;
};

/// The body as one label, with its border voxels repeated outwards so that its surface does not close there.
LabelImage padded_body(const LabelImage& image, const Outside& outside, std::size_t pad) {
  LabelImage body;
  body.labels = {0, 1};
  body.step = image.step;
  for (std::size_t a = 0; a < 3; ++a) body.size[a] = image.size[a] + 2 * pad;
  body.voxels.reserve(body.size[0] * body.size[1] * body.size[2]);
  const auto inner = [&](std::size_t at, std::size_t a) {
    return std::min(at > pad ? at - pad : 0, image.size[a] - 1);
  };
  for (std::size_t k = 0; k < body.size[2]; ++k) {
    for (std::size_t j = 0; j < body.size[1]; ++j) {
      for (std::size_t i = 0; i < body.size[0]; ++i) {
        const bool is_out = outside.is_out(image.index(inner(i, 0), inner(j, 1), inner(k, 2)));
        body.voxels.push_back(is_out ? 0 : 1);
      }
    }
  }
  return body;
}

/// A point in each cell of eight voxel centres that the surface passes, and two triangles for each edge that it
/// crosses. Nodes are voxel centres, from one before the image to one behind; a slice of cells lies between two of
/// nodes.
class SurfaceNet {
 public:
  SurfaceNet(const LabelImage& image, const LabelField& field, std::size_t pad, unsigned threads)
      : image_(image),
        field_(field),
        pad_(pad),
        threads_(threads),
        n_{image.size[0] + 2, image.size[1] + 2},
        reach_(field.reach()) {}

  OuterSurface run() {
    low_ = values(0);
    for (std::size_t k = 0; k + 1 < image_.size[2] + 2; ++k) {
      high_ = values(k + 1);
      place_points(k);
      emit_upright();
      if (k > 0) emit_flat();
      below_ = std::move(cells_);
      low_ = std::move(high_);
    }
    return std::move(out_);
  }

 private:
  [[nodiscard]] std::size_t node(std::size_t i, std::size_t j) const { return j * n_[0] + i; }

  /// Share of the body less a half, at the nodes of a slice.
  [[nodiscard]] std::vector<double> values(std::size_t k) const {
    std::vector<double> values(n_[0] * n_[1]);
    parallel_blocks(values.size(), threads_, [&](std::size_t, std::size_t begin, std::size_t end) {
      Shares shares;
      for (std::size_t v = begin; v < end; ++v) values[v] = value(v % n_[0], v / n_[0], k, shares);
    });
    return values;
  }

  double value(std::size_t i, std::size_t j, std::size_t k, Shares& shares) const {
    const double shift = static_cast<double>(pad_) - 1;
    const Vec3 at(static_cast<double>(i) + shift, static_cast<double>(j) + shift, static_cast<double>(k) + shift);
    const Vec3 p = at.cwiseProduct(field_.volume().spacing());
    if (const LabelIndex only = field_.volume().uniform_label(p - reach_, p + reach_); only != kMixed) {
      return only == 0 ? -0.5 : 0.5;
    }
    field_.sample(p, 0, shares);
    const Share* body = shares.find(1);
    return (body != nullptr ? body->value : 0) - 0.5;
  }

  /// The value at a corner of the cell: bits of `corner` are steps along i, j, k.
  [[nodiscard]] double at_corner(std::size_t i, std::size_t j, unsigned corner) const {
    const std::vector<double>& slice = (corner & 4U) != 0 ? high_ : low_;
    return slice[node(i + (corner & 1U), j + (corner >> 1U & 1U))];
  }

  void place_points(std::size_t k) {
    cells_.assign(n_[0] * n_[1], kNone);
    for (std::size_t j = 0; j + 1 < n_[1]; ++j) {
      for (std::size_t i = 0; i + 1 < n_[0]; ++i) place_point(i, j, k);
    }
  }

  /// The mean of where the surface crosses the twelve edges of a cell.
  void place_point(std::size_t i, std::size_t j, std::size_t k) {
    std::array<double, 8> value{};
    for (unsigned c = 0; c < 8; ++c) value[c] = at_corner(i, j, c);
    Vec3 sum = Vec3::Zero();
    double crossings = 0;
    for (unsigned c = 0; c < 8; ++c) {
      for (unsigned axis = 1; axis < 8; axis *= 2) {
        const unsigned other = c | axis;
        if (other == c || (value[c] < 0) == (value[other] < 0)) continue;
        const double share = value[c] / (value[c] - value[other]);
        const Vec3 from(c & 1U, c >> 1U & 1U, c >> 2U), to(other & 1U, other >> 1U & 1U, other >> 2U);
        sum += from + share * (to - from);
        crossings += 1;
      }
    }
    if (crossings == 0) return;
    cells_[node(i, j)] = static_cast<std::uint32_t>(out_.points.size());
    const Vec3 at =
        sum / crossings + Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)) - Vec3::Ones();
    out_.points.push_back(image_.origin + at.x() * image_.step[0] + at.y() * image_.step[1] + at.z() * image_.step[2]);
  }

  /// Triangles for edges along k: around them lie four cells of this slice.
  void emit_upright() {
    for (std::size_t j = 1; j + 1 < n_[1]; ++j) {
      for (std::size_t i = 1; i + 1 < n_[0]; ++i) {
        if ((low_[node(i, j)] < 0) == (high_[node(i, j)] < 0)) continue;
        add(cells_[node(i - 1, j - 1)], cells_[node(i, j - 1)], cells_[node(i, j)], cells_[node(i - 1, j)]);
      }
    }
  }

  /// Triangles for edges in the lower slice of nodes: two of the cells lie below it.
  void emit_flat() {
    for (std::size_t j = 1; j + 1 < n_[1]; ++j) {
      for (std::size_t i = 1; i + 1 < n_[0]; ++i) {
        const bool is_out = low_[node(i, j)] < 0;
        if (i + 2 < n_[0] && is_out != (low_[node(i + 1, j)] < 0)) {
          add(below_[node(i, j - 1)], below_[node(i, j)], cells_[node(i, j)], cells_[node(i, j - 1)]);
        }
        if (j + 2 < n_[1] && is_out != (low_[node(i, j + 1)] < 0)) {
          add(below_[node(i - 1, j)], below_[node(i, j)], cells_[node(i, j)], cells_[node(i - 1, j)]);
        }
      }
    }
  }

  /// The four cells in order around an edge. Those at the rim of the image may have no point on one side.
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    if (a == kNone || b == kNone || c == kNone || d == kNone) return;
    out_.triangles.push_back({a, b, c});
    out_.triangles.push_back({a, c, d});
  }

  const LabelImage& image_;
  const LabelField& field_;
  std::size_t pad_;
  unsigned threads_;
  OuterSurface out_;
  std::array<std::size_t, 2> n_;  // nodes along i and j
  Vec3 reach_;                    // of the kernel, mm
  std::vector<double> low_, high_;
  std::vector<std::uint32_t> cells_, below_;  // points of cells, at their least node
};

}  // namespace

OuterSurface find_outer_surface(const LabelImage& image, double smooth, unsigned threads) {
  const Outside outside(image);
  const auto pad = static_cast<std::size_t>(smooth * kKernelReach) + 3;
  const LabelVolume volume(padded_body(image, outside, pad));
  const LabelField field(volume, smooth);
  OuterSurface out = SurfaceNet(image, field, pad, threads).run();
  out.cut_off = outside.count_cut_off();
  return out;
}

}  // namespace image
}  // namespace v0
}  // namespace incise
