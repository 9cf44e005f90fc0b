# SPDX-License-Identifier: Apache-2.0
"""Prints what a report of `incise cut` says, for people. usage: report_summary.py REPORT.json"""
import json
import sys

QUALITY = (("lr_mean", "L/r mean"), ("lr_p99", "L/r p99"), ("lr_max", "L/r worst"), ("lr_over_200_pct", "L/r > 200, %"),
           ("dihedral_min_deg", "smallest dihedral"), ("dihedral_max_deg", "greatest dihedral"))
STAGES = ("collision", "subdivide", "separate", "merge", "improve")
MAINTENANCE = (("collapsed_edges", "edges collapsed"), ("moved_vertices", "moves"), ("removed_edges", "edges removed"),
               ("removed_faces", "faces swapped"), ("inserted_vertices", "vertices inserted"),
               ("peeled_tets", "flat tets peeled off"), ("waiting_tets", "tets still waiting"))


def print_meshes(report):
    before, after = report["mesh"]["before"], report["mesh"]["after"]
    cut_tets = "%d" % report["quality"]["cut"]["tets"]
    print("%-22s %12s %12s %12s" % ("", "before", "last cut", "maintained"))
    for key in ("tets", "vertices", "components"):
        print("%-22s %12d %12s %12d" % (key, before[key], cut_tets if key == "tets" else "", after[key]))
    for key, name in QUALITY:
        print("%-22s %12.2f %12.2f %12.2f" % (name, *(report["quality"][of][key] for of in ("before", "cut", "after"))))
    volume = report["volume"]
    print("%-22s %12.6g %12s %12.6g   relative error %.1e"
          % ("volume", volume["before"], "", volume["after"], volume["relative_error"]))


def print_work(report):
    cut, maintain = report["cut"], report["maintain"]
    print("%d tets cut in %d steps: %d new tets, %d wall faces, %d vertices snapped"
          % (cut["cut_tets"], cut["steps"], cut["created_tets"], cut["incision_faces"], cut["snapped_vertices"]))
    done = ["%d %s" % (maintain[key], name) for key, name in MAINTENANCE if maintain.get(key)]
    print("maintenance: %+d tets; %s" % (maintain["created_tets"], ", ".join(done) or "nothing to do"))
    times = report["time_ms"]
    print("%.2f ms in all (%s)" % (times["total"], ", ".join(
        "%s %.2f" % (stage, times[stage]) for stage in STAGES if stage in times)))


def main(path):
    with open(path, encoding="utf-8") as source:
        report = json.load(source)
    print_meshes(report)
    print()
    print_work(report)
    print("valid" if report["validity"]["ok"] else "NOT VALID")
    print("state hash %s" % report["hash"])


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
