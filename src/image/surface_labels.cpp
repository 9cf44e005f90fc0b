// SPDX-License-Identifier: Apache-2.0
#include "incise/image/surface_labels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <utility>

#include "image/mend_surface.h"
#include "image/winding_number.h"
#include "incise/core/parallel.h"
#include "incise/geom/box.h"
#include "incise/io/surface_file.h"

namespace incise {
inline namespace v0 {
namespace image {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Voxels left free around the surface.
constexpr double kMargin = 1.5;
/// A part lies wholly in another where that has this share of its voxels.
constexpr double kWholly = 0.999;

/// Triangles that shared points join, or all those with holes together.
struct Part {
  std::vector<Triangle> triangles;
  double volume = 0;  ///< enclosed
  bool is_open = false;
};

double volume_of(const io::SurfaceSoup& surface, const std::vector<Triangle>& triangles, const Vec3& middle) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    const Vec3 a = surface.points[t[0]] - middle, b = surface.points[t[1]] - middle, c = surface.points[t[2]] - middle;
    sum += a.dot(b.cross(c)) / 6;
  }
  return std::abs(sum);
}

/// Edges that an odd number of triangles have.
std::size_t count_open_edges(const std::vector<Triangle>& triangles) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) edges.emplace_back(std::minmax(t[i], t[(i + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  std::size_t open = 0;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i;
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    open += (end - i) % 2;
    i = end;
  }
  return open;
}

std::vector<Part> find_parts(const io::SurfaceSoup& surface) {
  std::vector<std::uint32_t> parent(surface.points.size());
  for (std::uint32_t p = 0; p < parent.size(); ++p) parent[p] = p;
  const auto root = [&](std::uint32_t p) {
    while (parent[p] != p) p = parent[p] = parent[parent[p]];
    return p;
  };
  for (const Triangle& t : surface.triangles) {
    for (std::size_t i = 1; i < 3; ++i) {
      const std::uint32_t a = root(t[0]), b = root(t[i]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<std::uint32_t> number(parent.size(), std::numeric_limits<std::uint32_t>::max());
  std::vector<Part> parts;
  for (const Triangle& t : surface.triangles) {
    std::uint32_t& n = number[root(t[0])];
    if (n == std::numeric_limits<std::uint32_t>::max()) {
      n = static_cast<std::uint32_t>(parts.size());
      parts.emplace_back();
    }
    parts[n].triangles.push_back(t);
  }
  return parts;
}

class SurfaceSampler {
 public:
  SurfaceSampler(io::SurfaceSoup surface, double voxel, unsigned threads)
      : surface_(std::move(surface)), voxel_(voxel), threads_(threads) {
    io::weld(surface_);
    mend();
    for (const Vec3& p : surface_.points) box_.extend(p);
  }

  Result<SurfaceLabels> run() {
    if (!(voxel_ > 0) || !std::isfinite(voxel_)) return bad("voxels must be larger than 0; give a larger size");
    if (surface_.triangles.empty()) return empty();
    if (!lay_voxels())
      return bad("the size is too small for the surface: it would take too many voxels; give a larger one");
    order_parts();
    if (parts_.empty()) return empty();
    sample();
    out_.parts = parts_.size();
    if (out_.image.labels.size() < 2) return empty();
    return std::move(out_);
  }

 private:
  /// A triangle that is there twice would count twice, or not at all where the second one faces the other way.
  void mend() {
    if (const std::size_t repeated = drop_repeated(surface_.triangles); repeated > 0) {
      out_.notes.push_back(std::to_string(repeated) + " triangles are there more than once: the first of each counts");
    }
    if (const std::size_t turned = turn_alike(surface_.triangles); turned > 0) {
      out_.notes.push_back(std::to_string(turned) +
                           " triangles faced other ways than those beside them, and are turned");
    }
  }

  static Error bad(const std::string& what) { return {ErrorCode::kBadArgument, what}; }
  [[nodiscard]] Error empty() const {
    const double extent = surface_.points.empty() ? 0 : (box_.hi - box_.lo).maxCoeff();
    return {ErrorCode::kBadFile, "the surface, " + std::to_string(extent) +
                                     " long, encloses nothing of this size; close its holes, turn its triangles alike, "
                                     "or give a smaller size"};
  }

  bool lay_voxels() {
    const Vec3 extent = box_.hi - box_.lo;
    double voxels = 1;
    for (std::size_t a = 0; a < 3; ++a) {
      const double n = std::floor(extent[static_cast<Eigen::Index>(a)] / voxel_ + 2 * kMargin) + 1;
      voxels *= n;
      if (!(voxels <= kMostSurfaceVoxels)) return false;
      out_.image.size[a] = static_cast<std::size_t>(n);
      out_.image.step[a] *= voxel_;
    }
    out_.image.origin = box_.lo - Vec3::Constant(kMargin * voxel_);
    return true;
  }

  /// Closed parts one by one and open ones as one, the largest first, without those smaller than a voxel.
  void order_parts() {
    const Vec3 middle = 0.5 * (box_.lo + box_.hi);
    Part open;
    open.is_open = true;
    std::size_t left_out = 0;
    for (Part& part : find_parts(surface_)) {
      const std::size_t edges = count_open_edges(part.triangles);
      out_.open_edges += edges;
      if (edges > 0) {
        open.triangles.insert(open.triangles.end(), part.triangles.begin(), part.triangles.end());
        continue;
      }
      part.volume = volume_of(surface_, part.triangles, middle);
      if (part.volume < voxel_ * voxel_ * voxel_) {
        ++left_out;
      } else {
        parts_.push_back(std::move(part));
      }
    }
    if (!open.triangles.empty()) {
      open.volume = volume_of(surface_, open.triangles, middle);
      parts_.push_back(std::move(open));
      out_.notes.push_back("has " + std::to_string(out_.open_edges) +
                           " edges without a second triangle: holes are bridged");
    }
    if (left_out > 0) out_.notes.push_back(std::to_string(left_out) + " parts smaller than a voxel are left out");
    std::stable_sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) { return a.volume > b.volume; });
    if (parts_.size() >= kMostLabels) {
      out_.notes.push_back("has more than " + std::to_string(kMostLabels - 1) + " parts: the smallest are left out");
      parts_.resize(kMostLabels - 1);
    }
  }

  void sample() {
    LabelImage& image = out_.image;
    image.voxels.assign(image.size[0] * image.size[1] * image.size[2], 0);
    image.labels = {0};
    out_.volumes = {0};
    for (std::size_t n = 0; n < parts_.size(); ++n) {
      image.labels.push_back(static_cast<std::int32_t>(n + 1));
      out_.volumes.push_back(parts_[n].is_open ? 0 : parts_[n].volume);
      sample_part(parts_[n], static_cast<std::uint16_t>(n + 1));
      take_from_those_around(parts_[n].volume, static_cast<std::uint16_t>(n + 1));
    }
  }

  /// A part that lies wholly in another takes its volume from it; where parts overlap volumes are not known.
  void take_from_those_around(double volume, std::uint16_t label) {
    std::vector<std::uint64_t> taken(label, 0);
    std::uint64_t all = 0;
    for (std::size_t v = 0; v < before_.size(); ++v) {
      if (out_.image.voxels[v] != label) continue;
      ++taken[before_[v]];
      ++all;
    }
    const auto most = std::max_element(taken.begin(), taken.end());
    if (static_cast<double>(*most) >= kWholly * static_cast<double>(all)) {
      double& around = out_.volumes[static_cast<std::size_t>(most - taken.begin())];
      if (most != taken.begin()) around = std::max(0.0, around - volume);
      return;
    }
    for (std::size_t l = 0; l < taken.size(); ++l) {
      if (taken[l] > 0) out_.volumes[l] = 0;
    }
  }

  /// Smaller parts come later, and overwrite those around them.
  void sample_part(const Part& part, std::uint16_t label) {
    LabelImage& image = out_.image;
    before_ = image.voxels;
    const WindingNumber winding(surface_.points, part.triangles);
    Box box;
    for (const Triangle& t : part.triangles) {
      for (const std::uint32_t p : t) box.extend(surface_.points[p]);
    }
    parallel_blocks(image.voxels.size(), threads_, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const std::size_t i = v % image.size[0], j = v / image.size[0] % image.size[1],
                          k = v / image.size[0] / image.size[1];
        const Vec3 p =
            image.origin + voxel_ * Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        if (box.distance2(p) == 0 && std::abs(winding(p)) > 0.5) image.voxels[v] = label;
      }
    });
  }

  io::SurfaceSoup surface_;
  double voxel_;
  unsigned threads_;
  Box box_;
  std::vector<Part> parts_;
  std::vector<std::uint16_t> before_;  // the voxels before the last part
  SurfaceLabels out_;
};

}  // namespace

Result<SurfaceLabels> label_surface(io::SurfaceSoup surface, double voxel, unsigned threads) {
#if defined(__cpp_exceptions)
  try {
    return SurfaceSampler(std::move(surface), voxel, threads).run();
  } catch (const std::bad_alloc&) {
  }
  return Error{ErrorCode::kOutOfMemory, "there is not enough memory for so many voxels; give a larger size"};
#else
  return SurfaceSampler(std::move(surface), voxel, threads).run();
#endif
}

}  // namespace image
}  // namespace v0
}  // namespace incise
