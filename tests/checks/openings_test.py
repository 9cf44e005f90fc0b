# SPDX-License-Identifier: Apache-2.0
"""What script/lib/openings.py finds in trees made for it. usage: openings_test.py ROOT"""
import sys

import trees
from trees import expect, outcome_of

trees.import_checks(sys.argv[1])
import openings  # noqa: E402

SPDX = "// SPDX-License-Identifier: Apache-2.0\n"


def check(text, path="src/cut/a.cpp"):
    """The exit code of the check for a tree of one file, and what it says."""
    return outcome_of(openings, {path: text})


def main():
    code, said = check(SPDX + "// Walks from tet to tet.\n#include <array>\n")
    expect(code == 0 and not said, "a source with its idea is let pass")
    for text in (SPDX + '#include "cut/a.h"\n', SPDX + "\n// Late.\n", SPDX + "// NOLINTBEGIN\n", SPDX + "//\n",
                 SPDX, "", "// Walks.\n" + SPDX):
        code, said = check(text)
        expect(code == 1 and said.startswith("src/cut/a.cpp: "), "a source without its idea is named: " + repr(text))
        expect("right after the SPDX line" in said, "the remedy is told: " + said)
    expect(check(SPDX + "int x;\n", "apps/view/a.cpp")[0] == 1, "apps are looked at")
    expect(check(SPDX + "int x;\n", "tests/cut/a.cpp")[0] == 0, "tests are not")
    expect(check(SPDX + "#pragma once\n", "src/cut/a.h")[0] == 0, "headers are not")


main()
