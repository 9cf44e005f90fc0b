# SPDX-License-Identifier: Apache-2.0
"""Checks that documents, and comments that send to them, name only what exists. usage: document_paths.py ROOT

What counts as a path: the target of a link; in backticks, something with a slash whose first part is a folder of the
tree or of the sources, and a bare name of a source file. What a link has behind # must be a heading of its document, as
GitHub names it. CHANGELOG.md tells of what was: only its links are checked.
"""
import glob
import os
import re
import subprocess
import sys

PLACES = ("", "src", "include", "include/incise", "src/app", "src/sim")  # where a path in backticks may begin
LINK = re.compile(r"\]\(([^)\s]+)\)")
CODE = re.compile(r"`([A-Za-z0-9_.*{},/-]+)`")
BARE = re.compile(r"[A-Za-z0-9_*-]+\.(h|cpp|py|cmake)$")
IN_COMMENT = re.compile(r"\bdocs/[A-Za-z0-9_./-]+\.md\b")
HEADING = re.compile(r"#{1,6} +(.*?) *#*$")
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


def anchor_of(heading):
    """The anchor that GitHub gives a heading: its text in small letters, spaces as hyphens, without punctuation."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def prose_lines(path):
    """Number and text of each line of a document that is not in a block of code."""
    is_code = False
    with open(path, encoding="utf-8") as document:
        for number, line in enumerate(document, 1):
            if line.startswith("```"):
                is_code = not is_code
            elif not is_code:
                yield number, line.rstrip("\n")


def anchors_of(path):
    anchors, times = set(), {}
    for _, line in prose_lines(path):
        heading = HEADING.match(line)
        if heading:
            anchor = anchor_of(heading[1])
            times[anchor] = times.get(anchor, 0) + 1
            anchors.add(anchor if times[anchor] == 1 else "%s-%d" % (anchor, times[anchor] - 1))
    return anchors


class Tree:
    def __init__(self, root):
        self.root, self.files, self.anchors = root, tracked(root), {}
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

    def leads_to(self, target, document):
        """Whether a link of a document leads somewhere: to a file, and to a heading where it names one."""
        path, _, anchor = target.partition("#")
        file = os.path.normpath(os.path.join(self.root, os.path.dirname(document), path)) if path else os.path.join(
            self.root, document)
        if not os.path.exists(file):
            return False
        if not anchor or not file.endswith(".md"):
            return True
        if file not in self.anchors:
            self.anchors[file] = anchors_of(file)
        return anchor in self.anchors[file]


def check_document(tree, path):
    beside = os.path.dirname(path)
    for number, line in prose_lines(os.path.join(tree.root, path)):
        for target in LINK.findall(line):
            if "://" not in target and not target.startswith("mailto:") and not tree.leads_to(target, path):
                yield number, target
        if path == "CHANGELOG.md":
            continue
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
        if path.endswith(".md"):
            found = check_document(tree, path)
        elif path.endswith((".h", ".cpp", ".cmake")) or os.path.basename(path) == "CMakeLists.txt":
            found = check_comments(tree, path)
        else:
            continue
        checked += 1
        for number, target in found:
            wrong += 1
            print("%s:%d: there is no %s" % (path, number, target))
    print("paths, links and anchors in documents: %d files, %d wrong" % (checked, wrong))
    return 1 if wrong or checked == 0 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]) if len(sys.argv) == 2 else __doc__)
