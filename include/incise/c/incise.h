/* SPDX-License-Identifier: Apache-2.0
 *
 * Incise in C: everything that the library does, for C99 and all that can call C. docs/c.md has every call by task.
 *
 * - Calls return a status; INCISE_OK is 0. What failed, with the ids of the elements concerned, is told by
 *   `incise_last_error` on the same thread. Nothing is thrown, printed, or ended.
 * - Buffers are the caller's. Where a call fills one it takes `room`, in records, and tells in `count` how many there
 *   are; it writes the first `room` of them. A null buffer with room 0 asks for the number.
 * - Structs whose first member is `size` grow with the library: set it to sizeof the struct. An older program goes on
 *   to work with a newer library; what it does not know of keeps its default. Options are filled by their
 *   `incise_default_...` call first. Structs without `size` never change.
 * - A handle belongs to one thread at a time. A call that finds another thread within a call on the same handle does
 *   nothing and returns INCISE_BUSY; so does a call that a callback makes on the handle that it was called from, unless
 *   its type says that it may. Different handles have nothing to do with each other.
 * - An id is the number of a slot. Arrays by slot have free slots in them: a free tet's first vertex is INCISE_NONE, a
 *   free vertex has the shape bit INCISE_SHAPE_DEAD.
 * - Lengths are in the unit of the mesh, everything else in SI units. Points are x y z, one after the other.
 *
 * bindings/generate.py reads this file and writes the other languages' declarations; it takes one declaration of a
 * member per line. */
#ifndef INCISE_C_INCISE_H
#define INCISE_C_INCISE_H

#include <stdint.h>

#if defined(_WIN32)
#if defined(INCISE_C_BUILDS)
#define INCISE_API __declspec(dllexport)
#else
#define INCISE_API __declspec(dllimport)
#endif
#else
#define INCISE_API __attribute__((visibility("default")))
#endif

/* C names are not C++ names. NOLINTBEGIN(readability-identifier-naming) */
#ifdef __cplusplus
extern "C" {
#endif

/* ---- versions and errors ------------------------------------------------------------------------------------- */

/* Of this header. A library of the same number serves it. */
#define INCISE_ABI 0
/* "No element" in every id. */
#define INCISE_NONE 0xFFFFFFFFu
/* Maintenance without a budget. */
#define INCISE_UNLIMITED 0xFFFFFFFFFFFFFFFFu

/* What a call returns: one of the numbers below. */
typedef int32_t incise_status;
#define INCISE_OK 0            /* done */
#define INCISE_BAD_ARGUMENT 1  /* an argument is outside its documented range */
#define INCISE_BAD_FILE 2      /* a file cannot be opened, or holds not what its format promises */
#define INCISE_UNSUPPORTED 3   /* well formed, but of a kind that Incise does not handle */
#define INCISE_OUT_OF_MEMORY 4 /* an allocation or an id range would be exceeded */
#define INCISE_IO 5            /* writing failed */
#define INCISE_INTERNAL 6      /* a broken invariant: the step was rolled back */
#define INCISE_BUSY 7          /* another thread is in a call on this handle */

/* INCISE_ABI of the library. */
INCISE_API uint32_t incise_abi(void);
/* The library's version, for instance "0.1.0". */
INCISE_API const char* incise_version(void);
/* "ok", "bad argument", ...; "unknown" for other numbers. */
INCISE_API const char* incise_status_name(incise_status status);

/* Of the last call on this thread that failed: one line that names the place and the remedy. Valid until the next call
 * on this thread fails. */
INCISE_API const char* incise_last_error(void);
/* The status of that call. */
INCISE_API incise_status incise_last_error_code(void);
/* The ids of the elements concerned, a few at most; what they are is in the message. Returns how many there are. */
INCISE_API uint64_t incise_last_error_ids(uint64_t* ids, uint64_t room);

/* ---- engines ------------------------------------------------------------------------------------------------- */

/* Owns a mesh and cuts it. */
typedef struct incise_engine incise_engine;

/* What the library has to say, for instance what a stroke could not do as asked. */
typedef void (*incise_log)(void* user, int32_t level, const char* message);
#define INCISE_LOG_DEBUG 0   /* for developers */
#define INCISE_LOG_INFO 1    /* worth knowing */
#define INCISE_LOG_WARNING 2 /* something was not done as asked */

/* Asked between operations of what takes long; other than 0 ends it for now, and it is not asked again. */
typedef int32_t (*incise_should_stop)(void* user);

#define INCISE_PROFILE_PAPER 0  /* the published method */
#define INCISE_PROFILE_INCISE 1 /* our own; the default */

/* How an engine works; see EngineOptions in C++. */
typedef struct incise_engine_options {
  uint32_t size;
  int32_t profile;         /* INCISE_PROFILE_... */
  double snap;             /* snapping distance as a share of the mean edge, in [0, 0.4]; 0: none */
  int32_t merge;           /* merge short edges after a cut */
  int32_t improve;         /* smooth, swap and remove what is badly shaped after a cut */
  uint64_t work_units;     /* of maintenance per stroke, or per step; about 0.1 us each; INCISE_UNLIMITED */
  uint32_t threads;        /* that search the mesh, in [1, 256]; the result does not depend on it */
  int32_t smooth_boundary; /* of the profile paper alone */
  int32_t check_steps;     /* look at all that a call touched, and take it back where that is not valid */
  uint32_t pad;
  incise_log log; /* null: nobody listens */
  void* log_user; /* handed to `log` */
} incise_engine_options;

/* Writes the first `size` bytes of the default options. */
INCISE_API incise_status incise_default_engine_options(incise_engine_options* options, uint32_t size);

/* A mesh as arrays. The first three pairs are enough; the last three are there where the mesh was cut before. */
typedef struct incise_mesh_arrays {
  uint32_t size;
  int32_t mend;           /* other than 0: turn tets of negative volume, drop exact duplicates, as reading files does */
  const double* points;   /* 3 n_points: x y z, finite */
  uint64_t n_points;      /* below 2^32 - 1 */
  const uint32_t* tets;   /* 4 n_tets: numbers of points; positive where (1-0) x (2-0) . (3-0) is */
  uint64_t n_tets;        /* at most 2^28 */
  const int32_t* regions; /* n_tets; null: all 0 */
  const uint32_t* walls;  /* 4 n_walls: three points and the stroke, from 1, of a boundary face that a cut made */
  uint64_t n_walls;       /* of them */
  const int32_t* origins; /* n_points: the vertex before all cuts, below 0: none; null: points are their own */
  const uint8_t* fronts;  /* n_points: 1 where a cut ends; null: seen from the walls */
} incise_mesh_arrays;

/* Makes an engine; `options` null: the default. Slots are the numbers of the arrays unless `mend` dropped tets.
 * Errors: bad argument names the first tet or point that is not sound. Each engine reserves about 25 GiB of address
 * space (not memory); see docs/c.md. Cost: O(n log n). */
INCISE_API incise_status incise_engine_create(const incise_mesh_arrays* mesh, const incise_engine_options* options,
                                              incise_engine** engine);
/* A box of `cells` = nx, ny, nz cells with six tets each between two corners (3 numbers each, low < high). */
INCISE_API incise_status incise_engine_create_box(const double* low, const double* high, const uint32_t* cells,
                                                  const incise_engine_options* options, incise_engine** engine);
/* Reads a mesh file: MEDIT, Gmsh, VTK, VTU, TetGen, Vega, Abaqus, tetrahedral PLY, gzipped or not, told by its content.
 * Negative tets are turned and duplicates dropped; see `incise_engine_notes`. Errors: bad file "FILE:LINE: ...". */
INCISE_API incise_status incise_engine_read(const char* path, const incise_engine_options* options,
                                            incise_engine** engine);
/* The same for `n_bytes` in memory; `name` stands for the file in messages. */
INCISE_API incise_status incise_engine_read_bytes(const void* bytes, uint64_t n_bytes, const char* name,
                                                  const incise_engine_options* options, incise_engine** engine);
/* Null is fine. INCISE_BUSY, and nothing is freed, while another thread is in a call. */
INCISE_API incise_status incise_engine_free(incise_engine* engine);

/* What reading changed or left out, and of arrays that are not mended the duplicate tets, one line each: copies at most
 * `room` bytes with a closing 0, tells in `count` how many the whole takes. */
INCISE_API incise_status incise_engine_notes(const incise_engine* engine, char* text, uint64_t room, uint64_t* count);

/* ---- the mesh, out ------------------------------------------------------------------------------------------- */

#define INCISE_AT_REST 0      /* the shape before anything deformed it */
#define INCISE_AS_IT_STANDS 1 /* the shape that `set_positions` gave last */

/* Writes the mesh in the format of the extension, with region and piece per tet, the stroke of each wall, and the
 * origin of each vertex, where the format can. No partial file is ever seen. */
INCISE_API incise_status incise_engine_write(const incise_engine* engine, const char* path, int32_t pose);
/* The bytes of such a file; `extension` is ".mesh", ".msh", ".msh2", ".vtk", ".vtu", ".node", ".ele", ".veg" or ".inp".
 */
INCISE_API incise_status incise_engine_write_bytes(const incise_engine* engine, const char* extension, int32_t pose,
                                                   void* bytes, uint64_t room, uint64_t* count);
/* Writes skin and walls at rest as triangles: .obj, .stl, .ply or .off. */
INCISE_API incise_status incise_engine_write_surface(const incise_engine* engine, const char* path);

/* How much there is. */
typedef struct incise_counts {
  uint32_t size;
  uint32_t strokes;        /* applied, undone ones not counted */
  uint64_t vertices;       /* live ones */
  uint64_t tets;           /* live ones */
  uint64_t vertex_slots;   /* one past the highest in use */
  uint64_t tet_slots;      /* likewise */
  uint64_t memory_bytes;   /* of the mesh */
  uint64_t version;        /* goes up with every call that may change the engine */
  uint32_t next_stroke;    /* the number that the next stroke gets, or the one under way has */
  int32_t is_in_stroke;    /* a stroke is under way */
  int32_t has_maintenance; /* some waits */
  int32_t pad;
} incise_counts;
/* Cost: O(1). */
INCISE_API incise_status incise_engine_counts(const incise_engine* engine, incise_counts* counts);

/* Arrays by slot. */
#define INCISE_TETS 0               /* uint32 x 4 */
#define INCISE_REST 1               /* double x 3 */
#define INCISE_CURRENT 2            /* double x 3: where the body stands */
#define INCISE_LINKS 3              /* uint32 x 4: the neighbour's tet * 4 + side; bit 31: boundary, the rest its tag */
#define INCISE_REGIONS 4            /* int32 */
#define INCISE_TET_GENERATIONS 5    /* uint32: goes up when the slot is freed */
#define INCISE_VERTEX_GENERATIONS 6 /* uint32 */
#define INCISE_SHAPES 7             /* uint8: INCISE_SHAPE_... */
#define INCISE_ORIGINS 8            /* uint32: the input's vertex, INCISE_NONE where a cut made it */

/* What a vertex is part of: bits. None: it is inside. */
#define INCISE_SHAPE_SKIN 1    /* on the original surface */
#define INCISE_SHAPE_WALL 2    /* on a cut wall */
#define INCISE_SHAPE_FRONT 4   /* where a cut ends inside */
#define INCISE_SHAPE_PINCHED 8 /* its tets were not face-connected at load */
#define INCISE_SHAPE_DEAD 128  /* the slot is free */

/* The engine's own memory: look, and do not write. */
typedef struct incise_view {
  uint32_t size;
  uint32_t stride;   /* bytes per row */
  const void* data;  /* rows of the array */
  uint64_t rows;     /* one per slot */
  uint64_t version;  /* as in incise_counts: the same number, the same rows with the same values */
  int32_t is_stable; /* 1: `data` stays where it is as long as the engine lives; 0: any call may move it */
  int32_t pad;
} incise_view;
/* `which`: INCISE_TETS to INCISE_ORIGINS. Cost: O(1). */
INCISE_API incise_status incise_engine_view(const incise_engine* engine, int32_t which, incise_view* view);

/* The boundary: three vertices per triangle, counter-clockwise seen from outside, its tag (0 skin, else the stroke) and
 * its side (tet * 4 + side). Each of the three may be null. Cost: O(tets). */
INCISE_API incise_status incise_engine_surface(const incise_engine* engine, uint32_t* triangles, uint32_t* tags,
                                               uint32_t* sides, uint64_t room, uint64_t* count);

/* The live mesh without free slots, in the order of slots. Any may be null; the others have room for all. */
typedef struct incise_compact {
  uint32_t size;
  int32_t pose;           /* INCISE_AT_REST or INCISE_AS_IT_STANDS */
  double* points;         /* 3 * vertices */
  uint32_t* tets;         /* 4 * tets: numbers of points */
  int32_t* regions;       /* tets */
  uint32_t* pieces;       /* tets: face-connected piece */
  uint32_t* vertex_slots; /* vertices: the slot of each point */
  uint32_t* tet_slots;    /* tets */
  uint64_t vertices;      /* out */
  uint64_t tet_count;     /* out */
  uint64_t vertex_room;   /* how many vertices there is room for; 0: enough */
  uint64_t tet_room;      /* likewise */
} incise_compact;
/* Errors: bad argument, and nothing is written, where the mesh has more than there is room for: another thread may have
 * cut it since it was counted. Cost: O(slots). */
INCISE_API incise_status incise_engine_compact(const incise_engine* engine, incise_compact* arrays);

/* The face-connected pieces: label by tet slot (INCISE_NONE where free), of which `label_room` are written; tets and
 * rest volume of each piece, of which `piece_room` are written. Each of the three may be null. */
INCISE_API incise_status incise_engine_pieces(const incise_engine* engine, uint32_t* labels, uint64_t label_room,
                                              uint64_t* tets, double* volumes, uint64_t piece_room, uint64_t* count);

/* 64 bits over connectivity, rest positions, regions, tags and free slots: the same on every compiler and machine.
 * Undo restores it. */
INCISE_API incise_status incise_engine_hash(const incise_engine* engine, uint64_t* hash);

/* The quality of a set of tets at rest; all 0 where it is empty. */
typedef struct incise_quality {
  uint32_t size;
  uint32_t pad;
  uint64_t tets;           /* measured */
  uint64_t flat_tets;      /* without volume to speak of; left out of what follows */
  double lr_min;           /* longest edge over inradius: 4.899 is regular, larger is worse */
  double lr_mean;          /* arithmetic */
  double lr_p99;           /* nearest rank */
  double lr_max;           /* the worst */
  double lr_over_200_pct;  /* percent of the tets, flat ones included */
  double dihedral_min_deg; /* degree */
  double dihedral_max_deg; /* degree */
} incise_quality;
/* At rest. `only_at_cuts`: of the tets with a vertex on a cut wall alone. */
INCISE_API incise_status incise_engine_quality(const incise_engine* engine, int32_t only_at_cuts,
                                               incise_quality* quality);

/* How much is looked at; each level has those before it. */
#define INCISE_VALIDATE_COUNTS 0   /* counts, ids, finite positions */
#define INCISE_VALIDATE_TOPOLOGY 1 /* links, faces, edges, stars, duplicates, too */
#define INCISE_VALIDATE_GEOMETRY 2 /* signs of rest volumes, and the total, too */
/* See `incise_violation_name`. */
#define INCISE_VIOLATION_KINDS 16

/* One place where the contract is broken. */
typedef struct incise_violation {
  uint64_t ids[2]; /* slots, meaning by kind */
  int32_t kind;    /* see `incise_violation_name` */
  int32_t pad;
} incise_violation;

/* What looking at the mesh found. */
typedef struct incise_validity {
  uint32_t size;
  int32_t ok;          /* no violation at all, the input's own included */
  uint64_t counts[16]; /* by kind */
  double volume;       /* total at rest, where the level is geometry */
} incise_validity;
/* Checks the validity contract (docs/internals.md). `violations` may be null. Cost: about 1 us per tet. */
INCISE_API incise_status incise_engine_validate(const incise_engine* engine, int32_t level, incise_validity* validity,
                                                incise_violation* violations, uint64_t room, uint64_t* count);
/* For instance "nonmanifold_cut_edge"; null for other numbers. */
INCISE_API const char* incise_violation_name(int32_t kind);

/* ---- cutting ------------------------------------------------------------------------------------------------- */

/* What a call did. Counts are sums over its steps. A step may take back what those before it made where the blade was:
   of a step or frame the growth can be below zero, and the sum over its stroke is what is there at the end. */
typedef struct incise_report {
  uint32_t size;
  uint32_t stroke;            /* its number: the tag of its walls; 0: none */
  uint64_t steps;             /* steps of the blade */
  uint64_t cut_tets;          /* tets with material on both sides of the sweep */
  int64_t created_tets;       /* by the cut: tets after minus tets before */
  int64_t new_vertices;       /* growth: split points and copies */
  uint64_t copied_vertices;   /* the copies among them */
  int64_t incision_faces;     /* growth: faces opened */
  uint64_t snapped_vertices;  /* vertices that took part in the cut */
  uint64_t bent_vertices;     /* of these, not movable onto the sweep */
  uint64_t crumbs_kept;       /* pieces too small to separate */
  uint64_t pinched_edges;     /* edges bisected because both their fans kept both ends */
  uint64_t latent_faces;      /* incision faces that stayed joined */
  uint64_t blocked_edges;     /* edges left whole beside flat tets */
  uint64_t sheets;            /* parts of a sweep that meets itself */
  uint64_t work_units;        /* of maintenance, from here on */
  uint64_t collapsed_edges;   /* vertices merged into a neighbour */
  uint64_t moved_vertices;    /* moves */
  uint64_t removed_edges;     /* edges swapped away */
  uint64_t removed_faces;     /* 2-3 swaps */
  uint64_t inserted_vertices; /* vertices put in */
  uint64_t peeled_tets;       /* flat tets taken off a surface */
  uint64_t waiting_tets;      /* 0: all is done */
  int64_t maintenance_tets;   /* tets after minus tets before */
  double collision_ms;        /* times are only reported; no decision reads them */
  double subdivide_ms;        /* division of tets */
  double separate_ms;         /* copies of vertices */
  double merge_ms;            /* merging of edges */
  double improve_ms;          /* smoothing and swapping */
  double relax_ms;            /* the solver */
  uint64_t journal_first;     /* the call's steps in the journal: [journal_first, journal_end) */
  uint64_t journal_end;       /* one past the last */
} incise_report;

/* A blade's motion through the rest shape: its edge as a polyline at increasing times. Each pair of times is a step. */
typedef struct incise_stroke {
  uint32_t size;
  uint32_t pad;
  const double* times;  /* s, n_times, strictly increasing */
  uint64_t n_times;     /* at least 2 */
  const double* points; /* 3 n_points for each time */
  uint64_t n_points;    /* at least 2 */
  const char* name;     /* for messages; null: none */
} incise_stroke;

/* Cuts along the whole stroke and maintains what it left. A blade that misses changes nothing and is no error.
 * `report` may be null, here and below. Errors: bad argument for a malformed stroke; the mesh is then unchanged. */
INCISE_API incise_status incise_engine_cut(incise_engine* engine, const incise_stroke* stroke, incise_report* report);
/* Cuts all that is there along normal . x = offset; `normal`: 3 numbers, of any length but 0. */
INCISE_API incise_status incise_engine_cut_plane(incise_engine* engine, const double* normal, double offset,
                                                 incise_report* report);
/* Cuts the strokes of a blade file (docs/formats.md), one after the other; `report` has their sums. Where one fails
 * those before it stay. */
INCISE_API incise_status incise_engine_cut_blade(incise_engine* engine, const char* path, incise_report* report);

/* Puts the blade in place: its edge as the body stands, `n_points` >= 2; `direction`: 3 numbers, where it cuts, null:
 * where it moves. `stroke`, which may be null, gets the stroke's number. */
INCISE_API incise_status incise_engine_begin_stroke(incise_engine* engine, const double* edge, uint64_t n_points,
                                                    const double* direction, uint32_t* stroke);
/* Moves the blade on and cuts what it passes through, up to where it stands now. Points as at the beginning. */
INCISE_API incise_status incise_engine_step(incise_engine* engine, const double* edge, uint64_t n_points,
                                            const double* direction, incise_report* report);
/* Lifts the blade off: what it cut stays, is finished and maintained. `report` is of the whole stroke. */
INCISE_API incise_status incise_engine_end_stroke(incise_engine* engine, incise_report* report);

/* Tells where the body stands: x y z for every vertex slot, free ones ignored. Between the steps of a stroke too. */
INCISE_API incise_status incise_engine_set_positions(incise_engine* engine, const double* positions, uint64_t n_slots);

/* Takes the last stroke, or `improve`, back, bit for bit. `done` (may be null): 0 where there was none. */
INCISE_API incise_status incise_engine_undo(incise_engine* engine, int32_t* done);
/* Applies what was last taken back. `done` as above. */
INCISE_API incise_status incise_engine_redo(incise_engine* engine, int32_t* done);
/* Keeps no more than the last `operations` (at least 1) for undo. */
INCISE_API incise_status incise_engine_keep_undo(incise_engine* engine, uint64_t operations);

/* Goes on with maintenance that a budget left undone, for `work_units` more, or until `should_stop` (may be null). */
INCISE_API incise_status incise_engine_maintain(incise_engine* engine, uint64_t work_units,
                                                incise_should_stop should_stop, void* user, incise_report* report);
/* Maintains the whole mesh, cut or not; an operation of its own for undo. */
INCISE_API incise_status incise_engine_improve(incise_engine* engine, incise_should_stop should_stop, void* user,
                                               incise_report* report);

/* ---- the journal --------------------------------------------------------------------------------------------- */

/* What changed, step by step, for solvers and renderers that follow the mesh: docs/journal.md tells what each record
 * means and in which order they apply. */
typedef struct incise_journal {
  uint32_t size;
  uint32_t pad;
  uint64_t first;         /* the lowest step that is kept */
  uint64_t position;      /* steps applied so far */
  uint64_t end;           /* one past the last that is kept, undone ones included */
  uint64_t newest_serial; /* the highest given so far */
  uint64_t memory_bytes;  /* of all steps that are kept */
} incise_journal;
/* Cost: O(1). */
INCISE_API incise_status incise_engine_journal(const incise_engine* engine, incise_journal* journal);

/* How many records a step has. They apply in the order of the members. */
typedef struct incise_step_counts {
  uint32_t size;
  uint32_t pad;
  uint64_t serial;        /* kept through undo and redo; no other step gets it */
  uint64_t born;          /* new vertices */
  uint64_t moved;         /* vertices that are other material points now */
  uint64_t copied;        /* twins */
  uint64_t consumed;      /* tets that are gone */
  uint64_t produced;      /* new tets */
  uint64_t rewired;       /* tets that live on with other vertices */
  uint64_t opened;        /* faces that are two boundary sides now */
  uint64_t closed;        /* walls that are joined again */
  uint64_t died;          /* vertices that are gone */
  uint64_t edits;         /* of maintenance: 0 where the lists above tell the whole order */
  uint64_t edit_consumed; /* tets of all edits */
  uint64_t edit_produced; /* tets of all edits */
  uint64_t new_vertices;  /* slots taken by the step */
  uint64_t new_tets;      /* likewise */
} incise_step_counts;
/* `step` in [first, end). */
INCISE_API incise_status incise_engine_step_counts(const incise_engine* engine, uint64_t step,
                                                   incise_step_counts* counts);

/* A vertex that is new. */
typedef struct incise_born {
  uint32_t id;         /* slot */
  uint32_t parents[4]; /* those not used are INCISE_NONE */
  uint32_t pad;
  double weights[4]; /* sum to 1 */
  double rest[3];    /* length unit */
  double current[3]; /* length unit */
} incise_born;
/* A vertex that is another material point now. */
typedef struct incise_moved {
  uint32_t id;       /* slot */
  uint32_t basis[4]; /* the tet that held the new place before the move */
  uint32_t pad;
  double weights[4];     /* in it; may be negative */
  double old_rest[3];    /* before, length unit */
  double rest[3];        /* after, length unit */
  double old_current[3]; /* before, length unit */
  double current[3];     /* after, length unit */
} incise_moved;
/* A vertex that is the twin of another one. */
typedef struct incise_copied {
  uint32_t id;     /* slot */
  uint32_t source; /* slot of the vertex that was copied */
} incise_copied;
/* A tet that is gone. */
typedef struct incise_consumed {
  uint32_t id;          /* slot */
  uint32_t vertices[4]; /* as they were */
} incise_consumed;
/* A tet that is new. */
typedef struct incise_produced {
  uint32_t id;          /* slot */
  uint32_t parent;      /* the consumed tet whose material it takes */
  uint32_t vertices[4]; /* positive in this order */
  int32_t region;       /* label, its parent's */
} incise_produced;
/* A tet that lives on with other vertices. */
typedef struct incise_rewired {
  uint32_t id;              /* slot */
  uint32_t old_vertices[4]; /* before */
  uint32_t vertices[4];     /* after */
} incise_rewired;
/* A face that is two boundary sides now, or, in the list of closed ones, a wall that is joined again. */
typedef struct incise_opened {
  uint32_t a;   /* a side: tet * 4 + side */
  uint32_t b;   /* the other tet's side */
  uint32_t tag; /* the stroke */
} incise_opened;
#define INCISE_EDIT_MOVE 0   /* a vertex moved */
#define INCISE_EDIT_REMESH 1 /* the tets of a cavity gave way to others */
/* One change of a step of maintenance. */
typedef struct incise_edit {
  uint32_t kind;         /* INCISE_EDIT_... */
  uint32_t vertex;       /* move: index into moved; remesh: into born where one was put in, else INCISE_NONE */
  uint32_t consumed_end; /* one past its last tet in the list of consumed tets of edits */
  uint32_t produced_end; /* likewise */
} incise_edit;

/* The records of a step in [first, end), in order; the next calls likewise. */
INCISE_API incise_status incise_engine_step_born(const incise_engine* engine, uint64_t step, incise_born* records,
                                                 uint64_t room, uint64_t* count);
/* Vertices that moved. */
INCISE_API incise_status incise_engine_step_moved(const incise_engine* engine, uint64_t step, incise_moved* records,
                                                  uint64_t room, uint64_t* count);
/* Twins. */
INCISE_API incise_status incise_engine_step_copied(const incise_engine* engine, uint64_t step, incise_copied* records,
                                                   uint64_t room, uint64_t* count);
/* Tets that are gone. */
INCISE_API incise_status incise_engine_step_consumed(const incise_engine* engine, uint64_t step,
                                                     incise_consumed* records, uint64_t room, uint64_t* count);
/* New tets. */
INCISE_API incise_status incise_engine_step_produced(const incise_engine* engine, uint64_t step,
                                                     incise_produced* records, uint64_t room, uint64_t* count);
/* Tets that live on with other vertices. */
INCISE_API incise_status incise_engine_step_rewired(const incise_engine* engine, uint64_t step, incise_rewired* records,
                                                    uint64_t room, uint64_t* count);
/* Faces that were opened. */
INCISE_API incise_status incise_engine_step_opened(const incise_engine* engine, uint64_t step, incise_opened* records,
                                                   uint64_t room, uint64_t* count);
/* Walls that were joined again. */
INCISE_API incise_status incise_engine_step_closed(const incise_engine* engine, uint64_t step, incise_opened* records,
                                                   uint64_t room, uint64_t* count);
/* Slots of vertices. */
INCISE_API incise_status incise_engine_step_died(const incise_engine* engine, uint64_t step, uint32_t* records,
                                                 uint64_t room, uint64_t* count);
/* Edits of a step of maintenance. */
INCISE_API incise_status incise_engine_step_edits(const incise_engine* engine, uint64_t step, incise_edit* records,
                                                  uint64_t room, uint64_t* count);
/* Tets that its edits consumed. */
INCISE_API incise_status incise_engine_step_edit_consumed(const incise_engine* engine, uint64_t step,
                                                          incise_consumed* records, uint64_t room, uint64_t* count);
/* Tets that its edits produced. */
INCISE_API incise_status incise_engine_step_edit_produced(const incise_engine* engine, uint64_t step,
                                                          incise_produced* records, uint64_t room, uint64_t* count);
/* Slots of vertices that the step took. */
INCISE_API incise_status incise_engine_step_new_vertices(const incise_engine* engine, uint64_t step, uint32_t* records,
                                                         uint64_t room, uint64_t* count);
/* Slots of tets that the step took. */
INCISE_API incise_status incise_engine_step_new_tets(const incise_engine* engine, uint64_t step, uint32_t* records,
                                                     uint64_t room, uint64_t* count);

/* Where a follower stands in a journal. */
typedef struct incise_cursor incise_cursor;
#define INCISE_WAY_NONE 0      /* the journal stands where the follower stands */
#define INCISE_WAY_FORWARD 1   /* steps from `position` on are new: apply them */
#define INCISE_WAY_ELSEWHERE 2 /* steps were undone, redone or forgotten: begin anew from the mesh */
/* At where the engine's journal stands now. It is for that engine alone: another one is a bad argument. */
INCISE_API incise_status incise_cursor_create(const incise_engine* engine, incise_cursor** cursor);
/* How it gets to where the journal stands; `position` (may be null): the steps that the follower has applied. */
INCISE_API incise_status incise_cursor_way(const incise_cursor* cursor, const incise_engine* engine, int32_t* way,
                                           uint64_t* position);
/* The follower has caught up. */
INCISE_API incise_status incise_cursor_move(incise_cursor* cursor, const incise_engine* engine);
/* Null is fine. */
INCISE_API incise_status incise_cursor_free(incise_cursor* cursor);

/* ---- attributes ---------------------------------------------------------------------------------------------- */

/* Values on vertices or tets that follow an engine's mesh through its journal. */
typedef struct incise_attributes incise_attributes;

#define INCISE_AT_VERTICES 0 /* one value per vertex */
#define INCISE_AT_TETS 1     /* one value per tet */
#define INCISE_INTERPOLATE 0 /* a field: velocity, temperature */
#define INCISE_INHERIT 1     /* a label */
#define INCISE_CONSERVE 2    /* an amount: its sum is kept */
#define INCISE_RECOMPUTE 3   /* a function of the mesh */

/* Computes the value of one element. It may read the engine (views, counts) and nothing else of it. */
typedef void (*incise_recompute)(void* user, uint32_t slot, double* value, uint32_t width);

/* What an attribute is. */
typedef struct incise_attribute_spec {
  uint32_t size;
  int32_t domain;             /* INCISE_AT_... */
  const char* name;           /* unique, not empty */
  uint32_t width;             /* numbers per element, 1 to 64 */
  int32_t transfer;           /* INCISE_INTERPOLATE ... INCISE_RECOMPUTE */
  const double* initial;      /* `width` numbers that every element starts with; null: zeros */
  incise_recompute recompute; /* for INCISE_RECOMPUTE, and only there */
  void* user;                 /* handed to `recompute` */
} incise_attribute_spec;

/* For an engine as it stands. The engine that later calls are given is this one. */
INCISE_API incise_status incise_attributes_create(const incise_engine* engine, incise_attributes** attributes);
/* Adds one; `id` gets its number. The engine stands where `incise_attributes_follow` has seen it last. */
INCISE_API incise_status incise_attributes_add(incise_attributes* attributes, const incise_engine* engine,
                                               const incise_attribute_spec* spec, uint32_t* id);
/* INCISE_NONE where none has the name. */
INCISE_API incise_status incise_attributes_find(const incise_attributes* attributes, const char* name, uint32_t* id);
/* Catches up with the journal, forwards or backwards. Errors: bad argument where the journal went back behind where the
 * attributes began, or has forgotten steps that they have not seen: they have to be made anew. */
INCISE_API incise_status incise_attributes_follow(incise_attributes* attributes, const incise_engine* engine);
/* The values by slot * width, to read and to write: `n_values` numbers, until the next `follow` or `add`. */
INCISE_API incise_status incise_attributes_values(incise_attributes* attributes, uint32_t id, double** values,
                                                  uint64_t* n_values);
/* Null is fine. */
INCISE_API incise_status incise_attributes_free(incise_attributes* attributes);

/* ---- simulation ---------------------------------------------------------------------------------------------- */

/* An elastic body that is cut while it deforms, frame by frame. */
typedef struct incise_simulation incise_simulation;

#define INCISE_BLOCK_DESCENT 0  /* each vertex goes to its least energy */
#define INCISE_POSITION_BASED 1 /* sequential XPBD: bounded, but too soft */

/* How a body is computed. */
typedef struct incise_body_options {
  uint32_t size;
  int32_t relaxation;  /* INCISE_BLOCK_DESCENT or INCISE_POSITION_BASED */
  double length_unit;  /* metres per length unit of the mesh, above 0 */
  double gravity[3];   /* m/s^2 */
  double damping;      /* share of the velocity lost per second */
  uint32_t substeps;   /* in [1, 1000] */
  uint32_t iterations; /* in [1, 1000] */
  double thinnest;     /* thinner tets are as soft as if they were not */
  double sleep_below;  /* of the local edge per frame: what moves less falls asleep; 0: never */
  uint32_t threads;    /* in [1, 256]; the result does not depend on it */
  int32_t coarse;      /* substeps begin on a coarse lattice */
  double crumb;        /* length unit^3: smaller tets only resist stretch; 0: chosen */
} incise_body_options;
/* Writes the first `size` bytes of the default options. */
INCISE_API incise_status incise_default_body_options(incise_body_options* options, uint32_t size);

/* What the tissue of a region is made of. */
typedef struct incise_material {
  int32_t region;      /* label of the tets */
  int32_t is_fallback; /* other than 0: of every region that no other one names; `region` is not read */
  double density;      /* kg/m^3 */
  double young;        /* Pa */
  double poisson;      /* [0, 0.499] */
  double toughness;    /* J/m^2 of cut face; 0: a blade meets no resistance */
  double cut_friction; /* N per m of engaged edge */
  double stiffening;   /* how fast it stiffens as it is strained, [0, 100] */
  double rupture;      /* share by which a front at rest bears more, and a running one less, [0, 0.5] */
  double fibre[3];     /* direction of fibres at rest, of any length */
  double fibre_young;  /* Pa, what they add to Young's modulus along them, in tension alone; 0: no fibres */
  double prony[6];     /* up to three pairs: a share of the shear modulus, and the seconds in which it relaxes */
  int32_t rigid;       /* other than 0: bone, it moves and does not deform */
  int32_t pad;
} incise_material;

/* How a simulation works. */
typedef struct incise_simulation_options {
  uint32_t size;
  uint32_t n_materials;                /* of `materials` */
  const incise_engine_options* engine; /* null: the default, with a frame's budget of maintenance */
  const incise_body_options* body;     /* null: the default */
  const incise_material* materials;    /* null: soft tissue everywhere */
  double frame_seconds;                /* in (0, 1] */
  double contact_stiffness;            /* N/m per touched vertex; 0: ten times the tissue's own */
  double flat_height;                  /* of the blade behind its edge; 0: the flat touches nothing */
} incise_simulation_options;
/* Writes the first `size` bytes of the default options. */
INCISE_API incise_status incise_default_simulation_options(incise_simulation_options* options, uint32_t size);

/* A body at rest, held by nothing yet; see `incise_simulation_hold`. */
INCISE_API incise_status incise_simulation_create(const incise_mesh_arrays* mesh,
                                                  const incise_simulation_options* options,
                                                  incise_simulation** simulation);
/* The same, of a mesh file. */
INCISE_API incise_status incise_simulation_read(const char* path, const incise_simulation_options* options,
                                                incise_simulation** simulation);
/* A scene (docs/scenes.md) from its file, with what holds the body; it has not settled yet. */
INCISE_API incise_status incise_simulation_read_scene(const char* path, uint32_t threads,
                                                      incise_simulation** simulation);
/* The same for JSON in memory; files that it names are seen from `folder`, null: from here. */
INCISE_API incise_status incise_simulation_parse_scene(const char* json, const char* folder, uint32_t threads,
                                                       incise_simulation** simulation);
/* Null is fine. The engine of the simulation goes with it. */
INCISE_API incise_status incise_simulation_free(incise_simulation* simulation);

/* The engine, to read: mesh, surface, journal, quality, files. It lives as long as the simulation and shares its
 * thread. */
INCISE_API const incise_engine* incise_simulation_engine(const incise_simulation* simulation);

/* A grip on the tissue: takes hold where it first appears, lets go where it appears no more. */
typedef struct incise_hook {
  uint32_t id; /* the same from frame to frame */
  uint32_t pad;
  double position[3]; /* length unit */
  double radius;      /* above 0 */
  double stiffness;   /* N/m per vertex, above 0 */
  double strength;    /* N in all: the greatest force; 0: it bears all */
  int32_t tears;      /* other than 0: beyond its strength it lets go; else it slips */
  uint32_t pad2;      /* means nothing */
} incise_hook;

#define INCISE_TOOL_BALL 0  /* a: centre, radius */
#define INCISE_TOOL_ROD 1   /* a, b: ends, radius */
#define INCISE_TOOL_PLANE 2 /* a: unit normal; the body stays where a . x >= offset */
#define INCISE_TOOL_FLAT 3  /* edge; a: from the edge to the back of the blade; radius: thickness */
/* Something that presses on the body; lengths in the unit of the mesh. */
typedef struct incise_tool {
  int32_t kind; /* INCISE_TOOL_... */
  uint32_t pad;
  double a[3];        /* by kind */
  double b[3];        /* by kind */
  double radius;      /* by kind */
  double offset;      /* of a plane */
  const double* edge; /* 3 n_edge */
  uint64_t n_edge;    /* points of the flat's edge, at least 2 */
} incise_tool;

/* Everything that the hands hold, where it is at the end of the frame. */
typedef struct incise_frame_input {
  uint32_t size;
  uint32_t pad;
  const double* blade;      /* 3 n_blade points of the edge; null: no blade */
  uint64_t n_blade;         /* at least 2, and the same through a stroke */
  const double* direction;  /* 3: where the edge cuts; null: where it moves */
  const incise_hook* hooks; /* grips in this frame */
  uint64_t n_hooks;         /* their number */
  const incise_tool* tools; /* what presses in this frame */
  uint64_t n_tools;         /* their number */
  double slicing;           /* of the blade: how fast its edge moves along itself, by how fast it is pushed; 0 to 100 */
} incise_frame_input;

/* What a frame did. */
typedef struct incise_frame_report {
  uint32_t size;
  uint32_t stroke;          /* under way, of this simulation's from 1; 0: none */
  int32_t blade_touches;    /* some of the edge is in the tissue, or presses on it */
  int32_t blade_yields;     /* somewhere the tissue gave way */
  double blade_force[3];    /* of the tissue on the edge, N */
  double engaged_length;    /* of the edge, m */
  double fracture_work;     /* J, in this frame, as the next two */
  double friction_work;     /* rubbed off while cutting */
  double tool_work;         /* that the hand did with the edge */
  uint64_t contacts;        /* vertices that tools touch */
  uint64_t active_vertices; /* that were awake */
  double fastest;           /* m/s */
  uint64_t n_hook_forces;   /* see incise_simulation_hook_forces */
} incise_frame_report;

/* One frame; `input` null: nothing is held. `report` may be null. Errors: bad argument for malformed input, and nothing
 * changes. */
INCISE_API incise_status incise_simulation_frame(incise_simulation* simulation, const incise_frame_input* input,
                                                 incise_frame_report* report);
/* One frame of the scene's own script, number `incise_simulation_frames`. Errors: bad argument without a scene. */
INCISE_API incise_status incise_simulation_play(incise_simulation* simulation, incise_frame_report* report);
/* What the last frame cut and maintained. */
INCISE_API incise_status incise_simulation_cut_report(const incise_simulation* simulation, incise_report* report);
/* Forces of the tissue on the hooks of the last frame, N: x y z each. */
INCISE_API incise_status incise_simulation_hook_forces(const incise_simulation* simulation, double* forces,
                                                       uint64_t room, uint64_t* count);
/* Lets the body come to rest until nothing moves faster than `speed` m/s, at least 0, at most `max_frames`; `frames`
 * (may be null) gets how many it took. */
INCISE_API incise_status incise_simulation_settle(incise_simulation* simulation, uint32_t max_frames, double speed,
                                                  uint32_t* frames);
/* As the scene says. Errors: bad argument without a scene. */
INCISE_API incise_status incise_simulation_settle_scene(incise_simulation* simulation, uint32_t* frames);
/* The same two, until `should_stop` (may be null), which is asked before each frame, returns other than 0: the body is
 * then as that many frames have left it. Several calls in place of one may make a frame more. */
INCISE_API incise_status incise_simulation_settle_until(incise_simulation* simulation, uint32_t max_frames,
                                                        double speed, incise_should_stop should_stop, void* user,
                                                        uint32_t* frames);
/* As the scene says. */
INCISE_API incise_status incise_simulation_settle_scene_until(incise_simulation* simulation,
                                                              incise_should_stop should_stop, void* user,
                                                              uint32_t* frames);

/* A body as it stands. */
typedef struct incise_simulation_state {
  uint32_t size;
  uint32_t pad;
  uint64_t frames;          /* done */
  uint64_t scene_frames;    /* that the scene's script has; 0 without a scene */
  double frame_seconds;     /* s */
  double length_unit;       /* metres */
  double mass;              /* kg, as what follows in SI units */
  double momentum[3];       /* kg m/s */
  double elastic;           /* energies, J */
  double kinetic;           /* of motion */
  double potential;         /* of gravity */
  double held;              /* in the springs that hold vertices */
  double pulled;            /* in the pulls */
  double force_on_holds[3]; /* N */
  uint64_t inverted_tets;   /* as the body stands */
  uint64_t hash;            /* of mesh and body */
} incise_simulation_state;
/* Cost: O(tets). */
INCISE_API incise_status incise_simulation_look(const incise_simulation* simulation, incise_simulation_state* state);

/* As of engines. The tissue stays where it stands. */
INCISE_API incise_status incise_simulation_undo(incise_simulation* simulation, int32_t* done);
/* Applies the stroke that was last taken back. */
INCISE_API incise_status incise_simulation_redo(incise_simulation* simulation, int32_t* done);

/* Holds a vertex where it stands: rigidly (infinite stiffness), or by a spring of N/m; 0 lets it go. */
INCISE_API incise_status incise_simulation_hold(incise_simulation* simulation, uint32_t vertex, double stiffness);
/* Holds a vertex by a spring of N/m that bears no more than `strength`, N, above 0: beyond it the vertex slips, or
 * tears loose where `tears` is other than 0. */
INCISE_API incise_status incise_simulation_pin(incise_simulation* simulation, uint32_t vertex, double stiffness,
                                               double strength, int32_t tears);
/* Where a held vertex is to be: x y z. */
INCISE_API incise_status incise_simulation_move_hold(incise_simulation* simulation, uint32_t vertex,
                                                     const double* target);
/* Whether a vertex is held: `is_held` gets 1 or 0. */
INCISE_API incise_status incise_simulation_is_held(const incise_simulation* simulation, uint32_t vertex,
                                                   int32_t* is_held);
/* Velocities of all vertex slots, m/s: x y z each. */
INCISE_API incise_status incise_simulation_velocities(const incise_simulation* simulation, double* velocities,
                                                      uint64_t room, uint64_t* count);
/* Gives a vertex a velocity, m/s, and wakes it. */
INCISE_API incise_status incise_simulation_set_velocity(incise_simulation* simulation, uint32_t vertex,
                                                        const double* velocity);

/* ---- force feedback ------------------------------------------------------------------------------------------ */

/* What a 1 kHz loop knows of the tissue at the blade until the next frame; docs/haptics.md. SI units. Plain data: copy
 * it to the other thread as you like. */
typedef struct incise_haptic_snapshot {
  uint32_t size;
  int32_t touches;  /* other than 0: some of the edge is in the tissue */
  uint64_t serial;  /* 0: nothing known yet */
  int32_t ruptured; /* other than 0: the tissue yields at the edge */
  int32_t pad;
  double tool_position[3];     /* m */
  double force[3];             /* N, of the tissue on the tool */
  double compliance[9];        /* m/N, symmetric */
  double contact_point[3];     /* m */
  double cutting_direction[3]; /* unit */
  double flat_normal[3];       /* unit */
  double engaged_length;       /* m */
  double toughness;            /* J/m^2 */
  double cut_friction;         /* N/m */
} incise_haptic_snapshot;
/* What the 1 kHz loop goes by until the next frame. Cost: O(1). */
INCISE_API incise_status incise_simulation_haptic_snapshot(const incise_simulation* simulation,
                                                           incise_haptic_snapshot* snapshot);

/* The blade in the hand at 1 kHz: coupling, rupture, passivity. Its own thread's; no call allocates but the first. */
typedef struct incise_haptic_tool incise_haptic_tool;
/* How a blade in the hand feels; see HapticToolOptions in C++. Numbers above 0 lie in [1e-15, 1e15], others in
 * [0, 1e15]. */
typedef struct incise_haptic_options {
  uint32_t size;
  uint32_t pad;
  double coupling_stiffness; /* N/m, above 0 */
  double coupling_damping;   /* N s/m */
  double drag;               /* N s/m */
  double max_stretch;        /* m, above 0 */
  double max_force;          /* N, above 0 */
  double physics_period;     /* s */
  double link_delay;         /* s, one way between hand and tissue; 0 to 0.05; docs/haptics.md */
} incise_haptic_options;
/* Writes the first `size` bytes of the default options. */
INCISE_API incise_status incise_default_haptic_options(incise_haptic_options* options, uint32_t size);
/* `options` null: the default. */
INCISE_API incise_status incise_haptic_tool_create(const incise_haptic_options* options, incise_haptic_tool** tool);
/* Takes a newer snapshot over. Errors: bad argument for one that is not sound, or not newer; it is passed over. */
INCISE_API incise_status incise_haptic_tool_accept(incise_haptic_tool* tool, const incise_haptic_snapshot* snapshot);
/* One tick of `dt` s, 1e-9 to 1: the device's position (m) and velocity (m/s) give the force on it (N) and, where
 * `tool_position` is not null, where the physics moves its blade to (m); 3 numbers each. Errors: bad argument for a
 * `dt` outside of its range, and for what is not finite or beyond 1e15; `force` is then zero, and the next tick starts
 * anew. */
INCISE_API incise_status incise_haptic_tool_tick(incise_haptic_tool* tool, double dt, const double* position,
                                                 const double* velocity, double* force, double* tool_position);
/* Null is fine. */
INCISE_API incise_status incise_haptic_tool_free(incise_haptic_tool* tool);

/* ---- batches ------------------------------------------------------------------------------------------------- */

/* A plan of many cuts, by workers that share a folder; see docs/batches.md. It does not change: any thread may use it,
 * and several at once. */
typedef struct incise_plan incise_plan;

/* Reads a plan, JSON of format incise-plan. Errors: bad file "FILE:LINE: PATH what; remedy". */
INCISE_API incise_status incise_plan_read(const char* path, incise_plan** plan);
/* The same from memory. Files that it names are seen from `folder`; null: from the folder that the program runs in. */
INCISE_API incise_status incise_plan_parse(const char* json, const char* folder, incise_plan** plan);
/* Null is fine. A batch that runs keeps what it needs. */
INCISE_API incise_status incise_plan_free(incise_plan* plan);
/* How many items it has. */
INCISE_API incise_status incise_plan_count(const incise_plan* plan, uint64_t* count);
/* The name of an item, from 0: copies at most `room` bytes with a closing 0, tells in `count` how many the whole takes.
 */
INCISE_API incise_status incise_plan_name(const incise_plan* plan, uint64_t item, char* text, uint64_t room,
                                          uint64_t* count);

/* Called before each item and after the last: items done, items in all. */
typedef void (*incise_progress)(void* user, uint64_t done, uint64_t total);
/* Gets a text that lasts as long as the call. */
typedef void (*incise_told)(void* user, const char* text);

/* What a worker does. */
typedef struct incise_batch_options {
  uint32_t size;
  uint32_t shard_index; /* which part of the items, from 0 */
  uint32_t shard_count; /* of how many, in [1, 99999] */
  uint32_t threads;     /* in [1, 256]; the result does not depend on it */
  int32_t retry;        /* items that have failed are tried again, lines that are no results taken off */
  uint32_t pad;
  uint64_t verify_items;          /* of incise_batch_verify: how many */
  uint64_t verify_seed;           /* which */
  incise_progress progress;       /* null: nobody asks */
  incise_should_stop should_stop; /* asked before each item and each frame of a scene; null: to the end */
  void* user;                     /* handed to these two */
  incise_log log;                 /* null: nobody listens */
  void* log_user;                 /* handed to `log` */
} incise_batch_options;
/* Writes the first `size` bytes of the default options. */
INCISE_API incise_status incise_default_batch_options(incise_batch_options* options, uint32_t size);

/* Computes the items of a shard that no worker has done yet into `folder`, which is made where it is not there. `tell`
 * (may be null) gets a report: JSON of format incise-batch, with "items", "skipped", "done", "failed" and "stopped".
 * Items that cannot be computed are no error of the call. Errors: io; bad argument where another worker is at the same
 * shard; bad file where the folder has results of another plan, of another version of the program or of other meshes,
 * or a line that is no result: the message names file, line and remedy. */
INCISE_API incise_status incise_batch_run(const incise_plan* plan, const char* folder,
                                          const incise_batch_options* options, incise_told tell, void* user);
/* Puts the lines of all shards into results.jsonl, in the order of the plan, where all is whole; the report's "ok" says
 * whether it was, and "missing", "contradictory" and "broken_files" what was not. Errors: as above. */
INCISE_API incise_status incise_batch_merge(const incise_plan* plan, const char* folder, incise_told tell, void* user);
/* Computes `verify_items` items again, and compares their lines: the report's "ok", "differences" and "stopped". */
INCISE_API incise_status incise_batch_verify(const incise_plan* plan, const char* folder,
                                             const incise_batch_options* options, incise_told tell, void* user);

#ifdef __cplusplus
} /* extern "C" */
#endif
/* NOLINTEND(readability-identifier-naming) */

#endif
