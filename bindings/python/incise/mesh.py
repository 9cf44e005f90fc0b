# SPDX-License-Identifier: Apache-2.0
"""A mesh to look at: arrays by slot without a copy, compact copies, surface, pieces, quality, validity, files."""
from __future__ import annotations

import ctypes
from ctypes import byref
from dataclasses import dataclass
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from . import _c
from . import journal as journals
from ._arrays import Bytes, Floats, Ints, Path, Rows, Slots, address, flag, lines, path_bytes, text_bytes, whole
from ._library import Handle, check, lib, sized
from .errors import BadArgument, shown, Busy

NONE: int = _c.NONE
"""The first vertex of a tet slot that is free, and "no element" elsewhere."""

_POSES = {"rest": _c.AT_REST, "current": _c.AS_IT_STANDS}
_MOST_LISTED = 1_000_000
_LEVELS = {"counts": _c.VALIDATE_COUNTS, "topology": _c.VALIDATE_TOPOLOGY, "geometry": _c.VALIDATE_GEOMETRY}


def choice(given: str, known: dict[str, int], name: str) -> int:
    """The number of a word."""
    if given not in known:
        raise BadArgument(f"{name} is {shown(given)}; one of {', '.join(map(repr, known))} is wanted")
    return known[given]


@dataclass(frozen=True)
class Compact:
    """The live mesh without gaps."""

    points: Floats
    """n x 3, length unit."""
    tets: Slots
    """m x 4, numbers of points."""
    regions: Ints
    """m."""
    pieces: Slots
    """m: the face-connected piece of each tet."""
    vertex_slots: Slots
    """n: the slot of each point."""
    tet_slots: Slots
    """m: the slot of each tet."""


@dataclass(frozen=True)
class Surface:
    """Skin and cut walls, counter-clockwise seen from outside."""

    triangles: Slots
    """n x 3, slots of vertices."""
    tags: Slots
    """n: 0 is skin, k > 0 the wall that stroke k cut."""
    sides: Slots
    """n: tet slot * 4 + side."""


@dataclass(frozen=True)
class Pieces:
    """The face-connected pieces of a mesh."""

    labels: Slots
    """By tet slot; `NONE` where it is free."""
    tets: npt.NDArray[np.uint64]
    """Live tets of each piece."""
    volumes: Floats
    """Rest volume of each piece, length unit cubed."""

    def __len__(self) -> int:
        return len(self.tets)


@dataclass(frozen=True)
class Quality:
    """Shape of the tets at rest. L/r is the longest edge over the inradius: 4.899 is regular, larger is worse."""

    tets: int
    flat_tets: int
    lr_min: float
    lr_mean: float
    lr_p99: float
    lr_max: float
    lr_over_200_pct: float
    dihedral_min_deg: float
    dihedral_max_deg: float


@dataclass(frozen=True)
class Violation:
    """One way in which the mesh breaks its contract."""

    kind: str
    ids: tuple[int, int]


@dataclass(frozen=True)
class Validity:
    """What `validate` found; true where it is nothing."""

    ok: bool
    counts: dict[str, int]
    volume: float
    violations: list[Violation]

    def __bool__(self) -> bool:
        return self.ok


def fields_of(kind: Any, struct: ctypes.Structure) -> Any:
    """A dataclass from the members of a struct that have its fields' names."""
    return kind(**{name: getattr(struct, name) for name in kind.__dataclass_fields__})


class Mesh:
    """A mesh to look at. Slots: elements have numbers, some of which are free; arrays by slot keep them.

    Views (`tets`, `rest`, `positions`, ...) are read-only and show the library's own memory where `views_are_stable`;
    they then follow what is cut as far as they reach, and keep the mesh alive. Where the arrays may move (under a limit
    on virtual memory) they are copies. Take a new one after each change: the number of slots grows.
    """

    _handle: Handle

    def _engine(self) -> ctypes.c_void_p:
        return self._handle.pointer

    def _counts(self) -> Any:
        counts = sized(_c.incise_counts)
        check(lib.incise_engine_counts(self._engine(), byref(counts)))
        return counts

    # --- arrays by slot

    def _view(self, which: int, dtype: npt.DTypeLike, width: int = 1) -> npt.NDArray[Any]:
        view = sized(_c.incise_view)
        check(lib.incise_engine_view(self._engine(), which, byref(view)))
        shape = (view.rows,) if width == 1 else (view.rows, width)
        if view.rows == 0:
            return np.empty(shape, dtype)
        rows = np.asarray(Rows(self._handle, view.data, shape, dtype))
        if not view.is_stable:
            rows = rows.copy()
            rows.flags.writeable = False
        return rows

    @property
    def tets(self) -> Slots:
        """n_tet_slots x 4 slots of vertices; the first is `NONE` where the slot is free."""
        return self._view(_c.TETS, np.uint32, 4)

    @property
    def rest(self) -> Floats:
        """n_vertex_slots x 3: places at rest, length unit."""
        return self._view(_c.REST, np.float64, 3)

    @property
    def positions(self) -> Floats:
        """n_vertex_slots x 3: where the body stands, length unit."""
        return self._view(_c.CURRENT, np.float64, 3)

    @property
    def links(self) -> Slots:
        """n_tet_slots x 4: behind each side the neighbour's tet * 4 + side; bit 31: boundary, the rest its tag."""
        return self._view(_c.LINKS, np.uint32, 4)

    @property
    def regions(self) -> Ints:
        """By tet slot."""
        return self._view(_c.REGIONS, np.int32)

    @property
    def shapes(self) -> Bytes:
        """By vertex slot, bits: 1 skin, 2 wall, 4 front, 8 pinched, 128 free."""
        return self._view(_c.SHAPES, np.uint8)

    @property
    def origins(self) -> Slots:
        """By vertex slot: the input's vertex that it is or was copied from; `NONE` where a cut made it."""
        return self._view(_c.ORIGINS, np.uint32)

    @property
    def tet_generations(self) -> Slots:
        """By tet slot: goes up when the slot is freed."""
        return self._view(_c.TET_GENERATIONS, np.uint32)

    @property
    def vertex_generations(self) -> Slots:
        """By vertex slot: goes up when the slot is freed."""
        return self._view(_c.VERTEX_GENERATIONS, np.uint32)

    @property
    def views_are_stable(self) -> bool:
        """Whether views stay valid while the mesh changes; where not, they are copies."""
        view = sized(_c.incise_view)
        check(lib.incise_engine_view(self._engine(), _c.TETS, byref(view)))
        return bool(view.is_stable)

    @property
    def live_tets(self) -> Slots:
        """The slots of all tets."""
        return np.flatnonzero(self.tets[:, 0] != NONE).astype(np.uint32)

    @property
    def live_vertices(self) -> Slots:
        """The slots of all vertices."""
        return np.flatnonzero((self.shapes & _c.SHAPE_DEAD) == 0).astype(np.uint32)

    # --- numbers

    @property
    def tet_count(self) -> int:
        """Live tets."""
        return int(self._counts().tets)

    @property
    def vertex_count(self) -> int:
        """Live vertices."""
        return int(self._counts().vertices)

    @property
    def version(self) -> int:
        """Goes up with every call that may change anything: equal versions, equal arrays."""
        return int(self._counts().version)

    @property
    def stroke_count(self) -> int:
        """Strokes applied, undone ones not counted."""
        return int(self._counts().strokes)

    @property
    def next_stroke(self) -> int:
        """The number, and the tag of its walls, that the next stroke gets, or the one under way has."""
        return int(self._counts().next_stroke)

    @property
    def memory_bytes(self) -> int:
        """Of the mesh's arrays."""
        return int(self._counts().memory_bytes)

    @property
    def hash(self) -> int:
        """64 bits over connectivity, rest places, regions, tags and free slots: the same on every machine."""
        value = ctypes.c_uint64()
        check(lib.incise_engine_hash(self._engine(), byref(value)))
        return value.value

    @property
    def notes(self) -> list[str]:
        """What reading the file changed or left out; of arrays, duplicate tets that were kept."""
        count = ctypes.c_uint64()
        check(lib.incise_engine_notes(self._engine(), None, 0, byref(count)))
        text = ctypes.create_string_buffer(count.value)
        check(lib.incise_engine_notes(self._engine(), text, count.value, None))
        return list(lines(text.value.decode(errors="replace")))

    # --- copies

    def compact(self, pose: str = "rest") -> Compact:
        """The live mesh without free slots, in the order of slots.

        pose: "rest" or "current". Cost: O(slots).
        """
        how, counts = choice(pose, _POSES, "pose"), self._counts()
        n, m = int(counts.vertices), int(counts.tets)
        result = Compact(np.empty((n, 3)), np.empty((m, 4), np.uint32), np.empty(m, np.int32), np.empty(m, np.uint32),
                         np.empty(n, np.uint32), np.empty(m, np.uint32))
        arrays = sized(_c.incise_compact)
        arrays.pose, arrays.vertex_room, arrays.tet_room = how, n, m
        for name in Compact.__dataclass_fields__:
            setattr(arrays, name, address(getattr(result, name)))
        try:
            check(lib.incise_engine_compact(self._engine(), byref(arrays)))
        except BadArgument:  # there is no room
            self._check_version(counts.version)
            raise
        self._check_version(counts.version)
        return result

    def _check_version(self, version: int) -> None:
        """Of what takes several calls: between two of them another thread may have had its turn."""
        if self.version != version:
            raise Busy("another thread has changed the mesh meanwhile: an engine is for one thread at a time")

    def surface(self) -> Surface:
        """All boundary faces, as slots of vertices (index `rest` or `positions` by them). Cost: O(tets)."""
        count, version = ctypes.c_uint64(), self.version
        check(lib.incise_engine_surface(self._engine(), None, None, None, 0, byref(count)))
        n = count.value
        result = Surface(np.empty((n, 3), np.uint32), np.empty(n, np.uint32), np.empty(n, np.uint32))
        check(lib.incise_engine_surface(self._engine(), address(result.triangles), address(result.tags),
                                        address(result.sides), n, None))
        self._check_version(version)
        return result

    def pieces(self) -> Pieces:
        """The face-connected pieces. Cost: O(tets)."""
        counts, count = self._counts(), ctypes.c_uint64()
        slots = int(counts.tet_slots)
        labels = np.empty(slots, np.uint32)
        check(lib.incise_engine_pieces(self._engine(), address(labels), slots, None, None, 0, byref(count)))
        n = count.value
        result = Pieces(labels, np.empty(n, np.uint64), np.empty(n))
        check(lib.incise_engine_pieces(self._engine(), None, 0, address(result.tets), address(result.volumes), n, None))
        self._check_version(counts.version)
        return result

    # --- judgement

    def quality(self, at_cuts: bool = False) -> Quality:
        """Of all tets, or of those with a vertex on a cut wall."""
        quality = sized(_c.incise_quality)
        check(lib.incise_engine_quality(self._engine(), flag(at_cuts, "at_cuts"), byref(quality)))
        return fields_of(Quality, quality)  # type: ignore[no-any-return]

    def validate(self, level: str = "geometry", most: int = 16) -> Validity:
        """Checks the validity contract: level "counts", "topology" or "geometry"; lists `most` violations at most.

        Cost: about 1 us per tet.
        """
        most = whole(most, "most", 0, _MOST_LISTED)
        listed = (_c.incise_violation * most)()
        validity, count = sized(_c.incise_validity), ctypes.c_uint64()
        check(lib.incise_engine_validate(self._engine(), choice(level, _LEVELS, "level"), byref(validity), listed, most,
                                         byref(count)))
        counts = {_violation_name(kind): n for kind, n in enumerate(validity.counts) if n}
        found = [Violation(_violation_name(v.kind), (v.ids[0], v.ids[1])) for v in listed[:min(count.value, most)]]
        return Validity(bool(validity.ok), counts, validity.volume, found)

    # --- files

    def write(self, path: Path, pose: str = "rest") -> None:
        """Writes the mesh in the format of the extension: .mesh .msh .vtk .vtu .node .veg .inp, also with .gz.

        Regions, pieces, strokes of walls and origins go along where the format can. No partial file is ever seen.
        """
        check(lib.incise_engine_write(self._engine(), path_bytes(path), choice(pose, _POSES, "pose")))

    def to_bytes(self, extension: str, pose: str = "rest") -> bytes:
        """What `write` would put into a file of that extension (".mesh")."""
        count, name, how = ctypes.c_uint64(), text_bytes(extension, "the extension"), choice(pose, _POSES, "pose")
        check(lib.incise_engine_write_bytes(self._engine(), name, how, None, 0, byref(count)))
        buffer = ctypes.create_string_buffer(count.value)
        check(lib.incise_engine_write_bytes(self._engine(), name, how, buffer, count.value, None))
        return buffer.raw

    def write_surface(self, path: Path) -> None:
        """Writes skin and walls at rest: .obj, .stl, .ply or .off."""
        check(lib.incise_engine_write_surface(self._engine(), path_bytes(path)))

    # --- the journal

    def journal(self, since: int = 0) -> list[journals.Step]:
        """The steps applied from position `since` on, oldest first; docs/journal.md says what the records mean.

        Raises `BadArgument` where `since` lies before what is kept (`keep_undo`) or after what is applied.
        """
        return journals.steps(self._engine(), since)

    @property
    def journal_position(self) -> int:
        """Steps applied so far."""
        return int(journals.state(self._engine()).position)

    def cursor(self) -> journals.Cursor:
        """A follower's place in the journal, at where it stands now."""
        return journals.Cursor(self._handle, self._engine)


def _violation_name(kind: int) -> str:
    name: Optional[bytes] = lib.incise_violation_name(kind)
    return name.decode() if name else "unknown"
