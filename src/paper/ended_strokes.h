// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "cut/blade_motion.h"
#include "cut/strip.h"
#include "cut/twist.h"
#include "paper/ring.h"

namespace incise {
inline namespace v0 {

/// How a stroke at rest has ended: what another one needs that goes on from it.
struct EndedStroke {
  BladeMotion motion;
  EdgeDivision edge = EdgeDivision();
  std::vector<Vec3> row;                             ///< where its blade stood, divided
  std::vector<std::shared_ptr<const Strip>> strips;  ///< the last that it laid, oldest first
  Ring ring = {};                                    ///< that its incision may become
  bool is_gone_on_from = false;                      ///< by another stroke: no tissue waits at its end any more
};

/// The ends of the last strokes at rest.
class EndedStrokes {
 public:
  /// One without a row is a stroke that none goes on from here: whole, or in a body that moves. Forgets the oldest
  /// above `kEndsKept`, those first from which none will go on. Cost: O(kEndsKept).
  void add(EndedStroke stroke);
  /// A stroke goes on from the end at which its blade stands: one that `find` told of.
  void go_on_from(const EndedStroke& stroke);
  /// All incisions are complete, or others than they were.
  void clear() { ended_.clear(); }
  /// The latest stroke at whose end a blade stands, each of its points within a length, and from which none has gone
  /// on; null where there is none. Cost: O(points · kEndsKept).
  [[nodiscard]] const EndedStroke* find(std::span<const Vec3> row, double within) const;
  /// The one with these strips; null where it is forgotten. Cost: O(kEndsKept).
  [[nodiscard]] const EndedStroke* find_at(std::span<const std::shared_ptr<const Strip>> strips) const;
  /// Whether no stroke has ended after one of these.
  [[nodiscard]] bool is_last(const EndedStroke& stroke) const { return &stroke == &ended_.back(); }

 private:
  std::deque<EndedStroke> ended_;
};

}  // namespace v0
}  // namespace incise
