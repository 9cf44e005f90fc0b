# SPDX-License-Identifier: Apache-2.0
"""The recorded corpus: what was recorded from C++ comes out of Python with the same hash after every call."""
import base64
import json
from pathlib import Path

import numpy as np
import pytest

import incise

RECORDINGS = sorted((Path(__file__).parents[1] / "recordings").glob("*.jsonl"))


def stop_at(ask):
    asked = [0]

    def should_stop():
        asked[0] += 1
        return asked[0] >= ask

    return None if ask is None else should_stop


def play(engine, call):
    kind = call["call"]
    if kind == "begin":
        engine.begin_stroke(call["edge"], call.get("direction"))
    elif kind == "step":
        engine.step(call["edge"], call.get("direction"))
    elif kind == "end":
        engine.end_stroke()
    elif kind == "cut":
        engine.cut(incise.Stroke(call["edges"], call["times"], call.get("name", "")))
    elif kind == "positions":
        engine.set_positions(np.frombuffer(base64.b64decode(call["base64"])).reshape(-1, 3))
    elif kind == "maintain":
        engine.maintain(call["limit"], stop_at(call.get("stop_ask")))
    else:
        assert kind in ("undo", "redo", "improve")
        getattr(engine, kind)()


@pytest.mark.parametrize("path", RECORDINGS, ids=lambda path: path.stem)
def test_the_hash_is_that_of_cpp_after_every_call(path):
    with open(path, encoding="utf-8") as lines:
        header, *calls = [json.loads(line) for line in lines]
    options = {name: header["options"][name] for name in ("profile", "snap", "merge", "improve", "work_units")}
    engine = incise.read(path.parent / header["mesh"]["file"], **options)
    assert "%016x" % engine.hash == header["mesh"]["hash"]
    for number, call in enumerate(calls, 2):
        play(engine, call)
        assert "%016x" % engine.hash == call["hash"], "line %d" % number
    assert len(calls) >= 20


def test_there_is_a_corpus():
    assert len(RECORDINGS) >= 2
