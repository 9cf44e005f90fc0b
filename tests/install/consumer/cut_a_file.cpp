// SPDX-License-Identifier: Apache-2.0
// Reads a mesh from a file, cuts it along a path of its own while a solver of its own follows, and writes the result
// with piece and stroke: with installed headers alone. usage: cut_a_file FOLDER
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

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

/// A solver of its own: heat that spreads along edges. It knows the mesh by the journal alone.
class Heat final : private incise::JournalVisitor {
 public:
  /// As hot as a vertex stands high.
  explicit Heat(const incise::TetMesh& mesh) {
    grow(mesh.vertex_slots(), mesh.tet_slots());
    mesh.for_each_vertex([&](incise::VertexId v) { heat_[v.value] = mesh.rest(v).z(); });
    mesh.for_each_tet([&](incise::TetId t) { tets_[t.value] = mesh.vertices(t); });
  }
  void follow(const incise::Journal& journal) {
    for (; position_ < journal.position(); ++position_) {
      const incise::Step& step = journal.step(position_);
      for (const incise::VertexId v : step.new_vertices) grow(v.value + 1, 0);
      for (const incise::TetId t : step.new_tets) grow(0, t.value + 1);
      visit(step, *this);
    }
  }
  void spread() {
    for (const incise::TetVertices& tet : tets_) {
      if (!tet[0].is_valid()) continue;
      double mean = 0;
      for (const incise::VertexId v : tet) mean += 0.25 * heat_[v.value];
      for (const incise::VertexId v : tet) heat_[v.value] += 0.1 * (mean - heat_[v.value]);
    }
  }
  /// Whether it has the mesh's tets, and heat between the coldest and the hottest at first.
  [[nodiscard]] bool fits(const incise::TetMesh& mesh) const {
    bool fits = mesh.tet_slots() == tets_.size();
    mesh.for_each_tet([&](incise::TetId t) { fits = fits && tets_[t.value] == mesh.vertices(t); });
    mesh.for_each_vertex([&](incise::VertexId v) { fits = fits && heat_[v.value] > -0.1 && heat_[v.value] < 1.1; });
    return fits;
  }

 private:
  void born(const incise::BornVertex& born) override {
    double heat = 0;
    for (unsigned i = 0; i < 4; ++i) {
      if (born.parents[i].is_valid()) heat += born.weights[i] * heat_[born.parents[i].value];
    }
    heat_[born.id.value] = heat;
  }
  void moved(const incise::MovedVertex& moved) override {
    double heat = 0;
    for (unsigned i = 0; i < 4; ++i) heat += moved.weights[i] * heat_[moved.basis[i].value];
    heat_[moved.id.value] = heat;
  }
  void copied(const incise::CopiedVertex& copied) override { heat_[copied.id.value] = heat_[copied.source.value]; }
  void replaced(std::span<const incise::ConsumedTet> consumed, std::span<const incise::ProducedTet> produced) override {
    for (const incise::ConsumedTet& tet : consumed) tets_[tet.id.value] = {};
    for (const incise::ProducedTet& tet : produced) tets_[tet.id.value] = tet.vertices;
  }
  void rewired(const incise::RewiredTet& tet) override { tets_[tet.id.value] = tet.vertices; }

  void grow(std::uint32_t vertices, std::uint32_t tets) {
    heat_.resize(std::max<std::size_t>(heat_.size(), vertices));
    tets_.resize(std::max<std::size_t>(tets_.size(), tets));
  }

  std::vector<double> heat_;
  std::vector<incise::TetVertices> tets_;  // the first vertex is invalid where the slot is free
  std::size_t position_ = 0;
};

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
  Heat heat(engine->mesh());
  if (const auto report = engine->cut(path()); !report.ok()) return fail("cutting", report.error());
  heat.follow(engine->journal());
  heat.spread();
  if (!heat.fits(engine->mesh())) {
    std::fprintf(stderr, "the solver has lost the mesh\n");
    return 1;
  }
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
