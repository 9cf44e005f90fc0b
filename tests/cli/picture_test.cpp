// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>

#include "cli/program.h"

namespace picture_test {
namespace {

using namespace incise_test;

class CliPicture : public testing::Test {
 protected:
  Outcome cut(std::vector<std::string> more) {
    more.insert(more.begin(), {"cut", cube_, "--picture", picture_});
    return run(more);
  }
  /// Where nothing can be drawn, nothing is cut either.
  bool cannot_draw(const Outcome& outcome) {
    if (outcome.code != 5) return false;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "cut.mesh"));
    EXPECT_FALSE(std::filesystem::exists(picture_));
    return true;
  }

  Folder folder_;
  std::string cube_ = folder_.write("cube.mesh", cube_mesh(4, 0.1));
  std::string picture_ = folder_ / "cut.png";
};

TEST_F(CliPicture, shows_a_cut_beside_the_mesh) {
  const Outcome made = cut({"--plane", "1,0,0,0.5", "-o", folder_ / "cut.mesh"});
  if (cannot_draw(made)) GTEST_SKIP() << made.err;
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(read(picture_).substr(1, 3), "PNG");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "cut.mesh"));
}

TEST_F(CliPicture, is_the_same_each_time_and_another_for_another_cut) {
  const Outcome first = cut({"--plane", "1,0,0,0.5"});
  if (cannot_draw(first)) GTEST_SKIP() << first.err;
  const std::string pixels = read(picture_);
  ASSERT_EQ(cut({"--plane", "1,0,0,0.5"}).code, 0);
  EXPECT_EQ(read(picture_), pixels);
  ASSERT_EQ(cut({"--blade", INCISE_SCENES "/cube_core.json"}).code, 0);
  EXPECT_NE(read(picture_), pixels);
}

TEST_F(CliPicture, of_a_blade_that_missed_is_a_picture_too) {
  const Outcome made = cut({"--plane", "1,0,0,5"});
  if (cannot_draw(made)) GTEST_SKIP() << made.err;
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(read(picture_).substr(1, 3), "PNG");
}

}  // namespace

}  // namespace picture_test
