// SPDX-License-Identifier: Apache-2.0
#include "image/organ_judge.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "incise/geom/quality.h"
#include "incise/mesh/defects.h"
#include "incise/mesh/validate.h"

namespace incise_test {
namespace {

using namespace incise;

/// How far away the truth changes its label, along a line; at most `most`.
double distance_along(const Truth& truth, const Vec3& p, const Vec3& direction, double most) {
  const std::int32_t here = truth(p);
  constexpr double kStep = 0.04;
  for (double t = kStep; t < most; t += kStep) {
    if (truth(p + t * direction) != here || truth(p - t * direction) != here) return t - kStep / 2;
  }
  return most;
}

/// The same along the normal; where that is far, along lines in all directions, of which the shortest counts.
double distance_to_change(const Truth& truth, const Vec3& p, const Vec3& normal, double far) {
  double least = distance_along(truth, p, normal, 8);
  for (int d = 0; d < 27 && least > far; ++d) {
    const Vec3 direction(d % 3 - 1, d / 3 % 3 - 1, d / 9 - 1);
    if (d != 13) least = distance_along(truth, p, direction.normalized(), least);
  }
  return least;
}

/// Calls back for each face between regions, and of the skin.
template <class Work>
void for_each_interface(const TetMesh& mesh, const Work& work) {
  for (std::uint32_t t = 0; t < mesh.tet_slots(); ++t) {
    if (!mesh.is_live(TetId(t))) continue;
    for (unsigned s = 0; s < 4; ++s) {
      const Side side(TetId(t), s);
      const Link link = mesh.link(side);
      const bool is_border = !link.is_boundary() && mesh.region(TetId(t)) < mesh.region(link.side().tet());
      if (link.is_boundary() || is_border) work(mesh.vertices(side), link.is_boundary());
    }
  }
}

void measure_interfaces(const OrganTruth& truth, const TetMesh& mesh, OrganFigures& out) {
  std::vector<double> errors;
  double sum = 0;
  for_each_interface(mesh, [&](const std::array<VertexId, 3>& v, bool) {
    const Vec3 a = mesh.rest(v[0]), b = mesh.rest(v[1]), c = mesh.rest(v[2]);
    const Vec3 normal = (b - a).cross(c - a).normalized();
    for (const Vec3& at :
         {Vec3((a + b + c) / 3), Vec3((4 * a + b + c) / 6), Vec3((a + 4 * b + c) / 6), Vec3((a + b + 4 * c) / 6)}) {
      errors.push_back(distance_to_change(truth.label_at, at, normal, 0.5 * truth.voxel) / truth.voxel);
      sum += errors.back();
    }
  });
  std::sort(errors.begin(), errors.end());
  out.mean_error = sum / static_cast<double>(errors.size());
  out.p99_error = errors[errors.size() * 99 / 100];
  out.worst_error = errors.back();
}

TetSoup soup_of(const TetMesh& mesh, const std::int32_t* label) {
  TetSoup soup;
  std::map<std::uint32_t, std::uint32_t> number;
  for (std::uint32_t t = 0; t < mesh.tet_slots(); ++t) {
    if (!mesh.is_live(TetId(t)) || (label != nullptr && mesh.region(TetId(t)) != *label)) continue;
    std::array<std::uint32_t, 4> tet{};
    for (std::size_t c = 0; c < 4; ++c) {
      const VertexId v = mesh.vertices(TetId(t))[c];
      const auto [at, is_new] = number.emplace(v.value, static_cast<std::uint32_t>(soup.points.size()));
      if (is_new) soup.points.push_back(mesh.rest(v));
      tet[c] = at->second;
    }
    soup.tets.push_back(tet);
  }
  return soup;
}

void count_defects(const std::vector<std::int32_t>& labels, const TetMesh& mesh, OrganFigures& out) {
  const auto add = [&](const TetSoup& soup) {
    const Defects defects = find_defects(soup);
    out.nonmanifold_edges += defects.nonmanifold_edges;
    out.singleton_vertices += defects.singleton_vertices;
  };
  add(soup_of(mesh, nullptr));
  for (const std::int32_t label : labels) add(soup_of(mesh, &label));
}

std::uint64_t count_surfaces(const TetMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.vertex_slots());
  std::vector<char> is_used(parent.size(), 0);
  for (std::uint32_t v = 0; v < parent.size(); ++v) parent[v] = v;
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for_each_interface(mesh, [&](const std::array<VertexId, 3>& v, bool is_skin) {
    if (!is_skin) return;
    for (const VertexId p : v) {
      is_used[p.value] = 1;
      parent[root(p.value)] = root(v[0].value);
    }
  });
  std::uint64_t surfaces = 0;
  for (std::uint32_t v = 0; v < parent.size(); ++v) surfaces += is_used[v] != 0 && root(v) == v ? 1U : 0U;
  return surfaces;
}

/// Shares of labels at a point, by the voxels around it.
class LinearLabels {
 public:
  explicit LinearLabels(const image::LabelImage& labels) : image_(&labels) {
    Eigen::Matrix3d steps;
    for (int axis = 0; axis < 3; ++axis) steps.col(axis) = labels.step[static_cast<std::size_t>(axis)];
    to_voxels_ = steps.inverse();
  }

  std::int32_t operator()(const Vec3& p) const {
    const Vec3 at = to_voxels_ * (p - image_->origin);
    std::array<std::pair<std::int32_t, double>, 8> shares{};
    std::size_t count = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
      double share = 1;
      Eigen::Array3i voxel;
      for (int axis = 0; axis < 3; ++axis) {
        const double low = std::floor(at[axis]);
        const bool is_high = (corner >> axis & 1U) != 0;
        voxel[axis] = static_cast<int>(low) + (is_high ? 1 : 0);
        share *= is_high ? at[axis] - low : 1 - at[axis] + low;
      }
      add(label_of(voxel), share, shares, count);
    }
    std::size_t most = 0;
    for (std::size_t i = 1; i < count; ++i) most = shares[i].second > shares[most].second ? i : most;
    return shares[most].first;
  }

 private:
  static void add(std::int32_t label, double share, std::array<std::pair<std::int32_t, double>, 8>& shares,
                  std::size_t& count) {
    std::size_t i = 0;
    while (i < count && shares[i].first != label) ++i;
    if (i == count) shares[count++] = {label, 0};
    shares[i].second += share;
  }
  [[nodiscard]] std::int32_t label_of(const Eigen::Array3i& voxel) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (voxel[axis] < 0 || voxel[axis] >= static_cast<int>(image_->size[static_cast<std::size_t>(axis)])) return 0;
    }
    return image_->label(static_cast<std::size_t>(voxel[0]), static_cast<std::size_t>(voxel[1]),
                         static_cast<std::size_t>(voxel[2]));
  }

  const image::LabelImage* image_;
  Eigen::Matrix3d to_voxels_;
};

}  // namespace

OrganTruth truth_of(const MadeImage& made) {
  return {made.truth, made.labels, true_volumes(made), made.spacing.minCoeff()};
}

OrganTruth truth_of(const image::LabelImage& image) {
  OrganTruth truth{LinearLabels(image), {}, {}, std::cbrt(image.voxel_volume())};
  const std::vector<std::uint64_t> counts = image.count_voxels();
  for (std::size_t l = 0; l < image.labels.size(); ++l) {
    if (image.labels[l] == 0 || counts[l] == 0) continue;
    truth.labels.push_back(image.labels[l]);
    truth.volumes.push_back(static_cast<double>(counts[l]) * image.voxel_volume());
  }
  return truth;
}

OrganFigures judge(const OrganTruth& truth, const TetMesh& mesh) {
  OrganFigures out;
  out.quality = measure_quality(mesh);
  for (std::size_t l = 0; l < truth.labels.size(); ++l) {
    double volume = 0;
    for (std::uint32_t t = 0; t < mesh.tet_slots(); ++t) {
      if (!mesh.is_live(TetId(t)) || mesh.region(TetId(t)) != truth.labels[l]) continue;
      const TetVertices& v = mesh.vertices(TetId(t));
      volume += signed_volume(mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3]));
    }
    out.volume_error.push_back(volume / truth.volumes[l] - 1);
  }
  measure_interfaces(truth, mesh, out);
  count_defects(truth.labels, mesh, out);
  out.surfaces = count_surfaces(mesh);
  out.is_valid = validate(mesh, ValidateLevel::kGeometry).ok;
  return out;
}

}  // namespace incise_test
