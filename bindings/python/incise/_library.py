# SPDX-License-Identifier: Apache-2.0
"""Finds libincise, and makes calls of it: errors become exceptions, structs know their sizes."""
from __future__ import annotations

import ctypes
import ctypes.util
import os
import threading
from pathlib import Path
from typing import Any, Callable, Type, TypeVar

from . import _c, errors

_Struct = TypeVar("_Struct", bound=ctypes.Structure)


def _candidates() -> list[str]:
    """Where the library may be: where $INCISE_LIBRARY says, beside this file, where the system looks."""
    given = os.environ.get("INCISE_LIBRARY")
    if given:
        return [given]
    beside = Path(__file__).with_name("libincise.so.0")
    return [str(beside)] if beside.exists() else ["libincise.so.0"]


def _load() -> ctypes.CDLL:
    path = _candidates()[0]
    try:
        library = ctypes.CDLL(path)
    except OSError as error:
        raise ImportError(
            f"libincise.so.0 cannot be loaded ({error}); install the wheel, or let INCISE_LIBRARY name the library"
        ) from None
    _c.declare(library)
    if library.incise_abi() != _c.ABI:
        raise ImportError(f"{path} has the binary interface {library.incise_abi()}, this package wants {_c.ABI}")
    return library


lib = _load()


class _Raised(threading.local):
    """What callbacks raised on this thread, which C cannot hand on; Ctrl-C may come in any of them."""

    def __init__(self) -> None:
        self.errors: list[BaseException] = []


raised = _Raised()


def hear(listener: Callable[..., Any], *words: Any) -> None:
    """Calls a listener from within a call; what it raises waits for `check`."""
    try:
        listener(*words)
    except BaseException as error:
        raised.errors.append(error)


def check(status: int) -> None:
    """Raises what a call failed with, or what a listener of it raised."""
    if raised.errors:
        error = raised.errors[0]
        raised.errors.clear()
        raise error
    if status == _c.OK:
        return
    count = lib.incise_last_error_ids(None, 0)
    ids = (ctypes.c_uint64 * count)()
    lib.incise_last_error_ids(ids, count)
    message = lib.incise_last_error().decode(errors="replace")
    raise errors.OF_STATUS.get(status, errors.InciseError)(message, tuple(ids))


def sized(kind: Type[_Struct]) -> _Struct:
    """A struct with its size, everything else zero."""
    value = kind()
    value.size = ctypes.sizeof(kind)
    return value


def default(kind: Type[_Struct], call: Any) -> _Struct:
    """A struct of options as the library has them."""
    value = kind()
    check(call(ctypes.byref(value), ctypes.sizeof(kind)))
    return value


class Handle:
    """Owns what the library made, and frees it when the last one who looks at it is gone."""

    pointer = ctypes.c_void_p()

    def __init__(self, pointer: ctypes.c_void_p, free: Any, keeps: Any = None) -> None:
        self.pointer = pointer
        self._free = free
        self._keeps = keeps  # what the library calls back: as long as it may, and in reach of the collector of cycles

    def __del__(self) -> None:
        if self.pointer:
            self._free(self.pointer)

    def __reduce__(self) -> Any:
        raise TypeError("what the library holds cannot be copied deeply, nor pickled: send its arrays, or its bytes "
                        "(compact(), to_bytes())")


def version() -> str:
    """The library's version, for instance "0.1.0"."""
    text: bytes = lib.incise_version()
    return text.decode()
