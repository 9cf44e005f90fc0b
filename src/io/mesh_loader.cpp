// SPDX-License-Identifier: Apache-2.0
// From a file's arrays to a mesh: mid-edge nodes out, orientation and duplicates mended, cuts of earlier sessions
// taken in; whatever changed becomes a note.
#include "incise/io/mesh_loader.h"

#include <algorithm>
#include <utility>

namespace incise {
inline namespace v0 {
namespace io {
namespace {

std::string counted(std::uint64_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

// The new number of each point, kInvalidIndex for those that go.
std::vector<std::uint32_t> renumber(std::size_t n_points, const std::vector<std::uint32_t>& gone) {
  std::vector<std::uint32_t> number(n_points, 0);
  for (const std::uint32_t point : gone) number[point] = kInvalidIndex;
  std::uint32_t next = 0;
  for (std::uint32_t& n : number) {
    if (n != kInvalidIndex) n = next++;
  }
  return number;
}

template <class T>
void keep_points(std::vector<T>& values, const std::vector<std::uint32_t>& number) {
  if (values.size() != number.size()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] != kInvalidIndex) values[kept++] = values[i];
  }
  values.resize(kept);
}

// Renumbers the triangles' corners; triangles that lose one go, with their labels.
void keep_triangles(MeshData& data, const std::vector<std::uint32_t>& number) {
  const bool has_labels = data.triangle_stroke.size() == data.triangles.size();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < data.triangles.size(); ++i) {
    auto triangle = data.triangles[i];
    for (std::uint32_t& v : triangle) v = number[v];
    if (std::find(triangle.begin(), triangle.end(), kInvalidIndex) != triangle.end()) continue;
    data.triangles[kept] = triangle;
    if (has_labels) data.triangle_stroke[kept] = data.triangle_stroke[i];
    ++kept;
  }
  data.triangles.resize(kept);
  if (has_labels) data.triangle_stroke.resize(kept);
}

// What the file knows of earlier cuts. Strokes of 0 and below are skin.
void take_cuts(const MeshData& data, TetSoup& soup) {
  soup.origins = data.origin_vertex;
  if (data.has_foreign_labels) return;
  for (std::size_t i = 0; i < data.triangle_stroke.size(); ++i) {
    if (data.triangle_stroke[i] <= 0) continue;
    soup.walls.push_back({data.triangles[i], static_cast<std::uint32_t>(data.triangle_stroke[i])});
  }
  if (soup.walls.empty()) return;
  for (const std::int32_t front : data.cut_front) soup.fronts.push_back(front != 0 ? 1 : 0);
}

std::size_t count_walls(const TetMesh& mesh) {
  std::size_t count = 0;
  mesh.for_each_tet([&](TetId tet) {
    for (const Link link : mesh.links(tet)) count += link.is_boundary() && link.tag() > 0 ? 1U : 0U;
  });
  return count;
}

// Walls that the mesh has no side for.
void note_lost_walls(const TetMesh& mesh, std::size_t in_file, std::vector<std::string>& notes) {
  const std::size_t lost = in_file - std::min(in_file, in_file == 0 ? 0 : count_walls(mesh));
  if (lost == 0) return;
  notes.push_back(counted(lost, "triangle with a stroke is", "triangles with a stroke are") +
                  " no boundary face of the tets, or there twice, and left out");
}

void note_changes(const Normalised& changes, std::vector<std::string>& notes) {
  if (changes.flipped > 0) {
    notes.push_back(counted(changes.flipped, "tet of negative volume was", "tets of negative volume were") +
                    " turned to positive");
  }
  if (changes.dropped > 0) {
    notes.push_back(counted(changes.dropped, "exact duplicate of a tet was", "exact duplicates of tets were") +
                    " dropped");
  }
  if (changes.zero_volume > 0) {
    notes.push_back(counted(changes.zero_volume, "tet has", "tets have") + " no volume");
  }
}

}  // namespace

std::vector<std::uint32_t> drop_mid_nodes(MeshFile& file) {
  std::vector<std::uint32_t> kept;
  if (file.mid_nodes.empty()) return kept;
  MeshData& data = file.data;
  const std::vector<std::uint32_t> number = renumber(data.soup.points.size(), file.mid_nodes);
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    if (number[i] != kInvalidIndex) kept.push_back(i);
  }
  keep_points(data.soup.points, number);
  keep_points(data.origin_vertex, number);
  keep_points(data.cut_front, number);
  for (auto& tet : data.soup.tets) {
    for (std::uint32_t& v : tet) v = number[v];
  }
  keep_triangles(data, number);
  file.notes.push_back(counted(file.mid_nodes.size(), "mid-edge node was", "mid-edge nodes were") + " left out");
  file.mid_nodes.clear();
  return kept;
}

Defects find_file_defects(const MeshFile& file) {
  Defects defects = find_defects(file.data.soup);
  if (file.mid_nodes.empty()) return defects;
  defects.unreferenced_vertices -= std::min<std::uint64_t>(defects.unreferenced_vertices, file.mid_nodes.size());
  auto& examples = defects.examples[static_cast<std::size_t>(DefectKind::kUnreferencedVertices)];
  examples.erase(std::remove_if(examples.begin(), examples.end(),
                                [&](std::uint32_t v) {
                                  return std::binary_search(file.mid_nodes.begin(), file.mid_nodes.end(), v);
                                }),
                 examples.end());
  return defects;
}

MeshSource describe(const MeshFile& file, const std::filesystem::path& path) {
  MeshSource source;
  source.file = path.string();
  source.format = file.format_name + (file.gzipped ? ", gzipped" : "");
  source.vertices = file.file_vertices;
  source.tets = file.file_tets;
  source.ten_node = file.ten_node;
  source.notes = file.notes;
  return source;
}

Result<LoadedMesh> build_mesh(MeshFile file, const std::filesystem::path& path) {
  LoadedMesh loaded;
  loaded.file_vertex = drop_mid_nodes(file);
  loaded.source = describe(file, path);
  loaded.region_names = std::move(file.data.region_names);
  TetSoup soup = std::move(file.data.soup);
  take_cuts(file.data, soup);
  if (!soup.origins.empty()) loaded.file_vertex.clear();  // the mesh's own origins are what the file says
  file.data = {};
  const std::size_t walls = soup.walls.size();
  note_changes(normalise(soup), loaded.source.notes);
  Result<TetMesh> mesh = TetMesh::build(std::move(soup));
  if (!mesh.ok()) {
    Error error = mesh.error();
    error.message = path.string() + ": " + error.message;
    return error;
  }
  loaded.mesh = std::move(mesh).value();
  note_lost_walls(loaded.mesh, walls, loaded.source.notes);
  return loaded;
}

Result<LoadedMesh> load_mesh(const std::filesystem::path& path, const std::vector<MeshFormat>& own) {
  Result<MeshFile> file = read_mesh(path, {}, own);
  if (!file.ok()) return file.error();
  return build_mesh(std::move(file).value(), path);
}

}  // namespace io
}  // namespace v0
}  // namespace incise
