# SPDX-License-Identifier: Apache-2.0
"""Puts the peers' figures into the paper's Table 3, prints it, and draws the distribution of its Figure 15.

usage: paper_tables.py FOLDER     with table3.csv and figure15.csv of bench_tables, and peers_ID.csv of run_peers

Writes FOLDER/table3_with_peers.csv and FOLDER/figure15.svg. Missing peers are named, and fail nothing.
"""
import csv
import math
import sys
from pathlib import Path

HEAD = ["case", "mesh", "tets", "min", "mean", "mean/original", "p99", "max", "% > 200", "dihedral min", "dihedral max",
        "ms", "volume change", "note"]
OURS = {"ms maintain": "ms", "defects": "note"}
PEERS = {"name": "mesh", "tets": "tets", "lr_min": "min", "lr_mean": "mean", "lr_p99": "p99", "lr_max": "max",
         "over_200_pct": "% > 200", "dih_min": "dihedral min", "dih_max": "dihedral max",
         "volume_error": "volume change", "note": "note"}
SIGN_OF_BEST = {"tets": 1, "min": 1, "mean": 1, "mean/original": 1, "p99": 1, "max": 1, "% > 200": 1,
                "dihedral min": -1, "dihedral max": 1, "ms": 1}
NOT_TREATED = ("original", "no optimisation", "incise, cut only")


def read(path):
    with open(path, encoding="utf-8", newline="") as source:
        return list(csv.DictReader(source))


def number(text):
    """A cell's value; None where it has none."""
    try:
        return float(text)
    except (TypeError, ValueError):
        return None


def short(value):
    return "0" if value == 0 else "%.4g" % value if abs(value) >= 1e-3 else "%.1e" % value


# Table 3 --------------------------------------------------------------------------------------------------------------

def our_rows(folder):
    """The rows of bench_tables, in the columns of HEAD."""
    rows = [{OURS.get(key, key): value for key, value in row.items()} for row in read(folder / "table3.csv")]
    return [{key: row.get(key) or "" for key in HEAD} for row in rows]


def peer_row(case, peer, original_mean):
    row = {PEERS[key]: value for key, value in peer.items() if key in PEERS}
    mean, seconds = number(peer["lr_mean"]), number(peer["seconds"])
    row["mean/original"] = short(mean / original_mean) if mean is not None else "n/a"
    row["ms"] = short(1e3 * seconds) if seconds is not None else "n/a"
    for key in HEAD[2:-1]:
        value = number(row[key])
        row[key] = row[key] if value is None or key == "tets" else short(value)
    return dict(row, case=case)


def peer_rows(folder, case, original_mean):
    """What run_peers wrote for a case, without the line of the input; nothing where it did not run."""
    path = folder / ("peers_%s.csv" % case.lower().replace(" ", "_"))
    if not path.is_file():
        return []
    return [peer_row(case, peer, original_mean) for peer in read(path) if peer["name"] != "input"]


def with_peers(folder):
    """The rows of Table 3 by case, and a line for each peer that gave nothing."""
    cases, missing = {}, {}
    for row in our_rows(folder):
        cases.setdefault(row["case"], []).append(row)
    for case, rows in cases.items():
        for row in peer_rows(folder, case, number(rows[0]["mean"])):
            if row["tets"] == "n/a":
                missing.setdefault((row["mesh"], row["note"]), []).append(case)
            else:
                rows.append(row)
    return cases, ["n/a: %s in %s (%s)" % (name, ", ".join(where), why) for (name, why), where in missing.items()]


def mark_best(rows):
    """Puts a star behind the best of each column, among the rows that treat the cut."""
    treated = [row for row in rows if row["mesh"] not in NOT_TREATED]
    for key, sign in SIGN_OF_BEST.items():
        values = [sign * number(row[key]) for row in treated if number(row[key]) is not None]
        for row in treated:
            if number(row[key]) is not None:
                row[key] += "*" if sign * number(row[key]) == min(values) else " "


def peers_ahead(cases):
    """Says in which columns a peer is the best of a case; the rows must be marked."""
    for name in sorted({row["mesh"] for rows in cases.values() for row in rows if not is_ours(row["mesh"])}):
        won = {}
        for case, rows in cases.items():
            for key in [key for row in rows if row["mesh"] == name for key in SIGN_OF_BEST if row[key].endswith("*")]:
                won.setdefault(key, []).append(case)
        columns = "; ".join("%s (%s)" % (key, ", ".join(of)) for key, of in won.items())
        print("%s is best in: %s" % (name, columns or "nothing"))


def is_ours(mesh):
    return mesh in NOT_TREATED or mesh == "our method" or mesh.split(",")[0] in ("paper", "incise")


def print_table(head, rows):
    widths = [max(len(row[key]) for row in [dict(zip(head, head)), *rows]) for key in head]
    for row in [dict(zip(head, head)), *rows]:
        cells = [row[key].ljust(width) if key in ("case", "mesh", "note") else row[key].rjust(width)
                 for key, width in zip(head, widths)]
        print("  ".join(cells).rstrip())


def report_table3(folder):
    cases, missing = with_peers(folder)
    rows = [row for of_case in cases.values() for row in of_case]
    with open(folder / "table3_with_peers.csv", "w", encoding="utf-8", newline="") as out:
        table = csv.DictWriter(out, HEAD, lineterminator="\n", extrasaction="ignore")
        table.writeheader()
        table.writerows(rows)
    for case, of_case in cases.items():
        if case != "printed":
            mark_best(of_case)
    print("\nTable 3 with the peers: the same cut for all. L/r of all tets; ms of what follows the cut; * marks the best\n"
          "of a case among the rows that treat the cut. The peers got the mesh 'no optimisation'.")
    print_table(HEAD, rows)
    for words in missing:
        print(words)
    peers_ahead(cases)


# Figure 15 ------------------------------------------------------------------------------------------------------------

SHOWN = ("CUBE oblique 3", "MEAT")
COLOURS = {"original": "#6b6b6b", "no optimisation": "#d55e00", "paper": "#0072b2", "incise": "#009e73"}
LABELS = {"original": "Original", "no optimisation": "No optimisation", "paper": "Profile paper",
          "incise": "Profile incise"}
LEFT, TOP, WIDTH, HEIGHT, GAP_X, GAP_Y = 134, 62, 300, 88, 26, 26
TICKS_X, TICKS_Y, BAD = (5, 10, 20, 50, 100, 200, 500, 1000), (0.1, 1, 5, 20, 50), 200


class Panel:
    """One histogram: L/r to the right, logarithmic; share of tets upwards, by its square root."""

    def __init__(self, column, row, low, high, top_share):
        self.left = LEFT + column * (WIDTH + GAP_X)
        self.base = TOP + row * (HEIGHT + GAP_Y) + HEIGHT
        self.low, self.high, self.top_share = low, high, top_share

    def x(self, ratio):
        return self.left + WIDTH * math.log(ratio / self.low) / math.log(self.high / self.low)

    def y(self, share):
        return self.base - HEIGHT * math.sqrt(share / self.top_share)


def text(x, y, words, style=""):
    return '<text x="%.1f" y="%.1f"%s>%s</text>' % (x, y, style and " " + style, words.replace(">", "&gt;"))


def line(x1, y1, x2, y2, style):
    return '<line x1="%.1f" y1="%.1f" x2="%.1f" y2="%.1f" %s/>' % (x1, y1, x2, y2, style)


def draw_axes(panel, is_first_column, is_last_row):
    right, top = panel.left + WIDTH, panel.base - HEIGHT
    out = [line(panel.left, panel.y(share), right, panel.y(share), 'stroke="#dddddd"') for share in TICKS_Y]
    out.append(line(panel.x(BAD), top + 16, panel.x(BAD), panel.base, 'stroke="#333333" stroke-dasharray="4 3"'))
    out.append(line(panel.left, panel.base, right, panel.base, 'stroke="#333333"'))
    for tick in [tick for tick in TICKS_X if tick <= panel.high]:
        out.append(line(panel.x(tick), panel.base, panel.x(tick), panel.base + 4, 'stroke="#333333"'))
        if is_last_row:
            out.append(text(panel.x(tick), panel.base + 17, str(tick), 'text-anchor="middle" font-size="11"'))
    if is_first_column:
        out += [text(panel.left - 5, panel.y(share) + 4, "%g %%" % share, 'text-anchor="end" font-size="10"')
                for share in TICKS_Y if share != 1]
    return out


def draw_bars(panel, classes, colour):
    bars = ['<rect x="%.1f" y="%.1f" width="%.1f" height="%.1f"/>' %
            (panel.x(low) + 0.5, panel.y(share), panel.x(high) - panel.x(low) - 1, panel.base - panel.y(share))
            for low, high, share in classes if share > 0]
    return ['<g fill="%s">' % colour, *bars, "</g>"]


def draw_outline(panel, classes):
    """The original's histogram as a line, to compare with."""
    path = "M%.1f %.1f" % (panel.x(classes[0][0]), panel.base)
    for low, high, share in classes:
        path += " L%.1f %.1f L%.1f %.1f" % (panel.x(low), panel.y(share), panel.x(high), panel.y(share))
    return ['<path d="%s" fill="none" stroke="black" stroke-width="1.3"/>' % path]


def figures_of(row):
    return "mean %.2f, worst %.0f, > 200: %.2g %%" % tuple(float(row[key]) for key in ("mean", "max", "% > 200"))


def draw_column(column, case, histograms, rows, scale):
    out = [text(LEFT + column * (WIDTH + GAP_X) + WIDTH / 2, TOP - 14, case,
                'text-anchor="middle" font-weight="bold"')]
    for number_of_row, (mesh, colour) in enumerate(COLOURS.items()):
        panel = Panel(column, number_of_row, *scale)
        out += draw_axes(panel, column == 0, number_of_row == len(COLOURS) - 1)
        out += draw_bars(panel, histograms[case, mesh], colour)
        if mesh != "original":
            out += draw_outline(panel, histograms[case, "original"])
        out.append(text(panel.left + WIDTH, panel.base - HEIGHT + 9, figures_of(rows[case, mesh]),
                        'text-anchor="end" font-size="11" stroke="white" stroke-width="3" paint-order="stroke"'))
        if column == 0:
            out.append(text(8, panel.base - HEIGHT / 2, LABELS[mesh].split()[0], 'font-weight="bold"'))
            out.append(text(8, panel.base - HEIGHT / 2 + 16, " ".join(LABELS[mesh].split()[1:]), 'font-weight="bold"'))
    return out


def read_histograms(folder):
    """Classes (from, to, share in %) by case and mesh."""
    histograms = {}
    for row in read(folder / "figure15.csv"):
        classes = histograms.setdefault((row["case"], row["mesh"]), [])
        classes.append((float(row["L/r above"]), float(row["up to"]), float(row["share %"])))
    return histograms


def draw_figure15(folder):
    histograms = read_histograms(folder)
    rows = {(row["case"], row["mesh"]): row for row in our_rows(folder)}
    cases = [case for case in SHOWN if (case, "incise") in histograms]
    shown = [entry for (case, _), classes in histograms.items() if case in cases for entry in classes]
    scale = (min(low for low, _, _ in shown), max(high for _, high, _ in shown),
             max(share for _, _, share in shown) * 1.25)
    width = LEFT + len(cases) * (WIDTH + GAP_X)
    height = TOP + len(COLOURS) * (HEIGHT + GAP_Y) + 40
    out = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %d %d" font-family="sans-serif" font-size="13">'
           % (width, height), "<title>Share of tets by L/r before and after a cut, in four meshes</title>",
           '<rect width="%d" height="%d" fill="white"/>' % (width, height),
           text(8, 22, "Share of tets by L/r (square-root scale). Black line: the original. Dashed: 200, above which a "
                "tet is bad-shaped", 'font-size="12"')]
    for column, case in enumerate(cases):
        out += draw_column(column, case, histograms, rows, scale)
    out.append(text(LEFT + (width - LEFT - GAP_X) / 2, height - 12,
                    "L/r, longest edge over inradius: smaller is better", 'text-anchor="middle"'))
    (folder / "figure15.svg").write_text("\n".join([*out, "</svg>", ""]), encoding="utf-8")


def main(folder):
    report_table3(folder)
    draw_figure15(folder)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]))
