# SPDX-License-Identifier: Apache-2.0
"""Slurm on this machine alone, for as long as a `with` lasts: Debian's programs, started by hand without services."""
import os
import shutil
import socket
import subprocess
import tempfile
import time
from pathlib import Path
from types import TracebackType
from typing import Optional, Type

NEEDED = ("munged", "slurmctld", "slurmd", "sbatch", "sinfo")
SECONDS = 60  # until the node is idle
CONFIGURATION = """ClusterName=incise
SlurmctldHost={host}(127.0.0.1)
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
CredType=cred/munge
SlurmUser=root
SlurmctldPort={control}
SlurmdPort={node}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs={processors} State=UNKNOWN
PartitionName=main Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def can_be_started() -> bool:
    """Its daemons change users, so that root alone can start them."""
    os.environ["PATH"] += os.pathsep + "/usr/sbin"
    return os.geteuid() == 0 and all(shutil.which(name) for name in NEEDED)


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


class Slurm:
    """`with Slurm():` sbatch finds it by $SLURM_CONF."""

    def __init__(self) -> None:
        self._folder = Path(tempfile.mkdtemp(prefix="incise_slurm_"))
        self._running: list[subprocess.Popen[bytes]] = []

    def __enter__(self) -> "Slurm":
        self._folder.chmod(0o755)
        for name in ("munge", "state", "spool"):
            (self._folder / name).mkdir(mode=0o755)
        key = self._folder / "munge" / "key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        configuration = self._folder / "slurm.conf"
        configuration.write_text(CONFIGURATION.format(
            host=socket.gethostname().split(".")[0], folder=self._folder, control=_free_port(), node=_free_port(),
            processors=os.cpu_count()), encoding="utf-8")
        os.environ["SLURM_CONF"] = str(configuration)
        munge = str(self._folder / "munge")
        self._start("munged", "-F", "--force", "--socket=%s/socket" % munge, "--key-file=%s/key" % munge,
                    "--pid-file=%s/pid" % munge, "--seed-file=%s/seed" % munge, "--log-file=%s/log" % munge)
        self._start("slurmctld", "-D")
        self._start("slurmd", "-D")
        try:
            self._wait_until_idle()
        except BaseException:
            self.__exit__(None, None, None)
            raise
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        for process in reversed(self._running):
            process.terminate()
            try:
                process.wait(timeout=20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        shutil.rmtree(self._folder, ignore_errors=True)

    def _start(self, *command: str) -> None:
        log = open(self._folder / (command[0] + ".log"), "wb")
        self._running.append(subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log))

    def _wait_until_idle(self) -> None:
        end = time.monotonic() + SECONDS
        while time.monotonic() < end:
            state = subprocess.run(["sinfo", "-h", "-o", "%T"], capture_output=True, text=True)
            if state.stdout.strip() == "idle":
                return
            time.sleep(0.3)
        logs = "\n".join(path.read_text(errors="replace")[-1000:] for path in self._folder.glob("*.log"))
        raise RuntimeError("Slurm did not start:\n" + logs)
