# SPDX-License-Identifier: Apache-2.0
"""Prepares a public header for doxygen. usage: reference_filter.py HEADER, which prints it

- Comments of the C header become doxygen's: /* ... */ before a declaration, or behind it on its line.
- A comment of several members of one line counts for each of them.
- Names that mean the same everywhere need no comment of their own in a header: CONVENTIONS documents them.
- Specialisations of std::hash, which doxygen does not read, are left out.
Lines stay where they are, so that warnings name the header's own.
"""
import re
import sys

CONTAINER = "As of the standard library's containers."
CONVENTIONS = (
    # C
    (r"^  uint32_t size;$", "sizeof this struct, set by the caller"),
    (r"^#define INCISE_API __attribute__", "Makes a call visible outside the library."),
    (r"^  u?int(8|16|32)_t pad(\[\d+\])?;$", "unused; 0"),
    # C++
    (r"^ +\w+\(\w+&&(?: other)?\)(?: noexcept)?(?:;| :| = default;| \{)", "Moves."),
    (r"^ +\w+& operator=\(\w+&&(?: other)?\)(?: noexcept)?(?:;| = default;| \{)", "Moves."),
    (r"^ +(?:\w+\(const \w+&(?: other)?\)|\w+& operator=\(const \w+&(?: other)?\))(?:;| :| = default;| \{)", "Copies."),
    (r"^ +friend (?:constexpr )?bool operator(?:==|!=|<)\(", "Compares by value."),
    (r"^ +\w+& operator\+=\(const \w+& other\)", "Adds what another one counted."),
    (r"^ +explicit operator bool\(\) const", "Whether it may be applied."),
    (r"^  (?:\[\[nodiscard\]\] )?(?:const )?T\* (?:begin|end|data)\(\)", CONTAINER),
    (r"^  \[\[nodiscard\]\] (?:std::size_t|bool) (?:size|empty|capacity)\(\) const", CONTAINER),
    (r"^  (?:const )?T& (?:operator\[\]\(std::size_t|back\(\))", CONTAINER),
    (r"^  void (?:push_back|pop_back|clear|swap)\(", CONTAINER),
)
ENDS_COMMENT = re.compile(r"^\s*(?:/\*| \*)(?:[^*]|\*(?!/))*\*/$|^ \*/$")  # of a comment on lines of its own
MEMBERS = re.compile(r"^(?P<space> *)(?P<type>(?:inline constexpr |static constexpr )?[\w:]+(?:<[^;()]*>)?) "
                     r"(?P<names>\w[^;]*,[^;]*);(?: *///< (?P<comment>.*))?$")


def as_c(line, is_first):
    """A line of the C header, with doxygen's comments."""
    if is_first:
        return "/** @file c/incise.h"
    if re.match(r"\s*/\* ?(-{4}|C names|NOLINT)", line):
        return line
    if re.match(r"\s*/\*", line):
        return line.replace("/*", "/**", 1)
    return re.sub(r"^(.*\S.*?)/\*", r"\1/**<", line)


def parted(text):
    """What commas part outside of brackets."""
    parts, depth = [""], 0
    for character in text:
        depth += (character in "({[<") - (character in ")}]>")
        if character == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    return [part.strip() for part in parts]


def one_by_one(line, has_comment):
    """Members of one line as declarations of their own, each with the comment, or sent to the first one's."""
    match = MEMBERS.match(line)
    names = parted(match["names"]) if match else []
    if len(names) < 2 or not (match["comment"] or has_comment):
        return line
    texts = [match["comment"]] * len(names) if match["comment"] else [None] + ["See the one before it."] * (len(names) - 1)
    return match["space"] + " ".join("%s %s;%s" % (match["type"], name, " /**< %s */" % text if text else "")
                                     for name, text in zip(names, texts))


def with_convention(line, has_comment):
    """A line with the comment that its name has by convention, unless it has one of its own."""
    if has_comment or "///<" in line or "/**<" in line:
        return line
    for pattern, text in CONVENTIONS:
        if re.match(pattern, line):
            return re.sub(r"^( *)", r"\1/** %s */ " % text, line, count=1)
    return line


def main(path):
    with open(path, encoding="utf-8") as header:
        lines = header.read().splitlines()
    is_c, is_hash, before = path.endswith("/c/incise.h"), False, ""
    for i, line in enumerate(lines):
        is_hash = is_hash or any("struct std::hash<" in near for near in lines[i:i + 2])
        has_comment = before.lstrip().startswith("///") or bool(ENDS_COMMENT.match(before))
        shown = as_c(line, i == 0) if is_c else one_by_one(line, has_comment)
        print("" if is_hash else with_convention(shown, has_comment))
        is_hash = is_hash and line != "};"
        before = line


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]) if len(sys.argv) == 2 else __doc__)
