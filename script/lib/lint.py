# SPDX-License-Identifier: Apache-2.0
"""Prints what clang-tidy 14 has to say of files of ours. usage: lint.py ROOT JOBS [FILE.cpp...]; none: what is built

It spends most of its time on headers, so files that compile alike are read together, in one source that includes them
all. Those that clash there, which shows as errors, are read once more among fewer others, and in the end alone.
"""
import concurrent.futures
import json
import os
import re
import shlex
import subprocess
import sys
import time

MOST_FILES = (40, 10, 2, 1)  # read together in the first round, the second, ...
OURS = r"/(include/incise|src|tests|apps|bench|examples)/.*\.(h|cpp)$"
EMSCRIPTEN = "/usr/share/emscripten/system/include"
COMPLAINT = re.compile(r"^(/[^:]+):\d+:\d+: (warning|error):")


def read_flags(build):
    """The compiler's arguments by file; None for one that is compiled in several ways."""
    flags = {}
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as database:
        for entry in json.load(database):
            words = shlex.split(entry["command"])
            these = words[1:words.index("-o")]
            flags[entry["file"]] = these if flags.get(entry["file"], these) == these else None
    return flags


def add_web_flags(root, flags):
    """Arguments for what emscripten alone compiles, where its headers are; says so where they are not."""
    folder = os.path.join(root, "bindings/web")
    like = flags.get(os.path.join(root, "src/render/ink_style.cpp"))
    paths = [os.path.join(folder, name) for name in sorted(os.listdir(folder)) if name.endswith(".cpp")]
    if like is None or not os.path.exists(os.path.join(EMSCRIPTEN, "emscripten/val.h")):
        print("lint: bindings/web is left out: it needs emscripten (script/bootstrap --web)", file=sys.stderr)
        return set(paths)
    for path in paths:
        flags[path] = [*like, "-I" + folder, "-isystem", EMSCRIPTEN]
    return set()


def matters(words):
    """Of a compiler's arguments those that change what is read: macros, folders and the language, not levels and warnings."""
    return [word for at, word in enumerate(words)
            if word.startswith(("-D", "-U", "-I", "-std=", "-isystem", "-include", "-x")) or
            words[at - 1] in ("-isystem", "-include", "-x")]


def groups_of(paths, flags, most):
    """Lists of at most `most` files that are read alike, the longest first."""
    alike = {}
    for path in sorted(paths):
        # What is compiled in several ways, or not at all, clang-tidy looks up best by itself.
        alike.setdefault(tuple(sorted(matters(flags.get(path) or []))) or (path,), []).append(path)
    groups = []
    for files in alike.values():
        count = -(-len(files) // most)
        groups += [files[len(files) * i // count:len(files) * (i + 1) // count] for i in range(count)]
    return sorted(together(groups, flags, most), key=len, reverse=True)


def macros(words):
    """What each macro is defined as."""
    return dict(word[2:].partition("=")[::2] for word in words if word.startswith("-D"))


def together(groups, flags, most):
    """Puts small groups into one where no macro of theirs is defined in two ways: a source looks at its own alone."""
    merged = []  # [files, macros, the language]
    for files in groups:
        words = flags.get(files[0])
        if words is None or "/bindings/web/" in files[0]:
            merged.append([files, None, None])
            continue
        own, language = macros(words), [word for word in words if word.startswith("-std=")]
        for other in merged:
            if (other[1] is not None and other[2] == language and len(other[0]) + len(files) <= most and
                    all(other[1].get(name, value) == value for name, value in own.items())):
                other[0] = other[0] + files
                other[1].update(own)
                break
        else:
            merged.append([files, own, language])
    return [files for files, _, _ in merged]


def words_of(group, flags):
    """The arguments of the first, and the folders and macros that others have besides."""
    words = list(flags[group[0]])
    for path in group[1:]:
        for at, word in enumerate(flags[path]):
            if word == "-isystem" and flags[path][at + 1] not in words:
                words += ["-isystem", flags[path][at + 1]]
            elif word.startswith(("-D", "-I")) and word not in words:
                words.append(word)
    return words


def read(root, build, group, flags):
    """Reads files together. Returns lines about files of ours, and which of the group have to be read again."""
    command = ["clang-tidy-14", "--quiet", "--header-filter=^" + re.escape(root) + OURS, "--extra-arg=-w"]
    if len(group) == 1 and "/bindings/web/" in group[0]:
        command += [group[0], "--", *flags[group[0]]]
    elif len(group) == 1:
        command += ["-p", build, group[0]]
    else:
        source_of_all = os.path.join(build, "lint_%s.cpp" % os.path.relpath(group[0], root).replace("/", "_"))
        with open(source_of_all, "w", encoding="utf-8") as source:
            source.writelines('#include "%s"\n' % path for path in group)
        command += ["--extra-arg=-ferror-limit=0", source_of_all, "--", *words_of(group, flags)]
    # Its exit status says too little: what counts is a complaint about a line of ours. (clang-tidy 14 also names a
    # parameter 'expr-type' that no file has, from generic lambdas, with no place.)
    output = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=False).stdout
    matches = [m for m in map(COMPLAINT.match, output.splitlines()) if m and m[1].startswith(root + "/")]
    clashing = {m[1] for m in matches if m[2] == "error"} if len(group) > 1 else set()
    lines = {m.string[len(root) + 1:] for m in matches if m[2] == "warning" or not clashing}
    if len(group) == 1 and group[0] not in flags and any("file not found" in line for line in lines):
        name = os.path.relpath(group[0], root)
        print(f"lint: {name} is left out: it is not built here, and a header that it needs is missing", file=sys.stderr)
        return set(), set()
    # An error in a header may be anybody's.
    return lines, clashing if clashing <= set(group) else set(group)


def main(root, jobs, paths):
    build = os.path.join(root, "build/lint")
    flags = read_flags(build)
    left_out = add_web_flags(root, flags)
    todo = ({os.path.abspath(path) for path in paths} or set(flags)) - left_out
    count, complaints = len(todo), set()
    began = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for most in MOST_FILES:
            groups = groups_of(todo, flags, most)
            results = []
            for result in pool.map(lambda group: read(root, build, group, flags), groups):
                results.append(result)
                print("lint: %d of %d groups of at most %d files, %d s" %
                      (len(results), len(groups), most, time.monotonic() - began), file=sys.stderr, flush=True)
            complaints.update(*(lines for lines, _ in results))
            todo = set().union(*(again for _, again in results))
    for line in sorted(complaints):
        print(line)
    print("lint: %d files, %d complaints" % (count, len(complaints)))
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], int(sys.argv[2]), sys.argv[3:]))
