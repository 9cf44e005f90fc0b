// SPDX-License-Identifier: Apache-2.0
#include "incise/core/triple_buffer.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

namespace incise::triple_buffer_test {
namespace {

TEST(TripleBuffer, HasTheInitialValueUntilOneIsTaken) {
  TripleBuffer<int> buffer(7);
  EXPECT_FALSE(buffer.take());
  EXPECT_EQ(buffer.value(), 7);
}

TEST(TripleBuffer, TakesTheNewestOnceAndDropsOlderOnes) {
  TripleBuffer<int> buffer;
  buffer.publish(1);
  buffer.publish(2);
  buffer.publish(3);
  EXPECT_TRUE(buffer.take());
  EXPECT_EQ(buffer.value(), 3);
  EXPECT_FALSE(buffer.take());
  EXPECT_EQ(buffer.value(), 3);
}

TEST(TripleBuffer, AValueTakenStaysWhileOthersArePublished) {
  TripleBuffer<int> buffer;
  buffer.publish(1);
  ASSERT_TRUE(buffer.take());
  for (int i = 2; i < 10; ++i) {
    buffer.publish(i);
    EXPECT_EQ(buffer.value(), 1);
  }
  ASSERT_TRUE(buffer.take());
  EXPECT_EQ(buffer.value(), 9);
}

/// Many words, so that half a value would show.
struct Wide {
  std::array<std::uint64_t, 48> words{};
};

Wide wide(std::uint64_t number) {
  Wide value;
  value.words.fill(number);
  return value;
}

TEST(TripleBuffer, TwoThreadsNeverSeeHalfAValueNorAnOlderOne) {
  constexpr std::uint64_t kLast = 200000;
  TripleBuffer<Wide> buffer;
  std::thread producer([&] {
    for (std::uint64_t i = 1; i <= kLast; ++i) buffer.publish(wide(i));
  });
  std::uint64_t newest = 0, torn = 0, older = 0, taken = 0;
  while (newest < kLast) {
    if (!buffer.take()) {
      std::this_thread::yield();
      continue;
    }
    const Wide& value = buffer.value();
    for (const std::uint64_t word : value.words) torn += word != value.words[0];
    older += value.words[0] <= newest;
    newest = value.words[0];
    ++taken;
  }
  producer.join();
  EXPECT_EQ(torn, 0U);
  EXPECT_EQ(older, 0U);
  EXPECT_GT(taken, 0U);
  EXPECT_FALSE(buffer.take());
}

}  // namespace
}  // namespace incise::triple_buffer_test
