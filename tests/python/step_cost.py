# SPDX-License-Identifier: Apache-2.0
"""Prints what the steps of a blade cost from Python and from C, on the bunny where models/ has it; both have to leave
the same hash. No time is asserted. usage: step_cost.py PROGRAM [MESH]     PROGRAM: tests/c/step_cost.c"""
import os
import subprocess
import sys
import time

SKIPPED = 77
ROUNDS, STEPS = 10, 96

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed for", sys.executable)
    sys.exit(SKIPPED)

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "bindings", "python"))
import incise  # noqa: E402


def place(low, high, share):
    """As in step_cost.c, to the bit."""
    x, (width, y, z) = 0.5 * (low[0] + high[0]), high - low
    level = high[2] + 0.05 * z - 1.1 * share * z
    return [[x - 0.02 * width, low[1] - 0.1 * y, level], [x + 0.03 * width, high[1] + 0.1 * y, level]]


def cut_once(engine, low, high):
    first, *edges = [np.array(place(low, high, i / STEPS)) for i in range(STEPS + 1)]
    engine.begin_stroke(first)
    began = time.process_time()
    for edge in edges:
        engine.step(edge)
    ms = 1e3 * (time.process_time() - began)
    engine.end_stroke()
    left = "%016x" % engine.hash
    engine.undo()
    return ms, left


def cost_of_views(engine):
    """us for one view, which does not depend on the mesh: nothing is copied."""
    began = time.process_time()
    for _ in range(1000):
        engine.rest, engine.tets
    return 1e3 * (time.process_time() - began) / 2


def main(program, mesh):
    engine = incise.box((12, 12, 12)) if mesh == "-" else incise.read(mesh)
    points = engine.rest[engine.live_vertices]
    low, high = points.min(axis=0), points.max(axis=0)
    rounds, rounds_in_c = [], []
    for _ in range(ROUNDS):  # in turns, so that a busy machine slows both down
        rounds.append(cut_once(engine, low, high))
        command = [program, mesh, "2", str(STEPS)]
        rounds_in_c.append(subprocess.run(command, check=True, capture_output=True, text=True).stdout.split())
    in_python, left = min(ms for ms, _ in rounds), rounds[0][1]
    in_c, left_by_c = min(float(ms) for ms, _ in rounds_in_c), rounds_in_c[0][1]
    print("%s, %d tets, %d steps, CPU: C %.1f ms, Python %.1f ms (%+.1f %%), %.1f us more per step" %
          (os.path.basename(mesh), engine.tet_count, STEPS, in_c, in_python, 100 * (in_python / in_c - 1),
           1e3 * (in_python - in_c) / STEPS))
    print("a view of %d rows: %.1f us" % (len(engine.tets), cost_of_views(engine)))
    if left != left_by_c or len({hash_left for _, hash_left in rounds}) != 1:
        print("hashes differ: C %s, Python %s" % (left_by_c, left))
        return 1
    return 0


if __name__ == "__main__":
    BUNNY = os.path.join(ROOT, "models", "bunny.mesh")
    DEFAULT = BUNNY if os.path.exists(BUNNY) else "-"
    sys.exit(main(sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else DEFAULT) if len(sys.argv) > 1 else __doc__)
