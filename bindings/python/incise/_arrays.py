# SPDX-License-Identifier: Apache-2.0
"""Between numpy and C."""
from __future__ import annotations

import ctypes
import operator
import os
import signal
import threading
from contextlib import nullcontext
from typing import Any, Callable, ContextManager, Iterator, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _c
from .errors import BadArgument, shown

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int32]
Slots = npt.NDArray[np.uint32]
Bytes = npt.NDArray[np.uint8]
Path = Union[str, "os.PathLike[str]"]
_SIGNALS = sorted(signal.valid_signals())
_AT_ONCE: "ContextManager[Any]" = nullcontext()


def _for_c(array: npt.NDArray[Any], kind: npt.DTypeLike) -> npt.NDArray[Any]:
    """Row by row, and where such numbers may begin: an array over bytes of a file may begin anywhere."""
    return np.require(array, kind, ("C", "A"))


def _hides(value: Any) -> bool:
    """Whether elements are hidden behind a mask, however deep in lists."""
    if not isinstance(value, (list, tuple)):
        return isinstance(value, np.ma.MaskedArray) and bool(np.ma.is_masked(value))  # type: ignore[no-untyped-call]
    for part in value:
        if type(part) is not float and _hides(part):  # the usual ones: each step of a blade comes by here
            return True
    return False


def plain(value: npt.ArrayLike, name: str) -> npt.NDArray[Any]:
    """As an array of numpy; what hides elements behind a mask is refused: C would take what is hidden. So are lists of
    different lengths, of which no array can be made."""
    if _hides(value):
        raise BadArgument(f"{name} has masked elements; fill them, or leave them out")
    try:
        return np.asarray(value)
    except ValueError as error:
        raise BadArgument(f"{name} cannot be made an array of: {error}; rows of the same length are wanted") from None


def real(value: npt.ArrayLike, name: str) -> Floats:
    """Real numbers, as C wants them; a single one becomes a list of one."""
    array = np.ascontiguousarray(value if type(value) is np.ndarray else plain(value, name))
    kind = array.dtype
    if kind.char == "d" and kind.isnative and array.flags.aligned:  # the usual one: each step of a blade comes by here
        return array
    if kind.kind not in "biufO":  # of complex ones numpy would drop half, and warn; dates and texts it would turn
        raise BadArgument(f"{name} is of {kind}; real numbers are wanted")
    try:
        return _for_c(array, np.float64)
    except ValueError as error:  # of objects
        raise BadArgument(f"{name} are no real numbers: {error}") from None


def number(value: Any, name: str) -> float:
    """One real number: of a text `float` would read it, or raise what names no argument."""
    if isinstance(value, (str, bytes, bytearray)):
        raise TypeError(f"{name} is {shown(value)}; a number is wanted")
    try:
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name} is {shown(value)}; a number is wanted") from None


def spread(value: npt.ArrayLike, shape: tuple[int, ...], name: str) -> Floats:
    """Real numbers of a shape, or fewer that numpy repeats to it."""
    array = real(value, name)
    try:
        return np.broadcast_to(array, shape)
    except ValueError:
        raise BadArgument(f"{name} has the shape {array.shape}; {' x '.join(map(str, shape))} is wanted") from None


def whole(value: Any, name: str, least: int, most: int) -> int:
    """A whole number in [least, most]: ctypes would take others modulo 2^32, or 2^64. A float is a TypeError."""
    number = operator.index(value)
    if not least <= number <= most:
        raise BadArgument(f"{name} is {number}; {least} to {most} are wanted")
    return number


def flag(value: Any, name: str) -> int:
    """Yes or no for C: a text would be yes, and 0.5 no."""
    if not isinstance(value, (bool, np.bool_)) and not (isinstance(value, (int, np.integer)) and value in (0, 1)):
        raise TypeError(f"{name} is {shown(value)}; True or False is wanted")
    return int(value)


def poses(value: npt.ArrayLike, name: str) -> Floats:
    """n x m x 3 numbers: an edge of m points at n times."""
    array = real(value, name)
    if array.ndim != 3 or array.shape[2] != 3:
        raise BadArgument(f"{name} have the shape {array.shape}; n_times x n_points x 3 is wanted")
    return array


def numbers(value: npt.ArrayLike, n: int, name: str) -> Floats:
    """n numbers."""
    array = real(value, name)
    if array.shape != (n,):
        raise BadArgument(f"{name} has the shape {array.shape}; {n} numbers are wanted")
    return array


def points(value: npt.ArrayLike, name: str = "points") -> Floats:
    """n x 3 numbers, as C wants them; no copy where they are that already."""
    array = real(value, name)
    if array.ndim != 2 or array.shape[1] != 3:
        raise BadArgument(f"{name} has the shape {array.shape}; n x 3 is wanted")
    return array


def vector(value: npt.ArrayLike, name: str) -> Floats:
    """Three numbers."""
    return numbers(value, 3, name)


def indices(value: npt.ArrayLike, width: int, name: str) -> Slots:
    """n x width whole numbers that 32 bits hold; no copy where they are uint32 already."""
    array = plain(value, name)
    if array.size == 0:
        array = array.reshape(0, width)
    if array.ndim != 2 or array.shape[1] != width:
        raise BadArgument(f"{name} has the shape {array.shape}; n x {width} is wanted")
    if array.dtype == np.uint32:
        return _for_c(array, np.uint32)
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
    given = plain(value, name)
    if given.shape != (n,):
        raise BadArgument(f"{name} has the shape {given.shape}; {n} labels are wanted")
    if given.dtype.kind not in "iubf":
        raise BadArgument(f"{name} is of {given.dtype}; whole numbers are wanted")
    with np.errstate(invalid="ignore"):
        array = _for_c(given, np.int32)
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


class Waiting:
    """While it lasts, signals wait. `with Waiting():` around calls that call back.

    Their handlers run at its end. Python would run them, most of all at the very beginning of a callback, where nothing
    can catch what they raise: C cannot hand it on, and Ctrl-C would be printed and forgotten.
    """

    def __init__(self) -> None:
        self._handlers: dict[int, Callable[[int, Any], Any]] = {}
        self._noted: list[tuple[int, Any]] = []

    def __enter__(self) -> Any:
        # Python hears of signals in the main thread alone, and only while it runs Python.
        if threading.current_thread() is threading.main_thread():
            try:
                for number in _SIGNALS:
                    handler = signal.getsignal(number)
                    if callable(handler):
                        self._handlers[number] = handler
                        signal.signal(number, self._note)
            except BaseException:  # of a handler whose turn had not come
                self._restore()
                raise
        return self

    def _note(self, number: int, frame: Any) -> None:
        self._noted.append((number, frame))

    def _handle(self) -> None:
        """Runs the handlers of what came; raises what they raise."""
        while self._noted:
            number, frame = self._noted.pop(0)
            self._handlers[number](number, frame)

    def __exit__(self, kind: Any, error: Any, trace: Any) -> None:
        self._restore()
        self._handle()

    def _restore(self) -> None:
        """Puts the handlers back, but where a callback has chosen another one, even if one that is back raises."""
        raised: Optional[BaseException] = None
        while any(signal.getsignal(number) == self._note for number in self._handlers):
            try:
                for number, handler in self._handlers.items():
                    if signal.getsignal(number) == self._note:
                        signal.signal(number, handler)
            except BaseException as error:
                raised = raised or error
        if raised is not None:
            raise raised


def waiting(wants: bool) -> "ContextManager[Any]":
    """`Waiting` where something may call back."""
    return Waiting() if wants else _AT_ONCE


class Asking(Waiting):
    """A callback that ends what takes long: where the caller's `should_stop` says so or raises, and where a signal's
    handler raises, as that of Ctrl-C does.

    `with Asking(should_stop) as callback:` around the call; what was raised is raised again at the end of the block.
    """

    def __init__(self, should_stop: Optional[Callable[[], bool]]) -> None:
        super().__init__()
        listener(should_stop, "should_stop")
        self._should_stop = should_stop
        self._error: Optional[BaseException] = None

    def __enter__(self) -> Any:
        super().__enter__()
        if self._should_stop is None and not self._handlers:
            return _c.incise_should_stop()
        return _c.incise_should_stop(self._ask)

    def _ask(self, _user: Any) -> int:
        try:
            self._handle()
            return 1 if self._should_stop is not None and self._should_stop() else 0
        except BaseException as error:
            self._error = error
            return 1

    def __exit__(self, kind: Any, error: Any, trace: Any) -> None:
        super().__exit__(kind, error, trace)
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
    if not isinstance(text, str):
        raise TypeError(f"{name} is {shown(text)}; a text is wanted")
    try:
        return _without_nul(text.encode(), name)
    except UnicodeEncodeError:
        raise BadArgument(f"{name} is {shown(text)}; it has half of a character in it") from None


def listener(function: Optional[Callable[..., Any]], name: str) -> None:
    """Refuses what cannot be called; none is fine."""
    if function is not None and not callable(function):
        raise TypeError(f"{name} is {shown(function)}; a function is wanted")


def _without_nul(content: bytes, name: str) -> bytes:
    if b"\0" in content:  # C would take what stands before it: another file
        raise BadArgument(f"{name} is {shown(content)}; there must be no null character in it")
    return content


def null() -> ctypes.c_void_p:
    """A place for a handle."""
    return ctypes.c_void_p()
