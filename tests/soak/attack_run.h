// SPDX-License-Identifier: Apache-2.0
// One case of an attack: a body, a way to cut it and options, run as `incise cut --blade` runs it, and judged.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "incise/engine/engine.h"
#include "soak/attack_strokes.h"
#include "soak/tet_review.h"

namespace incise::test {

/// What the command is asked for, and what may be asked of the result.
struct AttackOptions {
  const char* name;
  const char* flags;  ///< of the command
  double snap;
  bool is_paper, maintains;
  bool cuts_whole;  ///< each stroke at once
  bool counts_pieces, judges_shape;
};

inline constexpr std::array<AttackOptions, 6> kAttackOptions = {{
    {"default", "", 0.2, false, true, false, true, true},
    {"snap0", "--snap 0", 0, false, true, false, true, false},
    {"raw", "--no-merge --no-improve", 0.2, false, false, false, true, false},
    {"paper", "--profile paper --at-once", 0.2, true, true, true, false, false},
    {"paper-pieces", "--profile paper --at-once", 0.2, true, true, true, true, false},
    {"at-once", "--at-once", 0.2, false, true, true, true, true},
}};

/// How a result falls short.
struct Shortfall {
  std::vector<std::string> faults;  ///< in words; empty where all is well
  bool is_shape_alone = false;      ///< nothing but a tet between the goal of L/r and its limit

  /// All in one line.
  [[nodiscard]] std::string text() const;
};

/// What a cut gave: tets, or why there are none.
struct CutOutcome {
  std::optional<TetReview> after;
  std::string error;
};

/// Cuts a body stroke by stroke, each step by step unless the options say otherwise, and maintains it after each. Gives
/// up where it takes longer than `limit` seconds, which is looked at between steps.
[[nodiscard]] CutOutcome cut_body(const AttackedBody& body, const std::vector<Stroke>& strokes,
                                  const AttackOptions& options, double limit);

/// Compares what came out with what must.
[[nodiscard]] Shortfall judge(const Attack& attack, const AttackOptions& options, const TetReview& before,
                              const TetReview& after, const std::optional<TetReview>& single);

[[nodiscard]] Shortfall run_attack(const AttackedBody& body, const Attack& attack, const AttackOptions& options,
                                   double limit);

}  // namespace incise::test
