# SPDX-License-Identifier: Apache-2.0
"""Optimises a mesh with Gmsh, as a program of its own: Gmsh is GPL.

usage: gmsh_optimize.py IN.mesh OUT.mesh STEP...     a step is a method of gmsh.model.mesh.optimize

Prints the processor time of the steps in seconds. Only Gmsh's Python interface can optimise a mesh that has no
geometry behind it: the command's -optimize and the script command OptimizeMesh pass over such volumes.
"""
import sys
import time

import gmsh


def optimize(steps):
    """Runs the steps on the mesh at hand; returns their processor time in seconds."""
    start = time.process_time()
    for step in steps:
        gmsh.model.mesh.optimize(step, force=True)
    return time.process_time() - start


def main(mesh, out, *steps):
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("General.NumThreads", 1)
    gmsh.open(mesh)
    seconds = optimize(steps)
    gmsh.option.setNumber("Mesh.SaveAll", 1)
    gmsh.write(out)
    print("%.6f" % seconds)
    gmsh.finalize()


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
