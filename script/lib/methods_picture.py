# SPDX-License-Identifier: Apache-2.0
"""Draws what bench_methods measured, and prints it as the table of docs/benchmark.md.

usage: methods_picture.py FOLDER     with methods.csv of bench_methods

Writes FOLDER/methods.svg and FOLDER/methods.md.
"""
import csv
import math
import sys
from pathlib import Path

COLOURS = {"1": "#009e73", "5": "#0072b2", "20": "#d55e00"}
LEFT, TOP, WIDTH, GAP_X, STEP, GAP_Y = 128, 74, 218, 26, 17, 44
HEAD = ("body", "planes", "method", "pieces", "volume lost, %", "tets added", "L/r: min", "mean", "max", "> 200, %", "flat",
        "dihedral: min, °", "max, °", "wall off, mean", "max", "µs / cut tet")


class Column:
    """One measure, to the right; `ticks` from its least to its greatest value, logarithmic where `is_log`."""

    def __init__(self, number, title, ticks, is_log, value):
        self.left = LEFT + number * (WIDTH + GAP_X)
        self.title, self.ticks, self.is_log, self.value = title, ticks, is_log, value

    def x(self, value):
        low, high = self.ticks[0], self.ticks[-1]
        value = min(max(value, low), high)
        share = math.log(value / low) / math.log(high / low) if self.is_log else (value - low) / (high - low)
        return self.left + WIDTH * share


def read(folder):
    """The rows, by position: two columns of the file have one name."""
    with open(folder / "methods.csv", encoding="utf-8", newline="") as source:
        return list(csv.reader(source))[1:]


def growth(row):
    return 1 + float(row[7]) / float(row[4])


def columns():
    return [Column(0, "tets, as a multiple of the body's", (0.01, 0.1, 1, 10, 100, 1000), True, growth),
            Column(1, "mean L/r (best 4.9)", (5, 10, 100, 1000, 10000, 100000), True, lambda row: float(row[9])),
            Column(2, "volume lost, %", (0, 20, 40, 60, 80, 100), False, lambda row: float(row[6]))]


def is_whole(row):
    """Whether all planes were cut."""
    return row[3] == row[1]


def text(x, y, words, style=""):
    return '<text x="%.1f" y="%.1f"%s>%s</text>' % (x, y, style and " " + style, words.replace(">", "&gt;"))


def draw_panel(column, top, methods, rows):
    bottom = top + STEP * len(methods)
    out = []
    for tick in column.ticks:
        out.append('<line x1="%.1f" y1="%.1f" x2="%.1f" y2="%.1f" stroke="#dddddd"/>'
                   % (column.x(tick), top, column.x(tick), bottom))
        out.append(text(column.x(tick), bottom + 12, "%g" % tick, 'text-anchor="middle" font-size="10"'))
    for row in rows:
        y = top + STEP * (methods.index(row[2]) + 0.5) + {"1": -3.5, "5": 0, "20": 3.5}[row[1]]
        fill = COLOURS[row[1]] if is_whole(row) else "white"
        out.append('<circle cx="%.1f" cy="%.1f" r="3.6" fill="%s" stroke="%s" stroke-width="1.4"/>'
                   % (column.x(column.value(row)), y, fill, COLOURS[row[1]]))
    return out


def draw(rows):
    bodies = list(dict.fromkeys(row[0] for row in rows))
    methods = list(dict.fromkeys(row[2] for row in rows))
    width = LEFT + len(columns()) * (WIDTH + GAP_X)
    height = TOP + len(bodies) * (STEP * len(methods) + GAP_Y)
    out = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %d %d" font-family="sans-serif" font-size="12">'
           % (width, height), "<title>Methods of cutting on the same planes</title>",
           '<rect width="%d" height="%d" fill="white"/>' % (width, height),
           text(8, 18, "After 1, 5 and 20 planes. Hollow: stopped before, with more than a million tets")]
    for k, (strokes, colour) in enumerate(COLOURS.items()):
        out.append('<circle cx="%d" cy="34" r="3.6" fill="%s"/>' % (16 + 60 * k, colour))
        out.append(text(24 + 60 * k, 38, strokes))
    for column in columns():
        out.append(text(column.left + WIDTH / 2, TOP - 22, column.title, 'text-anchor="middle" font-weight="bold"'))
    for k, body in enumerate(bodies):
        top = TOP + k * (STEP * len(methods) + GAP_Y)
        out.append(text(8, top - 5, body, 'font-weight="bold"'))
        for number, method in enumerate(methods):
            out.append(text(8, top + STEP * (number + 0.5) + 4, method, 'font-size="11"'))
        for column in columns():
            out += draw_panel(column, top, methods, [row for row in rows if row[0] == body])
    return "\n".join([*out, "</svg>", ""])


def to_markdown(rows):
    lines = ["| " + " | ".join(HEAD) + " |", "|" + "---|" * len(HEAD)]
    before = [None, None]
    for row in rows:
        of = [row[0], "%s" % row[1]]
        shown = of if of != before else ["", ""]
        before = of
        name = row[2] if is_whole(row) else "%s, after %s" % (row[2], row[3])
        lines.append("| " + " | ".join([*shown, name, *row[5:7], row[7].replace("-", "−"), *row[8:]]) + " |")
    return "\n".join([*lines, ""])


def main(folder):
    rows = read(folder)
    (folder / "methods.svg").write_text(draw(rows), encoding="utf-8")
    (folder / "methods.md").write_text(to_markdown(rows), encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]))
