// SPDX-License-Identifier: Apache-2.0
// What becomes of regions in an exercise: layers that are divided, tissue that stays whole, tissue that comes off.
#pragma once

#include <cstdint>
#include <vector>

#include "app/scene/exercise_measure.h"
#include "app/scene/exercise_score.h"
#include "incise/geom/triangle_tree.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The faces of some regions of the uncut mesh: towards other regions and towards the outside.
class RegionFaces {
 public:
  /// @param regions  labels of tets. Cost: O(tets), and O(n log n) of the faces.
  RegionFaces(const std::vector<std::int32_t>& regions, const TetMesh& mesh);

  /// The way from a point to the nearest face, length units; infinite where there is none.
  [[nodiscard]] double distance(const Vec3& point) const;
  /// How far a ray from a point of the skin goes until it leaves the regions through a face that it looks at from
  /// within; NaN where it meets none.
  /// @param inward  unit.
  [[nodiscard]] double thickness(const Vec3& skin, const Vec3& inward) const;
  /// Points of the faces towards other regions.
  [[nodiscard]] const std::vector<Vec3>& rim() const { return rim_; }

 private:
  std::vector<Vec3> points_;
  std::vector<TriangleTree::Triangle> triangles_;
  TriangleTree tree_;
  std::vector<Vec3> rim_;
};

/// Measures what an exercise asks of regions.
class ExerciseGoals {
 public:
  /// @param exercise  with the numbers of its regions; it must outlive this, and so must `line`.
  /// @param mesh      before the first cut; it is not kept. Cost: O(tets).
  ExerciseGoals(const Exercise& exercise, const TargetLine& line, const TetMesh& mesh);

  /// Fills in the figures of regions. `score` has its profile already. Cost: O(tets), and O(log n) per side of a wall.
  void measure(const TetMesh& mesh, ExerciseScore& score) const;

 private:
  void measure_divided(ExerciseScore& score) const;
  void measure_wounds(const TetMesh& mesh, ExerciseScore& score) const;
  void measure_removed(const TetMesh& mesh, ExerciseScore& score) const;

  const Exercise& exercise_;
  const TargetLine& line_;
  std::vector<double> thickness_;    // of the layers to be divided, per part of the line
  std::vector<RegionFaces> spared_;  // as the exercise's
  std::vector<Vec3> rim_;            // of what is to come off
  double volume_ = 0;                // of what is to come off
};

}  // namespace app
}  // namespace v0
}  // namespace incise
