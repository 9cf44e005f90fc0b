# SPDX-License-Identifier: Apache-2.0
"""Checks the lists that documents keep of what is elsewhere. usage: document_lists.py ROOT

- docs/acceptance.md has T1 to T35; comments in tests name each of them and no other; the tests that it and docs/paper_map.md
  name exist.
- docs/decisions/README.md has a row for each record, under its title.
- docs/README.md names each page beside it.
- docs/results.md has the figures of docs/benchmark_methods.csv, of the bunny after 1 and 20 planes.
- docs/troubleshooting.md quotes messages ("`...`") as the sources have them.
"""
import csv
import glob
import os
import re
import sys

COUNT = 35  # of the acceptance list
NUMBER = re.compile(r"\bT([1-9]\d?)\b")
TEST = re.compile(r"^TEST(?:_F|_P)?\((\w+), *(\w+)\)", re.M)
NAMED_TEST = re.compile(r"`([A-Z]\w+\.\w+)`")
MESSAGE = re.compile(r'"`([^`]+)`"')
SOURCES = ("src/**/*.cpp", "src/**/*.h", "apps/**/*.cpp", "apps/**/*.h", "bindings/python/**/*.py", "script/*",
           "script/lib/*.sh")


def text_of(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


def files(root, pattern):
    return sorted(path for path in glob.glob(os.path.join(root, pattern), recursive=True) if os.path.isfile(path))


def check_acceptance(root):
    page, in_tests, tests = text_of(root, "docs/acceptance.md"), set(), set()
    for path in files(root, "tests/**/*.cpp"):
        source = text_of(path)
        tests.update("%s.%s" % found for found in TEST.findall(source))
        for comment in re.findall(r"//(.*)", source):
            in_tests.update(int(number) for number in NUMBER.findall(comment))
    listed = [int(number) for number in re.findall(r"^\| T(\d+) \|", page, re.M)]
    if sorted(listed) != list(range(1, COUNT + 1)):
        yield "docs/acceptance.md lists %s, not each of T1 to T%d once" % (sorted(listed), COUNT)
    for number in sorted(set(listed) - in_tests):
        yield "docs/acceptance.md lists T%d, which no comment in a test names" % number
    for number in sorted(in_tests - set(listed)):
        yield "a comment in a test names T%d, which docs/acceptance.md does not list" % number
    for where, text in (("docs/acceptance.md", page), ("docs/paper_map.md", text_of(root, "docs/paper_map.md"))):
        for name in sorted(set(NAMED_TEST.findall(text)) - tests):
            yield "%s names the test %s, which does not exist" % (where, name)


def check_decisions(root):
    index = text_of(root, "docs/decisions/README.md")
    for path in files(root, "docs/decisions/[0-9]*.md"):
        name = os.path.basename(path)
        number, title = re.match(r"# (\d+)\. (.*)", text_of(path)).groups()
        if "| %s | [%s](%s) |" % (number, title, name) not in index:
            yield "docs/decisions/README.md has no row '| %s | [%s](%s) | ... |'" % (number, title, name)


def check_index(root):
    index = text_of(root, "docs/README.md")
    for path in files(root, "docs/*.md"):
        name = os.path.basename(path)
        if name != "README.md" and "](%s)" % name not in index:
            yield "docs/README.md does not name %s" % name


def check_messages(root):
    sources = [re.sub(r'"\s*f?"', "", text_of(path)) for pattern in SOURCES for path in files(root, pattern)]
    for message in MESSAGE.findall(text_of(root, "docs/troubleshooting.md")):
        if not any(message in source for source in sources):
            yield "docs/troubleshooting.md quotes '%s', which no source has" % message


def method_row(first, last):
    """Of the table in docs/results.md, without the method's name."""
    made = "" if last["made"] == last["strokes"] else " (after %s)" % last["made"]
    pairs = [(first[name], last[name]) for name in ("tets added", "mean", "> 200 %", "volume lost %")]
    cells = ["%s, %s%s" % (first["pieces"], last["pieces"], made)] + ["%s, %s" % pair for pair in pairs]
    return "| %s |" % " | ".join(cell.replace("-", "\u2212") for cell in cells)


def check_methods(root):
    page = text_of(root, "docs/results.md")
    of_bunny = {}
    for row in csv.DictReader(text_of(root, "docs/benchmark_methods.csv").splitlines()):
        if row["body"] == "bunny":
            of_bunny.setdefault(row["method"], {})[row["strokes"]] = row
    for method, rows in of_bunny.items():
        if method_row(rows["1"], rows["20"]) not in page:
            yield "docs/results.md lacks '%s' of %s" % (method_row(rows["1"], rows["20"]), method)


def main(root):
    checks = (check_acceptance, check_decisions, check_index, check_methods, check_messages)
    wrong = [fault for check in checks for fault in check(root)]
    for fault in wrong:
        print(fault)
    print("lists in documents: %d wrong" % len(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]) if len(sys.argv) == 2 else __doc__)
