# SPDX-License-Identifier: Apache-2.0
"""Batches: many cuts by a plan, by any number of workers that share a folder (docs/batches.md in the sources).

>>> import tempfile
>>> from incise import batch
>>> scene = {"format": "incise-scene", "version": 1, "length_unit": 0.1, "frames": 2,
...          "model": {"box": {"cells": [3, 3, 3]}}}
>>> plan = {"format": "incise-plan", "version": 1, "output": {"mesh": None, "before": False},
...         "items": [{"name": "cut", "repeat": 2, "scene": scene, "random": {"seed": 1}}]}
>>> batch.names(plan)
['cut-0000', 'cut-0001']
>>> out = tempfile.mkdtemp()
>>> [batch.run(plan, out, shard=(i, 2)).done for i in range(2)]
[1, 1]
>>> batch.merge(plan, out).is_whole
True
>>> [line["name"] for line in batch.results(out)]
['cut-0000', 'cut-0001']
>>> len(batch.verify(plan, out, items=1).differences)
0
"""
from __future__ import annotations

import ctypes
import json
import operator
import os
from ctypes import byref
from dataclasses import dataclass
from pathlib import Path as _Path
from typing import Any, Callable, Iterator, Mapping, Optional, Tuple, Union

from . import _c
from ._arrays import Asking, Path, Waiting, flag, listener, null, path_bytes, whole
from ._library import Handle, check, default, lib
from .errors import BadArgument

Plan = Union[Path, Mapping[str, Any]]
Shard = Union[str, Tuple[int, int]]
Progress = Callable[[int, int], None]


@dataclass(frozen=True)
class Told:
    """Lines about items: the first of them, at most 100. Its length is how many there are."""

    first: list[str]
    count: int

    def __len__(self) -> int:
        return self.count

    def __iter__(self) -> Iterator[str]:
        return iter(self.first)


@dataclass(frozen=True)
class Run:
    """What one worker did."""

    items: int  #: of the shard
    skipped: int  #: that were there before
    done: int  #: computed, those that failed included
    failed: Told  #: of those: "NAME: why"
    stopped: bool  #: by `should_stop`


@dataclass(frozen=True)
class Merge:
    """What a merge found; results.jsonl is written where `is_whole`."""

    is_whole: bool
    items: int
    shards: int  #: files that were read
    failed: int  #: items whose line says why they could not be computed
    repeated: int  #: lines of items that were computed more than once, with the same result
    missing: Told  #: items without a line
    contradictory: Told  #: items with different lines
    broken_files: Told  #: that a line names, and that are not as they were written


@dataclass(frozen=True)
class Verification:
    """What came of computing items again."""

    items: int  #: computed again
    differences: Told  #: "NAME: what differs"
    stopped: bool  #: by `should_stop`


def _read(plan: Plan, folder: Optional[Path]) -> Handle:
    pointer = null()
    if isinstance(plan, (str, os.PathLike)):
        if folder is not None:
            raise BadArgument("folder is for plans that are mappings; a plan's file has one")
        check(lib.incise_plan_read(path_bytes(plan), byref(pointer)))
    else:
        seen_from = None if folder is None else path_bytes(folder)
        check(lib.incise_plan_parse(json.dumps(plan).encode(), seen_from, byref(pointer)))
    return Handle(pointer, lib.incise_plan_free)


def _told(report: dict[str, Any], key: str) -> Told:
    return Told(report[key]["first"], report[key]["count"])


def _reported(call: Callable[[Any], Any]) -> dict[str, Any]:
    """The report of a call that takes a callback for it."""
    texts: list[bytes] = []
    check(call(_c.incise_told(lambda _user, text: texts.append(text))))
    report: dict[str, Any] = json.loads(texts[0])
    return report


def _computed(plan: Handle, out: Path, call: Any, options: Any, progress: Optional[Progress],
              should_stop: Optional[Callable[[], bool]]) -> dict[str, Any]:
    """Runs what takes long: Ctrl-C, and what a callback raises, ends it between two items, or two frames."""
    listener(progress, "progress")
    listener(should_stop, "should_stop")
    raised: list[BaseException] = []

    def tell(_user: Any, done: int, total: int) -> None:
        try:
            if progress is not None and not raised:
                progress(done, total)
        except BaseException as error:
            raised.append(error)

    def stops() -> bool:
        if raised:
            raise raised[0]
        return should_stop is not None and should_stop()

    asks = progress is not None or should_stop is not None
    with Asking(stops if asks else None) as callback:
        if progress is not None:
            options.progress = _c.incise_progress(tell)
        options.should_stop = callback
        report = _reported(lambda told: call(plan.pointer, path_bytes(out), byref(options), told, None))
    if raised:  # after the last item nobody is asked
        raise raised[0]
    return report


def _options(threads: int) -> Any:
    options = default(_c.incise_batch_options, lib.incise_default_batch_options)
    options.threads = whole(threads, "threads", 1, 256)
    return options


def _shard(shard: Optional[Shard]) -> Tuple[int, int]:
    """I and N; "N/N" is "0/N", so that shards may be counted from 1."""
    if shard is None:
        return 0, 1
    try:
        parts: list[Any] = list(shard.split("/") if isinstance(shard, str) else shard)
        if isinstance(shard, str) and not all(part.isascii() and part.isdigit() for part in parts):
            raise ValueError
        if not isinstance(shard, str) and any(isinstance(part, bool) for part in parts):
            raise TypeError
        index, count = (int(part) if isinstance(part, str) else operator.index(part) for part in parts)
    except (TypeError, ValueError):
        raise BadArgument(f"shard is {shard!r}; \"I/N\" or (I, N) is wanted") from None
    if not (1 <= count < 100_000 and 0 <= index <= count):
        raise BadArgument(f"shard is {shard!r}; of (I, N), N lies in [1, 99999] and I in [0, N]")
    return index % count, count


def names(plan: Plan, folder: Optional[Path] = None) -> list[str]:
    """The names of a plan's items: its file, or its content as a mapping (files that it names are then seen from
    `folder`). Raises `BadFile`, with the place in the plan, where it is not sound."""
    handle, count = _read(plan, folder), ctypes.c_uint64()
    check(lib.incise_plan_count(handle.pointer, byref(count)))
    found = []
    for item in range(count.value):
        text = ctypes.create_string_buffer(256)
        check(lib.incise_plan_name(handle.pointer, item, text, len(text), None))
        found.append(text.value.decode())
    return found


def run(plan: Plan, out: Path, shard: Optional[Shard] = None, *, threads: int = 1, retry: bool = False,
        progress: Optional[Progress] = None, should_stop: Optional[Callable[[], bool]] = None,
        folder: Optional[Path] = None) -> Run:
    """Computes the items of a shard that no worker has done yet; `incise batch plan -o out --shard I/N`.

    shard: "I/N" or (I, N); all items where it is None. progress(done, total) is called before each item and after the
    last. Ctrl-C, and whatever a callback raises, ends it: what is done stays, and the next run goes on there.
    """
    options = _options(threads)
    options.shard_index, options.shard_count = _shard(shard)
    options.retry = flag(retry, "retry")
    report = _computed(_read(plan, folder), out, lib.incise_batch_run, options, progress, should_stop)
    return Run(report["items"], report["skipped"], report["done"], _told(report, "failed"), report["stopped"])


def merge(plan: Plan, out: Path, folder: Optional[Path] = None) -> Merge:
    """Writes out/results.jsonl, in the order of the plan, where each item has one result and all files are there."""
    handle = _read(plan, folder)
    with Waiting():
        report = _reported(lambda told: lib.incise_batch_merge(handle.pointer, path_bytes(out), told, None))
    return Merge(report["ok"], report["items"], report["shards"], report["failed"], report["repeated"],
                 _told(report, "missing"), _told(report, "contradictory"), _told(report, "broken_files"))


def verify(plan: Plan, out: Path, items: int = 1, seed: int = 0, *, threads: int = 1,
           progress: Optional[Progress] = None, should_stop: Optional[Callable[[], bool]] = None,
           folder: Optional[Path] = None) -> Verification:
    """Computes `items` items again, which `seed` chooses, and compares their lines."""
    options = _options(threads)
    options.verify_items = whole(items, "items", 1, 2**64 - 1)
    options.verify_seed = whole(seed, "seed", 0, 2**64 - 1)
    report = _computed(_read(plan, folder), out, lib.incise_batch_verify, options, progress, should_stop)
    return Verification(report["items"], _told(report, "differences"), report["stopped"])


def results(out: Path) -> list[dict[str, Any]]:
    """The lines of out/results.jsonl, as `merge` wrote it: docs/batches.md has their fields."""
    text = _Path(os.fspath(out), "results.jsonl").read_text(encoding="utf-8")
    return [json.loads(line) for line in text.splitlines()]
