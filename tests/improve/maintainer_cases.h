// SPDX-License-Identifier: Apache-2.0
// Cuts that are hard on quality, and what is asked of the mesh after them.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "improve/support.h"
#include "incise/geom/quality.h"
#include "incise/mesh/bounds.h"

namespace incise::test {

/// A body and the strokes to make in it.
struct Case {
  std::string name;
  TetSoup soup;
  std::vector<Stroke> strokes;
};

inline Engine maintaining_engine(TetSoup soup, double snap, std::uint64_t work_units = kUnlimitedWork,
                                 unsigned threads = 1) {
  EngineOptions options;
  options.cut.snap = snap;
  options.maintain.work_units = work_units;
  options.threads = threads;
  Result<Engine> engine = Engine::create(build(std::move(soup)), options);
  EXPECT_TRUE(engine.ok());
  return std::move(engine).value();
}

inline StrokeReport cut_and_maintain(Engine& engine, const Stroke& stroke) {
  const Result<StrokeReport> report = engine.cut(stroke);
  EXPECT_TRUE(report.ok()) << report.error().message;
  return report.ok() ? *report : StrokeReport{};
}

inline Stroke plane_of(const TetSoup& soup, const Vec3& normal, double offset) {
  Box box;
  for (const Vec3& point : soup.points) box.extend(point);
  Result<Stroke> stroke = plane_stroke(box, normal, offset);
  EXPECT_TRUE(stroke.ok());
  return std::move(stroke).value();
}

/// The oblique plane of the study of quality, and a point of it.
inline Vec3 oblique_normal() {
  return Vec3(0.37, 0.53, 0.76).normalized();
}
inline Vec3 oblique_point() {
  return {0.513, 0.492, 0.507};
}
inline Stroke oblique_plane(const TetSoup& soup) {
  return plane_of(soup, oblique_normal(), oblique_normal().dot(oblique_point()));
}

/// A plane through three points of the cube, `beside` above them.
inline Stroke plane_beside_vertices(const TetSoup& soup, double beside) {
  const auto nearest = [&](const Vec3& to) {
    return *std::min_element(soup.points.begin(), soup.points.end(), [&](const Vec3& p, const Vec3& q) {
      return (p - to).squaredNorm() < (q - to).squaredNorm();
    });
  };
  const Vec3 n = oblique_normal(), u = n.cross(Vec3::UnitX()).normalized(), v = n.cross(u), at = oblique_point();
  const Vec3 a = nearest(at + 0.28 * u), b = nearest(at - 0.2 * u + 0.22 * v), c = nearest(at - 0.25 * v);
  const Vec3 normal = (b - a).cross(c - a).normalized();
  return plane_of(soup, normal, normal.dot(a) + beside);
}

/// The part of a direction along which a point of the unit cube stays on the faces that it lies on.
inline Vec3 free_part(const Vec3& point, Vec3 direction) {
  for (int axis = 0; axis < 3; ++axis) {
    if (point[axis] == 0 || point[axis] == 1) direction[axis] = 0;
  }
  return direction;
}

/// Moves a point of the unit cube to a height above a plane, where that leaves all tets a tenth of their volume.
inline void move_to_height(TetSoup& soup, std::uint32_t point, const Vec3& normal, double offset, double height) {
  const Vec3 old = soup.points[point], along = free_part(old, normal);
  const auto volumes = [&] {
    std::vector<double> list;
    for (const auto& [a, b, c, d] : soup.tets) {
      if (a == point || b == point || c == point || d == point) {
        list.push_back(signed_volume6(soup.points[a], soup.points[b], soup.points[c], soup.points[d]));
      }
    }
    return list;
  };
  if (along.dot(normal) < 0.1) return;
  const std::vector<double> before = volumes();
  soup.points[point] = old + (height - (normal.dot(old) - offset)) / along.dot(normal) * along;
  const std::vector<double> after = volumes();
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (after[i] < 0.1 * before[i]) {
      soup.points[point] = old;
      return;
    }
  }
}

/// A jittered cube with a carpet of vertices right beside the oblique plane, on either side by turns.
inline TetSoup cube_with_carpet(std::uint32_t n, std::uint64_t seed) {
  TetSoup soup = jittered_cube(n, seed);
  const Vec3 normal = oblique_normal();
  const double offset = normal.dot(oblique_point()), h = 1.0 / n;
  for (std::uint32_t i = 0; i < soup.points.size(); ++i) {
    if (std::abs(normal.dot(soup.points[i]) - offset) < 0.15 * h) {
      move_to_height(soup, i, normal, offset, (i % 2 == 0 ? 1e-3 : -1e-3) * h);
    }
  }
  return soup;
}

/// A jittered cube with a layer of vertices right below a plane that is nearly along the axes.
inline Case layer_case(std::uint32_t n, std::uint64_t seed) {
  TetSoup soup = jittered_cube(n, seed);
  const std::uint32_t layer = n / 2;
  const Vec3 normal = Vec3(1, 0.02, -0.013).normalized();
  const double offset = normal.dot(Vec3(static_cast<double>(layer) / n, 0.5, 0.5));
  for (std::uint32_t i = layer; i < soup.points.size(); i += n + 1) {
    move_to_height(soup, i, normal, offset, -1e-3 / n);
  }
  const Stroke stroke = plane_of(soup, normal, offset);
  return {"D", std::move(soup), {stroke}};
}

/// A smooth sheet with an amplitude of 0.08 of the cube, slightly tilted.
inline Stroke wavy_sheet(unsigned quads) {
  std::vector<std::vector<Vec3>> edges;
  for (unsigned j = 0; j <= quads; ++j) {
    auto& edge = edges.emplace_back();
    for (unsigned i = 0; i <= quads; ++i) {
      const double x = -0.1 + 1.2 * i / quads, y = -0.1 + 1.2 * j / quads;
      const double wave = 0.08 * on_circle(x + 0.0637).second * on_circle(y - 0.0477).first;
      edge.emplace_back(x, y, 0.507 + wave + 0.11 * (x - 0.5) - 0.07 * (y - 0.5));
    }
  }
  return stroke_of(std::move(edges));
}

/// A flat blade that stops inside the cube.
inline Stroke partial_stroke() {
  return quad_stroke(Vec3(0.52, -0.2, -0.2), Vec3(0.47, -0.2, 1.2), Vec3(0.55, 0.6, -0.2), Vec3(0.5, 0.6, 1.2));
}

/// The hard planar cuts of the study, by letter: generic, beside vertices, through a carpet, beside a layer.
inline Case planar_case(char letter, std::uint32_t n, std::uint64_t seed) {
  TetSoup soup = letter == 'C' ? cube_with_carpet(n, seed) : jittered_cube(n, seed);
  const Stroke stroke = letter == 'B' ? plane_beside_vertices(soup, 1e-3 / n) : oblique_plane(soup);
  return letter == 'D' ? layer_case(n, seed) : Case{std::string(1, letter), std::move(soup), {stroke}};
}

/// One of every kind of cut.
inline std::vector<Case> all_kinds_of_cuts() {
  std::vector<Case> cases;
  cases.push_back(planar_case('A', 4, 1));
  cases.push_back(planar_case('C', 4, 2));
  cases.push_back({"wavy", jittered_cube(4, 3), {wavy_sheet(16)}});
  cases.push_back({"coring", jittered_cube(5, 6), {coring_stroke(Vec3(0.5, 0.5, 0), 0.3, 24, -0.2, 1.2)}});
  cases.push_back({"partial", jittered_cube(4, 4), {partial_stroke()}});
  TetSoup crossed = jittered_cube(4, 5);
  const Stroke one = plane_of(crossed, Vec3(1, 0.2, 0.1), 0.6), two = plane_of(crossed, Vec3(0.1, 1, 0.2), 0.6);
  cases.push_back({"crossing", std::move(crossed), {one, two}});
  TetSoup round = ball(6);
  const Stroke through = plane_of(round, Vec3(0.3, 0.5, 0.9), 0.1);
  cases.push_back({"ball", std::move(round), {through}});
  return cases;
}

/// Which vertices the journal's steps from a position on made, copied or moved, and those on cut walls.
inline std::vector<bool> touched_vertices(const Engine& engine, std::size_t first_step = 0) {
  std::vector<bool> is_touched(engine.mesh().vertex_slots(), false);
  for (std::size_t i = first_step; i < engine.journal().position(); ++i) {
    const Step& step = engine.journal().step(i);
    for (const BornVertex& v : step.born) is_touched[v.id.value] = true;
    for (const MovedVertex& v : step.moved) is_touched[v.id.value] = true;
    for (const CopiedVertex& v : step.copied) is_touched[v.id.value] = is_touched[v.source.value] = true;
  }
  engine.mesh().for_each_vertex([&](VertexId v) {
    if ((engine.mesh().shape_of(v) & shape::kWall) != 0) is_touched[v.value] = true;
  });
  return is_touched;
}

/// The quality of the tets that have such a vertex.
inline QualityStats touched_quality(const Engine& engine, std::size_t first_step = 0) {
  const std::vector<bool> is_touched = touched_vertices(engine, first_step);
  return measure_quality(engine.mesh(), [&](TetId tet) {
    const TetVertices& v = engine.mesh().vertices(tet);
    return std::any_of(v.begin(), v.end(), [&](VertexId id) { return is_touched[id.value]; });
  });
}

}  // namespace incise::test
