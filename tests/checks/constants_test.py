# SPDX-License-Identifier: Apache-2.0
"""What script/lib/constants.py finds in trees made for it. usage: constants_test.py ROOT"""
import sys

import trees
from trees import expect, outcome_of

trees.import_checks(sys.argv[1])
import constants  # noqa: E402

TABLE = "## 7 Constants\n\n| value | unit | what | where |\n|---|---|---|---|\n%s\n\n## 8 More\n"


def main():
    def passes(files):
        code, said = outcome_of(constants, files)
        return code == 0 and not said

    for text in ("constexpr double kNear = 0.1;\n", "inline constexpr float kNear = 0.1F;\n",
                 "struct A {\n  static constexpr double kNear{1e-3};\n};\n", "constexpr double kNear = 1.0 / 32;\n",
                 "void f() {\n  constexpr double kNear = 0x1p-20;  // far above rounding\n}\n",
                 "constexpr double kHalf = kNear / 2, kNear = 0.1;\n", "const double kNear =\n    -2.0;\n"):
        for path in ("src/cut/a.cpp", "src/sim/body/a.h", "src/geom/a.cpp"):
            code, said = outcome_of(constants, {path: text})
            expect(code == 1 and said.startswith(path + ":"), "a tuned constant is named: " + repr(text))
            expect("kNear is a tuned constant" in said and "constants.h" in said, "the remedy is told: " + said)
            expect("kHalf" not in said, "what follows from others is none: " + said)
        for path in ("src/cut/constants.h", "src/cut/blade_constants.h", "src/app/view/a.cpp", "include/incise/cut/a.h"):
            expect(passes({path: text}), "%s may hold it: %r" % (path, text))
    for text in ("constexpr std::size_t kRoom = 3;\n", "constexpr double kRoot = some(2.0);\n", "double near = 0.1;\n",
                 "// constexpr double kNear = 0.1;\n", "/* constexpr double kNear = 0.1; */\n"):
        expect(passes({"src/cut/a.cpp": text}), "what is not tuned is let pass: " + repr(text))

    splitter = "src/geom/expansion_internal.h"
    expect(passes({splitter: "constexpr double kSplitter = 134217729.0;\n"}), "exceptions are let pass")
    code, said = outcome_of(constants, {splitter: "\n"})
    expect(code == 1 and "kSplitter needs no exception" in said, "exceptions that nothing needs are named: " + said)

    near, far = "inline constexpr double kNear = 0.1;\n", "inline constexpr unsigned kNear = 4;\n"
    code, said = outcome_of(constants, {"src/cut/constants.h": near, "src/improve/constants.h": far})
    expect(code == 1 and "src/improve/constants.h: kNear has that name in src/cut/constants.h" in said, said)

    source = {"src/cut/constants.h": "inline constexpr double kNear = 0.1, kSame = 1e-6;\n"}
    for row in ("| 0.1; 10⁻⁶ | edge | near | `kNear`, `kSame` |", "| 0.1 | edge | near | `Options::near` |",
                "| 12°; 3 | angle; edge | near | `Bounds` |"):
        expect(passes({**source, "docs/internals.md": TABLE % row}), "a row that agrees is let pass: " + row)
    for row, fault in (("| 0.1; 10⁻⁵ | edge | near | `kNear`, `kSame` |", "kSame is 1e-06, not 1e-05"),
                       ("| 0.2 | edge | near | `kNear` |", "docs/internals.md:5: kNear is 0.1, not 0.2"),
                       ("| 0.1 | edge | near | `kGone` |", "no source has kGone")):
        code, said = outcome_of(constants, {**source, "docs/internals.md": TABLE % row})
        expect(code == 1 and fault in said, "a row that does not is named: " + said)


main()
