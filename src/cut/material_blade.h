// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "cut/closed_complex.h"
#include "cut/surface_index.h"

namespace incise {
inline namespace v0 {

/// Where the edge of a blade stands in the material of a body that moves: its points, dense enough to follow the
/// tissue, each with the rest point that the front has reached there.
///
/// The blade is located in the elements as they stand; the cut is made in the rest shape, where strips share rows bit
/// for bit whatever the body does. So an error of location moves the cut, but cannot leave a bridge. What moved is told
/// from what was swept by comparing the blade with the crack's tip, the place where the front's rest point stands now:
/// only a blade ahead of it, in the direction of cutting, cuts on; in the open wound, or withdrawn, it is held.
/// Source: docs/internals.md (blades in a moving body).
class MaterialBlade {
 public:
  /// Starts at a row, `n ≥ 2` points as the body stands; those in tissue have their tip there. `spacing`: a typical
  /// edge. Cost: O(points · near surface).
  void begin(const TetMesh& mesh, const SurfaceIndex& surface, std::span<const Vec3> row, double spacing,
             ClosedComplex& complex);
  /// The front: a rest point for each point of the blade.
  [[nodiscard]] std::span<const Vec3> anchors() const { return anchors_; }

  /// Takes over a stroke that began at rest: `anchors`, one for each point of the refined row, are its front.
  void take_over(const TetMesh& mesh, const SurfaceIndex& surface, std::span<const Vec3> row,
                 std::span<const Vec3> front, double spacing, ClosedComplex& complex);
  /// Where each segment of the row is divided: shares of its length, the last one 1.
  [[nodiscard]] const std::vector<std::vector<double>>& shares() const { return shares_; }
  /// Whether it reaches so far beyond the body that its points are dense near the body alone, as that and the blade
  /// stood at first: where it has not met the body yet, `begin` again.
  [[nodiscard]] bool is_graded() const { return is_graded_; }

  /// Looks for the blade as it stands now. `direction`: where its edge cuts, unit; zero: where it has cut so far.
  /// `is_last`: the blade goes no further, and points that waited for it to go on do so no more; others stay.
  void locate(const TetMesh& mesh, const SurfaceIndex& surface, const ClosedComplex& complex, std::span<const Vec3> row,
              const Vec3& direction, bool is_last = false);
  /// Whether the front lies outside the body at rest, all of it.
  [[nodiscard]] bool is_front_clear(const TetMesh& mesh, const SurfaceIndex& surface);
  /// Whether the blade is in the air: none of its points is in tissue or has its front there, and on its way from where
  /// it was looked for last it met no tissue, nor does its front. Cost: O(points) in tissue, else O(surface).
  [[nodiscard]] bool is_in_air(const TetMesh& mesh, const SurfaceIndex& surface);
  /// The row to cut to, as far as it is not held.
  [[nodiscard]] std::vector<Vec3> wanted() const;
  /// Notes where the front stands, for `stands_at`.
  void find_tips(const TetMesh& mesh, const ClosedComplex& complex);
  /// Whether a blade stands where this one would now, had the tissue taken it along since `find_tips`: each of its
  /// points in tissue within `distance`, and there are some.
  [[nodiscard]] bool stands_at(const TetMesh& mesh, const ClosedComplex& complex, std::span<const Vec3> row,
                               double distance) const;
  /// Puts the blade where it stands now, after the body has moved and has taken its front along: as if it had come
  /// there with the tissue.
  void carry_to(std::span<const Vec3> row);
  /// Where a blade that stands at a row now would stand if it were as far back as the crack's tip is, each corner of
  /// the row by its nearest point in tissue; `before` where there are no such points.
  [[nodiscard]] std::vector<Vec3> front_of(const TetMesh& mesh, const ClosedComplex& complex,
                                           std::span<const Vec3> before, std::span<const Vec3> row) const;
  /// Holds a point of the blade in this step.
  void hold(std::size_t point) { points_[point].is_accepted = false; }
  [[nodiscard]] bool is_in_tissue(std::size_t point) const { return points_[point].tet.is_valid(); }
  [[nodiscard]] bool is_accepted(std::size_t point) const { return points_[point].is_accepted; }
  /// How far ahead of the crack's tip a point of the blade is, along the direction of cutting.
  [[nodiscard]] double lead(std::size_t point) const { return points_[point].lead; }
  /// Takes the accepted points as the new front. Their tets become masters, so that the front is found again.
  void advance(const TetMesh& mesh, const SurfaceIndex& surface, ClosedComplex& complex);
  /// The masters that hold the front, or did where a point has left the body: its place is told by them.
  [[nodiscard]] std::vector<std::uint32_t> masters() const;
  /// Finds the masters of the front anew, after those before were let go.
  void find_masters(const TetMesh& mesh, const SurfaceIndex& surface, ClosedComplex& complex);

 private:
  struct Point {
    Vec3 world = Vec3::Zero();      ///< where it is now
    Vec3 before = Vec3::Zero();     ///< where it was when it was looked for last
    Vec3 reached = Vec3::Zero();    ///< where it was when its anchor was last put in place
    Vec3 candidate = Vec3::Zero();  ///< the rest point there
    Vec3 tip = Vec3::Zero();        ///< where the front's rest point stands now
    Vec3 towed = Vec3::Zero();      ///< follows the anchor through tissue at rest as if on a rope
    Vec3 direction = Vec3::Zero();  ///< of cutting, as the body stands
    Vec3 along = Vec3::Zero();      ///< the blade's edge here, unit
    double lead = 0;
    TetId tet;                             ///< that holds it, if it is in tissue
    TetId hint;                            ///< a live tet near it
    std::uint32_t master = Master::kNone;  ///< that holds the anchor, if it is in tissue
    bool is_mapped = false;                ///< outside, `candidate` is what the map of a tet says
    bool has_entered = false;
    bool is_accepted = false;
  };

  void set_shares(const TetMesh& mesh, std::span<const Vec3> row);
  void find(const TetMesh& mesh, const SurfaceIndex& surface, Point& point, const Vec3& anchor, bool is_expected);
  [[nodiscard]] static bool is_in_master(const ClosedComplex& complex, const Point& point) {
    return point.master < complex.size() && complex[point.master].split != nullptr;
  }
  /// Where the front's rest point stands now. A point that is away from the tet that it left by follows others.
  void find_tip(const TetMesh& mesh, const ClosedComplex& complex, Point& point, const Vec3& anchor) const;
  void find_directions(const Vec3& given);
  void tow(const TetMesh& mesh, std::size_t point, const Vec3& step);
  [[nodiscard]] bool is_due(double step) const;
  [[nodiscard]] bool is_behind_others(std::size_t i) const;
  void judge(const TetMesh& mesh, const SurfaceIndex& surface, std::size_t i);
  [[nodiscard]] bool lies_in_cut(const TetMesh& mesh, const SurfaceIndex& surface, const Vec3& rest) const;
  bool push_out(const TetMesh& mesh, const SurfaceIndex& surface, const Vec3& from, Vec3& rest);
  bool keep_out(const TetMesh& mesh, const SurfaceIndex& surface, const Vec3& from, Vec3& rest,
                bool has_passed = false);
  bool go_round(const TetMesh& mesh, const SurfaceIndex& surface, const Vec3& from, const Vec3& inner, Vec3& rest);
  [[nodiscard]] std::size_t leader_of(std::size_t point) const;
  [[nodiscard]] bool is_clear(const TetMesh& mesh, const SurfaceIndex& surface, const Vec3& from, const Vec3& to);
  void keep_clear(const TetMesh& mesh, const SurfaceIndex& surface, std::size_t end);
  void set_course();
  void follow_entered(const TetMesh& mesh, const SurfaceIndex& surface);
  [[nodiscard]] bool meets_tissue(const TetMesh& mesh, const Point& point) const;

  std::vector<Point> points_;
  std::vector<Vec3> anchors_;
  std::vector<std::vector<double>> shares_;  // of each segment of the row
  bool is_graded_ = false, is_last_ = false;
  Vec3 course_ = Vec3::Zero();  // of the cut at rest, unit
  double spacing_ = 1.0;
  std::uint64_t next_key_ = std::uint64_t{1} << 48U;
};

}  // namespace v0
}  // namespace incise
