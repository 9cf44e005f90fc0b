# SPDX-License-Identifier: Apache-2.0
"""Runs what the README has under "The same cut, five times", and compares the hashes that are printed; builds and runs the
lines of C++ under "The library", too.

usage: same_cut.py PREFIX CMAKE CC CXX     PREFIX: where Incise is installed
"""
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
PACKAGE = os.path.join(ROOT, "bindings", "python")

CPP = """#include <cstdio>
#include <utility>
#include "incise/incise.h"
#include "incise/io/mesh_loader.h"
#include "incise/mesh/bounds.h"
int main() {
%s  return 0;
}
"""
LIBRARY = """%s
#include <utility>
int main() {
%s  return report.ok() && engine->mesh().tet_count() == 750 ? 0 : 1;
}
"""
C = """#include <stdio.h>
#include "incise/c/incise.h"
int main(void) {
%s  return 0;
}
"""


def blocks_of_readme():
    with open(os.path.join(ROOT, "README.md"), encoding="utf-8") as file:
        text = file.read()
    blocks = dict(blocks_of_section(text, "### The same cut, five times"))
    library = blocks_of_section(text, "## The library")[0][1].splitlines(keepends=True)
    blocks["library"] = ("".join(line for line in library if line.startswith("#include")),
                         "".join(line for line in library if not line.startswith("#include")))
    return blocks


def blocks_of_section(text, heading):
    section = re.split(r"\n##+ ", text.split("\n%s\n" % heading, 1)[1])[0]
    return re.findall(r"```(\w+)\n(.*?)```", section, re.S)


def run(command, folder, environment):
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit("%s failed (%d):\n%s%s" % (command, done.returncode, done.stdout, done.stderr))
    return done.stdout


def build(blocks, folder, prefix, cmake, cc, cxx):
    project = os.path.join(folder, "project")
    shutil.copytree(os.path.join(HERE, "consumer"), project)
    for name, frame, language in (("in_cpp.cpp", CPP, "cpp"), ("in_c.c", C, "c"), ("library.cpp", LIBRARY, "library")):
        with open(os.path.join(project, name), "w", encoding="utf-8") as file:
            file.write(frame % blocks[language])
    run([cmake, "-S", project, "-B", project + "/build", "-DCMAKE_PREFIX_PATH=" + prefix, "-DCMAKE_BUILD_TYPE=Release",
         "-DCMAKE_C_COMPILER=" + cc, "-DCMAKE_CXX_COMPILER=" + cxx], folder, os.environ)
    run([cmake, "--build", project + "/build"], folder, os.environ)
    return project + "/build/"


def main(prefix, cmake, cc, cxx):
    if importlib.util.find_spec("numpy") is None:
        print("skipped: numpy is not installed for", sys.executable)
        return SKIPPED
    blocks = blocks_of_readme()
    with tempfile.TemporaryDirectory(prefix="incise readme ") as folder:
        environment = dict(os.environ, PYTHONPATH=PACKAGE, PATH=prefix + "/bin:" + os.environ["PATH"])
        make = "import incise; incise.box((5, 5, 5)).write('cube.mesh')"
        run([sys.executable, "-c", make], folder, environment)
        built = build(blocks, folder, prefix, cmake, cc, cxx)
        printed = {"cpp": run([built + "in_cpp"], folder, environment), "c": run([built + "in_c"], folder, environment),
                   "python": run([sys.executable, "-c", blocks["python"]], folder, environment),
                   "sh": run(["sh", "-c", blocks["sh"]], folder, environment),
                   "batch": run(["sh", "-e", "-c", blocks["shell"]], folder, environment)}
        run([built + "library"], folder, environment)
    hashes = {language: re.findall(r"\b[0-9a-f]{16}\b", text) for language, text in printed.items()}
    print(hashes)
    first = hashes["cpp"]
    return 0 if len(first) == 1 and all(found == first for found in hashes.values()) else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]) if len(sys.argv) == 5 else __doc__)
