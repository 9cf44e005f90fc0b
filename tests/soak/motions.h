// SPDX-License-Identifier: Apache-2.0
// Random cases of blades that are moved step by step through made bodies, as people move them: each from one seed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "incise/mesh/tet_soup.h"

namespace incise::test {

/// Which body; everything about it is in these numbers.
struct BodyPlan {
  enum class Kind : std::uint8_t { kKuhn, kJittered, kRenumbered, kBall, kPlate, kNeedle, kDoubled, kModel };
  Kind kind = Kind::kKuhn;
  std::uint32_t n = 4;     ///< cells per axis; tets of a needle
  std::uint64_t seed = 0;  ///< of what is random about it
  std::filesystem::path model = {};
};
TetSoup make_body(const BodyPlan& plan);
/// The call of bodies.h that makes it, or the name of the model.
std::string describe(const BodyPlan& plan);

/// One stroke: the poses of its edge, in the space in which the body stands.
struct MotionStroke {
  std::string policy;                    ///< how it moves, in words
  std::vector<std::vector<Vec3>> edges;  ///< at least 2 poses
  bool is_aborted = false;               ///< undone instead of ended, then done again
};

/// A body, how it is cut, and the strokes.
struct MotionCase {
  std::uint64_t seed = 0;
  BodyPlan body;
  double snap = 0.2;
  bool maintains = false;
  double wave =
      0;  ///< amplitude with which the body moves while it is cut, as a share of its diagonal; 0: it is at rest
  std::vector<MotionStroke> strokes;
};
/// The body is one of `models`, or a made one where there are none.
MotionCase random_case(std::uint64_t seed, const std::vector<std::filesystem::path>& models = {});

/// Where rest point `p` stands at time `t`: a smooth wave through the body, the same bits on every target.
Vec3 waved(const Vec3& p, double t, double amplitude, double diagonal);

}  // namespace incise::test
