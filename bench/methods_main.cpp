// SPDX-License-Identifier: Apache-2.0
// The methods that the paper compares itself with, and both profiles, on the same planes: docs/benchmark.md.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "incise/engine/engine.h"
#include "incise/io/mesh_loader.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/shapes.h"
#include "maintenance_cases.h"
#include "methods.h"
#include "report.h"

namespace incise::bench {

namespace {

constexpr std::array<unsigned, 3> kStrokes = {1, 5, 20};
constexpr std::uint64_t kSeed = 7;

struct Body {
  std::string name;
  TetSoup soup;
};

/// What came of all strokes.
struct Outcome {
  TetMesh mesh;
  std::vector<double> wall_distances;  // of points of the walls that the last stroke left, in mean edges of the body
  std::uint64_t cut_tets = 0;          // tets with corners on both sides of a stroke, when it came
  double ms = 0;
};

using Method = std::function<std::optional<Outcome>(const Body&, const std::vector<Plane>&)>;

TetSoup soup_of(const TetMesh& mesh) {
  TetSoup soup;
  for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) {
    soup.points.push_back(mesh.is_live(VertexId(v)) ? mesh.rest(VertexId(v)) : Vec3(Vec3::Zero()));
  }
  mesh.for_each_tet([&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    soup.tets.push_back({v[0].value, v[1].value, v[2].value, v[3].value});
  });
  return soup;
}

double volume_of(const TetMesh& mesh) {
  double sum = 0;
  mesh.for_each_tet([&](TetId tet) { sum += mesh.rest_volume(tet); });
  return sum;
}

std::optional<Outcome> by_soup(const Body& body, const std::vector<Plane>& planes,
                               Cut (*method)(TetSoup, const Plane&)) {
  Outcome out;
  TetSoup soup = body.soup;
  for (const Plane& plane : planes) {
    const double start = thread_ms();
    Cut cut = method(std::move(soup), plane);
    out.ms += thread_ms() - start;
    out.cut_tets += cut.cut_tets;
    out.wall_distances.clear();
    for (const std::uint32_t v : cut.wall_points) {
      out.wall_distances.push_back(std::abs(plane.height(cut.soup.points[v])));
    }
    soup = std::move(cut.soup);
  }
  Result<TetMesh> mesh = TetMesh::build(std::move(soup));
  if (!mesh) {
    std::fprintf(stderr, "%s: %s\n", body.name.c_str(), mesh.error().message.c_str());
    return std::nullopt;
  }
  out.mesh = std::move(*mesh);
  return out;
}

std::uint64_t count_crossed(const TetMesh& mesh, const Plane& plane) {
  std::uint64_t count = 0;
  mesh.for_each_tet([&](TetId tet) {
    bool is_above = false, is_below = false;
    for (const VertexId v : mesh.vertices(tet)) {
      is_above = is_above || plane.height(mesh.rest(v)) > 0;
      is_below = is_below || plane.height(mesh.rest(v)) < 0;
    }
    count += is_above && is_below ? 1U : 0U;
  });
  return count;
}

void measure_walls(const TetMesh& mesh, std::uint32_t stroke, const Plane& plane, Outcome& out) {
  std::vector<bool> is_wall(mesh.vertex_slots(), false);
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(tet)[s];
      if (!link.is_boundary() || link.tag() != stroke) continue;
      for (const VertexId v : mesh.vertices(Side(tet, s))) is_wall[v.value] = true;
    }
  });
  for (std::uint32_t v = 0; v < is_wall.size(); ++v) {
    if (is_wall[v]) out.wall_distances.push_back(std::abs(plane.height(mesh.rest(VertexId(v)))));
  }
}

std::optional<Outcome> by_engine(const Body& body, const std::vector<Plane>& planes, Profile profile, bool maintains) {
  EngineOptions options;
  options.cut.profile = profile;
  if (!maintains) options.cut.snap = 0;
  options.maintain.merge = options.maintain.improve = maintains;
  Result<TetMesh> mesh = TetMesh::build(body.soup);
  Result<Engine> engine = mesh.ok() ? Engine::create(std::move(*mesh), options) : Result<Engine>(mesh.error());
  if (!engine) return std::nullopt;
  Outcome out;
  const Box box = rest_bounds(engine->mesh());
  std::uint32_t last = 0;
  for (const Plane& plane : planes) {
    out.cut_tets += count_crossed(engine->mesh(), plane);
    const double start = thread_ms();
    const Result<StrokeReport> report = engine->cut(*plane_stroke(box, plane.normal, plane.offset));
    if (!report) return std::nullopt;
    last = report->stroke;
    if (maintains && &plane == &planes.back()) static_cast<void>(engine->maintain());
    out.ms += thread_ms() - start;
  }
  measure_walls(engine->mesh(), last, planes.back(), out);
  out.mesh = engine->mesh();
  return out;
}

struct NamedMethod {
  const char* name;
  Method run;
};

std::vector<NamedMethod> methods() {
  return {
      {"removal of elements [7, 8]",
       [](const Body& b, const std::vector<Plane>& p) { return by_soup(b, p, remove_tets); }},
      {"snapping of nodes [9]", [](const Body& b, const std::vector<Plane>& p) { return by_soup(b, p, snap_nodes); }},
      {"minimal subdivision [13]",
       [](const Body& b, const std::vector<Plane>& p) { return by_engine(b, p, Profile::kPaper, false); }},
      {"profile paper",
       [](const Body& b, const std::vector<Plane>& p) { return by_engine(b, p, Profile::kPaper, true); }},
      {"profile incise",
       [](const Body& b, const std::vector<Plane>& p) { return by_engine(b, p, Profile::kIncise, true); }}};
}

/// Planes through random points near the middle of the body, in random directions: the first ones of one sequence.
std::vector<Plane> random_planes(const Body& body, unsigned count) {
  Box box;
  for (const Vec3& p : body.soup.points) box.extend(p);
  Noise noise(kSeed);
  std::vector<Plane> planes;
  while (planes.size() < count) {
    const Vec3 normal = noise.direction();
    Vec3 point = box.lo;
    for (int axis = 0; axis < 3; ++axis) point[axis] += (0.5 + 0.2 * noise.next()) * (box.hi[axis] - box.lo[axis]);
    planes.push_back({normal, normal.dot(point)});
  }
  return planes;
}

double mean_edge(const TetSoup& soup) {
  double sum = 0;
  for (const auto& tet : soup.tets) {
    for (unsigned i = 0; i < 4; ++i) {
      for (unsigned j = i + 1; j < 4; ++j) sum += (soup.points[tet[i]] - soup.points[tet[j]]).norm();
    }
  }
  return sum / (6.0 * static_cast<double>(soup.tets.size()));
}

void add_row(const Body& body, unsigned strokes, const char* method, const Outcome& out, Table& table) {
  const QualityStats quality = measure_quality(out.mesh);
  const double before = volume_of(*TetMesh::build(body.soup)), edge = mean_edge(body.soup);
  double sum = 0, greatest = 0;
  for (const double d : out.wall_distances) {
    sum += d / edge;
    greatest = std::max(greatest, d / edge);
  }
  const auto walls = static_cast<double>(std::max<std::size_t>(out.wall_distances.size(), 1));
  const auto added = static_cast<double>(out.mesh.tet_count()) - static_cast<double>(body.soup.tets.size());
  table.add({body.name, std::to_string(strokes), method, std::to_string(find_components(out.mesh).count()),
             fmt::format("{:.2f}", 100 * (1 - volume_of(out.mesh) / before)), fmt::format("{:+.0f}", added),
             fmt::format("{:.2f}", quality.lr_min), fmt::format("{:.2f}", quality.lr_mean),
             fmt::format("{:.4g}", quality.lr_max), fmt::format("{:.2g}", quality.lr_over_200_pct),
             fmt::format("{:.2g}", quality.dihedral_min_deg), fmt::format("{:.4g}", quality.dihedral_max_deg),
             fmt::format("{:.2g}", sum / walls), fmt::format("{:.2g}", greatest),
             fmt::format("{:.1f}", 1e3 * out.ms / static_cast<double>(std::max<std::uint64_t>(out.cut_tets, 1)))});
}

std::vector<Body> bodies(const std::filesystem::path& root) {
  std::vector<Body> bodies = {{"cube", kuhn_cube(5)}};
  for (const char* name : {"bunny", "liver"}) {
    const Result<io::LoadedMesh> loaded = io::load_mesh(root / "models" / (std::string(name) + ".mesh"));
    if (loaded.ok()) {
      bodies.push_back({name, soup_of(loaded->mesh)});
    } else {
      std::fprintf(stderr, "%s is left out: %s\n", name, loaded.error().message.c_str());
    }
  }
  return bodies;
}

constexpr const char* kUsage =
    "usage: bench_methods [--out FOLDER] [--root FOLDER]\n"
    "Cuts cube, bunny and liver by the methods that the paper compares itself with and by both profiles, along 1, 5 "
    "and\n"
    "20 planes, and writes what came of it as methods.csv: docs/benchmark.md.\n";

int run(int argc, char** argv) {
  std::filesystem::path folder = "bench-results", root = ".";
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--out" && i + 1 < argc) {
      folder = argv[++i];
    } else if (argument == "--root" && i + 1 < argc) {
      root = argv[++i];
    } else {
      std::fputs(kUsage, argument == "-h" || argument == "--help" ? stdout : stderr);
      return argument == "-h" || argument == "--help" ? 0 : 2;
    }
  }
  Table table(
      "methods",
      "Methods on the same planes. Volume lost and tets added over the body's; L/r and dihedral angles of all tets; "
      "distance of the last wall's points from its plane in mean edges; processor time by tet that a plane met",
      {"body", "strokes", "method", "pieces", "volume lost %", "tets added", "L/r min", "mean", "max", "> 200 %",
       "dihedral min", "max", "wall off, mean", "max", "us / cut tet"});
  for (const Body& body : bodies(root)) {
    for (const unsigned strokes : kStrokes) {
      const std::vector<Plane> planes = random_planes(body, strokes);
      for (const NamedMethod& method : methods()) {
        const std::optional<Outcome> out = method.run(body, planes);
        if (out) add_row(body, strokes, method.name, *out, table);
      }
    }
  }
  table.print();
  table.write_csv(folder);
  return 0;
}

}  // namespace

}  // namespace incise::bench

int main(int argc, char** argv) {
  return incise::bench::run(argc, argv);
}
