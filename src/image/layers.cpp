// SPDX-License-Identifier: Apache-2.0
// Depth below the outer surface decides, and is asked block by block: within a block it differs from that of its
// middle by no more than the distance from there, so that most blocks need one question.
#include "incise/image/layers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <new>
#include <stdexcept>
#include <utility>

#include "image/label_field.h"
#include "image/lattice.h"
#include "image/outer_surface.h"
#include "incise/core/parallel.h"
#include "incise/geom/triangle_tree.h"

namespace incise {
inline namespace v0 {
namespace image {
namespace {

/// A layer of fewer voxels than this comes out ragged, or with holes.
constexpr double kLeastVoxels = 2;
constexpr std::size_t kBlockEdge = 8;
/// Depths are measured from a surface that is at least this smooth, voxels: the steps of a clean segmentation would
/// else move it by a tenth of a voxel to and fro, and the nearest bump tell the depth.
constexpr double kSmoothSurface = 1;
/// What finer voxels are smoothed by at most, so that points of tets much larger than they find the interfaces, and
/// layers of two voxels are not smoothed away.
constexpr double kSmoothFine = 1.4;

Error bad(const std::string& what) {
  return {ErrorCode::kBadArgument, what};
}

/// Of an image for which the options, good for others, are not.
Error bad_for_image(const std::string& what) {
  return {ErrorCode::kBadFile, what};
}

std::string in_mm(double length) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g mm", length);
  return text.data();
}

std::string in_times(double factor) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g times", factor);
  return text.data();
}

std::string described(const Layer& layer) {
  return "layer " + layer.name + " of " + in_mm(layer.thickness);
}

Status check_options(const LayerOptions& o) {
  if (o.layers.empty()) return bad("there is no layer; give one");
  if (!(o.size > 0) || !std::isfinite(o.size)) return bad("the size of tets must be above 0 mm; give a larger one");
  if (!(o.smooth >= 0.4 && o.smooth <= 10)) return bad("smoothing must lie in [0.4, 10] voxels; mend it");
  if (o.most_halvings < 0 || o.most_halvings > kMostHalvings) {
    return bad("the size may be halved 0 to " + std::to_string(kMostHalvings) + " times; mend it");
  }
  for (const Layer& layer : o.layers) {
    if (!(layer.thickness > 0) || !std::isfinite(layer.thickness)) {
      return bad("layer " + layer.name + ": its thickness must be above 0 mm; mend it");
    }
  }
  return o.threads >= 1 && o.threads <= 256 ? Status() : bad("1 to 256 threads may be used; mend it");
}

const Layer& thinnest(const LayerOptions& options) {
  return *std::min_element(options.layers.begin(), options.layers.end(),
                           [](const Layer& a, const Layer& b) { return a.thickness < b.thickness; });
}

/// How much finer the voxels must be along each axis for the thinnest layer.
std::array<std::size_t, 3> finer_by(const LabelImage& image, double thickness) {
  std::array<std::size_t, 3> finer{1, 1, 1};
  const Vec3 spacing = image.spacing();
  for (std::size_t a = 0; a < 3; ++a) {
    const double needed = kLeastVoxels * spacing[static_cast<Eigen::Index>(a)] / thickness;
    finer[a] = static_cast<std::size_t>(std::clamp(std::ceil(needed - 1e-6), 1.0, 1e6));
  }
  return finer;
}

/// Whether tets can follow the thinnest layer, and voxels hold it.
Status check_thickness(const LabelImage& image, const LayerOptions& options, const std::array<std::size_t, 3>& finer) {
  const Layer& layer = thinnest(options);
  double voxels = 1, voxel = image.spacing().maxCoeff();
  for (std::size_t a = 0; a < 3; ++a) {
    voxels *= static_cast<double>(finer[a]) * static_cast<double>(image.size[a]);
    voxel = std::min(voxel, image.spacing()[static_cast<Eigen::Index>(a)] / static_cast<double>(finer[a]));
  }
  const int halvings = count_halvings(voxel, options.size, options.most_halvings);
  const double finest = options.size / (1 << halvings);
  if (layer.thickness < kThinnestLayer * finest) {
    return bad(described(layer) + " is thinner than " + in_times(kThinnestLayer) + " the finest tets, " +
               in_mm(finest) + " (" + in_mm(options.size) + " halved " + std::to_string(halvings) +
               " times); give a size of " + in_mm(layer.thickness / kThinnestLayer * (1 << halvings)) +
               " at most, more halvings, or a thicker layer");
  }
  if (voxels <= kMostLayeredVoxels) return {};
  return bad(described(layer) + " is much thinner than the voxels, and would take " + std::to_string(voxels * 1e-6) +
             " million finer ones; give a thicker layer, or crop the image");
}

/// The image with finer voxels, of the labels that the smoothed indicators have there.
LabelImage refined(const LabelImage& image, const std::array<std::size_t, 3>& finer, double smooth, unsigned threads) {
  const LabelVolume volume(image);
  const LabelField field(volume, smooth);
  std::vector<std::uint16_t> index;  // in the image, of labels as the volume counts them
  for (const std::int32_t label : volume.labels()) index.push_back(static_cast<std::uint16_t>(image.find_label(label)));
  LabelImage out;
  out.labels = image.labels;
  out.origin = image.origin;
  Vec3 first, step;  // of the fine voxels, in coarse ones
  for (std::size_t a = 0; a < 3; ++a) {
    const auto c = static_cast<Eigen::Index>(a);
    step[c] = 1 / static_cast<double>(finer[a]);
    first[c] = 0.5 * step[c] - 0.5;
    out.size[a] = finer[a] * image.size[a];
    out.step[a] = step[c] * image.step[a];
    out.origin += first[c] * image.step[a];
  }
  out.voxels.resize(out.size[0] * out.size[1] * out.size[2]);
  const Vec3 reach = field.reach();
  parallel_blocks(out.voxels.size(), threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    Shares shares;
    for (std::size_t v = begin; v < end; ++v) {
      const Vec3 at(static_cast<double>(v % out.size[0]), static_cast<double>(v / out.size[0] % out.size[1]),
                    static_cast<double>(v / (out.size[0] * out.size[1])));
      const Vec3 p = (first + step.cwiseProduct(at)).cwiseProduct(volume.spacing());
      LabelIndex label = volume.uniform_label(p - reach, p + reach);
      if (label == kMixed) {
        field.sample(p, 0, shares);
        label = shares.greatest().label;
      }
      out.voxels[v] = index[label];
    }
  });
  return out;
}

/// Hands voxels to layers, block by block: a block whose depths lie in one layer goes as a whole.
class LayerGrower {
 public:
  LayerGrower(const OuterSurface& surface, const LayerOptions& options, LayeredImage& out)
      : tree_(surface.points, surface.triangles), image_(out.image), first_(image_.labels.size()) {
    for (const Layer& layer : options.layers) {
      depth_ += layer.thickness;
      ends_.push_back(depth_);
      out.labels.push_back(std::max(image_.labels.back(), 0) + 1);
      image_.labels.push_back(out.labels.back());
    }
    gives_.assign(image_.labels.size(), 0);
    for (std::size_t l = 0; l < first_; ++l) {
      const auto& within = options.within;
      const bool is_asked = std::find(within.begin(), within.end(), image_.labels[l]) != within.end();
      gives_[l] = image_.labels[l] != 0 && (within.empty() || is_asked) ? 1 : 0;
    }
  }

  void run(unsigned threads) {
    std::array<std::size_t, 3> blocks{};
    for (std::size_t a = 0; a < 3; ++a) blocks[a] = (image_.size[a] + kBlockEdge - 1) / kBlockEdge;
    const std::size_t n = blocks[0] * blocks[1] * blocks[2];
    parallel_blocks(n, threads, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b) {
        const std::array<std::size_t, 3> at = {b % blocks[0], b / blocks[0] % blocks[1], b / (blocks[0] * blocks[1])};
        Range range;
        for (std::size_t a = 0; a < 3; ++a) {
          range.low[a] = at[a] * kBlockEdge;
          range.high[a] = std::min(range.low[a] + kBlockEdge, image_.size[a]);
        }
        if (can_give(range)) fill(range);
      }
    });
  }

 private:
  struct Range {
    std::array<std::size_t, 3> low{}, high{};
  };

  [[nodiscard]] bool can_give(const Range& r) const {
    bool can = false;
    for_each_voxel(r, [&](std::size_t v) { can = can || gives_[image_.voxels[v]] != 0; });
    return can;
  }

  template <class Work>
  void for_each_voxel(const Range& r, const Work& work) const {
    for (std::size_t k = r.low[2]; k < r.high[2]; ++k) {
      for (std::size_t j = r.low[1]; j < r.high[1]; ++j) {
        for (std::size_t i = r.low[0]; i < r.high[0]; ++i) work(image_.index(i, j, k));
      }
    }
  }

  /// The layer at a depth; as many as there are: below all.
  [[nodiscard]] std::size_t layer_at(double depth) const {
    return static_cast<std::size_t>(std::upper_bound(ends_.begin(), ends_.end(), depth) - ends_.begin());
  }

  /// No voxel's depth differs from that of the middle by more than its distance from it.
  void fill(const Range& r) {
    Vec3 middle = image_.origin;
    std::array<Vec3, 3> half;
    for (std::size_t a = 0; a < 3; ++a) {
      middle += 0.5 * static_cast<double>(r.low[a] + r.high[a] - 1) * image_.step[a];
      half[a] = 0.5 * static_cast<double>(r.high[a] - r.low[a] - 1) * image_.step[a];
    }
    const double radius = std::max({(half[0] + half[1] + half[2]).norm(), (half[0] + half[1] - half[2]).norm(),
                                    (half[0] - half[1] + half[2]).norm(), (half[0] - half[1] - half[2]).norm()});
    const TriangleTree::Hit hit = tree_.closest(middle, depth_ + radius);
    if (!hit.is_valid()) return;
    const double depth = std::sqrt(hit.distance2);
    const std::size_t layer = layer_at(depth - radius);
    if (layer == layer_at(depth + radius)) return give(r, layer);
    std::size_t axis = 0;
    for (std::size_t a = 1; a < 3; ++a) {
      if (r.high[a] - r.low[a] > r.high[axis] - r.low[axis]) axis = a;
    }
    Range low = r, high = r;
    low.high[axis] = high.low[axis] = (r.low[axis] + r.high[axis]) / 2;
    fill(low);
    fill(high);
  }

  void give(const Range& r, std::size_t layer) {
    if (layer == ends_.size()) return;
    for_each_voxel(r, [&](std::size_t v) {
      if (gives_[image_.voxels[v]] != 0) image_.voxels[v] = static_cast<std::uint16_t>(first_ + layer);
    });
  }

  TriangleTree tree_;
  LabelImage& image_;
  std::size_t first_;         // the first layer, in the image's labels
  double depth_ = 0;          // of all layers
  std::vector<double> ends_;  // depth where each layer ends
  std::vector<char> gives_;   // of the image's labels
};

/// Counts what came out, and drops labels that are no more.
Status count_layers(const LayerOptions& options, const std::vector<std::uint64_t>& before, LayeredImage& out) {
  const std::vector<std::uint64_t> counts = out.image.count_voxels();
  for (std::size_t l = 0; l < before.size(); ++l) {
    if (before[l] > 0 && counts[l] == 0) out.swallowed.push_back(out.image.labels[l]);
  }
  for (std::size_t l = 0; l < out.labels.size(); ++l) {
    out.voxels.push_back(counts[out.image.find_label(out.labels[l])]);
    if (out.voxels.back() > 0) continue;
    const bool has_surface = counts.size() > 1 && out.cut_off == 0;
    return bad_for_image(
        described(options.layers[l]) +
        (has_surface || l > 0 ? " lies deeper than the body is thick anywhere" : " has no surface to grow from") +
        "; leave it out, or name the labels that it may grow in");
  }
  return {};
}

Result<LayeredImage> grow(const LabelImage& image, const LayerOptions& options) {
  LayeredImage out;
  out.finer = finer_by(image, thinnest(options).thickness);
  if (const Status status = check_thickness(image, options, out.finer); !status.ok()) return status.error();
  const OuterSurface surface = find_outer_surface(image, std::max(options.smooth, kSmoothSurface), options.threads);
  out.cut_off = surface.cut_off;
  const bool is_fine_enough = out.finer == std::array<std::size_t, 3>{1, 1, 1};
  out.image = is_fine_enough ? image : refined(image, out.finer, options.smooth, options.threads);
  const std::vector<std::uint64_t> before = out.image.count_voxels();
  const double finer = static_cast<double>(*std::min_element(out.finer.begin(), out.finer.end()));
  out.smooth = std::min(options.smooth * finer, std::max(options.smooth, kSmoothFine));
  LayerGrower(surface, options, out).run(options.threads);
  if (const Status status = count_layers(options, before, out); !status.ok()) return status.error();
  return out;
}

}  // namespace

Result<LayeredImage> grow_layers(const LabelImage& image, const LayerOptions& options) {
  if (const Status status = check_options(options); !status.ok()) return status.error();
  const bool has_numbers = image.labels.size() + options.layers.size() <= kMostLabels &&
                           (image.labels.empty() || image.labels.back() < 0x7FFFFFFF - 4096);
  if (!has_numbers) return bad_for_image("there are no numbers left for further labels; merge some");
#if defined(__cpp_exceptions)
  try {
    return grow(image, options);
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {
  }
  return Error{ErrorCode::kOutOfMemory, "there is not enough memory for so fine voxels; give thicker layers"};
#else
  return grow(image, options);
#endif
}

}  // namespace image
}  // namespace v0
}  // namespace incise
