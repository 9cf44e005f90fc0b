// SPDX-License-Identifier: Apache-2.0
// A follower that sees the C interface alone has the mesh, slot for slot.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

#include "handle.h"

namespace journal_test {
namespace {

using incise_test::cube;
using incise_test::cut_plane;
using incise_test::EngineHandle;
using incise_test::rows;
using incise_test::sized;

using Vertices = std::array<std::uint32_t, 4>;
using Point = std::array<double, 3>;

Vertices vertices_of(const std::uint32_t (&from)[4]) {
  return {from[0], from[1], from[2], from[3]};
}

/// What a solver keeps.
class Follower {
 public:
  explicit Follower(const incise_engine* engine) : engine_(engine) {
    read(tets_, rest_);
    incise_cursor_create(engine, &cursor_);
  }
  ~Follower() { incise_cursor_free(cursor_); }
  Follower(const Follower&) = delete;
  Follower& operator=(const Follower&) = delete;

  void follow() {
    std::int32_t way = -1;
    std::uint64_t position = 0;
    ASSERT_EQ(incise_cursor_way(cursor_, engine_, &way, &position), INCISE_OK);
    ASSERT_EQ(way, INCISE_WAY_FORWARD);
    auto journal = sized<incise_journal>();
    ASSERT_EQ(incise_engine_journal(engine_, &journal), INCISE_OK);
    for (; position < journal.position; ++position) apply(position);
    ASSERT_EQ(incise_cursor_move(cursor_, engine_), INCISE_OK);
  }

  void expect_equal_to_the_mesh() const {
    std::map<std::uint32_t, Vertices> tets;
    std::map<std::uint32_t, Point> rest;
    read(tets, rest);
    EXPECT_EQ(tets_, tets);
    EXPECT_EQ(rest_, rest);
  }
  [[nodiscard]] const incise_cursor* cursor() const { return cursor_; }

 private:
  void read(std::map<std::uint32_t, Vertices>& tets, std::map<std::uint32_t, Point>& rest) const {
    const auto all = rows<Vertices>(engine_, INCISE_TETS);
    for (std::uint32_t i = 0; i < all.size(); ++i) {
      if (all[i][0] != INCISE_NONE) tets[i] = all[i];
    }
    const auto points = rows<Point>(engine_, INCISE_REST);
    const auto shapes = rows<std::uint8_t>(engine_, INCISE_SHAPES);
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      if ((shapes[i] & INCISE_SHAPE_DEAD) == 0) rest[i] = points[i];
    }
  }

  template <class Record, class Get>
  std::vector<Record> list(Get get, std::uint64_t step) const {
    std::uint64_t count = 0;
    EXPECT_EQ(get(engine_, step, nullptr, 0, &count), INCISE_OK);
    std::vector<Record> records(count);
    EXPECT_EQ(get(engine_, step, records.data(), count, &count), INCISE_OK);
    return records;
  }

  void apply(std::uint64_t step) {
    for (const auto& r : list<incise_born>(incise_engine_step_born, step))
      rest_[r.id] = {r.rest[0], r.rest[1], r.rest[2]};
    for (const auto& r : list<incise_moved>(incise_engine_step_moved, step)) {
      rest_[r.id] = {r.rest[0], r.rest[1], r.rest[2]};
    }
    for (const auto& r : list<incise_copied>(incise_engine_step_copied, step)) rest_[r.id] = rest_[r.source];
    for (const auto& r : list<incise_consumed>(incise_engine_step_consumed, step)) {
      EXPECT_EQ(tets_[r.id], vertices_of(r.vertices));
      tets_.erase(r.id);
    }
    for (const auto& r : list<incise_produced>(incise_engine_step_produced, step))
      tets_[r.id] = vertices_of(r.vertices);
    for (const auto& r : list<incise_rewired>(incise_engine_step_rewired, step)) tets_[r.id] = vertices_of(r.vertices);
    for (const std::uint32_t id : list<std::uint32_t>(incise_engine_step_died, step)) rest_.erase(id);
    expect_counts_of(step);
  }

  void expect_counts_of(std::uint64_t step) const {
    auto c = sized<incise_step_counts>();
    ASSERT_EQ(incise_engine_step_counts(engine_, step, &c), INCISE_OK);
    EXPECT_EQ(list<incise_opened>(incise_engine_step_opened, step).size(), c.opened);
    EXPECT_EQ(list<incise_opened>(incise_engine_step_closed, step).size(), c.closed);
    EXPECT_EQ(list<incise_edit>(incise_engine_step_edits, step).size(), c.edits);
    EXPECT_EQ(list<incise_consumed>(incise_engine_step_edit_consumed, step).size(), c.edit_consumed);
    EXPECT_EQ(list<incise_produced>(incise_engine_step_edit_produced, step).size(), c.edit_produced);
    EXPECT_EQ(list<std::uint32_t>(incise_engine_step_new_vertices, step).size(), c.new_vertices);
    EXPECT_EQ(list<std::uint32_t>(incise_engine_step_new_tets, step).size(), c.new_tets);
  }

  const incise_engine* engine_;
  incise_cursor* cursor_ = nullptr;
  std::map<std::uint32_t, Vertices> tets_;
  std::map<std::uint32_t, Point> rest_;
};

TEST(CJournal, a_follower_has_the_mesh_after_every_stroke) {
  const EngineHandle engine = cube(4);
  Follower follower(engine.get());
  for (const double offset : {0.31, 0.52, 0.77}) {
    cut_plane(engine.get(), 1, 0.3 * offset, 0.1, offset);
    follower.follow();
    follower.expect_equal_to_the_mesh();
  }
}

TEST(CJournal, a_follower_has_the_mesh_after_every_step_of_the_blade) {
  const EngineHandle engine = cube(4);
  Follower follower(engine.get());
  double edge[6] = {0.47, -0.2, 1.1, 0.52, 1.2, 1.1};
  ASSERT_EQ(incise_engine_begin_stroke(engine.get(), edge, 2, nullptr, nullptr), INCISE_OK);
  for (int i = 1; i <= 8; ++i) {
    edge[2] = edge[5] = 1.1 - 0.1 * i;
    auto report = sized<incise_report>();
    ASSERT_EQ(incise_engine_step(engine.get(), edge, 2, nullptr, &report), INCISE_OK) << incise_last_error();
    if (report.journal_end > report.journal_first) follower.follow();
    follower.expect_equal_to_the_mesh();
  }
  ASSERT_EQ(incise_engine_end_stroke(engine.get(), nullptr), INCISE_OK);
  follower.follow();
  follower.expect_equal_to_the_mesh();
}

TEST(CJournal, a_cursor_tells_of_undo) {
  const EngineHandle engine = cube(3);
  cut_plane(engine.get(), 1, 0, 0, 0.4);
  const Follower follower(engine.get());
  std::int32_t way = -1;
  ASSERT_EQ(incise_cursor_way(follower.cursor(), engine.get(), &way, nullptr), INCISE_OK);
  EXPECT_EQ(way, INCISE_WAY_NONE);
  ASSERT_EQ(incise_engine_undo(engine.get(), nullptr), INCISE_OK);
  ASSERT_EQ(incise_cursor_way(follower.cursor(), engine.get(), &way, nullptr), INCISE_OK);
  EXPECT_EQ(way, INCISE_WAY_ELSEWHERE);
}

TEST(CJournal, steps_that_are_not_kept_are_errors) {
  const EngineHandle engine = cube(3);
  auto sizes = sized<incise_step_counts>();
  EXPECT_EQ(incise_engine_step_counts(engine.get(), 0, &sizes), INCISE_BAD_ARGUMENT);
  cut_plane(engine.get(), 1, 0, 0, 0.4);
  EXPECT_EQ(incise_engine_step_counts(engine.get(), 0, &sizes), INCISE_OK);
  ASSERT_EQ(incise_engine_keep_undo(engine.get(), 1), INCISE_OK);
  cut_plane(engine.get(), 0, 1, 0, 0.4);
  EXPECT_EQ(incise_engine_step_counts(engine.get(), 0, &sizes), INCISE_BAD_ARGUMENT);
  std::uint64_t id = 9;
  EXPECT_EQ(incise_last_error_ids(&id, 1), 1U);
  EXPECT_EQ(id, 0U);
}

}  // namespace

}  // namespace journal_test
