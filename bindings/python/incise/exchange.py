# SPDX-License-Identifier: Apache-2.0
"""To and from other packages. They are imported where they are used: none of them is needed otherwise."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from .errors import BadArgument, shown

if TYPE_CHECKING:
    from .mesh import Mesh

_REGION_NAMES = ("region", "gmsh:physical", "medit:ref", "cell_tags")
_VTK_TETRA = 10


def arrays_of_meshio(mesh: Any, regions: Optional[str]) -> tuple[Any, Any, Any]:
    """Points, tets and regions of a `meshio.Mesh`; points that no tet uses are left out."""
    if not all(hasattr(mesh, name) for name in ("points", "cells", "cell_data")):
        raise TypeError(f"{shown(mesh)} is no mesh of meshio; read one with meshio.read(path)")
    blocks = [index for index, block in enumerate(mesh.cells) if block.type in ("tetra", "tetra10")]
    if not blocks:
        raise BadArgument("the mesh has no tets; its cells are " + ", ".join(block.type for block in mesh.cells))
    tets = np.concatenate([np.asarray(mesh.cells[index].data)[:, :4] for index in blocks])
    used, numbered = np.unique(tets, return_inverse=True)
    points = np.asarray(mesh.points, np.float64)
    if points.ndim != 2 or points.shape[1] != 3:
        raise BadArgument(f"the points have the shape {points.shape}; n x 3 is wanted")
    name = regions or next((known for known in _REGION_NAMES if known in mesh.cell_data), None)
    if name is None:
        return points[used], numbered.reshape(tets.shape), None
    if name not in mesh.cell_data:
        raise BadArgument(f"the mesh has no cell data {name!r}; it has " + ", ".join(map(repr, mesh.cell_data)))
    labels = np.concatenate([np.asarray(mesh.cell_data[name][index]).ravel() for index in blocks])
    return points[used], numbered.reshape(tets.shape), labels


def to_meshio(mesh: "Mesh", pose: str) -> Any:
    """See `Engine.to_meshio`."""
    import meshio  # type: ignore[import]

    compact, surface = mesh.compact(pose), mesh.surface()
    is_wall = surface.tags > 0
    number = np.full(len(mesh.rest), -1, np.int64)
    number[compact.vertex_slots] = np.arange(len(compact.points))
    walls = number[surface.triangles[is_wall]]
    cells = [("tetra", compact.tets.astype(np.int64))]
    data = {"region": [compact.regions], "piece": [compact.pieces.astype(np.int32)],
            "stroke": [np.zeros(len(compact.tets), np.int32)]}
    if len(walls):
        cells.append(("triangle", walls))
        data["region"].append(np.zeros(len(walls), np.int32))
        data["piece"].append(np.full(len(walls), -1, np.int32))
        data["stroke"].append(surface.tags[is_wall].astype(np.int32))
    return meshio.Mesh(compact.points, cells, cell_data=data)


def to_pyvista(mesh: "Mesh", pose: str) -> Any:
    """See `Engine.to_pyvista`."""
    import pyvista  # type: ignore[import]

    compact = mesh.compact(pose)
    n = len(compact.tets)
    cells = np.hstack([np.full((n, 1), 4), compact.tets.astype(np.int64)]).ravel()
    grid = pyvista.UnstructuredGrid(cells, np.full(n, _VTK_TETRA, np.uint8), compact.points)
    grid.cell_data["region"] = compact.regions
    grid.cell_data["piece"] = compact.pieces.astype(np.int32)
    return grid
