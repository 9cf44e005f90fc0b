#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the other languages' declarations of include/incise/c/incise.h, so that none of them is written by hand.

usage: bindings/generate.py [--check]     --check: writes nothing, fails where a file is not what it would write
"""
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
HEADER = "include/incise/c/incise.h"
NOTE = "Written by bindings/generate.py from %s: change that, and run it again." % HEADER


class Type:
    """`base`, how many stars, whether what it points to is const, and the length of an array (0: none)."""

    def __init__(self, text, length=0):
        words = text.replace("*", " * ").split()
        self.stars = words.count("*")
        self.is_const = "const" in words
        self.base = [word for word in words if word not in ("const", "*")][0]
        self.length = length


class Header:
    """What the header declares, in its order."""

    def __init__(self, text):
        self.constants = []   # (name, value)
        self.opaque = []      # name
        self.callbacks = []   # (name, return, [(name, type)])
        self.structs = []     # (name, [(name, type)], comment)
        self.functions = []   # (name, return, [(name, type)], comment)
        body = text[text.index("---- versions and errors"):]
        self._read_constants(body)
        self._read_declarations(body)
        self.struct_names = {name for name, _, _ in self.structs}
        self.callback_names = {name for name, _, _ in self.callbacks}
        self._check_types()

    def _check_types(self):
        known = set(CTYPES) | {"char"} | self.struct_names | self.callback_names | set(self.opaque)
        lists = [arguments for _, _, arguments, _ in self.functions] + [members for _, members, _ in self.structs]
        for name, kind in (pair for pairs in lists for pair in pairs):
            if kind.base not in known:
                raise SystemExit("%s: the type of %s is %s, which bindings/generate.py does not know" %
                                 (HEADER, name, kind.base))

    def _read_constants(self, body):
        for name, value in re.findall(r"^#define (INCISE_[A-Z0-9_]+) +([0-9A-Fa-fxu]+)", body, re.M):
            self.constants.append((name, int(value.rstrip("u"), 0)))

    def _read_declarations(self, body):
        pattern = re.compile(
            r"(?P<comment>(?:/\*(?:[^*]|\*(?!/))*\*/\s*)?)"
            r"(?:typedef struct (?P<opaque>\w+) \w+;"
            r"|typedef struct (?P<struct>\w+) \{(?P<members>.*?)\} \w+;"
            r"|typedef (?P<returns>[\w ]+?) \(\*(?P<callback>\w+)\)\((?P<call_args>[^)]*)\);"
            r"|INCISE_API (?P<result>[^;(]+?)\s*(?P<function>incise_\w+)\((?P<args>[^)]*)\);)", re.S)
        for found in pattern.finditer(body):
            comment = tidy_comment(found["comment"])
            if found["opaque"]:
                self.opaque.append(found["opaque"])
            elif found["struct"]:
                self.structs.append((found["struct"], members_of(found["members"]), comment))
            elif found["callback"]:
                self.callbacks.append((found["callback"], Type(found["returns"]), arguments_of(found["call_args"])))
            else:
                self.functions.append((found["function"], Type(found["result"]), arguments_of(found["args"]), comment))


def tidy_comment(text):
    return " ".join(text.strip().removeprefix("/*").removesuffix("*/").replace("\n *", " ").split())


def members_of(text):
    plain = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
    members = []
    for declaration in filter(None, (part.strip() for part in plain.split(";"))):
        found = re.fullmatch(r"(.*?)(\w+)(?:\[(\d+)\])?", declaration, re.S)
        members.append((found[2], Type(found[1], int(found[3] or 0))))
    return members


def arguments_of(text):
    arguments = []
    for argument in (part.strip() for part in text.split(",")):
        if argument != "void":
            found = re.fullmatch(r"(.*?)(\w+)", argument, re.S)
            arguments.append((found[2], Type(found[1])))
    return arguments


# ---- Python ----

CTYPES = {"int32_t": "c_int32", "int64_t": "c_int64", "uint32_t": "c_uint32", "uint64_t": "c_uint64", "uint8_t": "c_uint8",
          "double": "c_double", "incise_status": "c_int32", "void": "None"}


def ctypes_of(header, kind):
    if kind.stars:
        if kind.base == "char" and kind.is_const:
            return "c_char_p"
        if kind.base in header.struct_names and kind.stars == 1:
            return "POINTER(%s)" % kind.base
        return "c_void_p"
    plain = CTYPES.get(kind.base, kind.base)
    return "%s * %d" % (plain, kind.length) if kind.length else plain


def write_python(header):
    lines = ['# SPDX-License-Identifier: Apache-2.0', '"""%s"""' % NOTE, "from __future__ import annotations", "",
             "from ctypes import (CDLL, CFUNCTYPE, POINTER, Structure, c_char_p, c_double, c_int32, c_int64, c_uint8,",
             "                    c_uint32, c_uint64, c_void_p)", "from typing import Any", ""]
    lines += ["%s = %s" % (name.removeprefix("INCISE_"), value) for name, value in header.constants]
    for name, returns, arguments in header.callbacks:
        kinds = [ctypes_of(header, returns)] + [ctypes_of(header, kind) for _, kind in arguments]
        lines += ["", "%s: Any = CFUNCTYPE(%s)" % (name, ", ".join(kinds))]
    for name, members, _ in header.structs:
        lines += ["", "", "class %s(Structure):" % name, "    _fields_ = ["]
        lines += ['        ("%s", %s),' % (member, ctypes_of(header, kind)) for member, kind in members]
        lines += ["    ]"]
    lines += ["", "", "def declare(library: CDLL) -> None:", '    """Tells ctypes what the calls take and return."""']
    for name, returns, arguments, _ in header.functions:
        kinds = ", ".join(ctypes_of(header, kind) for _, kind in arguments)
        lines += ["    library.%s.restype = %s" % (name, ctypes_of(header, returns)),
                  "    library.%s.argtypes = [%s]" % (name, kinds)]
    return "\n".join(lines) + "\n"


# ---- Rust ----

RUST = {"int32_t": "i32", "int64_t": "i64", "uint32_t": "u32", "uint64_t": "u64", "uint8_t": "u8", "double": "f64",
        "incise_status": "i32", "void": "c_void", "char": "c_char"}


def rust_of(header, kind):
    plain = RUST.get(kind.base, kind.base)
    if kind.base in header.callback_names:
        return "Option<%s>" % plain
    text = plain
    for star in range(kind.stars):
        text = ("*const " if kind.is_const and star == 0 else "*mut ") + text
    return "[%s; %d]" % (text, kind.length) if kind.length else text


def rust_call(header, returns, arguments):
    text = "(%s)" % ", ".join("%s: %s" % (rust_name(name), rust_of(header, kind)) for name, kind in arguments)
    return text if returns.base == "void" and not returns.stars else text + " -> " + rust_of(header, returns)


def rust_name(name):
    return "r#" + name if name in ("type", "move", "box") else name


def write_rust(header):
    lines = ["// SPDX-License-Identifier: Apache-2.0", "// " + NOTE,
             "#![allow(non_camel_case_types, dead_code, missing_docs)]", "use std::os::raw::{c_char, c_void};", ""]
    for name, value in header.constants:
        kind = "u64" if value > 0xFFFFFFFF else "u32" if value > 0x7FFFFFFF or name == "INCISE_ABI" else "i32"
        lines.append("pub const %s: %s = %s;" % (name, kind, hex(value) if value > 0x7FFFFFFF else value))
    for name in header.opaque:
        lines += ["#[repr(C)]", "pub struct %s {" % name, "    _opaque: [u8; 0],", "}"]
    for name, returns, arguments in header.callbacks:
        lines.append('pub type %s = unsafe extern "C" fn%s;' % (name, rust_call(header, returns, arguments)))
    for name, members, _ in header.structs:
        lines += ["#[repr(C)]", "#[derive(Clone, Copy)]", "pub struct %s {" % name]
        lines += ["    pub %s: %s," % (rust_name(member), rust_of(header, kind)) for member, kind in members] + ["}"]
    lines += ['#[link(name = "incise")]', 'extern "C" {']
    lines += ["    pub fn %s%s;" % (name, rust_call(header, returns, arguments))
              for name, returns, arguments, _ in header.functions]
    return "\n".join(lines + ["}"]) + "\n"


# ---- C# ----

CSHARP = {"int32_t": "int", "int64_t": "long", "uint32_t": "uint", "uint64_t": "ulong", "uint8_t": "byte", "double": "double",
          "incise_status": "int", "void": "void", "char": "byte"}
CSHARP_WORDS = {"params": "@params", "fixed": "@fixed", "in": "@in", "out": "@out", "base": "@base"}


def csharp_of(header, kind, is_argument=False):
    if kind.base in header.opaque:
        return "IntPtr" if kind.stars == 1 else "out IntPtr"
    if kind.base in header.callback_names:
        return kind.base if is_argument else "IntPtr"
    if kind.base == "char" and kind.stars == 1 and kind.is_const and is_argument:
        return "[MarshalAs(UnmanagedType.LPUTF8Str)] string"
    if kind.base == "void" and kind.stars or kind.base == "char" and kind.stars:
        return "IntPtr"
    return CSHARP.get(kind.base, kind.base) + "*" * kind.stars


def csharp_arguments(header, arguments):
    return ", ".join("%s %s" % (csharp_of(header, kind, True), CSHARP_WORDS.get(name, name)) for name, kind in arguments)


def csharp_summary(comment, indent):
    text = comment.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return [indent + "/// <summary>" + text + "</summary>"] if text else []


def write_csharp(header):
    lines = ["// SPDX-License-Identifier: Apache-2.0", "// " + NOTE,
             "// For .NET and Unity (allow unsafe code). It has been generated and read, and never been run: untested.",
             "// Strings that come back are UTF-8 that the library owns: Marshal.PtrToStringUTF8.",
             "using System;", "using System.Runtime.InteropServices;", "", "namespace Incise", "{",
             "    public static unsafe class Native", "    {", '        private const string Library = "incise";', ""]
    for name, value in header.constants:
        kind = "ulong" if value > 0xFFFFFFFF else "uint" if value > 0x7FFFFFFF else "int"
        lines.append("        public const %s %s = %s;" % (kind, name, value))
    for name, returns, arguments in header.callbacks:
        plain = ", ".join("%s %s" % (csharp_of(header, kind), argument) for argument, kind in arguments)
        lines += ["", "        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]",
                  "        public delegate %s %s(%s);" % (csharp_of(header, returns), name, plain)]
    for name, members, comment in header.structs:
        lines += [""] + csharp_summary(comment, "        ")
        lines += ["        [StructLayout(LayoutKind.Sequential)]", "        public struct %s" % name, "        {"]
        for member, kind in members:
            member = CSHARP_WORDS.get(member, member)
            text = csharp_of(header, kind)
            lines.append("            public fixed %s %s[%d];" % (text, member, kind.length) if kind.length
                         else "            public %s %s;" % (text, member))
        lines.append("        }")
    for name, returns, arguments, comment in header.functions:
        lines += [""] + csharp_summary(comment, "        ")
        lines += ["        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]",
                  "        public static extern %s %s(%s);" % (csharp_of(header, returns), name,
                                                              csharp_arguments(header, arguments))]
    return "\n".join(lines + ["    }", "}"]) + "\n"


# ---- a table for programs that load the library themselves ----

def c_of(kind):
    return ("const " if kind.is_const else "") + kind.base + "*" * kind.stars


def write_table(header):
    lines = ["/* SPDX-License-Identifier: Apache-2.0", " * " + NOTE, " *",
             " * For Unreal, and whoever loads the library by name: the calls as a table of pointers. In a module of Unreal,",
             " *   void* library = FPlatformProcess::GetDllHandle(TEXT(\"libincise.so.0\"));",
             " * and `find` calls FPlatformProcess::GetDllExport. Tested with dlopen; never run in Unreal. */",
             "/* clang-format off */",
             "#ifndef INCISE_TABLE_H", "#define INCISE_TABLE_H", "", "#include <stddef.h>", "#include <string.h>", "",
             '#include "incise/c/incise.h"', "",
             "#ifdef __cplusplus", 'extern "C" {', "#endif", "", "typedef struct incise_table {"]
    for name, returns, arguments, _ in header.functions:
        text = ", ".join("%s %s" % (c_of(kind), argument) for argument, kind in arguments) or "void"
        lines.append("  %s (*%s)(%s);" % (c_of(returns), name.removeprefix("incise_"), text))
    lines += ["} incise_table;", "", "/* Finds a symbol of a library: null where there is none. */",
              "typedef void* (*incise_find)(void* library, const char* name);", "",
              "/* Fills the table. Returns null, or the name of the first call that the library does not have. */",
              "static inline const char* incise_table_load(incise_table* table, incise_find find, void* library) {",
              "  static const char* const names[] = {"]
    lines += ['    "%s",' % name for name, _, _, _ in header.functions]
    lines += ["  };",
              "  const size_t count = sizeof names / sizeof *names;",
              "  size_t i;",
              "  /* The table is one pointer after the other, in the order of the names. */",
              "  (void)sizeof(char[sizeof(incise_table) == sizeof names / sizeof *names * sizeof(void*) ? 1 : -1]);",
              "  for (i = 0; i < count; ++i) {",
              "    void* const symbol = find(library, names[i]);",
              "    if (!symbol) return names[i];",
              "    memcpy((char*)table + i * sizeof symbol, &symbol, sizeof symbol);",
              "  }",
              "  return 0;", "}", "", "#ifdef __cplusplus", "}", "#endif", "", "#endif"]
    return "\n".join(lines) + "\n"


def write_symbols(header):
    return "\n".join(sorted(name for name, _, _, _ in header.functions)) + "\n"


def write_layout(header):
    lines = ["/* SPDX-License-Identifier: Apache-2.0", " * " + NOTE + " */"]
    for name, members, _ in header.structs:
        lines.append('{"%s", sizeof(%s)},' % (name, name))
        lines += ['{"%s.%s", offsetof(%s, %s)},' % (name, member, name, member) for member, _ in members]
    return "\n".join(lines) + "\n"


OUTPUTS = {
    "bindings/python/incise/_c.py": write_python,
    "bindings/rust/src/sys.rs": write_rust,
    "bindings/csharp/Incise.cs": write_csharp,
    "bindings/unreal/incise_table.h": write_table,
    "tests/c/symbols.txt": write_symbols,
    "tests/c/layout.inc": write_layout,
}


def main(arguments):
    if arguments not in ([], ["--check"]):
        return __doc__
    with open(os.path.join(ROOT, HEADER), encoding="utf-8") as file:
        header = Header(file.read())
    stale = []
    for path, write in OUTPUTS.items():
        text, full = write(header), os.path.join(ROOT, path)
        if arguments:
            if not os.path.exists(full) or open(full, encoding="utf-8").read() != text:
                stale.append(path)
            continue
        with open(full, "w", encoding="utf-8") as file:
            file.write(text)
    for path in stale:
        print("%s is not what %s says; run bindings/generate.py" % (path, HEADER))
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
