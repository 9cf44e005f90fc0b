#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A bar that hangs by one end in MuJoCo, and is slit by Incise while it swings.

MuJoCo compiles the topology of a soft body into its model. So each frame in which the cut goes on makes a new model, and
the state is carried over: places are the engine's, which puts new vertices where they are in the moving body; velocities,
and whether a vertex is held, are attributes, which new vertices take from those that they come from.

usage: npm install && python3 cut_while_it_hangs.py [FRAMES]      (needs node, and the Python package of Incise)
"""
from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np

import incise

FRAME, STEPS = 1 / 60, 8  # s; of MuJoCo in a frame
DENSITY, YOUNG, POISSON, DAMPING = 1000.0, 5e4, 0.3, 2e-2  # kg/m³, Pa, 1, s
LENGTH = 0.4  # m
CUT_FRAMES = 40


class Solver:
    """MuJoCo in a process of its own; see solver.mjs."""

    def __init__(self) -> None:
        folder = Path(__file__).resolve().parent
        self._process = subprocess.Popen(["node", "solver.mjs"], cwd=folder, stdin=subprocess.PIPE,
                                         stdout=subprocess.PIPE, text=True)
        self.models = 0

    def __enter__(self) -> "Solver":
        return self

    def __exit__(self, *_what: object) -> None:
        assert self._process.stdin
        self._process.stdin.close()
        self._process.wait(10)

    def _ask(self, request: dict[str, Any]) -> dict[str, Any]:
        assert self._process.stdin and self._process.stdout
        self._process.stdin.write(json.dumps(request) + "\n")
        self._process.stdin.flush()
        line = self._process.stdout.readline()
        if not line:
            raise RuntimeError("MuJoCo ended; what it said is above")
        answer: dict[str, Any] = json.loads(line)
        return answer

    def compile(self, points: np.ndarray, tets: np.ndarray, held: np.ndarray) -> None:
        a, b, c, d = (points[tets[:, k]] for k in range(4))
        mass = DENSITY * np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a).sum() / 6
        self._ask({"points": points.tolist(), "tets": tets.tolist(), "held": held.tolist(), "mass": mass, "young": YOUNG,
                   "poisson": POISSON, "damping": DAMPING, "seconds": FRAME / STEPS})
        self.models += 1

    def advance(self, positions: np.ndarray, velocities: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        answer = self._ask({"positions": positions.tolist(), "velocities": velocities.tolist(), "steps": STEPS})
        return np.array(answer["positions"]), np.array(answer["velocities"])


def blade(frame: int) -> np.ndarray:
    """An edge through the bar's thickness that comes up from its free end, and leaves it at the held one."""
    z = -1.3 * LENGTH + 1.6 * LENGTH * frame / CUT_FRAMES
    return np.array([[0.0, -0.1, z], [0.12, 0.2, z]])


def main(frames: int) -> int:
    bar = incise.box((4, 3, 10), (0, 0, -LENGTH), (0.1, 0.075, 0))
    state = incise.Attributes(bar)
    state.add("velocity", "vertices", "interpolate", 3)
    state.add("held", "vertices", "interpolate")
    state["held"] = np.where(bar.rest[:, 2] == 0, 1.0, 0.0)
    before, live = bar.tet_count, bar.live_vertices
    with Solver() as solver:
        version = -1
        for frame in range(frames + 1):
            if frame == 0:
                bar.begin_stroke(blade(0))
            elif frame <= CUT_FRAMES:
                bar.step(blade(frame))
            if frame == CUT_FRAMES:
                bar.end_stroke()
            state.follow()
            if bar.journal_position != version:
                version, live = bar.journal_position, bar.live_vertices
                number = np.zeros(len(bar.rest), np.int64)
                number[live] = np.arange(len(live))
                held = np.flatnonzero(state["held"][live].reshape(-1) > 1 - 1e-9)
                solver.compile(bar.rest[live], number[bar.tets[bar.live_tets]], held)
            places, speeds = solver.advance(bar.positions[live], state["velocity"][live])
            everywhere = np.array(bar.positions)
            everywhere[live] = places
            bar.set_positions(everywhere)
            velocities = np.array(state["velocity"])
            velocities[live] = speeds
            state["velocity"] = velocities
        models = solver.models
    places, tets = bar.positions[bar.live_vertices], bar.live_tets
    sag = -LENGTH - places[:, 2].min()
    uniform = DENSITY * 9.81 * LENGTH**2 / (2 * YOUNG)
    print(f"{before} -> {len(tets)} tets, {len(bar.pieces())} pieces, {models} models in {frames} frames; they are longer by {1e3 * sag:.1f} mm "
          f"({1e3 * uniform:.1f} mm by the book); valid: {bool(bar.validate())}")
    is_sound = bool(np.isfinite(places).all()) and bool(bar.validate()) and len(bar.pieces()) == 2
    return 0 if is_sound and models > 10 and 0.7 * uniform < sag < 1.5 * uniform else 1


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 60))
