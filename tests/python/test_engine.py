# SPDX-License-Identifier: Apache-2.0
import gc
import json
import os

import numpy as np
import pytest

import incise

POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]], float)
TETS = np.array([[0, 1, 2, 3], [1, 2, 3, 4]])


def blade(z):
    return [[0.47, -0.2, z], [0.52, 1.2, z]]


def test_of_arrays_keeps_their_numbers():
    engine = incise.Engine(POINTS, TETS, regions=[3, 4])
    assert engine.tet_count == 2 and engine.vertex_count == 5
    assert np.array_equal(engine.rest, POINTS) and np.array_equal(engine.tets, TETS)
    assert engine.regions.tolist() == [3, 4]
    assert engine.rest.dtype == np.float64 and engine.tets.dtype == np.uint32


@pytest.mark.parametrize("kind", [np.int32, np.int64, np.uint32, np.uint64, np.int8])
def test_takes_whole_numbers_of_any_kind(kind):
    assert incise.Engine(POINTS, TETS.astype(kind)).tet_count == 2


def test_takes_lists_and_arrays_in_any_order_in_memory():
    assert incise.Engine(POINTS.tolist(), TETS.tolist()).hash == incise.Engine(POINTS, TETS).hash
    assert incise.Engine(np.asfortranarray(POINTS), np.asfortranarray(TETS)).hash == incise.Engine(POINTS, TETS).hash
    assert incise.Engine(POINTS.astype(np.float32), TETS[:, :]).hash == incise.Engine(POINTS, TETS).hash


@pytest.mark.parametrize("points, tets, regions", [
    (POINTS[:, :2], TETS, None), (POINTS, TETS[:, :3], None), (POINTS, TETS, [1]), (POINTS, TETS.astype(float), None),
    (POINTS, -TETS, None), (POINTS, TETS + 2**32, None), (POINTS[0], TETS, None)])
def test_refuses_arrays_of_the_wrong_shape(points, tets, regions):
    with pytest.raises(incise.BadArgument):
        incise.Engine(points, tets, regions)


def test_a_body_may_have_no_tets():
    engine = incise.Engine(POINTS, [])
    assert engine.tet_count == 0 and engine.tets.shape == (0, 4) and len(engine.pieces()) == 0
    assert engine.compact().tets.shape == (0, 4)


def test_errors_name_the_elements():
    turned = [[0, 1, 2, 3], [1, 3, 2, 4]]
    with pytest.raises(incise.BadArgument, match="1") as error:
        incise.Engine(POINTS, turned)
    assert error.value.ids == (1,)
    assert isinstance(error.value, ValueError) and isinstance(error.value, incise.InciseError)
    assert incise.Engine(POINTS, turned, mend=True).tet_count == 2
    with pytest.raises(incise.BadArgument) as error:
        incise.Engine(POINTS, [[0, 1, 2, 3], [1, 2, 3, 7]], mend=True)
    assert error.value.ids == (1,)


def test_errors_are_what_a_python_programmer_expects():
    with pytest.raises(OSError, match="/no/such/file.mesh"):
        incise.read("/no/such/file.mesh")
    for kind, builtin in ((incise.BadArgument, ValueError), (incise.BadFile, OSError), (incise.OutOfMemory, MemoryError),
                          (incise.WriteFailed, OSError), (incise.Busy, RuntimeError), (incise.Internal, RuntimeError),
                          (incise.Unsupported, NotImplementedError)):
        assert issubclass(kind, builtin) and issubclass(kind, incise.InciseError)
        assert kind("text", (1, 2)).ids == (1, 2) and str(kind("text")) == "text"


@pytest.mark.parametrize("options", [{"snap": 7}, {"profile": "best"}, {"threads": 0}, {"threads": -1}])
def test_refuses_options_out_of_range(options):
    with pytest.raises(incise.BadArgument):
        incise.box(**options)


def test_cuts_and_takes_back():
    engine = incise.box((5, 5, 5), merge=False, improve=False)
    before = engine.hash
    report = engine.cut_plane((1, 0, 0), 0.5)
    assert (engine.tet_count, len(engine.pieces()), report.stroke) == (1300, 2, 1)
    assert report.created_tets == 550 and report.journal_end > report.journal_first
    assert np.allclose(engine.pieces().volumes.sum(), 1)
    after = engine.hash
    assert engine.undo() and engine.hash == before and not engine.undo()
    assert engine.redo() and engine.hash == after and not engine.redo()


def test_cuts_a_stroke_of_poses():
    engine = incise.box((4, 4, 4))
    stroke = incise.Stroke([[[0.5, -1, -1], [0.5, -1, 2]], [[0.5, 2, -1], [0.5, 2, 2]]], times=[0, 0.5], name="plane")
    assert engine.cut(stroke).cut_tets > 0
    assert len(engine.pieces()) == 2
    assert engine.cut([[[-1, 0.4, -1], [-1, 0.4, 2]], [[2, 0.4, -1], [2, 0.4, 2]]]).stroke == 2
    with pytest.raises(incise.BadArgument):
        engine.cut(incise.Stroke([[[0, 0, 0], [1, 0, 0]]] * 2, times=[1, 1]))
    with pytest.raises(incise.BadArgument):
        engine.cut(incise.Stroke([[[0, 0, 0], [1, 0, 0]]] * 2, times=[1]))
    with pytest.raises(incise.BadArgument):
        engine.cut([[0, 0, 0], [1, 0, 0]])


def test_cuts_step_by_step_in_a_body_that_moves():
    engine = incise.box((4, 4, 4))
    assert engine.begin_stroke(blade(1.1), direction=(0, 0, -1)) == 1 and engine.is_in_stroke
    for i in range(1, 9):
        engine.step(blade(1.1 - 0.1 * i))
        engine.set_positions(engine.rest * [1, 1 + 0.01 * i, 1])
    assert engine.end_stroke().cut_tets > 0 and not engine.is_in_stroke
    assert np.array_equal(engine.positions[engine.live_vertices[0]], engine.rest[engine.live_vertices[0]])
    assert engine.validate()
    with pytest.raises(incise.BadArgument):
        engine.step(blade(0))
    with pytest.raises(incise.BadArgument):
        engine.set_positions(np.zeros((3, 3)))
    with pytest.raises(incise.BadArgument):
        engine.set_positions(engine.rest * np.nan)


def read_only(edge):
    edge.flags.writeable = False
    return edge


@pytest.mark.parametrize("given", [
    list, read_only, np.asfortranarray, lambda edge: edge[:, ::-1][:, ::-1], lambda edge: np.repeat(edge, 2, axis=0)[::2],
    lambda edge: edge.astype(">f8"), lambda edge: edge.astype(object), lambda edge: edge.view(np.recarray),
    lambda edge: np.frombuffer(b"." + edge.tobytes(), np.float64, offset=1).reshape(-1, 3)])
def test_an_edge_of_any_kind_of_array_cuts_the_same(given):
    edges = [np.array(blade(1.1 - 0.1 * i)) for i in range(14)]
    engine, other = incise.box((3, 3, 3)), incise.box((3, 3, 3))
    engine.cut_along(edges, direction=(0, 0, -1))
    other.cut_along([given(edge) for edge in edges], direction=given(np.array([[0, 0, -1.0]]))[0])
    assert engine.hash == other.hash and len(engine.pieces()) == 2


@pytest.mark.parametrize("edge", [
    np.zeros((0, 3)), np.zeros((1, 3)), np.zeros(6), np.zeros((3, 2)), np.zeros((2, 3, 1)), np.zeros((2, 0)),
    np.full((2, 3), np.nan), np.zeros((2, 3), complex), np.array([["0"] * 3] * 2)])
def test_an_edge_of_another_shape_or_kind_is_refused_in_a_stroke(edge):
    engine = incise.box((2, 2, 2))
    engine.begin_stroke(blade(1.1))
    with pytest.raises(incise.BadArgument):
        engine.step(edge)
    assert engine.is_in_stroke and engine.step(blade(0.5)).cut_tets > 0


def test_a_stroke_that_is_broken_off_is_taken_back():
    engine = incise.box((4, 4, 4))
    before, told = engine.hash, []

    def progress(done):
        told.append(done)
        if done == 4:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        engine.cut_along((blade(1.1 - 0.1 * i) for i in range(10)), progress=progress)
    assert told == [0, 1, 2, 3, 4] and engine.hash == before and not engine.is_in_stroke
    assert engine.cut_along(blade(1.1 - 0.1 * i) for i in range(10)).cut_tets > 0
    with pytest.raises(incise.BadArgument):
        engine.cut_along([])


def test_strokes_of_a_blade_file(tmp_path):
    path = tmp_path / "a blade.json"
    path.write_text('{"format": "incise-blade", "version": 1, "strokes": [{"edges": ['
                    '{"t": 0, "points": [[0.3, -1, -1], [0.3, -1, 2]]}, {"t": 1, "points": [[0.3, 2, -1], [0.3, 2, 2]]}]}]}')
    engine = incise.box((3, 3, 3))
    assert engine.cut_blade(path).stroke == 1 and len(engine.pieces()) == 2
    with pytest.raises(incise.BadFile):
        engine.cut_blade(tmp_path / "none.json")


def test_maintenance_within_a_budget():
    engine = incise.box((5, 5, 5), work_units=100, snap=0)
    engine.cut_plane((1, 0.2, 0.3), 0.7)
    assert engine.has_maintenance
    assert engine.maintain(50).work_units >= 0 and engine.has_maintenance
    assert engine.maintain().waiting_tets == 0 and not engine.has_maintenance
    rough = incise.box((4, 4, 4))
    assert rough.improve(should_stop=lambda: True).work_units <= rough.improve().work_units + 10**9
    rough.keep_undo(1)
    with pytest.raises(incise.BadArgument):
        rough.keep_undo(0)


def test_what_the_callback_raises_comes_out():
    class Mine(Exception):
        pass

    def stop():
        raise Mine

    engine = incise.box((4, 4, 4))
    with pytest.raises(Mine):
        engine.improve(stop)
    assert engine.validate()


def test_the_log_is_heard_and_lives_as_long_as_the_engine():
    said = []
    engine = incise.box((3, 3, 3), log=lambda level, text: said.append((level, text)))
    gc.collect()
    engine.cut_plane((1, 0, 0), 0.4)
    assert all(level in (0, 1, 2) and text for level, text in said)


def test_views_are_the_engine_itself_and_read_only():
    engine = incise.box((4, 4, 4))
    rest, tets = engine.rest, engine.tets
    assert engine.rest.ctypes.data == rest.ctypes.data and engine.tets.ctypes.data == tets.ctypes.data
    with pytest.raises(ValueError):
        rest[0] = 1
    with pytest.raises(ValueError):
        rest.flags.writeable = True
    version = engine.version
    engine.cut_plane((1, 0.1, 0), 0.51)
    assert engine.version > version and len(engine.rest) > len(rest)
    assert engine.rest.ctypes.data == rest.ctypes.data, "arrays stay in their places while they grow"


def test_views_keep_the_mesh_alive():
    rest = incise.box((6, 6, 6)).rest
    gc.collect()
    assert rest.min() == 0 and rest.max() == 1 and len(rest) == 343
    part = incise.box((6, 6, 6)).rest[10:20]
    gc.collect()
    assert part.shape == (10, 3) and np.isfinite(part).all()


def test_copies():
    engine = incise.box((3, 3, 3))
    engine.cut_plane((1, 0.2, 0.1), 0.52)
    compact, surface, pieces = engine.compact(), engine.surface(), engine.pieces()
    assert compact.points.shape == (engine.vertex_count, 3) and compact.tets.max() == engine.vertex_count - 1
    assert np.array_equal(compact.vertex_slots[compact.tets], engine.tets[compact.tet_slots])
    assert np.array_equal(compact.tet_slots, engine.live_tets)
    assert np.array_equal(pieces.labels[compact.tet_slots], compact.pieces)
    assert set(surface.tags.tolist()) == {0, 1}
    corners = engine.rest[surface.triangles]
    volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
    assert abs(volume - 1) < 1e-9, "triangles turn outward"
    assert (engine.links[surface.sides // 4, surface.sides % 4] & 0x80000000).all()
    engine.set_positions(engine.rest * 2)
    assert np.allclose(engine.compact("current").points, 2 * compact.points)
    with pytest.raises(incise.BadArgument):
        engine.compact("somewhere")


def test_judgement():
    engine = incise.box((3, 3, 3))
    engine.cut_plane((0.1, 1, 0.3), 0.66)
    all_tets, at_cuts = engine.quality(), engine.quality(at_cuts=True)
    assert 0 < at_cuts.tets < all_tets.tets == engine.tet_count and all_tets.lr_min >= 4.89
    validity = engine.validate()
    assert validity and validity.ok and validity.counts == {} and abs(validity.volume - 1) < 1e-12
    with pytest.raises(incise.BadArgument):
        engine.validate("everything")
    points = np.vstack([POINTS, [[5, 5, 5]]])
    lonely = incise.Engine(points, TETS).validate()
    assert not lonely and lonely.counts == {"orphan_vertex": 1} or lonely.violations[0].ids[0] == 5


def test_files(tmp_path):
    engine = incise.box((3, 3, 3))
    engine.cut_plane((1, 0.2, 0), 0.5)
    for name in ("a.vtk", "b.mesh", "c.vtu", "d.vtk.gz"):
        engine.write(tmp_path / name)
        again = incise.read(tmp_path / name)
        assert again.tet_count == engine.tet_count and again.next_stroke == 2
    content = engine.to_bytes(".mesh")
    assert incise.Engine.from_bytes(content, "memory").hash == incise.read(str(tmp_path / "b.mesh")).hash
    engine.write_surface(tmp_path / "e.stl")
    assert os.path.getsize(tmp_path / "e.stl") > 84
    with pytest.raises(incise.BadArgument):
        engine.write(tmp_path / "f.xyz")
    with pytest.raises(incise.WriteFailed):
        engine.write("/no/such/folder/a.vtk")
    turned = incise.Engine.from_bytes(b"MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n"
                                      b"0 0 1 0\nTetrahedra 1\n1 3 2 4 0\nEnd\n")
    assert any("turned to positive" in note for note in turned.notes)
    assert engine.notes == []


def test_numbers_that_c_cannot_hold_are_errors():
    engine = incise.box((2, 2, 2))
    with pytest.raises((incise.BadArgument, OverflowError)):
        incise.box((-1, 2, 2))
    with pytest.raises(incise.BadArgument):
        incise.box((2, 2))
    with pytest.raises(incise.BadArgument):
        engine.keep_undo(-1)


def test_a_blade_file_may_stop_at_a_region(tmp_path):
    box = incise.box((6, 6, 6)).compact()
    middles = box.points[box.tets].mean(axis=1)
    engine = incise.Engine(box.points, box.tets, np.where(middles[:, 2] < 0.5, 7, 1))
    edges = [{"t": t, "points": [[-0.1 + 1.2 * t, 0.52, 1.2], [-0.1 + 1.2 * t, 0.52, 0.1]]} for t in (0, 1)]
    blade = tmp_path / "blade.json"
    blade.write_text(json.dumps({"format": "incise-blade", "version": 1, "strokes": [{"stop_at": [7], "edges": edges}]}))
    engine.cut_blade(blade)
    walls = engine.surface()
    depths = engine.rest[walls.triangles[walls.tags > 0]][:, :, 2]
    assert len(depths) > 10 and depths.min() > 0.5
    blade.write_text(blade.read_text().replace("[7]", '["fat"]'))
    with pytest.raises(incise.BadFile, match="fat"):
        engine.cut_blade(blade)
