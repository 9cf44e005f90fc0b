# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

import incise


class Mirror:
    """A follower that knows records alone."""

    def __init__(self, mesh):
        self.mesh, self.cursor = mesh, mesh.cursor()
        self.tets = {slot: tuple(mesh.tets[slot]) for slot in mesh.live_tets.tolist()}
        self.rest = {slot: tuple(mesh.rest[slot]) for slot in mesh.live_vertices.tolist()}

    def follow(self):
        steps = self.cursor.new_steps()
        assert steps is not None
        for step in steps:
            for record in step.born:
                self.rest[record["id"]] = tuple(record["rest"])
            for record in step.moved:
                self.rest[record["id"]] = tuple(record["rest"])
            for record in step.copied:
                self.rest[record["id"]] = self.rest[record["source"]]
            for record in step.consumed:
                assert self.tets.pop(record["id"]) == tuple(record["vertices"])
            for record in step.produced:
                self.tets[record["id"]] = tuple(record["vertices"])
            for record in step.rewired:
                self.tets[record["id"]] = tuple(record["vertices"])
            for vertex in step.died:
                del self.rest[vertex]
        return len(steps)

    def expect_equal(self):
        other = Mirror(self.mesh)
        assert self.tets == other.tets and self.rest == other.rest


def test_a_follower_has_the_mesh_after_every_stroke():
    engine = incise.box((4, 4, 4))
    mirror = Mirror(engine)
    for offset in (0.3, 0.55, 0.8):
        engine.cut_plane((1, 0.3 * offset, 0.1), offset)
        assert mirror.follow() > 0
        mirror.expect_equal()
    assert mirror.follow() == 0


def test_a_cursor_tells_of_undo():
    engine = incise.box((3, 3, 3))
    engine.cut_plane((1, 0, 0), 0.4)
    cursor = engine.cursor()
    engine.undo()
    assert cursor.new_steps() is None
    assert cursor.new_steps() == []


def test_weights_give_the_place():
    engine = incise.box((3, 3, 3), merge=False, improve=False, snap=0)
    before = engine.rest.copy()
    report = engine.cut_plane((1, 0.21, 0.13), 0.6)
    step = engine.journal(report.journal_first)[0]
    assert len(step.born) > 0 and not len(step.edits)
    known = {slot: before[slot] for slot in range(len(before))}
    for record in step.born:
        parents = [p for p in record["parents"] if p != incise.NONE]
        place = sum(w * known[p] for w, p in zip(record["weights"], parents))
        assert np.allclose(place, record["rest"], atol=1e-12)
        known[record["id"]] = record["rest"]


def test_steps_that_are_not_kept_are_errors():
    engine = incise.box((3, 3, 3))
    assert engine.journal() == [] and engine.journal_position == 0
    engine.cut_plane((1, 0, 0), 0.4)
    assert len(engine.journal()) == engine.journal_position
    with pytest.raises(incise.BadArgument):
        engine.journal(engine.journal_position + 1)
    with pytest.raises(incise.BadArgument):
        engine.journal(-1)


def test_attributes_keep_sums_and_labels():
    engine = incise.box((4, 4, 4))
    values = incise.Attributes(engine)
    values.add("mass", "tets", "conserve")
    values.add("place", "vertices", "interpolate", width=3)
    values.add("is_skin", "vertices", "recompute", recompute=lambda slot: engine.shapes[slot] & 1)
    values["mass"] = np.arange(len(engine.tets))
    values["place"] = engine.rest
    total = values["mass"].sum()
    engine.cut_plane((1, 0.2, 0.1), 0.6)
    values.follow()
    live = engine.live_vertices
    assert abs(values["mass"][engine.live_tets].sum() - total) < 1e-9 * total
    assert np.allclose(values["place"][live], engine.rest[live], atol=1e-9), "a linear field stays exact"
    assert np.array_equal(values["is_skin"][live], engine.shapes[live] & 1)
    assert "mass" in values and "what" not in values
    engine.undo()
    values.follow()
    assert values["mass"].tolist() == np.arange(len(engine.tets)).tolist()
    with pytest.raises(KeyError):
        values["what"]
    with pytest.raises(incise.BadArgument):
        values.add("mass", "tets")
    with pytest.raises(incise.BadArgument):
        values.add("other", "edges")
    with pytest.raises(ZeroDivisionError):
        values.add("bad", "tets", "recompute", recompute=lambda slot: 1 // 0)
