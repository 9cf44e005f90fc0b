# SPDX-License-Identifier: Apache-2.0
import sys
import types

import numpy as np
import pytest

import incise


def cut_box():
    engine = incise.box((3, 3, 3))
    engine.cut_plane((1, 0.2, 0), 0.5)
    return engine


def test_meshio_and_back():
    pytest.importorskip("meshio")
    engine = cut_box()
    mesh = engine.to_meshio()
    assert len(mesh.points) == engine.vertex_count
    assert [block.type for block in mesh.cells] == ["tetra", "triangle"]
    assert set(mesh.cell_data["stroke"][1].tolist()) == {1} and set(mesh.cell_data["piece"][0].tolist()) == {0, 1}
    again = incise.Engine.from_meshio(mesh)
    assert again.tet_count == engine.tet_count and np.array_equal(again.rest, mesh.points)


def test_meshio_of_other_makers():
    meshio = pytest.importorskip("meshio")
    points = np.array([[9, 9, 9], [0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    tets = np.array([[1, 3, 2, 4]])  # turned
    mesh = meshio.Mesh(points, [("triangle", np.array([[1, 2, 3]])), ("tetra", tets)],
                       cell_data={"label": [np.array([7]), np.array([5])]})
    engine = incise.Engine.from_meshio(mesh, regions="label")
    assert engine.vertex_count == 4 and engine.regions.tolist() == [5]
    with pytest.raises(incise.BadArgument, match="label"):
        incise.Engine.from_meshio(mesh, regions="what")
    with pytest.raises(incise.BadArgument, match="triangle"):
        incise.Engine.from_meshio(meshio.Mesh(points, [("triangle", np.array([[1, 2, 3]]))]))


@pytest.mark.parametrize("extension", [".vtk", ".vtu", ".mesh", ".inp"])
def test_meshio_reads_what_is_written(tmp_path, extension):
    meshio = pytest.importorskip("meshio")
    engine = cut_box()
    engine.write(tmp_path / ("cut" + extension))
    mesh = meshio.read(tmp_path / ("cut" + extension))
    assert sum(len(block.data) for block in mesh.cells if block.type == "tetra") == engine.tet_count
    assert np.allclose(mesh.points, engine.compact().points)


def test_pyvista_gets_its_arrays(monkeypatch):
    """PyVista is in no package of Debian 12: a stand-in keeps what it is given, unless the real one is there."""
    try:
        import pyvista  # noqa: F401
    except ImportError:
        stand_in = types.ModuleType("pyvista")
        stand_in.UnstructuredGrid = lambda cells, kinds, points: types.SimpleNamespace(
            cells=cells, celltypes=kinds, points=points, n_cells=len(kinds), cell_data={})
        monkeypatch.setitem(sys.modules, "pyvista", stand_in)
    engine = cut_box()
    grid = engine.to_pyvista()
    assert grid.n_cells == engine.tet_count and set(grid.celltypes) == {10}
    assert np.array_equal(np.asarray(grid.cells).reshape(-1, 5)[:, 1:], engine.compact().tets)
    assert set(np.asarray(grid.cell_data["piece"]).tolist()) == {0, 1}
