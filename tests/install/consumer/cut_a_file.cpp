// SPDX-License-Identifier: Apache-2.0
// Reads a mesh from a file, cuts it along a path of its own, and writes the result with piece and stroke: with
// installed headers alone. usage: cut_a_file FOLDER
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string>
#include <utility>

#include "incise/incise.h"

namespace {

namespace fs = std::filesystem;

int fail(const char* what, const incise::Error& error) {
  std::fprintf(stderr, "%s: %s\n", what, error.message.c_str());
  return 1;
}

/// A cube with a tet turned over, as files in the wild have them.
incise::io::MeshData wild_mesh() {
  incise::io::MeshData data;
  data.soup = incise::kuhn_cube(3);
  std::swap(data.soup.tets[0][0], data.soup.tets[0][1]);
  return data;
}

/// A blade that goes down through the middle of the cube in three steps, slightly tilted.
incise::Stroke path() {
  incise::Stroke stroke;
  stroke.name = "down";
  for (int step = 0; step <= 3; ++step) {
    const double z = 1.2 - 0.5 * step, x = 0.45 + 0.03 * step;
    stroke.times.push_back(0.1 * step);
    stroke.edges.push_back({incise::Vec3(x, -0.2, z), incise::Vec3(x, 1.2, z)});
  }
  return stroke;
}

/// Whether the file holds two pieces and walls of stroke 1.
int check(const fs::path& file) {
  const auto again = incise::io::read_mesh(file);
  if (!again.ok()) return fail("reading the result", again.error());
  const incise::io::MeshData& data = again->data;
  const std::set<std::int32_t> pieces(data.piece.begin(), data.piece.end());
  const std::set<std::int32_t> strokes(data.triangle_stroke.begin(), data.triangle_stroke.end());
  std::printf("%s: %zu tets, %zu pieces, %zu wall triangles\n", file.filename().string().c_str(), data.soup.tets.size(),
              pieces.size(), data.triangles.size());
  return pieces.size() == 2 && strokes == std::set<std::int32_t>{1} ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  const fs::path folder = count > 1 ? arguments[1] : ".";
  if (const auto status = incise::io::write_mesh(folder / "wild.msh", wild_mesh()); !status.ok()) {
    return fail("writing the input", status.error());
  }
  auto loaded = incise::io::load_mesh(folder / "wild.msh");
  if (!loaded.ok()) return fail("reading the input", loaded.error());
  for (const std::string& note : loaded->source.notes) std::printf("note: %s\n", note.c_str());
  auto engine = incise::Engine::create(std::move(loaded->mesh));
  if (!engine.ok()) return fail("starting the engine", engine.error());
  if (const auto report = engine->cut(path()); !report.ok()) return fail("cutting", report.error());
  const incise::Components pieces = incise::find_components(engine->mesh());
  const auto result = incise::io::to_mesh_data(engine->mesh(), pieces, loaded->file_vertex);
  for (const char* name : {"cut.vtk", "cut.msh"}) {
    if (const auto status = incise::io::write_mesh(folder / name, result); !status.ok()) {
      return fail("writing the result", status.error());
    }
    if (check(folder / name) != 0) return 1;
  }
  return 0;
}
