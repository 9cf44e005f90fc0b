# SPDX-License-Identifier: Apache-2.0
"""What people do with a library that they have not read about: errors, never another result or a crash."""
import copy
import math
import os
import pickle
import re
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

import incise

CUBE = incise.box((3, 3, 3)).compact()
STROKE = np.array([[[0.4, -1, -1], [0.4, -1, 2]], [[0.4, 2, -1], [0.5, 2, 2]]])
PLAN = {"format": "incise-plan", "version": 1,
        "items": [{"scene": {"format": "incise-scene", "version": 1, "model": {"box": {"cells": [1, 1, 1]}}, "length_unit": 1, "frames": 1},
                   "random": {}}]}
SYMBOLS = Path(__file__).parents[1] / "c" / "symbols.txt"


def body(**options):
    return incise.Simulation(CUBE.points, CUBE.tets, length_unit=0.1, **options)


@pytest.mark.parametrize("regions", [
    [1.5] * 162, [math.nan] * 162, [2**31] * 162, [-2**31 - 1] * 162, ["a"] * 162, [1j] * 162, [1] * 161, [[1]] * 162])
def test_labels_are_whole_numbers_that_c_can_hold(regions):
    with pytest.raises(incise.BadArgument):
        incise.Engine(CUBE.points, CUBE.tets, regions)


@pytest.mark.parametrize("regions", [[4.0] * 162, [True] * 162, np.full(162, -2**31), np.full(162, 7, np.uint8)])
def test_labels_may_be_of_any_kind_that_is_whole(regions):
    assert incise.Engine(CUBE.points, CUBE.tets, regions).regions[0] == regions[0]


def test_points_are_real():
    with pytest.raises(incise.BadArgument, match="complex"):
        incise.Engine(CUBE.points.astype(complex), CUBE.tets)
    with pytest.raises(incise.BadArgument, match="complex"):
        incise.box((2, 2, 2)).cut_plane((1j, 0, 0), 0.5)


def test_arrays_may_lie_in_memory_as_they_like():
    whole = incise.Engine(CUBE.points, CUBE.tets).hash
    for points, tets in ((np.repeat(CUBE.points, 2, axis=0)[::2], np.repeat(CUBE.tets, 3, axis=1)[:, ::3]),
                         (CUBE.points.astype(">f8"), CUBE.tets.astype(">i8")),
                         (np.ascontiguousarray(CUBE.points[::-1])[::-1], CUBE.tets)):
        assert incise.Engine(points, tets).hash == whole


def shifted(array):
    """The same array, beginning at an odd address, as in bytes that were read from a file."""
    raw = np.zeros(array.nbytes + 1, np.uint8)
    raw[1:] = np.frombuffer(array.tobytes(), np.uint8)
    moved = raw[1:].view(array.dtype).reshape(array.shape)
    assert not moved.flags.aligned and moved.flags.c_contiguous
    return moved


def test_arrays_that_begin_at_odd_addresses_are_copied():
    regions = np.arange(len(CUBE.tets), dtype=np.int32)
    engines = [incise.Engine(change(CUBE.points), change(CUBE.tets), change(regions)) for change in (np.copy, shifted)]
    stroke = np.array([[[0.4, -1, -1], [0.4, -1, 2]], [[0.4, 2, -1], [0.5, 2, 2]]])
    engines[0].cut(stroke)
    engines[1].cut(incise.Stroke(shifted(stroke), times=shifted(np.array([0.0, 1.0]))))
    assert engines[0].hash == engines[1].hash
    for array, kind in ((CUBE.points, "points"), (CUBE.tets, "tets"), (regions, "regions")):
        taken = {"points": incise._arrays.points, "tets": lambda tets: incise._arrays.indices(tets, 4, "tets"),
                 "regions": lambda labels: incise._arrays.labels(labels, len(labels), "regions")}[kind](shifted(array))
        assert taken.flags.aligned and np.array_equal(taken, array)


def test_what_holds_bytes_is_a_file():
    content = incise.box((2, 2, 2)).to_bytes(".mesh")
    for given in (bytearray(content), memoryview(content), np.frombuffer(content, np.uint8)):
        assert incise.Engine.from_bytes(given).hash == incise.Engine.from_bytes(content).hash
    with pytest.raises(TypeError):  # ctypes would take its memory
        incise.Engine.from_bytes(content.decode())


@pytest.mark.parametrize("kind", ["M8[s]", "m8[s]", "U8", "S8"])
def test_dates_and_texts_are_no_places(kind):
    with pytest.raises(incise.BadArgument, match="real numbers"):
        incise.Engine(np.zeros((4, 3)).astype(kind), [[0, 1, 2, 3]])


def test_complex_strokes_are_refused():
    stroke = np.array([[[0.4, -1, -1], [0.4, -1, 2]], [[0.4, 2, -1], [0.5, 2, 2]]])
    for given in (stroke + 1j, incise.Stroke(stroke, times=[0j, 1j])):
        with pytest.raises(incise.BadArgument, match="complex"):
            incise.box((2, 2, 2)).cut(given)


def test_numbers_of_numpy_are_numbers():
    engine = incise.box(np.array((3, 3, 3)), threads=np.int64(1), work_units=np.uint64(10**6))
    engine.cut_plane((1, 0.2, 0), np.float32(0.5))
    assert engine.validate(most=np.int64(3)) and len(engine.journal(np.int64(0))) == engine.journal_position
    engine.keep_undo(np.uint8(2))
    cube = incise.Simulation(CUBE.points, CUBE.tets, length_unit=np.float32(0.1), substeps=np.int64(2))
    cube.hold(np.uint32(3), np.float64(30))
    assert cube.is_held(np.int64(3)) and cube.settle(np.int16(2), np.float32(0)) == 2
    cube.frame(hooks=[incise.Hook(np.int64(1), (0.5, 0.5, 0), np.float32(0.3))])


@pytest.mark.parametrize("call", [
    lambda: incise.box((2, 2, 2), work_units=-1), lambda: incise.box((2, 2, 2), work_units=2**64),
    lambda: incise.box((2, 2, 2), threads=2**32 + 1), lambda: incise.box((2, 2, 2)).keep_undo(2**64 + 1),
    lambda: incise.box((2, 2, 2)).maintain(-1), lambda: incise.box((2, 2, 2)).validate(most=-1),
    lambda: incise.box((2, 2, 2)).validate(most=2**40), lambda: body(substeps=2**32 + 1), lambda: body(iterations=-1),
    lambda: body().settle(2**32 + 1), lambda: body().frame(hooks=[incise.Hook(-1, (0.5, 0.5, 0), 0.3)]),
    lambda: body().frame(hooks=[incise.Hook(2**32 + 1, (0.5, 0.5, 0), 0.3)]),
    lambda: body(materials=incise.Material(region=2**31)), lambda: body().hold(2**32),
    lambda: incise.Attributes(incise.box((2, 2, 2))).add("a", "tets", width=2**32 + 1)])
def test_numbers_are_not_taken_modulo_two_to_the_32(call):
    with pytest.raises(incise.BadArgument):
        call()


@pytest.mark.parametrize("call", [
    lambda: incise.box((2, 2, 2)).keep_undo(1.5), lambda: body().hold([1.7]), lambda: body().settle(2.5),
    lambda: incise.box((2, 2, 2)).cut_plane((1, 0, 0), None), lambda: incise.box((2, 2, 2), threads="2")])
def test_what_is_no_number_of_the_kind_is_a_type_error(call):
    with pytest.raises(TypeError):
        call()


@pytest.mark.parametrize("call", [
    lambda: incise.box((2, 2, 2), log=5), lambda: body(log="print"),
    lambda: incise.box((2, 2, 2)).maintain(should_stop=1), lambda: incise.box((2, 2, 2)).improve(should_stop=True),
    lambda: incise.box((2, 2, 2)).cut_along([], progress=3), lambda: body().settle(should_stop=0),
    lambda: body().run(0, progress=[]), lambda: incise.batch.run(PLAN, "nowhere", progress=1),
    lambda: incise.batch.verify(PLAN, "nowhere", should_stop=1),
    lambda: incise.Attributes(incise.box((2, 2, 2))).add("a", "tets", "recompute", recompute=2.0)])
def test_what_is_called_back_can_be_called(call):
    with pytest.raises(TypeError, match="a function is wanted"):
        call()


@pytest.mark.parametrize("call", [
    lambda: incise.box((2, 2, 2)).cut(incise.Stroke(STROKE, name=None)),
    lambda: incise.box((2, 2, 2)).cut(incise.Stroke(STROKE, name=b"a")), lambda: incise.box((2, 2, 2)).to_bytes(None),
    lambda: incise.Engine.from_bytes(b"", name=1), lambda: incise.Attributes(incise.box((2, 2, 2))).add(7, "tets")])
def test_names_are_texts(call):
    with pytest.raises(TypeError, match="a text is wanted"):
        call()


def test_names_have_whole_characters():
    with pytest.raises(incise.BadArgument, match="half of a character"):
        incise.box((2, 2, 2)).cut(incise.Stroke(STROKE, name="\ud800"))


@pytest.mark.parametrize("call", [
    lambda: incise.box((2, 2, 2), merge=0.5), lambda: incise.box((2, 2, 2), improve="1"), lambda: body(coarse=2),
    lambda: incise.box((2, 2, 2), check_steps=[]), lambda: incise.Engine(CUBE.points, CUBE.tets, mend=None),
    lambda: incise.box((2, 2, 2)).quality("no"), lambda: body(materials=incise.Material(rigid="no")),
    lambda: body().pin(0, 100, 1, tears="no"), lambda: incise.batch.run(PLAN, "nowhere", retry="no"),
    lambda: body().frame(hooks=[incise.Hook(1, (0.5, 0.5, 0), 0.3, tears=0.5)])])
def test_yes_and_no_are_no_texts_nor_shares(call):
    with pytest.raises(TypeError, match="True or False is wanted"):
        call()


def hidden(array):
    """The array with its last number behind a mask."""
    mask = np.zeros(np.shape(array), bool)
    mask.flat[-1] = True
    return np.ma.array(array, mask=mask)


@pytest.mark.parametrize("call", [
    lambda: incise.Engine(hidden(CUBE.points), CUBE.tets), lambda: incise.Engine(CUBE.points, hidden(CUBE.tets)),
    lambda: incise.Engine(list(hidden(CUBE.points)), CUBE.tets),
    lambda: incise.Engine(CUBE.points, CUBE.tets, hidden(CUBE.regions)), lambda: incise.box(hidden([2, 2, 2])),
    lambda: incise.box((2, 2, 2), high=hidden([1.0, 1, 1])), lambda: incise.box((2, 2, 2)).cut(hidden(STROKE)),
    lambda: incise.box((2, 2, 2)).cut(incise.Stroke(STROKE, times=hidden([0.0, 1]))),
    lambda: incise.box((2, 2, 2)).set_positions(hidden(np.zeros((27, 3)))), lambda: body().hold(hidden([1, 2])),
    lambda: body().move_hold(0, hidden([0.0, 0, 0])), lambda: body().set_velocity(0, hidden([0.0, 0, 0])),
    lambda: incise.box((2, 2, 2)).cut([[hidden(point) for point in edge] for edge in STROKE]),
    lambda: incise.box((2, 2, 2)).cut([[(0.5, -0.2, np.ma.masked), (0.5, 1.2, 1)], [(0.5, -0.2, 0), (0.5, 1.2, 0)]]),
    lambda: body().frame(hidden(STROKE[0])), lambda: incise.Attributes(incise.box((2, 2, 2))).add("a", "tets", initial=hidden([1.0]))])
def test_what_a_mask_hides_is_not_taken(call):
    with pytest.raises(incise.BadArgument, match="masked"):
        call()


@pytest.mark.parametrize("spoil", [
    lambda values, n: values.__setitem__("pair", np.zeros((2, n))), lambda values, n: values.__setitem__("pair", np.zeros(2 * n)),
    lambda values, n: values.__setitem__("pair", np.zeros((n + 1, 2))), lambda values, n: values.__setitem__("one", np.zeros((n, 1))),
    lambda values, n: values.__setitem__("one", [1.0, 2, 3]),
    lambda values, n: values.add("other", "tets", width=3, initial=[1.0, 2])])
def test_values_of_another_shape_are_refused_and_change_nothing(spoil):
    engine = incise.box((2, 2, 2))
    values = incise.Attributes(engine)
    values.add("one", "tets", initial=3)
    values.add("pair", "tets", width=2, initial=(1, 2))
    with pytest.raises(incise.BadArgument, match="shape"):
        spoil(values, len(engine.tets))
    assert (values["one"] == 3).all() and (values["pair"] == (1, 2)).all()
    values["one"], values["pair"] = 4, (5, 6)
    assert (values["one"] == 4).all() and (values["pair"] == (5, 6)).all()


def test_a_mask_that_hides_nothing_is_fine():
    engine = incise.Engine(np.ma.array(CUBE.points), np.ma.array(CUBE.tets, mask=np.zeros(CUBE.tets.shape, bool)))
    assert engine.hash == incise.Engine(CUBE.points, CUBE.tets).hash


C_SOURCES = Path(__file__).parents[2] / "bindings" / "c"


def test_messages_name_no_call_of_c():
    """Python hears the same words as C does. A name alone, of a struct or a header, is no message."""
    texts = []
    for source in sorted(C_SOURCES.glob("*.cpp")) + sorted(C_SOURCES.glob("*.h")):
        texts += re.findall(r'"((?:[^"\\\n]|\\.)*)"', source.read_text(encoding="utf-8"))
    messages = [text for text in texts if " " in text]
    assert len(messages) > 50
    assert not [text for text in messages if "incise_" in text]
    with pytest.raises(incise.BadArgument) as error:
        body().play()
    assert str(error.value) == "this simulation was made without a scene; make it from one"


def test_null_characters_do_not_end_a_name(tmp_path):
    engine = incise.box((2, 2, 2))
    for call in (lambda: engine.write(str(tmp_path / "a.mesh") + "\0.vtk"), lambda: engine.to_bytes(".mesh\0.vtk"),
                 lambda: incise.read(str(tmp_path / "a.mesh") + "\0"),
                 lambda: incise.Attributes(engine).add("a\0b", "tets"),
                 lambda: engine.cut(incise.Stroke([[[0.5, -1, -1], [0.5, -1, 2]], [[0.5, 2, -1], [0.5, 2, 2]]], name="\0"))):
        with pytest.raises(incise.BadArgument, match="null character"):
            call()
    assert not list(tmp_path.iterdir())


def test_engines_are_not_copied_deeply_nor_pickled(capfd):
    engine = incise.box((2, 2, 2))
    for call in (copy.deepcopy, pickle.dumps):
        with pytest.raises(TypeError, match="to_bytes"):
            call(engine)
    assert copy.copy(engine).hash == engine.hash
    assert capfd.readouterr().err == ""


def test_masks_hold_nothing_and_bad_slots_neither():
    cube = body()
    with pytest.raises(incise.BadArgument, match="flatnonzero"):
        cube.hold(cube.mesh.rest[:, 2] > 0.9)
    with pytest.raises(incise.BadArgument) as error:
        cube.hold([1, 2, 9999])
    assert error.value.ids == (9999,)
    with pytest.raises(incise.BadArgument, match="not live") as error:
        cube.set_velocity(9999, (0, 0, 0))
    assert error.value.ids == (9999,)
    assert not any(cube.is_held(vertex) for vertex in range(3))
    cube.hold(np.flatnonzero(cube.mesh.rest[:, 2] > 0.9))
    assert cube.is_held(63)


@pytest.mark.parametrize("speed", [math.nan, -1, -math.inf])
def test_no_body_settles_for_ever(speed):
    with pytest.raises(incise.BadArgument, match="at rest"):
        body().settle(2**32 - 1, speed)


@pytest.mark.parametrize("spoil", [
    lambda cube: cube.frame(hooks=[incise.Hook(1, (1e300, 0.5, 0), 0.3)]),
    lambda cube: cube.move_hold(0, (1e300, 0, 0)),
    lambda cube: cube.set_velocity(1, (1e300, 0, 0)), lambda cube: cube.set_velocity(1, (math.nan, 0, 0)),
    lambda cube: cube.frame(tools=[incise.Plane((0, 0, 1), 1e300)]),
    lambda cube: cube.frame(hooks=[incise.Hook(1, (0.5, 0.5, 0), 1e300)]),
    lambda cube: cube.frame(hooks=[incise.Hook(1, (0.5, 0.5, 0), 0.3, stiffness=1e300)]),
    lambda cube: cube.frame(tools=[incise.Ball((0, 0, 0), 1e300)]),
    lambda cube: cube.frame(tools=[incise.Rod((0, 0, 0), (1, 1, 1), 1e300)]),
    lambda cube: cube.frame(tools=[incise.Ball((0, 0, math.nan), 1)])])
def test_what_no_body_can_bear_is_refused_and_changes_nothing(spoil):
    cube = body()
    cube.hold(0)
    cube.frame(hooks=[incise.Hook(1, (0.5, 0.5, 0), 0.3)])
    before = cube.hash
    with pytest.raises(incise.BadArgument):
        spoil(cube)
    assert cube.hash == before
    assert math.isfinite(cube.frame().fastest)


def test_followers_of_one_engine_refuse_another():
    engine, other = incise.box((3, 3, 3)), incise.box((5, 5, 5))
    cursor, values = engine.cursor(), incise.Attributes(engine)
    values.add("mass", "tets", "conserve", initial=1.0)
    for each in (engine, other, other):
        each.cut_plane((1, 0.1, 0), 0.4 + 0.1 * each.stroke_count)
    cursor._engine, values._mesh = other._engine, other
    for call in (cursor.new_steps, values.follow):
        with pytest.raises(incise.BadArgument, match="another engine"):
            call()


def test_rows_of_different_lengths_are_refused():
    with pytest.raises(incise.BadArgument, match="same length"):
        incise.Engine([[0, 0, 0], [1, 0]], [[0, 1, 2, 3]])
    with pytest.raises(incise.BadArgument, match="same length"):
        incise.box((2, 2, 2)).cut([[[0, 0, 0], [1, 1, 1]], [[0, 0, 0]]])


def test_what_is_no_number_hook_material_or_mesh_is_told():
    engine = incise.box((2, 2, 2))
    with pytest.raises(TypeError, match="offset is 'x'; a number is wanted"):
        engine.cut_plane((1, 0, 0), "x")
    cube = engine.compact()
    with pytest.raises(incise.BadArgument, match="'x' is no material"):
        incise.Simulation(cube.points, cube.tets, materials="x")
    body = incise.Simulation(cube.points, cube.tets)
    with pytest.raises(incise.BadArgument, match="3 is no hook"):
        body.frame(hooks=[3])
    with pytest.raises(TypeError, match="None is no mesh of meshio"):
        incise.Engine.from_meshio(None)


def test_find_wants_true_or_false_for_each_place():
    cube = incise.box((2, 2, 2)).compact()
    body = incise.Simulation(cube.points, cube.tets)
    for where in (lambda rest: True, lambda rest: rest[:, 2], lambda rest: rest[:3, 2] > 0, lambda rest: np.array([0, 1])):
        with pytest.raises(incise.BadArgument, match="True or False for each of 27 places"):
            body.find(where)
    with pytest.raises(TypeError, match="a function is wanted"):
        body.find(3)
    assert len(body.find(lambda rest: (rest[:, 2] > 0.9).tolist())) == 9


def test_messages_are_short():
    engine = incise.box((2, 2, 2))
    scene = {"format": "incise-scene", "version": 1, "x" * 3000: 1}
    for call in (lambda: incise.read("/tmp/" + "y" * 3000), lambda: incise.box((2, 2, 2), profile="p" * 5000),
                 lambda: engine.to_bytes("." + "y" * 3000), lambda: incise.Simulation.from_scene(scene),
                 lambda: engine.cut(incise.Stroke(np.full((2, 2, 3), np.nan), None, "n" * 5000))):
        with pytest.raises(incise.InciseError) as error:
            call()
        assert len(str(error.value)) <= 500
    with pytest.raises(TypeError) as unfit:
        engine.cut_plane((1, 0, 0), "z" * 5000)
    assert len(str(unfit.value)) <= 500


def test_a_stroke_of_one_pose_is_named():
    with pytest.raises(incise.BadArgument, match="^the stroke needs at least two times"):
        incise.box((2, 2, 2)).cut(np.zeros((1, 2, 3)))


def test_what_recompute_raises_comes_out_and_what_follows_is_sound():
    engine = incise.box((3, 3, 3))
    values, spoiled = incise.Attributes(engine), [False]

    def recompute(_slot):
        if spoiled[0]:
            raise KeyError("spoiled")
        return 2.0

    values.add("two", "tets", "recompute", recompute=recompute)
    spoiled[0] = True
    engine.cut_plane((1, 0, 0), 0.4)
    with pytest.raises(KeyError, match="spoiled"):
        values.follow()
    spoiled[0] = False
    engine.cut_plane((0, 1, 0.1), 0.4)
    values.follow()
    assert np.isfinite(values["two"][engine.live_tets]).all()


def test_six_threads_on_one_engine_leave_it_sound():
    engine, other = incise.box((6, 6, 6)), []

    def work(number):
        for k in range(20):
            try:
                if k % 3 == 0:
                    engine.cut_plane((1, 0.1 * number, 0.05 * k), 0.1 + 0.04 * k)
                elif k % 3 == 1:
                    found = engine.compact()
                    assert found.tets.max() < len(found.points) == len(found.vertex_slots)
                    assert engine.surface().tags.max() < 2**20 and engine.pieces().volumes.sum() < 1.01
                else:
                    engine.undo()
            except incise.Busy:
                pass
            except Exception as error:
                other.append(error)

    threads = [threading.Thread(target=work, args=(number,)) for number in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not other and engine.validate()


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no processes are forked here")
def test_a_forked_process_cuts_its_copy():
    engine = incise.box((6, 6, 6), threads=2)
    engine.cut_plane((1, 0.1, 0), 0.5)
    child = os.fork()
    if child == 0:
        try:
            engine.cut_plane((0, 1, 0.1), 0.5)
            os._exit(0 if engine.validate() and engine.stroke_count == 2 else 1)
        except BaseException:
            os._exit(2)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
    assert engine.stroke_count == 1


EVERY_CALL = """
import ctypes, sys
import incise
from incise._library import lib

cube = incise.box((3, 3, 3))
cube.cut_plane((1, 0, 0), 0.4)
compact = cube.compact()
body = incise.Simulation(compact.points, compact.tets)
tool = ctypes.c_void_p()
lib.incise_haptic_tool_create(None, ctypes.byref(tool))
owners = {"incise_engine_": cube._handle.pointer, "incise_simulation_": body._handle.pointer,
          "incise_haptic_tool_": tool}

def value(kind, whole, real):
    if kind in (ctypes.c_void_p, ctypes.c_char_p) or issubclass(kind, ctypes._Pointer):
        return None
    if issubclass(kind, ctypes._CFuncPtr):
        return kind()
    return real if kind is ctypes.c_double else whole

for name in sys.argv[1:]:
    call = getattr(lib, name)
    firsts = [None] + [owner for prefix, owner in owners.items()
                       if name.startswith(prefix) and not name.endswith(("free", "create", "read", "scene", "bytes", "box"))]
    for first in firsts:
        for whole, real in ((0, 0.0), (-1, float("nan"))):
            arguments = [value(kind, whole, real) for kind in call.argtypes]
            if first is not None and arguments:
                arguments[0] = first
            print(name, first is not None, whole, flush=True)
            status = call(*arguments)
            if call.restype is ctypes.c_int32 and status not in (0, 1, 3, 4):
                sys.exit("%s: status %d, %s" % (name, status, lib.incise_last_error()))
"""


def test_every_call_survives_nulls():
    calls = [line for line in SYMBOLS.read_text(encoding="ascii").split() if line.startswith("incise_")]
    assert len(calls) > 80
    run = subprocess.run([sys.executable, "-c", EVERY_CALL, *calls], capture_output=True, text=True, check=False, timeout=120)
    assert run.returncode == 0, run.stdout[-200:] + run.stderr[-500:]
    assert run.stdout.count("\n") >= 2 * len(calls)


def test_holds_move_all_or_none():
    simulation = body()
    simulation.hold([5], stiffness=100.0)
    before = simulation.hash
    with pytest.raises(incise.BadArgument, match="vertex 9 is not held") as error:
        simulation.move_hold([5, 9], [(0, 0, 0), (1, 1, 1)])
    assert list(error.value.ids) == [9] and simulation.hash == before


def test_errors_name_the_vertex():
    engine = incise.box((2, 2, 2))
    places = engine.rest.copy()
    places[7] = math.nan
    with pytest.raises(incise.BadArgument) as error:
        engine.set_positions(places)
    assert list(error.value.ids) == [7]


@pytest.mark.parametrize("times, ids", [((0, math.nan), (1,)), ((1, 0), (1,)), ((0, math.inf), (1,))])
def test_errors_name_the_time(times, ids):
    with pytest.raises(incise.BadArgument) as error:
        incise.box((2, 2, 2)).cut(incise.Stroke(STROKE, times=times))
    assert error.value.ids == ids


def test_boxes_have_cells():
    with pytest.raises(incise.BadArgument, match="too small"):
        incise.box((3, 3, 3), (1e16, 0, 0), (1e16 + 2, 1, 1))


@pytest.mark.parametrize("shard", [(1.7, 2), (0.5, 2), (True, 2), "1_0/20", " 1 / 2 ", "", "1"])
def test_shards_are_whole_numbers(shard, tmp_path):
    with pytest.raises(incise.BadArgument):
        incise.batch.run({"format": "incise-plan"}, tmp_path, shard=shard)


def test_one_material_is_for_all_other_regions():
    with pytest.raises(incise.BadArgument, match="more than one material"):
        body(materials=[incise.Material(young=1e3), incise.Material(young=1e6)])
