// SPDX-License-Identifier: Apache-2.0
// From rows of a blade to strips: holding, slits, coming back, meeting itself.
#include "cut/blade_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "cut/strips.h"

namespace incise::test::blade_motion_test {
namespace {

/// A blade that moves in a body that is everywhere, or nowhere.
class Motion {
 public:
  explicit Motion(const Row& row, double spacing = 1.0) { motion_.begin(row, spacing); }

  BladeMotion::Move advance(const Row& row, bool flushes = false) {
    return keep(motion_.advance(
        row, sheet_, [](const SweptSurface&) { return true; }, around_, flushes));
  }
  BladeMotion::Move end() {
    return keep(motion_.end(
        sheet_, [](const SweptSurface&) { return true; }, around_));
  }
  /// Another stroke, which goes on from this one.
  void go_on(const Row& row) {
    motion_.go_on(row, 1.0);
    sheet_.clear();
  }
  /// From now on there is an older cut wherever `reach` says so; nothing is outside the body.
  void meet_older_cuts(std::function<double(const Vec3& place, const Vec3& outwards)> reach) {
    around_.has_older_cuts = true;
    around_.reach = [reach = std::move(reach)](const Vec3& place, const Vec3& outwards, const Vec3&) {
      return reach(place, outwards);
    };
    around_.is_outside = [](const Vec3&) { return false; };
    around_.retreat = [](const Vec3&, const Vec3&, double) { return 0.0; };
  }
  /// From now on there is an older wall at a plane y = `wall`, just before the blade's end.
  void pass_a_wall(double wall) {
    meet_older_cuts([](const Vec3&, const Vec3&) { return 0.0; });
    around_.retreat = [wall](const Vec3& place, const Vec3& outwards, double) {
      return outwards.y() > 0.9 && place.y() > wall && place.y() < wall + 0.1 ? place.y() - wall : 0.0;
    };
  }
  /// The last strip once more, as the first of a new sheet.
  void lay_anew() {
    auto strip = motion_.lay_anew(around_);
    sheet_.clear();
    sheet_.add(std::move(strip));
  }
  BladeMotion::Move go_over_beginning() { return keep(motion_.go_over_beginning(around_)); }
  BladeMotion::Move reach_on() { return keep(motion_.reach_on(around_)); }
  [[nodiscard]] const OwnSheet& sheet() const { return sheet_; }
  [[nodiscard]] const Strip& last() const { return *sheet_.strips().back(); }
  /// Everything swept since the sheet was started, as one.
  [[nodiscard]] std::set<SegmentKeys> whole_border() const {
    SweptSurface all;
    for (const auto& strip : sheet_.strips()) append(all, strip->surface);
    return keys_of(Strip(all, {}).border);
  }

 private:
  /// Takes the strip into the sheet; what is returned tells whether there was one.
  BladeMotion::Move keep(BladeMotion::Move move) {
    has_strip_ = move.strip != nullptr;
    if (move.starts_anew) sheet_.clear();
    if (has_strip_) sheet_.add(std::move(move.strip));
    return move;
  }

 public:
  [[nodiscard]] bool has_strip() const { return has_strip_; }

 private:
  BladeMotion motion_;
  Surroundings around_;
  OwnSheet sheet_;
  bool has_strip_ = false;
};

/// A straight blade along y at x.
Row at(double x, double z = 0) {
  return {Vec3(x, 0, z), Vec3(x, 1, z), Vec3(x, 2, z)};
}

TEST(BladeMotion, lays_a_strip_from_row_to_row_that_shares_their_points) {
  Motion blade(at(0));
  blade.advance(at(1));
  const std::size_t points = blade.last().surface.points.size();
  EXPECT_EQ(points, 6U);
  EXPECT_EQ(blade.last().surface.triangles.size(), 4U);
  EXPECT_EQ(blade.last().border.size(), 6U);
  blade.advance(at(2));
  EXPECT_EQ(blade.last().border.size(), 4U);  // not along the front between
  EXPECT_EQ(keys_of(blade.sheet().border()), blade.whole_border());
}

TEST(BladeMotion, goes_on_without_a_seam_where_another_stroke_ended) {
  Motion blade(at(0));
  blade.advance(at(1));
  const auto front = blade.last().row;
  blade.go_on(at(1));
  blade.advance(at(2));
  EXPECT_EQ(blade.last().border.size(), 6U) << "a sheet of its own";
  for (const SosPoint& point : front) {
    const auto& points = blade.last().surface.points;
    EXPECT_TRUE(std::any_of(points.begin(), points.end(), [&](const SosPoint& p) { return p.key == point.key; }));
  }
  for (const SosPoint& point : blade.last().row) {
    EXPECT_TRUE(std::none_of(front.begin(), front.end(), [&](const SosPoint& p) { return p.key == point.key; }));
  }
}

TEST(BladeMotion, holds_a_blade_that_hardly_moves_until_it_has_gone_far_enough) {
  Motion blade(at(0));
  blade.advance(at(1));
  blade.advance(at(1.03));
  EXPECT_FALSE(blade.has_strip());
  blade.advance(at(1.04));
  EXPECT_FALSE(blade.has_strip());
  blade.advance(at(1.08));
  ASSERT_TRUE(blade.has_strip());
  EXPECT_EQ(blade.last().sheet.bounds().lo.x(), 1.0);
  EXPECT_EQ(blade.last().sheet.bounds().hi.x(), 1.08);
}

TEST(BladeMotion, lays_what_was_held_at_the_end) {
  Motion blade(at(0));
  blade.advance(at(1));
  blade.advance(at(1.03));
  blade.end();
  ASSERT_TRUE(blade.has_strip());
  EXPECT_EQ(blade.last().sheet.bounds().hi.x(), 1.03);
  blade.end();
  EXPECT_FALSE(blade.has_strip());
}

TEST(BladeMotion, lays_what_was_held_when_asked_to) {
  Motion blade(at(0));
  blade.advance(at(0.01), true);
  EXPECT_TRUE(blade.has_strip());
}

TEST(BladeMotion, holds_the_points_that_do_not_move_and_moves_the_others) {
  Motion blade(at(0));
  blade.advance({Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 2, 0)});
  EXPECT_EQ(blade.last().surface.triangles.size(), 1U);
  blade.advance({Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(2, 2, 0)});
  EXPECT_EQ(blade.last().surface.triangles.size(), 1U);
}

TEST(BladeMotion, holds_a_blade_in_its_own_slit) {
  Motion blade(at(0));
  blade.advance(at(2));
  for (const double x : {1.5, 0.5, 1.0, 1.9}) {
    blade.advance(at(x, 0.1));
    EXPECT_FALSE(blade.has_strip()) << x;
  }
  blade.advance(at(3));
  ASSERT_TRUE(blade.has_strip());
  EXPECT_EQ(blade.last().sheet.bounds().lo.x(), 2.0);
}

TEST(BladeMotion, trembling_lays_the_same_strips_as_going_straight) {
  Motion blade(at(0));
  double furthest = 0;
  for (int i = 1; i <= 100; ++i) {
    const double x = 0.05 * i + (i % 2 == 0 ? 0.04 : -0.04);
    blade.advance(at(x));
    furthest = std::max(furthest, x);
  }
  blade.end();
  double area = 0;
  for (const auto& strip : blade.sheet().strips()) {
    for (std::uint32_t t = 0; t < strip->sheet.triangle_count(); ++t) area += 0.5 * strip->sheet.normal(t).norm();
  }
  EXPECT_NEAR(area, 2 * furthest, 1e-12);
  EXPECT_EQ(keys_of(blade.sheet().border()), blade.whole_border());
}

TEST(BladeMotion, trembling_across_its_way_waits_until_it_gets_on_or_turns) {
  Motion blade(at(0));
  blade.advance(at(1));
  for (const double across : {0.2, -0.2, 0.9, -0.6, 0.3}) {
    blade.advance(at(1.1, across));
    EXPECT_FALSE(blade.has_strip()) << across;
  }
  blade.advance(at(1.5, 0.3));
  EXPECT_TRUE(blade.has_strip());
  blade.advance(at(1.5, 1.2));
  EXPECT_FALSE(blade.has_strip()) << "it may come back";
  blade.advance(at(1.5, 1.4));
  EXPECT_TRUE(blade.has_strip()) << "it has turned";
}

TEST(BladeMotion, jumps_to_and_fro_lay_no_folds) {
  Motion blade(at(0));
  blade.advance(at(1));
  for (int i = 1; i <= 40; ++i) blade.advance(at(1 + 0.1 * i, i % 2 == 0 ? 0.45 : -0.45));
  double furthest = 0;
  Vec3 before(0, 0, 0);
  for (const auto& strip : blade.sheet().strips()) {
    const Vec3 way = strip->row.front().position - before;
    before = strip->row.front().position;
    EXPECT_LE(std::abs(way.z()), 1.03 * way.x());
    EXPECT_GE(before.x(), furthest);
    furthest = before.x();
  }
  EXPECT_GE(furthest, 4.0);
}

TEST(BladeMotion, what_waits_at_the_end_is_laid_unless_it_went_back) {
  for (const double x : {1.1, 0.7}) {
    Motion blade(at(0));
    blade.advance(at(1));
    blade.advance(at(x, 0.5));
    EXPECT_FALSE(blade.has_strip());
    blade.end();
    EXPECT_EQ(blade.has_strip(), x > 1) << x;
  }
}

TEST(BladeMotion, of_ends_that_shake_apart_gets_on_as_a_whole) {
  Motion blade(at(0));
  blade.advance(at(1));
  Row row = at(1.4, 0.3);
  row.front().z() += 0.15;  // this end alone would wait
  blade.advance(row);
  ASSERT_TRUE(blade.has_strip());
  EXPECT_EQ(blade.last().surface.triangles.size(), 4U);
}

TEST(BladeMotion, sliding_along_its_own_edge_is_no_tremor) {
  Motion blade(at(0));
  blade.advance(at(1));
  for (int i = 1; i <= 8; ++i) {
    Row row = at(1 + 0.06 * i);
    for (Vec3& p : row) p.y() += i % 2 == 0 ? 0.2 : -0.2;
    blade.advance(row);
    EXPECT_TRUE(blade.has_strip()) << i;
  }
}

TEST(BladeMotion, starts_anew_where_it_leaves_its_slit_elsewhere) {
  Motion blade(at(0));
  blade.advance(at(2));
  blade.advance(at(1));
  EXPECT_FALSE(blade.has_strip());
  const BladeMotion::Move move = blade.advance(at(-1));  // backwards, beyond where it began
  ASSERT_TRUE(blade.has_strip());
  EXPECT_TRUE(move.starts_anew);
  EXPECT_EQ(blade.last().sheet.bounds().lo.x(), -1.0);
  EXPECT_EQ(blade.last().sheet.bounds().hi.x(), 1.0);
}

TEST(BladeMotion, goes_on_from_its_front_where_it_leaves_its_slit_beside_it) {
  Motion blade(at(0));
  blade.advance(at(2));
  blade.advance(at(1.5));
  EXPECT_FALSE(blade.advance(at(1.5, 1)).starts_anew);
  ASSERT_TRUE(blade.has_strip());
  EXPECT_EQ(blade.last().sheet.bounds().hi.x(), 2.0);
}

TEST(BladeMotion, starts_at_its_wall_where_it_leaves_its_slit_sideways) {
  Motion blade(at(0));
  blade.advance(at(2));
  blade.advance(at(1, 0.1));
  EXPECT_TRUE(blade.advance(at(1, 1)).starts_anew);
  ASSERT_TRUE(blade.has_strip());
  EXPECT_EQ(blade.last().sheet.bounds().hi.x(), 1.0);
  EXPECT_EQ(blade.last().sheet.bounds().lo.z(), 0.0);
}

/// A blade along z that goes around a unit circle from the right.
Row around(double turns) {
  const auto [x, y] = on_circle(turns);
  return {Vec3(x, y, 0), Vec3(x, y, 1)};
}

// Fails: where the blade comes back it is within its slit, and held; a core cut by going around stays joined.
TEST(BladeMotion, sweeps_up_to_its_start_when_it_comes_back_there) {
  Motion blade(around(0), 0.1);
  for (int i = 1; i <= 16; ++i) EXPECT_FALSE(blade.advance(around(i / 16.0)).starts_anew);
  EXPECT_EQ(blade.sheet().strips().size(), 16U);
  EXPECT_EQ(blade.sheet().border().size(), 34U);  // two rings; its first row and its last, which lie in one place
  EXPECT_NEAR((blade.last().row.front().position - around(0).front()).norm(), 0.0, 1e-12);
}

TEST(BladeMotion, starts_anew_where_it_meets_itself) {
  Motion blade({Vec3(0, 0, 0), Vec3(0, 0, 1)}, 0.05);
  blade.advance({Vec3(2, 0, 0), Vec3(2, 0, 1)});
  blade.advance({Vec3(2, 1, 0), Vec3(2, 1, 1)});
  blade.advance({Vec3(1, 1, 0), Vec3(1, 1, 1)});
  const BladeMotion::Move move = blade.advance({Vec3(1, -1, 0), Vec3(1, -1, 1)});
  EXPECT_TRUE(move.starts_anew);
  ASSERT_TRUE(blade.has_strip());
  EXPECT_EQ(blade.sheet().strips().size(), 1U);
  EXPECT_EQ(blade.last().sheet.bounds().lo.y(), -1.0);
  EXPECT_EQ(blade.last().sheet.bounds().hi.y(), 1.0);
}

// Fails: at a corner nothing lies along the new strip behind it, and what is left there of the old front stays joined.
TEST(BladeMotion, lays_the_last_strips_once_more_in_a_new_sheet) {
  Motion blade(at(0));
  blade.meet_older_cuts([](const Vec3&, const Vec3&) { return 0.0; });
  for (const double x : {0.5, 1.0, 1.5, 1.7, 1.9}) blade.advance(at(x));
  blade.advance(at(1.9, 1.1));
  blade.lay_anew();
  EXPECT_EQ(blade.last().sheet.bounds().lo.x(), 0.5);
  EXPECT_EQ(blade.last().sheet.bounds().hi.z(), 1.1);
  double area = 0, again = 0;
  for (std::uint32_t t = 0; t < blade.last().sheet.triangle_count(); ++t) {
    (blade.last().sheet.reaches_on(t) ? again : area) += 0.5 * blade.last().sheet.normal(t).norm();
  }
  EXPECT_NEAR(area, 2 * 1.1, 1e-12);
  EXPECT_NEAR(again, 2 * 1.4, 1e-12);
}

/// A blade that turns about its end at the origin.
Row turned(double turns) {
  const auto [x, y] = on_circle(turns);
  return {Vec3(0, 0, 0), Vec3(4 * x, 4 * y, 0)};
}

TEST(BladeMotion, starts_anew_where_it_laps_over_its_start_about_an_end) {
  Motion blade(turned(0), 0.2);
  for (int i = 1; i <= 9; ++i) EXPECT_FALSE(blade.advance(turned(0.1 * i)).starts_anew) << i;
  EXPECT_TRUE(blade.advance(turned(1.03)).starts_anew);
}

// Fails where only strips that meet count: these pass beside each other.
TEST(BladeMotion, starts_anew_where_it_comes_round_a_little_beside_its_start) {
  Motion blade(turned(0), 0.2);
  for (int i = 1; i < 100; ++i) EXPECT_FALSE(blade.advance(turned(0.01 * i)).starts_anew) << i;
  Row row = turned(1.003);
  row.back().z() += 0.03;
  EXPECT_TRUE(blade.advance(row).starts_anew);
}

// Fails where a way is asked at a few shares of its length: it begins with a gap, and is held.
TEST(BladeMotion, goes_on_over_a_gap_into_its_slit) {
  Motion blade(turned(0), 0.2);
  for (const double turns : {0.3, 0.6, 0.97}) blade.advance(turned(turns));
  blade.advance(turned(1.2));
  EXPECT_TRUE(blade.has_strip());
}

TEST(BladeMotion, reaches_back_into_an_older_cut_that_ends_where_it_starts) {
  Motion blade(at(0));
  blade.meet_older_cuts([](const Vec3& place, const Vec3& outwards) {
    return place.x() < 0.01 && outwards.x() < -0.5 && place.y() < 1.01 ? 0.3 : 0.0;
  });
  blade.advance(at(1));
  EXPECT_NEAR(blade.last().sheet.bounds().lo.x(), -0.3, 1e-12);
  EXPECT_EQ(keys_of(blade.sheet().border()), blade.whole_border());
  double area = 0;
  for (std::uint32_t t = 0; t < blade.last().sheet.triangle_count(); ++t) {
    const std::array<Vec3, 3> p = {blade.last().sheet.point(t, 0).position, blade.last().sheet.point(t, 1).position,
                                   blade.last().sheet.point(t, 2).position};
    area += 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
  }
  EXPECT_NEAR(area, 2.0 + 0.3 * 1.0, 1e-12);  // half of its edge is at the older cut
}

TEST(BladeMotion, draws_back_an_end_that_passes_an_older_wall_by_very_little) {
  Motion blade(at(0));
  blade.pass_a_wall(1.95);
  blade.advance(at(1));
  EXPECT_NEAR(blade.last().sheet.bounds().hi.y(), 1.95, 1e-12);
  blade.advance(at(2));
  EXPECT_NEAR(blade.last().sheet.bounds().hi.y(), 1.95, 1e-12);
  EXPECT_EQ(keys_of(blade.sheet().border()), blade.whole_border());
  Motion beyond(at(0));
  beyond.pass_a_wall(1.5);
  beyond.advance(at(1));
  EXPECT_NEAR(beyond.last().sheet.bounds().hi.y(), 2.0, 1e-12) << "it means to pass";
}

TEST(BladeMotion, reaches_on_into_an_older_cut_where_it_ends) {
  Motion blade(at(0));
  blade.meet_older_cuts(
      [](const Vec3& place, const Vec3& outwards) { return place.x() > 0.99 && outwards.x() > 0.5 ? 0.3 : 0.0; });
  blade.advance(at(1));
  EXPECT_EQ(blade.last().sheet.bounds().hi.x(), 1.0);
  blade.reach_on();
  ASSERT_TRUE(blade.has_strip());
  EXPECT_NEAR(blade.last().sheet.bounds().hi.x(), 1.3, 1e-12);
  EXPECT_EQ(keys_of(blade.sheet().border()), blade.whole_border());
}

TEST(BladeMotion, reaches_on_beside_the_traces_of_its_ends) {
  Motion blade(at(0));
  blade.meet_older_cuts([](const Vec3& place, const Vec3& outwards) {
    return place.y() < 0.01 && outwards.y() < -0.5 && place.x() > 0.9 && place.x() < 3.1 ? 0.3 : 0.0;
  });
  for (const double x : {1.0, 2.0, 3.0, 4.0}) {
    blade.advance(at(x));
    EXPECT_EQ(keys_of(blade.sheet().border()), blade.whole_border()) << x;
    EXPECT_NEAR(blade.last().sheet.bounds().lo.y(), -0.3, 1e-12) << x;
    const double reach = x == 2.0 || x == 3.0 ? 0.3 : 0.15;  // on the average: it begins with nothing, and ends so
    double area = 0;
    for (std::uint32_t t = 0; t < blade.last().sheet.triangle_count(); ++t) {
      area += 0.5 * blade.last().sheet.normal(t).norm();
    }
    EXPECT_NEAR(area, 2.0 + reach, 1e-12) << x;
  }
}

TEST(BladeMotion, of_a_closed_edge_has_no_border_along_it) {
  const auto ring = [](double z) {
    Row row;
    for (int i = 0; i < 12; ++i) {
      const auto [x, y] = on_circle(i / 12.0);
      row.emplace_back(x, y, z);
    }
    row.push_back(row.front());
    return row;
  };
  Motion blade(ring(0), 0.2);
  blade.advance(ring(1));
  blade.advance(ring(2));
  EXPECT_EQ(blade.sheet().border().size(), 24U);
}

// Fails where parts of the front are held while others go on: held segments count as inner, and leave the border of the
// sheet although it still ends there.
TEST(BladeMotion, ends_where_all_that_it_swept_does) {
  Random random(1);
  for (unsigned run = 0; run < 30; ++run) {
    SCOPED_TRACE(run);
    std::array<double, 5> x{};
    const auto row = [&] {
      Row points;
      for (std::size_t c = 0; c < x.size(); ++c) points.emplace_back(x[c], static_cast<double>(c), 0);
      return points;
    };
    Motion blade(row());
    for (unsigned step = 0; step < 8; ++step) {
      for (double& place : x) place += random.integer(0, 2) == 0 ? 0.0 : 0.7;
      EXPECT_FALSE(blade.advance(row()).starts_anew);
      EXPECT_EQ(keys_of(blade.sheet().border()), blade.whole_border()) << step;
    }
  }
}

/// An upright blade at a place of the plane.
Row upright(double x, double y) {
  return {Vec3(x, y, 0), Vec3(x, y, 1)};
}

TEST(BladeMotion, lays_the_last_side_of_a_ring_that_comes_to_its_beginning_in_one_step) {
  Motion blade(upright(0, 0), 0.5);
  blade.advance(upright(1, 0));
  blade.advance(upright(0.5, 0.8));
  ASSERT_TRUE(blade.has_strip());
  EXPECT_TRUE(blade.advance(upright(0, 0)).is_full_turn);
  ASSERT_TRUE(blade.has_strip()) << "it goes back against its course, and ends on its sheet";
  EXPECT_NEAR(blade.last().sheet.bounds().hi.y(), 0.8, 1e-12);
}

TEST(BladeMotion, waits_beside_its_slit_where_it_has_not_left_it) {
  Motion blade(upright(0, 0), 0.5);
  blade.advance(upright(1, 0));
  blade.advance(upright(2, 0));
  EXPECT_FALSE(blade.advance(upright(1.2, 0.2)).is_full_turn);
  EXPECT_FALSE(blade.has_strip());
}

TEST(BladeMotion, goes_over_its_first_strips_once_more_where_it_has_come_round) {
  Motion blade(upright(0, 0), 0.5);
  EXPECT_EQ(blade.go_over_beginning().strip, nullptr);
  for (const double x : {0.3, 0.6, 0.9, 1.2}) EXPECT_FALSE(blade.advance(upright(x, 0)).is_full_turn);
  blade.advance(upright(1.2, 1.2));
  blade.advance(upright(0, 1.2));
  EXPECT_TRUE(blade.advance(upright(0, 0)).is_full_turn);
  for (const double x : {0.3, 0.6}) {  // more than a spacing
    blade.go_over_beginning();
    ASSERT_TRUE(blade.has_strip());
    EXPECT_EQ(blade.last().row.front().position, Vec3(x, 0, 0));
  }
  blade.go_over_beginning();
  EXPECT_FALSE(blade.has_strip());
}

}  // namespace
}  // namespace incise::test::blade_motion_test
