# SPDX-License-Identifier: Apache-2.0
"""Values on vertices or tets that follow an engine through its cuts."""
from __future__ import annotations

import ctypes
from ctypes import byref
from typing import Any, Callable, Optional

import numpy as np
import numpy.typing as npt

from . import _c
from ._arrays import Floats, address, listener, spread, text_bytes, waiting, whole
from ._library import Handle, check, lib, sized
from .mesh import Mesh, choice

_DOMAINS = {"vertices": _c.AT_VERTICES, "tets": _c.AT_TETS}
_TRANSFERS = {"interpolate": _c.INTERPOLATE, "inherit": _c.INHERIT, "conserve": _c.CONSERVE,
              "recompute": _c.RECOMPUTE}

Recompute = Callable[[int], npt.ArrayLike]


class Attributes:
    """Values that follow a mesh: call `follow` after cuts, undo and redo.

    >>> import incise
    >>> engine = incise.box((3, 3, 3))
    >>> values = incise.Attributes(engine)
    >>> values.add("mass", "tets", "conserve", initial=2.0)
    >>> _ = engine.cut_plane((1, 0.2, 0), 0.5)
    >>> values.follow()
    >>> round(float(values["mass"].sum()), 9)
    324.0
    """

    def __init__(self, mesh: Mesh) -> None:
        self._mesh = mesh
        pointer = ctypes.c_void_p()
        check(lib.incise_attributes_create(mesh._engine(), byref(pointer)))
        self._handle = Handle(pointer, lib.incise_attributes_free)
        self._keep: list[Any] = []
        self._errors: list[BaseException] = []
        self._widths: dict[str, int] = {}

    def add(self, name: str, domain: str, transfer: str = "interpolate", width: int = 1,
            initial: Optional[npt.ArrayLike] = None, recompute: Optional[Recompute] = None) -> None:
        """Adds one. domain: "vertices" or "tets". width: numbers per element, 1 to 64. initial: what every element
        starts with.

        transfer: "interpolate" (a field), "inherit" (a label), "conserve" (an amount: its sum is kept), or "recompute":
        then recompute(slot) computes the `width` numbers of an element from the mesh alone. What it raises comes out of
        `add` and `follow`; the values that it owed are then 0, or those of another element.
        """
        width = whole(width, "width", 1, 64)
        listener(recompute, "recompute")
        spec = sized(_c.incise_attribute_spec)
        encoded = text_bytes(name, "the name")
        start = None if initial is None else np.array(spread(initial, (width,), "initial"))
        spec.name, spec.width, spec.initial = encoded, width, address(start)
        spec.domain, spec.transfer = choice(domain, _DOMAINS, "domain"), choice(transfer, _TRANSFERS, "transfer")
        if recompute is not None:
            spec.recompute = self._callback(recompute, width)
            self._keep.append(spec)
        with waiting(recompute is not None):
            check(lib.incise_attributes_add(self._handle.pointer, self._mesh._engine(), byref(spec),
                                            byref(ctypes.c_uint32())))
        self._widths[name] = width
        self._raise_what_came()

    def _callback(self, recompute: Recompute, width: int) -> Any:
        def call(_user: Any, slot: int, value: int, _width: int) -> None:
            try:
                out = np.ctypeslib.as_array(ctypes.cast(value, ctypes.POINTER(ctypes.c_double)), (width,))
                out[:] = recompute(slot)
            except BaseException as error:
                self._errors.append(error)

        return _c.incise_recompute(call)

    def _raise_what_came(self) -> None:
        if self._errors:
            error = self._errors[0]
            self._errors.clear()
            raise error

    def follow(self) -> None:
        """Catches up with the mesh, forwards or backwards. Raises `BadArgument` where steps were forgotten that it has
        not seen: make it anew."""
        with waiting(bool(self._keep)):  # something is recomputed
            check(lib.incise_attributes_follow(self._handle.pointer, self._mesh._engine()))
        self._raise_what_came()

    def __contains__(self, name: object) -> bool:
        return name in self._widths

    def __getitem__(self, name: str) -> Floats:
        """A copy of the values by slot: n_slots, or n_slots x width. Those of free slots mean nothing."""
        width = self._width(name)
        values = self._values(name).copy()
        return values if width == 1 else values.reshape(-1, width)

    def __setitem__(self, name: str, values: npt.ArrayLike) -> None:
        """Sets all values, in the shape in which they are had; one for all elements will do, too."""
        inside, width = self._values(name), self._width(name)
        shape = (len(inside),) if width == 1 else (len(inside) // width, width)
        inside.reshape(shape)[:] = spread(values, shape, "values")

    def _width(self, name: str) -> int:
        if name not in self._widths:
            raise KeyError(name)
        return self._widths[name]

    def _values(self, name: str) -> Floats:
        found, data, n = ctypes.c_uint32(), ctypes.c_void_p(), ctypes.c_uint64()
        self._width(name)
        check(lib.incise_attributes_find(self._handle.pointer, name.encode(), byref(found)))
        check(lib.incise_attributes_values(self._handle.pointer, found.value, byref(data), byref(n)))
        if n.value == 0:
            return np.empty(0)
        return np.ctypeslib.as_array(ctypes.cast(data, ctypes.POINTER(ctypes.c_double)), (n.value,))
