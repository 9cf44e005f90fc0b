// SPDX-License-Identifier: Apache-2.0
// How tissue resists a blade, and yields to it (docs/coupling.md).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/process_zone.h"
#include "incise/engine/engine.h"
#include "incise/engine/simulation.h"
#include "incise/sim/solver.h"
#include "incise/sim/tissue_point.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// The cutting edge in tissue that bears a force before it is cut.
///
/// The edge is taken at points along it. Where one is in tissue it presses on the vertices around the front
/// (`ProcessZone`), in the direction of cutting, by stiff springs that give way at the force that the material bears:
/// (toughness + friction) · its share of the edge, of the toughness the less the more the edge slices. What the springs
/// have slipped pays for the front to go on. Without toughness and friction the edge passes unhindered, and nothing
/// here does anything.
class BladeCoupling {
 public:
  /// Puts the blade in place. `spacing`: a typical edge of the mesh.
  void begin(const BladePose& pose, const TetMesh& mesh, const Materials& materials, double length_unit,
             double spacing);
  [[nodiscard]] bool resists() const { return resists_; }

  /// Moves the blade on; appends what presses on the tissue during the next relaxation.
  void press(const BladePose& pose, const TetMesh& mesh, std::vector<Pull>& pulls);
  /// After the relaxation: where the edge has come to in the tissue, for `Engine::step`.
  [[nodiscard]] BladePose yield(const TetMesh& mesh);
  /// After the cut: takes hold of what is ahead of the edge now. `fresh`: the tets that the cut made.
  void take_hold(const TetMesh& mesh, std::span<const TetId> fresh);

  /// Pays for `area` of new cut face, in squared length units at rest: the toughness where the edge has yielded.
  void pay_for(double area);

  /// Forces and work of the last frame.
  [[nodiscard]] const BladeState& state() const { return state_; }
  /// What the force-feedback loop goes by.
  [[nodiscard]] HapticSnapshot snapshot(const Solver& solver, const TetMesh& mesh) const;

 private:
  /// A point of the edge.
  struct Sample {
    std::size_t segment = 0;  // of the pose's polyline, and how far along it
    double share = 0;
    Vec3 place = Vec3::Zero(), before = Vec3::Zero();  // of the blade, now and in the frame before
    Vec3 cut = Vec3::Zero();                           // how far the tissue is cut
    std::optional<TissuePoint> grip;                   // the material just ahead of the front
    Vec3 rest = Vec3::Zero();                          // its place at rest
    Vec3 front = Vec3::Zero();                         // likewise of the material that the cut has come to
    Vec3 slid = Vec3::Zero();                          // along the edge, since it took hold
    bool stiffens = false;                             // its tissue: the front goes on as far as slip has paid alone
    bool is_open = false;                              // its front has broken before
    bool runs = false;                                 // its front has broken, and goes faster than the blade
    double ahead = 0;                                  // of `cut`, along the direction: where the grip was taken
    double lead = 0;                                   // of `place` ahead of the front, along the direction
    double lag = 0;                                    // mean of the springs'
    double paid = 0;                                   // for how far the front may go on, at rest
    double advance = 0;                                // of the front in this frame, at rest
    bool has_slipped = false;                          // in this frame
    double retreat = 0;                                // of `cut` behind `place`, along the direction
    double length = 0;                                 // of edge that it stands for, at rest, m
    double radius = 0;                                 // of its zone
    double toughness = 0, friction = 0;                // N/m, of the material at the grip
    double rupture = 0;                                // likewise
    double pushed = 1;                                 // the share of the toughness that the push bears
    double force = 0, force_before = 0;                // N

    [[nodiscard]] double limit() const { return (pushed * toughness + friction) * length; }
    [[nodiscard]] double bears() const;
  };

  void sample(const BladePose& pose);
  void move_to(const BladePose& pose);
  void turn_springs(const Vec3& before);
  void measure(const TetMesh& mesh);
  [[nodiscard]] Vec3 tangent_at(std::size_t sample) const;
  [[nodiscard]] double length_within(std::size_t index, const Vec3& way, const TetMesh& mesh) const;
  void retreat_outside();
  [[nodiscard]] bool is_point() const;
  void retreat_together();
  void slide(const TetMesh& mesh);
  void enter(const TetMesh& mesh);
  void enter(Sample& sample, const TissuePoint& inside, const TetMesh& mesh);
  void grip(Sample& sample, const TissuePoint& point, const TetMesh& mesh);
  void take_hold(Sample& sample, const TetMesh& mesh, std::span<const TetId> fresh);
  void find_zone(const TetMesh& mesh);
  template <class Visit>
  void for_each_share(const Visit& visit);
  void settle_springs(const TetMesh& mesh);
  void pool();
  void go_on(Sample& sample, const TetMesh& mesh);
  [[nodiscard]] double paid_way(Sample& sample, const TetMesh& mesh) const;
  void account(Sample& sample);
  [[nodiscard]] TetId any_grip() const;

  const Materials* materials_ = nullptr;
  double unit_ = 1, spacing_ = 1, widest_zone_ = 1;
  bool resists_ = false;
  std::vector<Sample> samples_;
  ProcessZone zone_;
  std::vector<std::uint32_t> sample_of_;  // by point of the zone
  Vec3 direction_ = Vec3::Zero();
  Vec3 middle_ = Vec3::Zero();  // of the pose's points: where force feedback has the tool
  BladeState state_;
};

}  // namespace detail
}  // namespace v0
}  // namespace incise
