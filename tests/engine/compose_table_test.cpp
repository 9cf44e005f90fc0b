// SPDX-License-Identifier: Apache-2.0
// Rows of the table of ways to make an incision in several strokes, in bodies that stand in several ways, with the last
// stroke undone, redone and made again. The whole table takes minutes; these rows stand for all of its classes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "compose/compose_run.h"
#include "support/campaign.h"

namespace incise::test::compose_table_test {
namespace {

enum class Body : std::uint8_t { kKuhn, kJittered };

TetSoup soup_of(Body body) {
  TetSoup soup = kuhn_cube(body == Body::kKuhn ? 5 : 6);
  if (body == Body::kJittered) jitter(soup, 0.2, 4);
  return soup;
}

constexpr std::array<std::string_view, 38> kRows = {"abutting oblique 2",
                                                    "abutting oblique 14",
                                                    "abutting oblique 28",
                                                    "abutting straight 3",
                                                    "abutting straight 28",
                                                    "overlap oblique 0.05",
                                                    "overlap oblique 0.5",
                                                    "overlap oblique 2",
                                                    "gap oblique 0.02",
                                                    "gap oblique 0.1",
                                                    "gap oblique 0.25",
                                                    "both sides oblique 0",
                                                    "both sides oblique -0.05",
                                                    "both sides oblique -0.25",
                                                    "both sides skew 5 degrees oblique",
                                                    "deeper oblique 4",
                                                    "deeper oblique 8",
                                                    "other side oblique",
                                                    "ends on mesh planes",
                                                    "ends on the skin",
                                                    "ends just below the skin",
                                                    "abutting cylinder 7",
                                                    "ring 2",
                                                    "ring 5",
                                                    "again 50 times, beside 0",
                                                    "part 20 times",
                                                    "parallel 0.1",
                                                    "parallel 0.25",
                                                    "parallel 0.5",
                                                    "T along its wall, degrees 90, off 0",
                                                    "T to its wall, degrees 90, off 0",
                                                    "T from its wall, degrees 90, off 0",
                                                    "T to its wall, degrees 30, off 0",
                                                    "cross, degrees 90",
                                                    "cross, degrees 30",
                                                    "star of 4 planes",
                                                    "short steps straight 0.1",
                                                    "short steps oblique 0.2"};

/// What a row gives today that falls short of what it must give (compose_rows.h; L/r at most 25): it is not to get
/// worse. A row that has come to hold is to be taken out.
/// - Gaps and parallel planes of 0.1 and 0.25 elements are at the limits of what is welded or shaved (0.08 and 0.2
///   spacings, a spacing is 1.24 elements): 25 < L/r, and 2 pieces of 3.
/// - Rings in bodies that have moved leave tissue joined where they close, in one stroke, too; so does one row of 28
/// strokes in a stretched body, where it leaves it.
struct Short {
  Body body;
  Stance stance;
  std::string_view name;
  std::size_t pieces;  ///< other than they must be, or as they must be
  double lr, growth;   ///< at most
};

constexpr std::array<Short, 12> kShort = {{
    {Body::kKuhn, Stance::kRest, "parallel 0.25", 2, 31, 1.3},
    {Body::kJittered, Stance::kRest, "both sides oblique -0.05", 1, 25, 1.3},
    {Body::kKuhn, Stance::kSheared, "ring 2", 1, 25, 1.3},
    {Body::kKuhn, Stance::kSheared, "ring 5", 1, 25, 1.55},
    {Body::kKuhn, Stance::kSheared, "parallel 0.25", 2, 31, 1.3},
    {Body::kKuhn, Stance::kStretched, "abutting straight 28", 1, 25, 1.3},
    {Body::kKuhn, Stance::kStretched, "ring 2", 1, 25, 1.3},
    {Body::kKuhn, Stance::kStretched, "ring 5", 1, 117, 1.3},
    {Body::kKuhn, Stance::kStretched, "parallel 0.25", 2, 31, 1.3},
    {Body::kKuhn, Stance::kSwaying, "ring 2", 1, 56, 1.3},
    {Body::kKuhn, Stance::kSwaying, "ring 5", 1, 56, 1.4},
    {Body::kKuhn, Stance::kSwaying, "parallel 0.25", 2, 31, 1.3},
}};

const Short* find_short(Body body, Stance stance, std::string_view name) {
  const auto found = std::find_if(kShort.begin(), kShort.end(), [&](const Short& s) {
    return s.body == body && s.stance == stance && s.name == name;
  });
  return found == kShort.end() ? nullptr : &*found;
}

/// By day, but in the body that rests: those that fall short, and every fourth one of the others.
void expect_rows(Body body, Stance stance) {
  const TetSoup soup = soup_of(body);
  unsigned number = 0;
  for (const ComposeRow& row : compose_rows()) {
    if (std::find(kRows.begin(), kRows.end(), row.name) == kRows.end()) continue;
    const bool is_slow = row.strokes.size() >= 20 && row.growth < 1.3;  // many retraces
    if (stance > of_campaign(Stance::kRest, Stance::kSheared) && is_slow) continue;
    const Short* today = find_short(body, stance, row.name);
    const bool is_whole = stance == Stance::kRest && body == Body::kKuhn;
    const bool is_of_slice = is_whole || today != nullptr || number++ % 4 == 0;
    if (!is_of_slice && !is_whole_campaign()) continue;
    SCOPED_TRACE(row.name);
    const ComposeFigures figures = measure_row(soup, row, stance, true);
    const ComposeOutcome& outcome = figures.outcome;
    EXPECT_EQ(outcome.error, "");
    EXPECT_TRUE(outcome.is_undone);
    EXPECT_TRUE(outcome.pieces == row.pieces || (today != nullptr && outcome.pieces == today->pieces))
        << outcome.pieces << " pieces";
    EXPECT_LE(outcome.lr, today == nullptr ? kMostLr : today->lr);
    EXPECT_LE(figures.growth, today == nullptr ? row.growth : today->growth);
  }
}

TEST(ComposeTable, short_steps_take_the_front_along) {
  unsigned number = 0;
  for (const Body body : of_campaign<std::vector<Body>>({Body::kJittered}, {Body::kKuhn, Body::kJittered})) {
    for (const ComposeRow& row : compose_rows()) {
      if (row.name.rfind("short steps", 0) != 0 || number++ % of_campaign(2U, 1U) != 0) continue;
      SCOPED_TRACE(row.name);
      const ComposeFigures figures = measure_row(soup_of(body), row, Stance::kRest, true);
      EXPECT_TRUE(holds(row, figures)) << figures.outcome.pieces << " pieces, L/r " << figures.outcome.lr;
      EXPECT_NEAR(figures.area, 1.0, 0.01);
    }
  }
}

TEST(ComposeTable, at_rest) {
  expect_rows(Body::kKuhn, Stance::kRest);
}
TEST(ComposeTable, at_rest_jittered) {
  expect_rows(Body::kJittered, Stance::kRest);
}
TEST(ComposeTable, sheared) {
  expect_rows(Body::kKuhn, Stance::kSheared);
}
TEST(ComposeTable, stretched) {
  expect_rows(Body::kKuhn, Stance::kStretched);
}
TEST(ComposeTable, swaying) {
  expect_rows(Body::kKuhn, Stance::kSwaying);
}

}  // namespace
}  // namespace incise::test::compose_table_test
