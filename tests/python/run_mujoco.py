# SPDX-License-Identifier: Apache-2.0
"""Runs the example with MuJoCo; ends with 77 (skipped) where numpy, node or the npm package @mujoco/mujoco is not there."""
import importlib.util
import os
import shutil
import subprocess
import sys

SKIPPED = 77
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
EXAMPLE = os.path.join(ROOT, "examples", "mujoco")


def main():
    if importlib.util.find_spec("numpy") is None:
        return "numpy (python3-numpy)"
    if shutil.which("node") is None:
        return "node (nodejs)"
    if not os.path.isdir(os.path.join(EXAMPLE, "node_modules", "@mujoco", "mujoco")):
        return "@mujoco/mujoco (npm --prefix examples/mujoco install)"
    environment = dict(os.environ, PYTHONPATH=os.path.join(ROOT, "bindings", "python"))
    done = subprocess.run([sys.executable, os.path.join(EXAMPLE, "cut_while_it_hangs.py")], env=environment, check=False)
    return done.returncode


if __name__ == "__main__":
    outcome = main()
    if isinstance(outcome, str):
        print("skipped: %s is not installed" % outcome)
        outcome = SKIPPED
    sys.exit(outcome)
