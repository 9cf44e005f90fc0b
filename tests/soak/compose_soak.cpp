// SPDX-License-Identifier: Apache-2.0
// The body's motion is affine, so that the blade's straight edge is straight in the rest shape, too: the strokes make
// the row's sheet whatever the body does.
#include "soak/compose_soak.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "compose/compose_rows.h"
#include "incise/engine/engine.h"
#include "incise/mesh/components.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/validate.h"
#include "soak/watch.h"
#include "support/bodies.h"
#include "support/random.h"

namespace incise::test {
namespace {

/// Rows of more strokes are retraces and very short strokes, which the table's own tests have.
constexpr std::size_t kMostStrokes = 14;
constexpr double kBadLr = 60;
constexpr double kTurn = 6.283185307179586;

enum class Stance : std::uint8_t { kRest, kMovedBetween, kMovedWithin };

struct Tally {
  std::uint64_t rows = 0, failures = 0;
  std::array<std::uint64_t, 3> of{}, other_pieces{}, bad{};  // by stance
};

/// A cube, jittered unless that would turn a tet inside out.
TetMesh body_of(std::uint64_t seed) {
  const TetSoup even = kuhn_cube(seed % 3 == 0 ? 5 : 6);
  TetSoup jittered = even;
  if (seed % 4 != 0) jitter(jittered, 0.2, seed);
  Result<TetMesh> mesh = TetMesh::build(jittered);
  return mesh ? std::move(mesh).value() : TetMesh::build(even).value();
}

/// One row of the table in one body.
class Composition {
 public:
  Composition(const ComposeRow& row, std::uint64_t seed, Tally& tally)
      : row_(row), seed_(seed), tally_(tally), random_(seed), engine_(Engine::create(body_of(seed)).value()) {
    stance_ = static_cast<Stance>(random_.integer(0, 2));
    amplitude_ = random_.real(0.3, 3);
    rate_ = random_.real(0.02, 0.5);
    for (double& angle : angles_) angle = random_.real(0, kTurn);
  }

  void run() {
    const std::uint64_t fresh = engine_.mesh().hash();
    bool is_sound = true;
    for (stroke_ = 0; is_sound && stroke_ < row_.strokes.size(); ++stroke_) {
      watch(name());
      is_sound = cut(row_.strokes[stroke_]) && (random_.integer(0, 3) > 0 || undo_and_redo());
    }
    if (is_sound) count();
    while (engine_.undo()) {
    }
    if (is_sound && engine_.mesh().hash() != fresh) fail("undo does not give back the body");
    stop_watching();
  }

 private:
  [[nodiscard]] std::string name() const {
    return "seed " + std::to_string(seed_) + ", row '" + row_.name + "', stroke " + std::to_string(stroke_);
  }
  bool fail(const std::string& what) {
    ++tally_.failures;
    std::printf("FAILED %s: %s\n", name().c_str(), what.c_str());
    return false;
  }
  [[nodiscard]] Vec3 map(const Vec3& p) const {
    const double s = stance_ == Stance::kRest ? 0.0 : amplitude_ * std::sin(rate_ * moment_);
    return {p.x() * (1 + 0.1 * s) + 0.2 * s * p.z(), p.y(), p.z() + 0.1 * s * p.y()};
  }
  /// A place of the table, turned about the middle of the cube and taken to where the body stands.
  [[nodiscard]] Vec3 place(const Vec3& in_table) const {
    Vec3 p = in_table - Vec3(0.5, 0.5, 0.5);
    for (unsigned axis = 0; axis < 3; ++axis) {
      const unsigned u = (axis + 1) % 3, v = (axis + 2) % 3;
      const double c = std::cos(angles_[axis]), s = std::sin(angles_[axis]), pu = p[u], pv = p[v];
      p[u] = c * pu - s * pv;
      p[v] = s * pu + c * pv;
    }
    return map(p + Vec3(0.5, 0.5, 0.5));
  }
  [[nodiscard]] BladePose pose(const Row& row) const {
    BladePose now;
    for (const Vec3& p : row) now.edge.push_back(place(p));
    return now;
  }
  void move() {
    ++moment_;
    if (stance_ == Stance::kRest) return;
    const TetMesh& mesh = engine_.mesh();
    std::vector<Vec3> positions;
    for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) positions.push_back(map(mesh.rest(VertexId(v))));
    static_cast<void>(engine_.set_positions(positions));
  }
  template <class T>
  bool is_done(const Result<T>& result, const char* where) {
    if (!result.ok()) return fail(result.error().message);
    const ValidityReport report = validate(engine_.mesh(), ValidateLevel::kGeometry);
    return report.ok || fail(std::string(name_of(report.first.front().kind)) + " after " + where);
  }
  bool cut(const BladePath& path) {
    move();
    if (!is_done(engine_.begin_stroke(pose(path.front())), "its begin")) return false;
    for (std::size_t i = 1; i < path.size(); ++i) {
      if (stance_ == Stance::kMovedWithin) move();
      if (!is_done(engine_.step(pose(path[i])), "a step")) return false;
    }
    return is_done(engine_.end_stroke(), "its end");
  }
  bool undo_and_redo() {
    const std::uint64_t after = engine_.mesh().hash();
    if (!engine_.undo()) return fail("it cannot be undone");
    move();
    if (!engine_.redo()) return fail("it cannot be redone");
    return engine_.mesh().hash() == after || fail("redo gives another mesh");
  }
  void count() {
    const auto at = static_cast<std::size_t>(stance_);
    ++tally_.of[at];
    if (!row_.is_short && find_components(engine_.mesh()).count() != row_.pieces) ++tally_.other_pieces[at];
    if (measure_quality(engine_.mesh()).lr_max > kBadLr) ++tally_.bad[at];
  }

  const ComposeRow& row_;
  std::uint64_t seed_;
  Tally& tally_;
  Random random_;
  Engine engine_;
  Stance stance_ = Stance::kRest;
  double amplitude_ = 0, rate_ = 0, moment_ = 0;
  std::array<double, 3> angles_{};
  std::size_t stroke_ = 0;
};

}  // namespace

int soak_compositions(const ComposeLimits& limits) {
  std::vector<ComposeRow> rows;
  for (ComposeRow& row : compose_rows()) {
    if (row.strokes.size() <= kMostStrokes) rows.push_back(std::move(row));
  }
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  Tally tally;
  const std::uint64_t rounds = limits.rounds > 0 ? limits.rounds : (limits.seconds > 0 ? UINT64_MAX : 300);
  for (; tally.rows < rounds && (limits.seconds <= 0 || elapsed() < limits.seconds); ++tally.rows) {
    const std::uint64_t seed = limits.seed + tally.rows;
    Composition(rows[Random(seed * 7919).bits() % rows.size()], seed, tally).run();
  }
  constexpr std::array<const char*, 3> kNames = {"at rest", "moved between strokes", "moved within strokes"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    std::printf("%-22s %5llu rows, %4llu with other pieces, %4llu with L/r > 60\n", kNames[i],
                static_cast<unsigned long long>(tally.of[i]), static_cast<unsigned long long>(tally.other_pieces[i]),
                static_cast<unsigned long long>(tally.bad[i]));
  }
  std::printf("compose: %llu rows, %llu failures, %.0f s\n", static_cast<unsigned long long>(tally.rows),
              static_cast<unsigned long long>(tally.failures), elapsed());
  return tally.failures == 0 ? 0 : 1;
}

}  // namespace incise::test
