// SPDX-License-Identifier: Apache-2.0
// Tet meshes of triangle surfaces, by whatever program: quality, and how far they lie from the surface that they were
// made of.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "incise/geom/triangle_tree.h"
#include "incise/io/mesh_file.h"
#include "incise/io/surface_file.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/defects.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/tet_mesh.h"

namespace {

using namespace incise;
using Triangle = TriangleTree::Triangle;

struct Skin {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};

Skin skin_of(const TetMesh& mesh) {
  Skin skin;
  skin.points.resize(mesh.vertex_slots(), Vec3::Zero());
  mesh.for_each_vertex([&](VertexId v) { skin.points[v.value] = mesh.rest(v); });
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (!mesh.links(tet)[s].is_boundary()) continue;
      const std::array<VertexId, 3> v = mesh.vertices(Side(tet, s));
      skin.triangles.push_back({v[0].value, v[1].value, v[2].value});
    }
  });
  return skin;
}

/// Mean, 99th percentile and greatest of some distances.
struct Spread {
  double mean = 0, p99 = 0, most = 0;
};

/// How far the centres and corners of triangles lie from another surface, in `unit`s; each by the triangle's area.
Spread distance(const Skin& from, const TriangleTree& to, double unit) {
  std::vector<std::pair<double, double>> found;  // distance, weight
  double sum = 0, all = 0;
  for (const auto& [i, j, k] : from.triangles) {
    const Vec3 &a = from.points[i], &b = from.points[j], &c = from.points[k];
    const double weight = (b - a).cross(c - a).norm();
    for (const Vec3& p : {Vec3((a + b + c) / 3), a, b, c}) {
      const double d = std::sqrt(to.closest(p).distance2) / unit;
      found.emplace_back(d, weight);
      sum += d * weight;
      all += weight;
    }
  }
  std::sort(found.begin(), found.end());
  Spread spread;
  if (found.empty() || !(all > 0)) return spread;
  spread.mean = sum / all;
  spread.most = found.back().first;
  double seen = 0;
  for (const auto& [d, weight] : found) {
    spread.p99 = d;
    seen += weight;
    if (seen >= 0.99 * all) break;
  }
  return spread;
}

/// Whether triangles hang together through shared points.
bool is_one_part(const io::SurfaceSoup& surface) {
  std::vector<std::uint32_t> root(surface.points.size());
  std::iota(root.begin(), root.end(), 0U);
  const auto find = [&](std::uint32_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const auto& [i, j, k] : surface.triangles) root[find(i)] = root[find(j)] = find(k);
  return std::all_of(surface.triangles.begin(), surface.triangles.end(),
                     [&](const auto& t) { return find(t[0]) == find(surface.triangles.front()[0]); });
}

/// What a surface encloses, by the divergence theorem; 0 where that is not known: of several parts, which may overlap,
/// and where an edge has other triangles than one on either side that face alike.
double enclosed(const io::SurfaceSoup& surface) {
  if (surface.triangles.empty() || !is_one_part(surface)) return 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<int, 2>> edges;  // how often each way
  double six = 0;
  for (const auto& [i, j, k] : surface.triangles) {
    six += surface.points[i].dot(surface.points[j].cross(surface.points[k]));
    for (const auto& [a, b] : {std::pair(i, j), std::pair(j, k), std::pair(k, i)}) ++edges[std::minmax(a, b)][a < b];
  }
  const bool is_closed = std::all_of(edges.begin(), edges.end(), [](const auto& edge) {
    return edge.second == std::array{1, 1};
  });
  return is_closed ? std::abs(six) / 6 : 0;
}

struct Job {
  std::string surface, mesh, made_by, folder;
  double size = 1, cpu_s = 0;
};

constexpr const char* kHead =
    "surface,made_by,size,tets,cpu_s,dihedral_min,dihedral_max,lr_max,lr_mean,mesh_to_surface_mean,mesh_to_surface_p99,"
    "mesh_to_surface_max,surface_to_mesh_mean,surface_to_mesh_p99,surface_to_mesh_max,volume_error_pct,nonmanifold\n";

void print(const Job& job, const TetMesh& mesh, const io::SurfaceSoup& surface, std::uint64_t nonmanifold) {
  const Skin skin = skin_of(mesh), given = {surface.points, {surface.triangles.begin(), surface.triangles.end()}};
  const Spread out = distance(skin, TriangleTree(given.points, given.triangles), job.size);
  const Spread back = distance(given, TriangleTree(skin.points, skin.triangles), job.size);
  const QualityStats q = measure_quality(mesh);
  double volume = 0;
  mesh.for_each_tet([&](TetId tet) { volume += mesh.rest_volume(tet); });
  const double truth = enclosed(surface);
  const std::string name = job.surface.substr(job.surface.find_last_of('/') + 1);
  const std::string error = truth > 0 ? fmt::format("{:+.2f}", 100 * (volume / truth - 1)) : "-";
  fmt::print(
      "{:<28} {:<7} {:>8.3g} {:>7} {:>6.1f} | {:>5.1f} {:>6.1f} {:>7.1f} {:>5.2f} | {:.3f} {:.2f} {:.2f} | "
      "{:.3f} {:.2f} {:.2f} | {:>6} | {}\n",
      name, job.made_by, job.size, q.tets, job.cpu_s, q.dihedral_min_deg, q.dihedral_max_deg, q.lr_max, q.lr_mean,
      out.mean, out.p99, out.most, back.mean, back.p99, back.most, error, nonmanifold);
  if (job.folder.empty()) return;
  std::FILE* csv = std::fopen((job.folder + "/surfaces.csv").c_str(), "a");
  if (csv == nullptr) return;
  if (std::fseek(csv, 0, SEEK_END) == 0 && std::ftell(csv) == 0) fmt::print(csv, "{}", kHead);
  fmt::print(csv, "{},{},{},{},{:.2f},{:.2f},{:.2f},{:.2f},{:.3f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{},{}\n",
             name, job.made_by, job.size, q.tets, job.cpu_s, q.dihedral_min_deg, q.dihedral_max_deg, q.lr_max,
             q.lr_mean, out.mean, out.p99, out.most, back.mean, back.p99, back.most, error, nonmanifold);
  std::fclose(csv);
}

int run(const Job& job) {
  Result<io::SurfaceSoup> surface = io::read_surface(job.surface);
  if (!surface) {
    fmt::print(stderr, "{}\n", surface.error().message);
    return 1;
  }
  io::weld(*surface);
  if (!(job.size > 0)) {  // a thirtieth of the diagonal of the box
    Box box;
    for (const Vec3& p : surface->points) box.extend(p);
    fmt::print("{:.6g}\n", (box.hi - box.lo).norm() / 30);
    return 0;
  }
  Result<io::MeshFile> read = io::read_mesh(job.mesh);
  if (!read) {
    fmt::print("{:<28} {:<7} made no mesh: {}\n", job.surface.substr(job.surface.find_last_of('/') + 1), job.made_by,
               read.error().message);
    return 1;
  }
  normalise(read->data.soup);
  const Defects defects = find_defects(read->data.soup);
  Result<TetMesh> mesh = TetMesh::build(std::move(read->data.soup));
  if (!mesh) {
    fmt::print(stderr, "{}\n", mesh.error().message);
    return 1;
  }
  print(job, *mesh, *surface, defects.nonmanifold_edges + defects.singleton_vertices);
  return 0;
}

constexpr const char* kUsage =
    "usage: bench_surfaces SURFACE                                          prints a size that suits it\n"
    "       bench_surfaces SURFACE MESH NAME SIZE CPU_SECONDS [FOLDER]      a row, also in FOLDER/surfaces.csv\n";

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && argv[1][0] != '-') return run({argv[1], "", "", "", 0, 0});
  if (argc < 6 || argc > 7) {
    std::fputs(kUsage, argc == 2 && std::strcmp(argv[1], "--help") == 0 ? stdout : stderr);
    return argc == 2 && std::strcmp(argv[1], "--help") == 0 ? 0 : 2;
  }
  return run({argv[1], argv[2], argv[3], argc > 6 ? argv[6] : "", std::atof(argv[4]), std::atof(argv[5])});
}
