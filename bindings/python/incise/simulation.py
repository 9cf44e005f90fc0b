# SPDX-License-Identifier: Apache-2.0
"""A body that is cut while it deforms."""
from __future__ import annotations

import ctypes
import json
import math
import os
from ctypes import byref
from dataclasses import dataclass
from typing import Any, Callable, Iterable, Mapping, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _c
from ._arrays import Asking, Floats, Path, Slots, address, flag, listener, number, path_bytes, plain, points, vector, waiting, whole
from ._library import Handle, check, default, lib, sized
from .engine import Report, engine_options, mesh_struct
from .errors import BadArgument, shown
from .mesh import Mesh, choice

_RELAXATIONS = {"block_descent": _c.BLOCK_DESCENT, "position_based": _c.POSITION_BASED}


@dataclass(frozen=True)
class Material:
    """What tissue is made of; region None: every region that no other material names."""

    young: float = 10e3
    """Pa."""
    density: float = 1000
    """kg/m^3."""
    poisson: float = 0.45
    toughness: float = 0
    """J/m^2 of cut face; 0: a blade meets no resistance."""
    cut_friction: float = 0
    """N per m of engaged edge."""
    stiffening: float = 0
    """How fast it stiffens as it is strained, 0 to 100; docs/coupling.md."""
    rupture: float = 0
    """Share by which a front at rest bears more, and a running one less, 0 to 0.5."""
    fibre: npt.ArrayLike = (0, 0, 0)
    """Direction of fibres at rest, of any length."""
    fibre_young: float = 0
    """Pa, what fibres add to Young's modulus along them, in tension alone."""
    prony: Sequence[tuple[float, float]] = ()
    """Up to three pairs: a share of the shear modulus, and the seconds in which it relaxes."""
    rigid: bool = False
    """Bone: it moves, and does not deform."""
    region: Optional[int] = None


@dataclass(frozen=True)
class Hook:
    """A grip on the tissue: takes hold where it first appears, lets go where it appears no more."""

    id: int
    """The same from frame to frame."""
    position: npt.ArrayLike
    radius: float
    """Length unit; of what it takes hold of."""
    stiffness: float = 100
    """N/m per vertex."""
    strength: float = 0
    """N, of all its springs together; 0: it bears all."""
    tears: bool = False
    """Beyond its strength it lets go; else it slips."""


@dataclass(frozen=True)
class Ball:
    """A ball that presses on the body. Length unit."""

    centre: npt.ArrayLike
    radius: float


@dataclass(frozen=True)
class Rod:
    """A rod with round ends. Length unit."""

    start: npt.ArrayLike
    end: npt.ArrayLike
    radius: float


@dataclass(frozen=True)
class Plane:
    """A table or a wall: the body stays where normal . x >= offset; the normal is unit."""

    normal: npt.ArrayLike
    offset: float


@dataclass(frozen=True)
class Flat:
    """The flat of a blade: the strip from its edge (n x 3) to `back` behind it. Length unit."""

    edge: npt.ArrayLike
    back: npt.ArrayLike
    thickness: float = 0


Tool = Union[Ball, Rod, Plane, Flat]


@dataclass(frozen=True)
class Frame:
    """What one frame did. SI units."""

    stroke: int
    """Under way, of this simulation's from 1; 0: none."""
    blade_touches: bool
    blade_yields: bool
    """Somewhere the tissue gave way."""
    blade_force: Floats
    """Of the tissue on the edge, N."""
    engaged_length: float
    fracture_work: float
    friction_work: float
    tool_work: float
    contacts: int
    """Vertices that tools touch."""
    active_vertices: int
    fastest: float
    hook_forces: Floats
    """n_hooks x 3: of the tissue on each hook of the input, N."""


@dataclass(frozen=True)
class State:
    """The body as it stands. SI units."""

    frames: int
    scene_frames: int
    frame_seconds: float
    length_unit: float
    mass: float
    momentum: Floats
    elastic: float
    kinetic: float
    potential: float
    held: float
    pulled: float
    force_on_holds: Floats
    inverted_tets: int
    hash: int


class _SimulatedMesh(Mesh):
    """The mesh of a simulation; lives as long as one of the two."""

    def __init__(self, handle: Handle) -> None:
        self._handle = handle

    def _engine(self) -> ctypes.c_void_p:
        return ctypes.c_void_p(lib.incise_simulation_engine(self._handle.pointer))


class Simulation:
    """An elastic body that is cut while it deforms, frame by frame. See docs/scenes.md for scenes.

    points, tets, regions, mend: as of `Engine`. materials: a `Material`, or several with regions. length_unit: metres
    per length unit. gravity: m/s^2. frame_seconds: (0, 1]. substeps, iterations: of relaxation. flat_height: of the
    blade behind its edge, length unit. Further options are those of `Engine`.

    >>> import incise
    >>> cube = incise.box((3, 3, 3)).compact()
    >>> body = incise.Simulation(cube.points, cube.tets, materials=incise.Material(young=20e3), length_unit=0.1)
    >>> body.hold(body.find(lambda rest: rest[:, 2] > 0.99))
    >>> body.settle() > 0
    True
    >>> frame = body.frame(hooks=[incise.Hook(1, (0.5, 0.5, 0), 0.2)])
    >>> frame.hook_forces.shape
    (1, 3)
    """

    def __init__(self, points: npt.ArrayLike, tets: npt.ArrayLike, regions: Optional[npt.ArrayLike] = None, *,
                 mend: bool = False, **options: Any) -> None:
        keep: list[Any] = []
        mesh = mesh_struct(points, tets, regions, mend, keep)
        struct = _options(keep, **options)
        self._listens = options.get("log") is not None
        self._make(lambda out: lib.incise_simulation_create(byref(mesh), byref(struct), out), keep)

    _listens = False  # to a log

    def _make(self, call: Callable[[Any], Any], keep: list[Any]) -> None:
        pointer = ctypes.c_void_p()
        with waiting(self._listens):
            check(call(byref(pointer)))
        self._handle = Handle(pointer, lib.incise_simulation_free)
        self._keep = keep
        self._mesh = _SimulatedMesh(self._handle)

    @classmethod
    def read(cls, path: Path, **options: Any) -> "Simulation":
        """Of a mesh file; options as of the class."""
        keep: list[Any] = []
        struct, name = _options(keep, **options), path_bytes(path)
        simulation = cls.__new__(cls)
        simulation._listens = options.get("log") is not None
        simulation._make(lambda out: lib.incise_simulation_read(name, byref(struct), out), keep)
        return simulation

    @classmethod
    def from_scene(cls, scene: Union[Path, Mapping[str, Any]], threads: int = 1, settle: bool = True,
                   folder: Optional[Path] = None) -> "Simulation":
        """Of a scene: its file, or its content as a mapping (files that it names are then seen from `folder`).

        settle: lets the body come to rest as the scene says.
        """
        simulation = cls.__new__(cls)
        threads, settles = whole(threads, "threads", 1, 256), flag(settle, "settle")
        if isinstance(scene, (str, os.PathLike)):
            name = path_bytes(scene)
            simulation._make(lambda out: lib.incise_simulation_read_scene(name, threads, out), [])
        else:
            text = json.dumps(scene).encode()
            seen_from = None if folder is None else path_bytes(folder)
            simulation._make(lambda out: lib.incise_simulation_parse_scene(text, seen_from, threads, out), [])
        if settles:
            with Asking(None) as callback:
                check(lib.incise_simulation_settle_scene_until(simulation._handle.pointer, callback, None, None))
        return simulation

    @property
    def mesh(self) -> Mesh:
        """The mesh, to look at: places, surface, pieces, quality, journal, files."""
        return self._mesh

    def find(self, where: Callable[[Floats], npt.NDArray[np.bool_]]) -> Slots:
        """The vertices whose rest places `where` holds for: it takes n x 3 and returns n, each True or False."""
        listener(where, "where")
        live = self._mesh.live_vertices
        holds = plain(where(self._mesh.rest[live]), "what `where` returns")
        if holds.dtype != bool or holds.shape != live.shape:
            raise BadArgument(f"what `where` returns is of {holds.dtype} and has the shape {holds.shape}; "
                              f"True or False for each of {len(live)} places is wanted")
        found: Slots = live[holds]
        return found

    # --- time goes on

    def frame(self, blade: Optional[npt.ArrayLike] = None, direction: Optional[npt.ArrayLike] = None,
              hooks: Sequence[Hook] = (), tools: Sequence[Tool] = (), slicing: float = 0) -> Frame:
        """One frame, with everything that the hands hold where it is at its end.

        blade: its edge, n x 3; the first frame puts it in place, frame by frame it cuts on, where it is gone the stroke
        has ended. direction: where it cuts; where it moves unless given. slicing: how fast the edge moves along itself, by
        how fast it is pushed, 0 to 100: the push bears 1 / (1 + slicing^2) of the toughness.
        """
        keep: list[Any] = []
        struct = _input(blade, direction, hooks, tools, keep)
        struct.slicing = number(slicing, "slicing")
        report = sized(_c.incise_frame_report)
        with waiting(self._listens):
            check(lib.incise_simulation_frame(self._handle.pointer, byref(struct), byref(report)))
        return self._frame(report)

    def play(self) -> Frame:
        """One frame of the scene's own script."""
        report = sized(_c.incise_frame_report)
        with waiting(self._listens):
            check(lib.incise_simulation_play(self._handle.pointer, byref(report)))
        return self._frame(report)

    def run(self, frames: Optional[int] = None,
            progress: Optional[Callable[[int, int], None]] = None) -> list[Frame]:
        """Frames of the scene's script, all that are left unless told. progress: told (done, of how many).

        Ctrl-C ends it between two frames.
        """
        listener(progress, "progress")
        state = self.state
        total = max(0, state.scene_frames - state.frames) if frames is None else whole(frames, "frames", 0, 2**32 - 1)
        done: list[Frame] = []
        for index in range(total):
            done.append(self.play())
            if progress is not None:
                progress(index + 1, total)
        return done

    def settle(self, max_frames: int = 300, speed: float = 1e-4,
               should_stop: Optional[Callable[[], bool]] = None) -> int:
        """Lets the body come to rest until nothing moves faster than `speed` m/s; returns the frames that it took.

        Ctrl-C, and whatever `should_stop` says or raises, ends it between two frames.
        """
        frames, most = ctypes.c_uint32(), whole(max_frames, "max_frames", 0, 2**32 - 1)
        with Asking(should_stop) as callback:
            check(lib.incise_simulation_settle_until(self._handle.pointer, most, number(speed, "speed"), callback, None,
                                                     byref(frames)))
        return frames.value

    def _frame(self, report: Any) -> Frame:
        forces = np.empty((report.n_hook_forces, 3))
        check(lib.incise_simulation_hook_forces(self._handle.pointer, address(forces), len(forces), None))
        return Frame(report.stroke, bool(report.blade_touches), bool(report.blade_yields), np.array(report.blade_force),
                     report.engaged_length, report.fracture_work, report.friction_work, report.tool_work,
                     report.contacts, report.active_vertices, report.fastest, forces)

    @property
    def cut_report(self) -> Report:
        """What the last frame cut and maintained."""
        report = sized(Report)
        check(lib.incise_simulation_cut_report(self._handle.pointer, byref(report)))
        return report

    # --- what holds it

    def hold(self, vertices: "npt.ArrayLike", stiffness: float = math.inf) -> None:
        """Holds vertices where they stand: rigidly, or by springs of `stiffness` N/m each; 0 lets them go.

        vertices: slots, as `find` gives them; a mask is refused. Where one of them is not live nothing is held.
        """
        for vertex in self._live_slots(vertices):
            check(lib.incise_simulation_hold(self._handle.pointer, vertex, number(stiffness, "stiffness")))

    def pin(self, vertices: "npt.ArrayLike", stiffness: float, strength: float, tears: bool = False) -> None:
        """Holds vertices by springs that bear no more than `strength` N each: beyond it they slip, or tear loose."""
        for vertex in self._live_slots(vertices):
            check(lib.incise_simulation_pin(self._handle.pointer, vertex, number(stiffness, "stiffness"),
                                            number(strength, "strength"), flag(tears, "tears")))

    def move_hold(self, vertices: npt.ArrayLike, targets: npt.ArrayLike) -> None:
        """Where held vertices are to be: n x 3, or one place for one vertex; length unit."""
        slots = self._live_slots(vertices)
        places = points(np.atleast_2d(plain(targets, "targets")), "targets")
        if len(places) != len(slots):
            raise BadArgument(f"{len(slots)} vertices and {len(places)} targets")
        for vertex in slots:  # before any is moved
            if not self.is_held(vertex):
                raise BadArgument(f"vertex {vertex} is not held", (vertex,))
        for vertex, place in zip(slots, places):
            check(lib.incise_simulation_move_hold(self._handle.pointer, vertex, address(place)))

    def _live_slots(self, vertices: npt.ArrayLike) -> list[int]:
        slots, shapes = [_slot(vertex) for vertex in np.atleast_1d(plain(vertices, "vertices")).tolist()], self._mesh.shapes
        for slot in slots:
            if slot >= len(shapes) or shapes[slot] & _c.SHAPE_DEAD:
                raise BadArgument(f"vertex {slot} is not live", (slot,))
        return slots

    def is_held(self, vertex: int) -> bool:
        """Whether a vertex is held."""
        held = ctypes.c_int32()
        check(lib.incise_simulation_is_held(self._handle.pointer, _slot(vertex), byref(held)))
        return bool(held.value)

    # --- what it is like

    @property
    def state(self) -> State:
        """Frames, mass, momentum, energies, hash. Cost: O(tets)."""
        struct = sized(_c.incise_simulation_state)
        check(lib.incise_simulation_look(self._handle.pointer, byref(struct)))
        values = {name: getattr(struct, name) for name in State.__dataclass_fields__}
        values["momentum"] = np.array(struct.momentum)
        values["force_on_holds"] = np.array(struct.force_on_holds)
        return State(**values)

    @property
    def hash(self) -> int:
        """Of the mesh and of the body's state."""
        return self.state.hash

    @property
    def velocities(self) -> Floats:
        """n_vertex_slots x 3, m/s."""
        values = np.empty((len(self._mesh.rest), 3))
        check(lib.incise_simulation_velocities(self._handle.pointer, address(values), len(values), None))
        return values

    def set_velocity(self, vertex: int, velocity: npt.ArrayLike) -> None:
        """Gives a vertex a velocity, m/s."""
        v = vector(velocity, "velocity")
        check(lib.incise_simulation_set_velocity(self._handle.pointer, _slot(vertex), address(v)))

    def undo(self) -> bool:
        """Takes the last stroke back; the tissue stays where it stands. False where there is none."""
        done = ctypes.c_int32()
        check(lib.incise_simulation_undo(self._handle.pointer, byref(done)))
        return bool(done.value)

    def redo(self) -> bool:
        """Applies what was last taken back. False where there is none."""
        done = ctypes.c_int32()
        check(lib.incise_simulation_redo(self._handle.pointer, byref(done)))
        return bool(done.value)


def _slot(vertex: Any) -> int:
    if isinstance(vertex, (bool, np.bool_)):  # a mask would hold vertices 0 and 1
        raise BadArgument("vertices are True or False; slots are wanted: those of a mask are "
                          "numpy.flatnonzero(mask)")
    return whole(vertex, "a vertex", 0, _c.NONE)


def _materials(materials: Union[Material, Iterable[Material], None], keep: list[Any]) -> tuple[Any, int]:
    given = [materials] if isinstance(materials, Material) else list(materials or [])
    structs = (_c.incise_material * len(given))()
    for struct, material in zip(structs, given):
        if not isinstance(material, Material):
            raise BadArgument(f"{shown(material)} is no material; Material is")
        struct.is_fallback = int(material.region is None)
        struct.region = whole(material.region or 0, "region", -2**31, 2**31 - 1)
        for name in ("density", "young", "poisson", "toughness", "cut_friction", "stiffening", "rupture", "fibre_young"):
            setattr(struct, name, getattr(material, name))
        struct.fibre[:] = vector(material.fibre, "fibre").tolist()
        terms = [part for term in material.prony for part in term]
        if len(terms) > 6 or len(terms) != 2 * len(material.prony):
            raise BadArgument("prony takes up to three pairs of a share and seconds")
        struct.prony[:] = terms + [0] * (6 - len(terms))
        struct.rigid = flag(material.rigid, "rigid")
    keep.append(structs)
    return structs, len(given)


_BODY_COUNTS = ("substeps", "iterations")
_BODY = ("length_unit", "damping", "substeps", "iterations", "thinnest", "sleep_below", "crumb")


def _options(keep: list[Any], *, materials: Union[Material, Iterable[Material], None] = None,
             gravity: npt.ArrayLike = (0, 0, -9.81), frame_seconds: float = 1 / 60, contact_stiffness: float = 0,
             flat_height: float = 0, relaxation: str = "block_descent", threads: int = 1, coarse: bool = True,
             work_units: Optional[int] = 20_000, **others: Any) -> Any:
    body = default(_c.incise_body_options, lib.incise_default_body_options)
    body.relaxation, body.coarse = choice(relaxation, _RELAXATIONS, "relaxation"), flag(coarse, "coarse")
    body.gravity[:] = vector(gravity, "gravity").tolist()
    for name in _BODY:
        if name in others:
            value = others.pop(name)
            setattr(body, name, whole(value, name, 0, 2**32 - 1) if name in _BODY_COUNTS else value)
    engine = engine_options(threads=threads, work_units=work_units, **others)
    body.threads = threads
    options = default(_c.incise_simulation_options, lib.incise_default_simulation_options)
    options.engine, options.body = ctypes.pointer(engine), ctypes.pointer(body)
    structs, options.n_materials = _materials(materials, keep)
    options.materials = ctypes.cast(structs, ctypes.POINTER(_c.incise_material))
    options.frame_seconds, options.contact_stiffness = frame_seconds, contact_stiffness
    options.flat_height = flat_height
    keep += [engine, body]
    return options


def _tool(tool: Tool, struct: Any, keep: list[Any]) -> None:
    if isinstance(tool, Ball):
        struct.kind, struct.radius, struct.a[:] = _c.TOOL_BALL, tool.radius, vector(tool.centre, "centre").tolist()
    elif isinstance(tool, Rod):
        struct.kind, struct.radius = _c.TOOL_ROD, tool.radius
        struct.a[:], struct.b[:] = vector(tool.start, "start").tolist(), vector(tool.end, "end").tolist()
    elif isinstance(tool, Plane):
        struct.kind, struct.offset, struct.a[:] = _c.TOOL_PLANE, tool.offset, vector(tool.normal, "normal").tolist()
    elif isinstance(tool, Flat):
        edge = points(tool.edge, "edge")
        keep.append(edge)
        struct.kind, struct.radius, struct.a[:] = _c.TOOL_FLAT, tool.thickness, vector(tool.back, "back").tolist()
        struct.edge, struct.n_edge = address(edge), len(edge)
    else:
        raise BadArgument(f"{shown(tool)} is no tool; Ball, Rod, Plane and Flat are")


def _input(blade: Optional[npt.ArrayLike], direction: Optional[npt.ArrayLike], hooks: Sequence[Hook],
           tools: Sequence[Tool], keep: list[Any]) -> Any:
    struct = sized(_c.incise_frame_input)
    if blade is not None:
        edge = points(blade, "blade")
        keep.append(edge)
        struct.blade, struct.n_blade = address(edge), len(edge)
    if direction is not None:
        way = vector(direction, "direction")
        keep.append(way)
        struct.direction = address(way)
    hook_structs, tool_structs = (_c.incise_hook * len(hooks))(), (_c.incise_tool * len(tools))()
    for hook, hook_struct in zip(hooks, hook_structs):
        if not isinstance(hook, Hook):
            raise BadArgument(f"{shown(hook)} is no hook; Hook is")
        hook_struct.id = whole(hook.id, "the hook's id", 0, 2**32 - 1)
        hook_struct.radius, hook_struct.stiffness = hook.radius, hook.stiffness
        hook_struct.strength, hook_struct.tears = hook.strength, flag(hook.tears, "tears")
        hook_struct.position[:] = vector(hook.position, "position").tolist()
    for tool, tool_struct in zip(tools, tool_structs):
        _tool(tool, tool_struct, keep)
    struct.hooks, struct.n_hooks = ctypes.cast(hook_structs, ctypes.POINTER(_c.incise_hook)), len(hooks)
    struct.tools, struct.n_tools = ctypes.cast(tool_structs, ctypes.POINTER(_c.incise_tool)), len(tools)
    keep += [hook_structs, tool_structs]
    return struct
