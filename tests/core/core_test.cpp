// SPDX-License-Identifier: Apache-2.0
// Ids, arrays, hashes, results, stage times.
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <type_traits>
#include <unordered_set>
#include <vector>

#include "incise/core/grow_array.h"
#include "incise/core/hash.h"
#include "incise/core/id.h"
#include "incise/core/id_array.h"
#include "incise/core/profile.h"
#include "incise/core/result.h"

namespace incise::test::core_test {
namespace {

TEST(Id, is_invalid_until_given_a_slot_and_compares_by_it) {
  EXPECT_FALSE(TetId().is_valid());
  EXPECT_TRUE(TetId(0).is_valid());
  EXPECT_EQ(TetId(3), TetId(3));
  EXPECT_NE(TetId(3), TetId(4));
  EXPECT_LT(TetId(3), TetId(4));
  EXPECT_LT(TetId(3), TetId());
  EXPECT_EQ(std::unordered_set<TetId>({TetId(1), TetId(1), TetId(2)}).size(), 2U);
}

TEST(Id, of_one_kind_is_no_id_of_another) {
  static_assert(!std::is_convertible_v<std::uint32_t, TetId>);
  static_assert(!std::is_convertible_v<TetId, std::uint32_t>);
  static_assert(!std::is_constructible_v<TetId, VertexId>);
}

TEST(GrowArray, keeps_its_elements_and_its_place_while_it_grows) {
  GrowArray<std::uint64_t> array;
  array.push_back(0);
  const std::uint64_t* start = array.data();
  for (std::uint64_t i = 1; i < 300000; ++i) array.push_back(i * i);
  EXPECT_EQ(array.size(), 300000U);
  for (std::uint64_t i = 0; i < array.size(); ++i) ASSERT_EQ(array[i], i * i);
  if (sizeof(void*) == 8) {
    EXPECT_EQ(array.data(), start);
  }
}

TEST(GrowArray, resizes_with_a_value_and_pops) {
  GrowArray<int> array;
  array.resize(5, 7);
  array.resize(3);
  array.resize(6, 9);
  EXPECT_EQ(std::vector<int>(array.begin(), array.end()), (std::vector<int>{7, 7, 7, 9, 9, 9}));
  array.pop_back();
  EXPECT_EQ(array.back(), 9);
  EXPECT_EQ(array.size(), 5U);
  array.clear();
  EXPECT_TRUE(array.empty());
}

TEST(GrowArray, copies_and_moves_like_a_value) {
  GrowArray<int> array;
  for (int i = 0; i < 100; ++i) array.push_back(i);
  GrowArray<int> copy = array;
  copy[5] = -1;
  EXPECT_EQ(array[5], 5);
  GrowArray<int> moved = std::move(copy);
  EXPECT_EQ(moved[5], -1);
  EXPECT_EQ(moved.size(), 100U);
  array = moved;
  EXPECT_EQ(array[5], -1);
  GrowArray<int>& self = array;
  array = self;
  EXPECT_EQ(array.size(), 100U);
  GrowArray<int> empty;
  array = empty;
  EXPECT_TRUE(array.empty());
}

TEST(ZeroedArray, is_zero_wherever_nothing_was_written) {
  ZeroedArray<std::uint32_t> array(10);
  array[3] = 5;
  array.ensure(100000);
  EXPECT_EQ(array[3], 5U);
  for (std::size_t i = 4; i < 100000; ++i) ASSERT_EQ(array[i], 0U);
}

template <class Array, class Index>
constexpr bool kIsIndexable = requires(Array& array, Index index) {
  array[index];
};

TEST(IdArray, is_indexed_by_its_own_id) {
  IdArray<TetId, int> array;
  array.push_back(4);
  array.push_back(5);
  EXPECT_EQ(array[TetId(1)], 5);
  static_assert(kIsIndexable<IdArray<TetId, int>, TetId>);
  static_assert(!kIsIndexable<IdArray<TetId, int>, VertexId>);
}

TEST(StateHash, is_the_same_on_every_target) {
  StateHash hash;
  hash.add(std::uint64_t{1});
  hash.add(0.5);
  StateHash same;
  same.add(std::uint64_t{1});
  same.add(std::uint64_t{0x3FE0000000000000U});
  EXPECT_EQ(hash.value(), same.value());
  EXPECT_EQ(StateHash().value(), StateHash().value());
}

TEST(StateHash, tells_order_bits_and_signs_of_zero_apart) {
  std::set<std::uint64_t> values;
  const auto hash_of = [](std::initializer_list<std::uint64_t> words) {
    StateHash hash;
    for (const std::uint64_t word : words) hash.add(word);
    return hash.value();
  };
  values.insert(hash_of({}));
  values.insert(hash_of({0}));
  values.insert(hash_of({0, 0}));
  values.insert(hash_of({1, 2}));
  values.insert(hash_of({2, 1}));
  for (unsigned bit = 0; bit < 64; ++bit) values.insert(hash_of({std::uint64_t{1} << bit, 7}));
  EXPECT_EQ(values.size(), 69U);
  StateHash plus, minus;
  plus.add(0.0);
  minus.add(-0.0);
  EXPECT_NE(plus.value(), minus.value());
}

TEST(Result, holds_a_value_or_an_error) {
  const Result<int> good(4);
  ASSERT_TRUE(good.ok());
  EXPECT_EQ(*good, 4);
  const Result<int> bad(Error{ErrorCode::kBadFile, "line 3: no such thing", {3}});
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().code, ErrorCode::kBadFile);
  EXPECT_EQ(bad.error().ids, std::vector<std::uint64_t>{3});
  Result<std::vector<int>> movable(std::vector<int>(3, 1));
  EXPECT_EQ(std::move(movable).value().size(), 3U);
  EXPECT_TRUE(Status());
  EXPECT_FALSE(Status(Error{ErrorCode::kIo, "disk full", {}}));
}

TEST(StageTimes, add_up) {
  StageTimes times;
  times[Stage::kCollision] = 1.5;
  times[Stage::kSeparate] = 2;
  StageTimes more = times;
  more += times;
  EXPECT_EQ(more.total(), 7.0);
  { const StageZone zone(times, Stage::kMerge); }
  EXPECT_GE(times[Stage::kMerge], 0.0);
  EXPECT_EQ(kStageNames.size(), times.ms.size());
}

}  // namespace
}  // namespace incise::test::core_test
