// SPDX-License-Identifier: Apache-2.0
// The journal of an engine as flat records, and cursors in it.
#include <algorithm>
#include <memory>

#include "handles.h"
#include "incise/mesh/journal_cursor.h"

// NOLINTBEGIN(readability-identifier-naming): a C name
struct incise_cursor {
  incise::JournalCursor cursor;
  incise::c::Identity engine;
};
// NOLINTEND(readability-identifier-naming)

namespace incise::c {
namespace {

template <class Ids, std::size_t kCount>
void copy_ids(const Ids& from, std::uint32_t (&to)[kCount]) {
  for (std::size_t k = 0; k < kCount; ++k) to[k] = from[k].value;
}

void copy_weights(const std::array<double, 4>& from, double (&to)[4]) {
  std::copy(from.begin(), from.end(), to);
}

incise_born to_c(const BornVertex& born) {
  incise_born c{};
  c.id = born.id.value;
  copy_ids(born.parents, c.parents);
  copy_weights(born.weights, c.weights);
  from_vec(born.rest, c.rest);
  from_vec(born.current, c.current);
  return c;
}

incise_moved to_c(const MovedVertex& moved) {
  incise_moved c{};
  c.id = moved.id.value;
  copy_ids(moved.basis, c.basis);
  copy_weights(moved.weights, c.weights);
  from_vec(moved.old_rest, c.old_rest);
  from_vec(moved.rest, c.rest);
  from_vec(moved.old_current, c.old_current);
  from_vec(moved.current, c.current);
  return c;
}

incise_copied to_c(const CopiedVertex& copied) {
  return {copied.id.value, copied.source.value};
}

incise_consumed to_c(const ConsumedTet& consumed) {
  incise_consumed c{};
  c.id = consumed.id.value;
  copy_ids(consumed.vertices, c.vertices);
  return c;
}

incise_produced to_c(const ProducedTet& produced) {
  incise_produced c{};
  c.id = produced.id.value;
  c.parent = produced.parent.value;
  copy_ids(produced.vertices, c.vertices);
  c.region = produced.region;
  return c;
}

incise_rewired to_c(const RewiredTet& rewired) {
  incise_rewired c{};
  c.id = rewired.id.value;
  copy_ids(rewired.old_vertices, c.old_vertices);
  copy_ids(rewired.vertices, c.vertices);
  return c;
}

incise_opened to_c(const OpenedFace& opened) {
  return {opened.a.value, opened.b.value, opened.tag};
}

incise_edit to_c(const Edit& edit) {
  return {edit.kind == Edit::Kind::kMove ? 0U : 1U, edit.vertex, edit.consumed_end, edit.produced_end};
}

template <class Tag>
std::uint32_t to_c(Id<Tag> id) {
  return id.value;
}

/// `call(const Step&)` for a step that is kept.
template <class Call>
incise_status at_step(const incise_engine* handle, std::uint64_t step, const Call& call) {
  return look(handle, [&](const Engine& engine) -> incise_status {
    const Journal& journal = engine.journal();
    if (step >= journal.first() && step < journal.size()) return call(journal.step(step));
    return fail({ErrorCode::kBadArgument,
                 "the journal has no step " + std::to_string(step) + "; it keeps those in [" +
                     std::to_string(journal.first()) + ", " + std::to_string(journal.size()) + ")",
                 {step}});
  });
}

/// One list of a step.
template <class Record, class C>
incise_status give_records(const incise_engine* handle, std::uint64_t step, std::vector<Record> Step::*list, C* records,
                           std::uint64_t room, std::uint64_t* count) {
  return at_step(handle, step, [&](const Step& found) {
    return give_list(found.*list, records, room, count, [](const Record& record) { return to_c(record); });
  });
}

incise_step_counts counts_of(const Step& step) {
  incise_step_counts c{};
  c.serial = step.serial;
  c.born = step.born.size();
  c.moved = step.moved.size();
  c.copied = step.copied.size();
  c.consumed = step.consumed.size();
  c.produced = step.produced.size();
  c.rewired = step.rewired.size();
  c.opened = step.opened.size();
  c.closed = step.closed.size();
  c.died = step.died.size();
  c.edits = step.edits.size();
  c.edit_consumed = step.edit_consumed.size();
  c.edit_produced = step.edit_produced.size();
  c.new_vertices = step.new_vertices.size();
  c.new_tets = step.new_tets.size();
  return c;
}

}  // namespace
}  // namespace incise::c

using namespace incise;

incise_status incise_engine_journal(const incise_engine* engine, incise_journal* journal) {
  if (journal == nullptr) return c::refuse("there is no place for the journal: the last argument is null");
  if (const incise_status bad = c::check_out(journal, "incise_journal")) return bad;
  return c::look(engine, [&](const Engine& looked) {
    const Journal& kept = looked.journal();
    incise_journal all{};
    all.first = kept.first();
    all.position = kept.position();
    all.end = kept.size();
    all.newest_serial = kept.newest_serial();
    all.memory_bytes = kept.memory_bytes();
    return c::give(all, journal);
  });
}

incise_status incise_engine_step_counts(const incise_engine* engine, uint64_t step, incise_step_counts* counts) {
  if (counts == nullptr) return c::refuse("there is no place for the counts: the last argument is null");
  if (const incise_status bad = c::check_out(counts, "incise_step_counts")) return bad;
  return c::at_step(engine, step, [&](const Step& found) { return c::give(c::counts_of(found), counts); });
}

incise_status incise_engine_step_born(const incise_engine* engine, uint64_t step, incise_born* records, uint64_t room,
                                      uint64_t* count) {
  return c::give_records(engine, step, &Step::born, records, room, count);
}

incise_status incise_engine_step_moved(const incise_engine* engine, uint64_t step, incise_moved* records, uint64_t room,
                                       uint64_t* count) {
  return c::give_records(engine, step, &Step::moved, records, room, count);
}

incise_status incise_engine_step_copied(const incise_engine* engine, uint64_t step, incise_copied* records,
                                        uint64_t room, uint64_t* count) {
  return c::give_records(engine, step, &Step::copied, records, room, count);
}

incise_status incise_engine_step_consumed(const incise_engine* engine, uint64_t step, incise_consumed* records,
                                          uint64_t room, uint64_t* count) {
  return c::give_records(engine, step, &Step::consumed, records, room, count);
}

incise_status incise_engine_step_produced(const incise_engine* engine, uint64_t step, incise_produced* records,
                                          uint64_t room, uint64_t* count) {
  return c::give_records(engine, step, &Step::produced, records, room, count);
}

incise_status incise_engine_step_rewired(const incise_engine* engine, uint64_t step, incise_rewired* records,
                                         uint64_t room, uint64_t* count) {
  return c::give_records(engine, step, &Step::rewired, records, room, count);
}

incise_status incise_engine_step_opened(const incise_engine* engine, uint64_t step, incise_opened* records,
                                        uint64_t room, uint64_t* count) {
  return c::give_records(engine, step, &Step::opened, records, room, count);
}

incise_status incise_engine_step_closed(const incise_engine* engine, uint64_t step, incise_opened* records,
                                        uint64_t room, uint64_t* count) {
  return c::give_records(engine, step, &Step::closed, records, room, count);
}

incise_status incise_engine_step_died(const incise_engine* engine, uint64_t step, uint32_t* records, uint64_t room,
                                      uint64_t* count) {
  return c::give_records(engine, step, &Step::died, records, room, count);
}

incise_status incise_engine_step_edits(const incise_engine* engine, uint64_t step, incise_edit* records, uint64_t room,
                                       uint64_t* count) {
  return c::give_records(engine, step, &Step::edits, records, room, count);
}

incise_status incise_engine_step_edit_consumed(const incise_engine* engine, uint64_t step, incise_consumed* records,
                                               uint64_t room, uint64_t* count) {
  return c::give_records(engine, step, &Step::edit_consumed, records, room, count);
}

incise_status incise_engine_step_edit_produced(const incise_engine* engine, uint64_t step, incise_produced* records,
                                               uint64_t room, uint64_t* count) {
  return c::give_records(engine, step, &Step::edit_produced, records, room, count);
}

incise_status incise_engine_step_new_vertices(const incise_engine* engine, uint64_t step, uint32_t* records,
                                              uint64_t room, uint64_t* count) {
  return c::give_records(engine, step, &Step::new_vertices, records, room, count);
}

incise_status incise_engine_step_new_tets(const incise_engine* engine, uint64_t step, uint32_t* records, uint64_t room,
                                          uint64_t* count) {
  return c::give_records(engine, step, &Step::new_tets, records, room, count);
}

incise_status incise_cursor_create(const incise_engine* engine, incise_cursor** cursor) {
  if (cursor == nullptr) return c::refuse("there is no place for the cursor: the last argument is null");
  *cursor = nullptr;
  return c::look(engine, [&](const Engine& looked) {
    *cursor =
        std::make_unique<incise_cursor>(incise_cursor{JournalCursor(looked.journal()), engine->identity}).release();
    return INCISE_OK;
  });
}

incise_status incise_cursor_way(const incise_cursor* cursor, const incise_engine* engine, int32_t* way,
                                uint64_t* position) {
  if (cursor == nullptr || way == nullptr) return c::refuse("the cursor, or the place for the way, is null");
  return c::look_as(cursor->engine, engine, [&](const Engine& looked) {
    *way = static_cast<std::int32_t>(cursor->cursor.way_to(looked.journal()));
    if (position != nullptr) *position = cursor->cursor.position();
    return INCISE_OK;
  });
}

incise_status incise_cursor_move(incise_cursor* cursor, const incise_engine* engine) {
  if (cursor == nullptr) return c::refuse("the cursor is null");
  return c::look_as(cursor->engine, engine, [&](const Engine& looked) {
    cursor->cursor.move_to(looked.journal());
    return INCISE_OK;
  });
}

incise_status incise_cursor_free(incise_cursor* cursor) {
  delete cursor;
  return INCISE_OK;
}
