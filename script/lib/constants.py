# SPDX-License-Identifier: Apache-2.0
"""Finds tuned constants that stand outside the headers of constants, names that two of these headers give, and values
in the table of docs/internals.md that are not those of the sources.
usage: constants.py ROOT"""
import ast
import operator
import os
import re
import sys

MODULES = ("cut", "improve", "paper", "lab", "sim", "mesh", "geom", "engine")
DOCUMENT = "docs/internals.md"
# constexpr double or float, with one or more names; up to the semicolon.
DECLARATION = re.compile(r"\bconst(?:expr)?\s+(?:double|float)\s+(k[A-Z][^;]*);")
ANY_DECLARATION = re.compile(r"\bconstexpr\s+(?:\w+(?:::\w+)*)\s+(k[A-Z][^;{]*);")
NUMBER = re.compile(r"(?<![\w.])(?:0[xX][0-9a-fA-F.]+(?:[pP][-+]?\d+)?|(?:\d[\d']*\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)"
                    r"[fFuUlL]*")
REMEDY = "move it to the module's constants.h, with its unit and what goes wrong where it is changed (CONTRIBUTING.md)"
# Constants of mathematics, which nobody turns: they stand where they are used.
MATHEMATICS = {
    ("src/geom/expansion_internal.h", "kSplitter"): "2^27 + 1, which splits a double into halves (Dekker)",
    ("src/improve/inradius_ratio.h", "kRegularLr"): "the L/r of the regular tet, 2 times the root of 6",
    ("src/paper/paper_merge.cpp", "kRegularVolume6"): "six times the volume of the regular tet, the root of 1/2",
}
OPERATORS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv}


def is_header_of_constants(path):
    """Whether a file is meant for constants: constants.h, or another one of that ending where one would be too long."""
    name = os.path.basename(path)
    return name == "constants.h" or name.endswith("_constants.h")


def without_comments(text):
    """The text with each comment blanked, so that lines keep their numbers."""
    return re.sub(r"//[^\n]*|/\*.*?\*/", lambda found: re.sub(r"[^\n]", " ", found.group()), text, flags=re.S)


def entries_of(declared):
    """The names of a declaration with their initialisers, as (name, text)."""
    for part in re.split(r",\s*(?=k[A-Z]\w*\s*[={])", declared):
        found = re.match(r"(k[A-Z]\w*)\s*[={]\s*(.*?)\}?\s*$", part, re.S)
        if found:
            yield found.group(1), found.group(2)


def is_literal(initialiser):
    """Whether an initialiser is made of numbers alone."""
    rest, count = NUMBER.subn(" ", initialiser)
    return count > 0 and re.search(r"[A-Za-z_]", rest) is None


def sources(root, folders):
    """The paths of C++ files below the folders, from the root, with their texts without comments."""
    for folder in folders:
        for where, inner, names in os.walk(os.path.join(root, folder)):
            inner.sort()
            for name in sorted(names):
                if name.endswith((".cpp", ".h")):
                    path = os.path.join(where, name)
                    with open(path, encoding="utf-8") as source:
                        yield os.path.relpath(path, root), without_comments(source.read())


def find_misplaced(root):
    """Tuned constants outside the headers of constants, as lines to print; and exceptions that nothing needs."""
    needed = set()
    for path, text in sources(root, ["src/" + module for module in MODULES]):
        if is_header_of_constants(path):
            continue
        for found in DECLARATION.finditer(text):
            line = text.count("\n", 0, found.start()) + 1
            for name, initialiser in entries_of(found.group(1)):
                if not is_literal(initialiser):
                    continue
                if (path, name) in MATHEMATICS:
                    needed.add((path, name))
                else:
                    yield "%s:%d: %s is a tuned constant: %s" % (path, line, name, REMEDY)
    for path, name in sorted(set(MATHEMATICS) - needed):
        if os.path.exists(os.path.join(root, path)):
            yield "%s: %s needs no exception: take it out of script/lib/constants.py" % (path, name)


def find_twins(root):
    """Names that two headers of constants give: one name is one value."""
    first = {}
    for path, text in sources(root, ["src/" + module for module in MODULES]):
        if not is_header_of_constants(path):
            continue
        for found in ANY_DECLARATION.finditer(text):
            for name, _ in entries_of(found.group(1)):
                if name in first:
                    yield "%s: %s has that name in %s: say what each is" % (path, name, first[name])
                first.setdefault(name, path)


def value_of(initialiser):
    """The number that an initialiser of numbers alone stands for; None where it is another one."""
    try:
        plain = NUMBER.sub(lambda found: repr(number(found.group())), initialiser)
        return compute(ast.parse(plain.strip(), mode="eval").body)
    except (SyntaxError, ValueError):
        return None


def number(text):
    text = text.replace("'", "")
    if text[:2] in ("0x", "0X"):
        return float.fromhex(text.rstrip("uUlL"))
    return float(text.rstrip("fFuUlL"))


def compute(node):
    if isinstance(node, ast.Constant) and isinstance(node.value, float):
        return node.value
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        return -compute(node.operand)
    if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
        return OPERATORS[type(node.op)](compute(node.left), compute(node.right))
    raise ValueError


def values_by_name(root):
    """The values that sources and public headers give each constant of one number."""
    values = {}
    for _, text in sources(root, ["src", "include"]):
        for found in ANY_DECLARATION.finditer(text):
            for name, initialiser in entries_of(found.group(1)):
                value = value_of(initialiser)
                if value is not None:
                    values.setdefault(name, set()).add(value)
    return values


def written(text):
    """The number of a cell of the table, as 0.25, 10⁻⁶ or 10⁶; None where it is no plain number."""
    text = text.strip()
    power = re.fullmatch(r"10([⁻⁰¹²³⁴-⁹]+)", text)
    if power:
        return float("1e" + power.group(1).translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")))
    return float(text) if re.fullmatch(r"[\d.]+", text) else None


def find_wrong_values(root):
    """Rows of the table of constants whose numbers are not those of the sources."""
    path = os.path.join(root, DOCUMENT)
    if not os.path.exists(path):
        return
    values = values_by_name(root)
    with open(path, encoding="utf-8") as document:
        lines = document.read().split("\n")
    inside = False
    for at, line in enumerate(lines, 1):
        if line.startswith("## "):
            inside = line.endswith(" Constants")
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if not inside or not line.startswith("| ") or len(cells) != 4 or cells[0] in ("value", "---"):
            continue
        names = re.findall(r"`([\w:]+)`", cells[3])
        numbers = [written(cell) for cell in cells[0].split(";")]
        if len(names) != len(numbers):
            continue  # angles, and what a struct's fields say together
        for name, shown in zip(names, numbers):
            if not re.fullmatch(r"k[A-Z]\w*", name) or shown is None:
                continue
            if name not in values:
                yield "%s:%d: no source has %s" % (DOCUMENT, at, name)
            elif shown not in values[name]:
                there = " or ".join("%g" % value for value in sorted(values[name]))
                yield "%s:%d: %s is %s, not %g" % (DOCUMENT, at, name, there, shown)


def main(root):
    said = [*find_misplaced(root), *find_twins(root), *find_wrong_values(root)]
    for line in said:
        print(line)
    return 1 if said else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
