// SPDX-License-Identifier: Apache-2.0
// Written by bindings/generate.py from include/incise/c/incise.h: change that, and run it again.
// For .NET and Unity (allow unsafe code). It has been generated and read, and never been run: untested.
// Strings that come back are UTF-8 that the library owns: Marshal.PtrToStringUTF8.
using System;
using System.Runtime.InteropServices;

namespace Incise
{
    public static unsafe class Native
    {
        private const string Library = "incise";

        public const int INCISE_ABI = 0;
        public const uint INCISE_NONE = 4294967295;
        public const ulong INCISE_UNLIMITED = 18446744073709551615;
        public const int INCISE_OK = 0;
        public const int INCISE_BAD_ARGUMENT = 1;
        public const int INCISE_BAD_FILE = 2;
        public const int INCISE_UNSUPPORTED = 3;
        public const int INCISE_OUT_OF_MEMORY = 4;
        public const int INCISE_IO = 5;
        public const int INCISE_INTERNAL = 6;
        public const int INCISE_BUSY = 7;
        public const int INCISE_LOG_DEBUG = 0;
        public const int INCISE_LOG_INFO = 1;
        public const int INCISE_LOG_WARNING = 2;
        public const int INCISE_PROFILE_PAPER = 0;
        public const int INCISE_PROFILE_INCISE = 1;
        public const int INCISE_AT_REST = 0;
        public const int INCISE_AS_IT_STANDS = 1;
        public const int INCISE_TETS = 0;
        public const int INCISE_REST = 1;
        public const int INCISE_CURRENT = 2;
        public const int INCISE_LINKS = 3;
        public const int INCISE_REGIONS = 4;
        public const int INCISE_TET_GENERATIONS = 5;
        public const int INCISE_VERTEX_GENERATIONS = 6;
        public const int INCISE_SHAPES = 7;
        public const int INCISE_ORIGINS = 8;
        public const int INCISE_SHAPE_SKIN = 1;
        public const int INCISE_SHAPE_WALL = 2;
        public const int INCISE_SHAPE_FRONT = 4;
        public const int INCISE_SHAPE_PINCHED = 8;
        public const int INCISE_SHAPE_DEAD = 128;
        public const int INCISE_VALIDATE_COUNTS = 0;
        public const int INCISE_VALIDATE_TOPOLOGY = 1;
        public const int INCISE_VALIDATE_GEOMETRY = 2;
        public const int INCISE_VIOLATION_KINDS = 16;
        public const int INCISE_EDIT_MOVE = 0;
        public const int INCISE_EDIT_REMESH = 1;
        public const int INCISE_WAY_NONE = 0;
        public const int INCISE_WAY_FORWARD = 1;
        public const int INCISE_WAY_ELSEWHERE = 2;
        public const int INCISE_AT_VERTICES = 0;
        public const int INCISE_AT_TETS = 1;
        public const int INCISE_INTERPOLATE = 0;
        public const int INCISE_INHERIT = 1;
        public const int INCISE_CONSERVE = 2;
        public const int INCISE_RECOMPUTE = 3;
        public const int INCISE_BLOCK_DESCENT = 0;
        public const int INCISE_POSITION_BASED = 1;
        public const int INCISE_TOOL_BALL = 0;
        public const int INCISE_TOOL_ROD = 1;
        public const int INCISE_TOOL_PLANE = 2;
        public const int INCISE_TOOL_FLAT = 3;

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        public delegate void incise_log(IntPtr user, int level, IntPtr message);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        public delegate int incise_should_stop(IntPtr user);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        public delegate void incise_recompute(IntPtr user, uint slot, double* value, uint width);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        public delegate void incise_progress(IntPtr user, ulong done, ulong total);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        public delegate void incise_told(IntPtr user, IntPtr text);

        /// <summary>How an engine works; see EngineOptions in C++.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_engine_options
        {
            public uint size;
            public int profile;
            public double snap;
            public int merge;
            public int improve;
            public ulong work_units;
            public uint threads;
            public int smooth_boundary;
            public int check_steps;
            public uint pad;
            public IntPtr log;
            public IntPtr log_user;
        }

        /// <summary>A mesh as arrays. The first three pairs are enough; the last three are there where the mesh was cut before.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_mesh_arrays
        {
            public uint size;
            public int mend;
            public double* points;
            public ulong n_points;
            public uint* tets;
            public ulong n_tets;
            public int* regions;
            public uint* walls;
            public ulong n_walls;
            public int* origins;
            public byte* fronts;
        }

        /// <summary>How much there is.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_counts
        {
            public uint size;
            public uint strokes;
            public ulong vertices;
            public ulong tets;
            public ulong vertex_slots;
            public ulong tet_slots;
            public ulong memory_bytes;
            public ulong version;
            public uint next_stroke;
            public int is_in_stroke;
            public int has_maintenance;
            public int pad;
        }

        /// <summary>The engine's own memory: look, and do not write.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_view
        {
            public uint size;
            public uint stride;
            public IntPtr data;
            public ulong rows;
            public ulong version;
            public int is_stable;
            public int pad;
        }

        /// <summary>The live mesh without free slots, in the order of slots. Any may be null; the others have room for all.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_compact
        {
            public uint size;
            public int pose;
            public double* points;
            public uint* tets;
            public int* regions;
            public uint* pieces;
            public uint* vertex_slots;
            public uint* tet_slots;
            public ulong vertices;
            public ulong tet_count;
            public ulong vertex_room;
            public ulong tet_room;
        }

        /// <summary>The quality of a set of tets at rest; all 0 where it is empty.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_quality
        {
            public uint size;
            public uint pad;
            public ulong tets;
            public ulong flat_tets;
            public double lr_min;
            public double lr_mean;
            public double lr_p99;
            public double lr_max;
            public double lr_over_200_pct;
            public double dihedral_min_deg;
            public double dihedral_max_deg;
        }

        /// <summary>One place where the contract is broken.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_violation
        {
            public fixed ulong ids[2];
            public int kind;
            public int pad;
        }

        /// <summary>What looking at the mesh found.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_validity
        {
            public uint size;
            public int ok;
            public fixed ulong counts[16];
            public double volume;
        }

        /// <summary>What a call did. Counts are sums over its steps. A step may take back what those before it made where the blade was: of a step or frame the growth can be below zero, and the sum over its stroke is what is there at the end.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_report
        {
            public uint size;
            public uint stroke;
            public ulong steps;
            public ulong cut_tets;
            public long created_tets;
            public long new_vertices;
            public ulong copied_vertices;
            public long incision_faces;
            public ulong snapped_vertices;
            public ulong bent_vertices;
            public ulong crumbs_kept;
            public ulong pinched_edges;
            public ulong latent_faces;
            public ulong blocked_edges;
            public ulong sheets;
            public ulong work_units;
            public ulong collapsed_edges;
            public ulong moved_vertices;
            public ulong removed_edges;
            public ulong removed_faces;
            public ulong inserted_vertices;
            public ulong peeled_tets;
            public ulong waiting_tets;
            public long maintenance_tets;
            public double collision_ms;
            public double subdivide_ms;
            public double separate_ms;
            public double merge_ms;
            public double improve_ms;
            public double relax_ms;
            public ulong journal_first;
            public ulong journal_end;
        }

        /// <summary>A blade's motion through the rest shape: its edge as a polyline at increasing times. Each pair of times is a step.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_stroke
        {
            public uint size;
            public uint pad;
            public double* times;
            public ulong n_times;
            public double* points;
            public ulong n_points;
            public IntPtr name;
        }

        /// <summary>What changed, step by step, for solvers and renderers that follow the mesh: docs/journal.md tells what each record means and in which order they apply.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_journal
        {
            public uint size;
            public uint pad;
            public ulong first;
            public ulong position;
            public ulong end;
            public ulong newest_serial;
            public ulong memory_bytes;
        }

        /// <summary>How many records a step has. They apply in the order of the members.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_step_counts
        {
            public uint size;
            public uint pad;
            public ulong serial;
            public ulong born;
            public ulong moved;
            public ulong copied;
            public ulong consumed;
            public ulong produced;
            public ulong rewired;
            public ulong opened;
            public ulong closed;
            public ulong died;
            public ulong edits;
            public ulong edit_consumed;
            public ulong edit_produced;
            public ulong new_vertices;
            public ulong new_tets;
        }

        /// <summary>A vertex that is new.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_born
        {
            public uint id;
            public fixed uint parents[4];
            public uint pad;
            public fixed double weights[4];
            public fixed double rest[3];
            public fixed double current[3];
        }

        /// <summary>A vertex that is another material point now.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_moved
        {
            public uint id;
            public fixed uint basis[4];
            public uint pad;
            public fixed double weights[4];
            public fixed double old_rest[3];
            public fixed double rest[3];
            public fixed double old_current[3];
            public fixed double current[3];
        }

        /// <summary>A vertex that is the twin of another one.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_copied
        {
            public uint id;
            public uint source;
        }

        /// <summary>A tet that is gone.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_consumed
        {
            public uint id;
            public fixed uint vertices[4];
        }

        /// <summary>A tet that is new.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_produced
        {
            public uint id;
            public uint parent;
            public fixed uint vertices[4];
            public int region;
        }

        /// <summary>A tet that lives on with other vertices.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_rewired
        {
            public uint id;
            public fixed uint old_vertices[4];
            public fixed uint vertices[4];
        }

        /// <summary>A face that is two boundary sides now, or, in the list of closed ones, a wall that is joined again.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_opened
        {
            public uint a;
            public uint b;
            public uint tag;
        }

        /// <summary>One change of a step of maintenance.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_edit
        {
            public uint kind;
            public uint vertex;
            public uint consumed_end;
            public uint produced_end;
        }

        /// <summary>What an attribute is.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_attribute_spec
        {
            public uint size;
            public int domain;
            public IntPtr name;
            public uint width;
            public int transfer;
            public double* initial;
            public IntPtr recompute;
            public IntPtr user;
        }

        /// <summary>How a body is computed.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_body_options
        {
            public uint size;
            public int relaxation;
            public double length_unit;
            public fixed double gravity[3];
            public double damping;
            public uint substeps;
            public uint iterations;
            public double thinnest;
            public double sleep_below;
            public uint threads;
            public int coarse;
            public double crumb;
        }

        /// <summary>What the tissue of a region is made of.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_material
        {
            public int region;
            public int is_fallback;
            public double density;
            public double young;
            public double poisson;
            public double toughness;
            public double cut_friction;
            public double stiffening;
            public double rupture;
            public fixed double fibre[3];
            public double fibre_young;
            public fixed double prony[6];
            public int rigid;
            public int pad;
        }

        /// <summary>How a simulation works.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_simulation_options
        {
            public uint size;
            public uint n_materials;
            public incise_engine_options* engine;
            public incise_body_options* body;
            public incise_material* materials;
            public double frame_seconds;
            public double contact_stiffness;
            public double flat_height;
        }

        /// <summary>A grip on the tissue: takes hold where it first appears, lets go where it appears no more.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_hook
        {
            public uint id;
            public uint pad;
            public fixed double position[3];
            public double radius;
            public double stiffness;
            public double strength;
            public int tears;
            public uint pad2;
        }

        /// <summary>Something that presses on the body; lengths in the unit of the mesh.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_tool
        {
            public int kind;
            public uint pad;
            public fixed double a[3];
            public fixed double b[3];
            public double radius;
            public double offset;
            public double* edge;
            public ulong n_edge;
        }

        /// <summary>Everything that the hands hold, where it is at the end of the frame.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_frame_input
        {
            public uint size;
            public uint pad;
            public double* blade;
            public ulong n_blade;
            public double* direction;
            public incise_hook* hooks;
            public ulong n_hooks;
            public incise_tool* tools;
            public ulong n_tools;
            public double slicing;
        }

        /// <summary>What a frame did.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_frame_report
        {
            public uint size;
            public uint stroke;
            public int blade_touches;
            public int blade_yields;
            public fixed double blade_force[3];
            public double engaged_length;
            public double fracture_work;
            public double friction_work;
            public double tool_work;
            public ulong contacts;
            public ulong active_vertices;
            public double fastest;
            public ulong n_hook_forces;
        }

        /// <summary>A body as it stands.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_simulation_state
        {
            public uint size;
            public uint pad;
            public ulong frames;
            public ulong scene_frames;
            public double frame_seconds;
            public double length_unit;
            public double mass;
            public fixed double momentum[3];
            public double elastic;
            public double kinetic;
            public double potential;
            public double held;
            public double pulled;
            public fixed double force_on_holds[3];
            public ulong inverted_tets;
            public ulong hash;
        }

        /// <summary>What a 1 kHz loop knows of the tissue at the blade until the next frame; docs/haptics.md. SI units. Plain data: copy it to the other thread as you like.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_haptic_snapshot
        {
            public uint size;
            public int touches;
            public ulong serial;
            public int ruptured;
            public int pad;
            public fixed double tool_position[3];
            public fixed double force[3];
            public fixed double compliance[9];
            public fixed double contact_point[3];
            public fixed double cutting_direction[3];
            public fixed double flat_normal[3];
            public double engaged_length;
            public double toughness;
            public double cut_friction;
        }

        /// <summary>How a blade in the hand feels; see HapticToolOptions in C++. Numbers above 0 lie in [1e-15, 1e15], others in [0, 1e15].</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_haptic_options
        {
            public uint size;
            public uint pad;
            public double coupling_stiffness;
            public double coupling_damping;
            public double drag;
            public double max_stretch;
            public double max_force;
            public double physics_period;
            public double link_delay;
        }

        /// <summary>What a worker does.</summary>
        [StructLayout(LayoutKind.Sequential)]
        public struct incise_batch_options
        {
            public uint size;
            public uint shard_index;
            public uint shard_count;
            public uint threads;
            public int retry;
            public uint pad;
            public ulong verify_items;
            public ulong verify_seed;
            public IntPtr progress;
            public IntPtr should_stop;
            public IntPtr user;
            public IntPtr log;
            public IntPtr log_user;
        }

        /// <summary>INCISE_ABI of the library.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern uint incise_abi();

        /// <summary>The library's version, for instance "0.1.0".</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern IntPtr incise_version();

        /// <summary>"ok", "bad argument", ...; "unknown" for other numbers.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern IntPtr incise_status_name(int status);

        /// <summary>Of the last call on this thread that failed: one line that names the place and the remedy. Valid until the next call on this thread fails.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern IntPtr incise_last_error();

        /// <summary>The status of that call.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_last_error_code();

        /// <summary>The ids of the elements concerned, a few at most; what they are is in the message. Returns how many there are.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern ulong incise_last_error_ids(ulong* ids, ulong room);

        /// <summary>Writes the first `size` bytes of the default options.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_default_engine_options(incise_engine_options* options, uint size);

        /// <summary>Makes an engine; `options` null: the default. Slots are the numbers of the arrays unless `mend` dropped tets. Errors: bad argument names the first tet or point that is not sound. Each engine reserves about 25 GiB of address space (not memory); see docs/c.md. Cost: O(n log n).</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_create(incise_mesh_arrays* mesh, incise_engine_options* options, out IntPtr engine);

        /// <summary>A box of `cells` = nx, ny, nz cells with six tets each between two corners (3 numbers each, low &lt; high).</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_create_box(double* low, double* high, uint* cells, incise_engine_options* options, out IntPtr engine);

        /// <summary>Reads a mesh file: MEDIT, Gmsh, VTK, VTU, TetGen, Vega, Abaqus, tetrahedral PLY, gzipped or not, told by its content. Negative tets are turned and duplicates dropped; see `incise_engine_notes`. Errors: bad file "FILE:LINE: ...".</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_read([MarshalAs(UnmanagedType.LPUTF8Str)] string path, incise_engine_options* options, out IntPtr engine);

        /// <summary>The same for `n_bytes` in memory; `name` stands for the file in messages.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_read_bytes(IntPtr bytes, ulong n_bytes, [MarshalAs(UnmanagedType.LPUTF8Str)] string name, incise_engine_options* options, out IntPtr engine);

        /// <summary>Null is fine. INCISE_BUSY, and nothing is freed, while another thread is in a call.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_free(IntPtr engine);

        /// <summary>What reading changed or left out, and of arrays that are not mended the duplicate tets, one line each: copies at most `room` bytes with a closing 0, tells in `count` how many the whole takes.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_notes(IntPtr engine, IntPtr text, ulong room, ulong* count);

        /// <summary>Writes the mesh in the format of the extension, with region and piece per tet, the stroke of each wall, and the origin of each vertex, where the format can. No partial file is ever seen.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_write(IntPtr engine, [MarshalAs(UnmanagedType.LPUTF8Str)] string path, int pose);

        /// <summary>The bytes of such a file; `extension` is ".mesh", ".msh", ".msh2", ".vtk", ".vtu", ".node", ".ele", ".veg" or ".inp".</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_write_bytes(IntPtr engine, [MarshalAs(UnmanagedType.LPUTF8Str)] string extension, int pose, IntPtr bytes, ulong room, ulong* count);

        /// <summary>Writes skin and walls at rest as triangles: .obj, .stl, .ply or .off.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_write_surface(IntPtr engine, [MarshalAs(UnmanagedType.LPUTF8Str)] string path);

        /// <summary>Cost: O(1).</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_counts(IntPtr engine, incise_counts* counts);

        /// <summary>`which`: INCISE_TETS to INCISE_ORIGINS. Cost: O(1).</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_view(IntPtr engine, int which, incise_view* view);

        /// <summary>The boundary: three vertices per triangle, counter-clockwise seen from outside, its tag (0 skin, else the stroke) and its side (tet * 4 + side). Each of the three may be null. Cost: O(tets).</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_surface(IntPtr engine, uint* triangles, uint* tags, uint* sides, ulong room, ulong* count);

        /// <summary>Errors: bad argument, and nothing is written, where the mesh has more than there is room for: another thread may have cut it since it was counted. Cost: O(slots).</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_compact(IntPtr engine, incise_compact* arrays);

        /// <summary>The face-connected pieces: label by tet slot (INCISE_NONE where free), of which `label_room` are written; tets and rest volume of each piece, of which `piece_room` are written. Each of the three may be null.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_pieces(IntPtr engine, uint* labels, ulong label_room, ulong* tets, double* volumes, ulong piece_room, ulong* count);

        /// <summary>64 bits over connectivity, rest positions, regions, tags and free slots: the same on every compiler and machine. Undo restores it.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_hash(IntPtr engine, ulong* hash);

        /// <summary>At rest. `only_at_cuts`: of the tets with a vertex on a cut wall alone.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_quality(IntPtr engine, int only_at_cuts, incise_quality* quality);

        /// <summary>Checks the validity contract (docs/internals.md). `violations` may be null. Cost: about 1 us per tet.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_validate(IntPtr engine, int level, incise_validity* validity, incise_violation* violations, ulong room, ulong* count);

        /// <summary>For instance "nonmanifold_cut_edge"; null for other numbers.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern IntPtr incise_violation_name(int kind);

        /// <summary>Cuts along the whole stroke and maintains what it left. A blade that misses changes nothing and is no error. `report` may be null, here and below. Errors: bad argument for a malformed stroke; the mesh is then unchanged.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_cut(IntPtr engine, incise_stroke* stroke, incise_report* report);

        /// <summary>Cuts all that is there along normal . x = offset; `normal`: 3 numbers, of any length but 0.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_cut_plane(IntPtr engine, double* normal, double offset, incise_report* report);

        /// <summary>Cuts the strokes of a blade file (docs/formats.md), one after the other; `report` has their sums. Where one fails those before it stay.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_cut_blade(IntPtr engine, [MarshalAs(UnmanagedType.LPUTF8Str)] string path, incise_report* report);

        /// <summary>Puts the blade in place: its edge as the body stands, `n_points` &gt;= 2; `direction`: 3 numbers, where it cuts, null: where it moves. `stroke`, which may be null, gets the stroke's number.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_begin_stroke(IntPtr engine, double* edge, ulong n_points, double* direction, uint* stroke);

        /// <summary>Moves the blade on and cuts what it passes through, up to where it stands now. Points as at the beginning.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_step(IntPtr engine, double* edge, ulong n_points, double* direction, incise_report* report);

        /// <summary>Lifts the blade off: what it cut stays, is finished and maintained. `report` is of the whole stroke.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_end_stroke(IntPtr engine, incise_report* report);

        /// <summary>Tells where the body stands: x y z for every vertex slot, free ones ignored. Between the steps of a stroke too.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_set_positions(IntPtr engine, double* positions, ulong n_slots);

        /// <summary>Takes the last stroke, or `improve`, back, bit for bit. `done` (may be null): 0 where there was none.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_undo(IntPtr engine, int* done);

        /// <summary>Applies what was last taken back. `done` as above.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_redo(IntPtr engine, int* done);

        /// <summary>Keeps no more than the last `operations` (at least 1) for undo.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_keep_undo(IntPtr engine, ulong operations);

        /// <summary>Goes on with maintenance that a budget left undone, for `work_units` more, or until `should_stop` (may be null).</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_maintain(IntPtr engine, ulong work_units, incise_should_stop should_stop, IntPtr user, incise_report* report);

        /// <summary>Maintains the whole mesh, cut or not; an operation of its own for undo.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_improve(IntPtr engine, incise_should_stop should_stop, IntPtr user, incise_report* report);

        /// <summary>Cost: O(1).</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_journal(IntPtr engine, incise_journal* journal);

        /// <summary>`step` in [first, end).</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_step_counts(IntPtr engine, ulong step, incise_step_counts* counts);

        /// <summary>The records of a step in [first, end), in order; the next calls likewise.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_step_born(IntPtr engine, ulong step, incise_born* records, ulong room, ulong* count);

        /// <summary>Vertices that moved.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_step_moved(IntPtr engine, ulong step, incise_moved* records, ulong room, ulong* count);

        /// <summary>Twins.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_step_copied(IntPtr engine, ulong step, incise_copied* records, ulong room, ulong* count);

        /// <summary>Tets that are gone.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_step_consumed(IntPtr engine, ulong step, incise_consumed* records, ulong room, ulong* count);

        /// <summary>New tets.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_step_produced(IntPtr engine, ulong step, incise_produced* records, ulong room, ulong* count);

        /// <summary>Tets that live on with other vertices.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_step_rewired(IntPtr engine, ulong step, incise_rewired* records, ulong room, ulong* count);

        /// <summary>Faces that were opened.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_step_opened(IntPtr engine, ulong step, incise_opened* records, ulong room, ulong* count);

        /// <summary>Walls that were joined again.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_step_closed(IntPtr engine, ulong step, incise_opened* records, ulong room, ulong* count);

        /// <summary>Slots of vertices.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_step_died(IntPtr engine, ulong step, uint* records, ulong room, ulong* count);

        /// <summary>Edits of a step of maintenance.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_step_edits(IntPtr engine, ulong step, incise_edit* records, ulong room, ulong* count);

        /// <summary>Tets that its edits consumed.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_step_edit_consumed(IntPtr engine, ulong step, incise_consumed* records, ulong room, ulong* count);

        /// <summary>Tets that its edits produced.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_step_edit_produced(IntPtr engine, ulong step, incise_produced* records, ulong room, ulong* count);

        /// <summary>Slots of vertices that the step took.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_step_new_vertices(IntPtr engine, ulong step, uint* records, ulong room, ulong* count);

        /// <summary>Slots of tets that the step took.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_engine_step_new_tets(IntPtr engine, ulong step, uint* records, ulong room, ulong* count);

        /// <summary>At where the engine's journal stands now. It is for that engine alone: another one is a bad argument.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_cursor_create(IntPtr engine, out IntPtr cursor);

        /// <summary>How it gets to where the journal stands; `position` (may be null): the steps that the follower has applied.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_cursor_way(IntPtr cursor, IntPtr engine, int* way, ulong* position);

        /// <summary>The follower has caught up.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_cursor_move(IntPtr cursor, IntPtr engine);

        /// <summary>Null is fine.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_cursor_free(IntPtr cursor);

        /// <summary>For an engine as it stands. The engine that later calls are given is this one.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_attributes_create(IntPtr engine, out IntPtr attributes);

        /// <summary>Adds one; `id` gets its number. The engine stands where `incise_attributes_follow` has seen it last.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_attributes_add(IntPtr attributes, IntPtr engine, incise_attribute_spec* spec, uint* id);

        /// <summary>INCISE_NONE where none has the name.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_attributes_find(IntPtr attributes, [MarshalAs(UnmanagedType.LPUTF8Str)] string name, uint* id);

        /// <summary>Catches up with the journal, forwards or backwards. Errors: bad argument where the journal went back behind where the attributes began, or has forgotten steps that they have not seen: they have to be made anew.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_attributes_follow(IntPtr attributes, IntPtr engine);

        /// <summary>The values by slot * width, to read and to write: `n_values` numbers, until the next `follow` or `add`.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_attributes_values(IntPtr attributes, uint id, double** values, ulong* n_values);

        /// <summary>Null is fine.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_attributes_free(IntPtr attributes);

        /// <summary>Writes the first `size` bytes of the default options.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_default_body_options(incise_body_options* options, uint size);

        /// <summary>Writes the first `size` bytes of the default options.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_default_simulation_options(incise_simulation_options* options, uint size);

        /// <summary>A body at rest, held by nothing yet; see `incise_simulation_hold`.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_create(incise_mesh_arrays* mesh, incise_simulation_options* options, out IntPtr simulation);

        /// <summary>The same, of a mesh file.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_read([MarshalAs(UnmanagedType.LPUTF8Str)] string path, incise_simulation_options* options, out IntPtr simulation);

        /// <summary>A scene (docs/scenes.md) from its file, with what holds the body; it has not settled yet.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_read_scene([MarshalAs(UnmanagedType.LPUTF8Str)] string path, uint threads, out IntPtr simulation);

        /// <summary>The same for JSON in memory; files that it names are seen from `folder`, null: from here.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_parse_scene([MarshalAs(UnmanagedType.LPUTF8Str)] string json, [MarshalAs(UnmanagedType.LPUTF8Str)] string folder, uint threads, out IntPtr simulation);

        /// <summary>Null is fine. The engine of the simulation goes with it.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_free(IntPtr simulation);

        /// <summary>The engine, to read: mesh, surface, journal, quality, files. It lives as long as the simulation and shares its thread.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern IntPtr incise_simulation_engine(IntPtr simulation);

        /// <summary>One frame; `input` null: nothing is held. `report` may be null. Errors: bad argument for malformed input, and nothing changes.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_frame(IntPtr simulation, incise_frame_input* input, incise_frame_report* report);

        /// <summary>One frame of the scene's own script, number `incise_simulation_frames`. Errors: bad argument without a scene.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_play(IntPtr simulation, incise_frame_report* report);

        /// <summary>What the last frame cut and maintained.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_cut_report(IntPtr simulation, incise_report* report);

        /// <summary>Forces of the tissue on the hooks of the last frame, N: x y z each.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_hook_forces(IntPtr simulation, double* forces, ulong room, ulong* count);

        /// <summary>Lets the body come to rest until nothing moves faster than `speed` m/s, at least 0, at most `max_frames`; `frames` (may be null) gets how many it took.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_settle(IntPtr simulation, uint max_frames, double speed, uint* frames);

        /// <summary>As the scene says. Errors: bad argument without a scene.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_settle_scene(IntPtr simulation, uint* frames);

        /// <summary>The same two, until `should_stop` (may be null), which is asked before each frame, returns other than 0: the body is then as that many frames have left it. Several calls in place of one may make a frame more.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_settle_until(IntPtr simulation, uint max_frames, double speed, incise_should_stop should_stop, IntPtr user, uint* frames);

        /// <summary>As the scene says.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_settle_scene_until(IntPtr simulation, incise_should_stop should_stop, IntPtr user, uint* frames);

        /// <summary>Cost: O(tets).</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_look(IntPtr simulation, incise_simulation_state* state);

        /// <summary>As of engines. The tissue stays where it stands.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_undo(IntPtr simulation, int* done);

        /// <summary>Applies the stroke that was last taken back.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_redo(IntPtr simulation, int* done);

        /// <summary>Holds a vertex where it stands: rigidly (infinite stiffness), or by a spring of N/m; 0 lets it go.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_hold(IntPtr simulation, uint vertex, double stiffness);

        /// <summary>Holds a vertex by a spring of N/m that bears no more than `strength`, N, above 0: beyond it the vertex slips, or tears loose where `tears` is other than 0.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_pin(IntPtr simulation, uint vertex, double stiffness, double strength, int tears);

        /// <summary>Where a held vertex is to be: x y z.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_move_hold(IntPtr simulation, uint vertex, double* target);

        /// <summary>Whether a vertex is held: `is_held` gets 1 or 0.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_is_held(IntPtr simulation, uint vertex, int* is_held);

        /// <summary>Velocities of all vertex slots, m/s: x y z each.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_velocities(IntPtr simulation, double* velocities, ulong room, ulong* count);

        /// <summary>Gives a vertex a velocity, m/s, and wakes it.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_set_velocity(IntPtr simulation, uint vertex, double* velocity);

        /// <summary>What the 1 kHz loop goes by until the next frame. Cost: O(1).</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_simulation_haptic_snapshot(IntPtr simulation, incise_haptic_snapshot* snapshot);

        /// <summary>Writes the first `size` bytes of the default options.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_default_haptic_options(incise_haptic_options* options, uint size);

        /// <summary>`options` null: the default.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_haptic_tool_create(incise_haptic_options* options, out IntPtr tool);

        /// <summary>Takes a newer snapshot over. Errors: bad argument for one that is not sound, or not newer; it is passed over.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_haptic_tool_accept(IntPtr tool, incise_haptic_snapshot* snapshot);

        /// <summary>One tick of `dt` s, 1e-9 to 1: the device's position (m) and velocity (m/s) give the force on it (N) and, where `tool_position` is not null, where the physics moves its blade to (m); 3 numbers each. Errors: bad argument for a `dt` outside of its range, and for what is not finite or beyond 1e15; `force` is then zero, and the next tick starts anew.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_haptic_tool_tick(IntPtr tool, double dt, double* position, double* velocity, double* force, double* tool_position);

        /// <summary>Null is fine.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_haptic_tool_free(IntPtr tool);

        /// <summary>Reads a plan, JSON of format incise-plan. Errors: bad file "FILE:LINE: PATH what; remedy".</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_plan_read([MarshalAs(UnmanagedType.LPUTF8Str)] string path, out IntPtr plan);

        /// <summary>The same from memory. Files that it names are seen from `folder`; null: from the folder that the program runs in.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_plan_parse([MarshalAs(UnmanagedType.LPUTF8Str)] string json, [MarshalAs(UnmanagedType.LPUTF8Str)] string folder, out IntPtr plan);

        /// <summary>Null is fine. A batch that runs keeps what it needs.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_plan_free(IntPtr plan);

        /// <summary>How many items it has.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_plan_count(IntPtr plan, ulong* count);

        /// <summary>The name of an item, from 0: copies at most `room` bytes with a closing 0, tells in `count` how many the whole takes.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_plan_name(IntPtr plan, ulong item, IntPtr text, ulong room, ulong* count);

        /// <summary>Writes the first `size` bytes of the default options.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_default_batch_options(incise_batch_options* options, uint size);

        /// <summary>Computes the items of a shard that no worker has done yet into `folder`, which is made where it is not there. `tell` (may be null) gets a report: JSON of format incise-batch, with "items", "skipped", "done", "failed" and "stopped". Items that cannot be computed are no error of the call. Errors: io; bad argument where another worker is at the same shard; bad file where the folder has results of another plan, of another version of the program or of other meshes, or a line that is no result: the message names file, line and remedy.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_batch_run(IntPtr plan, [MarshalAs(UnmanagedType.LPUTF8Str)] string folder, incise_batch_options* options, incise_told tell, IntPtr user);

        /// <summary>Puts the lines of all shards into results.jsonl, in the order of the plan, where all is whole; the report's "ok" says whether it was, and "missing", "contradictory" and "broken_files" what was not. Errors: as above.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_batch_merge(IntPtr plan, [MarshalAs(UnmanagedType.LPUTF8Str)] string folder, incise_told tell, IntPtr user);

        /// <summary>Computes `verify_items` items again, and compares their lines: the report's "ok", "differences" and "stopped".</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int incise_batch_verify(IntPtr plan, [MarshalAs(UnmanagedType.LPUTF8Str)] string folder, incise_batch_options* options, incise_told tell, IntPtr user);
    }
}
