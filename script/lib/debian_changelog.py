# SPDX-License-Identifier: Apache-2.0
"""Writes CHANGELOG.md as Debian's changelog. usage: debian_changelog.py ROOT PACKAGE VERSION MAINTAINER OUT

VERSION is that of the newest section, which may be unreleased: its date is then that of the last commit.
"""
import re
import subprocess
import sys
import textwrap
from datetime import datetime, timezone
from email.utils import format_datetime
from pathlib import Path

HEADING = re.compile(r"^## \[?(?P<name>[^\]\s]+)\]?(?: → (?P<next>\S+))?(?: - (?P<date>\d{4}-\d\d-\d\d))?", re.M)
WIDTH = 78


def last_commit(root: Path) -> datetime:
    """When the sources were last changed; the changelog's own time where there is no git."""
    found = subprocess.run(["git", "-C", str(root), "log", "-1", "--format=%ct"], capture_output=True, text=True)
    seconds = found.stdout.strip() or (root / "CHANGELOG.md").stat().st_mtime
    return datetime.fromtimestamp(int(seconds), timezone.utc)


def plain(text: str) -> str:
    """Without links and Markdown's marks."""
    return re.sub(r"[`*]+", '"', re.sub(r"\[([^\]]+)\]\([^)]*\)", r"\1", text))


def entries(section: str) -> list[str]:
    """The items of a section, wrapped and indented as Debian has them."""
    lines = []
    for part in re.split(r"^### ", section, flags=re.M)[1:]:
        title, _, body = part.partition("\n")
        lines += ["", "  [ %s ]" % title.strip()]
        for item in re.split(r"^- ", body, flags=re.M)[1:]:
            text = plain(" ".join(item.split()))
            lines += textwrap.wrap(text, WIDTH, initial_indent="  * ", subsequent_indent="    ")
    return lines


def main(root: Path, package: str, version: str, maintainer: str, out: Path) -> None:
    text = (root / "CHANGELOG.md").read_text(encoding="utf-8")
    headings = list(HEADING.finditer(text))
    if not headings or (headings[0]["next"] or headings[0]["name"]) != version.rpartition("-")[0]:
        sys.exit("CHANGELOG.md does not begin with a section for %s" % version.rpartition("-")[0])
    revision = version.rpartition("-")[2]
    stanzas = []
    for heading, after in zip(headings, headings[1:] + [None]):
        section = text[heading.end():after.start() if after else len(text)]
        date = datetime.fromisoformat(heading["date"] + "T00:00:00+00:00") if heading["date"] else last_commit(root)
        head = "%s (%s-%s) unstable; urgency=medium" % (package, heading["next"] or heading["name"], revision)
        stanzas.append("\n".join([head] + entries(section) +
                                 ["", " -- %s  %s" % (maintainer, format_datetime(date)), ""]))
    out.write_text("\n".join(stanzas), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]), *sys.argv[2:5], Path(sys.argv[5]))
