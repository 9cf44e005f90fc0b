// SPDX-License-Identifier: Apache-2.0
#include "image/organ_judge.h"

#include <algorithm>
#include <cmath>
#include <map>

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

void measure_interfaces(const MadeImage& made, const TetMesh& mesh, OrganFigures& out) {
  std::vector<double> errors;
  double sum = 0;
  const double voxel = made.spacing.minCoeff();
  for_each_interface(mesh, [&](const std::array<VertexId, 3>& v, bool) {
    const Vec3 a = mesh.rest(v[0]), b = mesh.rest(v[1]), c = mesh.rest(v[2]);
    const Vec3 normal = (b - a).cross(c - a).normalized();
    for (const Vec3& at :
         {Vec3((a + b + c) / 3), Vec3((4 * a + b + c) / 6), Vec3((a + 4 * b + c) / 6), Vec3((a + b + 4 * c) / 6)}) {
      errors.push_back(distance_to_change(made.truth, at, normal, 0.5 * voxel) / voxel);
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

void count_defects(const MadeImage& made, const TetMesh& mesh, OrganFigures& out) {
  const auto add = [&](const TetSoup& soup) {
    const Defects defects = find_defects(soup);
    out.nonmanifold_edges += defects.nonmanifold_edges;
    out.singleton_vertices += defects.singleton_vertices;
  };
  add(soup_of(mesh, nullptr));
  for (const std::int32_t label : made.labels) add(soup_of(mesh, &label));
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

}  // namespace

OrganFigures judge(const MadeImage& made, const TetMesh& mesh) {
  OrganFigures out;
  out.quality = measure_quality(mesh);
  const std::vector<double> volumes = true_volumes(made);
  for (std::size_t l = 0; l < made.labels.size(); ++l) {
    double volume = 0;
    for (std::uint32_t t = 0; t < mesh.tet_slots(); ++t) {
      if (!mesh.is_live(TetId(t)) || mesh.region(TetId(t)) != made.labels[l]) continue;
      const TetVertices& v = mesh.vertices(TetId(t));
      volume += signed_volume(mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3]));
    }
    out.volume_error.push_back(volume / volumes[l] - 1);
  }
  measure_interfaces(made, mesh, out);
  count_defects(made, mesh, out);
  out.surfaces = count_surfaces(mesh);
  out.is_valid = validate(mesh, ValidateLevel::kGeometry).ok;
  return out;
}

}  // namespace incise_test
