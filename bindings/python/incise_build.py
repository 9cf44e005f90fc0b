# SPDX-License-Identifier: Apache-2.0
"""Builds the wheel (PEP 517), with CMake and Python's own library alone: nothing has to be fetched.

The shared library is compiled in build/python, without oneTBB, so that the wheel asks little of the machine it is used
on. $INCISE_LIBRARY names one that is there already; --config-settings=cmake=ARGUMENTS are handed to CMake.
"""
from __future__ import annotations

import base64
import hashlib
import os
import re
import shlex
import subprocess
import sys
import sysconfig
import tarfile
import zipfile
from pathlib import Path
from typing import Any, Optional

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = Path(__file__).resolve().parent / "incise"
Settings = Optional[dict[str, Any]]
_EPOCH = (1980, 1, 1, 0, 0, 0)  # of what is in the wheel, so that equal sources give equal wheels


def _version() -> str:
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    found = re.search(r"project\(incise VERSION ([0-9.]+)", text)
    if found is None:
        raise RuntimeError("CMakeLists.txt names no version")
    return found[1]


def _metadata() -> str:
    head = ["Metadata-Version: 2.1", "Name: incise-mesh", "Version: " + _version(),
            "Summary: Cuts tetrahedral models in real time and keeps the mesh fit to simulate", "License: Apache-2.0",
            "Requires-Python: >=3.9", "Requires-Dist: numpy", "Provides-Extra: exchange",
            "Requires-Dist: meshio; extra == 'exchange'", "Requires-Dist: pyvista; extra == 'exchange'",
            "Description-Content-Type: text/markdown"]
    return "\n".join(head) + "\n\n" + (ROOT / "docs" / "python.md").read_text(encoding="utf-8")


def _tag() -> str:
    return "py3-none-" + re.sub("[-.]", "_", sysconfig.get_platform())


def _library(settings: Settings) -> Path:
    given = os.environ.get("INCISE_LIBRARY")
    if given:
        return Path(given)
    build = ROOT / "build" / "python"
    arguments = shlex.split(str((settings or {}).get("cmake", "")))
    off = ["APPS", "VIEW", "EXAMPLES", "TESTS", "DETERMINISM"]
    options = ["-DINCISE_BUILD_%s=OFF" % name for name in off]
    jobs = os.environ.get("INCISE_JOBS", str(os.cpu_count() or 1))
    shared = {} if " " in str(ROOT) else {"CCACHE_BASEDIR": str(ROOT), "CCACHE_NOHASHDIR": "1"}  # see script/lib/common.sh
    environment = dict(os.environ, **shared)
    for command in (["cmake", "-S", str(ROOT), "-B", str(build), "-DCMAKE_BUILD_TYPE=Release",
                     "-DCMAKE_UNITY_BUILD=ON", "-DINCISE_BUILD_C=ON",
                     "-DINCISE_WITH_TBB=OFF", "-DINCISE_INSTALL=OFF", "-DINCISE_WERROR=OFF"] + options + arguments,
                    ["cmake", "--build", str(build), "-j", jobs, "--target", "incise_c"]):
        subprocess.run(command, check=True, env=environment)
    return build / "bindings" / "c" / "libincise.so.0"


def _stripped(library: Path) -> bytes:
    copy = library.with_suffix(".stripped")
    try:
        subprocess.run(["strip", "--strip-unneeded", "-o", str(copy), str(library)], check=True)
        return copy.read_bytes()
    except (OSError, subprocess.CalledProcessError):  # larger, and as good
        return library.read_bytes()
    finally:
        copy.unlink(missing_ok=True)


class _Wheel:
    """A wheel under way: files, and the list of them that closes it."""

    def __init__(self, path: Path) -> None:
        self._zip = zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED)
        self._records: list[str] = []

    def add(self, name: str, content: bytes) -> None:
        entry = zipfile.ZipInfo(name, _EPOCH)
        entry.external_attr, entry.compress_type = 0o644 << 16, zipfile.ZIP_DEFLATED
        self._zip.writestr(entry, content)
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        self._records.append("%s,sha256=%s,%d" % (name, digest, len(content)))

    def close(self, info: str) -> None:
        self._zip.writestr(zipfile.ZipInfo(info + "/RECORD", _EPOCH),
                           "\n".join(self._records + [info + "/RECORD,,"]) + "\n")
        self._zip.close()


def get_requires_for_build_wheel(config_settings: Settings = None) -> list[str]:
    """Nothing."""
    return []


def get_requires_for_build_sdist(config_settings: Settings = None) -> list[str]:
    """Nothing."""
    return []


def _wheel_note() -> str:
    return "Wheel-Version: 1.0\nGenerator: incise_build\nRoot-Is-Purelib: false\nTag: %s\n" % _tag()


def prepare_metadata_for_build_wheel(metadata_directory: str, config_settings: Settings = None) -> str:
    """What pip asks for first: without this it would compile the library to know the version."""
    info = write_metadata(Path(metadata_directory))
    (info / "WHEEL").write_text(_wheel_note(), encoding="utf-8")
    return info.name


def build_wheel(wheel_directory: str, config_settings: Settings = None,
                metadata_directory: Optional[str] = None) -> str:
    """Compiles the library and packs the wheel; returns its name."""
    library = _library(config_settings)
    name = "incise_mesh-%s-%s.whl" % (_version(), _tag())
    info = "incise_mesh-%s.dist-info" % _version()
    wheel = _Wheel(Path(wheel_directory) / name)
    for path in sorted(PACKAGE.glob("*.py")) + [PACKAGE / "py.typed"]:
        wheel.add("incise/" + path.name, path.read_bytes())
    wheel.add("incise/libincise.so.0", _stripped(library))
    for path in (ROOT / "LICENSE", ROOT / "THIRD_PARTY.md"):
        wheel.add(info + "/" + path.name, path.read_bytes())
    wheel.add(info + "/METADATA", _metadata().encode())
    wheel.add(info + "/WHEEL", _wheel_note().encode())
    wheel.close(info)
    return name


def build_sdist(sdist_directory: str, config_settings: Settings = None) -> str:
    """Packs what git tracks; returns the archive's name."""
    top = "incise_mesh-" + _version()
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True).stdout.decode()
    archive = Path(sdist_directory) / (top + ".tar.gz")
    pkg_info = archive.with_name("PKG-INFO")
    pkg_info.write_text(_metadata(), encoding="utf-8")
    with tarfile.open(archive, "w:gz", format=tarfile.PAX_FORMAT) as out:
        for name in filter(None, listed.split("\0")):
            out.add(ROOT / name, top + "/" + name, recursive=False)
        out.add(pkg_info, top + "/PKG-INFO")
    pkg_info.unlink()
    return archive.name


def write_metadata(folder: Path) -> Path:
    """Writes what `importlib.metadata` and pip know the package by, where there is no wheel; returns its folder."""
    info = folder / ("incise_mesh-%s.dist-info" % _version())
    info.mkdir(parents=True, exist_ok=True)
    (info / "METADATA").write_text(_metadata(), encoding="utf-8")
    return info


if __name__ == "__main__":
    write_metadata(Path(sys.argv[1]))
