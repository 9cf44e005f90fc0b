# SPDX-License-Identifier: Apache-2.0
"""Reads lines `file<TAB>first line<TAB>last line<TAB>name`, prints lengths by module. usage: see script/function_lengths"""
import sys

MEDIAN_LIMIT, LONG, LONG_SHARE_LIMIT = 10, 100, 0.02


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


def main(show_longest):
    functions = []
    for line in sys.stdin:
        path, first, last, name = line.rstrip("\n").split("\t")
        if last.isdigit():
            functions.append((int(last) - int(first) + 1, path, int(first), name))
    if not functions:
        sys.exit("function_lengths: found no function")
    print("%-12s %9s %7s %5s %8s %11s" % ("module", "functions", "median", "p90", "longest", "over %d" % LONG))
    for module in sorted({module_of(path) for _, path, _, _ in functions}):
        row(module, [n for n, path, _, _ in functions if module_of(path) == module])
    median, share = row("all", [n for n, _, _, _ in functions])
    if show_longest:
        for n, path, first, name in sorted(functions, reverse=True)[:20]:
            print("%5d  %s:%d  %s" % (n, path, first, name))
    return 1 if median > MEDIAN_LIMIT or share > LONG_SHARE_LIMIT else 0


if __name__ == "__main__":
    sys.exit(main("--longest" in sys.argv[1:]))
