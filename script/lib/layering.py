# SPDX-License-Identifier: Apache-2.0
"""Checks the #include lines of the tree. usage: layering.py ROOT"""
import os
import re
import sys

LOWEST = ("core", "geom", "mesh")
MAY_INCLUDE = {
    "core": (),
    "geom": ("core",),
    "mesh": ("core", "geom"),
    "cut": LOWEST,
    "improve": LOWEST,
    "paper": LOWEST + ("cut", "improve"),
    "lab": LOWEST + ("cut", "paper"),
    "sim": LOWEST,
    "io": LOWEST,
    "image": LOWEST + ("improve", "io"),
    "engine": LOWEST + ("cut", "improve", "paper", "sim", "io"),
    "app": LOWEST + ("cut", "improve", "paper", "lab", "sim", "io", "image", "engine"),
    "render": LOWEST + ("app",),
    "c": (),  # include/incise/c: C, and self-contained; bindings/c is a front end
}
# Modules that may use what is private to others: the paper's profile shares sweeps, templates and journal steps; the
# cited methods share the paper's search for crossings besides.
MAY_LOOK_INTO = {"paper": ("cut", "improve"), "lab": ("cut", "paper")}
# What a module is to those above it, though it is not installed: parts, and who calls them; and constants that modules
# share which may not include each other.
PARTS = {
    "cut/cutter.h": ("engine",),
    "geom/constants.h": ("mesh", "cut", "improve"),
    "improve/maintainer.h": ("engine", "image"),
    "paper/paper_cut.h": ("engine",),
    "paper/paper_maintenance.h": ("engine",),
}
# Folders of a module, lowest first: each may include those before it, unless they are named as parts side by side.
ROOMS = {
    "app": ("text", "model", "scene", "recording", "jobs", "view", "hands", "session", "viewer"),
    "sim": ("body", "haptic", "reference"),
}
SIDE_BY_SIDE = {("sim", "haptic", "reference"), ("sim", "reference", "haptic")}
# The modules of the programs. Their headers lie beside their sources: include/ is what is installed.
OF_PROGRAMS = ("app", "render")
FRONT_ENDS = ("apps", "bindings", "bench", "examples")
# It names public headers for those who want all of them; no module may include it.
UMBRELLA = os.path.join("include", "incise", "incise.h")
VERSION = "incise/version.h"  # made when the build is configured
SOURCE_ENDINGS = (".h", ".cpp", ".hpp", ".c", ".cc", ".inc", ".hh", ".cxx", ".hxx", ".c++", ".h++", ".ipp", ".inl",
                  ".tpp")
OUR_ENDINGS = (".h", ".cpp")  # of modules
# Headers of C that installed ones may include. Those of C++ have neither a dot nor a slash.
C_HEADERS = ("stdint.h", "stddef.h", "stdbool.h")
# Third-party headers, and the modules whose .cpp files may include them. No public header may, but for Eigen.
PRIVATE_HEADERS = {
    "tbb/": ("core",),  # behind core/parallel.h
    "oneapi/": (),
    "hwy/": ("geom", "mesh", "cut", "improve", "sim"),
    "pugixml.hpp": ("io",),
    "zlib.h": ("io", "image", "render"),
    "nlohmann/": ("io", "app"),
    "fmt/": ("io", "app"),
    "CLI/": (),
    "epoxy/": ("render",),
    "EGL/": ("render",),
    "stb/": ("render",),
    "boost/": ("app",),
    "iostream": ("app",),  # the library prints nothing
}
# Folders of headers that all may include in their .cpp files.
EVERYBODYS = ("Eigen/", "sys/")
INCLUDE = re.compile(r'^\s*#\s*(?:include|include_next|import)\b\s*(.*)')
NAME = re.compile(r'[<"]([^>"]+)[>"]')


def sources(root, folder):
    if os.path.isfile(os.path.join(root, folder)):
        yield folder
    for where, folders, names in os.walk(os.path.join(root, folder)):
        folders.sort()
        for name in sorted(names):
            if name.lower().endswith(SOURCE_ENDINGS):
                yield os.path.relpath(os.path.join(where, name), root)


def includes(root, path):
    with open(os.path.join(root, path), encoding="utf-8") as source:
        for number, line in enumerate(source, 1):
            match = INCLUDE.match(line)
            if match:
                name = NAME.match(match.group(1))
                yield number, name.group(1) if name else match.group(1)


def module_of(header):
    """The module of ours that `header`, as written in an #include, belongs to; None for others."""
    parts = header.split("/")
    if parts[0] == "incise" and len(parts) > 2:
        return parts[1]
    return parts[0] if parts[0] in MAY_INCLUDE and len(parts) > 1 else None


def room_of(root, module, path):
    """The room in which a file of `module` lies, or the source that goes with a public header; None where it has none."""
    parts = path.split("/")
    if parts[0] == "src":
        return parts[2] if len(parts) > 3 else None
    stem = os.path.splitext(parts[-1])[0]
    for room in ROOMS[module]:
        if os.path.exists(os.path.join(root, "src", module, room, stem + ".cpp")):
            return room
    return None  # headers alone: only what they include is looked at


def check_rooms(root, module, path, header):
    """Whether a file may include a header of its own module."""
    rooms = ROOMS[module]
    own = room_of(root, module, path)
    header_path = "include/" + header if header.startswith("incise/") else "src/" + header
    other = room_of(root, module, header_path)
    if other is not None and other not in rooms:
        return "there is no room '%s' in %s" % (other, module)
    if own not in rooms or other is None or own == other:
        return None  # a file that lies in no room is told once, by itself
    if rooms.index(other) > rooms.index(own) or (module, own, other) in SIDE_BY_SIDE:
        return "%s/%s must not include %s/%s" % (module, own, module, other)
    return None


def check_name(header):
    """Whether a header is named in a way that tells where it belongs."""
    if ".." in header.split("/") or header.startswith(("./", "/")):
        return "%s: name headers from include/ or src/ on" % header
    if header == VERSION or module_of(header) is not None:
        return None
    if header.startswith("incise/"):
        return "%s belongs to no module" % header
    return None


def is_installed_elsewhere(header):
    """Whether a public header may include what is not Incise's: the standard library and Eigen."""
    return header.startswith("Eigen/") or header in C_HEADERS or not re.search(r"[./]", header)


def check_part(module, header):
    """Whether `module` may include a private header of another module."""
    other = module_of(header)
    if other in MAY_LOOK_INTO.get(module, ()) + OF_PROGRAMS or module in PARTS.get(header, ()):
        return None
    return "%s is private to module %s" % (header, other)


def check_third_party(module, path, header):
    if path.startswith("include/") and not is_installed_elsewhere(header):
        return "<%s> in a public header" % header
    for prefix, allowed in PRIVATE_HEADERS.items():
        if header == prefix or (prefix.endswith("/") and header.startswith(prefix)):
            return None if module in allowed else "<%s> has no place in module %s" % (header, module)
    is_known = "/" not in header or header.startswith(EVERYBODYS)
    return None if is_known else "<%s> is of no third party that modules may include" % header


def check_module_file(root, module, path, header):
    other = module_of(header)
    complaint = check_name(header)
    if complaint:
        return complaint
    if other == module and module in ROOMS:
        complaint = check_rooms(root, module, path, header)
        if complaint:
            return complaint
    if other is not None and other != module and other not in MAY_INCLUDE[module]:
        return "module %s must not include %s" % (module, other)
    if other is None or header.startswith("incise/"):
        return None if other is not None or header == VERSION else check_third_party(module, path, header)
    if path.startswith("include/"):
        return "a public header includes a private one"
    return None if other == module else check_part(module, header)


def check_front_end_file(root, path, header):
    if header.startswith("incise/"):
        known = header == "incise/version.h" or os.path.exists(os.path.join(root, "include", header))
        return None if known else "%s is no public header" % header
    if module_of(header) in OF_PROGRAMS:
        known = os.path.exists(os.path.join(root, "src", header))
        return None if known else "there is no %s" % header
    beside = os.path.normpath(os.path.join(os.path.dirname(path), header))
    if beside.startswith("src" + os.sep) or module_of(header) is not None and \
            os.path.exists(os.path.join(root, "src", header)):
        return "front ends use public headers only, and those of app and render"
    return None


def module_of_file(path):
    """The module that a file of src/ or include/ lies in; None where it lies in none."""
    parts = path.split(os.sep)
    if parts[0] == "src":
        return parts[1] if len(parts) > 2 else None
    return parts[2] if len(parts) > 3 and parts[1] == "incise" else None


def place_problem(root, module, path):
    """What is wrong with where a file of src/ or include/ lies, and with its name; None where nothing is."""
    if module not in MAY_INCLUDE:
        return "lies in no module" if module is None else "there is no module '%s'" % module
    if not path.endswith(OUR_ENDINGS):
        return "sources end in %s" % " or ".join(OUR_ENDINGS)
    in_include = path.startswith("include" + os.sep)
    if in_include and module in OF_PROGRAMS:
        return "include/ is what is installed; headers of %s lie beside their sources" % module
    if not in_include and module in ROOMS and room_of(root, module, path) not in ROOMS[module]:
        return "lies in no room of %s: %s" % (module, ", ".join(ROOMS[module]))
    return None


def wrong_includes(root, path, check):
    for number, header in includes(root, path):
        complaint = check(header)
        if complaint:
            yield "%s:%d: %s" % (path, number, complaint)


def main(root):
    checked, wrong = 0, []
    for base in ("include", "src"):
        for path in sources(root, base):
            if path == UMBRELLA:
                continue
            checked += 1
            module = module_of_file(path)
            problem = place_problem(root, module, path)
            if problem:
                wrong.append("%s: %s" % (path, problem))
            if module in MAY_INCLUDE:
                wrong += wrong_includes(root, path, lambda header: check_module_file(root, module, path, header))
    for base in FRONT_ENDS + (UMBRELLA,):
        for path in sources(root, base):
            checked += 1
            wrong += wrong_includes(root, path, lambda header: check_front_end_file(root, path, header))
    for line in wrong:
        print(line)
    print("layering: %d files, %d wrong includes" % (checked, len(wrong)))
    return 1 if wrong or checked == 0 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]) if len(sys.argv) == 2 else __doc__)
