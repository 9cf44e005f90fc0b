# SPDX-License-Identifier: Apache-2.0
"""Finds sources of src and apps that do not open with their idea: a comment right after the SPDX line.
usage: openings.py ROOT"""
import os
import re
import sys

FOLDERS = ("src", "apps")
SPDX = "// SPDX-License-Identifier: Apache-2.0"
# A comment with a word in it, and none that speaks to a tool alone.
IDEA = re.compile(r"//\s*(?!NOLINT|clang-format|IWYU)\S*\w")
REMEDY = "say its idea in one to three lines of // right after the SPDX line (CONTRIBUTING.md)"


def opens_with_its_idea(lines):
    """Whether the first lines of a source are the SPDX line and a comment."""
    return len(lines) > 1 and lines[0] == SPDX and IDEA.match(lines[1]) is not None


def find_without(root):
    """The sources that do not, as paths from the root."""
    for folder in FOLDERS:
        for where, folders, names in os.walk(os.path.join(root, folder)):
            folders.sort()
            for name in sorted(names):
                path = os.path.join(where, name)
                if not name.endswith(".cpp"):
                    continue
                with open(path, encoding="utf-8") as source:
                    lines = [line.rstrip("\n") for _, line in zip(range(2), source)]
                if not opens_with_its_idea(lines):
                    yield os.path.relpath(path, root)


def main(root):
    without = list(find_without(root))
    for path in without:
        print("%s: does not open with its idea: %s" % (path, REMEDY))
    return 1 if without else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
