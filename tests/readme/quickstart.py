# SPDX-License-Identifier: Apache-2.0
"""Does what a quick start tells a new user to do, and compares what is printed.

usage: quickstart.py PAGE BIN [PREFIX]     BIN: where incise is built; PREFIX: where Incise is installed

Blocks of `sh` are run one after the other by one shell, in a folder with the clone's scenes and models. A block of `cpp`
or `cmake` is written to the file whose name stands before it in bold. Each line of a block of `text` must be in what the
block of `sh` before it prints. What builds the clone, opens a window or measures for minutes is passed over: PASSED_OVER.
"""
import os
import re
import subprocess
import sys
import tempfile

SKIPPED = 77
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PASSED_OVER = """
function script/demo { :; }; function script/models { :; }; function script/bench { :; }; function script/figures { :; }
function incise-view { case " $* " in *" --headless "*) command incise-view "$@" ;; esac; }
function build/release/bin/incise-view { incise-view "$@"; }
function cmake { case " $* " in *" --preset "* | *" --install "*) ;; *) command cmake "$@" ;; esac; }
function python3 { case " $* " in *" venv "*) ;; *) command python3 "$@" ;; esac; }
function venv/bin/pip { :; }
function export { :; }
set -o errexit -o pipefail
"""
BLOCK = re.compile(r"(?:\*\*(\w+\.\w+)\*\*[^\n]*\n(?:[^`\n][^\n]*\n|\n)*?)?```(\w+)\n(.*?)```", re.S)


def script_of(page, folder):
    """A shell script of the page's blocks that marks where each begins, and which lines each must print."""
    script, wanted = PASSED_OVER, []
    for name, language, text in BLOCK.findall(page):
        if name:
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        elif language == "sh":
            script += "echo '== block %d'\n%s" % (len(wanted), text)
            wanted.append([])
        elif language == "text":
            wanted[-1] += text.splitlines()
    return script, wanted


def main(page, binaries, prefix=""):
    if not os.path.exists(os.path.join(ROOT, "models", "bunny.mesh")):
        print("skipped: there is no models/bunny.mesh; script/models makes it")
        return SKIPPED
    with open(page, encoding="utf-8") as file:
        text = file.read()
    with tempfile.TemporaryDirectory(prefix="incise quick start ") as folder:
        for name in ("scenes", "models"):
            os.symlink(os.path.join(ROOT, name), os.path.join(folder, name))
        if prefix:
            os.symlink(prefix, os.path.join(folder, "incise"))
        script, wanted = script_of(text, folder)
        environment = dict(os.environ, HOME=folder, PATH=binaries + ":" + os.environ["PATH"])
        done = subprocess.run(["bash", "-c", script], cwd=folder, env=environment, capture_output=True, text=True, check=False)
    print(done.stdout, done.stderr, sep="\n")
    printed = [part.splitlines() for part in re.split(r"== block \d+\n", done.stdout)[1:]]
    missing = [line for block, lines in zip(printed, wanted) for line in lines if line not in block]
    for line in missing:
        print("not printed:", line)
    return 1 if missing or done.returncode != 0 or len(printed) != len(wanted) or not wanted else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]) if len(sys.argv) in (3, 4) else __doc__)
