# SPDX-License-Identifier: Apache-2.0
"""Reads lines `file<TAB>first line<TAB>last line<TAB>name<TAB>kind`, prints lengths by module.
usage: see script/function_lengths"""
import os
import re
import sys

MEDIAN_LIMIT, LONG, LONG_SHARE_LIMIT = 10, 100, 0.02
CLASS_LIMIT = 300
# Lines "file class most-lines": classes that were longer when the limit came. None is added, and none grows.
LONG_CLASSES = "script/lib/long_classes.txt"


def module_of(path):
    parts = path.split("/")
    if parts[0] == "include":
        return parts[2]
    return parts[1] if parts[0] == "src" else "/".join(parts[:2])


def quantile(ordered, share):
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))]


def row(name, lengths):
    ordered = sorted(lengths)
    share = sum(n > LONG for n in ordered) / len(ordered)
    print("%-12s %9d %7d %5d %8d %9.1f %%" % (name, len(ordered), quantile(ordered, 0.5), quantile(ordered, 0.9),
                                            ordered[-1], 100 * share))
    return quantile(ordered, 0.5), share


def sources(root):
    for base in ("include", "src", "apps"):
        for where, folders, names in os.walk(os.path.join(root, base)):
            folders.sort()
            for name in sorted(names):
                if name.endswith((".h", ".cpp")):
                    yield os.path.relpath(os.path.join(where, name), root)


def function_ends(root, path):
    """The lines with the closing brace of a function outside classes, which the layout puts first in its line.

    Those of shaders in raw strings are left out, and those after #else: ctags reads one branch.
    """
    branches, in_string = [], False
    with open(os.path.join(root, path), encoding="utf-8") as source:
        for number, line in enumerate(source, 1):
            directive = re.match(r"#\s*(if|elif|else|endif)", line)
            if in_string or 'R"' in line:
                in_string = not re.search(r'\)[a-z]*"', line)
            elif directive and directive[1] == "endif":
                branches.pop()
            elif directive:
                branches = branches if directive[1] == "if" else branches[:-1]
                branches.append(directive[1])
            elif line.rstrip() == "}" and all(branch == "if" for branch in branches):
                yield number


def report_unseen(root, functions):
    """Prints the functions that ctags did not see; returns how many."""
    seen = {(path, first + lines - 1) for lines, path, first, _ in functions}
    unseen = [(path, n) for path in sources(root) for n in function_ends(root, path) if (path, n) not in seen]
    for path, number in unseen:
        print("%s:%d: ctags does not see the function that ends here" % (path, number))
    return len(unseen)


def known_long_classes(root):
    known = {}
    with open(os.path.join(root, LONG_CLASSES), encoding="utf-8") as lines:
        for line in lines:
            if line.strip() and not line.startswith("#"):
                path, name, most = line.split()
                known[path, name] = int(most)
    return known


def report_long_classes(root, classes):
    """Prints the classes that are too long, and entries of the list that are so no more; returns how many."""
    known, wrong = known_long_classes(root), []
    for lines, path, first, name in classes:
        if lines > known.get((path, name), CLASS_LIMIT):
            wrong.append("%s:%d: class %s has %d lines; split it along its headings" % (path, first, name, lines))
    longest = {}
    for lines, path, _, name in classes:
        longest[path, name] = max(lines, longest.get((path, name), 0))
    for (path, name), most in sorted(known.items()):
        now = longest.get((path, name), 0)
        if now <= CLASS_LIMIT:
            wrong.append("%s: %s %s has %d lines now: strike it" % (LONG_CLASSES, path, name, now))
        elif now < most - 20:
            wrong.append("%s: %s %s has %d lines now, not %d: say so" % (LONG_CLASSES, path, name, now, most))
    print("classes: %d, longest %d, %d over %d" % (len(classes), max(classes)[0],
                                                  sum(c[0] > CLASS_LIMIT for c in classes), CLASS_LIMIT))
    for line in wrong:
        print(line)
    return len(wrong)


def main(root, show_longest):
    functions, classes = [], []
    for line in sys.stdin:
        path, first, last, name, kind = line.rstrip("\n").split("\t")
        if last.isdigit():
            entry = (int(last) - int(first) + 1, path, int(first), name)
            (functions if kind == "function" else classes).append(entry)
    if not functions:
        sys.exit("function_lengths: found no function")
    print("%-12s %9s %7s %5s %8s %11s" % ("module", "functions", "median", "p90", "longest", "over %d" % LONG))
    for module in sorted({module_of(path) for _, path, _, _ in functions}):
        row(module, [n for n, path, _, _ in functions if module_of(path) == module])
    median, share = row("all", [n for n, _, _, _ in functions])
    if show_longest:
        for n, path, first, name in sorted(functions, reverse=True)[:20] + sorted(classes, reverse=True)[:20]:
            print("%5d  %s:%d  %s" % (n, path, first, name))
    is_wrong = report_unseen(root, functions) + report_long_classes(root, classes) > 0 or median > MEDIAN_LIMIT or share > LONG_SHARE_LIMIT
    return 1 if is_wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], "--longest" in sys.argv[2:]))
