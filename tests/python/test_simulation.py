# SPDX-License-Identifier: Apache-2.0
import gc
import json
import math

import numpy as np
import pytest

import incise

SCENE = {
    "format": "incise-scene", "version": 1, "name": "hanging cube", "model": {"box": {"cells": [4, 4, 4]}},
    "length_unit": 0.1, "materials": {"default": {"young": 20000, "toughness": 20}},
    "attachments": [{"below": [0, 0, -1, -0.99]}],
    "strokes": [{"blade": [{"edges": [{"t": 0, "points": [[0.5, -0.3, -0.2], [0.5, -0.3, 0.6]]},
                                      {"t": 0.3, "points": [[0.5, 1.3, -0.2], [0.5, 1.3, 0.6]]}]}]}],
    "duration": 0.4, "settle": {"frames": 30}}


def hanging_cube(**options):
    cube = incise.box((4, 4, 4)).compact()
    body = incise.Simulation(cube.points, cube.tets, materials=incise.Material(young=20e3), length_unit=0.1, **options)
    body.hold(body.find(lambda rest: rest[:, 2] > 0.99))
    return body


def test_a_scene_plays_to_its_end(tmp_path):
    told = []
    body = incise.Simulation.from_scene(SCENE)
    frames = body.run(progress=lambda done, total: told.append((done, total)))
    assert len(frames) == 24 and told[-1] == (24, 24)
    assert any(frame.blade_touches for frame in frames) and body.mesh.stroke_count == 1
    assert np.isfinite(body.mesh.positions[body.mesh.live_vertices]).all() and body.mesh.validate()
    (tmp_path / "scene.json").write_text(json.dumps(SCENE))
    again = incise.Simulation.from_scene(tmp_path / "scene.json")
    again.run()
    assert again.hash == body.hash
    assert body.run() == []


def test_a_scene_may_be_left_unsettled():
    assert incise.Simulation.from_scene(SCENE, settle=False).hash != incise.Simulation.from_scene(SCENE).hash


def test_bad_scenes_are_errors():
    with pytest.raises(incise.BadFile, match="cells"):
        incise.Simulation.from_scene({**SCENE, "model": {"box": {"cells": [0, 4, 4]}}})
    with pytest.raises(incise.BadFile):
        incise.Simulation.from_scene("/no/such/scene.json")
    with pytest.raises(incise.BadArgument):
        incise.Simulation.from_scene(SCENE, threads=0)


def test_weight_hangs_on_what_holds_it():
    body = hanging_cube()
    assert body.settle(400, 1e-3) > 0
    state = body.state
    assert abs(state.mass - 1) < 1e-9 and abs(state.force_on_holds[2] + 9.81) < 0.2
    assert state.inverted_tets == 0 and state.elastic > 0
    lowest = body.find(lambda rest: rest[:, 2] == 0)
    assert (body.mesh.positions[lowest, 2] < 0).all()
    assert body.is_held(int(body.find(lambda rest: rest[:, 2] == 1)[0])) and not body.is_held(int(lowest[0]))
    held = body.find(lambda rest: rest[:, 2] == 1)
    body.move_hold(held, body.mesh.rest[held] + [0.1, 0, 0])
    body.hold(lowest[0], 50.0)
    body.hold(lowest[0], 0)
    body.set_velocity(int(lowest[0]), (0, 0, 1))
    assert abs(body.velocities[lowest[0], 2] - 1) < 1e-6
    body.frame()
    assert body.state.frames > state.frames


def test_hooks_pull_and_tools_press():
    body = hanging_cube()
    for i in range(10):
        frame = body.frame(hooks=[incise.Hook(7, (0.5, 0.5, -0.05 * i), 0.3, 200)],
                           tools=[incise.Plane((1, 0, 0), 0.1), incise.Ball((2, 2, 2), 0.1),
                                  incise.Rod((3, 3, 3), (4, 4, 4), 0.1),
                                  incise.Flat([[5, 5, 5], [6, 5, 5]], (0, 0, 1), 0.01)])
    assert frame.contacts > 0 and frame.hook_forces.shape == (1, 3) and frame.hook_forces[0, 2] > 0
    with pytest.raises(incise.BadArgument):
        body.frame(tools=["a hammer"])
    with pytest.raises(incise.BadArgument):
        body.frame(tools=[incise.Ball((0, 0, 0), -1)])
    with pytest.raises(incise.BadArgument):
        body.frame(hooks=[incise.Hook(1, (0, 0), 0.1)])


def test_an_edge_that_slices_is_pushed_with_less():
    strongest = []
    for slicing in (0, 3):
        body = incise.Simulation.from_scene({**SCENE, "strokes": []})
        forces = [np.linalg.norm(body.frame(blade=[[0.5, y, -0.2], [0.5, y, 0.5]], direction=(0, 1, 0),
                                            slicing=slicing).blade_force) for y in np.linspace(-0.2, 1.2, 25)]
        strongest.append(max(forces))
    assert strongest[1] < 0.3 * strongest[0]
    with pytest.raises(incise.BadArgument, match="slicing"):
        body.frame(blade=[[0.5, 0, -0.2], [0.5, 0, 0.5]], slicing=-1)


def test_the_blade_cuts_and_is_taken_back():
    body = incise.Simulation.from_scene({**SCENE, "strokes": []})
    before = body.mesh.hash
    force = 0.0
    for i in range(25):
        y = -0.2 + 0.06 * i
        frame = body.frame(blade=[[0.5, y, -0.2], [0.5, y, 0.5]], direction=(0, 1, 0))
        force = max(force, float(np.linalg.norm(frame.blade_force)))
    assert frame.stroke == 1 and force > 0
    assert body.mesh.hash != before
    body.frame()
    assert body.cut_report.stroke == 0 and body.mesh.stroke_count == 1
    assert body.undo() and body.mesh.hash == before and not body.undo()
    assert body.redo() and body.mesh.hash != before


def test_what_a_frame_takes_back_counts_below_zero():
    body = incise.Simulation.from_scene({**SCENE, "strokes": []})
    grown = []
    for i in range(25):
        y = -0.2 + 0.06 * i
        body.frame(blade=[[0.5, y, -0.2], [0.5, y, 0.5]], direction=(0, 1, 0))
        grown.append((body.cut_report.created_tets, body.cut_report.new_vertices, body.cut_report.incision_faces))
    assert np.abs(grown).max() < 10_000 and np.min(grown) < 0
    assert np.sum(grown, axis=0).min() > 0


def test_materials_by_region():
    cube = incise.box((2, 2, 2)).compact()
    regions = (cube.points[cube.tets].mean(axis=1)[:, 0] > 0.5).astype(int)
    body = incise.Simulation(cube.points, cube.tets, regions,
                             materials=[incise.Material(density=1000), incise.Material(density=3000, region=1)])
    assert abs(body.state.mass - 2000) < 1e-6


def test_the_mesh_is_to_be_read_and_outlives_the_simulation():
    body = hanging_cube()
    mesh, rest = body.mesh, body.mesh.rest
    version = mesh.version
    body.frame()
    assert mesh.version > version and not hasattr(mesh, "cut_plane")
    del body
    gc.collect()
    assert mesh.tet_count == 384 and rest.shape == (125, 3) and math.isfinite(float(rest.sum()))


def test_a_scene_that_is_none_cannot_be_played():
    with pytest.raises(incise.BadArgument, match="scene"):
        hanging_cube().play()


def test_a_run_can_be_broken_off():
    body = incise.Simulation.from_scene(SCENE)

    def stop(done, _total):
        if done == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        body.run(progress=stop)
    assert len(body.run()) == 21


def test_of_a_file(tmp_path):
    incise.box((2, 2, 2)).write(tmp_path / "cube.mesh")
    assert incise.Simulation.read(tmp_path / "cube.mesh", length_unit=0.01).mesh.tet_count == 48
    with pytest.raises(incise.BadArgument):
        incise.Simulation.read(tmp_path / "cube.mesh", length_unit=-1)
