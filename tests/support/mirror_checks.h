// SPDX-License-Identifier: Apache-2.0
// The mirror of a journal, and what tests ask of it.
#pragma once

#include <gtest/gtest.h>

#include "incise/mesh/journal_mirror.h"

namespace incise::test {

/// A velocity that is known everywhere, and must be met wherever vertices are born, moved or copied.
inline Vec3 affine_velocity(const Vec3& x) {
  return {1.0 + 2.0 * x.x() - x.z(), -0.5 + x.x() + 3.0 * x.y(), 0.25 - x.y() + 0.5 * x.z()};
}

/// A mirror with that velocity.
inline JournalMirror mirror_of(const TetMesh& mesh, StepReading reading = StepReading::kEdits) {
  JournalMirror mirror(mesh, {}, reading);
  mesh.for_each_vertex([&](VertexId v) { mirror.vertex(v).velocity = affine_velocity(mesh.rest(v)); });
  return mirror;
}

inline void expect_follows(JournalMirror& mirror, const Journal& journal, const TetMesh& mesh) {
  mirror.follow(journal);
  ASSERT_EQ(mirror.difference(mesh), "");
}

inline void expect_affine_velocity(const JournalMirror& mirror, double tolerance) {
  for (const JournalMirror::Vertex& vertex : mirror.vertices()) {
    if (!vertex.is_live) continue;
    EXPECT_LT((vertex.velocity - affine_velocity(vertex.rest)).norm(), tolerance);
  }
}

/// Calls `visit(vertex, mass)` for the quarter of each tet's rest volume at each of its corners.
template <class Visit>
void for_each_quarter(const JournalMirror& mirror, const Visit& visit) {
  for (const JournalMirror::Tet& tet : mirror.tets()) {
    if (!tet.is_live()) continue;
    const auto at = [&](unsigned c) { return mirror.vertex(tet.vertices[c]).rest; };
    const double volume = (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) / 6;
    for (const VertexId v : tet.vertices) visit(mirror.vertex(v), volume / 4);
  }
}

/// Of a body of density 1.
inline double mass_of(const JournalMirror& mirror) {
  double sum = 0;
  for_each_quarter(mirror, [&](const JournalMirror::Vertex&, double mass) { sum += mass; });
  return sum;
}
inline Vec3 momentum_of(const JournalMirror& mirror) {
  Vec3 sum = Vec3::Zero();
  for_each_quarter(mirror, [&](const JournalMirror::Vertex& v, double mass) { sum += mass * v.velocity; });
  return sum;
}

}  // namespace incise::test
