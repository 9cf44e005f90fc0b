# SPDX-License-Identifier: Apache-2.0
"""Batches from Python: shards, restarts, merges, Ctrl-C, errors."""
import json
import os
import signal
import threading

import pytest

import incise
from incise import batch


@pytest.fixture(name="plan")
def make_plan(tmp_path):
    incise.box((4, 4, 4)).write(tmp_path / "box.mesh")
    plan = {"format": "incise-plan", "version": 1, "defaults": {"mesh": "box.mesh"},
            "items": [{"name": "half", "plane": [1, 0.2, 0, 0.5]},
                      {"name": "random", "repeat": 4, "random": {"seed": 3}}]}
    (tmp_path / "plan.json").write_text(json.dumps(plan))
    return tmp_path / "plan.json"


def test_results_do_not_depend_on_the_workers(plan, tmp_path):
    assert batch.run(plan, tmp_path / "one").done == 5
    for shard in ("1/2", (2, 2)):
        assert batch.run(plan, tmp_path / "two", shard).items in (2, 3)
    assert batch.merge(plan, tmp_path / "one").is_whole and batch.merge(plan, tmp_path / "two").is_whole
    assert (tmp_path / "one" / "results.jsonl").read_bytes() == (tmp_path / "two" / "results.jsonl").read_bytes()
    lines = batch.results(tmp_path / "two")
    assert [line["name"] for line in lines] == batch.names(plan)
    engine = incise.read(tmp_path / "box.mesh")
    engine.cut_plane((1, 0.2, 0), 0.5)
    assert lines[0]["hash"] == "%016x" % engine.hash
    assert batch.verify(plan, tmp_path / "two", items=5) == batch.Verification(5, batch.Told([], 0), False)


def test_a_plan_is_a_mapping_as_well(plan, tmp_path):
    content = json.loads(plan.read_text())
    assert batch.names(content, folder=tmp_path) == batch.names(plan)
    assert batch.run(content, tmp_path / "out", folder=tmp_path).done == 5
    assert batch.run(plan, tmp_path / "out").skipped == 5
    with pytest.raises(incise.BadArgument, match="folder"):
        batch.names(plan, folder=tmp_path)


def test_a_run_that_was_stopped_goes_on(plan, tmp_path):
    seen = []
    report = batch.run(plan, tmp_path / "out", progress=lambda done, total: seen.append((done, total)),
                       should_stop=lambda: len(seen) > 2)
    assert report.stopped and report.done == 2 and seen[:2] == [(0, 5), (1, 5)]
    found = batch.merge(plan, tmp_path / "out")
    assert not found.is_whole and len(found.missing) == 3
    assert not (tmp_path / "out" / "results.jsonl").exists()
    assert batch.run(plan, tmp_path / "out").done == 3
    assert batch.merge(plan, tmp_path / "out").is_whole


def test_what_a_callback_raises_comes_out(plan, tmp_path):
    def fails(done, _total):
        if done == 1:
            raise ZeroDivisionError("of the caller")

    with pytest.raises(ZeroDivisionError, match="of the caller"):
        batch.run(plan, tmp_path / "out", progress=fails)
    assert batch.run(plan, tmp_path / "out").skipped == 1

    def fails_at_the_end(done, total):
        if done == total:
            raise KeyError("too late to stop")

    with pytest.raises(KeyError):
        batch.verify(plan, tmp_path / "out", items=1, progress=fails_at_the_end)


def test_ctrl_c_ends_a_run_and_is_not_lost(plan, tmp_path):
    def interrupts(done, _total):
        if done == 2:
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        batch.run(plan, tmp_path / "out", progress=interrupts)
    assert 0 < batch.run(plan, tmp_path / "out").skipped < 5


def test_workers_are_threads_or_processes(plan, tmp_path):
    reports = [None] * 3

    def work(index):
        reports[index] = batch.run(plan, tmp_path / "out", (index, 3))

    workers = [threading.Thread(target=work, args=(index,)) for index in range(3)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert sum(report.done for report in reports) == 5
    assert batch.merge(plan, tmp_path / "out").is_whole


def test_an_item_that_fails_has_a_line(plan, tmp_path):
    content = json.loads(plan.read_text())
    (tmp_path / "bad.mesh").write_text("no mesh")
    content["items"].append({"name": "bad", "mesh": "bad.mesh", "plane": [1, 0, 0, 0.5]})
    report = batch.run(content, tmp_path / "out", folder=tmp_path)
    assert report.done == 6 and len(report.failed) == 1 and report.failed.first[0].startswith("bad: ")
    assert batch.merge(content, tmp_path / "out", folder=tmp_path).failed == 1
    assert "message" in batch.results(tmp_path / "out")[-1]["error"]


def test_errors_name_the_place(plan, tmp_path):
    content = json.loads(plan.read_text())
    content["items"][1]["randon"] = {}
    with pytest.raises(incise.BadFile, match=r"items\[1\]"):
        batch.names(content, folder=tmp_path)
    with pytest.raises(incise.BadFile):
        batch.names(tmp_path / "nowhere.json")
    for shard in ("3", "1/0", "4/3", (-1, 2), "a/b", (1, 2, 3), 7):
        with pytest.raises(incise.BadArgument, match="shard"):
            batch.run(plan, tmp_path / "out", shard)
    for call in (lambda: batch.run(plan, tmp_path / "out", threads=0), lambda: batch.run(plan, tmp_path / "out", threads=999),
                 lambda: batch.verify(plan, tmp_path / "out", items=0)):
        with pytest.raises(incise.BadArgument):
            call()
    batch.run(plan, tmp_path / "out", (0, 5))
    content = json.loads(plan.read_text())
    content["items"][0]["plane"][3] = 0.6
    with pytest.raises(incise.BadFile, match="another plan"):
        batch.run(content, tmp_path / "out", folder=tmp_path)
