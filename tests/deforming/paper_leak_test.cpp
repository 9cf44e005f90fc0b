// SPDX-License-Identifier: Apache-2.0
// The profile paper in 20 scenes of bodies that move under a solver: the pieces of the profile incise, and nothing
// else, maintained or not. By day every fourth scene: each body, and each motion.
#include <gtest/gtest.h>

#include <cstdio>

#include "deforming/leak_run.h"
#include "support/campaign.h"

namespace incise::test::paper_leak_test {
namespace {

LeakResult run(LeakSettings settings, Profile profile) {
  settings.cut.profile = profile;
  return run_leak(settings);
}

TEST(PaperLeaks, none_in_twenty_scenes_of_moving_bodies) {
  unsigned scene = 0;
  for (const BodyKind body : {BodyKind::kBeam, BodyKind::kCube, BodyKind::kBall, BodyKind::kShuffled}) {
    for (const Motion motion :
         {Motion::kStraight, Motion::kTremor, Motion::kReversal, Motion::kCurve, Motion::kReentry}) {
      if (scene++ % 4 != 0 && !is_whole_campaign()) continue;
      LeakSettings settings;
      settings.body = body;
      settings.motion = motion;
      settings.steps = 60;
      settings.seed = 11;
      settings.check_every = 4;
      SCOPED_TRACE(testing::Message() << name_of(body) << ", motion " << static_cast<unsigned>(motion));
      const LeakResult incise = run(settings, Profile::kIncise);
      for (const bool maintains : {false, true}) {
        settings.maintains = maintains;
        const LeakResult paper = run(settings, Profile::kPaper);
        EXPECT_EQ(paper.failure, "");
        EXPECT_EQ(paper.invalid, 0U);
        EXPECT_EQ(paper.crumbs, 0U);
        EXPECT_EQ(paper.pieces, paper.expected);
        EXPECT_EQ(paper.pieces, incise.pieces);
        EXPECT_LT(paper.turned_over, 1e-6) << "inside out as the body stood";
        EXPECT_LE(paper.volume_change, maintains ? 5e-4 : 1e-12);
        if (maintains) {
          std::printf("%s, motion %u: maintenance changed the volume by %.1e\n", name_of(body),
                      static_cast<unsigned>(motion), paper.volume_change);
        }
      }
    }
  }
}

TEST(PaperLeaks, make_no_slivers_without_end_where_a_body_sways) {
  LeakSettings settings;
  settings.body = BodyKind::kShuffled;
  settings.motion = Motion::kStrongTremor;
  settings.mover = Mover::kField;
  settings.amplitude = 0.6;
  settings.seed = 12;
  settings.steps = 240;
  settings.check_every = 16;
  const LeakResult paper = run(settings, Profile::kPaper);
  EXPECT_EQ(paper.failure, "");
  EXPECT_LT(paper.tets, 5000U) << "the strips of a frame lie beside those before it, at rest";
}

}  // namespace
}  // namespace incise::test::paper_leak_test
