// SPDX-License-Identifier: Apache-2.0
// Ways to make one sheet, or several that meet: in one stroke, in many that go on from each other, from both sides,
// over again, crossed … What must come out is known without a cutter.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "incise/cut/stroke.h"
#include "incise/mesh/tet_mesh.h"
#include "soak/tet_review.h"
#include "support/random.h"

namespace incise::test {

/// A body to attack, and what is known of it before.
struct AttackedBody {
  std::string name;
  std::filesystem::path file;  ///< where it came from; empty for a made one
  TetMesh mesh;
  TetSoup soup;
  TetReview before;
  bool is_convex = false;
  double diagonal = 0;  ///< of its bounding box
  double edge = 0;      ///< how long edges are, in the mean

  [[nodiscard]] bool is_made() const { return file.empty(); }

  AttackedBody(std::string called, std::filesystem::path from, TetMesh whole);
};

/// The names of the ways, in the order in which cases take them.
inline constexpr std::array<const char*, 22> kAttackKinds = {
    "one",           "again2",   "again5",   "again17", "overlap",  "both_sides", "deeper", "zigzag",
    "finish_behind", "retrace2", "retrace5", "jitter5", "part_one", "tee",        "cross",  "star",
    "parallel",      "coil",     "twist",    "core",    "fine",     "tiny"};

struct Attack {
  std::vector<Stroke> strokes;
  std::vector<Stroke> single;         ///< the same sheet in one stroke; empty where there is no such stroke
  std::optional<std::size_t> pieces;  ///< that must come out; none where that is not known
  double growth_limit = 1.6;          ///< new tets, against those of `single`
  double few_tets = 40;               ///< or against this number, where `single` makes fewer
  bool encloses_nothing = false;      ///< every wall must reach the skin: no bubble inside
};

/// The strokes of one kind, an index into `kAttackKinds`.
[[nodiscard]] Attack make_attack(std::size_t kind, const AttackedBody& body, Random& random);

/// A campaign: its name, the kinds of its cases, what makes them, and how many of `kAttackOptions` they take in turn.
struct AttackSet {
  const char* name;
  std::span<const char* const> kinds;
  Attack (*make)(std::size_t kind, const AttackedBody& body, Random& random);
  std::size_t options = 5;
};
inline constexpr AttackSet kAttacks = {"attack", kAttackKinds, make_attack};

}  // namespace incise::test
