# SPDX-License-Identifier: Apache-2.0
"""What changed, step by step, for solvers and renderers that follow a mesh."""
from __future__ import annotations

import ctypes
from ctypes import byref
from dataclasses import dataclass
from typing import Any, Callable, Optional

import numpy as np
import numpy.typing as npt

from . import _c
from ._library import Handle, check, lib, sized
from .errors import BadArgument

Records = npt.NDArray[Any]

_LISTS: dict[str, Any] = {
    "born": _c.incise_born, "moved": _c.incise_moved, "copied": _c.incise_copied, "consumed": _c.incise_consumed,
    "produced": _c.incise_produced, "rewired": _c.incise_rewired, "opened": _c.incise_opened,
    "closed": _c.incise_opened, "died": np.uint32, "edits": _c.incise_edit, "edit_consumed": _c.incise_consumed,
    "edit_produced": _c.incise_produced, "new_vertices": np.uint32, "new_tets": np.uint32,
}
_DTYPES: dict[str, np.dtype[Any]] = {name: np.dtype(kind) for name, kind in _LISTS.items()}


@dataclass(frozen=True)
class Step:
    """One step, as arrays of records whose fields have the names of docs/journal.md: `step.born["weights"]`.

    They apply in the order of the members. A step of maintenance has `edits` besides.
    """

    index: int
    serial: int
    born: Records
    moved: Records
    copied: Records
    consumed: Records
    produced: Records
    rewired: Records
    opened: Records
    closed: Records
    died: Records
    edits: Records
    edit_consumed: Records
    edit_produced: Records
    new_vertices: Records
    new_tets: Records


def state(engine: ctypes.c_void_p) -> Any:
    """Where the journal stands."""
    journal = sized(_c.incise_journal)
    check(lib.incise_engine_journal(engine, byref(journal)))
    return journal


def _pointer(records: Records, name: str) -> Any:
    kind: Any = ctypes.c_void_p if _LISTS[name] is np.uint32 else ctypes.POINTER(_LISTS[name])
    return records.ctypes.data_as(kind)


def _read(engine: ctypes.c_void_p, index: int) -> Step:
    counts = sized(_c.incise_step_counts)
    check(lib.incise_engine_step_counts(engine, index, byref(counts)))
    lists: dict[str, Records] = {}
    for name, dtype in _DTYPES.items():
        n = getattr(counts, name)
        records = np.zeros(n, dtype)
        if n:
            check(getattr(lib, "incise_engine_step_" + name)(engine, index, _pointer(records, name), n, None))
        lists[name] = records
    return Step(index, counts.serial, **lists)


def steps(engine: ctypes.c_void_p, since: int) -> list[Step]:
    """The applied steps from `since` on."""
    journal = state(engine)
    if not journal.first <= since <= journal.position:
        raise BadArgument(f"the journal's steps in [{journal.first}, {journal.position}) can be had, not from {since} on")
    return [_read(engine, index) for index in range(since, journal.position)]


class Cursor:
    """Where a follower stands in a journal: it knows steps that were undone from those that are new."""

    def __init__(self, handle: Handle, engine: Callable[[], ctypes.c_void_p]) -> None:
        self._keeps, self._engine = handle, engine
        pointer = ctypes.c_void_p()
        check(lib.incise_cursor_create(engine(), byref(pointer)))
        self._handle = Handle(pointer, lib.incise_cursor_free)

    def new_steps(self) -> Optional[list[Step]]:
        """The steps since the last call, which count as followed then; none where nothing happened.

        `None` where steps were undone, redone or forgotten: begin anew from the mesh.
        """
        way, position = ctypes.c_int32(), ctypes.c_uint64()
        check(lib.incise_cursor_way(self._handle.pointer, self._engine(), byref(way), byref(position)))
        new = None if way.value == _c.WAY_ELSEWHERE else steps(self._engine(), position.value)
        check(lib.incise_cursor_move(self._handle.pointer, self._engine()))
        return new
