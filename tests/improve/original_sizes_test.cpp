// SPDX-License-Identifier: Apache-2.0
// The size of the elements that a body came with is known wherever it was cut.
#include "improve/original_sizes.h"

#include <gtest/gtest.h>

namespace incise::test {
namespace {

Step step_with_birth(VertexId id, std::array<VertexId, 4> parents, std::array<double, 4> weights) {
  Step step;
  step.born.push_back({id, parents, weights, Vec3::Zero(), Vec3::Zero()});
  return step;
}

TEST(OriginalSizes, are_unknown_before_anything_was_noted) {
  const OriginalSizes sizes;
  EXPECT_EQ(sizes.at(VertexId(7)), 0.0);
}

TEST(OriginalSizes, are_the_mean_of_the_edges_noted_at_a_vertex) {
  OriginalSizes sizes;
  sizes.note_edge(VertexId(0), VertexId(1), 1.0);
  sizes.note_edge(VertexId(1), VertexId(2), 3.0);
  EXPECT_EQ(sizes.at(VertexId(0)), 1.0);
  EXPECT_EQ(sizes.at(VertexId(1)), 2.0);
  EXPECT_EQ(sizes.at(VertexId(2)), 3.0);
}

TEST(OriginalSizes, are_handed_on_to_vertices_that_are_born_and_copied) {
  OriginalSizes sizes;
  sizes.note_edge(VertexId(0), VertexId(2), 1.0);
  sizes.note_edge(VertexId(1), VertexId(3), 5.0);
  Step step = step_with_birth(VertexId(9), {VertexId(0), VertexId(1), VertexId(), VertexId()}, {0.25, 0.75, 0, 0});
  step.copied.push_back({VertexId(10), VertexId(9)});
  sizes.follow(step);
  EXPECT_DOUBLE_EQ(sizes.at(VertexId(9)), 4.0);
  EXPECT_DOUBLE_EQ(sizes.at(VertexId(10)), 4.0);
}

TEST(OriginalSizes, of_a_slot_that_is_used_again_are_those_of_the_new_vertex) {
  OriginalSizes sizes;
  sizes.note_edge(VertexId(0), VertexId(1), 2.0);
  sizes.note_edge(VertexId(9), VertexId(8), 7.0);
  sizes.follow(step_with_birth(VertexId(9), {VertexId(0), VertexId(), VertexId(), VertexId()}, {1, 0, 0, 0}));
  EXPECT_EQ(sizes.at(VertexId(9)), 2.0);
}

}  // namespace
}  // namespace incise::test
