// SPDX-License-Identifier: Apache-2.0
#include "compose/compose_run.h"

#include <cmath>
#include <utility>

#include "incise/engine/engine.h"
#include "incise/mesh/components.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/validate.h"

namespace incise::test {
namespace {

/// A body and a blade under one map.
class Operation {
 public:
  Operation(const TetSoup& soup, Stance stance)
      : engine_(Engine::create(TetMesh::build(soup).value()).value()), stance_(stance) {
    stand();
  }

  bool stroke(const BladePath& path) {
    stand();
    Status status = error_of(engine_.begin_stroke(pose(path.front())));
    for (std::size_t i = 1; status && i < path.size(); ++i) {
      stand();
      status = error_of(engine_.step(pose(path[i])));
    }
    if (status) status = error_of(engine_.end_stroke());
    if (!status) outcome_.error = status.error().message;
    return status.ok();
  }
  bool last_stroke_again(const BladePath& path) {
    const std::uint64_t after = engine_.mesh().hash();
    const bool is_undone = engine_.undo() && engine_.redo() && engine_.mesh().hash() == after && engine_.undo();
    outcome_.is_undone = is_undone && engine_.mesh().hash() == before_last_;
    return stroke(path);
  }
  void note() { before_last_ = engine_.mesh().hash(); }

  ComposeOutcome review() {
    const TetMesh& mesh = engine_.mesh();
    const ValidityReport report = validate(mesh, ValidateLevel::kGeometry);
    if (outcome_.error.empty() && !report.ok) outcome_.error = "not valid";
    outcome_.pieces = find_components(mesh).count();
    outcome_.tets = mesh.tet_count();
    outcome_.lr = measure_quality(mesh).lr_max;
    outcome_.area = wall_area(mesh);
    return outcome_;
  }

 private:
  template <class T>
  static Status error_of(const Result<T>& result) {
    return result ? Status() : Status(result.error());
  }
  [[nodiscard]] Vec3 map(const Vec3& p) const {
    switch (stance_) {
      case Stance::kSheared:
        return {p.x() + 0.3 * p.z(), p.y(), p.z()};
      case Stance::kStretched:
        return {1.4 * p.x(), p.y(), p.z()};
      case Stance::kSwaying: {
        const double s = std::sin(0.1 * moment_);
        return {p.x() * (1 + 0.1 * s) + 0.2 * s * p.z(), p.y(), p.z() + 0.1 * s * p.y()};
      }
      default:
        return p;
    }
  }
  void stand() {
    if (stance_ == Stance::kRest) return;
    ++moment_;
    const TetMesh& mesh = engine_.mesh();
    std::vector<Vec3> positions(mesh.vertex_slots());
    for (std::uint32_t slot = 0; slot < mesh.vertex_slots(); ++slot) positions[slot] = map(mesh.rest(VertexId(slot)));
    static_cast<void>(engine_.set_positions(positions));
  }
  [[nodiscard]] BladePose pose(const Row& row) const {
    BladePose pose;
    for (const Vec3& p : row) pose.edge.push_back(map(p));
    return pose;
  }
  static double wall_area(const TetMesh& mesh) {
    double twice = 0;
    mesh.for_each_tet([&](TetId tet) {
      for (unsigned s = 0; s < 4; ++s) {
        const Link link = mesh.links(tet)[s];
        if (!link.is_boundary() || link.tag() == 0) continue;
        const auto v = mesh.vertices(Side(tet, s));
        twice += 0.5 * (mesh.rest(v[1]) - mesh.rest(v[0])).cross(mesh.rest(v[2]) - mesh.rest(v[0])).norm();
      }
    });
    return 0.5 * twice;
  }

  Engine engine_;
  Stance stance_;
  double moment_ = 0;
  std::uint64_t before_last_ = 0;
  ComposeOutcome outcome_;
};

}  // namespace

ComposeOutcome make_strokes(const TetSoup& soup, const BladePaths& strokes, Stance stance, bool again) {
  Operation operation(soup, stance);
  for (const BladePath& path : strokes) {
    operation.note();
    if (!operation.stroke(path)) return operation.review();
  }
  if (again) operation.last_stroke_again(strokes.back());
  return operation.review();
}

ComposeFigures measure_row(const TetSoup& soup, const ComposeRow& row, Stance stance, bool again) {
  ComposeFigures figures{make_strokes(soup, row.strokes, stance, again)};
  const auto uncut = static_cast<double>(soup.tets.size());
  double tets = uncut, area = 0;
  for (const BladePath& path : row.single) {
    const ComposeOutcome one = make_strokes(soup, {path}, stance, false);
    tets += static_cast<double>(one.tets) - uncut;
    area += one.area;
  }
  figures.growth = static_cast<double>(figures.outcome.tets) / tets;
  figures.area = figures.outcome.area / area;
  return figures;
}

bool holds(const ComposeRow& row, const ComposeFigures& figures) {
  const ComposeOutcome& outcome = figures.outcome;
  return outcome.error.empty() && outcome.is_undone && outcome.pieces == row.pieces && outcome.lr <= kMostLr &&
         figures.growth <= row.growth;
}

}  // namespace incise::test
