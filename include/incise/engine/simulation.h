// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "incise/core/result.h"
#include "incise/engine/engine.h"
#include "incise/engine/suture.h"
#include "incise/sim/body.h"
#include "incise/sim/contact.h"
#include "incise/sim/haptic_snapshot.h"
#include "incise/sim/solver.h"

namespace incise {
inline namespace v0 {

/// A frame's budget of maintenance unless told otherwise, in work units: about 2 ms. The steps of a stroke need a tenth
/// of it; what a stroke leaves when it ends is spread over some frames, without a hitch.
inline constexpr std::uint64_t kFrameWorkUnits = 20'000;

/// What a body is made of, and how it is computed.
struct SimulationOptions {
  /// `engine.maintain.work_units` is the budget of each frame: a stroke's maintenance goes on in the frames after it.
  EngineOptions engine = {{}, {.work_units = kFrameWorkUnits}, {}, 1};
  BodyOptions body;                 ///< how the body finds its balance
  Materials materials;              ///< what its regions are made of
  double frame_seconds = 1.0 / 60;  ///< in (0, 1]
  double contact_stiffness = 0;     ///< N/m per touched vertex; 0: ten times what the tissue itself has
  double flat_height = 0;           ///< of the blade behind its edge, length unit; 0: the flat touches nothing
};

/// What a hook takes hold of.
enum class HookReach : std::uint8_t {
  kBall,     ///< all vertices within the radius of its position, on both sides of a wound and inside the body as well
  kSurface,  ///< those of the surface that are no further than the radius by the way along its edges, from the nearest
             ///< place on; never across a lip, from skin to wall, or over the end of a cut to the wall across
};

/// A grip on the tissue: a hook, a pair of forceps. In the first frame that names it, it takes hold; in the first frame
/// that does not, it lets go.
struct Hook {
  std::uint32_t id = 0;                ///< the same from frame to frame, and once per frame
  Vec3 position = Vec3::Zero();        ///< length unit
  double radius = 0;                   ///< length unit, above 0; where no vertex is within it, the nearest one is taken
  double stiffness = 100;              ///< N/m per vertex, above 0
  HookReach reach = HookReach::kBall;  ///< where it takes hold
  double closed = 0;  ///< in [0, 1): share of the way to its position by which what it holds is gathered, as jaws do
  /// Of all its springs together, N, above 0: the greatest force. Pulled harder it slips through the tissue, so that it
  /// bears just this, or tears out.
  double strength = std::numeric_limits<double>::infinity();
  bool tears = false;  ///< beyond its strength it lets go, until the tissue is gripped anew under another id
};

/// What the hands do in one frame: everything that they hold, where it is at the end of the frame.
struct FrameInput {
  /// The blade. Its first frame puts it in place and cuts nothing; each frame after that cuts on; the first frame
  /// without it ends the stroke. All poses of a stroke have the same number of points.
  std::optional<BladePose> blade;
  std::vector<Hook> hooks;  ///< what grips the tissue in this frame
  std::vector<Tool> tools;  ///< what presses on the surface in this frame, tables and walls included
};

/// The blade and the tissue at the end of a frame. SI units.
struct BladeState {
  bool touches = false;       ///< some of the edge is in the tissue, or presses on it
  bool yields = false;        ///< somewhere the tissue gave way in this frame
  Vec3 force = Vec3::Zero();  ///< of the tissue on the edge, N
  double engaged_length = 0;  ///< of the edge, m
  double fracture_work = 0;   ///< toughness · new area, in this frame, J
  double friction_work = 0;   ///< rubbed off while cutting, in this frame, J
  double tool_work = 0;       ///< that the hand did with the edge in this frame, J
};

/// What one frame did.
struct FrameReport {
  CutStatistics cut;                        ///< what the blade did
  MaintainStatistics maintain;              ///< what maintenance did
  StageTimes times;                         ///< relax: solver and following; the others as the engine has them
  double follow_ms = 0;                     ///< of `times`' relax: what it took the solver to follow the mesh
  AdvanceReport relax;                      ///< what relaxation did
  BladeState blade;                         ///< forces and work at the edge
  std::vector<Vec3> hook_forces;            ///< of the tissue on each hook of the input, N
  std::uint32_t stroke = 0;                 ///< the stroke under way, of this simulation's from 1; 0: none
  std::size_t contacts = 0;                 ///< vertices that tools touch
  std::vector<std::uint32_t> torn_sutures;  ///< ids of those that tore in this frame
  std::vector<std::uint32_t> torn_hooks;    ///< ids of those that tore out in this frame
};

/// A body that is cut while it deforms: the paper's whole pipeline (Figure 1), frame by frame.
///
/// In each frame the tissue moves on under its own weight, hooks and tools (relaxation); then the blade cuts it where
/// it stands, and the solver follows the mesh; between strokes the mesh is maintained within the budget of the frame.
/// Where a material has toughness or friction the tissue resists: the edge presses it ahead until the force per length
/// of edge reaches what the material bears, and then cuts on just as far as that force allows (`docs/coupling.md`). The
/// front of the cut lives in the tissue and moves with it. *Differs* from the paper, whose blade cuts rigid tissue.
/// One writer; the same calls give the same bits on every compiler and number of threads. No clock is read but to
/// report times.
class Simulation {
 public:
  /// Takes the mesh as it stands, at rest or drawn out. Errors: kBadArgument for options out of range.
  static Result<Simulation> create(TetMesh mesh, SimulationOptions options);
  /// The same with a solver of one's own, made for this mesh. Of `options.body` the length unit alone counts, and of
  /// `options.materials` how tissue resists a blade. Errors: kBadArgument besides without a solver.
  static Result<Simulation> create(TetMesh mesh, SimulationOptions options, std::unique_ptr<Solver> solver);
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

  /// One frame. Errors: kBadArgument for malformed input, and nothing changes; kOutOfMemory where ids run out: the
  /// stroke ends there. Cost: the relaxation's, plus O(tets that the blade touches), plus O(vertices), about 5 ns each.
  Result<FrameReport> frame(const FrameInput& input);

  /// Lets the body come to rest under gravity and its holds, before anything is done to it: makes frames without input,
  /// with velocities halved, until nothing moves faster than `speed` m/s, at least 0, at most `max_frames` of them.
  /// Returns how many frames it made.
  /// @param should_stop  asked before each frame; true ends it there. May be empty. To settle in several calls is not
  /// the same: a call makes a frame before it can tell that the body is at rest.
  Result<unsigned> settle(unsigned max_frames, double speed = 1e-4, const ShouldStop& should_stop = {});

  /// Takes the last stroke back, with its maintenance; a stroke under way as well. The tissue stays where it stands.
  /// Returns false where there is none.
  bool undo();
  /// Applies the stroke that was last taken back. Returns false where there is none.
  bool redo();
  /// Keeps no more than the last `operations` strokes for undo; see `Engine::keep_undo`. The body and the blade follow
  /// each frame and lose nothing. Errors: kBadArgument for 0.
  Status keep_undo(std::size_t operations);

  /// Ties two places of the material to each other, of one piece or of two: a suture, a staple, a plate. It acts from
  /// its first frame on, at once where that has come, and follows the material through cuts, maintenance, undo and
  /// redo. The blade goes past it. Returns its id; no two of a simulation are the same.
  /// @param ends  each in a live tet of `mesh()`, weights in [0, 1].
  /// Errors: kBadArgument for such ends, for numbers out of range, or where the solver has no ties; nothing changes.
  Result<std::uint32_t> add_suture(const std::array<TissuePoint, 2>& ends, const Suture& suture);
  /// The same between two places of the rest shape, length unit: in the tissue, or no further from it than a quarter of
  /// the mean edge. Cost: O(tets).
  Result<std::uint32_t> add_suture(const std::array<Vec3, 2>& rest_places, const Suture& suture);
  /// Takes a suture out, torn or not. Errors: kBadArgument where there is none of that id.
  Status remove_suture(std::uint32_t id);
  /// All sutures as they are now, in the order in which they were added.
  [[nodiscard]] std::vector<SutureState> sutures() const;

  /// As given to `create`.
  [[nodiscard]] const SimulationOptions& options() const;
  /// The engine, to read: journal, strokes.
  [[nodiscard]] const Engine& engine() const;
  /// The mesh as it stands after the last frame.
  [[nodiscard]] const TetMesh& mesh() const;
  /// What relaxes the tissue. Follow the journal by `frame` alone.
  [[nodiscard]] const Solver& solver() const;
  /// The same, to hold and release vertices of a solver of your own.
  [[nodiscard]] Solver& solver();
  /// Whether that is the solver that Incise has.
  [[nodiscard]] bool has_body() const;
  /// The solver that Incise has; not to be called where `has_body` is false.
  [[nodiscard]] const DeformableBody& body() const;
  /// To hold and release vertices.
  [[nodiscard]] DeformableBody& body();
  /// Frames done.
  [[nodiscard]] std::uint64_t frames() const;
  /// What the 1 kHz loop of force feedback goes by until the next frame. Cost: O(1).
  [[nodiscard]] const HapticSnapshot& haptic_snapshot() const;
  /// Of the mesh and of the body's state. Cost: O(slots).
  [[nodiscard]] std::uint64_t hash() const;

 private:
  struct State;
  explicit Simulation(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace v0
}  // namespace incise
