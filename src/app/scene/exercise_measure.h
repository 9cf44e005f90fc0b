// SPDX-License-Identifier: Apache-2.0
// The geometry of an exercise: where points of a cut are, seen from the target line.
#pragma once

#include <vector>

#include "app/scene/exercise_score.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace app {

/// A point seen from the target line. Length units.
struct LinePlace {
  double arc = 0;      ///< along the line from its first point; below 0 and above its length on its prolongations
  double lateral = 0;  ///< beside the line, along the skin; at least 0
  double depth = 0;    ///< below the skin; below 0 outside the body
  Vec3 beside = Vec3::Zero();  ///< from the line to the point, along the skin
};

/// The target line on the skin of the uncut mesh.
class TargetLine {
 public:
  static constexpr std::size_t kBins = 100;  ///< parts of the line

  TargetLine(const Exercise& exercise, const TetMesh& mesh);

  [[nodiscard]] double length() const { return arcs_.back(); }
  /// Whether it comes back to where it begins: it has no ends.
  [[nodiscard]] bool is_closed() const { return is_closed_; }
  /// The skin nearest to the middle of a part of the line.
  [[nodiscard]] const Vec3& skin_at(std::size_t bin) const { return skin_[bin].point; }
  [[nodiscard]] const Vec3& skin_normal(std::size_t bin) const { return skin_[bin].normal; }
  /// Whether a part is so near an end that the cut may have begun or ended there.
  [[nodiscard]] bool is_end(std::size_t bin) const;
  [[nodiscard]] LinePlace place_of(const Vec3& point) const;
  /// Outward and unit: the skin's normal nearest to the line at an arc length.
  [[nodiscard]] const Vec3& normal_at(double arc) const { return skin_[bin_at(arc)].normal; }
  /// The part of the line at an arc length; beyond its ends the first or last.
  [[nodiscard]] std::size_t bin_at(double arc) const;
  /// Whether the line runs along the skin there, as near as points of an attempt are to the line.
  [[nodiscard]] bool is_on_skin(std::size_t bin) const { return skin_[bin].is_near; }
  /// How far beside the line a point of an attempt may be at some depth.
  [[nodiscard]] double reach(double depth) const { return near_ + (depth > 0 ? slope_ * depth : 0); }
  /// The nearest distance of a point to the line itself.
  [[nodiscard]] double distance(const Vec3& point) const;

 private:
  struct Skin {
    Vec3 point = Vec3::Zero();
    Vec3 normal = Vec3::UnitZ();
    bool is_near = false;
  };
  /// The nearest point of the line; `is_prolonged`: of the line with its first and last part going on.
  struct Foot {
    double arc = 0;
    Vec3 point;
  };
  [[nodiscard]] Foot foot_of(const Vec3& point, bool is_prolonged) const;
  [[nodiscard]] Vec3 point_at(double arc) const;
  void find_skin(const TetMesh& mesh);

  std::vector<Vec3> points_;
  std::vector<double> arcs_;  // per point
  bool is_closed_ = false;
  double end_ = 0;  // length of what `is_end`
  double near_ = 0, slope_ = 0;
  std::vector<Skin> skin_;  // per bin
};

/// Calls `visit(tet, vertices, tag)` for each side of the boundary: tag 0 is skin, others are walls of cuts.
template <class Visit>
void for_each_boundary_side(const TetMesh& mesh, const Visit& visit) {
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (mesh.links(tet)[s].is_boundary()) visit(tet, mesh.vertices(Side(tet, s)), mesh.links(tet)[s].tag());
    }
  });
}

/// Fills in all figures that the mesh tells, but for those of regions.
void measure_mesh(const Exercise& exercise, const TargetLine& line, const TetMesh& mesh, ExerciseScore& score);

}  // namespace app
}  // namespace v0
}  // namespace incise
