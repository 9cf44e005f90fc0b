# SPDX-License-Identifier: Apache-2.0
"""Checks that documents, and comments that send to them, name only paths that exist. usage: document_paths.py ROOT

What counts as a path: the target of a link; in backticks, something with a slash whose first part is a folder of the
tree or of the sources, and a bare name of a source file. CHANGELOG.md tells of what was, and is left out.
"""
import glob
import os
import re
import subprocess
import sys

PLACES = ("", "src", "include", "include/incise", "src/app", "src/sim")  # where a path in backticks may begin
LINK = re.compile(r"\]\(([^)\s#]+)(?:#[^)]*)?\)")
CODE = re.compile(r"`([A-Za-z0-9_.*{},/-]+)`")
BARE = re.compile(r"[A-Za-z0-9_*-]+\.(h|cpp|py|cmake)$")
IN_COMMENT = re.compile(r"\bdocs/[A-Za-z0-9_./-]+\.md\b")
MADE = ("build",)  # folders that only work makes


def tracked(root):
    out = subprocess.run(["git", "-C", root, "ls-files", "--cached", "--others", "--exclude-standard"], check=True,
                         stdout=subprocess.PIPE, text=True).stdout
    return [path for path in out.splitlines() if os.path.exists(os.path.join(root, path))]


def alternatives(path):
    """`a/{b,c}.h` is a/b.h and a/c.h."""
    match = re.search(r"\{([^{}]*)\}", path)
    if not match:
        return [path]
    return [one for part in match[1].split(",") for one in alternatives(path[:match.start()] + part + path[match.end():])]


class Tree:
    def __init__(self, root):
        self.root, self.files = root, tracked(root)
        self.names = {os.path.basename(path) for path in self.files}
        self.folders = {path.split("/")[0] for path in self.files if "/" in path} - set(MADE)
        for place in PLACES[1:]:
            self.folders |= {path[len(place) + 1:].split("/")[0] for path in self.files
                             if path.startswith(place + "/") and path.count("/") > place.count("/") + 1}

    def holds(self, path, beside):
        return any(glob.glob(os.path.join(self.root, place, path)) for place in PLACES + (beside,))

    def lacks(self, text, beside):
        """Which of the paths that a text in backticks stands for are nowhere."""
        if "/" in text:
            if text.startswith("/") or text.split("/")[0] not in self.folders:
                return []
            return [path for path in alternatives(text) if not self.holds(path, beside)]
        if BARE.match(text) and "*" not in text and text not in self.names:
            return [text]
        return []


def check_document(tree, path):
    beside, is_code = os.path.dirname(path), False
    with open(os.path.join(tree.root, path), encoding="utf-8") as document:
        for number, line in enumerate(document, 1):
            if line.startswith("```"):
                is_code = not is_code
            if is_code:
                continue
            for target in LINK.findall(line):
                if "://" not in target and not os.path.exists(os.path.join(tree.root, beside, target)):
                    yield number, target
            for text in CODE.findall(line):
                for missing in tree.lacks(text, beside):
                    yield number, missing


def check_comments(tree, path):
    with open(os.path.join(tree.root, path), encoding="utf-8") as source:
        for number, line in enumerate(source, 1):
            for target in IN_COMMENT.findall(line):
                if not os.path.exists(os.path.join(tree.root, target)):
                    yield number, target


def main(root):
    tree, checked, wrong = Tree(root), 0, 0
    for path in tree.files:
        if path.endswith(".md") and path != "CHANGELOG.md":
            found = check_document(tree, path)
        elif path.endswith((".h", ".cpp", ".cmake")) or os.path.basename(path) == "CMakeLists.txt":
            found = check_comments(tree, path)
        else:
            continue
        checked += 1
        for number, target in found:
            wrong += 1
            print("%s:%d: there is no %s" % (path, number, target))
    print("paths in documents: %d files, %d wrong" % (checked, wrong))
    return 1 if wrong or checked == 0 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]) if len(sys.argv) == 2 else __doc__)
