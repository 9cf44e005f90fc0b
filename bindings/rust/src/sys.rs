// SPDX-License-Identifier: Apache-2.0
// Written by bindings/generate.py from include/incise/c/incise.h: change that, and run it again.
#![allow(non_camel_case_types, dead_code, missing_docs)]
use std::os::raw::{c_char, c_void};

pub const INCISE_ABI: u32 = 0;
pub const INCISE_NONE: u32 = 0xffffffff;
pub const INCISE_UNLIMITED: u64 = 0xffffffffffffffff;
pub const INCISE_OK: i32 = 0;
pub const INCISE_BAD_ARGUMENT: i32 = 1;
pub const INCISE_BAD_FILE: i32 = 2;
pub const INCISE_UNSUPPORTED: i32 = 3;
pub const INCISE_OUT_OF_MEMORY: i32 = 4;
pub const INCISE_IO: i32 = 5;
pub const INCISE_INTERNAL: i32 = 6;
pub const INCISE_BUSY: i32 = 7;
pub const INCISE_LOG_DEBUG: i32 = 0;
pub const INCISE_LOG_INFO: i32 = 1;
pub const INCISE_LOG_WARNING: i32 = 2;
pub const INCISE_PROFILE_PAPER: i32 = 0;
pub const INCISE_PROFILE_INCISE: i32 = 1;
pub const INCISE_AT_REST: i32 = 0;
pub const INCISE_AS_IT_STANDS: i32 = 1;
pub const INCISE_TETS: i32 = 0;
pub const INCISE_REST: i32 = 1;
pub const INCISE_CURRENT: i32 = 2;
pub const INCISE_LINKS: i32 = 3;
pub const INCISE_REGIONS: i32 = 4;
pub const INCISE_TET_GENERATIONS: i32 = 5;
pub const INCISE_VERTEX_GENERATIONS: i32 = 6;
pub const INCISE_SHAPES: i32 = 7;
pub const INCISE_ORIGINS: i32 = 8;
pub const INCISE_SHAPE_SKIN: i32 = 1;
pub const INCISE_SHAPE_WALL: i32 = 2;
pub const INCISE_SHAPE_FRONT: i32 = 4;
pub const INCISE_SHAPE_PINCHED: i32 = 8;
pub const INCISE_SHAPE_DEAD: i32 = 128;
pub const INCISE_VALIDATE_COUNTS: i32 = 0;
pub const INCISE_VALIDATE_TOPOLOGY: i32 = 1;
pub const INCISE_VALIDATE_GEOMETRY: i32 = 2;
pub const INCISE_VIOLATION_KINDS: i32 = 16;
pub const INCISE_EDIT_MOVE: i32 = 0;
pub const INCISE_EDIT_REMESH: i32 = 1;
pub const INCISE_WAY_NONE: i32 = 0;
pub const INCISE_WAY_FORWARD: i32 = 1;
pub const INCISE_WAY_ELSEWHERE: i32 = 2;
pub const INCISE_AT_VERTICES: i32 = 0;
pub const INCISE_AT_TETS: i32 = 1;
pub const INCISE_INTERPOLATE: i32 = 0;
pub const INCISE_INHERIT: i32 = 1;
pub const INCISE_CONSERVE: i32 = 2;
pub const INCISE_RECOMPUTE: i32 = 3;
pub const INCISE_BLOCK_DESCENT: i32 = 0;
pub const INCISE_POSITION_BASED: i32 = 1;
pub const INCISE_TOOL_BALL: i32 = 0;
pub const INCISE_TOOL_ROD: i32 = 1;
pub const INCISE_TOOL_PLANE: i32 = 2;
pub const INCISE_TOOL_FLAT: i32 = 3;
#[repr(C)]
pub struct incise_engine {
    _opaque: [u8; 0],
}
#[repr(C)]
pub struct incise_cursor {
    _opaque: [u8; 0],
}
#[repr(C)]
pub struct incise_attributes {
    _opaque: [u8; 0],
}
#[repr(C)]
pub struct incise_simulation {
    _opaque: [u8; 0],
}
#[repr(C)]
pub struct incise_haptic_tool {
    _opaque: [u8; 0],
}
#[repr(C)]
pub struct incise_plan {
    _opaque: [u8; 0],
}
pub type incise_log = unsafe extern "C" fn(user: *mut c_void, level: i32, message: *const c_char);
pub type incise_should_stop = unsafe extern "C" fn(user: *mut c_void) -> i32;
pub type incise_recompute = unsafe extern "C" fn(user: *mut c_void, slot: u32, value: *mut f64, width: u32);
pub type incise_progress = unsafe extern "C" fn(user: *mut c_void, done: u64, total: u64);
pub type incise_told = unsafe extern "C" fn(user: *mut c_void, text: *const c_char);
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_engine_options {
    pub size: u32,
    pub profile: i32,
    pub snap: f64,
    pub merge: i32,
    pub improve: i32,
    pub work_units: u64,
    pub threads: u32,
    pub smooth_boundary: i32,
    pub check_steps: i32,
    pub pad: u32,
    pub log: Option<incise_log>,
    pub log_user: *mut c_void,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_mesh_arrays {
    pub size: u32,
    pub mend: i32,
    pub points: *const f64,
    pub n_points: u64,
    pub tets: *const u32,
    pub n_tets: u64,
    pub regions: *const i32,
    pub walls: *const u32,
    pub n_walls: u64,
    pub origins: *const i32,
    pub fronts: *const u8,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_counts {
    pub size: u32,
    pub strokes: u32,
    pub vertices: u64,
    pub tets: u64,
    pub vertex_slots: u64,
    pub tet_slots: u64,
    pub memory_bytes: u64,
    pub version: u64,
    pub next_stroke: u32,
    pub is_in_stroke: i32,
    pub has_maintenance: i32,
    pub pad: i32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_view {
    pub size: u32,
    pub stride: u32,
    pub data: *const c_void,
    pub rows: u64,
    pub version: u64,
    pub is_stable: i32,
    pub pad: i32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_compact {
    pub size: u32,
    pub pose: i32,
    pub points: *mut f64,
    pub tets: *mut u32,
    pub regions: *mut i32,
    pub pieces: *mut u32,
    pub vertex_slots: *mut u32,
    pub tet_slots: *mut u32,
    pub vertices: u64,
    pub tet_count: u64,
    pub vertex_room: u64,
    pub tet_room: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_quality {
    pub size: u32,
    pub pad: u32,
    pub tets: u64,
    pub flat_tets: u64,
    pub lr_min: f64,
    pub lr_mean: f64,
    pub lr_p99: f64,
    pub lr_max: f64,
    pub lr_over_200_pct: f64,
    pub dihedral_min_deg: f64,
    pub dihedral_max_deg: f64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_violation {
    pub ids: [u64; 2],
    pub kind: i32,
    pub pad: i32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_validity {
    pub size: u32,
    pub ok: i32,
    pub counts: [u64; 16],
    pub volume: f64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_report {
    pub size: u32,
    pub stroke: u32,
    pub steps: u64,
    pub cut_tets: u64,
    pub created_tets: i64,
    pub new_vertices: i64,
    pub copied_vertices: u64,
    pub incision_faces: i64,
    pub snapped_vertices: u64,
    pub bent_vertices: u64,
    pub crumbs_kept: u64,
    pub pinched_edges: u64,
    pub latent_faces: u64,
    pub blocked_edges: u64,
    pub sheets: u64,
    pub work_units: u64,
    pub collapsed_edges: u64,
    pub moved_vertices: u64,
    pub removed_edges: u64,
    pub removed_faces: u64,
    pub inserted_vertices: u64,
    pub peeled_tets: u64,
    pub waiting_tets: u64,
    pub maintenance_tets: i64,
    pub collision_ms: f64,
    pub subdivide_ms: f64,
    pub separate_ms: f64,
    pub merge_ms: f64,
    pub improve_ms: f64,
    pub relax_ms: f64,
    pub journal_first: u64,
    pub journal_end: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_stroke {
    pub size: u32,
    pub pad: u32,
    pub times: *const f64,
    pub n_times: u64,
    pub points: *const f64,
    pub n_points: u64,
    pub name: *const c_char,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_journal {
    pub size: u32,
    pub pad: u32,
    pub first: u64,
    pub position: u64,
    pub end: u64,
    pub newest_serial: u64,
    pub memory_bytes: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_step_counts {
    pub size: u32,
    pub pad: u32,
    pub serial: u64,
    pub born: u64,
    pub moved: u64,
    pub copied: u64,
    pub consumed: u64,
    pub produced: u64,
    pub rewired: u64,
    pub opened: u64,
    pub closed: u64,
    pub died: u64,
    pub edits: u64,
    pub edit_consumed: u64,
    pub edit_produced: u64,
    pub new_vertices: u64,
    pub new_tets: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_born {
    pub id: u32,
    pub parents: [u32; 4],
    pub pad: u32,
    pub weights: [f64; 4],
    pub rest: [f64; 3],
    pub current: [f64; 3],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_moved {
    pub id: u32,
    pub basis: [u32; 4],
    pub pad: u32,
    pub weights: [f64; 4],
    pub old_rest: [f64; 3],
    pub rest: [f64; 3],
    pub old_current: [f64; 3],
    pub current: [f64; 3],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_copied {
    pub id: u32,
    pub source: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_consumed {
    pub id: u32,
    pub vertices: [u32; 4],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_produced {
    pub id: u32,
    pub parent: u32,
    pub vertices: [u32; 4],
    pub region: i32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_rewired {
    pub id: u32,
    pub old_vertices: [u32; 4],
    pub vertices: [u32; 4],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_opened {
    pub a: u32,
    pub b: u32,
    pub tag: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_edit {
    pub kind: u32,
    pub vertex: u32,
    pub consumed_end: u32,
    pub produced_end: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_attribute_spec {
    pub size: u32,
    pub domain: i32,
    pub name: *const c_char,
    pub width: u32,
    pub transfer: i32,
    pub initial: *const f64,
    pub recompute: Option<incise_recompute>,
    pub user: *mut c_void,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_body_options {
    pub size: u32,
    pub relaxation: i32,
    pub length_unit: f64,
    pub gravity: [f64; 3],
    pub damping: f64,
    pub substeps: u32,
    pub iterations: u32,
    pub thinnest: f64,
    pub sleep_below: f64,
    pub threads: u32,
    pub coarse: i32,
    pub crumb: f64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_material {
    pub region: i32,
    pub is_fallback: i32,
    pub density: f64,
    pub young: f64,
    pub poisson: f64,
    pub toughness: f64,
    pub cut_friction: f64,
    pub stiffening: f64,
    pub rupture: f64,
    pub fibre: [f64; 3],
    pub fibre_young: f64,
    pub prony: [f64; 6],
    pub rigid: i32,
    pub pad: i32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_simulation_options {
    pub size: u32,
    pub n_materials: u32,
    pub engine: *const incise_engine_options,
    pub body: *const incise_body_options,
    pub materials: *const incise_material,
    pub frame_seconds: f64,
    pub contact_stiffness: f64,
    pub flat_height: f64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_hook {
    pub id: u32,
    pub pad: u32,
    pub position: [f64; 3],
    pub radius: f64,
    pub stiffness: f64,
    pub strength: f64,
    pub tears: i32,
    pub pad2: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_tool {
    pub kind: i32,
    pub pad: u32,
    pub a: [f64; 3],
    pub b: [f64; 3],
    pub radius: f64,
    pub offset: f64,
    pub edge: *const f64,
    pub n_edge: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_frame_input {
    pub size: u32,
    pub pad: u32,
    pub blade: *const f64,
    pub n_blade: u64,
    pub direction: *const f64,
    pub hooks: *const incise_hook,
    pub n_hooks: u64,
    pub tools: *const incise_tool,
    pub n_tools: u64,
    pub slicing: f64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_frame_report {
    pub size: u32,
    pub stroke: u32,
    pub blade_touches: i32,
    pub blade_yields: i32,
    pub blade_force: [f64; 3],
    pub engaged_length: f64,
    pub fracture_work: f64,
    pub friction_work: f64,
    pub tool_work: f64,
    pub contacts: u64,
    pub active_vertices: u64,
    pub fastest: f64,
    pub n_hook_forces: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_simulation_state {
    pub size: u32,
    pub pad: u32,
    pub frames: u64,
    pub scene_frames: u64,
    pub frame_seconds: f64,
    pub length_unit: f64,
    pub mass: f64,
    pub momentum: [f64; 3],
    pub elastic: f64,
    pub kinetic: f64,
    pub potential: f64,
    pub held: f64,
    pub pulled: f64,
    pub force_on_holds: [f64; 3],
    pub inverted_tets: u64,
    pub hash: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_haptic_snapshot {
    pub size: u32,
    pub touches: i32,
    pub serial: u64,
    pub ruptured: i32,
    pub pad: i32,
    pub tool_position: [f64; 3],
    pub force: [f64; 3],
    pub compliance: [f64; 9],
    pub contact_point: [f64; 3],
    pub cutting_direction: [f64; 3],
    pub flat_normal: [f64; 3],
    pub engaged_length: f64,
    pub toughness: f64,
    pub cut_friction: f64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_haptic_options {
    pub size: u32,
    pub pad: u32,
    pub coupling_stiffness: f64,
    pub coupling_damping: f64,
    pub drag: f64,
    pub max_stretch: f64,
    pub max_force: f64,
    pub physics_period: f64,
    pub link_delay: f64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct incise_batch_options {
    pub size: u32,
    pub shard_index: u32,
    pub shard_count: u32,
    pub threads: u32,
    pub retry: i32,
    pub pad: u32,
    pub verify_items: u64,
    pub verify_seed: u64,
    pub progress: Option<incise_progress>,
    pub should_stop: Option<incise_should_stop>,
    pub user: *mut c_void,
    pub log: Option<incise_log>,
    pub log_user: *mut c_void,
}
#[link(name = "incise")]
extern "C" {
    pub fn incise_abi() -> u32;
    pub fn incise_version() -> *const c_char;
    pub fn incise_status_name(status: i32) -> *const c_char;
    pub fn incise_last_error() -> *const c_char;
    pub fn incise_last_error_code() -> i32;
    pub fn incise_last_error_ids(ids: *mut u64, room: u64) -> u64;
    pub fn incise_default_engine_options(options: *mut incise_engine_options, size: u32) -> i32;
    pub fn incise_engine_create(mesh: *const incise_mesh_arrays, options: *const incise_engine_options, engine: *mut *mut incise_engine) -> i32;
    pub fn incise_engine_create_box(low: *const f64, high: *const f64, cells: *const u32, options: *const incise_engine_options, engine: *mut *mut incise_engine) -> i32;
    pub fn incise_engine_read(path: *const c_char, options: *const incise_engine_options, engine: *mut *mut incise_engine) -> i32;
    pub fn incise_engine_read_bytes(bytes: *const c_void, n_bytes: u64, name: *const c_char, options: *const incise_engine_options, engine: *mut *mut incise_engine) -> i32;
    pub fn incise_engine_free(engine: *mut incise_engine) -> i32;
    pub fn incise_engine_notes(engine: *const incise_engine, text: *mut c_char, room: u64, count: *mut u64) -> i32;
    pub fn incise_engine_write(engine: *const incise_engine, path: *const c_char, pose: i32) -> i32;
    pub fn incise_engine_write_bytes(engine: *const incise_engine, extension: *const c_char, pose: i32, bytes: *mut c_void, room: u64, count: *mut u64) -> i32;
    pub fn incise_engine_write_surface(engine: *const incise_engine, path: *const c_char) -> i32;
    pub fn incise_engine_counts(engine: *const incise_engine, counts: *mut incise_counts) -> i32;
    pub fn incise_engine_view(engine: *const incise_engine, which: i32, view: *mut incise_view) -> i32;
    pub fn incise_engine_surface(engine: *const incise_engine, triangles: *mut u32, tags: *mut u32, sides: *mut u32, room: u64, count: *mut u64) -> i32;
    pub fn incise_engine_compact(engine: *const incise_engine, arrays: *mut incise_compact) -> i32;
    pub fn incise_engine_pieces(engine: *const incise_engine, labels: *mut u32, label_room: u64, tets: *mut u64, volumes: *mut f64, piece_room: u64, count: *mut u64) -> i32;
    pub fn incise_engine_hash(engine: *const incise_engine, hash: *mut u64) -> i32;
    pub fn incise_engine_quality(engine: *const incise_engine, only_at_cuts: i32, quality: *mut incise_quality) -> i32;
    pub fn incise_engine_validate(engine: *const incise_engine, level: i32, validity: *mut incise_validity, violations: *mut incise_violation, room: u64, count: *mut u64) -> i32;
    pub fn incise_violation_name(kind: i32) -> *const c_char;
    pub fn incise_engine_cut(engine: *mut incise_engine, stroke: *const incise_stroke, report: *mut incise_report) -> i32;
    pub fn incise_engine_cut_plane(engine: *mut incise_engine, normal: *const f64, offset: f64, report: *mut incise_report) -> i32;
    pub fn incise_engine_cut_blade(engine: *mut incise_engine, path: *const c_char, report: *mut incise_report) -> i32;
    pub fn incise_engine_begin_stroke(engine: *mut incise_engine, edge: *const f64, n_points: u64, direction: *const f64, stroke: *mut u32) -> i32;
    pub fn incise_engine_step(engine: *mut incise_engine, edge: *const f64, n_points: u64, direction: *const f64, report: *mut incise_report) -> i32;
    pub fn incise_engine_end_stroke(engine: *mut incise_engine, report: *mut incise_report) -> i32;
    pub fn incise_engine_set_positions(engine: *mut incise_engine, positions: *const f64, n_slots: u64) -> i32;
    pub fn incise_engine_undo(engine: *mut incise_engine, done: *mut i32) -> i32;
    pub fn incise_engine_redo(engine: *mut incise_engine, done: *mut i32) -> i32;
    pub fn incise_engine_keep_undo(engine: *mut incise_engine, operations: u64) -> i32;
    pub fn incise_engine_maintain(engine: *mut incise_engine, work_units: u64, should_stop: Option<incise_should_stop>, user: *mut c_void, report: *mut incise_report) -> i32;
    pub fn incise_engine_improve(engine: *mut incise_engine, should_stop: Option<incise_should_stop>, user: *mut c_void, report: *mut incise_report) -> i32;
    pub fn incise_engine_journal(engine: *const incise_engine, journal: *mut incise_journal) -> i32;
    pub fn incise_engine_step_counts(engine: *const incise_engine, step: u64, counts: *mut incise_step_counts) -> i32;
    pub fn incise_engine_step_born(engine: *const incise_engine, step: u64, records: *mut incise_born, room: u64, count: *mut u64) -> i32;
    pub fn incise_engine_step_moved(engine: *const incise_engine, step: u64, records: *mut incise_moved, room: u64, count: *mut u64) -> i32;
    pub fn incise_engine_step_copied(engine: *const incise_engine, step: u64, records: *mut incise_copied, room: u64, count: *mut u64) -> i32;
    pub fn incise_engine_step_consumed(engine: *const incise_engine, step: u64, records: *mut incise_consumed, room: u64, count: *mut u64) -> i32;
    pub fn incise_engine_step_produced(engine: *const incise_engine, step: u64, records: *mut incise_produced, room: u64, count: *mut u64) -> i32;
    pub fn incise_engine_step_rewired(engine: *const incise_engine, step: u64, records: *mut incise_rewired, room: u64, count: *mut u64) -> i32;
    pub fn incise_engine_step_opened(engine: *const incise_engine, step: u64, records: *mut incise_opened, room: u64, count: *mut u64) -> i32;
    pub fn incise_engine_step_closed(engine: *const incise_engine, step: u64, records: *mut incise_opened, room: u64, count: *mut u64) -> i32;
    pub fn incise_engine_step_died(engine: *const incise_engine, step: u64, records: *mut u32, room: u64, count: *mut u64) -> i32;
    pub fn incise_engine_step_edits(engine: *const incise_engine, step: u64, records: *mut incise_edit, room: u64, count: *mut u64) -> i32;
    pub fn incise_engine_step_edit_consumed(engine: *const incise_engine, step: u64, records: *mut incise_consumed, room: u64, count: *mut u64) -> i32;
    pub fn incise_engine_step_edit_produced(engine: *const incise_engine, step: u64, records: *mut incise_produced, room: u64, count: *mut u64) -> i32;
    pub fn incise_engine_step_new_vertices(engine: *const incise_engine, step: u64, records: *mut u32, room: u64, count: *mut u64) -> i32;
    pub fn incise_engine_step_new_tets(engine: *const incise_engine, step: u64, records: *mut u32, room: u64, count: *mut u64) -> i32;
    pub fn incise_cursor_create(engine: *const incise_engine, cursor: *mut *mut incise_cursor) -> i32;
    pub fn incise_cursor_way(cursor: *const incise_cursor, engine: *const incise_engine, way: *mut i32, position: *mut u64) -> i32;
    pub fn incise_cursor_move(cursor: *mut incise_cursor, engine: *const incise_engine) -> i32;
    pub fn incise_cursor_free(cursor: *mut incise_cursor) -> i32;
    pub fn incise_attributes_create(engine: *const incise_engine, attributes: *mut *mut incise_attributes) -> i32;
    pub fn incise_attributes_add(attributes: *mut incise_attributes, engine: *const incise_engine, spec: *const incise_attribute_spec, id: *mut u32) -> i32;
    pub fn incise_attributes_find(attributes: *const incise_attributes, name: *const c_char, id: *mut u32) -> i32;
    pub fn incise_attributes_follow(attributes: *mut incise_attributes, engine: *const incise_engine) -> i32;
    pub fn incise_attributes_values(attributes: *mut incise_attributes, id: u32, values: *mut *mut f64, n_values: *mut u64) -> i32;
    pub fn incise_attributes_free(attributes: *mut incise_attributes) -> i32;
    pub fn incise_default_body_options(options: *mut incise_body_options, size: u32) -> i32;
    pub fn incise_default_simulation_options(options: *mut incise_simulation_options, size: u32) -> i32;
    pub fn incise_simulation_create(mesh: *const incise_mesh_arrays, options: *const incise_simulation_options, simulation: *mut *mut incise_simulation) -> i32;
    pub fn incise_simulation_read(path: *const c_char, options: *const incise_simulation_options, simulation: *mut *mut incise_simulation) -> i32;
    pub fn incise_simulation_read_scene(path: *const c_char, threads: u32, simulation: *mut *mut incise_simulation) -> i32;
    pub fn incise_simulation_parse_scene(json: *const c_char, folder: *const c_char, threads: u32, simulation: *mut *mut incise_simulation) -> i32;
    pub fn incise_simulation_free(simulation: *mut incise_simulation) -> i32;
    pub fn incise_simulation_engine(simulation: *const incise_simulation) -> *const incise_engine;
    pub fn incise_simulation_frame(simulation: *mut incise_simulation, input: *const incise_frame_input, report: *mut incise_frame_report) -> i32;
    pub fn incise_simulation_play(simulation: *mut incise_simulation, report: *mut incise_frame_report) -> i32;
    pub fn incise_simulation_cut_report(simulation: *const incise_simulation, report: *mut incise_report) -> i32;
    pub fn incise_simulation_hook_forces(simulation: *const incise_simulation, forces: *mut f64, room: u64, count: *mut u64) -> i32;
    pub fn incise_simulation_settle(simulation: *mut incise_simulation, max_frames: u32, speed: f64, frames: *mut u32) -> i32;
    pub fn incise_simulation_settle_scene(simulation: *mut incise_simulation, frames: *mut u32) -> i32;
    pub fn incise_simulation_settle_until(simulation: *mut incise_simulation, max_frames: u32, speed: f64, should_stop: Option<incise_should_stop>, user: *mut c_void, frames: *mut u32) -> i32;
    pub fn incise_simulation_settle_scene_until(simulation: *mut incise_simulation, should_stop: Option<incise_should_stop>, user: *mut c_void, frames: *mut u32) -> i32;
    pub fn incise_simulation_look(simulation: *const incise_simulation, state: *mut incise_simulation_state) -> i32;
    pub fn incise_simulation_undo(simulation: *mut incise_simulation, done: *mut i32) -> i32;
    pub fn incise_simulation_redo(simulation: *mut incise_simulation, done: *mut i32) -> i32;
    pub fn incise_simulation_hold(simulation: *mut incise_simulation, vertex: u32, stiffness: f64) -> i32;
    pub fn incise_simulation_pin(simulation: *mut incise_simulation, vertex: u32, stiffness: f64, strength: f64, tears: i32) -> i32;
    pub fn incise_simulation_move_hold(simulation: *mut incise_simulation, vertex: u32, target: *const f64) -> i32;
    pub fn incise_simulation_is_held(simulation: *const incise_simulation, vertex: u32, is_held: *mut i32) -> i32;
    pub fn incise_simulation_velocities(simulation: *const incise_simulation, velocities: *mut f64, room: u64, count: *mut u64) -> i32;
    pub fn incise_simulation_set_velocity(simulation: *mut incise_simulation, vertex: u32, velocity: *const f64) -> i32;
    pub fn incise_simulation_haptic_snapshot(simulation: *const incise_simulation, snapshot: *mut incise_haptic_snapshot) -> i32;
    pub fn incise_default_haptic_options(options: *mut incise_haptic_options, size: u32) -> i32;
    pub fn incise_haptic_tool_create(options: *const incise_haptic_options, tool: *mut *mut incise_haptic_tool) -> i32;
    pub fn incise_haptic_tool_accept(tool: *mut incise_haptic_tool, snapshot: *const incise_haptic_snapshot) -> i32;
    pub fn incise_haptic_tool_tick(tool: *mut incise_haptic_tool, dt: f64, position: *const f64, velocity: *const f64, force: *mut f64, tool_position: *mut f64) -> i32;
    pub fn incise_haptic_tool_free(tool: *mut incise_haptic_tool) -> i32;
    pub fn incise_plan_read(path: *const c_char, plan: *mut *mut incise_plan) -> i32;
    pub fn incise_plan_parse(json: *const c_char, folder: *const c_char, plan: *mut *mut incise_plan) -> i32;
    pub fn incise_plan_free(plan: *mut incise_plan) -> i32;
    pub fn incise_plan_count(plan: *const incise_plan, count: *mut u64) -> i32;
    pub fn incise_plan_name(plan: *const incise_plan, item: u64, text: *mut c_char, room: u64, count: *mut u64) -> i32;
    pub fn incise_default_batch_options(options: *mut incise_batch_options, size: u32) -> i32;
    pub fn incise_batch_run(plan: *const incise_plan, folder: *const c_char, options: *const incise_batch_options, tell: Option<incise_told>, user: *mut c_void) -> i32;
    pub fn incise_batch_merge(plan: *const incise_plan, folder: *const c_char, tell: Option<incise_told>, user: *mut c_void) -> i32;
    pub fn incise_batch_verify(plan: *const incise_plan, folder: *const c_char, options: *const incise_batch_options, tell: Option<incise_told>, user: *mut c_void) -> i32;
}
