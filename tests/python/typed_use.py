# SPDX-License-Identifier: Apache-2.0
"""What a user's program looks like to mypy; never run."""
from __future__ import annotations

import numpy as np
import numpy.typing as npt

import incise


def cut_all(path: str, offsets: list[float]) -> list[int]:
    """Uses what the types promise."""
    engine: incise.Engine = incise.read(path, snap=0.1)
    created: list[int] = [engine.cut_plane((1, 0, 0), offset).created_tets for offset in offsets]
    rest: npt.NDArray[np.float64] = engine.rest
    tets: npt.NDArray[np.uint32] = engine.compact().tets
    steps: list[incise.Step] = engine.journal()
    valid: bool = engine.validate().ok
    print(rest.shape, tets.shape, len(steps), valid)
    return created


def many(plan: str, out: str) -> list[str]:
    """Likewise."""
    done: int = incise.batch.run(plan, out, (0, 4), progress=lambda done, total: None).done
    print(done, incise.batch.merge(plan, out).is_whole)
    return [str(line["name"]) for line in incise.batch.results(out)]


def simulate(path: str) -> float:
    """Likewise."""
    body: incise.Simulation = incise.Simulation.from_scene(path)
    frames: list[incise.Frame] = body.run(3)
    mesh: incise.Mesh = body.mesh
    force: npt.NDArray[np.float64] = frames[0].blade_force
    return float(force[2]) + mesh.quality().lr_mean
