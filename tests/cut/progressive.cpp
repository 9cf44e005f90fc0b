// SPDX-License-Identifier: Apache-2.0
#include "cut/progressive.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "incise/geom/quality.h"
#include "incise/geom/triangle_tree.h"
#include "support/strokes.h"

namespace incise::test {
namespace {

using Segment = std::array<Vec3, 2>;

Engine engine_on(const TetSoup& soup, const SteppedOptions& options) {
  EngineOptions all;
  all.cut.snap = options.snap;
  all.maintain.merge = all.maintain.improve = options.maintains;
  Result<Engine> engine = Engine::create(build(soup), all);
  EXPECT_TRUE(engine.ok());
  return std::move(engine).value();
}

// --- borders
// ------------------------------------------------------------------------------------------------------------------

/// The edges at which the two walls of a cut meet: two wall sides with the same third corner at rest.
std::vector<Segment> front_of(const TetMesh& mesh, std::uint32_t tag) {
  std::map<std::array<std::uint32_t, 2>, std::vector<VertexId>> thirds;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (mesh.links(tet)[s] != Link::boundary(tag)) continue;
      const auto v = mesh.vertices(Side(tet, s));
      for (unsigned k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(v[k].value, v[(k + 1) % 3].value);
        thirds[{low, high}].push_back(v[(k + 2) % 3]);
      }
    }
  });
  std::vector<Segment> front;
  for (const auto& [edge, third] : thirds) {
    if (third.size() == 2 && mesh.rest(third[0]) == mesh.rest(third[1])) {
      front.push_back({mesh.rest(VertexId(edge[0])), mesh.rest(VertexId(edge[1]))});
    }
  }
  return front;
}

std::vector<Segment> border_of(const Stroke& stroke) {
  std::vector<Segment> border;
  for (const auto* edge : {&stroke.edges.front(), &stroke.edges.back()}) {
    for (std::size_t i = 0; i + 1 < edge->size(); ++i) border.push_back({(*edge)[i], (*edge)[i + 1]});
  }
  for (std::size_t i = 0; i + 1 < stroke.edges.size(); ++i) {
    border.push_back({stroke.edges[i].front(), stroke.edges[i + 1].front()});
    border.push_back({stroke.edges[i].back(), stroke.edges[i + 1].back()});
  }
  return border;
}

/// Points along segments, evenly spaced.
std::vector<Vec3> samples_on(const std::vector<Segment>& segments, double spacing) {
  std::vector<Vec3> points;
  for (const auto& [a, b] : segments) {
    const double count = std::ceil((b - a).norm() / spacing);
    for (double i = 0.5; i < count; ++i) points.emplace_back(a + i / count * (b - a));
  }
  return points;
}

bool is_inside(const TetMesh& mesh, TetId tet, const Vec3& point) {
  const TetVertices& v = mesh.vertices(tet);
  for (unsigned c = 0; c < 4; ++c) {
    std::array<Vec3, 4> corners;
    for (unsigned k = 0; k < 4; ++k) corners[k] = k == c ? point : mesh.rest(v[k]);
    if (signed_volume6(corners[0], corners[1], corners[2], corners[3]) < 0) return false;
  }
  return true;
}

std::vector<Vec3> inside_of(const TetMesh& mesh, const std::vector<Vec3>& points) {
  std::vector<Vec3> inside;
  for (const Vec3& point : points) {
    bool is_found = false;
    mesh.for_each_tet([&](TetId tet) { is_found = is_found || is_inside(mesh, tet, point); });
    if (is_found) inside.push_back(point);
  }
  return inside;
}

/// One way: how far points lie from segments.
Deviation deviation_of(const std::vector<Vec3>& points, const std::vector<Segment>& from) {
  std::vector<Vec3> ends;
  std::vector<TriangleTree::Triangle> flat;
  for (const auto& [a, b] : from) {
    const auto first = static_cast<std::uint32_t>(ends.size());
    ends.insert(ends.end(), {a, b});
    flat.push_back({first, first + 1, first + 1});
  }
  const TriangleTree tree(ends, flat);
  Deviation result;
  for (const Vec3& point : points) {
    const double distance = std::sqrt(tree.closest(point).distance2);
    result.greatest = std::max(result.greatest, distance);
    result.mean += distance / static_cast<double>(points.size());
  }
  return result;
}

constexpr double kSpacing = 0.02;  // of h, between samples on borders

GridPoint to_grid(const Vec3& p) {
  constexpr double kCells = 1e7;
  constexpr double kShift = 0.3819660113;  // keeps round numbers away from the rounding
  return {std::llround(p.x() * kCells + kShift), std::llround(p.y() * kCells + kShift),
          std::llround(p.z() * kCells + kShift)};
}

}  // namespace

// --- the engine
// ---------------------------------------------------------------------------------------------------------------

std::vector<BladePose> poses_of(const Stroke& stroke) {
  std::vector<BladePose> poses;
  for (const auto& edge : stroke.edges) poses.push_back({edge, Vec3::Zero()});
  return poses;
}

Stroke subdivided(const Stroke& stroke, unsigned parts) {
  std::vector<std::vector<Vec3>> edges = {stroke.edges.front()};
  for (std::size_t i = 0; i + 1 < stroke.edges.size(); ++i) {
    for (unsigned part = 1; part <= parts; ++part) {
      edges.push_back(stroke.edges[i + 1]);
      if (part == parts) break;
      const double rest = 1.0 - static_cast<double>(part) / parts;
      for (std::size_t k = 0; k < edges.back().size(); ++k) {
        edges.back()[k] += rest * (stroke.edges[i][k] - stroke.edges[i + 1][k]);
      }
    }
  }
  return stroke_of(std::move(edges));
}

std::vector<Vec3> divided_edge(const Vec3& a, const Vec3& b, unsigned parts) {
  std::vector<Vec3> edge;
  for (unsigned i = 0; i <= parts; ++i) edge.emplace_back(a + static_cast<double>(i) / parts * (b - a));
  return edge;
}

SteppedEngine::SteppedEngine(const TetSoup& soup, SteppedOptions options)
    : engine_(engine_on(soup, options)), input_(build(soup)), body_(input_), volume_(volume_of(input_)) {}

SteppedEngine::~SteppedEngine() {
  expect_back_and_forth();
}

bool SteppedEngine::expect_sound() const {
  ValidateOptions options;
  options.expected_volume = volume_;
  const ValidityReport report = validate(mesh(), ValidateLevel::kGeometry, options);
  EXPECT_TRUE(report.ok) << describe(report);
  return report.ok;
}

bool SteppedEngine::begin(const BladePose& pose) {
  const std::uint64_t hash = mesh().hash();
  const Result<std::uint32_t> number = engine_.begin_stroke(pose);
  EXPECT_TRUE(number.ok()) << number.error().message;
  EXPECT_EQ(mesh().hash(), hash) << "a blade that is put in place cuts nothing";
  return number.ok();
}

bool SteppedEngine::step(const BladePose& pose) {
  const Result<StepReport> report = engine_.step(pose);
  EXPECT_TRUE(report.ok()) << report.error().message;
  return report.ok() && expect_sound();
}

std::uint32_t SteppedEngine::end() {
  const Result<StrokeReport> report = engine_.end_stroke();
  EXPECT_TRUE(report.ok()) << report.error().message;
  expect_sound();
  return report.ok() ? report->stroke : 0;
}

std::uint32_t SteppedEngine::run(const Stroke& stroke, const std::function<void(std::size_t)>& before_step) {
  for (std::size_t i = 0; i < stroke.edges.size(); ++i) {
    SCOPED_TRACE(testing::Message() << "pose " << i << " of " << stroke.edges.size());
    if (before_step) before_step(i);
    const BladePose pose{stroke.edges[i], Vec3::Zero()};
    if (!(i == 0 ? begin(pose) : step(pose))) break;
  }
  return end();
}

void SteppedEngine::deform(const std::function<Vec3(VertexId)>& place) {
  std::vector<Vec3> positions(mesh().vertex_slots(), Vec3::Zero());
  mesh().for_each_vertex([&](VertexId v) { positions[v.value] = place(v); });
  const Status status = engine_.set_positions(positions);
  ASSERT_TRUE(status.ok()) << status.error().message;
}

void SteppedEngine::expect_back_and_forth() {
  const std::uint64_t last = mesh().hash();
  while (engine_.undo()) {
  }
  EXPECT_EQ(mesh().hash(), input_.hash()) << "undo does not restore the input";
  while (engine_.redo()) {
  }
  EXPECT_EQ(mesh().hash(), last) << "redo does not restore the cut";
}

// --- measures
// -----------------------------------------------------------------------------------------------------------------

Deviation border_deviation(const SteppedEngine& stepped, const Stroke& stroke, std::uint32_t tag) {
  const std::vector<Segment> front = front_of(stepped.mesh(), tag), border = border_of(stroke);
  const double spacing = kSpacing * stepped.h();
  const std::vector<Vec3> wanted = inside_of(stepped.input(), samples_on(border, spacing));
  EXPECT_FALSE(front.empty());
  const Deviation found = deviation_of(samples_on(front, spacing), border), missed = deviation_of(wanted, front);
  return {std::max(found.greatest, missed.greatest), std::max(found.mean, missed.mean)};
}

double border_length(const SteppedEngine& stepped, const Stroke& stroke) {
  const double spacing = kSpacing * stepped.h();
  return spacing * static_cast<double>(inside_of(stepped.input(), samples_on(border_of(stroke), spacing)).size());
}

double boundary_area(const TetMesh& mesh) {
  double twice = 0;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (!mesh.links(tet)[s].is_boundary()) continue;
      const auto v = mesh.vertices(Side(tet, s));
      twice += (mesh.rest(v[1]) - mesh.rest(v[0])).cross(mesh.rest(v[2]) - mesh.rest(v[0])).norm();
    }
  });
  return 0.5 * twice;
}

std::size_t count_bad_tets(const TetMesh& mesh) {
  std::size_t count = 0;
  mesh.for_each_tet([&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    const double shape = longest_edge_over_inradius(mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3]));
    count += shape <= 200 ? 0U : 1U;
  });
  return count;
}

std::vector<std::array<GridPoint, 4>> tets_by_place(const TetMesh& mesh) {
  std::vector<std::array<GridPoint, 4>> tets;
  mesh.for_each_tet([&](TetId tet) {
    auto& corners = tets.emplace_back();
    for (unsigned c = 0; c < 4; ++c) corners[c] = to_grid(mesh.rest(mesh.vertices(tet)[c]));
    std::sort(corners.begin(), corners.end());
  });
  std::sort(tets.begin(), tets.end());
  return tets;
}

std::vector<GridPoint> walls_by_place(const TetMesh& mesh) {
  std::vector<GridPoint> points;
  mesh.for_each_vertex([&](VertexId v) {
    if ((mesh.shape_of(v) & shape::kWall) != 0) points.push_back(to_grid(mesh.rest(v)));
  });
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

}  // namespace incise::test
