// SPDX-License-Identifier: Apache-2.0
// A sample of tets at equal strides of slots: a scale needs no more, and costs nothing that grows with the mesh.
#include "cut/spacing.h"

#include <algorithm>

#include "cut/constants.h"

namespace incise {
inline namespace v0 {

namespace {

/// Some edges, and how long they are together.
struct Edges {
  double length = 0;
  std::size_t count = 0;

  void add(const TetMesh& mesh, TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    for (const auto& [a, b] : kEdgeCorners) {
      length += (mesh.rest(v[a]) - mesh.rest(v[b])).norm();
      ++count;
    }
  }
  [[nodiscard]] double mean() const { return count == 0 ? 0.0 : length / static_cast<double>(count); }
};

/// Some tets, and how much they hold together.
struct Volumes {
  double volume = 0;
  std::size_t count = 0;

  void add(const TetMesh& mesh, TetId tet) {
    volume += mesh.rest_volume(tet);
    ++count;
  }
  [[nodiscard]] double mean() const { return count == 0 ? 0.0 : volume / static_cast<double>(count); }
};

/// What is to be measured of 64 to 128 tets, spread over the slots, of which `takes(tet)` is true.
template <class Measured, class Takes>
auto sample(const TetMesh& mesh, Takes&& takes) {
  Measured measured;
  const std::uint32_t stride = std::max(1U, mesh.tet_slots() / 64U);
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); slot += stride) {
    if (mesh.is_live(TetId(slot)) && takes(TetId(slot))) measured.add(mesh, TetId(slot));
  }
  return measured;
}

/// The mean of tets that no cut has touched, where they are many enough to tell; of all elsewhere.
template <class Measured>
double uncut_mean(const TetMesh& mesh) {
  const auto all = sample<Measured>(mesh, [](TetId) { return true; });
  const auto uncut = sample<Measured>(mesh, [&](TetId tet) {
    const TetVertices& corners = mesh.vertices(tet);
    return std::none_of(corners.begin(), corners.end(),
                        [&](VertexId v) { return (mesh.shape_of(v) & shape::kWall) != 0; });
  });
  const bool is_told = static_cast<double>(uncut.count) >= kUncutShare * static_cast<double>(all.count);
  return is_told ? uncut.mean() : all.mean();
}

}  // namespace

double typical_spacing(const TetMesh& mesh) {
  return sample<Edges>(mesh, [](TetId) { return true; }).mean();
}

double uncut_spacing(const TetMesh& mesh) {
  return uncut_mean<Edges>(mesh);
}

double uncut_volume(const TetMesh& mesh) {
  return uncut_mean<Volumes>(mesh);
}

}  // namespace v0
}  // namespace incise
