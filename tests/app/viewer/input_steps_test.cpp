// SPDX-License-Identifier: Apache-2.0
#include "app/viewer/input_steps.h"

#include <gtest/gtest.h>

#include <vector>

namespace incise::app::input_steps_test {
namespace {

using Kind = PointerEvent::Kind;

PointerEvent pointer(Kind kind) {
  PointerEvent event;
  event.kind = kind;
  return event;
}

std::vector<std::size_t> steps_of(std::span<const InputEvent> events) {
  std::vector<std::size_t> lengths;
  while (!events.empty()) {
    lengths.push_back(step_length(events));
    events = events.subspan(lengths.back());
  }
  return lengths;
}

TEST(InputSteps, without_events_there_is_none) {
  EXPECT_EQ(step_length({}), 0U);
}

TEST(InputSteps, the_ways_of_a_pointer_are_one) {
  const std::vector<InputEvent> events(5, pointer(Kind::kMove));
  EXPECT_EQ(steps_of(events), std::vector<std::size_t>{5});
}

TEST(InputSteps, a_press_comes_with_its_way_and_its_release_in_the_next) {
  const std::vector<InputEvent> events = {pointer(Kind::kMove), pointer(Kind::kMove), pointer(Kind::kPress),
                                          pointer(Kind::kRelease), pointer(Kind::kMove)};
  EXPECT_EQ(steps_of(events), (std::vector<std::size_t>{3, 1, 1}));
}

TEST(InputSteps, two_clicks_are_four) {
  const std::vector<InputEvent> events = {pointer(Kind::kPress), pointer(Kind::kRelease), pointer(Kind::kPress),
                                          pointer(Kind::kRelease)};
  EXPECT_EQ(steps_of(events), (std::vector<std::size_t>{1, 1, 1, 1}));
}

TEST(InputSteps, a_key_goes_down_and_up_in_two) {
  const std::vector<InputEvent> events = {KeyChange{65, 0, 1, 0, KeyPress{"A"}}, TypedCharacter{97},
                                          KeyChange{65, 0, 0, 0, {}}};
  EXPECT_EQ(steps_of(events), (std::vector<std::size_t>{1, 1, 1}));
}

TEST(InputSteps, what_ends_a_way_may_be_the_windows_rim_or_a_file) {
  const std::vector<InputEvent> events = {pointer(Kind::kMove), PointerLeft{}, pointer(Kind::kMove),
                                          DroppedFile{"cube.mesh"}};
  EXPECT_EQ(steps_of(events), (std::vector<std::size_t>{2, 2}));
}

}  // namespace
}  // namespace incise::app::input_steps_test
