// SPDX-License-Identifier: Apache-2.0
// A step told in the order in which it takes effect: docs/journal.md, sections 2 and 5, as code.
#include "incise/mesh/journal_visitor.h"

#include <algorithm>

namespace incise {
inline namespace v0 {

namespace {

class StepTeller {
 public:
  StepTeller(const Step& step, JournalVisitor& visitor) : step_(step), visitor_(visitor) {
    if (step.born.empty()) return;
    copied_ = step.copied;
    std::sort(copied_.begin(), copied_.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  }

  void tell_lists() {
    for (const BornVertex& born : step_.born) visitor_.born(with_live_parents(born));
    for (const MovedVertex& moved : step_.moved) visitor_.moved(moved);
    for (const CopiedVertex& copied : step_.copied) visitor_.copied(copied);
    replace(step_.consumed, step_.produced);
    for (const RewiredTet& rewired : step_.rewired) visitor_.rewired(rewired);
  }
  /// Such a step has neither copies nor rewired tets.
  void tell_edits() {
    std::size_t consumed = 0, produced = 0;
    for (const Edit& edit : step_.edits) {
      if (edit.kind == Edit::Kind::kMove) {
        visitor_.moved(step_.moved[edit.vertex]);
      } else if (edit.vertex != kInvalidIndex) {
        visitor_.born(step_.born[edit.vertex]);
      }
      replace(std::span(step_.edit_consumed).subspan(consumed, edit.consumed_end - consumed),
              std::span(step_.edit_produced).subspan(produced, edit.produced_end - produced));
      consumed = edit.consumed_end;
      produced = edit.produced_end;
    }
  }
  void tell_rest() {
    for (const OpenedFace& face : step_.opened) visitor_.opened(face);
    for (const OpenedFace& face : step_.closed) visitor_.closed(face);
    for (const VertexId vertex : step_.died) visitor_.died(vertex);
  }

 private:
  void replace(std::span<const ConsumedTet> consumed, std::span<const ProducedTet> produced) {
    if (!consumed.empty() || !produced.empty()) visitor_.replaced(consumed, produced);
  }
  /// Copies of the step come after its births: their sources stand for them.
  [[nodiscard]] BornVertex with_live_parents(BornVertex born) const {
    for (VertexId& parent : born.parents) {
      for (auto copy = find_copy(parent); copy != copied_.end(); copy = find_copy(parent)) parent = copy->source;
    }
    return born;
  }
  [[nodiscard]] std::vector<CopiedVertex>::const_iterator find_copy(VertexId id) const {
    const auto found = std::lower_bound(copied_.begin(), copied_.end(), id,
                                        [](const CopiedVertex& copy, VertexId wanted) { return copy.id < wanted; });
    return found != copied_.end() && found->id == id ? found : copied_.end();
  }

  const Step& step_;
  JournalVisitor& visitor_;
  std::vector<CopiedVertex> copied_;  // by id
};

}  // namespace

void visit(const Step& step, JournalVisitor& visitor, StepReading reading) {
  StepTeller teller(step, visitor);
  if (reading == StepReading::kEdits && !step.edits.empty()) {
    teller.tell_edits();
  } else {
    teller.tell_lists();
  }
  teller.tell_rest();
}

}  // namespace v0
}  // namespace incise
