// SPDX-License-Identifier: Apache-2.0
// A plane of faces is opened but for some, as two sheets leave them that meet there.
#include "cut/bridges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "incise/mesh/components.h"
#include "incise/mesh/journal.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/star_separation.h"

namespace incise::test::bridges_test {
namespace {

constexpr std::uint32_t kCells = 12;
constexpr double kCell = 1.0 / kCells;

/// Two triangles in the plane x = 1/2, for y up to a border.
SweptTriangles swept_up_to(double y) {
  return {{Vec3(0.5, -1, -1), Vec3(0.5, -1, 2), Vec3(0.5, y, -1), Vec3(0.5, y, 2)}, {{0, 1, 2}, {1, 3, 2}}};
}

/// A line along z in the plane.
SweptTriangles joint_at(double y) {
  return {{Vec3(0.5, y, -1), Vec3(0.5, y, 2)}, {{0, 1, 1}}};
}

/// A cube whose plane of faces x = 1/2 is open where a property of their middles holds.
class CubeWithWall {
 public:
  explicit CubeWithWall(const std::function<bool(const Vec3&)>& is_open) : mesh_(build(kuhn_cube(kCells))) {
    std::vector<IncisionFace> faces;
    mesh_.for_each_tet([&](TetId tet) {
      for (unsigned s = 0; s < 4; ++s) {
        const Side side(tet, s);
        const Link link = mesh_.link(side);
        if (link.is_boundary() || link.side() < side) continue;
        const auto v = mesh_.vertices(side);
        const Vec3 middle = (mesh_.rest(v[0]) + mesh_.rest(v[1]) + mesh_.rest(v[2])) / 3.0;
        const bool is_in_plane = std::all_of(v.begin(), v.end(), [&](VertexId u) { return mesh_.rest(u).x() == 0.5; });
        if (is_in_plane && is_open(middle)) faces.push_back({side, link.side()});
      }
    });
    separate_stars(mesh_, faces);
  }

  /// How many faces are opened; what comes of it must be sound, and may be taken back.
  std::size_t cut_bridges(const SweptTriangles& swept, const SweptTriangles& joints) {
    SurfaceIndex surface;
    surface.follow(mesh_, journal_);
    const std::uint64_t before = mesh_.hash();
    Transaction transaction(mesh_);
    const std::vector<Side> opened = incise::cut_bridges(transaction, surface, swept, joints, kCell, 2);
    journal_.append_if_changed(transaction.commit());
    pieces_ = find_components(mesh_).count();
    expect_valid(mesh_, 1.0);
    for (const Side side : opened) EXPECT_EQ(mesh_.link(side).tag(), 2U);
    while (journal_.position() > 0) journal_.undo(mesh_);
    EXPECT_EQ(mesh_.hash(), before);
    return opened.size() / 2;
  }
  [[nodiscard]] std::size_t pieces() const { return pieces_; }

 private:
  TetMesh mesh_;
  Journal journal_;
  std::size_t pieces_ = 0;
};

/// Whether a place lies in a cell of the plane, or in one half of it.
bool is_in_cell(const Vec3& place, unsigned y, unsigned z) {
  return std::floor(place.y() / kCell) == y && std::floor(place.z() / kCell) == z;
}
bool is_in_half_cell(const Vec3& place, unsigned y, unsigned z) {
  return is_in_cell(place, y, z) && place.y() - y * kCell > place.z() - z * kCell;
}

TEST(Bridges, of_one_face_are_cut) {
  CubeWithWall body([](const Vec3& middle) { return !is_in_half_cell(middle, 5, 6); });
  EXPECT_EQ(body.cut_bridges(swept_up_to(2), joint_at(5.5 * kCell)), 1U);
  EXPECT_EQ(body.pieces(), 2U);
}

TEST(Bridges, as_long_as_the_blade_are_cut) {
  CubeWithWall body([](const Vec3& middle) { return std::floor(middle.y() / kCell) != 5; });
  EXPECT_EQ(body.cut_bridges(swept_up_to(2), joint_at(5.5 * kCell)), 2U * kCells);
  EXPECT_EQ(body.pieces(), 2U);
}

TEST(Bridges, within_a_cut_that_ends_elsewhere_are_cut) {
  CubeWithWall body([](const Vec3& middle) { return middle.y() < 9 * kCell && !is_in_cell(middle, 2, 6); });
  EXPECT_EQ(body.cut_bridges(swept_up_to(9 * kCell), joint_at(2.5 * kCell)), 2U);
  EXPECT_EQ(body.pieces(), 1U);
}

TEST(Bridges, are_not_what_the_blade_has_not_reached) {
  CubeWithWall body([](const Vec3& middle) { return !is_in_cell(middle, 5, 6); });
  for (const double border : {4.0, 5.2}) {  // far from it, and where one of the two faces lies just beyond the border
    EXPECT_EQ(body.cut_bridges(swept_up_to(border * kCell), joint_at(5.5 * kCell)), 0U) << border;
  }
}

TEST(Bridges, are_not_where_the_cut_ends_nearby) {
  CubeWithWall body([](const Vec3& middle) { return middle.y() < 7 * kCell && !is_in_cell(middle, 5, 6); });
  EXPECT_EQ(body.cut_bridges(swept_up_to(7 * kCell), joint_at(5.5 * kCell)), 0U);
}

TEST(Bridges, away_from_where_sheets_meet_are_left) {
  CubeWithWall body([](const Vec3& middle) { return !is_in_cell(middle, 10, 6); });
  EXPECT_EQ(body.cut_bridges(swept_up_to(2), joint_at(2.5 * kCell)), 0U);
}

}  // namespace
}  // namespace incise::test::bridges_test
