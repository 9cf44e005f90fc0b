# SPDX-License-Identifier: Apache-2.0
"""Between numpy and C."""
from __future__ import annotations

import ctypes
import operator
import os
import signal
import threading
from typing import Any, Callable, Iterator, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _c
from .errors import BadArgument

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int32]
Slots = npt.NDArray[np.uint32]
Bytes = npt.NDArray[np.uint8]
Path = Union[str, "os.PathLike[str]"]


def _real(value: npt.ArrayLike, name: str) -> Floats:
    array = np.ascontiguousarray(value)
    kind = array.dtype
    if kind.char == "d" and kind.isnative:  # the usual one: each step of a blade comes by here
        return array
    if kind.kind == "c":  # numpy would drop half of it, and warn
        raise BadArgument(f"{name} is of {kind}; real numbers are wanted")
    return np.ascontiguousarray(array, dtype=np.float64)


def whole(value: Any, name: str, least: int, most: int) -> int:
    """A whole number in [least, most]: ctypes would take others modulo 2^32, or 2^64. A float is a TypeError."""
    number = operator.index(value)
    if not least <= number <= most:
        raise BadArgument(f"{name} is {number}; {least} to {most} are wanted")
    return number


def points(value: npt.ArrayLike, name: str = "points") -> Floats:
    """n x 3 numbers, as C wants them; no copy where they are that already."""
    array = _real(value, name)
    if array.ndim != 2 or array.shape[1] != 3:
        raise BadArgument(f"{name} has the shape {array.shape}; n x 3 is wanted")
    return array


def vector(value: npt.ArrayLike, name: str) -> Floats:
    """Three numbers."""
    array = _real(value, name)
    if array.shape != (3,):
        raise BadArgument(f"{name} has the shape {array.shape}; 3 numbers are wanted")
    return array


def indices(value: npt.ArrayLike, width: int, name: str) -> Slots:
    """n x width whole numbers that 32 bits hold; no copy where they are uint32 already."""
    array = np.asarray(value)
    if array.size == 0:
        array = array.reshape(0, width)
    if array.ndim != 2 or array.shape[1] != width:
        raise BadArgument(f"{name} has the shape {array.shape}; n x {width} is wanted")
    if array.dtype == np.uint32:
        return np.ascontiguousarray(array)
    if array.size and array.dtype.kind not in "iu":
        raise BadArgument(f"{name} is of {array.dtype}; whole numbers are wanted")
    if array.size and (int(array.min()) < 0 or int(array.max()) >= _c.NONE):
        bad = int(np.argmax((array < 0).any(axis=1) | (array.astype(np.float64) >= _c.NONE).any(axis=1)))
        raise BadArgument(f"{name}[{bad}] names a point below 0 or above 2^32 - 2", (bad,))
    return np.ascontiguousarray(array, dtype=np.uint32)


def labels(value: Optional[npt.ArrayLike], n: int, name: str) -> Optional[Ints]:
    """n labels, or none."""
    if value is None:
        return None
    given = np.asarray(value)
    if given.shape != (n,):
        raise BadArgument(f"{name} has the shape {given.shape}; {n} labels are wanted")
    if given.dtype.kind not in "iubf":
        raise BadArgument(f"{name} is of {given.dtype}; whole numbers are wanted")
    with np.errstate(invalid="ignore"):
        array = np.ascontiguousarray(given, dtype=np.int32)
    if not np.array_equal(array, given):
        bad = int(np.argmax(array != given))
        raise BadArgument(f"{name}[{bad}] is {given[bad]}; whole numbers from -2^31 to 2^31 - 1 are wanted", (bad,))
    return array


def address(array: Optional[npt.NDArray[Any]]) -> Optional[int]:
    """Where an array begins; the caller keeps it alive."""
    return None if array is None else array.__array_interface__["data"][0]


class Rows:
    """Memory of the library as an array that numpy takes without a copy; keeps its owner alive."""

    def __init__(self, owner: Any, data: int, shape: tuple[int, ...], dtype: npt.DTypeLike) -> None:
        self._owner = owner
        self.__array_interface__ = {
            "data": (data, True), "shape": shape, "typestr": np.dtype(dtype).str, "version": 3}


class Asking:
    """A callback that ends maintenance: where the caller's `should_stop` says so or raises, and at Ctrl-C.

    `with Asking(should_stop) as callback:` around the call; what came is raised at the end of the block. While it lasts,
    Ctrl-C is only noted: raised anywhere in a callback it would be lost, since C cannot hand it on.
    """

    def __init__(self, should_stop: Optional[Callable[[], bool]]) -> None:
        self._should_stop = should_stop
        self._error: Optional[BaseException] = None
        self._interrupted = False
        self._handler: Any = None  # of Ctrl-C before

    def __enter__(self) -> Any:
        # Python hears of signals in the main thread alone, and only while it runs Python.
        if threading.current_thread() is threading.main_thread():
            handler = signal.getsignal(signal.SIGINT)
            if callable(handler):
                signal.signal(signal.SIGINT, self._note)
                self._handler = handler
        if self._should_stop is None and self._handler is None:
            return _c.incise_should_stop()
        return _c.incise_should_stop(self._ask)

    def _note(self, _number: int, _frame: Any) -> None:
        self._interrupted = True

    def _ask(self, _user: Any) -> int:
        try:
            stops = self._should_stop is not None and self._should_stop()
        except BaseException as error:
            self._error = error
            return 1
        return 1 if stops or self._interrupted else 0

    def __exit__(self, kind: Any, error: Any, trace: Any) -> None:
        if self._handler is not None:
            signal.signal(signal.SIGINT, self._handler)
            if self._interrupted:
                self._handler(signal.SIGINT, None)  # as if it came now: raises KeyboardInterrupt, unless told otherwise
        if self._error is not None and error is None:
            raise self._error


def lines(text: str) -> Iterator[str]:
    """Lines that are not empty."""
    return (line for line in text.split("\n") if line)


def path_bytes(path: Path) -> bytes:
    """A path for C."""
    return _without_nul(os.fsencode(os.fspath(path)), "the path")


def text_bytes(text: str, name: str) -> bytes:
    """A text for C."""
    return _without_nul(text.encode(), name)


def _without_nul(content: bytes, name: str) -> bytes:
    if b"\0" in content:  # C would take what stands before it: another file
        raise BadArgument(f"{name} is {content!r}; there must be no null character in it")
    return content


def null() -> ctypes.c_void_p:
    """A place for a handle."""
    return ctypes.c_void_p()
