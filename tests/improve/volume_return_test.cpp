// SPDX-License-Identifier: Apache-2.0
// Volume that a change took comes back from the surfaces around it.
#include "improve/volume_return.h"

#include "improve/maintainer_cases.h"

namespace incise::test::volume_return_test {
namespace {

/// A body cut in halves, and an inner vertex of its wall.
struct Halves {
  TetMesh uncut = build(kuhn_cube(4)), mesh = cut_mesh(kuhn_cube(4), {{Vec3(1, 0.1, 0.05), 0.6}});
  VertexId centre = inner_wall_vertex(mesh);

  static VertexId inner_wall_vertex(const TetMesh& mesh) {
    VertexId found;
    mesh.for_each_vertex([&](VertexId v) {
      const unsigned bits = mesh.shape_of(v);
      if ((bits & shape::kWall) != 0 && (bits & shape::kSkin) == 0 && !found.is_valid()) found = v;
    });
    return found;
  }
};

TEST(VolumeReturn, gives_exactly_what_was_lost) {
  for (const double lost6 : {2e-4, -2e-4}) {
    Halves halves;
    ASSERT_TRUE(halves.centre.is_valid());
    const double before = volume_of(halves.mesh);
    const Vec3 place = halves.mesh.rest(halves.centre);
    CareOf care(halves.mesh);
    care.references.set_original(halves.uncut);
    ASSERT_TRUE(return_volume(care.care, halves.centre, lost6));
    EXPECT_GT(care.statistics.moved_vertices, 1U);
    EXPECT_EQ(halves.mesh.rest(halves.centre), place) << "it stays where the merge has put it";
    for (const TetId tet : care.changed) EXPECT_TRUE(halves.mesh.is_live(tet));
    care.commit();
    EXPECT_NEAR(volume_of(halves.mesh) - before, lost6 / 6.0, 1e-13);
    EXPECT_NEAR(boundary_area(halves.mesh, 0), 6.0, 1e-9) << "flat skin gives nothing";
  }
}

TEST(VolumeReturn, is_refused_where_surfaces_would_leave_their_place) {
  Halves halves;
  const std::uint64_t hash = halves.mesh.hash();
  {
    CareOf care(halves.mesh);
    care.references.set_original(halves.uncut);
    EXPECT_FALSE(return_volume(care.care, halves.centre, 0.05));
  }
  EXPECT_EQ(halves.mesh.hash(), hash) << "the caller rolls back";
}

TEST(VolumeReturn, takes_rounding_for_nothing) {
  Halves halves;
  CareOf care(halves.mesh);
  EXPECT_TRUE(return_volume(care.care, halves.centre, 1e-17));
  EXPECT_EQ(care.statistics.moved_vertices, 0U);
}

}  // namespace
}  // namespace incise::test::volume_return_test
