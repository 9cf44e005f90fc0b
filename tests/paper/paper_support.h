// SPDX-License-Identifier: Apache-2.0
// What tests of the paper's maintenance share: cuts of the paper profile, and what must be kept.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <utility>
#include <vector>

#include "support/bodies.h"
#include "support/engines.h"
#include "support/strokes.h"

namespace incise::test {

/// A mesh that the paper profile has cut, not maintained, with the journal of that.
struct CutBody {
  TetMesh mesh;
  Journal journal;
};

/// Cuts along planes (normal, offset), one stroke each.
inline CutBody cut_as_paper(TetSoup soup, const std::vector<std::pair<Vec3, double>>& planes) {
  Engine engine = make_engine(std::move(soup), 0.0, Profile::kPaper);
  for (const auto& [normal, offset] : planes) cut(engine, plane(engine, normal, offset));
  return {engine.mesh(), engine.journal()};
}

inline CutBody cut_as_paper(TetSoup soup, const Stroke& stroke) {
  Engine engine = make_engine(std::move(soup), 0.0, Profile::kPaper);
  cut(engine, stroke);
  return {engine.mesh(), engine.journal()};
}

/// What `find` finds first among the live vertices.
template <class Find>
VertexId first_vertex(const TetMesh& mesh, Find&& find) {
  std::optional<VertexId> found;
  mesh.for_each_vertex([&](VertexId v) {
    if (!found && find(v)) found = v;
  });
  EXPECT_TRUE(found.has_value());
  return found.value_or(VertexId());
}

/// A vertex at a place, within rounding.
inline VertexId vertex_at(const TetMesh& mesh, const Vec3& place) {
  return first_vertex(mesh, [&](VertexId v) { return (mesh.rest(v) - place).norm() < 1e-12; });
}

/// A gently curved blade through the unit cube, from x = 0.3 below to x = 0.6 in the middle and back.
inline Stroke curved_stroke() {
  std::vector<Vec3> path;
  for (int i = -1; i <= 13; ++i) {
    const double y = i / 12.0;
    path.emplace_back(0.33 + 1.1 * y * (1.0 - y), y, 0.0);
  }
  return path_stroke(path, -0.2, 1.2);
}

}  // namespace incise::test
