// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "incise/core/log.h"
#include "incise/core/profile.h"
#include "incise/core/result.h"
#include "incise/cut/options.h"
#include "incise/cut/stroke.h"
#include "incise/improve/options.h"
#include "incise/mesh/journal.h"
#include "incise/mesh/step_check.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// How an engine works.
struct EngineOptions {
  CutOptions cut;            ///< how the blade cuts
  MaintainOptions maintain;  ///< what is done to the mesh behind the blade
  LogSink log;               ///< told where a stroke was not done as asked
  unsigned threads = 1;      ///< that search the mesh, in [1, 256]; the result does not depend on it
  /// Checks what each call committed, after the cut and after its maintenance. Where it returns an error, the call is
  /// taken back and returns that error. `TouchedCheck` in builds with assertions; empty, and without cost, in others.
  StepCheck check_step = default_step_check();
};

/// What one stroke did.
struct StrokeReport {
  CutStatistics cut;            ///< what cutting did
  MaintainStatistics maintain;  ///< what maintenance did
  StageTimes times;             ///< summed over the stroke
  std::vector<double> step_ms;  ///< one entry for each step; one for a stroke that was cut as a whole
  std::uint32_t stroke = 0;     ///< its number: the tag of the walls that it made; see `Engine::next_stroke`
};

/// The blade at one moment.
struct BladePose {
  static constexpr double kMostSlicing = 100;  ///< the greatest `slicing`

  std::vector<Vec3> edge;         ///< the cutting edge as a polyline, at least 2 points, as the body stands now
  Vec3 direction = Vec3::Zero();  ///< where the edge cuts, of any length; zero: where it moves
  /// How fast the edge moves along itself, by how fast it is pushed, in [0, kMostSlicing]: a ring that is twisted, an
  /// edge that saws. What moves it pays its share of the toughness, and the push bears 1 / (1 + slicing²) of it
  /// (Atkins, Xu and Jeronimidis 2004, doi:10.1023/B:JMSC.0000021451.17182.86). Only a body with toughness knows; the
  /// cut is the same.
  double slicing = 0;
};

/// What one step of the blade did.
struct StepReport {
  CutStatistics cut;            ///< what cutting did
  MaintainStatistics maintain;  ///< of what the blade has left behind
  StageTimes times;             ///< ms by stage
};

/// What maintenance between strokes did.
struct MaintainReport {
  MaintainStatistics maintain;  ///< counts
  StageTimes times;             ///< ms by stage
};

/// Owns a mesh and orders the pipeline on it: collision → subdivide → separate → merge → improve (paper, Figure 1).
///
/// A stroke is cut as a whole (`cut`) or step by step as the blade moves (`begin_stroke`, `step`, `end_stroke`), in a
/// body at rest or one that moves (`set_positions`). After each step the mesh is valid and cut up to the blade, inside
/// elements. The profile `paper` cuts whole elements in each step, and lags by the ones that the blade is still in; it
/// merges and maintains when a stroke ends, but for the tets at the front of an incision that the next stroke may go on
/// from (docs/decisions/0050).
/// Maintenance follows the blade at a small distance, a band around the front of the cut, and ends with the stroke.
/// Each call spends at most `MaintainOptions::work_units`; what is left undone waits for the next call or `maintain`.
/// One writer; const reads from any thread between calls. A call either takes effect as a whole or not at all; where it
/// fails with kOutOfMemory or with what `EngineOptions::check_step` says (kInternal), what `redo` could apply is
/// forgotten.
class Engine {
 public:
  /// Takes the mesh. Errors: kBadArgument for options out of range. Cost: O(tets).
  static Result<Engine> create(TetMesh mesh, EngineOptions options = {});

  Engine(Engine&&) noexcept;
  Engine& operator=(Engine&&) noexcept;
  ~Engine();

  /// The mesh; to be read between calls.
  [[nodiscard]] const TetMesh& mesh() const;
  /// What each step changed; to be read between calls.
  [[nodiscard]] const Journal& journal() const;
  /// As given to `create`.
  [[nodiscard]] const EngineOptions& options() const;
  /// Strokes applied so far (undone ones not counted).
  [[nodiscard]] std::uint32_t stroke_count() const;
  /// The number that the next stroke gets, or the one under way has: one above those applied, which go on from the
  /// highest tag of the mesh that was taken; 1 for a fresh engine on a body without walls.
  [[nodiscard]] std::uint32_t next_stroke() const;

  /// Cuts along the whole stroke, in the rest shape, as one sheet; where it meets itself, or shares a front with other
  /// strokes, as if its blade had come in steps: strokes that begin where others end are one cut with them. A blade
  /// that misses changes nothing and is no error. Errors: kBadArgument for a malformed stroke, one that leaves the
  /// body's surroundings (`check_reach`), or while another is under way; kOutOfMemory where ids run out; kInternal; the
  /// mesh is then unchanged. Cost: O(tets) to find the first contact, then O(cut tets).
  Result<StrokeReport> cut(const Stroke& stroke);

  /// Puts the blade in place for a stroke that will be cut step by step; nothing is cut yet. Returns the stroke's
  /// number. A stroke that starts where the last one ended, its points within 0.05 spacings of a typical edge, is one
  /// cut with it: its first step takes back what ended that one, and cuts on (docs/decisions/0030). Errors:
  /// kBadArgument for a malformed pose, one too far from the body as it stands (`check_reach`), or while another stroke
  /// is under way; nothing changes then.
  Result<std::uint32_t> begin_stroke(const BladePose& pose);
  /// Moves the blade on and cuts what it passes through on the way, up to where it stands now. All poses of a stroke
  /// have the same number of points. Errors: kBadArgument without a stroke, for a malformed pose or one too far away,
  /// where nothing changes; kOutOfMemory where ids run out, and kInternal; the mesh is then as before the step, and the
  /// stroke has ended there. May append several steps to the journal. Cost: O(tets that the blade touches), whatever
  /// the mesh's size.
  Result<StepReport> step(const BladePose& pose);
  /// Lifts the blade off: what it cut stays, is finished (vertices that took part in the cut move onto it, its front
  /// draws close to the blade), and is maintained within the budget. Errors: kBadArgument without a stroke;
  /// kOutOfMemory and kInternal, where the stroke ends as its last step left it.
  Result<StrokeReport> end_stroke();
  /// Whether a pose is sound, with at least two points, and keeps within reach of the body as it stands
  /// (`check_reach`), as `begin_stroke` and `step` ask. The error says which pose of which stroke it would be.
  [[nodiscard]] Status check_pose(const BladePose& pose) const;
  /// Whether a stroke is under way: begun, and not ended.
  [[nodiscard]] bool is_in_stroke() const;

  /// Tells where the body stands now: `positions[slot]` for every vertex slot, dead ones ignored. Finite, in the mesh's
  /// length unit; the rest shape stays. At any time, between the steps of a stroke too; no operation for undo.
  /// Errors: kBadArgument for a wrong count or a position that is not finite. Cost: O(vertices).
  Status set_positions(std::span<const Vec3> positions);

  /// Goes on with the maintenance that a budget left undone, for `work_units` more or until `should_stop` says so; it
  /// counts as part of the last stroke. The same units on the same mesh give the same result, whatever stopped it. In
  /// the profile `paper` a call when nothing waits says that the incision is complete: its front is maintained, too,
  /// and no stroke goes on from it. Errors: kBadArgument while a stroke is under way, which is maintained as it goes;
  /// kInternal, where the mesh is unchanged and nothing waits any more. Cost: about 0.1 µs per unit.
  Result<MaintainReport> maintain(std::uint64_t work_units = kUnlimitedWork, const ShouldStop& should_stop = {});
  /// Whether maintenance waits; what the front of the paper's incision holds is not counted.
  [[nodiscard]] bool has_maintenance() const;

  /// Maintains the whole mesh, cut or not: an operation of its own for undo. Errors: kBadArgument while a stroke is
  /// under way; kInternal, where the mesh is unchanged. Cost: O(tets).
  Result<MaintainReport> improve(const ShouldStop& should_stop = {});

  /// Takes the last stroke (or `improve`) back, bit for bit, its maintenance included; maintenance that waits is
  /// dropped, and a stroke under way is ended where the blade is, and taken back. Returns false where there is none.
  /// Cost: O(its edits).
  bool undo();
  /// Applies what was last taken back. Returns false where there is none, or while a stroke is under way. A new stroke
  /// forgets what could be applied, once it has ended.
  bool redo();
  /// Keeps no more than the last `operations` for undo, from now on: steps of the journal before them are forgotten at
  /// the end of each operation, and their memory is free again. Followers that follow after each call lose nothing;
  /// others learn from `Journal::first`, `JournalCursor` or the error of their `follow` that they must begin anew.
  /// Unlimited at first. Errors: kBadArgument for 0, since followers need the steps of the last operation.
  Status keep_undo(std::size_t operations);

 private:
  class Conductor;  // holds the parts, and calls them in order
  explicit Engine(std::unique_ptr<Conductor> conductor);
  std::unique_ptr<Conductor> conductor_;
};

}  // namespace v0
}  // namespace incise
