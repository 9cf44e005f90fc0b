// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "cli/program.h"
#include "incise/io/surface_file.h"

namespace fine_test {
namespace {

using namespace incise_test;

/// The surface of the unit cube, each face of 2 n² triangles by itself.
std::string cube_surface(unsigned n) {
  std::ostringstream out;
  std::ostringstream faces;
  unsigned first = 1;
  for (unsigned axis = 0; axis < 3; ++axis) {
    for (const unsigned side : {0U, 1U}) {
      for (unsigned i = 0; i <= n; ++i) {
        for (unsigned j = 0; j <= n; ++j) {
          double p[3] = {};
          p[axis] = side;
          p[(axis + 1) % 3] = static_cast<double>(i) / n;
          p[(axis + 2) % 3] = static_cast<double>(j) / n;
          out << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
        }
      }
      for (unsigned i = 0; i < n; ++i) {
        for (unsigned j = 0; j < n; ++j) {
          const unsigned a = first + i * (n + 1) + j, b = a + n + 1, c = b + 1, d = a + 1;
          if (side == 1) faces << "f " << a << ' ' << b << ' ' << c << ' ' << d << '\n';
          if (side == 0) faces << "f " << a << ' ' << d << ' ' << c << ' ' << b << '\n';
        }
      }
      first += (n + 1) * (n + 1);
    }
  }
  return out.str() + faces.str();
}

class CliFine : public testing::Test {
 protected:
  Folder folder_;
  std::string cube_ = folder_.write("cube.mesh", cube_mesh(4, 0.1));
  std::string fine_ = folder_.write("fine.obj", cube_surface(16));
};

TEST_F(CliFine, a_cut_writes_the_surface_as_it_is_drawn) {
  const Outcome made = run({"cut", cube_, "--plane", "1,0,0,0.53", "--surface", fine_, "--drawn", folder_ / "cut.obj"});
  ASSERT_EQ(made.code, 0) << made.err;
  const auto drawn = incise::io::read_surface(folder_ / "cut.obj");
  ASSERT_TRUE(drawn.ok()) << drawn.error().message;
  EXPECT_GT(drawn->triangles.size(), 12U * 16 * 16);
  EXPECT_FALSE(drawn->texture.empty());
  EXPECT_EQ(run({"cut", cube_, "--plane", "1,0,0,0.53", "--surface", fine_, "--drawn", folder_ / "cut.glb"}).code, 0);
  EXPECT_EQ(read(folder_ / "cut.glb").substr(0, 4), "glTF");
}

TEST_F(CliFine, a_scene_writes_it_over_time_and_the_same_each_time) {
  const std::string scene = folder_.write(
      "scene.json",
      R"({"format":"incise-scene","version":1,"model":{"box":{"cells":[4,4,4]},"surface":"fine.obj"},"length_unit":0.1,
          "frames":8,"strokes":[{"blade":[{"edges":[{"t":0.0,"points":[[0.53,-0.5,1.2],[0.53,1.5,1.2]]},
          {"t":0.1,"points":[[0.53,-0.5,0.4],[0.53,1.5,0.4]]}]}]}]})");
  const Outcome made = run({"simulate", scene, "--drawn", folder_ / "a.glb"});
  ASSERT_EQ(made.code, 0) << made.err;
  ASSERT_EQ(run({"simulate", scene, "--drawn", folder_ / "b.glb"}).code, 0);
  const std::string bytes = read(folder_ / "a.glb");
  EXPECT_NE(bytes.find("\"targets\""), std::string::npos);
  EXPECT_EQ(bytes, read(folder_ / "b.glb"));
}

TEST_F(CliFine, what_does_not_fit_together_is_said) {
  const auto error = [&](const std::vector<std::string>& more, int code) {
    std::vector<std::string> all = {"cut", cube_, "--plane", "1,0,0,0.53"};
    all.insert(all.end(), more.begin(), more.end());
    const Outcome made = run(all);
    EXPECT_EQ(made.code, code) << made.err;
    return made.err;
  };
  EXPECT_NE(error({"--drawn", folder_ / "x.glb"}, 2).find("--surface"), std::string::npos);
  EXPECT_NE(error({"--surface", fine_, "--drawn", folder_ / "x.fbx"}, 2).find(".glb"), std::string::npos);
  EXPECT_NE(error({"--surface", folder_ / "none.obj", "--drawn", folder_ / "x.glb"}, 3).find("none.obj"),
            std::string::npos);
  const std::string far = folder_.write("far.obj", "v 90 0 0\nv 91 0 0\nv 90 1 0\nf 1 2 3\n");
  EXPECT_NE(error({"--surface", far, "--drawn", folder_ / "x.glb"}, 3).find("outside the mesh"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "x.glb"));
}

}  // namespace

}  // namespace fine_test
