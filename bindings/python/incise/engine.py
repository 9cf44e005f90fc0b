# SPDX-License-Identifier: Apache-2.0
"""The engine: owns a mesh and cuts it."""
from __future__ import annotations

import ctypes
from ctypes import byref
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Callable, Iterable, Optional

import numpy as np
import numpy.typing as npt

from . import _c, exchange
from ._arrays import Asking, Path, address, flag, indices, labels, listener, number, numbers, path_bytes, plain, points, poses, text_bytes, vector, waiting, whole
from ._library import Handle, check, default, hear, lib, sized
from .errors import BadArgument
from .mesh import Mesh, choice

_PROFILES = {"paper": _c.PROFILE_PAPER, "incise": _c.PROFILE_INCISE}


class Report(_c.incise_report):  # the struct itself: a step copies nothing
    """What a call did, summed over its steps. Times in ms."""

    if TYPE_CHECKING:
        stroke: int  # its number: the tag of its walls; 0: none
        steps: int
        cut_tets: int
        created_tets: int
        new_vertices: int
        copied_vertices: int
        incision_faces: int
        snapped_vertices: int
        bent_vertices: int
        crumbs_kept: int
        pinched_edges: int
        latent_faces: int
        blocked_edges: int
        sheets: int
        work_units: int  # of maintenance, as what follows
        collapsed_edges: int
        moved_vertices: int
        removed_edges: int
        removed_faces: int
        inserted_vertices: int
        peeled_tets: int
        waiting_tets: int  # 0: all is done
        maintenance_tets: int
        collision_ms: float
        subdivide_ms: float
        separate_ms: float
        merge_ms: float
        improve_ms: float
        relax_ms: float
        journal_first: int  # the call's steps in the journal: [journal_first, journal_end)
        journal_end: int

    def as_dict(self) -> dict[str, float]:
        """All figures by name."""
        return {name: getattr(self, name) for name, *_ in self._fields_ if name != "size"}

    def __repr__(self) -> str:
        return "Report(%s)" % ", ".join(f"{name}={value:.6g}" for name, value in self.as_dict().items() if value)


_REPORT_SIZE = ctypes.sizeof(Report)
_Array, _FLOAT64, _step = np.ndarray, np.dtype(np.float64), lib.incise_engine_step
_first_of: Callable[[Any], ctypes.c_double] = ctypes.c_double.from_buffer  # a number at the beginning of an array


@dataclass(frozen=True)
class Stroke:
    """A blade's motion through the rest shape: its edge at increasing times; each pair of times is one step.

    points: n_times x n_points x 3, n_times and n_points at least 2. times: n_times, s, increasing; 0, 1, 2, ... unless
    given.
    """

    points: npt.ArrayLike
    times: Optional[npt.ArrayLike] = None
    name: str = ""


def stroke_struct(stroke: Stroke, keep: list[Any]) -> Any:
    """The stroke for C; `keep` holds on to what it points to."""
    edges = poses(stroke.points, "the points of a stroke")
    times = numbers(np.arange(len(edges)) if stroke.times is None else stroke.times, len(edges), "times of a stroke")
    name = text_bytes(stroke.name, "the name of the stroke")
    keep += [edges, times, name]
    struct = sized(_c.incise_stroke)
    struct.times, struct.n_times = address(times), len(times)
    struct.points, struct.n_points = address(edges), edges.shape[1]
    struct.name = name
    return struct


def _units(work_units: Optional[int]) -> int:
    """A budget; none: unlimited."""
    return _c.UNLIMITED if work_units is None else whole(work_units, "work_units", 0, _c.UNLIMITED)


def engine_options(profile: str = "incise", snap: float = 0.2, merge: bool = True, improve: bool = True,
                   work_units: Optional[int] = None, threads: int = 1, smooth_boundary: bool = True,
                   check_steps: Optional[bool] = None, log: Optional[Callable[[int, str], None]] = None) -> Any:
    """The options of an engine for C, with what they point to."""
    listener(log, "log")
    options = default(_c.incise_engine_options, lib.incise_default_engine_options)
    options.profile = choice(profile, _PROFILES, "profile")
    options.snap, options.merge, options.improve = snap, flag(merge, "merge"), flag(improve, "improve")
    options.work_units = _units(work_units)
    options.threads, options.smooth_boundary = whole(threads, "threads", 1, 256), flag(smooth_boundary, "smooth_boundary")
    if check_steps is not None:
        options.check_steps = flag(check_steps, "check_steps")
    if log is not None:
        options.log = _c.incise_log(lambda _user, level, text: hear(log, level, text.decode(errors="replace")))
    return options


def mesh_struct(point_array: npt.ArrayLike, tets: npt.ArrayLike, regions: Optional[npt.ArrayLike], mend: bool,
                keep: list[Any]) -> Any:
    """Arrays for C; `keep` holds on to them."""
    xyz, corners = points(point_array), indices(tets, 4, "tets")
    region = labels(regions, len(corners), "regions")
    keep += [xyz, corners, region]
    mesh = sized(_c.incise_mesh_arrays)
    mesh.mend = flag(mend, "mend")
    mesh.points, mesh.n_points = address(xyz), len(xyz)
    mesh.tets, mesh.n_tets, mesh.regions = address(corners), len(corners), address(region)
    return mesh


class Engine(Mesh):
    """Owns a tetrahedral mesh and cuts it.

    points: n x 3, finite, length unit. tets: m x 4, numbers of points, of positive volume. regions: m labels.

    profile: "incise", or "paper" for the baseline. snap: snapping distance as a share of the mean edge, [0, 0.4].
    merge, improve: what maintenance does after a cut. work_units: its budget per stroke or step, about 0.1 us each.
    threads: that search the mesh. mend: turns tets of negative volume and drops duplicates. log: hears (level, text);
    what it raises comes out of the call that had something to say, which was done all the same.

    An engine is for one thread at a time: another one gets `Busy`. Calls release the interpreter's lock, so that
    engines of several threads run side by side. Each reserves about 25 GiB of address space, which is no memory.

    >>> import incise
    >>> engine = incise.box((5, 5, 5))
    >>> report = engine.cut_plane((1, 0, 0), 0.5)
    >>> len(engine.pieces())
    2
    >>> engine.undo()
    True
    >>> engine.tet_count
    750
    """

    def __init__(self, points: npt.ArrayLike, tets: npt.ArrayLike, regions: Optional[npt.ArrayLike] = None, *,
                 mend: bool = False, **options: Any) -> None:
        keep: list[Any] = []
        mesh = mesh_struct(points, tets, regions, mend, keep)
        self._make(engine_options(**options), lambda c, out: lib.incise_engine_create(byref(mesh), c, out))

    def _make(self, options: Any, call: Callable[[Any, Any], Any]) -> None:
        pointer = ctypes.c_void_p()
        self._listens = bool(options.log)
        with waiting(self._listens):
            check(call(byref(options), byref(pointer)))
        self._handle = Handle(pointer, lib.incise_engine_free, keeps=options)

    @classmethod
    def read(cls, path: Path, **options: Any) -> "Engine":
        """Reads a mesh file: MEDIT, Gmsh, VTK, VTU, TetGen, Vega, Abaqus, PLY, gzipped or not. See `notes`."""
        engine = cls.__new__(cls)
        name = path_bytes(path)
        engine._make(engine_options(**options), lambda c, out: lib.incise_engine_read(name, c, out))
        return engine

    @classmethod
    def from_bytes(cls, content: "bytes | bytearray | memoryview", name: str = "mesh", **options: Any) -> "Engine":
        """The content of a mesh file; `name` stands for it in messages."""
        data = content if isinstance(content, bytes) else bytes(memoryview(content))
        engine = cls.__new__(cls)
        engine._make(engine_options(**options), lambda c, out: lib.incise_engine_read_bytes(
            data, len(data), text_bytes(name, "the name"), c, out))
        return engine

    @classmethod
    def box(cls, cells: Iterable[int] = (5, 5, 5), low: npt.ArrayLike = (0, 0, 0), high: npt.ArrayLike = (1, 1, 1),
            **options: Any) -> "Engine":
        """A box of six tets per cell, for trying things."""
        corner, other = vector(low, "low"), vector(high, "high")
        counts = plain(cells if isinstance(cells, np.ndarray) else list(cells), "cells")
        if counts.shape != (3,) or counts.dtype.kind not in "iu" or counts.min() < 0 or counts.max() > 2**28:
            raise BadArgument(f"cells are {counts.tolist()}; three numbers from 1 on are wanted")
        sizes = counts.astype(np.uint32)
        engine = cls.__new__(cls)
        engine._make(engine_options(**options), lambda c, out: lib.incise_engine_create_box(
            address(corner), address(other), address(sizes), c, out))
        return engine

    @classmethod
    def from_meshio(cls, mesh: Any, regions: Optional[str] = None, **options: Any) -> "Engine":
        """Of a `meshio.Mesh` with tets, of four or ten nodes; others are left out.

        regions: the cell data that labels them; otherwise "region", "gmsh:physical" or "medit:ref", where it is there.
        Negative tets are turned and points without tets left out (`mend`), as files are read.
        """
        options.setdefault("mend", True)
        return cls(*exchange.arrays_of_meshio(mesh, regions), **options)

    def to_meshio(self, pose: str = "rest") -> Any:
        """A `meshio.Mesh`: tets with "region" and "piece", triangles of cut walls with "stroke"."""
        return exchange.to_meshio(self, pose)

    def to_pyvista(self, pose: str = "rest") -> Any:
        """A `pyvista.UnstructuredGrid` of the tets with "region" and "piece"."""
        return exchange.to_pyvista(self, pose)

    # --- cutting

    def _reported(self, call: Callable[[Any], Any]) -> Report:
        report = sized(Report)
        check(call(byref(report)))
        return report

    def _told(self, call: Callable[[Any], Any]) -> Report:
        with waiting(self._listens):
            return self._reported(call)

    def cut(self, stroke: "Stroke | npt.ArrayLike") -> Report:
        """Cuts along a whole stroke (or its points), and maintains what it left. One that misses is no error."""
        keep: list[Any] = []
        struct = stroke_struct(stroke if isinstance(stroke, Stroke) else Stroke(stroke), keep)
        return self._told(lambda report: lib.incise_engine_cut(self._engine(), byref(struct), report))

    def cut_plane(self, normal: npt.ArrayLike, offset: float) -> Report:
        """Cuts all that is there along normal . x = offset; the normal of any length but 0."""
        n, d = vector(normal, "normal"), number(offset, "offset")
        return self._told(lambda report: lib.incise_engine_cut_plane(self._engine(), address(n), d, report))

    def cut_blade(self, path: Path) -> Report:
        """Cuts the strokes of a blade file, one after the other; the report has their sums."""
        return self._told(lambda report: lib.incise_engine_cut_blade(self._engine(), path_bytes(path), report))

    def begin_stroke(self, edge: npt.ArrayLike, direction: Optional[npt.ArrayLike] = None) -> int:
        """Puts the blade in place: its edge as the body stands, n x 3, n >= 2. direction: where it cuts; where it
        moves unless given. Returns the stroke's number."""
        at, way, stroke = points(edge, "edge"), self._direction(direction), ctypes.c_uint32()
        check(lib.incise_engine_begin_stroke(self._engine(), address(at), len(at), address(way), byref(stroke)))
        return stroke.value

    def step(self, edge: npt.ArrayLike, direction: Optional[npt.ArrayLike] = None) -> Report:
        """Moves the blade on and cuts what it passes through, up to where it stands now."""
        # As few calls as it takes: a step costs 1 ms and leaves cold caches, in which each line here is dear.
        report, way = Report(_REPORT_SIZE), None
        if direction is not None:
            way = vector(direction, "direction")
        if (type(edge) is _Array and edge.dtype is _FLOAT64 and edge.flags.carray and edge.ndim == 2
                and edge.shape[1] == 3 and len(edge)):  # as C takes it
            at: Any = byref(_first_of(edge))
        else:
            edge = points(edge, "edge")
            at = address(edge)
        status = _step(self._handle.pointer, at, len(edge), None if way is None else address(way), byref(report))
        if status:
            check(status)
        return report

    def end_stroke(self) -> Report:
        """Lifts the blade off: what it cut stays, is finished and maintained. The report is of the whole stroke."""
        return self._told(lambda report: lib.incise_engine_end_stroke(self._engine(), report))

    def cut_along(self, edges: Iterable[npt.ArrayLike], direction: Optional[npt.ArrayLike] = None,
                  progress: Optional[Callable[[int], None]] = None) -> Report:
        """A stroke pose by pose: begin, a step for each edge, end. progress: told how many steps are done.

        Whatever is raised on the way, Ctrl-C among it, takes the stroke back.
        """
        listener(progress, "progress")
        began = False
        try:
            for done, edge in enumerate(edges):
                if began:
                    self.step(edge, direction)
                else:
                    self.begin_stroke(edge, direction)
                    began = True
                if progress is not None:
                    progress(done)
            if not began:
                raise BadArgument("a stroke without an edge")
            return self.end_stroke()
        except BaseException:
            if began and self.is_in_stroke:
                self.undo()
            raise

    @staticmethod
    def _direction(direction: Optional[npt.ArrayLike]) -> Optional[npt.NDArray[np.float64]]:
        return None if direction is None else vector(direction, "direction")

    @property
    def is_in_stroke(self) -> bool:
        """Between `begin_stroke` and `end_stroke`."""
        return bool(self._counts().is_in_stroke)

    def set_positions(self, positions: npt.ArrayLike) -> None:
        """Tells where the body stands: n_vertex_slots x 3, free slots ignored. Between the steps of a stroke too."""
        xyz = points(positions, "positions")
        check(lib.incise_engine_set_positions(self._engine(), address(xyz), len(xyz)))

    # --- history and maintenance

    def undo(self) -> bool:
        """Takes the last stroke, or `improve`, back, bit for bit. False where there is none."""
        done = ctypes.c_int32()
        check(lib.incise_engine_undo(self._engine(), byref(done)))
        return bool(done.value)

    def redo(self) -> bool:
        """Applies what was last taken back. False where there is none."""
        done = ctypes.c_int32()
        check(lib.incise_engine_redo(self._engine(), byref(done)))
        return bool(done.value)

    def keep_undo(self, operations: int) -> None:
        """Keeps no more than the last operations for undo."""
        check(lib.incise_engine_keep_undo(self._engine(), whole(operations, "operations", 1, _c.UNLIMITED)))

    @property
    def has_maintenance(self) -> bool:
        """A budget left some undone."""
        return bool(self._counts().has_maintenance)

    def maintain(self, work_units: Optional[int] = None, should_stop: Optional[Callable[[], bool]] = None) -> Report:
        """Goes on with maintenance that a budget left undone, for `work_units` more or until `should_stop`.

        Ctrl-C, and whatever `should_stop` raises, ends it between two operations: the mesh is sound, and what is left
        waits.
        """
        units = _units(work_units)
        with Asking(should_stop) as callback:
            return self._reported(lambda out: lib.incise_engine_maintain(self._engine(), units, callback, None, out))

    def improve(self, should_stop: Optional[Callable[[], bool]] = None) -> Report:
        """Maintains the whole mesh, cut or not; an operation of its own for undo. Stops as `maintain` does."""
        with Asking(should_stop) as callback:
            return self._reported(lambda out: lib.incise_engine_improve(self._engine(), callback, None, out))


def read(path: Path, **options: Any) -> Engine:
    """Reads a mesh file into an engine; see `Engine.read`."""
    return Engine.read(path, **options)


def box(cells: Iterable[int] = (5, 5, 5), low: npt.ArrayLike = (0, 0, 0), high: npt.ArrayLike = (1, 1, 1),
        **options: Any) -> Engine:
    """An engine of a box; see `Engine.box`."""
    return Engine.box(cells, low, high, **options)
