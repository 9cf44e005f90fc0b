# SPDX-License-Identifier: Apache-2.0
"""What script/lib/openings.py finds in trees made for it. usage: openings.py PATH_OF_OPENINGS"""
import contextlib
import importlib.util
import io
import os
import sys
import tempfile

SPDX = "// SPDX-License-Identifier: Apache-2.0\n"


def load(path):
    spec = importlib.util.spec_from_file_location("openings", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def check(openings, text, path="src/cut/a.cpp"):
    """The exit code of the check for a tree of one file, and what it says."""
    with tempfile.TemporaryDirectory() as root:
        place = os.path.join(root, path)
        os.makedirs(os.path.dirname(place))
        with open(place, "w", encoding="utf-8") as source:
            source.write(text)
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            code = openings.main(root)
    return code, said.getvalue()


def expect(is_true, what):
    if not is_true:
        sys.exit("openings_test.py: " + what)


def main():
    openings = load(sys.argv[1])
    code, said = check(openings, SPDX + "// Walks from tet to tet.\n#include <array>\n")
    expect(code == 0 and not said, "a source with its idea is let pass")
    for text in (SPDX + '#include "cut/a.h"\n', SPDX + "\n// Late.\n", SPDX + "// NOLINTBEGIN\n", SPDX + "//\n",
                 SPDX, "", "// Walks.\n" + SPDX):
        code, said = check(openings, text)
        expect(code == 1 and said.startswith("src/cut/a.cpp: "), "a source without its idea is named: " + repr(text))
        expect("right after the SPDX line" in said, "the remedy is told: " + said)
    expect(check(openings, SPDX + "int x;\n", "apps/view/a.cpp")[0] == 1, "apps are looked at")
    expect(check(openings, SPDX + "int x;\n", "tests/cut/a.cpp")[0] == 0, "tests are not")
    expect(check(openings, SPDX + "#pragma once\n", "src/cut/a.h")[0] == 0, "headers are not")


main()
