# SPDX-License-Identifier: Apache-2.0
"""Runs the code of a notebook from top to bottom, without Jupyter; ends with 77 (skipped) where numpy or Matplotlib is
not installed. usage: run_notebook.py NOTEBOOK [PICTURE.png]     PICTURE: where its last figure goes
"""
import importlib.util
import json
import os
import sys

SKIPPED = 77
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def main(notebook, picture=None):
    missing = [name for name in ("numpy", "matplotlib") if importlib.util.find_spec(name) is None]
    if missing:
        print("skipped: %s is not installed for %s" % (", ".join(missing), sys.executable))
        return SKIPPED
    import matplotlib  # pylint: disable=import-outside-toplevel
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt  # pylint: disable=import-outside-toplevel
    plt.show = lambda *_args, **_kinds: None
    sys.path.insert(0, os.path.join(ROOT, "bindings", "python"))
    with open(notebook, encoding="utf-8") as file:
        cells = [cell for cell in json.load(file)["cells"] if cell["cell_type"] == "code"]
    names = {"__name__": "__main__"}
    for number, cell in enumerate(cells):
        exec(compile("".join(cell["source"]), "%s, cell %d" % (notebook, number), "exec"), names)
    figures = plt.get_fignums()
    print("%d cells, %d figures" % (len(cells), len(figures)))
    if picture and figures:
        plt.figure(figures[-1]).savefig(picture, dpi=110)
    return 0 if figures else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]) if len(sys.argv) in (2, 3) else __doc__)
