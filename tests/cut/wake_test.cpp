// SPDX-License-Identifier: Apache-2.0
// What a stroke keeps of its cut: a band around its front, whatever its length.
#include "cut/wake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "cut/blade_motion.h"
#include "cut/stroke_cut.h"
#include "incise/mesh/components.h"
#include "incise/mesh/validate.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::wake_test {
namespace {

/// A blade that is pushed along a box of unit cells, across all of its section, in steps of half a cell.
class LongCut {
 public:
  explicit LongCut(unsigned length) : mesh_(build(jittered_box(length, 4, 4, 5))) {
    cut_.begin(1, 1.2);
    cut_.prepare(mesh_, journal_);
    motion_.begin(row_at(-0.7), 1.2);
  }
  /// Returns whether the strip came back to what the blade has left.
  bool push_to(double x) {
    const auto touches = [](const SweptSurface& /*surface*/) { return true; };
    BladeMotion::Move move = motion_.advance(row_at(x), cut_.sheet(), touches, {}, false);
    if (move.strip == nullptr) return false;
    static_cast<void>(cut_.crosses_own_cut(context(), *move.strip, 0.05));
    if (cut_.comes_back(mesh_, *move.strip)) return true;
    EXPECT_TRUE(cut_.advance(context(), std::move(move.strip), {}));
    cut_.bake(context(), {}, {});
    most_kept_ = std::max(most_kept_, cut_.complex().master_count());
    return false;
  }
  /// Whether a strip across the cut at `x` would come back to what the blade has left.
  bool comes_back_at(double x) {
    SweptSurface surface;
    const std::array<Vec3, 4> corners = {Vec3(x, -1, 1.1), Vec3(x, 5, 1.1), Vec3(x, 5, 3.1), Vec3(x, -1, 3.1)};
    for (const Vec3& p : corners) surface.points.push_back({p, next_key_++});
    surface.triangles = {{{0, 1, 2}, 0, 0}, {{0, 2, 3}, 0, 0}};
    const Strip strip(std::move(surface), {});
    static_cast<void>(cut_.crosses_own_cut(context(), strip, 0.05));
    return cut_.comes_back(mesh_, strip);
  }
  void finish() { cut_.finish(context(), {}); }

  [[nodiscard]] const TetMesh& mesh() const { return mesh_; }
  [[nodiscard]] const ClosedComplex& complex() const { return cut_.complex(); }
  [[nodiscard]] std::size_t most_kept() const { return most_kept_; }

 private:
  CutContext context() { return {mesh_, journal_, times_, statistics_}; }
  static std::vector<Vec3> row_at(double x) { return {Vec3(x, -1.0, 2.13), Vec3(x, 5.0, 2.21)}; }

  TetMesh mesh_;
  Journal journal_;
  StrokeCut cut_{CutOptions{}};
  BladeMotion motion_;
  CutStatistics statistics_;
  StageTimes times_;
  std::size_t most_kept_ = 0;
  std::uint64_t next_key_ = std::uint64_t{1} << 60U;
};

std::size_t most_kept_over(unsigned length) {
  LongCut cut(length);
  for (double x = -0.2; x < length - 1.0; x += 0.5) cut.push_to(x);
  return cut.most_kept();
}

TEST(Wake, keeps_a_band_whatever_the_length_of_the_stroke) {
  const std::size_t at_16 = most_kept_over(16), at_64 = most_kept_over(64);
  EXPECT_LT(static_cast<double>(at_64), 1.2 * static_cast<double>(at_16));
  EXPECT_LT(at_64, 1000U) << "a cut through 64 cells meets some 2,000 tets";
}

TEST(Wake, lets_go_of_all_once_the_blade_is_through) {
  LongCut cut(6);
  for (double x = -0.2; x < 9.0; x += 0.5) cut.push_to(x);
  EXPECT_EQ(cut.complex().master_count(), 0U);
  EXPECT_EQ(find_components(cut.mesh()).count(), 2U);
}

TEST(Wake, lets_go_of_nothing_beside_a_tet_that_may_still_be_made_anew) {
  LongCut cut(12);
  std::size_t open = 0;
  for (double x = -0.2; x < 8.0; x += 0.5) {
    cut.push_to(x);
    const ClosedComplex& complex = cut.complex();
    for (std::uint32_t m = 0; m < complex.size(); ++m) {
      if (complex[m].split == nullptr || complex[m].is_settled || complex[m].flagged == 0) continue;
      EXPECT_FALSE(complex.is_half_baked(m)) << x;
      ++open;
    }
  }
  EXPECT_GT(open, 500U);
}

TEST(Wake, tells_a_strip_that_comes_back) {
  LongCut cut(12);
  for (double x = -0.2; x < 8.0; x += 0.5) ASSERT_FALSE(cut.push_to(x)) << x;
  EXPECT_TRUE(cut.comes_back_at(5.3));
  EXPECT_FALSE(cut.comes_back_at(8.05)) << "the front is there";
  EXPECT_FALSE(cut.comes_back_at(10.3)) << "nothing is cut there yet";
  EXPECT_FALSE(cut.comes_back_at(1.3)) << "these are ordinary tets again";
}

TEST(Wake, settles_all_when_the_sheet_is_finished) {
  LongCut cut(12);
  for (double x = -0.2; x < 8.0; x += 0.5) cut.push_to(x);
  cut.finish();
  EXPECT_EQ(cut.complex().master_count(), 0U);
  EXPECT_TRUE(validate(cut.mesh(), ValidateLevel::kGeometry).ok);
}

}  // namespace
}  // namespace incise::test::wake_test
