// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "improve/care.h"

namespace incise {
inline namespace v0 {

/// The shape of a star as a function of the place of its centre: Σ 1/q⁶ over its tets, q their mean ratio; infinite
/// where a tet has no positive volume. With the other vertices fixed the volume is linear and Σ l² quadratic, so that a
/// tet costs a few operations; value, gradient and a positive definite stand-in for the Hessian come together.
class StarEnergy {
 public:
  struct Value {
    double energy = 0;
    Vec3 gradient = Vec3::Zero();
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  };

  /// For the faces (p, q, r) opposite the centre, such that (centre, p, q, r) is negative: the centre lies on the side
  /// that their normal points to.
  void clear() { faces_.clear(); }
  void add(const Vec3& p, const Vec3& q, const Vec3& r);
  [[nodiscard]] std::size_t size() const { return faces_.size(); }

  [[nodiscard]] double energy(const Vec3& centre) const;
  [[nodiscard]] Value evaluate(const Vec3& centre) const;

 private:
  struct Face {
    Vec3 normal;  // 6 V = normal·x − offset
    double offset;
    Vec3 centroid;  // Σ l² = 3 |x − centroid|² + constant
    double constant;
  };
  std::vector<Face> faces_;
};

/// The step from `here` towards the least energy, within what a vertex with these surfaces may do.
Vec3 newton_step(const StarEnergy::Value& here, const VertexSurfaces& surfaces);

/// Moves one vertex to a better place within its surfaces. Keeps scratch memory.
class Smoother {
 public:
  /// Tries to improve the worst tet around `vertex` by moving it. Where it was accepted `care.changed` holds its star.
  ///
  /// Newton steps on `StarEnergy`, held to what the vertex is part of: interior free, on a surface orthogonal to the
  /// vector area of its faces, where two surfaces meet orthogonal to both, and to the gradient of each region's
  /// volume: what is on either side stays. Accepted
  /// where the worst L/r of the star falls, no surface leaves its place, and no tet is inverted, at rest or now; for a
  /// bad tet on a curved surface also half, a quarter or an eighth of the way. Cost: about 2 µs. **Source:** Paper §3.2
  /// and §3.4. Differs: no average decides; the optimum instead of the centre.
  bool improve(Care& care, VertexId vertex);

 private:
  [[nodiscard]] bool is_curved() const {
    return surfaces_.mobility != Mobility::kFree && (!surfaces_.is_flat() || surfaces_.is_front());
  }
  void collect(const Care& care, VertexId vertex);
  [[nodiscard]] Vec3 find_place(Care& care, VertexId vertex) const;
  [[nodiscard]] bool keeps_surfaces(const Care& care, VertexId vertex, const Vec3& place);
  void collect_pieces(const Care& care, VertexId vertex, const Vec3& place, unsigned surface);
  [[nodiscard]] double worst_at(Care& care, VertexId vertex, const Vec3& place, double bound) const;

  std::vector<TetId> star_;
  VertexSurfaces surfaces_;
  StarEnergy energy_;
  Piece before_, after_;
};

/// Moves a vertex and samples what followers carry at the new place; `star` is its star. Returns false, and does
/// nothing, where a tet would stand inverted that does not now.
bool move_vertex(Care& care, VertexId vertex, const Vec3& place, const std::vector<TetId>& star);

}  // namespace v0
}  // namespace incise
