#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether script/layering finds each kind of wrong include and of misplaced source, and nothing in a sound tree.

usage: layering_test.py ROOT
"""
import os
import shutil
import sys
import tempfile
import unittest

import trees

ROOT = sys.argv.pop()
trees.import_checks(ROOT)
import layering  # noqa: E402

# A small tree that is sound: a few modules, rooms and a front end.
SOUND = {
    "include/incise/incise.h": '#include "incise/core/result.h"\n#include "incise/version.h"\n',
    "include/incise/core/result.h": "#include <string>\n",
    "include/incise/mesh/tet_mesh.h": '#include <Eigen/Core>\n#include <vector>\n#include "incise/core/result.h"\n',
    "include/incise/c/incise.h": "#include <stdint.h>\n",
    "src/core/parallel.cpp": "#include <tbb/parallel_for.h>\n",
    "src/geom/closest.cpp": '#include <sys/stat.h>\n#include "incise/core/result.h"\n',
    "src/cut/cutter.h": '#include "incise/mesh/tet_mesh.h"\n',
    "src/paper/paper_cut.cpp": '#include "cut/cutter.h"\n',
    "src/engine/engine.cpp": '#include "cut/cutter.h"\n',
    "src/sim/body/tissue.cpp": '#include "incise/mesh/tet_mesh.h"\n',
    "src/sim/haptic/tool.cpp": '#include "sim/body/tissue.h"\n',
    "src/app/text/json_write.h": "#include <fmt/core.h>\n",
    "src/app/text/json_write.cpp": '#include "app/text/json_write.h"\n#include "incise/version.h"\n',
    "src/app/jobs/report.cpp": '#include "app/text/json_write.h"\n',
    "src/app/viewer/viewer.h": '#include "app/jobs/report.h"\n',
    "src/render/window.cpp": '#include <epoxy/gl.h>\n#include "app/viewer/viewer.h"\n',
    "apps/cli/main.cpp": '#include "incise/incise.h"\n#include "app/viewer/viewer.h"\n',
}


class Layering(unittest.TestCase):
    def setUp(self):
        self.root = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.root)
        trees.write(self.root, SOUND)

    def write(self, path, text):
        trees.write(self.root, {path: text})

    def said(self):
        status, text = trees.outcome(layering, self.root)
        self.assertEqual(status, 0 if ", 0 wrong" in text else 1)
        return text

    def expect_refused(self, path, include, reason):
        """An #include that is put before a sound file is found, and is the only thing that is."""
        self.write(path, "#include %s\n%s" % (include, SOUND[path]))
        self.assertIn("%s:1: %s" % (path, reason), self.said())
        self.assertIn(", 1 wrong includes", self.said())

    def test_a_sound_tree_passes(self):
        self.assertIn("%d files, 0 wrong includes" % len(SOUND), self.said())

    def test_no_module_includes_all_of_incise(self):
        for path in ("src/core/parallel.cpp", "include/incise/core/result.h"):
            with self.subTest(path):
                self.expect_refused(path, '"incise/incise.h"', "incise/incise.h belongs to no module")
                self.write(path, SOUND[path])

    def test_paths_that_go_up_are_refused_in_modules(self):
        self.expect_refused("src/geom/closest.cpp", '"../cut/cutter.h"', "../cut/cutter.h: name headers from")

    def test_paths_that_go_up_are_refused_within_a_module(self):
        self.expect_refused("src/app/text/json_write.cpp", '"../viewer/viewer.h"', "../viewer/viewer.h: name headers from")

    def test_a_lower_room_includes_no_higher_one(self):
        self.expect_refused("src/app/text/json_write.cpp", '"app/viewer/viewer.h"', "app/text must not include app/viewer")

    def test_parts_are_for_who_calls_them(self):
        self.expect_refused("src/app/jobs/report.cpp", '"cut/cutter.h"', "cut/cutter.h is private to module cut")

    def test_siblings_do_not_include_each_other(self):
        self.expect_refused("src/cut/cutter.h", '"incise/sim/body.h"', "module cut must not include sim")

    def test_installed_headers_include_no_third_party(self):
        for header in ("<boost/any.hpp>", "<hdf5.h>", "<iostream>"):
            with self.subTest(header):
                self.expect_refused("include/incise/mesh/tet_mesh.h", header, "<%s>" % header[1:-1])

    def test_unknown_third_parties_are_refused_in_sources(self):
        self.expect_refused("src/geom/closest.cpp", "<vtk/thing.h>", "<vtk/thing.h> is of no third party")

    def test_headers_beside_the_modules_are_seen(self):
        self.write("include/other.h", "")
        self.write("include/incise/other.h", "")
        self.assertIn("include/other.h: lies in no module", self.said())
        self.assertIn("include/incise/other.h: lies in no module", self.said())

    def test_other_endings_are_seen(self):
        self.write("src/geom/sneaky.hh", '#include "cut/cutter.h"\n')
        self.assertIn("src/geom/sneaky.hh: sources end in .h or .cpp", self.said())
        self.assertIn("src/geom/sneaky.hh:1: module geom must not include cut", self.said())

    def test_an_unknown_room_is_told(self):
        self.write("src/sim/loose/free.cpp", '#include "sim/body/tissue.h"\n')
        self.assertIn("src/sim/loose/free.cpp: lies in no room of sim: body, haptic, reference", self.said())

    def test_an_unknown_module_is_told(self):
        self.write("src/new/thing.cpp", "")
        self.assertIn("src/new/thing.cpp: there is no module 'new'", self.said())

    def test_front_ends_include_what_is_public(self):
        self.expect_refused("apps/cli/main.cpp", '"cut/cutter.h"', "front ends use public headers only")
        self.write("apps/cli/main.cpp", SOUND["apps/cli/main.cpp"])
        self.write("src/cut/../cut/options.h", "")
        self.expect_refused("apps/cli/main.cpp", '"../../src/cut/options.h"', "front ends use public headers only")


if __name__ == "__main__":
    unittest.main()
