// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "cut/closed_complex.h"
#include "cut/strip.h"
#include "cut/surface_index.h"

namespace incise {
inline namespace v0 {

/// The live tet that holds a rest point, or none where the point lies outside the body. Exact: a point on a face
/// belongs to one side of it. Looks for the surface along a ray, and walks back from there. Cost: O(cells and tets on
/// the ray).
[[nodiscard]] TetId locate(const TetMesh& mesh, const SurfaceIndex& surface, const SosPoint& point);

/// Finds the tets that a blade meets by walking, from those that it met in the step before and from the surface.
///
/// Paper §2.2 (collision detection). Differs: no search of the mesh; the cost depends on the tets met alone.
class ContactWalk {
 public:
  /// The masters that a walk remembers.
  struct Memory {
    std::vector<std::uint32_t> met, last, front;
  };
  void clear() { restore({}); }
  [[nodiscard]] Memory memory() const { return {met_, last_, front_}; }
  void restore(const Memory& memory) {
    met_ = memory.met;
    last_ = memory.last;
    front_ = memory.front;
  }
  /// The masters that the strip meets, each once, in the order of the walk; tets that were none yet become masters.
  /// Conservative: a few come close without touching. Cost: about 30 ns per tet visited, and the cells of the surface
  /// index that the strip passes through.
  const std::vector<std::uint32_t>& find(const TetMesh& mesh, const Strip& strip, const SurfaceIndex& surface,
                                         ClosedComplex& complex, std::uint32_t step);
  /// Notes where the front lies now, `row`, among the masters met last and where it lay before: the next strip is
  /// looked for from there, wherever along the blade it begins. Cost: O(masters · segments).
  void keep_front(const TetMesh& mesh, const ClosedComplex& complex, std::span<const SosPoint> row);
  /// The vertices of what the strip looked for last may pass through and the blade has left: settled masters, and tets
  /// beside them that are none. They are not among the masters met.
  [[nodiscard]] const std::vector<TetVertices>& left_behind() const { return left_behind_; }
  /// Forgets masters that were let go.
  void forget_released(const ClosedComplex& complex);

 private:
  void visit(std::uint32_t master);
  void visit(const TetMesh& mesh, TetId tet);
  void seed_from_surface(const TetMesh& mesh, const Strip& strip, const SurfaceIndex& surface);
  void walk_on(const TetMesh& mesh, std::uint32_t master);

  struct Plane {
    Vec3 normal;
    double offset, margin;
  };
  /// A triangle as the prism of space above and below it.
  struct Prism {
    Plane face;
    std::array<Plane, 3> walls;
  };
  void prepare(const Strip& strip);
  [[nodiscard]] Prism prism_of(const Strip& strip, std::uint32_t triangle) const;
  [[nodiscard]] bool meets(const std::array<Vec3, 4>& corners) const;
  [[nodiscard]] bool meets_some(const std::array<Vec3, 4>& corners) const;

  const Strip* strip_ = nullptr;
  ClosedComplex* complex_ = nullptr;
  const TetMesh* mesh_ = nullptr;
  std::uint32_t step_ = 0;
  std::vector<Prism> prisms_;
  std::vector<std::uint32_t> met_, last_;
  std::vector<TetId> near_;                // behind the boundary sides in the cells along the strip
  std::vector<std::uint32_t> front_;       // masters that the blade's front may lie in
  ZeroedArray<std::uint32_t> rejected_;    // by tet slot: the walk that turned it down
  ZeroedArray<std::uint32_t> found_near_;  // by tet slot: the walk that had it in `near_`
  std::vector<TetVertices> left_behind_;
  std::uint32_t walk_ = 0;
};

}  // namespace v0
}  // namespace incise
