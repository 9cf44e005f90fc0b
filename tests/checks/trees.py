# SPDX-License-Identifier: Apache-2.0
"""Small trees of sources for the tests of checks, and what a check says of one."""
import contextlib
import io
import os
import sys
import tempfile


def import_checks(root):
    """From now on the checks in script/lib of a clone can be imported."""
    sys.path.insert(0, os.path.join(root, "script", "lib"))


def write(root, files):
    """Writes texts by path."""
    for path, text in files.items():
        place = os.path.join(root, path)
        os.makedirs(os.path.dirname(place), exist_ok=True)
        with open(place, "w", encoding="utf-8") as source:
            source.write(text)


def outcome(check, root):
    """The exit code of a check's `main` for a tree, and what it prints."""
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        code = check.main(root)
    return code, said.getvalue()


def outcome_of(check, files):
    """The same for a tree of these files alone."""
    with tempfile.TemporaryDirectory() as root:
        write(root, files)
        return outcome(check, root)


def expect(is_true, what):
    """Ends the test where something does not hold."""
    if not is_true:
        sys.exit("%s: %s" % (os.path.basename(sys.argv[0]), what))
