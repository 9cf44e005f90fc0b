# SPDX-License-Identifier: Apache-2.0
"""Makes the Debian packages, unpacks them into an empty root, and uses what is there. usage: packages.py ROOT WORK

Ends with 77 where dpkg-dev is not installed. Without lintian that part is left out, and said so.
"""
import gzip
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

PACKAGES = ["incise", "incise-view", "libincise-dev", "libincise0", "python3-incise"]


def run(*command: Any, **more: Any) -> str:
    """Its output; ends the test where it fails."""
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          **more)
    if done.returncode != 0:
        sys.exit("%s\nended with %d:\n%s" % (" ".join(map(str, command)), done.returncode, done.stdout[-4000:]))
    return done.stdout


def check(holds: bool, what: str) -> None:
    if not holds:
        sys.exit("failed: " + what)
    print("ok: " + what)


class Installed:
    """A root with nothing in it but what the packages bring."""

    def __init__(self, debs: dict[str, Path], work: Path) -> None:
        self.root = work / "root"
        for deb in debs.values():
            run("dpkg-deb", "-x", deb, self.root)
        self.usr = self.root / "usr"
        self.lib = next(self.usr.glob("lib/*/libincise.so.0")).parent
        self.work = work
        self.environment = dict(os.environ, LD_LIBRARY_PATH=str(self.lib), PATH="/usr/bin:/bin")
        self.environment.pop("INCISE_LIBRARY", None)

    def command(self) -> str:
        """Cuts with the command; returns the hash of the mesh."""
        plan = ('{"format": "incise-scene", "version": 1, "model": {"box": {"cells": [2, 2, 2]}}, "length_unit": 1, '
                '"frames": 1}')
        (self.work / "scene.json").write_text(plan, encoding="utf-8")
        incise = self.usr / "bin" / "incise"
        run(incise, "simulate", self.work / "scene.json", env=self.environment)
        run(incise, "--version", env=self.environment)
        report = run(incise, "cut", self.cube(), "--plane", "1,0.2,0,0.6", "--report", "-", env=self.environment)
        return re.search(r'"hash": "([0-9a-f]{16})"', report)[1]

    def cube(self) -> Path:
        """A cube of tets: the corners of one cell, and Kuhn's six."""
        path = self.work / "cube.mesh"
        corners = [(i & 1, i >> 1 & 1, i >> 2) for i in range(8)]
        tets = [(1, 2, 4, 8), (1, 4, 3, 8), (1, 3, 7, 8), (1, 7, 5, 8), (1, 5, 6, 8), (1, 6, 2, 8)]
        rows = ["MeshVersionFormatted 2", "Dimension 3", "Vertices", "8"] + ["%d %d %d 0" % c for c in corners]
        rows += ["Tetrahedra", "6"] + ["%d %d %d %d 0" % t for t in tets] + ["End", ""]
        path.write_text("\n".join(rows), encoding="utf-8")
        return path

    def c_consumer(self, example: Path) -> None:
        environment = dict(self.environment, PKG_CONFIG_LIBDIR=str(self.lib / "pkgconfig"),
                           PKG_CONFIG_SYSROOT_DIR=str(self.root))
        flags = shlex.split(run("pkg-config", "--cflags", "--libs", "incise", env=environment))
        program = self.work / "by_pkg_config"
        run("cc", "-std=c99", "-Wall", "-Wextra", "-Werror", example, "-o", program, *flags, env=environment)
        run(program, env=self.environment, cwd=self.work)

    def cmake_consumer(self, folder: Path, program: str, *more: str) -> None:
        build = self.work / program
        run("cmake", "-S", folder, "-B", build, "-DCMAKE_PREFIX_PATH=%s" % self.usr, "-DCMAKE_BUILD_TYPE=Release", *more,
            env=self.environment)
        cache = (build / "CMakeCache.txt").read_text(encoding="utf-8")
        check("incise_DIR:PATH=" + str(self.lib) in cache, program + " has found the package in the empty root")
        run("cmake", "--build", build, "--target", program, env=self.environment)
        run(build / program, build, env=self.environment)

    def python(self) -> str:
        """Cuts with Python; returns the hash of the mesh."""
        path = self.usr / "lib" / "python3" / "dist-packages"
        lines = ["import importlib.metadata, incise", "print(incise.__file__)", "print(incise.__version__)",
                 "print(importlib.metadata.version('incise-mesh'))", "engine = incise.read(%r)" % str(self.cube()),
                 "engine.cut_plane((1, 0.2, 0), 0.6)", "print('%016x' % engine.hash)"]
        out = run("/usr/bin/python3", "-c", "\n".join(lines), cwd=self.work,
                  env=dict(self.environment, PYTHONPATH=str(path), PYTHONDONTWRITEBYTECODE="1")).split()
        check(out[0].startswith(str(path)) and out[1] == out[2], "Python has the module of the package, " + out[1])
        return out[3]

    def documents(self, version: str) -> None:
        for package in PACKAGES:
            doc = self.usr / "share" / "doc" / package
            changes = gzip.open(doc / "changelog.Debian.gz", "rt", encoding="utf-8").readline()
            check(changes.startswith("incise (%s) " % version), "the changelog of %s begins with %s" % (package, version))
            check("common-licenses/Apache-2.0" in (doc / "copyright").read_text(encoding="utf-8"), package + ": copyright")
        view = gzip.open(self.usr / "share" / "man" / "man1" / "incise-view.1.gz", "rt").read()
        check("incise\\-view " + version.rpartition("-")[0] in view, "the manual page of incise-view names the version")
        words = run(self.usr / "bin" / "incise", "--help", env=self.environment)
        for command in re.findall(r"^  ([a-z]+)  +[A-Z]", words, re.M):
            page = gzip.open(self.usr / "share" / "man" / "man1" / ("incise-%s.1.gz" % command), "rt").read()
            check(version.rpartition("-")[0] in page, "the manual page of incise %s names the version" % command)


def main(source: Path, work: Path) -> None:
    if shutil.which("dpkg-shlibdeps") is None:
        print("skipped: dpkg-dev is not installed")
        sys.exit(77)
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    run(source / "script" / "package", work / "debs")
    if shutil.which("lintian") is None:
        print("lintian is not installed: the packages were not checked by it")
    debs = {path.name.partition("_")[0]: path for path in (work / "debs").glob("*.deb")}
    check(sorted(debs) == PACKAGES, "there are five packages")
    version = run("dpkg-deb", "-f", debs["incise"], "Version").strip()
    declared = re.search(r"project\(incise VERSION ([0-9.]+)", (source / "CMakeLists.txt").read_text(encoding="utf-8"))
    check(version == declared[1] + "-1", "their version is that of CMakeLists.txt, " + version)
    for package in ("libincise-dev", "python3-incise"):
        depends = run("dpkg-deb", "-f", debs[package], "Depends")
        check("libincise0 (= %s)" % version in depends, package + " depends on its library")
    check("libc6" in run("dpkg-deb", "-f", debs["libincise0"], "Depends"), "libincise0 depends on what it links")
    installed = Installed(debs, work)
    installed.documents(version)
    by_command = installed.command()
    installed.c_consumer(source / "examples" / "cut_a_cube.c")
    print("ok: a program in C, by pkg-config")
    installed.cmake_consumer(source / "tests" / "c" / "consumer", "c_consumer",
                             "-DEXAMPLE=%s" % (source / "examples" / "cut_a_cube.c"))
    installed.cmake_consumer(source / "tests" / "install" / "consumer", "cut_a_file",
                             "-DINCLUDE_FOLDER=%s" % (installed.usr / "include"))
    print("ok: programs in C and C++, by CMake")
    check(installed.python() == by_command, "Python gives the command's hash, " + by_command)


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]))
