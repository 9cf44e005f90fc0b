# SPDX-License-Identifier: Apache-2.0
"""Prints what the steps of a blade cost from Python and from C, on the bunny where models/ has it; both have to leave
the same hash. No time is asserted. INCISE_CAMPAIGNS_ALL=1 for ten rounds of 96 steps, whose figures tell something; one
round of 48 otherwise.

usage: step_cost.py PROGRAM [MESH] [--instructions]
  PROGRAM         built from tests/c/step_cost.c
  --instructions  counts instructions by valgrind instead of CPU time: slow, and the same on a busy machine
"""
import ctypes
import os
import re
import subprocess
import sys
import time

SKIPPED = 77
ROUNDS, STEPS = (10, 96) if "INCISE_CAMPAIGNS_ALL" in os.environ else (1, 48)

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed for", sys.executable)
    sys.exit(SKIPPED)

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "bindings", "python"))
import incise  # noqa: E402
from incise._library import lib  # noqa: E402


def place(low, high, share):
    """As in step_cost.c, to the bit."""
    x, (width, y, z) = 0.5 * (low[0] + high[0]), high - low
    level = high[2] + 0.05 * z - 1.1 * share * z
    return [[x - 0.02 * width, low[1] - 0.1 * y, level], [x + 0.03 * width, high[1] + 0.1 * y, level]]


class Body:
    """A mesh, and the stroke through it."""

    def __init__(self, mesh):
        self.engine = incise.box((12, 12, 12)) if mesh == "-" else incise.read(mesh)
        points = self.engine.rest[self.engine.live_vertices]
        low, high = points.min(axis=0), points.max(axis=0)
        self.first, *self.edges = [np.array(place(low, high, i / STEPS)) for i in range(STEPS + 1)]

    def cut_once(self):
        """CPU ms of each step, and the hash that they leave."""
        engine, ms = self.engine, []
        engine.begin_stroke(self.first)
        for edge in self.edges:
            began = time.process_time()
            engine.step(edge)
            ms.append(1e3 * (time.process_time() - began))
        engine.end_stroke()
        left = "%016x" % engine.hash
        engine.undo()
        return ms, left


class BareBody(Body):
    """The same, stepped by bare calls of the library with arguments that are there already."""

    def __init__(self, mesh):
        super().__init__(mesh)
        self.report = incise.Report(ctypes.sizeof(incise.Report))
        handle = self.engine._handle.pointer  # pylint: disable=protected-access
        self.calls = [(handle, edge.ctypes.data_as(ctypes.c_void_p), 2, None, ctypes.byref(self.report))
                      for edge in self.edges]


def compare_in_turns(mesh):
    """ms of each step, bare and by the package: medians over rounds in which each step is made both ways, one after the
    other, in one process. What a busy machine does to one it does to the other."""
    bare, whole, rounds = BareBody(mesh), Body(mesh), []
    call, now = lib.incise_engine_step, time.thread_time_ns
    for number in range(ROUNDS):
        for body in (bare, whole):
            body.engine.begin_stroke(body.first)
        ms = np.empty((STEPS, 2))
        for step, (arguments, edge) in enumerate(zip(bare.calls, whole.edges)):
            for which in ((0, 1), (1, 0))[(number + step) % 2]:
                began = now()
                if which:
                    whole.engine.step(edge)
                else:
                    call(*arguments)
                ms[step, which] = 1e-6 * (now() - began)
        rounds.append(ms)
        for body in (bare, whole):
            body.engine.end_stroke()
            body.engine.undo()
    return np.median(rounds, axis=0).sum(axis=0)


def cost_of_views(engine):
    """us for one view, which does not depend on the mesh: nothing is copied."""
    began = time.process_time()
    for _ in range(1000):
        engine.rest, engine.tets
    return 1e3 * (time.process_time() - began) / 2


def run(command):
    """The hash that a program leaves, and CPU ms of each step."""
    left, *ms = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
    return [float(step) for step in ms], left


def python_command(mesh, rounds):
    """Does in Python what step_cost.c does, and prints the same."""
    return [sys.executable, os.path.abspath(__file__), "--strokes", mesh, str(rounds)]


def compare_times(program, mesh):
    """Each step's least over programs that take turns: what else a busy machine does falls on few steps of a round, and
    where a program happens to lie in memory, which is a few percent, on few rounds."""
    in_python, in_c = [], []
    for _ in range(ROUNDS):
        in_python.append(run(python_command(mesh, 2)))
        in_c.append(run([program, mesh, "2", str(STEPS)]))
    cost_in_python, cost_in_c = (np.min([ms for ms, _ in rounds], axis=0).sum() for rounds in (in_python, in_c))
    engine = Body(mesh).engine
    print("%s, %d tets, %d steps, CPU: C %.1f ms, Python %.1f ms (%+.1f %%), %.1f us more per step" %
          (os.path.basename(mesh), engine.tet_count, STEPS, cost_in_c, cost_in_python,
           100 * (cost_in_python / cost_in_c - 1), 1e3 * (cost_in_python - cost_in_c) / STEPS))
    bare, whole = compare_in_turns(mesh)
    print("in one process, in turns, medians: bare calls %.1f ms, the package %.1f ms (%+.1f %%), %.1f us more per step" %
          (bare, whole, 100 * (whole / bare - 1), 1e3 * (whole - bare) / STEPS))
    print("a view of %d rows: %.1f us" % (len(engine.tets), cost_of_views(engine)))
    hashes = {left for _, left in in_python + in_c}
    if len(hashes) != 1:
        print("hashes differ:", hashes)
        return 1
    return 0


def instructions_of(command):
    """How many a program takes, by valgrind."""
    run = subprocess.run(["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"] + command,
                         check=True, capture_output=True, text=True)
    return int(re.search(r"I\s+refs:\s+([\d,]+)", run.stderr).group(1).replace(",", ""))


def compare_instructions(program, mesh):
    """Two strokes more against none more: what comes before and after them is the same."""
    def of_a_step(command):
        return (instructions_of(command(3)) - instructions_of(command(1))) / (2 * STEPS)

    in_c = of_a_step(lambda rounds: [program, mesh, str(rounds), str(STEPS)])
    in_python = of_a_step(lambda rounds: python_command(mesh, rounds))
    print("%s, %d steps, instructions of a step with its share of beginning, ending and taking back: C %.0f, Python %.0f "
          "(%+.2f %%)" % (os.path.basename(mesh), STEPS, in_c, in_python, 100 * (in_python / in_c - 1)))
    return 0


def main(arguments):
    if arguments[0] == "--strokes":
        body = Body(arguments[1])
        rounds = [body.cut_once() for _ in range(int(arguments[2]))]
        print(rounds[-1][1], *("%.4f" % ms for ms in np.min([ms for ms, _ in rounds], axis=0)), sep="\n")
        return 0
    counts = "--instructions" in arguments
    program, *mesh = [argument for argument in arguments if argument != "--instructions"]
    bunny = os.path.join(ROOT, "models", "bunny.mesh")
    chosen = mesh[0] if mesh else bunny if os.path.exists(bunny) else "-"
    return (compare_instructions if counts else compare_times)(program, chosen)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]) if len(sys.argv) > 1 else __doc__)
