// SPDX-License-Identifier: Apache-2.0
// What tests of the cited methods share.
#pragma once

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "incise/lab/method.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "incise/mesh/validate.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/random_strokes.h"
#include "support/strokes.h"

namespace incise::test {

/// What one stroke left.
struct LabCut {
  TetMesh mesh;
  Journal journal;
  CutStatistics statistics;
};

inline void cut_on(LabCut& body, LabMethod method, const Stroke& stroke, std::uint32_t tag) {
  const Result<CutStatistics> cut = cut_by(method, body.mesh, body.journal, stroke, tag);
  ASSERT_TRUE(cut.ok()) << cut.error().message;
  body.statistics = *cut;
}

inline LabCut cut_by(LabMethod method, TetSoup soup, const Stroke& stroke) {
  LabCut body{build(std::move(soup)), {}, {}};
  cut_on(body, method, stroke, 1);
  return body;
}

/// The plane normal · x = offset through the unit cube.
inline Stroke plane_through(const Vec3& normal, double offset) {
  return *plane_stroke({Vec3(0, 0, 0), Vec3(1, 1, 1)}, normal, offset);
}

/// The first planes of docs/benchmark.md (`random_planes` of bench/methods.cpp), through the unit cube.
inline std::vector<Stroke> benchmark_planes(unsigned count) {
  Random random(7 * 0x9e3779b97f4a7c15U + 1);
  std::vector<Stroke> strokes;
  while (strokes.size() < count) {
    const Vec3 normal = random_direction(random);
    strokes.push_back(plane_through(normal, normal.dot(0.5 * Vec3::Ones() + 0.2 * random.point(-1, 1))));
  }
  return strokes;
}

/// Nothing inverted or pinched, every link sound: whatever the volume is.
inline void expect_sound(const TetMesh& mesh) {
  const ValidityReport report = validate(mesh, ValidateLevel::kGeometry);
  EXPECT_TRUE(report.ok) << describe(report);
}

/// The greatest distance of a vertex of the walls of a stroke from a plane with a unit normal.
inline double greatest_wall_distance(const TetMesh& mesh, const Vec3& normal, double offset, std::uint32_t tag = 1) {
  double greatest = 0;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(tet)[s];
      if (!link.is_boundary() || link.tag() != tag) continue;
      for (const VertexId v : mesh.vertices(Side(tet, s))) {
        greatest = std::max(greatest, std::abs(normal.dot(mesh.rest(v)) - offset));
      }
    }
  });
  return greatest;
}

}  // namespace incise::test
