// SPDX-License-Identifier: Apache-2.0
// Parts one by one, the largest first and smaller ones over it, each by the winding number of its own triangles at the
// voxels of its box.
#include "incise/image/surface_labels.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <new>
#include <numeric>
#include <sstream>
#include <utility>

#include "image/mend_surface.h"
#include "image/surface_cells.h"
#include "image/winding_number.h"
#include "incise/core/parallel.h"
#include "incise/geom/box.h"
#include "incise/io/surface_file.h"

namespace incise {
inline namespace v0 {
namespace image {
namespace {

/// Voxels left free around the surface; uneven, so that no plane that a designer would choose goes through their
/// middles.
const Vec3 kMargin(1.5151, 1.5233, 1.5087);
/// A part lies wholly in another where that has this share of its voxels.
constexpr double kWholly = 0.999;

/// Voxels side by side along i.
struct VoxelRun {
  std::size_t begin = 0, n = 0;
};

/// A cell, or all triangles of parts with holes together.
struct SampledPart {
  std::vector<VoxelRun> runs;  ///< of the voxels inside
  double volume = 0;           ///< of what is inside
};

class SurfaceSampler {
 public:
  SurfaceSampler(io::SurfaceSoup surface, double voxel, unsigned threads)
      : surface_(std::move(surface)), voxel_(voxel), threads_(threads) {
    io::weld(surface_);
    if (const std::size_t repeated = drop_repeated(surface_.triangles); repeated > 0) {
      out_.notes.push_back(std::to_string(repeated) + " triangles are there more than once: the first of each counts");
    }
    for (const Triangle& t : surface_.triangles) {
      for (const std::uint32_t p : t) box_.extend(surface_.points[p]);
    }
  }

  Result<SurfaceLabels> run() {
    if (!(voxel_ > 0) || !std::isfinite(voxel_)) return bad("voxels must be larger than 0; give a larger size");
    if (surface_.triangles.empty() || voxel_ >= (box_.hi - box_.lo).maxCoeff()) return empty();
    if (!lay_voxels())
      return bad("the size is too small for the surface: it would take too many voxels; give a larger one");
    sample_parts();
    if (parts_.empty()) return empty();
    label_voxels();
    out_.parts = parts_.size();
    return std::move(out_);
  }

 private:
  using Triangle = SurfaceCells::Triangle;

  static Error bad(const std::string& what) { return {ErrorCode::kBadArgument, what}; }
  [[nodiscard]] Error empty() const {
    if (surface_.triangles.empty()) return {ErrorCode::kBadFile, "the surface has no triangles; export it again"};
    std::ostringstream extent;
    extent << std::setprecision(4) << (box_.hi - box_.lo).maxCoeff();
    return {ErrorCode::kBadFile, "the surface, " + extent.str() +
                                     " long, encloses nothing of this size; close its holes, turn its triangles alike, "
                                     "or give a smaller size"};
  }

  bool lay_voxels() {
    const Vec3 extent = box_.hi - box_.lo;
    double voxels = 1;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto c = static_cast<Eigen::Index>(a);
      const double n = std::floor(extent[c] / voxel_ + 2 * kMargin[c]) + 1;
      voxels *= n;
      if (!(voxels <= kMostSurfaceVoxels)) return false;
      out_.image.size[a] = static_cast<std::size_t>(n);
      out_.image.step[a] *= voxel_;
    }
    out_.image.origin = box_.lo - voxel_ * kMargin;
    return true;
  }

  /// Closed cells one by one and what is open as one, the largest first, without those smaller than a voxel.
  void sample_parts() {
    SurfaceCells cells = find_cells(surface_.points, surface_.triangles);
    out_.open_edges = cells.open_edges;
    std::size_t left_out = 0;
    for (const SurfaceCells::Cell& cell : cells.closed) left_out += add_part(cell.triangles, cell.volume) ? 0U : 1U;
    if (left_out > 0) out_.notes.push_back(std::to_string(left_out) + " parts smaller than a voxel are left out");
    if (!cells.open.empty()) add_open(cells.open);
    std::stable_sort(parts_.begin(), parts_.end(),
                     [](const SampledPart& a, const SampledPart& b) { return a.volume > b.volume; });
    if (parts_.size() >= kMostLabels) {
      out_.notes.push_back("has more than " + std::to_string(kMostLabels - 1) + " parts: the smallest are left out");
      parts_.resize(kMostLabels - 1);
    }
  }

  void add_open(std::vector<Triangle>& triangles) {
    if (const std::size_t turned = turn_alike(triangles); turned > 0) {
      out_.notes.push_back(std::to_string(turned) +
                           " triangles faced other ways than those beside them, and are turned");
    }
    const std::string edges = std::to_string(out_.open_edges) + " edges without a second triangle";
    const bool is_bridged = add_part(triangles, 0);
    out_.notes.push_back("has " + edges + (is_bridged ? ": holes are bridged" : ": what has them encloses nothing"));
  }

  /// False where nothing is inside. `signed_volume`: how often the triangles wind around each place, over space.
  bool add_part(const std::vector<Triangle>& triangles, double signed_volume) {
    Box box;
    for (const Triangle& t : triangles) {
      for (const std::uint32_t p : t) box.extend(surface_.points[p]);
    }
    std::array<std::size_t, 3> first{}, n{};
    for (std::size_t a = 0; a < 3; ++a) {
      const auto c = static_cast<Eigen::Index>(a);
      const double low = std::ceil((box.lo[c] - out_.image.origin[c]) / voxel_);
      const double high = std::floor((box.hi[c] - out_.image.origin[c]) / voxel_);
      first[a] = static_cast<std::size_t>(std::max(0.0, low));
      n[a] = static_cast<std::size_t>(std::max(0.0, high - low + 1));
      n[a] = std::min(n[a], out_.image.size[a] - std::min(out_.image.size[a], first[a]));
    }
    const std::vector<std::int8_t> windings = wind(triangles, first, n);
    SampledPart part;
    std::int64_t inside = 0, more = 0;
    for (std::size_t v = 0; v < windings.size(); ++v) {
      if (windings[v] == 0) continue;
      ++inside;
      more += windings[v] - 1;
      const std::size_t at =
          out_.image.index(first[0] + v % n[0], first[1] + v / n[0] % n[1], first[2] + v / n[0] / n[1]);
      if (part.runs.empty() || part.runs.back().begin + part.runs.back().n != at) part.runs.push_back({at, 0});
      ++part.runs.back().n;
    }
    // Exact where each place inside is wound around once; where it is not, as the voxels tell.
    const double voxel_volume = voxel_ * voxel_ * voxel_;
    part.volume = signed_volume > 0 ? signed_volume - static_cast<double>(more) * voxel_volume
                                    : static_cast<double>(inside) * voxel_volume;
    if (part.volume < voxel_volume) return false;
    parts_.push_back(std::move(part));
    return true;
  }

  /// How often the triangles wind around each voxel of a box, i fastest.
  [[nodiscard]] std::vector<std::int8_t> wind(const std::vector<Triangle>& triangles,
                                              const std::array<std::size_t, 3>& first,
                                              const std::array<std::size_t, 3>& n) const {
    constexpr double kMost = 100;
    const WindingNumber winding(surface_.points, triangles);
    std::vector<std::int8_t> out(n[0] * n[1] * n[2]);
    parallel_blocks(out.size(), threads_, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const Vec3 at(static_cast<double>(first[0] + v % n[0]), static_cast<double>(first[1] + v / n[0] % n[1]),
                      static_cast<double>(first[2] + v / n[0] / n[1]));
        const double turns = std::floor(winding(out_.image.origin + voxel_ * at) + 0.5);
        out[v] = static_cast<std::int8_t>(std::clamp(turns, -kMost, kMost));
      }
    });
    return out;
  }

  /// Smaller parts come later, and overwrite those around them.
  void label_voxels() {
    LabelImage& image = out_.image;
    image.voxels.assign(image.size[0] * image.size[1] * image.size[2], 0);
    image.labels = {0};
    out_.volumes = {0};
    for (const SampledPart& part : parts_) {
      const auto label = static_cast<std::uint16_t>(image.labels.size());
      image.labels.push_back(label);
      std::vector<std::uint64_t> taken(label, 0);
      for (const VoxelRun& run : part.runs) {
        for (std::size_t v = run.begin; v < run.begin + run.n; ++v) ++taken[std::exchange(image.voxels[v], label)];
      }
      take_from_those_around(part, taken);
      out_.volumes.push_back(part.volume);
    }
  }

  /// A part takes its volume from that which it lies in wholly; where parts overlap, that of the voxels of both.
  void take_from_those_around(const SampledPart& part, const std::vector<std::uint64_t>& taken) {
    const std::uint64_t all = std::accumulate(taken.begin(), taken.end(), std::uint64_t{0});
    const auto most = std::max_element(taken.begin(), taken.end());
    const bool is_within = static_cast<double>(*most) >= kWholly * static_cast<double>(all);
    for (std::size_t l = 1; l < taken.size(); ++l) {
      double loss = static_cast<double>(taken[l]) * voxel_ * voxel_ * voxel_;
      if (is_within) loss = taken.begin() + static_cast<std::ptrdiff_t>(l) == most ? part.volume : 0;
      if (all > 0) out_.volumes[l] = std::max(0.0, out_.volumes[l] - loss);
    }
  }

  io::SurfaceSoup surface_;
  double voxel_;
  unsigned threads_;
  Box box_;
  std::vector<SampledPart> parts_;
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
