// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "incise/mesh/journal.h"

namespace incise {
inline namespace v0 {

/// What is read of a step that changes one place several times (`Step::edits`).
enum class StepReading : std::uint8_t {
  kEdits,  ///< every change in its turn: for state that is carried from tet to tet
  kNet,    ///< the net effect: for whoever rebuilds what changed
};

/// Hears what a step did, change by change, in the order in which the changes take effect.
///
/// Derive from it and override what you need; what is not overridden is ignored. Each call may rely on those before it
/// and on nothing after it: parents, bases and sources are live, tets have the vertices that the record says.
class JournalVisitor {
 public:
  virtual ~JournalVisitor() = default;

  /// A vertex comes into being between its parents, which are live. (The profile paper may name a copy that the same
  /// step makes later; its source is told instead, which stands at the same place.)
  virtual void born(const BornVertex& /*vertex*/) {}
  /// A vertex is another material point from now on. Its basis, itself included, is as it was before the move.
  virtual void moved(const MovedVertex& /*vertex*/) {}
  /// A twin comes into being, with all values of its source.
  virtual void copied(const CopiedVertex& /*vertex*/) {}
  /// Tets give way to others: all of `consumed` go, then all of `produced` come. A tet that lives on with other
  /// vertices may stand in both. A parent is among the consumed of this call.
  virtual void replaced(std::span<const ConsumedTet> /*consumed*/, std::span<const ProducedTet> /*produced*/) {}
  /// A tet lives on with other vertices: twins took the places of their sources.
  virtual void rewired(const RewiredTet& /*tet*/) {}
  /// Two sides that were joined are boundary now, walls of a stroke.
  virtual void opened(const OpenedFace& /*face*/) {}
  /// Side `a`, a wall so far, has the neighbour `b` again.
  virtual void closed(const OpenedFace& /*face*/) {}
  /// A vertex goes. No live tet has it.
  virtual void died(VertexId /*vertex*/) {}
};

/// Tells `visitor` what `step` did. A follower has each step told once, one after the other, from where it stands to
/// `Journal::position`; what was undone or redone it restores from images of its own (docs/journal.md, section 7).
/// Cost: O(records), times the logarithm of the copies where vertices are born.
void visit(const Step& step, JournalVisitor& visitor, StepReading reading = StepReading::kEdits);

}  // namespace v0
}  // namespace incise
