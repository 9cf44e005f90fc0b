// SPDX-License-Identifier: Apache-2.0
#include "soak/motion_run.h"

#include <cmath>
#include <optional>
#include <utility>

#include "app/jobs/cut_job.h"
#include "incise/engine/engine.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/validate.h"
#include "soak/watch.h"

namespace incise::test {
namespace {

/// Bodies up to here are looked at after every step.
constexpr std::size_t kSmallBody = 6000;

Engine engine_for(const MotionCase& motion) {
  EngineOptions options;
  options.cut.snap = motion.snap;
  options.maintain.merge = options.maintain.improve = motion.maintains;
  TetMesh mesh = TetMesh::build(make_body(motion.body)).value();
  return Engine::create(std::move(mesh), options).value();
}

class MotionRun {
 public:
  explicit MotionRun(const MotionCase& motion)
      : motion_(motion),
        engine_(engine_for(motion)),
        topology_(validate(engine_.mesh(), ValidateLevel::kTopology)),
        geometry_(validate(engine_.mesh(), ValidateLevel::kGeometry)),
        first_hash_(engine_.mesh().hash()) {
    const Box box = rest_bounds(engine_.mesh());
    diagonal_ = (box.hi - box.lo).norm();
  }

  Outcome run() {
    while (outcome_.strokes < motion_.strokes.size() && is_fine()) cut(motion_.strokes[outcome_.strokes++]);
    if (is_fine()) go_back();
    stop_watching();
    return outcome_;
  }

 private:
  [[nodiscard]] bool is_fine() const { return outcome_.fault == Fault::kNone; }
  void fail(Fault fault, const std::string& what) {
    if (is_fine()) outcome_ = {fault, doing_ + ": " + what, outcome_.strokes};
  }
  void expect_hash(std::uint64_t hash, Fault fault, const std::string& after) {
    if (engine_.mesh().hash() != hash) fail(fault, "another hash after " + after);
  }
  void begin(const std::string& what) {
    doing_ = "stroke " + std::to_string(outcome_.strokes - 1) + " (" + motion_.strokes[outcome_.strokes - 1].policy +
             "), " + what;
    watch("seed " + std::to_string(motion_.seed) + ", " + doing_);
  }

  // One stroke.
  void cut(const MotionStroke& stroke) {
    const std::uint64_t before = engine_.mesh().hash();
    begin("start");
    deform(0);
    if (const auto begun = engine_.begin_stroke({stroke.edges[0], Vec3::Zero()}); !begun.ok()) {
      return fail(Fault::kRefused, begun.error().message);
    }
    for (std::size_t i = 1; i < stroke.edges.size() && is_fine(); ++i) step(stroke, i);
    if (is_fine() && stroke.is_aborted) abort(before);
    if (is_fine() && engine_.is_in_stroke()) end();
    if (is_fine() && engine_.mesh().hash() != before) go_back_one(before);
  }
  void step(const MotionStroke& stroke, std::size_t i) {
    begin("step " + std::to_string(i) + " of " + std::to_string(stroke.edges.size() - 1));
    deform(static_cast<double>(i) / static_cast<double>(stroke.edges.size()));
    if (const auto done = engine_.step({stroke.edges[i], Vec3::Zero()}); !done.ok()) {
      return fail(Fault::kRefused, done.error().message);
    }
    if (engine_.mesh().tet_count() <= kSmallBody) check(topology_, ValidateLevel::kTopology);
  }
  void end() {
    begin("end");
    if (const auto done = engine_.end_stroke(); !done.ok()) return fail(Fault::kRefused, done.error().message);
    check(geometry_, ValidateLevel::kGeometry);
  }
  /// Takes the stroke under way back, and goes on with what redo brings again, which is no longer under way.
  void abort([[maybe_unused]] std::uint64_t before) {
#ifdef INCISE_TEST_PROGRESSIVE
    begin("undo under way");
    const std::uint64_t cut = engine_.mesh().hash();
    if (cut == before) return;
    if (!engine_.undo() || engine_.is_in_stroke()) fail(Fault::kUndo, "undo does not end a stroke under way");
    expect_hash(before, Fault::kUndo, "undo");
    if (!engine_.redo()) fail(Fault::kRedo, "nothing to redo");
    expect_hash(cut, Fault::kRedo, "redo");
    check(geometry_, ValidateLevel::kGeometry);
#endif
  }

  // Where the body stands.
  void deform(double t) {
    if (motion_.wave == 0) return;
    const TetMesh& mesh = engine_.mesh();
    std::vector<Vec3> positions(mesh.vertex_slots(), Vec3::Zero());
    mesh.for_each_vertex([&](VertexId v) { positions[v.value] = waved(mesh.rest(v), t, motion_.wave, diagonal_); });
    if (const Status status = engine_.set_positions(positions); !status.ok()) {
      fail(Fault::kRefused, status.error().message);
    }
  }

  // What must hold.
  void check(const ValidityReport& input, ValidateLevel level) {
    const ValidityReport now = validate(engine_.mesh(), level);
    const ValidityChange change = compare_with_input(input, now);
    std::string grown;
    for (std::size_t kind = 0; kind < kViolationKinds; ++kind) {
      if (change.grown[kind] == 0) continue;
      grown += " +" + std::to_string(change.grown[kind]) + " " + std::string(name_of(static_cast<ViolationKind>(kind)));
    }
    if (!grown.empty()) fail(Fault::kInvalid, grown);
    if (level != ValidateLevel::kGeometry) return;
    const double drift = std::abs(now.volume - input.volume) / input.volume;
    if (!(drift <= app::volume_tolerance(engine_.options()))) {
      fail(Fault::kVolume, "drift " + std::to_string(drift * 1e12) + "e-12");
    }
  }
  void go_back_one(std::uint64_t before) {
    begin("undo and redo");
    const std::uint64_t after = engine_.mesh().hash();
    if (!engine_.undo()) fail(Fault::kUndo, "nothing to undo");
    expect_hash(before, Fault::kUndo, "undo");
    if (!engine_.redo()) fail(Fault::kRedo, "nothing to redo");
    expect_hash(after, Fault::kRedo, "redo");
  }
  void go_back() {
    begin("all back and again");
    const std::uint64_t last = engine_.mesh().hash();
    while (engine_.undo()) {
    }
    expect_hash(first_hash_, Fault::kUndo, "all undone");
    while (engine_.redo()) {
    }
    expect_hash(last, Fault::kRedo, "all redone");
  }

  const MotionCase& motion_;
  Engine engine_;
  ValidityReport topology_, geometry_;
  std::uint64_t first_hash_;
  double diagonal_ = 0;
  std::string doing_;
  Outcome outcome_;
};

}  // namespace

Outcome run_case(const MotionCase& motion) {
  return MotionRun(motion).run();
}

}  // namespace incise::test
