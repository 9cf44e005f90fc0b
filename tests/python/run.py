# SPDX-License-Identifier: Apache-2.0
"""Runs a check of the Python package; ends with 77 (skipped) where a package that it needs is not installed.

usage: run.py pytest ARGUMENT... | mypy | wheel
"""
import importlib.util
import os
import subprocess
import sys
import tempfile
import zipfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PACKAGE = os.path.join(ROOT, "bindings", "python")
SKIPPED = 77

SMOKE = """
import incise
engine = incise.box((3, 3, 3))
engine.cut_plane((1, 0.1, 0), 0.5)
assert len(engine.pieces()) == 2 and engine.validate(), "the cut is not right"
print("Incise", incise.__version__, "from", incise.__file__)
"""


def skip_without(*packages):
    missing = [name for name in packages if importlib.util.find_spec(name) is None]
    if missing:
        print("skipped: %s is not installed for %s" % (", ".join(missing), sys.executable))
        sys.exit(SKIPPED)


def run_pytest(arguments):
    skip_without("numpy", "pytest")
    environment = dict(os.environ, PYTHONPATH=PACKAGE)
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-rs", *arguments]
    return subprocess.run(command, cwd=ROOT, env=environment, check=False).returncode


def run_mypy():
    skip_without("numpy", "mypy")
    command = [sys.executable, "-m", "mypy", "--cache-dir", tempfile.mkdtemp(prefix="incise-mypy-"), "--config-file",
               os.path.join(ROOT, "pyproject.toml"), os.path.join(PACKAGE, "incise"),
               os.path.join(PACKAGE, "incise_build.py"), os.path.join(ROOT, "tests", "python", "typed_use.py")]
    return subprocess.run(command, cwd=ROOT, check=False).returncode


def check_metadata(wheel, folder):
    """What pip is told before anything is compiled is what the wheel says."""
    told = subprocess.run([sys.executable, "-c", "import incise_build, sys; "
                           "print(incise_build.prepare_metadata_for_build_wheel(sys.argv[1]))", folder],
                          env=dict(os.environ, PYTHONPATH=PACKAGE), check=True, capture_output=True, text=True).stdout.strip()
    with zipfile.ZipFile(wheel) as content:
        for name in ("METADATA", "WHEEL"):
            with open(os.path.join(folder, told, name), "rb") as file:
                if file.read() != content.read(told + "/" + name):
                    raise SystemExit("%s of the wheel is not what was told before" % name)


def run_wheel():
    """Builds the wheel around the library of this build, installs it into a folder of its own, and uses it there."""
    skip_without("numpy", "pip")
    with tempfile.TemporaryDirectory(prefix="incise wheel ") as folder:
        built = subprocess.run([sys.executable, "-c", "import incise_build, sys; print(incise_build.build_wheel(sys.argv[1]))",
                                folder], env=dict(os.environ, PYTHONPATH=PACKAGE), check=True, capture_output=True, text=True)
        check_metadata(os.path.join(folder, built.stdout.strip()), folder)
        wheel, site = os.path.join(folder, built.stdout.strip()), os.path.join(folder, "site")
        subprocess.run([sys.executable, "-m", "pip", "install", "-q", "--no-index", "--no-deps", "--target", site, wheel],
                       check=True)
        environment = {name: value for name, value in os.environ.items() if name != "INCISE_LIBRARY"}
        return subprocess.run([sys.executable, "-c", SMOKE], cwd=folder, env=dict(environment, PYTHONPATH=site),
                              check=False).returncode


def main(arguments):
    if arguments[:1] == ["pytest"]:
        return run_pytest(arguments[1:])
    return {("mypy",): run_mypy, ("wheel",): run_wheel}.get(tuple(arguments), lambda: __doc__)()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
