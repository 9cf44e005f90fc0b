#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A batch by MPI, a shard for each rank. usage: mpirun -n RANKS python3 with_mpi.py PLAN OUT"""
import subprocess
import sys

from mpi4py import MPI

world = MPI.COMM_WORLD
command = ["incise", "-q", "batch", sys.argv[1], "-o", sys.argv[2]]
done = subprocess.run(command + ["--shard", "%d/%d" % (world.rank, world.size)]).returncode
if world.allreduce(abs(done)) != 0:
    sys.exit("rank %d: incise batch ended with %d" % (world.rank, done))
if world.rank == 0:
    subprocess.run(command + ["--merge"], check=True)
