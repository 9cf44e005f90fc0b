# SPDX-License-Identifier: Apache-2.0
"""Whether incise_first, with which script/demo makes its first picture, does as the command does.

usage: first_program.py FIRST INCISE
"""
import os
import re
import subprocess
import sys
import tempfile

from other_readers import write_cube

BLADE = """{"format": "incise-blade", "version": 1, "strokes": [{"name": "deep", "edges": [
  {"t": 0, "points": [[-1, 2.3, 5], [-1, 2.4, 1.1]]}, {"t": 1, "points": [[5, 2.3, 5], [5, 2.6, 1.1]]}]}]}"""
CALLS = (
    ("cut", "--help"),
    ("help", "check"),
    ("cut", "cube.mesh", "--blade", "blade.json", "-o", "cut.vtu", "--picture", "cut.png", "--record", "cut.jsonl"),
    ("cut", "cube.mesh", "--blade", "blade.json", "-o", "cut.vtu", "--stop-at", "2", "--snap", "0", "--profile", "paper"),
    ("cut", "cube.mesh", "--plane", "1,0,0,1.3", "-o", "cut.mesh", "--profile", "removal"),
    ("cut", "cube.mesh", "--plane", "1,0,0,1.3", "--snap", "9"),
    ("cut", "cube.mesh", "--plan", "1,0,0,1.3"),
    ("cut", "missing.mesh", "--plane", "1,0,0,1.3"),
    ("check", "cube.mesh"),
    ("check", "cut.vtu", "--json"),
)
TIMES = re.compile(r"[0-9.]+(e-?[0-9]+)? ms")


def read(path):
    with open(path, "rb") as file:
        return file.read()


def outcomes(program):
    """What each call says and leaves in its folder, but for the times that it took."""
    found = []
    with tempfile.TemporaryDirectory() as folder:
        write_cube(os.path.join(folder, "cube.mesh"), (1, 2))
        with open(os.path.join(folder, "blade.json"), "w", encoding="ascii") as file:
            file.write(BLADE)
        for call in CALLS:
            done = subprocess.run((program,) + call, cwd=folder, capture_output=True, text=True, check=False)
            found.append({"exit": done.returncode, "stdout": TIMES.sub("ms", done.stdout), "stderr": done.stderr})
            found[-1].update((name, read(os.path.join(folder, name))) for name in os.listdir(folder))
    return found


def main(first, incise):
    differ = 0
    for call, ours, theirs in zip(CALLS, outcomes(os.path.abspath(first)), outcomes(os.path.abspath(incise))):
        print("incise %s: exit %d" % (" ".join(call), theirs["exit"]))
        for what in sorted(ours.keys() | theirs.keys()):
            if ours.get(what) != theirs.get(what):
                print("  %s is %.300r, not %.300r" % (what, ours.get(what), theirs.get(what)))
                differ += 1
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]) if len(sys.argv) == 3 else __doc__)
