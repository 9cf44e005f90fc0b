# SPDX-License-Identifier: Apache-2.0
"""Runs a recipe of examples/batch and compares what it merges with one run. usage: recipes.py RECIPE FOLDER

FOLDER has the program incise. Ends with 77 where what the recipe needs is not there.
"""
import importlib.util
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import one_machine_slurm

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "batch"
PLAN = EXAMPLES / "small.json"


def skip(what: str) -> None:
    print("skipped: " + what + " is not installed")
    sys.exit(77)


def need_module(name: str, package: str) -> None:
    if importlib.util.find_spec(name) is None:
        skip(package)


def need_program(name: str, package: str) -> None:
    if shutil.which(name) is None:
        skip(package)


def with_xargs(out: Path) -> None:
    need_program("xargs", "findutils")
    subprocess.run([EXAMPLES / "with_xargs.sh", PLAN, out, "3"], check=True)


def with_slurm(out: Path) -> None:
    """By Slurm where it is installed and this is root; else as Slurm runs the script, task by task."""
    out.mkdir()
    environment = dict(os.environ, PLAN=str(PLAN), OUT=str(out))
    if one_machine_slurm.can_be_started():
        with one_machine_slurm.Slurm():
            environment = dict(environment, PATH=os.environ["PATH"], SLURM_CONF=os.environ["SLURM_CONF"])
            subprocess.run(["sbatch", "--wait", "--array=4-6", "--output=%s.log" % out, EXAMPLES / "slurm_array.sh"],
                           check=True, env=environment, timeout=200)
        print("run by Slurm")
    else:
        for task in range(4, 7):
            variables = {"ID": task, "MIN": 4, "MAX": 6, "STEP": 1, "COUNT": 3}
            told = {"SLURM_ARRAY_TASK_" + key: str(value) for key, value in variables.items()}
            subprocess.run([EXAMPLES / "slurm_array.sh"], check=True, env=dict(environment, **told))
        print("slurmctld, slurmd and munge are not installed, or this is not root: not run by Slurm itself")
    if len(list(out.glob("shard-*-of-00003.jsonl"))) != 3:
        sys.exit("three tasks have not made three shards")
    subprocess.run(["incise", "-q", "batch", PLAN, "-o", out, "--merge"], check=True)


def with_dask(out: Path) -> None:
    need_module("distributed", "python3-distributed")
    subprocess.run([sys.executable, EXAMPLES / "with_dask.py", PLAN, out, "5"], check=True)


def with_mpi(out: Path) -> None:
    need_module("mpi4py", "python3-mpi4py")
    need_program("mpirun", "openmpi-bin")
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                       OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_btl_vader_single_copy_mechanism="none")
    subprocess.run(["mpirun", "-n", "2", sys.executable, EXAMPLES / "with_mpi.py", PLAN, out], check=True,
                   env=environment, stdin=subprocess.DEVNULL)


def data_card(whole: Path) -> None:
    """The card's figures are those of the results, and it names each column."""
    subprocess.run(["incise", "-q", "batch", PLAN, "-o", whole, "--merge"], check=True)
    card = subprocess.run([sys.executable, EXAMPLES / "data_card.py", whole / "results.jsonl"], check=True,
                          stdout=subprocess.PIPE, text=True).stdout
    rows = [json.loads(line) for line in (whole / "results.jsonl").read_text(encoding="utf-8").splitlines()]
    peak = max(row["forces"]["peak_force"] for row in rows)
    for text in ("| train | 8 |", "| test | 4 |", "12 items", "%.5g" % peak):
        if text not in card:
            sys.exit("the card has no '%s':\n%s" % (text, card))


def files(out: Path) -> dict[str, bytes]:
    """All that was written, but for the lines of each shard."""
    return {str(path.relative_to(out)): path.read_bytes() for path in out.rglob("*")
            if path.is_file() and not path.name.startswith("shard-")}


def main(recipe: str, programs: str) -> None:
    os.environ["PATH"] = programs + os.pathsep + os.environ["PATH"]
    recipes = {"xargs": with_xargs, "slurm": with_slurm, "dask": with_dask, "mpi": with_mpi}
    with tempfile.TemporaryDirectory(prefix="incise batch ") as folder:
        whole, parts = Path(folder) / "whole", Path(folder) / "parts"
        if recipe in recipes:
            recipes[recipe](parts)  # first, since it may be skipped
        subprocess.run(["incise", "-q", "batch", PLAN, "-o", whole], check=True)
        if recipe == "card":
            return data_card(whole)
        subprocess.run(["incise", "-q", "batch", PLAN, "-o", whole, "--merge"], check=True)
        wanted, found = files(whole), files(parts)
        if len(wanted) != 12 * 2 + 2 or wanted != found:
            differing = [name for name in wanted.keys() | found.keys() if wanted.get(name) != found.get(name)]
            sys.exit("%d files; these differ: %s" % (len(wanted), sorted(differing)[:10]))
        print("%d files, the same as by one run" % len(wanted))


if __name__ == "__main__":
    main(*sys.argv[1:])
