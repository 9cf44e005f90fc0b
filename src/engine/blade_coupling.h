// SPDX-License-Identifier: Apache-2.0
// How tissue resists a blade, and yields to it (docs/coupling.md).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "incise/engine/engine.h"
#include "incise/engine/simulation.h"
#include "incise/sim/solver.h"
#include "incise/sim/tissue_point.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// The cutting edge in tissue that bears a force before it is cut.
///
/// The edge is taken at points along it. Where one is in tissue it has hold of the material just ahead of the front,
/// and presses it on, in the direction of cutting, by a stiff spring that gives way at the force that the material
/// bears: (toughness + friction) · its share of the edge. What the spring gives way is what is cut. Without toughness
/// and friction the edge passes unhindered, and nothing here does anything.
class BladeCoupling {
 public:
  /// Puts the blade in place. `spacing`: a typical edge of the mesh.
  void begin(const BladePose& pose, const Materials& materials, double length_unit, double spacing);
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
    std::optional<TissuePoint> grip;                   // the material that it presses on
    Vec3 rest = Vec3::Zero();                          // its place at rest
    double ahead = 0;                                  // of `cut`, along the direction: where the grip was taken
    bool has_slipped = false;                          // in this frame
    double retreat = 0;                                // of `cut` behind `place`, along the direction
    double length = 0;                                 // of edge that it stands for, m
    double toughness = 0, friction = 0;                // N/m, of the material at the grip
    double force = 0, force_before = 0;                // N

    [[nodiscard]] double limit() const { return (toughness + friction) * length; }
  };

  void sample(const BladePose& pose, double spacing);
  void move_to(const BladePose& pose);
  void retreat_outside();
  void enter(const TetMesh& mesh);
  void enter(Sample& sample, const TissuePoint& inside, const TetMesh& mesh);
  void grip(Sample& sample, const TissuePoint& point, const TetMesh& mesh);
  void take_hold(Sample& sample, const TetMesh& mesh, std::span<const TetId> fresh);
  [[nodiscard]] double stiffness(const Sample& sample) const;
  void account(Sample& sample);
  [[nodiscard]] TetId any_grip() const;

  const Materials* materials_ = nullptr;
  double unit_ = 1, spacing_ = 1;
  bool resists_ = false;
  std::vector<Sample> samples_;
  Vec3 direction_ = Vec3::Zero();
  Vec3 middle_ = Vec3::Zero();  // of the pose's points: where force feedback has the tool
  BladeState state_;
};

}  // namespace detail
}  // namespace v0
}  // namespace incise
