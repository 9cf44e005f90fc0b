# SPDX-License-Identifier: Apache-2.0
"""What goes wrong in bindings to a library with memory, threads and callbacks of its own, and does not here."""
import gc
import os
import resource
import signal
import subprocess
import sys
import threading
import time
import weakref

import numpy as np
import pytest

import incise

UNDER_A_LIMIT = """
import resource
import numpy as np
import incise
used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (used + 2**31, used + 2**31))
engine = incise.box((6, 6, 6))
assert not engine.views_are_stable, "the arrays cannot be reserved, and stay where they are"
rest = engine.rest
kept, base = rest.copy(), rest.base
assert not rest.flags.writeable
for offset in (0.2, 0.4, 0.6, 0.8):
    engine.cut_plane((1, 0.1, 0.2), offset)
assert np.array_equal(rest, kept), "a copy does not change"
assert len(engine.rest) > len(rest) and engine.validate()
print("%016x" % engine.hash)
"""


def test_views_do_not_dangle_where_arrays_move():
    """Trap 1: under a limit on address space arrays move when they grow: views are copies then."""
    run = subprocess.run([sys.executable, "-c", UNDER_A_LIMIT], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    engine = incise.box((6, 6, 6))
    assert engine.views_are_stable
    for offset in (0.2, 0.4, 0.6, 0.8):
        engine.cut_plane((1, 0.1, 0.2), offset)
    assert run.stdout.strip() == "%016x" % engine.hash, "the result does not depend on it"


def resident_bytes():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


def test_a_thousand_engines_leave_nothing_behind():
    """Trap 2: each engine reserves address space. It is given back, and memory does not grow."""
    for _ in range(50):
        incise.box((2, 2, 2)).cut_plane((1, 0, 0), 0.4)
    gc.collect()
    before = resident_bytes()
    for _ in range(1000):
        engine = incise.box((2, 2, 2))
        engine.cut_plane((1, 0, 0), 0.4)
        assert engine.rest[0, 0] == 0
    del engine
    gc.collect()
    assert resident_bytes() - before < 8 * 2**20


def test_three_hundred_engines_live_side_by_side():
    engines = [incise.box((2, 2, 2)) for _ in range(300)]
    assert sum(engine.tet_count for engine in engines) == 300 * 48


def rough_box(n):
    box = incise.box((n, n, n)).compact()
    shift = np.random.default_rng(1).uniform(-0.1 / n, 0.1 / n, box.points.shape)
    return incise.Engine(box.points + shift, box.tets)


def test_ctrl_c_ends_maintenance_and_is_not_lost():
    """Trap 3: the library may ask again after it was told to stop."""
    engine = rough_box(24)
    timer = threading.Timer(0.05, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        while time.monotonic() - began < 60:
            engine.improve()
    timer.join()
    assert engine.validate()
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler, "Ctrl-C is as it was"


def hanging_box(n):
    box = incise.box((n, n, n)).compact()
    body = incise.Simulation(box.points, box.tets, length_unit=0.1, materials=incise.Material(young=5e3))
    body.hold(body.find(lambda rest: rest[:, 2] == 1))
    return body


def test_ctrl_c_ends_settling_between_two_frames():
    body = hanging_box(12)
    timer = threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        body.settle(2**31, 0.0)
    timer.join()
    assert np.isfinite(body.frame().fastest)


def test_settling_stops_where_told_to():
    asked = []

    def stop_at_fourth():
        asked.append(1)
        return len(asked) == 4

    body, other = hanging_box(3), hanging_box(3)
    assert body.settle(100, 0.0, stop_at_fourth) == 3 and other.settle(3, 0.0) == 3
    assert body.hash == other.hash and len(asked) == 4
    with pytest.raises(ZeroDivisionError):
        body.settle(100, 0.0, lambda: 1 // 0)


CROSSING = [(-0.2, 0.5), (1.2, 0.5), (1.3, 1.3), (0.5, 1.2), (0.5, -0.2)]  # a way that meets itself: it is told of


def test_what_comes_while_c_computes_comes_out_of_the_call(capfd):
    """Python runs the handlers of signals at the beginning of the next callback, where nothing can catch what they raise;
    C cannot hand it on, and ctypes prints and forgets it."""
    def late(*_):
        raise TimeoutError

    heard, stroke = [], [[(x, y, -0.5), (x, y, 1.5)] for x, y in CROSSING]
    engine, rough = incise.box((12, 12, 12), log=lambda level, text: heard.append(text)), rough_box(24)
    values, scene = incise.Attributes(incise.box((20, 20, 20))), {
        "format": "incise-scene", "version": 1, "model": {"box": {"cells": [9, 9, 9]}}, "length_unit": 0.1,
        "settle": {"frames": 10_000, "speed": 1e-12}}
    previous = signal.signal(signal.SIGALRM, late)
    try:
        for call in (lambda: engine.cut(stroke), lambda: rough.improve(), lambda: rough.improve(lambda: False),
                     lambda: values.add("one", "tets", "recompute", recompute=lambda slot: 1.0),
                     lambda: incise.Simulation.from_scene(scene)):
            with pytest.raises(TimeoutError):
                signal.setitimer(signal.ITIMER_REAL, 0.002)
                end = time.monotonic() + 60
                while time.monotonic() < end:
                    call()
                    rough.undo()
            assert signal.getsignal(signal.SIGALRM) is late
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, previous)
    assert capfd.readouterr().err == "" and engine.validate() and rough.validate()


def test_handlers_that_raise_nothing_end_nothing():
    came, engine = [], rough_box(8)
    previous = signal.signal(signal.SIGINT, lambda number, _frame: came.append(number))
    try:
        def interrupt_once():
            if not came:
                signal.raise_signal(signal.SIGINT)
            return False

        done, other = engine.improve(interrupt_once), rough_box(8)
        other.improve()
    finally:
        signal.signal(signal.SIGINT, previous)
    assert came == [signal.SIGINT] and done.waiting_tets == 0 and engine.hash == other.hash


def test_what_a_listener_raises_comes_out_of_the_call():
    def interrupted(_level, _text):
        raise KeyboardInterrupt

    stroke, heard = [[(x, y, -0.5), (x, y, 1.5)] for x, y in CROSSING], []
    engine = incise.box((4, 4, 4), log=interrupted)
    with pytest.raises(KeyboardInterrupt):
        engine.cut(stroke)
    assert engine.stroke_count == 1 and engine.validate(), "it was cut all the same, and nothing is raised twice"
    other = incise.box((4, 4, 4), log=lambda level, text: heard.append((level, text)))
    other.cut(stroke)
    assert len(heard) == 1 and "meets itself" in heard[0][1] and other.hash == engine.hash


def test_who_said_stop_is_not_asked_again():
    asked = []

    def stop_at_third():
        asked.append(1)
        return len(asked) == 3

    rough_box(8).improve(stop_at_third)
    assert len(asked) == 3


def test_a_second_thread_gets_an_error():
    """Trap 4: an engine is for one thread at a time."""
    engine = incise.box((6, 6, 6))
    entered, may_go, results = threading.Event(), threading.Event(), []

    def wait():
        entered.set()
        may_go.wait(30)
        return True

    worker = threading.Thread(target=lambda: results.append(engine.improve(wait)))
    worker.start()
    assert entered.wait(30)
    with pytest.raises(incise.Busy, match="one thread"):
        engine.cut_plane((1, 0, 0), 0.5)
    with pytest.raises(incise.Busy):
        engine.hash
    other = incise.box((3, 3, 3))
    assert other.cut_plane((1, 0, 0), 0.5).stroke == 1
    may_go.set()
    worker.join()
    assert len(results) == 1 and engine.cut_plane((1, 0, 0), 0.5).stroke == 1


def test_callbacks_cannot_call_their_engine():
    engine = incise.box((4, 4, 4))
    with pytest.raises(incise.Busy):
        engine.improve(lambda: engine.undo())


def test_engines_of_several_threads_run_side_by_side():
    """The interpreter's lock is released: all give the result of one alone."""
    def cut(results, index):
        engine = incise.box((8, 8, 8))
        for offset in (0.3, 0.6):
            engine.cut_plane((1, 0.2, 0.1), offset)
        results[index] = engine.hash

    results = [0] * 4
    threads = [threading.Thread(target=cut, args=(results, index)) for index in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(set(results)) == 1 and results[0]

def test_meshio_reads_our_msh(tmp_path):
    """Trap 5: meshio and others read MSH 4.1, with regions as physical groups."""
    meshio = pytest.importorskip("meshio")
    cube = incise.box((3, 3, 3)).compact()
    regions = (cube.points[cube.tets].mean(axis=1)[:, 0] > 0.5).astype(int) + 4
    engine = incise.Engine(cube.points, cube.tets, regions)
    engine.cut_plane((0.1, 1, 0), 0.5)
    engine.write(tmp_path / "cut.msh")
    mesh = meshio.read(tmp_path / "cut.msh")
    tets = [index for index, block in enumerate(mesh.cells) if block.type == "tetra"]
    assert sum(len(mesh.cells[index].data) for index in tets) == engine.tet_count
    labels = np.concatenate([mesh.cell_data["gmsh:physical"][index] for index in tets])
    assert sorted(labels.tolist()) == sorted(engine.compact().regions.tolist())
    assert incise.read(tmp_path / "cut.msh").tet_count == engine.tet_count
    assert incise.Engine.from_meshio(mesh).tet_count == engine.tet_count


def test_an_engine_that_tells_its_owner_goes_with_it():
    class Owner:
        def __init__(self):
            self.engine = incise.box((2, 2, 2), log=self.on_log)

        def on_log(self, level, text):
            pass

    owners = []
    for _ in range(20):
        owner = Owner()
        owners.append(weakref.ref(owner))
        del owner
    gc.collect()
    assert sum(owner() is not None for owner in owners) == 0


def test_a_stroke_under_way_outlives_a_stroke_that_was_refused():
    engine = incise.box((4, 4, 4))
    engine.begin_stroke([(0.55, -1, 1.2), (0.55, 2, 1.2)])
    engine.step([(0.55, -1, 0.5), (0.55, 2, 0.5)])
    cut = engine.hash
    with pytest.raises(incise.BadArgument, match="under way"):
        engine.cut_along([[(0.3, -1, 1.2), (0.3, 2, 1.2)], [(0.3, -1, 0.5), (0.3, 2, 0.5)]])
    assert engine.is_in_stroke and engine.hash == cut


def test_a_program_may_end_while_a_daemon_is_called_back():
    program = """
import sys, threading, time, incise
engine = incise.box((30, 30, 30))
engine.cut_plane((1, 0.2, 0.1), 0.6)
def work():
    while True:
        engine.improve(lambda: False)
threading.Thread(target=work, daemon=True).start()
time.sleep(0.2)
sys.exit(3)
"""
    for _ in range(3):
        ended = subprocess.run([sys.executable, "-c", program], capture_output=True, timeout=120)
        assert ended.returncode == 3, ended.stderr.decode()
