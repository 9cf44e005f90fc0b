# SPDX-License-Identifier: Apache-2.0
"""Runs the mutants of tests/paper/mutants.md in a copy of the tree: see script/mutants."""
import pathlib
import re
import subprocess
import sys
import typing

MUTANT = re.compile(r"^### (\d+)\. ([^\n]+)\n\n`([^`]+)`; killed by `([^`]+)`(?: of `(\w+)`)?\n\n```diff\n(.*?)```",
                    re.M | re.S)


class Test(typing.NamedTuple):
    """A filter of tests, and the program that has them."""
    filter: str
    program: str


def read_mutants(text):
    for number, name, file, tests, program, diff in MUTANT.findall(text):
        lines = diff.splitlines()
        old = "\n".join(line[1:] for line in lines if line.startswith("-"))
        new = "\n".join(line[1:] for line in lines if line.startswith("+"))
        yield int(number), name, file, Test(tests, program or "paper_test"), old, new


def copy_tree(root, folder):
    """Brings the copy up to date; files that are the same keep their times, so that little is built anew."""
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "-z"], cwd=root,
                            capture_output=True, check=True).stdout.decode()
    for name in filter(None, listed.split("\0")):
        source, target = root / name, folder / name
        if not source.is_file():
            continue
        data = source.read_bytes()
        if target.is_file() and target.read_bytes() == data:
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(data)
        target.chmod(source.stat().st_mode)


def configure(folder):
    run = subprocess.run(["cmake", "--preset", "release"], cwd=folder, capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit("script/mutants: the copy does not configure:\n" + run.stderr[-2000:])


def build(folder, jobs, programs):
    return subprocess.run(["cmake", "--build", "--preset", "release", "-j", jobs, "--target", *programs], cwd=folder,
                          capture_output=True, text=True)


def passes(folder, test):
    """Whether the tests that the filter names pass; there must be some."""
    run = subprocess.run([f"build/release/bin/{test.program}", f"--gtest_filter={test.filter}"], cwd=folder,
                         capture_output=True, text=True, timeout=600)
    return run.returncode == 0 and "[  PASSED  ] 0 tests" not in run.stdout


def judge(folder, jobs, file, test, old, new):
    path = folder / file
    text = path.read_text()
    if text.count(old) != 1:
        return f"does not apply: its lines are {text.count(old)} times in {file}"
    path.write_text(text.replace(old, new))
    try:
        built = build(folder, jobs, [test.program])
        if built.returncode != 0:
            return "does not compile: " + next((l for l in built.stdout.splitlines() if "error" in l), "")
        return "SURVIVES" if passes(folder, test) else None
    except subprocess.TimeoutExpired:
        return None
    finally:
        path.write_text(text)


def main():
    root, folder, jobs = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]
    wanted = {int(n) for n in sys.argv[4:]}
    copy_tree(root, folder)
    configure(folder)
    mutants = [m for m in read_mutants((folder / "tests/paper/mutants.md").read_text()) if not wanted or m[0] in wanted]
    if not mutants:
        sys.exit("script/mutants: there are no such mutants in tests/paper/mutants.md")
    built = build(folder, jobs, sorted({m[3].program for m in mutants}))
    if built.returncode != 0:
        sys.exit("script/mutants: the tree does not build:\n" + built.stdout[-2000:])
    broken = [test.filter for test in sorted({m[3] for m in mutants}) if not passes(folder, test)]
    if broken:
        sys.exit("script/mutants: without a mutant these fail, or there are none: " + ", ".join(broken))
    failed = 0
    for number, name, file, test, old, new in mutants:
        fault = judge(folder, jobs, file, test, old, new)
        failed += fault is not None
        print(f"{number:3}  {'killed' if fault is None else fault}  {name}  ({test.filter})", flush=True)
    print(f"{len(mutants)} mutants, {len(mutants) - failed} killed")
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
