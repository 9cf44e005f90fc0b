// SPDX-License-Identifier: Apache-2.0
// What tests of maintenance share: a mesh in care, edits of single elements, and comparisons of meshes.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "improve/care.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/verbs.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/strokes.h"

namespace incise::test {

/// A mesh under an open transaction, as the operations of maintenance want it.
struct CareOf {
  explicit CareOf(TetMesh& mesh)
      : transaction(mesh, true), care{transaction, mesh, references, walker, statistics, true, {}, changed} {}
  /// Ends the transaction.
  Step commit() { return transaction.commit(); }

  Transaction transaction;
  References references;
  StarWalker walker;
  MaintainStatistics statistics;
  std::vector<TetId> changed;
  Care care;
};

/// The vertex nearest to a place.
inline VertexId nearest_vertex(const TetMesh& mesh, const Vec3& place) {
  VertexId best;
  mesh.for_each_vertex([&](VertexId v) {
    if (!best.is_valid() || (mesh.rest(v) - place).squaredNorm() < (mesh.rest(best) - place).squaredNorm()) best = v;
  });
  return best;
}

inline std::vector<TetId> tets_of(const TetMesh& mesh) {
  std::vector<TetId> tets;
  mesh.for_each_tet([&](TetId tet) { tets.push_back(tet); });
  return tets;
}

inline std::vector<VertexId> vertices_of(const TetMesh& mesh) {
  std::vector<VertexId> vertices;
  mesh.for_each_vertex([&](VertexId v) { vertices.push_back(v); });
  return vertices;
}

inline double ratio_of(const TetMesh& mesh, TetId tet) {
  return inradius_ratio(mesh, mesh.vertices(tet));
}

inline double worst_ratio(const TetMesh& mesh, const std::vector<TetId>& tets) {
  double worst = 1.0;
  for (const TetId tet : tets) worst = std::min(worst, ratio_of(mesh, tet));
  return worst;
}

/// The tet with the least inradius ratio.
inline TetId worst_tet(const TetMesh& mesh) {
  const std::vector<TetId> tets = tets_of(mesh);
  return *std::min_element(tets.begin(), tets.end(),
                           [&](TetId a, TetId b) { return ratio_of(mesh, a) < ratio_of(mesh, b); });
}

/// A mesh that has been cut, not maintained.
inline TetMesh cut_mesh(TetSoup soup, const std::vector<std::pair<Vec3, double>>& planes, double snap = 0.0) {
  Engine engine = make_engine(std::move(soup), snap);
  for (const auto& [normal, offset] : planes) cut(engine, plane(engine, normal, offset));
  return engine.mesh();
}

inline TetMesh cut_mesh(TetSoup soup, const Stroke& stroke, double snap = 0.0) {
  Engine engine = make_engine(std::move(soup), snap);
  cut(engine, stroke);
  return engine.mesh();
}

/// Splits the edge between the vertices nearest to two places, at (1 − t)·a + t·b.
inline VertexId split_edge_at(TetMesh& mesh, const Vec3& a, const Vec3& b, double t) {
  const VertexId from = nearest_vertex(mesh, a), to = nearest_vertex(mesh, b);
  StarWalker walker;
  TetId seed;
  for (const TetId tet : walker.star(mesh, from)) {
    if (mesh.corner_of(tet, to) < 4) seed = tet;
  }
  EXPECT_TRUE(seed.is_valid()) << "no such edge";
  Transaction transaction(mesh);
  const VertexId middle = apply(transaction, plan_split_edge(mesh, from, to, seed, t)).vertex;
  transaction.commit();
  return middle;
}

/// The area of the boundary with a tag, both lips of a wall together.
inline double boundary_area(const TetMesh& mesh, std::uint32_t tag) {
  double area = 0;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(tet)[s];
      if (link.is_boundary() && link.tag() == tag) area += 0.5 * vector_area2(mesh, {tet, s}).norm();
    }
  });
  return area;
}

/// The tets by the places of their corners, in a fixed order: two meshes have equal lists where they differ in slots
/// alone.
inline std::vector<std::array<std::array<double, 3>, 4>> shape_list(const TetMesh& mesh) {
  std::vector<std::array<std::array<double, 3>, 4>> list;
  mesh.for_each_tet([&](TetId tet) {
    auto& places = list.emplace_back();
    for (unsigned c = 0; c < 4; ++c) {
      const Vec3& p = mesh.rest(mesh.vertices(tet)[c]);
      places[c] = {p.x(), p.y(), p.z()};
    }
    std::sort(places.begin(), places.end());
  });
  std::sort(list.begin(), list.end());
  return list;
}

/// A vertex's star, copied.
inline std::vector<TetId> star_of(const TetMesh& mesh, VertexId vertex) {
  StarWalker walker;
  return walker.star(mesh, vertex);
}

}  // namespace incise::test
