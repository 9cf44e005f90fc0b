// SPDX-License-Identifier: Apache-2.0
// The copies of one vertex: one per part of its star.
#include "cut/star_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "incise/mesh/star.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::star_parts_test {
namespace {

/// The middle of a Kuhn cube; faces of its star can be opened and closed.
class Middle {
 public:
  Middle() {
    mesh_.for_each_vertex([&](VertexId v) {
      if ((mesh_.rest(v) - Vec3(0.5, 0.5, 0.5)).norm() < 1e-12) vertex_ = v;
    });
    tets_ = StarWalker().star(mesh_, vertex_);
  }
  [[nodiscard]] const TetMesh& mesh() const { return mesh_; }
  [[nodiscard]] VertexId vertex() const { return vertex_; }
  [[nodiscard]] const std::vector<TetId>& tets() const { return tets_; }
  [[nodiscard]] bool is_right(TetId tet) const {
    Vec3 sum = Vec3::Zero();
    for (const VertexId v : mesh_.vertices(tet)) sum += mesh_.rest(v);
    return sum.x() > 2;
  }
  /// Divides the star along the plane x = ½, or joins it there; new tets are those for which `is_new` holds.
  template <class IsNew>
  std::uint64_t divide(bool opens, IsNew&& is_new, const StarParts::Home& home) {
    Transaction transaction(mesh_);
    std::vector<StarTet> star;
    for (const TetId tet : tets_) {
      star.push_back({tet, corner_of(tet), is_new(tet), kInvalidIndex, 0});
      for (unsigned s = 0; s < 4; ++s) turn(transaction, Side(tet, s), opens);
    }
    const std::uint64_t made = parts_.divide(transaction, complex_, old_, vertex_, star, home, {{1, 1}, false}).made;
    step_ = transaction.commit();
    return made;
  }
  [[nodiscard]] const Step& step() const { return step_; }
  [[nodiscard]] std::set<VertexId> copies_at(bool right) const {
    std::set<VertexId> found;
    for (const TetId tet : tets_) {
      if (is_right(tet) == right) found.insert(mesh_.vertices(tet)[corner_of(tet)]);
    }
    return found;
  }
  void stand(VertexId vertex, const Vec3& place) {
    std::vector<Vec3> current(mesh_.vertex_slots(), Vec3::Zero());
    mesh_.for_each_vertex([&](VertexId v) { current[v.value] = v == vertex ? place : mesh_.current(v); });
    mesh_.set_current(current);
  }
  [[nodiscard]] const ClosedComplex& complex() const { return complex_; }

 private:
  [[nodiscard]] unsigned corner_of(TetId tet) const { return complex_.closed_corner(mesh_, tet, vertex_); }
  /// Opens or joins a side on the plane.
  void turn(Transaction& transaction, Side side, bool opens) {
    const auto v = mesh_.vertices(side);
    if (std::any_of(v.begin(), v.end(), [&](VertexId w) { return mesh_.rest(w).x() != 0.5; })) return;
    if (std::none_of(v.begin(), v.end(), [&](VertexId w) { return complex_.closed(w) == vertex_; })) return;
    if (opens && !mesh_.link(side).is_boundary()) {
      walls_.push_back({side, mesh_.link(side).side()});
      transaction.open(side, mesh_.link(side).side(), 1);
    } else if (!opens) {
      for (const auto& [a, b] : walls_) transaction.join(a, b);
    }
  }

  TetMesh mesh_ = build(kuhn_cube(2));
  SplitTemplates templates_;
  ClosedComplex complex_{templates_};
  OldChildren old_;
  StarParts parts_;
  VertexId vertex_;
  std::vector<TetId> tets_;
  std::vector<std::array<Side, 2>> walls_;
  Step step_;
};

const StarParts::Home kNoHome = [](std::span<const StarTet>) { return VertexId(); };

TEST(StarParts, keep_a_whole_star_as_it_is) {
  Middle middle;
  EXPECT_EQ(middle.divide(
                false, [](TetId) { return true; }, kNoHome),
            0U);
  EXPECT_EQ(middle.copies_at(true), std::set{middle.vertex()});
  EXPECT_EQ(middle.copies_at(false), std::set{middle.vertex()});
}

TEST(StarParts, give_either_side_a_copy_of_its_own) {
  Middle middle;
  EXPECT_EQ(middle.divide(
                true, [](TetId) { return true; }, kNoHome),
            1U);
  ASSERT_EQ(middle.copies_at(true).size(), 1U);
  ASSERT_EQ(middle.copies_at(false).size(), 1U);
  const VertexId right = *middle.copies_at(true).begin(), left = *middle.copies_at(false).begin();
  EXPECT_NE(right, left);
  EXPECT_EQ(middle.complex().closed(right), middle.vertex());
  EXPECT_EQ(middle.complex().closed(left), middle.vertex());
  EXPECT_EQ(middle.mesh().shape_of(right), shape::kWall);
}

TEST(StarParts, let_the_part_that_is_at_home_keep_the_vertex) {
  for (const bool right : {false, true}) {
    Middle middle;
    middle.divide(
        true, [](TetId) { return true; },
        [&](std::span<const StarTet> part) {
          return middle.is_right(part[0].tet) == right ? middle.vertex() : VertexId();
        });
    EXPECT_EQ(middle.copies_at(right), std::set{middle.vertex()});
  }
}

TEST(StarParts, leave_tets_from_before_their_copy) {
  for (const bool right : {false, true}) {
    Middle middle;
    middle.divide(
        true, [](TetId) { return true; }, kNoHome);
    const auto before = std::pair(middle.copies_at(false), middle.copies_at(true));
    middle.stand(*before.second.begin(), Vec3(0.7, 0.5, 0.5));
    middle.divide(
        true, [&](TetId tet) { return middle.is_right(tet) == right; }, kNoHome);
    EXPECT_EQ(right ? middle.copies_at(false) : middle.copies_at(true), right ? before.first : before.second);
  }
}

TEST(StarParts, bury_a_copy_that_no_part_needs_and_keep_the_closed_vertex_alive) {
  for (const bool right : {false, true}) {  // the side that was there before
    Middle middle;
    middle.divide(
        true, [](TetId) { return true; }, kNoHome);
    const VertexId left_copy = *middle.copies_at(false).begin(), right_copy = *middle.copies_at(true).begin();
    middle.stand(left_copy, Vec3(0.4, 0.5, 0.5));
    middle.stand(right_copy, Vec3(0.6, 0.5, 0.5));
    EXPECT_EQ(middle.divide(
                  false, [&](TetId tet) { return middle.is_right(tet) != right; }, kNoHome),
              0U);
    EXPECT_EQ(middle.copies_at(true), std::set{middle.vertex()});
    EXPECT_EQ(middle.copies_at(false), std::set{middle.vertex()});
    EXPECT_FALSE(middle.complex().has_copies(middle.vertex()));
    EXPECT_EQ(middle.mesh().current(middle.vertex()), Vec3(right ? 0.6 : 0.4, 0.5, 0.5));
    EXPECT_EQ(middle.step().died.size(), 1U);
    expect_valid(middle.mesh(), 1.0);
  }
}

}  // namespace
}  // namespace incise::test::star_parts_test
