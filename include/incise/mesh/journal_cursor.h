// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "incise/mesh/journal.h"

namespace incise {
inline namespace v0 {

/// Where a follower stands in a journal, and how it gets from there to where the journal stands now.
class JournalCursor {
 public:
  /// At the beginning of a journal: nothing was applied.
  JournalCursor() = default;
  /// Where the journal stands.
  explicit JournalCursor(const Journal& journal) { move_to(journal); }

  /// How to catch up.
  enum class Way : std::uint8_t {
    kNone,     ///< the journal stands where the follower stands
    kForward,  ///< the steps from `position` on are new: apply them
    /// Steps that the follower knew are undone, or back by redo, or were trimmed before it came to them: compare with
    /// the mesh, or build anew.
    kElsewhere,
  };
  /// Cost: O(1).
  [[nodiscard]] Way way_to(const Journal& journal) const {
    if (journal.position() < position_ || journal.first() > position_) return Way::kElsewhere;
    if (journal.serial_before(position_) != serial_) return Way::kElsewhere;
    if (journal.position() == position_) return Way::kNone;
    return journal.step(position_).serial > newest_ ? Way::kForward : Way::kElsewhere;
  }
  /// Whether the journal still has all steps between where the follower stands and where the journal does: those to be
  /// applied, undone ones that were done again among them, or those that were undone. Cost: O(1).
  [[nodiscard]] bool can_walk_to(const Journal& journal) const {
    return journal.first() <= std::min(position_, journal.position()) && position_ <= journal.size() &&
           journal.serial_before(position_) == serial_;
  }
  /// The follower has caught up.
  void move_to(const Journal& journal) {
    position_ = journal.position();
    serial_ = journal.serial_before(position_);
    newest_ = journal.newest_serial();
  }
  /// Steps applied.
  [[nodiscard]] std::size_t position() const { return position_; }

 private:
  std::size_t position_ = 0;
  std::uint64_t serial_ = 0;  // of the last step applied
  std::uint64_t newest_ = 0;  // the highest that the journal had given by then: steps above it are new
};

}  // namespace v0
}  // namespace incise
