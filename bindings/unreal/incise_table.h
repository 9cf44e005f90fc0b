/* SPDX-License-Identifier: Apache-2.0
 * Written by bindings/generate.py from include/incise/c/incise.h: change that, and run it again.
 *
 * For Unreal, and whoever loads the library by name: the calls as a table of pointers. In a module of Unreal,
 *   void* library = FPlatformProcess::GetDllHandle(TEXT("libincise.so.0"));
 * and `find` calls FPlatformProcess::GetDllExport. Tested with dlopen; never run in Unreal. */
/* clang-format off */
#ifndef INCISE_TABLE_H
#define INCISE_TABLE_H

#include <stddef.h>
#include <string.h>

#include "incise/c/incise.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct incise_table {
  uint32_t (*abi)(void);
  const char* (*version)(void);
  const char* (*status_name)(incise_status status);
  const char* (*last_error)(void);
  incise_status (*last_error_code)(void);
  uint64_t (*last_error_ids)(uint64_t* ids, uint64_t room);
  incise_status (*default_engine_options)(incise_engine_options* options, uint32_t size);
  incise_status (*engine_create)(const incise_mesh_arrays* mesh, const incise_engine_options* options, incise_engine** engine);
  incise_status (*engine_create_box)(const double* low, const double* high, const uint32_t* cells, const incise_engine_options* options, incise_engine** engine);
  incise_status (*engine_read)(const char* path, const incise_engine_options* options, incise_engine** engine);
  incise_status (*engine_read_bytes)(const void* bytes, uint64_t n_bytes, const char* name, const incise_engine_options* options, incise_engine** engine);
  incise_status (*engine_free)(incise_engine* engine);
  incise_status (*engine_notes)(const incise_engine* engine, char* text, uint64_t room, uint64_t* count);
  incise_status (*engine_write)(const incise_engine* engine, const char* path, int32_t pose);
  incise_status (*engine_write_bytes)(const incise_engine* engine, const char* extension, int32_t pose, void* bytes, uint64_t room, uint64_t* count);
  incise_status (*engine_write_surface)(const incise_engine* engine, const char* path);
  incise_status (*engine_counts)(const incise_engine* engine, incise_counts* counts);
  incise_status (*engine_view)(const incise_engine* engine, int32_t which, incise_view* view);
  incise_status (*engine_surface)(const incise_engine* engine, uint32_t* triangles, uint32_t* tags, uint32_t* sides, uint64_t room, uint64_t* count);
  incise_status (*engine_compact)(const incise_engine* engine, incise_compact* arrays);
  incise_status (*engine_pieces)(const incise_engine* engine, uint32_t* labels, uint64_t label_room, uint64_t* tets, double* volumes, uint64_t piece_room, uint64_t* count);
  incise_status (*engine_hash)(const incise_engine* engine, uint64_t* hash);
  incise_status (*engine_quality)(const incise_engine* engine, int32_t only_at_cuts, incise_quality* quality);
  incise_status (*engine_validate)(const incise_engine* engine, int32_t level, incise_validity* validity, incise_violation* violations, uint64_t room, uint64_t* count);
  const char* (*violation_name)(int32_t kind);
  incise_status (*engine_cut)(incise_engine* engine, const incise_stroke* stroke, incise_report* report);
  incise_status (*engine_cut_plane)(incise_engine* engine, const double* normal, double offset, incise_report* report);
  incise_status (*engine_cut_blade)(incise_engine* engine, const char* path, incise_report* report);
  incise_status (*engine_begin_stroke)(incise_engine* engine, const double* edge, uint64_t n_points, const double* direction, uint32_t* stroke);
  incise_status (*engine_step)(incise_engine* engine, const double* edge, uint64_t n_points, const double* direction, incise_report* report);
  incise_status (*engine_end_stroke)(incise_engine* engine, incise_report* report);
  incise_status (*engine_set_positions)(incise_engine* engine, const double* positions, uint64_t n_slots);
  incise_status (*engine_undo)(incise_engine* engine, int32_t* done);
  incise_status (*engine_redo)(incise_engine* engine, int32_t* done);
  incise_status (*engine_keep_undo)(incise_engine* engine, uint64_t operations);
  incise_status (*engine_maintain)(incise_engine* engine, uint64_t work_units, incise_should_stop should_stop, void* user, incise_report* report);
  incise_status (*engine_improve)(incise_engine* engine, incise_should_stop should_stop, void* user, incise_report* report);
  incise_status (*engine_journal)(const incise_engine* engine, incise_journal* journal);
  incise_status (*engine_step_counts)(const incise_engine* engine, uint64_t step, incise_step_counts* counts);
  incise_status (*engine_step_born)(const incise_engine* engine, uint64_t step, incise_born* records, uint64_t room, uint64_t* count);
  incise_status (*engine_step_moved)(const incise_engine* engine, uint64_t step, incise_moved* records, uint64_t room, uint64_t* count);
  incise_status (*engine_step_copied)(const incise_engine* engine, uint64_t step, incise_copied* records, uint64_t room, uint64_t* count);
  incise_status (*engine_step_consumed)(const incise_engine* engine, uint64_t step, incise_consumed* records, uint64_t room, uint64_t* count);
  incise_status (*engine_step_produced)(const incise_engine* engine, uint64_t step, incise_produced* records, uint64_t room, uint64_t* count);
  incise_status (*engine_step_rewired)(const incise_engine* engine, uint64_t step, incise_rewired* records, uint64_t room, uint64_t* count);
  incise_status (*engine_step_opened)(const incise_engine* engine, uint64_t step, incise_opened* records, uint64_t room, uint64_t* count);
  incise_status (*engine_step_closed)(const incise_engine* engine, uint64_t step, incise_opened* records, uint64_t room, uint64_t* count);
  incise_status (*engine_step_died)(const incise_engine* engine, uint64_t step, uint32_t* records, uint64_t room, uint64_t* count);
  incise_status (*engine_step_edits)(const incise_engine* engine, uint64_t step, incise_edit* records, uint64_t room, uint64_t* count);
  incise_status (*engine_step_edit_consumed)(const incise_engine* engine, uint64_t step, incise_consumed* records, uint64_t room, uint64_t* count);
  incise_status (*engine_step_edit_produced)(const incise_engine* engine, uint64_t step, incise_produced* records, uint64_t room, uint64_t* count);
  incise_status (*engine_step_new_vertices)(const incise_engine* engine, uint64_t step, uint32_t* records, uint64_t room, uint64_t* count);
  incise_status (*engine_step_new_tets)(const incise_engine* engine, uint64_t step, uint32_t* records, uint64_t room, uint64_t* count);
  incise_status (*cursor_create)(const incise_engine* engine, incise_cursor** cursor);
  incise_status (*cursor_way)(const incise_cursor* cursor, const incise_engine* engine, int32_t* way, uint64_t* position);
  incise_status (*cursor_move)(incise_cursor* cursor, const incise_engine* engine);
  incise_status (*cursor_free)(incise_cursor* cursor);
  incise_status (*attributes_create)(const incise_engine* engine, incise_attributes** attributes);
  incise_status (*attributes_add)(incise_attributes* attributes, const incise_engine* engine, const incise_attribute_spec* spec, uint32_t* id);
  incise_status (*attributes_find)(const incise_attributes* attributes, const char* name, uint32_t* id);
  incise_status (*attributes_follow)(incise_attributes* attributes, const incise_engine* engine);
  incise_status (*attributes_values)(incise_attributes* attributes, uint32_t id, double** values, uint64_t* n_values);
  incise_status (*attributes_free)(incise_attributes* attributes);
  incise_status (*default_body_options)(incise_body_options* options, uint32_t size);
  incise_status (*default_simulation_options)(incise_simulation_options* options, uint32_t size);
  incise_status (*simulation_create)(const incise_mesh_arrays* mesh, const incise_simulation_options* options, incise_simulation** simulation);
  incise_status (*simulation_read)(const char* path, const incise_simulation_options* options, incise_simulation** simulation);
  incise_status (*simulation_read_scene)(const char* path, uint32_t threads, incise_simulation** simulation);
  incise_status (*simulation_parse_scene)(const char* json, const char* folder, uint32_t threads, incise_simulation** simulation);
  incise_status (*simulation_free)(incise_simulation* simulation);
  const incise_engine* (*simulation_engine)(const incise_simulation* simulation);
  incise_status (*simulation_frame)(incise_simulation* simulation, const incise_frame_input* input, incise_frame_report* report);
  incise_status (*simulation_play)(incise_simulation* simulation, incise_frame_report* report);
  incise_status (*simulation_cut_report)(const incise_simulation* simulation, incise_report* report);
  incise_status (*simulation_hook_forces)(const incise_simulation* simulation, double* forces, uint64_t room, uint64_t* count);
  incise_status (*simulation_settle)(incise_simulation* simulation, uint32_t max_frames, double speed, uint32_t* frames);
  incise_status (*simulation_settle_scene)(incise_simulation* simulation, uint32_t* frames);
  incise_status (*simulation_settle_until)(incise_simulation* simulation, uint32_t max_frames, double speed, incise_should_stop should_stop, void* user, uint32_t* frames);
  incise_status (*simulation_settle_scene_until)(incise_simulation* simulation, incise_should_stop should_stop, void* user, uint32_t* frames);
  incise_status (*simulation_look)(const incise_simulation* simulation, incise_simulation_state* state);
  incise_status (*simulation_undo)(incise_simulation* simulation, int32_t* done);
  incise_status (*simulation_redo)(incise_simulation* simulation, int32_t* done);
  incise_status (*simulation_hold)(incise_simulation* simulation, uint32_t vertex, double stiffness);
  incise_status (*simulation_pin)(incise_simulation* simulation, uint32_t vertex, double stiffness, double strength, int32_t tears);
  incise_status (*simulation_move_hold)(incise_simulation* simulation, uint32_t vertex, const double* target);
  incise_status (*simulation_is_held)(const incise_simulation* simulation, uint32_t vertex, int32_t* is_held);
  incise_status (*simulation_velocities)(const incise_simulation* simulation, double* velocities, uint64_t room, uint64_t* count);
  incise_status (*simulation_set_velocity)(incise_simulation* simulation, uint32_t vertex, const double* velocity);
  incise_status (*simulation_haptic_snapshot)(const incise_simulation* simulation, incise_haptic_snapshot* snapshot);
  incise_status (*default_haptic_options)(incise_haptic_options* options, uint32_t size);
  incise_status (*haptic_tool_create)(const incise_haptic_options* options, incise_haptic_tool** tool);
  incise_status (*haptic_tool_accept)(incise_haptic_tool* tool, const incise_haptic_snapshot* snapshot);
  incise_status (*haptic_tool_tick)(incise_haptic_tool* tool, double dt, const double* position, const double* velocity, double* force, double* tool_position);
  incise_status (*haptic_tool_free)(incise_haptic_tool* tool);
  incise_status (*plan_read)(const char* path, incise_plan** plan);
  incise_status (*plan_parse)(const char* json, const char* folder, incise_plan** plan);
  incise_status (*plan_free)(incise_plan* plan);
  incise_status (*plan_count)(const incise_plan* plan, uint64_t* count);
  incise_status (*plan_name)(const incise_plan* plan, uint64_t item, char* text, uint64_t room, uint64_t* count);
  incise_status (*default_batch_options)(incise_batch_options* options, uint32_t size);
  incise_status (*batch_run)(const incise_plan* plan, const char* folder, const incise_batch_options* options, incise_told tell, void* user);
  incise_status (*batch_merge)(const incise_plan* plan, const char* folder, incise_told tell, void* user);
  incise_status (*batch_verify)(const incise_plan* plan, const char* folder, const incise_batch_options* options, incise_told tell, void* user);
} incise_table;

/* Finds a symbol of a library: null where there is none. */
typedef void* (*incise_find)(void* library, const char* name);

/* Fills the table. Returns null, or the name of the first call that the library does not have. */
static inline const char* incise_table_load(incise_table* table, incise_find find, void* library) {
  static const char* const names[] = {
    "incise_abi",
    "incise_version",
    "incise_status_name",
    "incise_last_error",
    "incise_last_error_code",
    "incise_last_error_ids",
    "incise_default_engine_options",
    "incise_engine_create",
    "incise_engine_create_box",
    "incise_engine_read",
    "incise_engine_read_bytes",
    "incise_engine_free",
    "incise_engine_notes",
    "incise_engine_write",
    "incise_engine_write_bytes",
    "incise_engine_write_surface",
    "incise_engine_counts",
    "incise_engine_view",
    "incise_engine_surface",
    "incise_engine_compact",
    "incise_engine_pieces",
    "incise_engine_hash",
    "incise_engine_quality",
    "incise_engine_validate",
    "incise_violation_name",
    "incise_engine_cut",
    "incise_engine_cut_plane",
    "incise_engine_cut_blade",
    "incise_engine_begin_stroke",
    "incise_engine_step",
    "incise_engine_end_stroke",
    "incise_engine_set_positions",
    "incise_engine_undo",
    "incise_engine_redo",
    "incise_engine_keep_undo",
    "incise_engine_maintain",
    "incise_engine_improve",
    "incise_engine_journal",
    "incise_engine_step_counts",
    "incise_engine_step_born",
    "incise_engine_step_moved",
    "incise_engine_step_copied",
    "incise_engine_step_consumed",
    "incise_engine_step_produced",
    "incise_engine_step_rewired",
    "incise_engine_step_opened",
    "incise_engine_step_closed",
    "incise_engine_step_died",
    "incise_engine_step_edits",
    "incise_engine_step_edit_consumed",
    "incise_engine_step_edit_produced",
    "incise_engine_step_new_vertices",
    "incise_engine_step_new_tets",
    "incise_cursor_create",
    "incise_cursor_way",
    "incise_cursor_move",
    "incise_cursor_free",
    "incise_attributes_create",
    "incise_attributes_add",
    "incise_attributes_find",
    "incise_attributes_follow",
    "incise_attributes_values",
    "incise_attributes_free",
    "incise_default_body_options",
    "incise_default_simulation_options",
    "incise_simulation_create",
    "incise_simulation_read",
    "incise_simulation_read_scene",
    "incise_simulation_parse_scene",
    "incise_simulation_free",
    "incise_simulation_engine",
    "incise_simulation_frame",
    "incise_simulation_play",
    "incise_simulation_cut_report",
    "incise_simulation_hook_forces",
    "incise_simulation_settle",
    "incise_simulation_settle_scene",
    "incise_simulation_settle_until",
    "incise_simulation_settle_scene_until",
    "incise_simulation_look",
    "incise_simulation_undo",
    "incise_simulation_redo",
    "incise_simulation_hold",
    "incise_simulation_pin",
    "incise_simulation_move_hold",
    "incise_simulation_is_held",
    "incise_simulation_velocities",
    "incise_simulation_set_velocity",
    "incise_simulation_haptic_snapshot",
    "incise_default_haptic_options",
    "incise_haptic_tool_create",
    "incise_haptic_tool_accept",
    "incise_haptic_tool_tick",
    "incise_haptic_tool_free",
    "incise_plan_read",
    "incise_plan_parse",
    "incise_plan_free",
    "incise_plan_count",
    "incise_plan_name",
    "incise_default_batch_options",
    "incise_batch_run",
    "incise_batch_merge",
    "incise_batch_verify",
  };
  const size_t count = sizeof names / sizeof *names;
  size_t i;
  /* The table is one pointer after the other, in the order of the names. */
  (void)sizeof(char[sizeof(incise_table) == sizeof names / sizeof *names * sizeof(void*) ? 1 : -1]);
  for (i = 0; i < count; ++i) {
    void* const symbol = find(library, names[i]);
    if (!symbol) return names[i];
    memcpy((char*)table + i * sizeof symbol, &symbol, sizeof symbol);
  }
  return 0;
}

#ifdef __cplusplus
}
#endif

#endif
