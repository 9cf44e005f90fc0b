// SPDX-License-Identifier: Apache-2.0
// The pipeline from voxels to a mesh: islands, lattice, labels, repair, then rounds of moving points and peeling flat
// tets, and maintenance at the end (docs/internals.md, 6).
#include "incise/image/mesh_labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "image/interface_fit.h"
#include "image/lattice.h"
#include "image/mend_manifold.h"
#include "image/peel_flat.h"
#include "image/tet_labels.h"
#include "improve/maintainer.h"
#include "incise/geom/quality.h"

namespace incise {
inline namespace v0 {
namespace image {
namespace {

constexpr double kMostTets = 1e8, kTetsPerCube = 12, kMostCubes = 1 << 15;
constexpr double kMostIsland = 1e15;  // voxels; more than there are
/// Rounds of moving points: those that spread them, in each pass between which flat tets are peeled off the skin, and
/// at the end those that only bring them nearer.
constexpr int kPasses = 6, kSpreadRounds = 4, kFinalRounds = 6;

/// Tets need not be smaller than this share of the least spacing of the voxels: they would show these, and no more.
constexpr double kLeastSize = 0.5;

std::string fmt_length(double length) {
  std::ostringstream out;
  out << std::setprecision(4) << length;
  return out.str();
}

Error bad_option(const std::string& what) {
  return {ErrorCode::kBadArgument, what};
}

/// Of an image for which the options, good for others, are not.
Error bad_image(const std::string& what) {
  return {ErrorCode::kBadFile, what};
}

Status check_options(const MeshLabelsOptions& o) {
  if (!(o.size > 0) || !std::isfinite(o.size))
    return bad_option("the size of tets must be above 0 mm; give a larger one");
  if (!(o.smooth >= 0.4 && o.smooth <= 10)) return bad_option("smoothing must lie in [0.4, 10] voxels; mend it");
  if (!(o.grade >= 0 && o.grade <= 10)) return bad_option("the grade must lie in [0, 10]; mend it");
  if (o.most_halvings < 0 || o.most_halvings > kMostHalvings) {
    return bad_option("the size may be halved 0 to " + std::to_string(kMostHalvings) + " times; mend it");
  }
  if (!(o.least_island >= 0)) return bad_option("the volume of islands must be at least 0 mm³; mend it");
  for (const double volume : o.volumes) {
    if (!(volume >= 0) || !std::isfinite(volume)) return bad_option("volumes of labels must be at least 0; mend them");
  }
  return o.threads >= 1 && o.threads <= 256 ? Status() : bad_option("1 to 256 threads may be used; mend it");
}

Error nothing_to_mesh() {
  return bad_image(
      "the image has no voxel of a label other than 0 that could be meshed; choose other labels, or a smaller size");
}

/// Whether an image is background alone: found out before anything as large as it is made.
bool is_background(const LabelImage& image) {
  return std::all_of(image.labels.begin(), image.labels.end(), [](std::int32_t label) { return label == 0; });
}

/// Whether there is something to mesh, and not too much.
Status check_amount(const LabelVolume& volume, const MeshLabelsOptions& options) {
  const std::vector<std::uint64_t> counts = volume.count_voxels();
  double voxels = 0;
  for (std::size_t l = 1; l < counts.size(); ++l) voxels += static_cast<double>(counts[l]);
  if (voxels == 0) return nothing_to_mesh();
  const Vec3& s = volume.spacing();
  if (const double least = kLeastSize * s.minCoeff(); options.size < (1.0 - 1e-6) * least) {
    return bad_image("tets of size " + fmt_length(options.size) + " mm are smaller than half a voxel; give " +
                     fmt_length(least) + " or more, or an image in the right unit");
  }
  const double cubes = voxels * s.x() * s.y() * s.z() / (options.size * options.size * options.size);
  if (options.grade == 0 && kTetsPerCube * cubes > kMostTets) {
    return bad_image("tets of size " + fmt_length(options.size) +
                     " mm would be more than 100 million; give a larger size");
  }
  if (cubes_along(volume, options.size) > kMostCubes) {
    return bad_image("the size of tets is too small for the image; give a larger one");
  }
  return {};
}

/// One run, stage by stage.
class LabelMesher {
 public:
  LabelMesher(const LabelImage& image, const MeshLabelsOptions& options)
      : image_(image), options_(options), volume_(image), field_(volume_, options.smooth) {}

  Result<LabelMesh> run() {
    if (const Status status = check_amount(volume_, options_); !status.ok()) return status.error();
    join_islands();
    if (const Status status = check_amount(volume_, options_); !status.ok()) return status.error();
    progress();
    make_tets();
    if (tets_.tets.empty()) {
      return bad_image("no label is thick enough: of tets of " + fmt_length(options_.size) +
                       " mm none lies mostly in one; give a smaller size, or a finer image");
    }
    fit_interfaces();
    Result<TetMesh> mesh = TetMesh::build(placed());
    if (!mesh) return mesh.error();
    out_.mesh = std::move(mesh).value();
    tets_ = {};
    progress();
    if (options_.improve) improve();
    measure();
    progress();
    return std::move(out_);
  }

 private:
  static constexpr std::size_t kStages = 5 + kPasses * kSpreadRounds + kFinalRounds;

  void progress() {
    if (options_.progress) options_.progress(++stage_, kStages);
  }

  void join_islands() {
    const Vec3& s = volume_.spacing();
    const double least =
        options_.least_island > 0 ? options_.least_island : options_.size * options_.size * options_.size / 8;
    const double voxels = std::min(least / (s.x() * s.y() * s.z()), kMostIsland);
    out_.island_voxels = volume_.join_islands(static_cast<std::uint64_t>(voxels));
  }

  void make_tets() {
    LatticeTets lattice = make_lattice(field_, {options_.size, options_.grade, options_.most_halvings});
    tets_.points = std::move(lattice.points);
    tets_.tets = std::move(lattice.tets);
    progress();
    label_tets(field_, options_.threads, tets_);
    const ManifoldRepair repair = mend_manifold(tets_);
    out_.relabelled_tets = repair.relabelled;
    out_.pinched_points = repair.left;
    tets_.drop_background();
    progress();
  }

  /// The volumes that the labels shall have, along the image's axes.
  [[nodiscard]] std::vector<double> wanted_volumes() const {
    const double box = volume_.spacing().prod();  // of a voxel, were its axes upright
    std::vector<double> wanted;
    for (const std::uint64_t n : volume_.count_voxels()) wanted.push_back(static_cast<double>(n) * box);
    for (std::size_t l = 1; l < wanted.size() && !options_.volumes.empty(); ++l) {
      const double told = options_.volumes[image_.find_label(volume_.labels()[l])];
      if (told > 0) wanted[l] = told * box / image_.voxel_volume();
    }
    return wanted;
  }

  void fit_interfaces() {
    const std::vector<double> wanted = wanted_volumes();
    for (int pass = 0; pass < kPasses; ++pass) {
      const bool is_last = pass + 1 == kPasses;
      if (pass > 0 && peel_flat_tets(tets_) == 0 && !is_last) continue;
      InterfaceFit fit(field_, wanted, {}, options_.threads, tets_);
      for (int round = 0; round < kSpreadRounds; ++round) {
        fit.move_points(0.5);
        if (round >= 2) fit.match_volumes();
        progress();
      }
      for (int round = 0; is_last && round < kFinalRounds; ++round) {
        fit.move_points(0);
        if (round + 2 < kFinalRounds) fit.match_volumes();
        progress();
      }
    }
  }

  /// The tets in RAS millimetres.
  [[nodiscard]] TetSoup placed() const {
    TetSoup soup;
    const Vec3& s = volume_.spacing();
    const std::array<Vec3, 3> axis = {image_.step[0] / s.x(), image_.step[1] / s.y(), image_.step[2] / s.z()};
    for (const Vec3& p : tets_.points)
      soup.points.push_back(image_.origin + p.x() * axis[0] + p.y() * axis[1] + p.z() * axis[2]);
    const bool is_mirrored = axis[0].cross(axis[1]).dot(axis[2]) < 0;
    for (std::size_t t = 0; t < tets_.tets.size(); ++t) {
      std::array<std::uint32_t, 4> tet = tets_.tets[t];
      if (is_mirrored) std::swap(tet[2], tet[3]);
      soup.tets.push_back(tet);
      soup.regions.push_back(volume_.labels()[tets_.labels[t]]);
    }
    return soup;
  }

  void improve() {
    Maintainer maintainer;
    Journal journal;
    StageTimes times;
    maintainer.set_original(out_.mesh);
    maintainer.take_up_all(out_.mesh);
    out_.maintain = maintainer.run(out_.mesh, journal, kUnlimitedWork, times);
  }

  void measure() {
    const std::vector<std::uint64_t> counts = volume_.count_voxels();
    const std::vector<double> wanted = wanted_volumes();
    const double upright = image_.voxel_volume() / volume_.spacing().prod();
    for (std::size_t l = 1; l < volume_.labels().size(); ++l) {
      out_.labels.push_back({volume_.labels()[l], counts[l], wanted[l] * upright, 0, 0});
    }
    const TetMesh& mesh = out_.mesh;
    for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
      const TetId tet(slot);
      if (!mesh.is_live(tet)) continue;
      const auto at = std::lower_bound(out_.labels.begin(), out_.labels.end(), mesh.region(tet),
                                       [](const LabelOutcome& o, std::int32_t label) { return o.label < label; });
      const TetVertices& v = mesh.vertices(tet);
      ++at->tets;
      at->volume += signed_volume(mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3]));
    }
  }

  const LabelImage& image_;
  const MeshLabelsOptions& options_;
  LabelVolume volume_;
  LabelField field_;
  LabelledTets tets_;
  LabelMesh out_;
  std::size_t stage_ = 0;
};

}  // namespace

Result<LabelMesh> mesh_labels(const LabelImage& image, const MeshLabelsOptions& options) {
  if (const Status status = check_options(options); !status.ok()) return status.error();
  if (!options.volumes.empty() && options.volumes.size() != image.labels.size()) {
    return bad_option("as many volumes as labels must be given, or none; mend them");
  }
  if (is_background(image)) return nothing_to_mesh();
#if defined(__cpp_exceptions)
  try {
    return LabelMesher(image, options).run();
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {
  }
  return Error{ErrorCode::kOutOfMemory, "there is not enough memory for so many tets; give a larger size"};
#else
  return LabelMesher(image, options).run();
#endif
}

}  // namespace image
}  // namespace v0
}  // namespace incise
