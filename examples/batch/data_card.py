#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Figures for the data card of a batch, as Markdown. usage: data_card.py OUT/results.jsonl"""
import json
import sys
from collections import Counter
from statistics import median
from typing import Any

Row = dict[str, Any]

# What it is called, where a line has it, and its unit in that of the line.
FIGURES = [
    ("tets before", "input tets", 1),
    ("tets after", "tets", 1),
    ("pieces", "pieces", 1),
    ("tets cut", "cut_tets", 1),
    ("faces opened", "incision_faces", 1),
    ("worst L/r before", "quality before lr_max", 1),
    ("worst L/r after", "quality after lr_max", 1),
    ("mean L/r after", "quality after lr_mean", 1),
    ("least dihedral angle after, degrees", "quality after dihedral_min_deg", 1),
    ("peak force on the edge, N", "forces peak_force", 1),
    ("work of fracture, mJ", "forces fracture_work", 1e-3),
]


def values_of(rows: list[Row], place: str, unit: float) -> list[float]:
    """Of the lines that have it: forces are of scenes alone."""
    values = []
    for row in rows:
        found: Any = row
        for key in place.split():
            found = found.get(key) if found is not None else None
        if found is not None:
            values.append(found / unit)
    return values


def main(path: str) -> None:
    with open(path, encoding="utf-8") as lines:
        rows = [json.loads(line) for line in lines]
    whole = [row for row in rows if "error" not in row]
    print("%d items, of which %d failed, %d were cut by nothing and %d are not valid; %d meshes before their cuts.\n" % (
        len(rows), len(rows) - len(whole), sum(row["cut_tets"] == 0 for row in whole),
        sum(not row["valid"] for row in whole), len({row["input"]["hash"] for row in whole})))
    print("| label | items |\n|---|---|")
    for label, count in sorted(Counter(row.get("label", "none") for row in rows).items(), reverse=True):
        print("| %s | %d |" % (label, count))
    print("\n| stroke | items |\n|---|---|")
    for kinds, count in sorted(Counter(" ".join(row["stroke_names"]) for row in whole).items()):
        print("| %s | %d |" % (kinds or "without a name", count))
    print("\n| figure | least | median | most |\n|---|---|---|---|")
    for name, place, unit in FIGURES:
        values = values_of(whole, place, unit)
        if values:
            print("| %s | %.5g | %.5g | %.5g |" % (name, min(values), median(values), max(values)))


if __name__ == "__main__":
    main(sys.argv[1])
