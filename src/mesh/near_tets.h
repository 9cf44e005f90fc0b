// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "incise/geom/box.h"
#include "incise/mesh/tet_mesh.h"
#include "mesh/tet_grid.h"

namespace incise {
inline namespace v0 {

/// Where the way from one place to another passes from one lip of a wall to the other.
struct WallCrossing {
  double t = 0;     ///< share of the way, in (0, 1)
  TetId low, high;  ///< the tets before and behind
};

/// Whether a wall is between two tets that meet at a place, within the tolerance of `NearTets`. One lip is enough:
/// where lips overlap at rest the place is at the border of one alone.
[[nodiscard]] bool are_parted(const TetMesh& mesh, TetId a, TetId b, const Vec3& place);

/// The tets near a few places at rest, to be asked many times.
class NearTets {
 public:
  /// For places within a body of such an extent, length units.
  explicit NearTets(double extent);
  /// Those within `reach` of a box by their own boxes; where there is none, the nearest.
  void gather(const TetMesh& mesh, const TetGrid& grid, const Box& box, double reach);
  /// Whether one of them touches a wall.
  [[nodiscard]] bool has_walls() const { return has_walls_; }
  /// The tet that holds a place, or the one nearest to it. Where several are, beyond an edge or a vertex, it is the one
  /// that leans most towards the place, so that the lips of a wall are told apart outside the body too. Places are
  /// taken a hair's breadth aside: a plane of the surface and a wall in the same plane would else be told apart by
  /// rounding.
  [[nodiscard]] TetId locate(const Vec3& place) const;
  /// The walls between two places in tets that `locate` gave, in order. Thinner layers between two walls than 2^-20
  /// of the way count as one wall.
  void find_crossings(const TetMesh& mesh, const Vec3& from, TetId from_tet, const Vec3& to, TetId to_tet,
                      std::vector<WallCrossing>& crossings) const;

 private:
  struct Entry {
    TetId tet;
    Box box;
    std::array<Vec3, 4> corners;
    std::array<Vec3, 4> slopes;  // the weight of corner c at p: slopes[c]·(p - the corner after it)
    bool is_flat;
  };
  struct Way;
  void add(const TetMesh& mesh, TetId tet);
  /// How near a tet is.
  struct Nearness {
    double distance2 = 0;
    double lean = 0;  // how far the tet reaches out towards the place from the nearest point of it
  };
  [[nodiscard]] static bool is_inside(const Entry& entry, const Vec3& place);
  [[nodiscard]] static Nearness nearness(const Entry& entry, const Vec3& place);
  void halve(const Way& way, double low, TetId low_tet, double high, TetId high_tet) const;

  std::vector<Entry> entries_;
  std::vector<TetId> found_;  // scratch
  Vec3 aside_;
  bool has_walls_ = false;
};

}  // namespace v0
}  // namespace incise
