# SPDX-License-Identifier: Apache-2.0
"""What goes wrong, as exceptions: each is the built-in one that a Python programmer would look for, too."""
from __future__ import annotations

from typing import Any

from . import _c

_LONGEST, _END = 480, 160
_LONGEST_VALUE = 100


def shortened(text: str) -> str:
    """At most 480 characters, as the library's own messages have: the beginning, and with the remedy the end."""
    if len(text) <= _LONGEST:
        return text
    return text[:_LONGEST - _END - 5] + " ... " + text[-_END:]


def shown(value: Any) -> str:
    """A value as messages have it; of a long one the beginning."""
    text = repr(value)
    return text if len(text) <= _LONGEST_VALUE else text[:_LONGEST_VALUE - 4] + " ..."


class InciseError(Exception):
    """Something could not be done. `ids` are the elements concerned, a few at most; the message says what they are."""

    def __init__(self, message: str, ids: tuple[int, ...] = ()) -> None:
        super().__init__(shortened(message))
        self.ids = ids


class BadArgument(InciseError, ValueError):
    """An argument is outside its documented range."""


class BadFile(InciseError, OSError):
    """A file cannot be opened, or holds not what its format promises."""

    def __init__(self, message: str, ids: tuple[int, ...] = ()) -> None:
        InciseError.__init__(self, message, ids)


class Unsupported(InciseError, NotImplementedError):
    """Well formed, but of a kind that Incise does not handle."""


class OutOfMemory(InciseError, MemoryError):
    """An allocation or an id range would be exceeded."""


class WriteFailed(InciseError, OSError):
    """A file could not be written; none was left half-written."""

    def __init__(self, message: str, ids: tuple[int, ...] = ()) -> None:
        InciseError.__init__(self, message, ids)


class Internal(InciseError, RuntimeError):
    """A broken invariant: the step was rolled back. Please report it, with a recording."""


class Busy(InciseError, RuntimeError):
    """Another thread is in a call on this engine."""


OF_STATUS: dict[int, type[InciseError]] = {
    _c.BAD_ARGUMENT: BadArgument,
    _c.BAD_FILE: BadFile,
    _c.UNSUPPORTED: Unsupported,
    _c.OUT_OF_MEMORY: OutOfMemory,
    _c.IO: WriteFailed,
    _c.INTERNAL: Internal,
    _c.BUSY: Busy,
}
