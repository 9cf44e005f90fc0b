# SPDX-License-Identifier: Apache-2.0
"""Written by bindings/generate.py from include/incise/c/incise.h: change that, and run it again."""
from __future__ import annotations

from ctypes import (CDLL, CFUNCTYPE, POINTER, Structure, c_char_p, c_double, c_int32, c_int64, c_uint8,
                    c_uint32, c_uint64, c_void_p)
from typing import Any

ABI = 0
NONE = 4294967295
UNLIMITED = 18446744073709551615
OK = 0
BAD_ARGUMENT = 1
BAD_FILE = 2
UNSUPPORTED = 3
OUT_OF_MEMORY = 4
IO = 5
INTERNAL = 6
BUSY = 7
LOG_DEBUG = 0
LOG_INFO = 1
LOG_WARNING = 2
PROFILE_PAPER = 0
PROFILE_INCISE = 1
AT_REST = 0
AS_IT_STANDS = 1
TETS = 0
REST = 1
CURRENT = 2
LINKS = 3
REGIONS = 4
TET_GENERATIONS = 5
VERTEX_GENERATIONS = 6
SHAPES = 7
ORIGINS = 8
SHAPE_SKIN = 1
SHAPE_WALL = 2
SHAPE_FRONT = 4
SHAPE_PINCHED = 8
SHAPE_DEAD = 128
VALIDATE_COUNTS = 0
VALIDATE_TOPOLOGY = 1
VALIDATE_GEOMETRY = 2
VIOLATION_KINDS = 16
EDIT_MOVE = 0
EDIT_REMESH = 1
WAY_NONE = 0
WAY_FORWARD = 1
WAY_ELSEWHERE = 2
AT_VERTICES = 0
AT_TETS = 1
INTERPOLATE = 0
INHERIT = 1
CONSERVE = 2
RECOMPUTE = 3
BLOCK_DESCENT = 0
POSITION_BASED = 1
TOOL_BALL = 0
TOOL_ROD = 1
TOOL_PLANE = 2
TOOL_FLAT = 3

incise_log: Any = CFUNCTYPE(None, c_void_p, c_int32, c_char_p)

incise_should_stop: Any = CFUNCTYPE(c_int32, c_void_p)

incise_recompute: Any = CFUNCTYPE(None, c_void_p, c_uint32, c_void_p, c_uint32)

incise_progress: Any = CFUNCTYPE(None, c_void_p, c_uint64, c_uint64)

incise_told: Any = CFUNCTYPE(None, c_void_p, c_char_p)


class incise_engine_options(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("profile", c_int32),
        ("snap", c_double),
        ("merge", c_int32),
        ("improve", c_int32),
        ("work_units", c_uint64),
        ("threads", c_uint32),
        ("smooth_boundary", c_int32),
        ("check_steps", c_int32),
        ("pad", c_uint32),
        ("log", incise_log),
        ("log_user", c_void_p),
    ]


class incise_mesh_arrays(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("mend", c_int32),
        ("points", c_void_p),
        ("n_points", c_uint64),
        ("tets", c_void_p),
        ("n_tets", c_uint64),
        ("regions", c_void_p),
        ("walls", c_void_p),
        ("n_walls", c_uint64),
        ("origins", c_void_p),
        ("fronts", c_void_p),
    ]


class incise_counts(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("strokes", c_uint32),
        ("vertices", c_uint64),
        ("tets", c_uint64),
        ("vertex_slots", c_uint64),
        ("tet_slots", c_uint64),
        ("memory_bytes", c_uint64),
        ("version", c_uint64),
        ("next_stroke", c_uint32),
        ("is_in_stroke", c_int32),
        ("has_maintenance", c_int32),
        ("pad", c_int32),
    ]


class incise_view(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("stride", c_uint32),
        ("data", c_void_p),
        ("rows", c_uint64),
        ("version", c_uint64),
        ("is_stable", c_int32),
        ("pad", c_int32),
    ]


class incise_compact(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("pose", c_int32),
        ("points", c_void_p),
        ("tets", c_void_p),
        ("regions", c_void_p),
        ("pieces", c_void_p),
        ("vertex_slots", c_void_p),
        ("tet_slots", c_void_p),
        ("vertices", c_uint64),
        ("tet_count", c_uint64),
        ("vertex_room", c_uint64),
        ("tet_room", c_uint64),
    ]


class incise_quality(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("pad", c_uint32),
        ("tets", c_uint64),
        ("flat_tets", c_uint64),
        ("lr_min", c_double),
        ("lr_mean", c_double),
        ("lr_p99", c_double),
        ("lr_max", c_double),
        ("lr_over_200_pct", c_double),
        ("dihedral_min_deg", c_double),
        ("dihedral_max_deg", c_double),
    ]


class incise_violation(Structure):
    _fields_ = [
        ("ids", c_uint64 * 2),
        ("kind", c_int32),
        ("pad", c_int32),
    ]


class incise_validity(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("ok", c_int32),
        ("counts", c_uint64 * 16),
        ("volume", c_double),
    ]


class incise_report(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("stroke", c_uint32),
        ("steps", c_uint64),
        ("cut_tets", c_uint64),
        ("created_tets", c_int64),
        ("new_vertices", c_int64),
        ("copied_vertices", c_uint64),
        ("incision_faces", c_int64),
        ("snapped_vertices", c_uint64),
        ("bent_vertices", c_uint64),
        ("crumbs_kept", c_uint64),
        ("pinched_edges", c_uint64),
        ("latent_faces", c_uint64),
        ("blocked_edges", c_uint64),
        ("sheets", c_uint64),
        ("work_units", c_uint64),
        ("collapsed_edges", c_uint64),
        ("moved_vertices", c_uint64),
        ("removed_edges", c_uint64),
        ("removed_faces", c_uint64),
        ("inserted_vertices", c_uint64),
        ("peeled_tets", c_uint64),
        ("waiting_tets", c_uint64),
        ("maintenance_tets", c_int64),
        ("collision_ms", c_double),
        ("subdivide_ms", c_double),
        ("separate_ms", c_double),
        ("merge_ms", c_double),
        ("improve_ms", c_double),
        ("relax_ms", c_double),
        ("journal_first", c_uint64),
        ("journal_end", c_uint64),
    ]


class incise_stroke(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("pad", c_uint32),
        ("times", c_void_p),
        ("n_times", c_uint64),
        ("points", c_void_p),
        ("n_points", c_uint64),
        ("name", c_char_p),
    ]


class incise_journal(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("pad", c_uint32),
        ("first", c_uint64),
        ("position", c_uint64),
        ("end", c_uint64),
        ("newest_serial", c_uint64),
        ("memory_bytes", c_uint64),
    ]


class incise_step_counts(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("pad", c_uint32),
        ("serial", c_uint64),
        ("born", c_uint64),
        ("moved", c_uint64),
        ("copied", c_uint64),
        ("consumed", c_uint64),
        ("produced", c_uint64),
        ("rewired", c_uint64),
        ("opened", c_uint64),
        ("closed", c_uint64),
        ("died", c_uint64),
        ("edits", c_uint64),
        ("edit_consumed", c_uint64),
        ("edit_produced", c_uint64),
        ("new_vertices", c_uint64),
        ("new_tets", c_uint64),
    ]


class incise_born(Structure):
    _fields_ = [
        ("id", c_uint32),
        ("parents", c_uint32 * 4),
        ("pad", c_uint32),
        ("weights", c_double * 4),
        ("rest", c_double * 3),
        ("current", c_double * 3),
    ]


class incise_moved(Structure):
    _fields_ = [
        ("id", c_uint32),
        ("basis", c_uint32 * 4),
        ("pad", c_uint32),
        ("weights", c_double * 4),
        ("old_rest", c_double * 3),
        ("rest", c_double * 3),
        ("old_current", c_double * 3),
        ("current", c_double * 3),
    ]


class incise_copied(Structure):
    _fields_ = [
        ("id", c_uint32),
        ("source", c_uint32),
    ]


class incise_consumed(Structure):
    _fields_ = [
        ("id", c_uint32),
        ("vertices", c_uint32 * 4),
    ]


class incise_produced(Structure):
    _fields_ = [
        ("id", c_uint32),
        ("parent", c_uint32),
        ("vertices", c_uint32 * 4),
        ("region", c_int32),
    ]


class incise_rewired(Structure):
    _fields_ = [
        ("id", c_uint32),
        ("old_vertices", c_uint32 * 4),
        ("vertices", c_uint32 * 4),
    ]


class incise_opened(Structure):
    _fields_ = [
        ("a", c_uint32),
        ("b", c_uint32),
        ("tag", c_uint32),
    ]


class incise_edit(Structure):
    _fields_ = [
        ("kind", c_uint32),
        ("vertex", c_uint32),
        ("consumed_end", c_uint32),
        ("produced_end", c_uint32),
    ]


class incise_attribute_spec(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("domain", c_int32),
        ("name", c_char_p),
        ("width", c_uint32),
        ("transfer", c_int32),
        ("initial", c_void_p),
        ("recompute", incise_recompute),
        ("user", c_void_p),
    ]


class incise_body_options(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("relaxation", c_int32),
        ("length_unit", c_double),
        ("gravity", c_double * 3),
        ("damping", c_double),
        ("substeps", c_uint32),
        ("iterations", c_uint32),
        ("thinnest", c_double),
        ("sleep_below", c_double),
        ("threads", c_uint32),
        ("coarse", c_int32),
        ("crumb", c_double),
    ]


class incise_material(Structure):
    _fields_ = [
        ("region", c_int32),
        ("is_fallback", c_int32),
        ("density", c_double),
        ("young", c_double),
        ("poisson", c_double),
        ("toughness", c_double),
        ("cut_friction", c_double),
        ("stiffening", c_double),
        ("rupture", c_double),
        ("fibre", c_double * 3),
        ("fibre_young", c_double),
        ("prony", c_double * 6),
        ("rigid", c_int32),
        ("pad", c_int32),
    ]


class incise_simulation_options(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("n_materials", c_uint32),
        ("engine", POINTER(incise_engine_options)),
        ("body", POINTER(incise_body_options)),
        ("materials", POINTER(incise_material)),
        ("frame_seconds", c_double),
        ("contact_stiffness", c_double),
        ("flat_height", c_double),
    ]


class incise_hook(Structure):
    _fields_ = [
        ("id", c_uint32),
        ("pad", c_uint32),
        ("position", c_double * 3),
        ("radius", c_double),
        ("stiffness", c_double),
        ("strength", c_double),
        ("tears", c_int32),
        ("pad2", c_uint32),
    ]


class incise_tool(Structure):
    _fields_ = [
        ("kind", c_int32),
        ("pad", c_uint32),
        ("a", c_double * 3),
        ("b", c_double * 3),
        ("radius", c_double),
        ("offset", c_double),
        ("edge", c_void_p),
        ("n_edge", c_uint64),
    ]


class incise_frame_input(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("pad", c_uint32),
        ("blade", c_void_p),
        ("n_blade", c_uint64),
        ("direction", c_void_p),
        ("hooks", POINTER(incise_hook)),
        ("n_hooks", c_uint64),
        ("tools", POINTER(incise_tool)),
        ("n_tools", c_uint64),
        ("slicing", c_double),
    ]


class incise_frame_report(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("stroke", c_uint32),
        ("blade_touches", c_int32),
        ("blade_yields", c_int32),
        ("blade_force", c_double * 3),
        ("engaged_length", c_double),
        ("fracture_work", c_double),
        ("friction_work", c_double),
        ("tool_work", c_double),
        ("contacts", c_uint64),
        ("active_vertices", c_uint64),
        ("fastest", c_double),
        ("n_hook_forces", c_uint64),
    ]


class incise_simulation_state(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("pad", c_uint32),
        ("frames", c_uint64),
        ("scene_frames", c_uint64),
        ("frame_seconds", c_double),
        ("length_unit", c_double),
        ("mass", c_double),
        ("momentum", c_double * 3),
        ("elastic", c_double),
        ("kinetic", c_double),
        ("potential", c_double),
        ("held", c_double),
        ("pulled", c_double),
        ("force_on_holds", c_double * 3),
        ("inverted_tets", c_uint64),
        ("hash", c_uint64),
    ]


class incise_haptic_snapshot(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("touches", c_int32),
        ("serial", c_uint64),
        ("ruptured", c_int32),
        ("pad", c_int32),
        ("tool_position", c_double * 3),
        ("force", c_double * 3),
        ("compliance", c_double * 9),
        ("contact_point", c_double * 3),
        ("cutting_direction", c_double * 3),
        ("flat_normal", c_double * 3),
        ("engaged_length", c_double),
        ("toughness", c_double),
        ("cut_friction", c_double),
    ]


class incise_haptic_options(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("pad", c_uint32),
        ("coupling_stiffness", c_double),
        ("coupling_damping", c_double),
        ("drag", c_double),
        ("max_stretch", c_double),
        ("max_force", c_double),
        ("physics_period", c_double),
        ("link_delay", c_double),
    ]


class incise_batch_options(Structure):
    _fields_ = [
        ("size", c_uint32),
        ("shard_index", c_uint32),
        ("shard_count", c_uint32),
        ("threads", c_uint32),
        ("retry", c_int32),
        ("pad", c_uint32),
        ("verify_items", c_uint64),
        ("verify_seed", c_uint64),
        ("progress", incise_progress),
        ("should_stop", incise_should_stop),
        ("user", c_void_p),
        ("log", incise_log),
        ("log_user", c_void_p),
    ]


def declare(library: CDLL) -> None:
    """Tells ctypes what the calls take and return."""
    library.incise_abi.restype = c_uint32
    library.incise_abi.argtypes = []
    library.incise_version.restype = c_char_p
    library.incise_version.argtypes = []
    library.incise_status_name.restype = c_char_p
    library.incise_status_name.argtypes = [c_int32]
    library.incise_last_error.restype = c_char_p
    library.incise_last_error.argtypes = []
    library.incise_last_error_code.restype = c_int32
    library.incise_last_error_code.argtypes = []
    library.incise_last_error_ids.restype = c_uint64
    library.incise_last_error_ids.argtypes = [c_void_p, c_uint64]
    library.incise_default_engine_options.restype = c_int32
    library.incise_default_engine_options.argtypes = [POINTER(incise_engine_options), c_uint32]
    library.incise_engine_create.restype = c_int32
    library.incise_engine_create.argtypes = [POINTER(incise_mesh_arrays), POINTER(incise_engine_options), c_void_p]
    library.incise_engine_create_box.restype = c_int32
    library.incise_engine_create_box.argtypes = [c_void_p, c_void_p, c_void_p, POINTER(incise_engine_options), c_void_p]
    library.incise_engine_read.restype = c_int32
    library.incise_engine_read.argtypes = [c_char_p, POINTER(incise_engine_options), c_void_p]
    library.incise_engine_read_bytes.restype = c_int32
    library.incise_engine_read_bytes.argtypes = [c_void_p, c_uint64, c_char_p, POINTER(incise_engine_options), c_void_p]
    library.incise_engine_free.restype = c_int32
    library.incise_engine_free.argtypes = [c_void_p]
    library.incise_engine_notes.restype = c_int32
    library.incise_engine_notes.argtypes = [c_void_p, c_void_p, c_uint64, c_void_p]
    library.incise_engine_write.restype = c_int32
    library.incise_engine_write.argtypes = [c_void_p, c_char_p, c_int32]
    library.incise_engine_write_bytes.restype = c_int32
    library.incise_engine_write_bytes.argtypes = [c_void_p, c_char_p, c_int32, c_void_p, c_uint64, c_void_p]
    library.incise_engine_write_surface.restype = c_int32
    library.incise_engine_write_surface.argtypes = [c_void_p, c_char_p]
    library.incise_engine_counts.restype = c_int32
    library.incise_engine_counts.argtypes = [c_void_p, POINTER(incise_counts)]
    library.incise_engine_view.restype = c_int32
    library.incise_engine_view.argtypes = [c_void_p, c_int32, POINTER(incise_view)]
    library.incise_engine_surface.restype = c_int32
    library.incise_engine_surface.argtypes = [c_void_p, c_void_p, c_void_p, c_void_p, c_uint64, c_void_p]
    library.incise_engine_compact.restype = c_int32
    library.incise_engine_compact.argtypes = [c_void_p, POINTER(incise_compact)]
    library.incise_engine_pieces.restype = c_int32
    library.incise_engine_pieces.argtypes = [c_void_p, c_void_p, c_uint64, c_void_p, c_void_p, c_uint64, c_void_p]
    library.incise_engine_hash.restype = c_int32
    library.incise_engine_hash.argtypes = [c_void_p, c_void_p]
    library.incise_engine_quality.restype = c_int32
    library.incise_engine_quality.argtypes = [c_void_p, c_int32, POINTER(incise_quality)]
    library.incise_engine_validate.restype = c_int32
    library.incise_engine_validate.argtypes = [c_void_p, c_int32, POINTER(incise_validity), POINTER(incise_violation), c_uint64, c_void_p]
    library.incise_violation_name.restype = c_char_p
    library.incise_violation_name.argtypes = [c_int32]
    library.incise_engine_cut.restype = c_int32
    library.incise_engine_cut.argtypes = [c_void_p, POINTER(incise_stroke), POINTER(incise_report)]
    library.incise_engine_cut_plane.restype = c_int32
    library.incise_engine_cut_plane.argtypes = [c_void_p, c_void_p, c_double, POINTER(incise_report)]
    library.incise_engine_cut_blade.restype = c_int32
    library.incise_engine_cut_blade.argtypes = [c_void_p, c_char_p, POINTER(incise_report)]
    library.incise_engine_begin_stroke.restype = c_int32
    library.incise_engine_begin_stroke.argtypes = [c_void_p, c_void_p, c_uint64, c_void_p, c_void_p]
    library.incise_engine_step.restype = c_int32
    library.incise_engine_step.argtypes = [c_void_p, c_void_p, c_uint64, c_void_p, POINTER(incise_report)]
    library.incise_engine_end_stroke.restype = c_int32
    library.incise_engine_end_stroke.argtypes = [c_void_p, POINTER(incise_report)]
    library.incise_engine_set_positions.restype = c_int32
    library.incise_engine_set_positions.argtypes = [c_void_p, c_void_p, c_uint64]
    library.incise_engine_undo.restype = c_int32
    library.incise_engine_undo.argtypes = [c_void_p, c_void_p]
    library.incise_engine_redo.restype = c_int32
    library.incise_engine_redo.argtypes = [c_void_p, c_void_p]
    library.incise_engine_keep_undo.restype = c_int32
    library.incise_engine_keep_undo.argtypes = [c_void_p, c_uint64]
    library.incise_engine_maintain.restype = c_int32
    library.incise_engine_maintain.argtypes = [c_void_p, c_uint64, incise_should_stop, c_void_p, POINTER(incise_report)]
    library.incise_engine_improve.restype = c_int32
    library.incise_engine_improve.argtypes = [c_void_p, incise_should_stop, c_void_p, POINTER(incise_report)]
    library.incise_engine_journal.restype = c_int32
    library.incise_engine_journal.argtypes = [c_void_p, POINTER(incise_journal)]
    library.incise_engine_step_counts.restype = c_int32
    library.incise_engine_step_counts.argtypes = [c_void_p, c_uint64, POINTER(incise_step_counts)]
    library.incise_engine_step_born.restype = c_int32
    library.incise_engine_step_born.argtypes = [c_void_p, c_uint64, POINTER(incise_born), c_uint64, c_void_p]
    library.incise_engine_step_moved.restype = c_int32
    library.incise_engine_step_moved.argtypes = [c_void_p, c_uint64, POINTER(incise_moved), c_uint64, c_void_p]
    library.incise_engine_step_copied.restype = c_int32
    library.incise_engine_step_copied.argtypes = [c_void_p, c_uint64, POINTER(incise_copied), c_uint64, c_void_p]
    library.incise_engine_step_consumed.restype = c_int32
    library.incise_engine_step_consumed.argtypes = [c_void_p, c_uint64, POINTER(incise_consumed), c_uint64, c_void_p]
    library.incise_engine_step_produced.restype = c_int32
    library.incise_engine_step_produced.argtypes = [c_void_p, c_uint64, POINTER(incise_produced), c_uint64, c_void_p]
    library.incise_engine_step_rewired.restype = c_int32
    library.incise_engine_step_rewired.argtypes = [c_void_p, c_uint64, POINTER(incise_rewired), c_uint64, c_void_p]
    library.incise_engine_step_opened.restype = c_int32
    library.incise_engine_step_opened.argtypes = [c_void_p, c_uint64, POINTER(incise_opened), c_uint64, c_void_p]
    library.incise_engine_step_closed.restype = c_int32
    library.incise_engine_step_closed.argtypes = [c_void_p, c_uint64, POINTER(incise_opened), c_uint64, c_void_p]
    library.incise_engine_step_died.restype = c_int32
    library.incise_engine_step_died.argtypes = [c_void_p, c_uint64, c_void_p, c_uint64, c_void_p]
    library.incise_engine_step_edits.restype = c_int32
    library.incise_engine_step_edits.argtypes = [c_void_p, c_uint64, POINTER(incise_edit), c_uint64, c_void_p]
    library.incise_engine_step_edit_consumed.restype = c_int32
    library.incise_engine_step_edit_consumed.argtypes = [c_void_p, c_uint64, POINTER(incise_consumed), c_uint64, c_void_p]
    library.incise_engine_step_edit_produced.restype = c_int32
    library.incise_engine_step_edit_produced.argtypes = [c_void_p, c_uint64, POINTER(incise_produced), c_uint64, c_void_p]
    library.incise_engine_step_new_vertices.restype = c_int32
    library.incise_engine_step_new_vertices.argtypes = [c_void_p, c_uint64, c_void_p, c_uint64, c_void_p]
    library.incise_engine_step_new_tets.restype = c_int32
    library.incise_engine_step_new_tets.argtypes = [c_void_p, c_uint64, c_void_p, c_uint64, c_void_p]
    library.incise_cursor_create.restype = c_int32
    library.incise_cursor_create.argtypes = [c_void_p, c_void_p]
    library.incise_cursor_way.restype = c_int32
    library.incise_cursor_way.argtypes = [c_void_p, c_void_p, c_void_p, c_void_p]
    library.incise_cursor_move.restype = c_int32
    library.incise_cursor_move.argtypes = [c_void_p, c_void_p]
    library.incise_cursor_free.restype = c_int32
    library.incise_cursor_free.argtypes = [c_void_p]
    library.incise_attributes_create.restype = c_int32
    library.incise_attributes_create.argtypes = [c_void_p, c_void_p]
    library.incise_attributes_add.restype = c_int32
    library.incise_attributes_add.argtypes = [c_void_p, c_void_p, POINTER(incise_attribute_spec), c_void_p]
    library.incise_attributes_find.restype = c_int32
    library.incise_attributes_find.argtypes = [c_void_p, c_char_p, c_void_p]
    library.incise_attributes_follow.restype = c_int32
    library.incise_attributes_follow.argtypes = [c_void_p, c_void_p]
    library.incise_attributes_values.restype = c_int32
    library.incise_attributes_values.argtypes = [c_void_p, c_uint32, c_void_p, c_void_p]
    library.incise_attributes_free.restype = c_int32
    library.incise_attributes_free.argtypes = [c_void_p]
    library.incise_default_body_options.restype = c_int32
    library.incise_default_body_options.argtypes = [POINTER(incise_body_options), c_uint32]
    library.incise_default_simulation_options.restype = c_int32
    library.incise_default_simulation_options.argtypes = [POINTER(incise_simulation_options), c_uint32]
    library.incise_simulation_create.restype = c_int32
    library.incise_simulation_create.argtypes = [POINTER(incise_mesh_arrays), POINTER(incise_simulation_options), c_void_p]
    library.incise_simulation_read.restype = c_int32
    library.incise_simulation_read.argtypes = [c_char_p, POINTER(incise_simulation_options), c_void_p]
    library.incise_simulation_read_scene.restype = c_int32
    library.incise_simulation_read_scene.argtypes = [c_char_p, c_uint32, c_void_p]
    library.incise_simulation_parse_scene.restype = c_int32
    library.incise_simulation_parse_scene.argtypes = [c_char_p, c_char_p, c_uint32, c_void_p]
    library.incise_simulation_free.restype = c_int32
    library.incise_simulation_free.argtypes = [c_void_p]
    library.incise_simulation_engine.restype = c_void_p
    library.incise_simulation_engine.argtypes = [c_void_p]
    library.incise_simulation_frame.restype = c_int32
    library.incise_simulation_frame.argtypes = [c_void_p, POINTER(incise_frame_input), POINTER(incise_frame_report)]
    library.incise_simulation_play.restype = c_int32
    library.incise_simulation_play.argtypes = [c_void_p, POINTER(incise_frame_report)]
    library.incise_simulation_cut_report.restype = c_int32
    library.incise_simulation_cut_report.argtypes = [c_void_p, POINTER(incise_report)]
    library.incise_simulation_hook_forces.restype = c_int32
    library.incise_simulation_hook_forces.argtypes = [c_void_p, c_void_p, c_uint64, c_void_p]
    library.incise_simulation_settle.restype = c_int32
    library.incise_simulation_settle.argtypes = [c_void_p, c_uint32, c_double, c_void_p]
    library.incise_simulation_settle_scene.restype = c_int32
    library.incise_simulation_settle_scene.argtypes = [c_void_p, c_void_p]
    library.incise_simulation_settle_until.restype = c_int32
    library.incise_simulation_settle_until.argtypes = [c_void_p, c_uint32, c_double, incise_should_stop, c_void_p, c_void_p]
    library.incise_simulation_settle_scene_until.restype = c_int32
    library.incise_simulation_settle_scene_until.argtypes = [c_void_p, incise_should_stop, c_void_p, c_void_p]
    library.incise_simulation_look.restype = c_int32
    library.incise_simulation_look.argtypes = [c_void_p, POINTER(incise_simulation_state)]
    library.incise_simulation_undo.restype = c_int32
    library.incise_simulation_undo.argtypes = [c_void_p, c_void_p]
    library.incise_simulation_redo.restype = c_int32
    library.incise_simulation_redo.argtypes = [c_void_p, c_void_p]
    library.incise_simulation_hold.restype = c_int32
    library.incise_simulation_hold.argtypes = [c_void_p, c_uint32, c_double]
    library.incise_simulation_pin.restype = c_int32
    library.incise_simulation_pin.argtypes = [c_void_p, c_uint32, c_double, c_double, c_int32]
    library.incise_simulation_move_hold.restype = c_int32
    library.incise_simulation_move_hold.argtypes = [c_void_p, c_uint32, c_void_p]
    library.incise_simulation_is_held.restype = c_int32
    library.incise_simulation_is_held.argtypes = [c_void_p, c_uint32, c_void_p]
    library.incise_simulation_velocities.restype = c_int32
    library.incise_simulation_velocities.argtypes = [c_void_p, c_void_p, c_uint64, c_void_p]
    library.incise_simulation_set_velocity.restype = c_int32
    library.incise_simulation_set_velocity.argtypes = [c_void_p, c_uint32, c_void_p]
    library.incise_simulation_haptic_snapshot.restype = c_int32
    library.incise_simulation_haptic_snapshot.argtypes = [c_void_p, POINTER(incise_haptic_snapshot)]
    library.incise_default_haptic_options.restype = c_int32
    library.incise_default_haptic_options.argtypes = [POINTER(incise_haptic_options), c_uint32]
    library.incise_haptic_tool_create.restype = c_int32
    library.incise_haptic_tool_create.argtypes = [POINTER(incise_haptic_options), c_void_p]
    library.incise_haptic_tool_accept.restype = c_int32
    library.incise_haptic_tool_accept.argtypes = [c_void_p, POINTER(incise_haptic_snapshot)]
    library.incise_haptic_tool_tick.restype = c_int32
    library.incise_haptic_tool_tick.argtypes = [c_void_p, c_double, c_void_p, c_void_p, c_void_p, c_void_p]
    library.incise_haptic_tool_free.restype = c_int32
    library.incise_haptic_tool_free.argtypes = [c_void_p]
    library.incise_plan_read.restype = c_int32
    library.incise_plan_read.argtypes = [c_char_p, c_void_p]
    library.incise_plan_parse.restype = c_int32
    library.incise_plan_parse.argtypes = [c_char_p, c_char_p, c_void_p]
    library.incise_plan_free.restype = c_int32
    library.incise_plan_free.argtypes = [c_void_p]
    library.incise_plan_count.restype = c_int32
    library.incise_plan_count.argtypes = [c_void_p, c_void_p]
    library.incise_plan_name.restype = c_int32
    library.incise_plan_name.argtypes = [c_void_p, c_uint64, c_void_p, c_uint64, c_void_p]
    library.incise_default_batch_options.restype = c_int32
    library.incise_default_batch_options.argtypes = [POINTER(incise_batch_options), c_uint32]
    library.incise_batch_run.restype = c_int32
    library.incise_batch_run.argtypes = [c_void_p, c_char_p, POINTER(incise_batch_options), incise_told, c_void_p]
    library.incise_batch_merge.restype = c_int32
    library.incise_batch_merge.argtypes = [c_void_p, c_char_p, incise_told, c_void_p]
    library.incise_batch_verify.restype = c_int32
    library.incise_batch_verify.argtypes = [c_void_p, c_char_p, POINTER(incise_batch_options), incise_told, c_void_p]
