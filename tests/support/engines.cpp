// SPDX-License-Identifier: Apache-2.0
#include "support/engines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

#include "incise/mesh/bounds.h"

namespace incise::test {

TetMesh build(TetSoup soup) {
  Result<TetMesh> mesh = TetMesh::build(std::move(soup));
  EXPECT_TRUE(mesh.ok()) << mesh.error().message;
  return mesh.ok() ? std::move(mesh).value() : TetMesh();
}

Engine make_engine(TetSoup soup, double snap, Profile profile) {
  EngineOptions options;
  options.cut = {profile, snap};
  options.maintain.merge = options.maintain.improve = false;
  Result<Engine> engine = Engine::create(build(std::move(soup)), options);
  EXPECT_TRUE(engine.ok());
  return std::move(engine).value();
}

double volume_of(const TetMesh& mesh) {
  return validate(mesh, ValidateLevel::kGeometry).volume;
}

std::string describe(const ValidityReport& report) {
  std::string text;
  for (std::size_t kind = 0; kind < kViolationKinds; ++kind) {
    if (report.counts[kind] > 0) {
      text +=
          std::string(name_of(static_cast<ViolationKind>(kind))) + " × " + std::to_string(report.counts[kind]) + ", ";
    }
  }
  for (const Violation& v : report.first) {
    text += std::string(name_of(v.kind)) + " " + std::to_string(v.ids[0]) + " " + std::to_string(v.ids[1]) + "; ";
  }
  std::array<char, 64> error{};
  std::snprintf(error.data(), error.size(), "volume error %.3g", report.volume_error);
  return text + error.data();
}

void expect_valid(const TetMesh& mesh, double volume, double tolerance) {
  ValidateOptions options;
  options.expected_volume = volume;
  options.volume_tolerance = tolerance;
  const ValidityReport report = validate(mesh, ValidateLevel::kGeometry, options);
  EXPECT_TRUE(report.ok) << describe(report);
}

std::vector<double> piece_volumes(const TetMesh& mesh) {
  std::vector<double> volumes = find_components(mesh).volume;
  std::sort(volumes.begin(), volumes.end());
  return volumes;
}

void expect_pieces(const TetMesh& mesh, std::vector<double> volumes, double tolerance) {
  const std::vector<double> found = piece_volumes(mesh);
  std::sort(volumes.begin(), volumes.end());
  ASSERT_EQ(found.size(), volumes.size());
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    EXPECT_NEAR(found[i], volumes[i], tolerance) << "piece " << i;
  }
}

std::vector<int> euler_characteristics(const TetMesh& mesh) {
  const Components pieces = find_components(mesh);
  struct Surface {
    std::set<std::uint32_t> vertices;
    std::set<std::array<std::uint32_t, 2>> edges;
    int faces = 0;
  };
  std::vector<Surface> surfaces(pieces.count());
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (!mesh.links(tet)[s].is_boundary()) continue;
      Surface& surface = surfaces[pieces.label[tet.value]];
      const auto v = mesh.vertices(Side(tet, s));
      for (unsigned k = 0; k < 3; ++k) {
        const std::uint32_t a = v[k].value, b = v[(k + 1) % 3].value;
        surface.vertices.insert(a);
        surface.edges.insert({std::min(a, b), std::max(a, b)});
      }
      ++surface.faces;
    }
  });
  std::vector<int> result;
  for (const Surface& s : surfaces) {
    result.push_back(static_cast<int>(s.vertices.size()) - static_cast<int>(s.edges.size()) + s.faces);
  }
  return result;
}

double wall_area(const TetMesh& mesh, std::uint32_t tag) {
  double twice = 0;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(tet)[s];
      if (!link.is_boundary() || link.tag() == 0 || (tag != 0 && link.tag() != tag)) continue;
      const auto v = mesh.vertices(Side(tet, s));
      twice += 0.5 * (mesh.rest(v[1]) - mesh.rest(v[0])).cross(mesh.rest(v[2]) - mesh.rest(v[0])).norm();
    }
  });
  return 0.5 * twice;
}

CutStatistics cut(Engine& engine, const Stroke& stroke) {
  const double volume = volume_of(engine.mesh());
  const Result<StrokeReport> report = engine.cut(stroke);
  EXPECT_TRUE(report.ok()) << report.error().message;
  expect_valid(engine.mesh(), volume);
  return report.ok() ? report->cut : CutStatistics{};
}

Stroke plane(const Engine& engine, const Vec3& normal, double offset) {
  Result<Stroke> stroke = plane_stroke(rest_bounds(engine.mesh()), normal, offset);
  EXPECT_TRUE(stroke.ok());
  return std::move(stroke).value();
}

}  // namespace incise::test
