# SPDX-License-Identifier: Apache-2.0
"""Compares the layout of structs in Python's ctypes with the C compiler's. usage: check_layout.py PROGRAM BINDINGS"""
import ctypes
import importlib.util
import os
import subprocess
import sys


def main(program, bindings):
    spec = importlib.util.spec_from_file_location("_c", os.path.join(bindings, "python", "incise", "_c.py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    wrong, lines = 0, subprocess.run([program], check=True, capture_output=True, text=True).stdout.splitlines()
    for line in lines:
        name, value = line.split()
        struct, _, member = name.partition(".")
        kind = getattr(module, struct)
        here = getattr(kind, member).offset if member else ctypes.sizeof(kind)
        if here != int(value):
            print("%s: %d in C, %d in Python" % (name, int(value), here))
            wrong += 1
    print("%d sizes and offsets, %d differ" % (len(lines), wrong))
    return 1 if wrong or not lines else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]) if len(sys.argv) == 3 else __doc__)
