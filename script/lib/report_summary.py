# SPDX-License-Identifier: Apache-2.0
"""Prints what a report of `incise cut` says, for people. usage: report_summary.py REPORT.json"""
import json
import sys


def main(path):
    with open(path, encoding="utf-8") as source:
        report = json.load(source)
    before, after = report["mesh"]["before"], report["mesh"]["after"]
    cut, quality, volume, times = report["cut"], report["quality"], report["volume"], report["time_ms"]
    print("%-22s %12s %12s" % ("", "before", "after"))
    for key in ("tets", "vertices", "components"):
        print("%-22s %12d %12d" % (key, before[key], after[key]))
    for key, name in (("lr_mean", "L/r mean"), ("lr_max", "L/r worst"), ("dihedral_min_deg", "smallest dihedral")):
        print("%-22s %12.2f %12.2f" % (name, quality["before"][key], quality["after"][key]))
    print("%-22s %12.6g %12.6g   relative error %.1e"
          % ("volume", volume["before"], volume["after"], volume["relative_error"]))
    print()
    print("%d tets cut in %d steps: %d new tets, %d wall faces, %d vertices snapped"
          % (cut["cut_tets"], cut["steps"], cut["created_tets"], cut["incision_faces"], cut["snapped_vertices"]))
    print("%.2f ms in all (%s)" % (times["total"], ", ".join(
        "%s %.2f" % (stage, times[stage]) for stage in ("collision", "subdivide", "separate") if stage in times)))
    print("valid" if report["validity"]["ok"] else "NOT VALID")
    print("state hash %s" % report["hash"])


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
