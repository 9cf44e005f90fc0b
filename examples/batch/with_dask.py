#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A batch by Dask. usage: with_dask.py PLAN OUT [SHARDS] [SCHEDULER]

Without a scheduler's address two workers are started here. More shards than workers even out what items cost.
"""
import subprocess
import sys
from typing import Optional

from dask.distributed import Client, LocalCluster


def compute(plan: str, out: str, shard: str) -> str:
    """One shard, on a worker; what was done before is skipped."""
    subprocess.run(["incise", "-q", "batch", plan, "-o", out, "--shard", shard], check=True)
    return shard


def main(plan: str, out: str, shards: str = "8", scheduler: Optional[str] = None) -> None:
    where = scheduler or LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
    with Client(where) as client:
        parts = ["%d/%s" % (i, shards) for i in range(int(shards))]
        client.gather(client.map(compute, [plan] * len(parts), [out] * len(parts), parts, pure=False, retries=3))
    subprocess.run(["incise", "-q", "batch", plan, "-o", out, "--merge"], check=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
