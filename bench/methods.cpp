// SPDX-License-Identifier: Apache-2.0
// The methods that the paper compares itself with, and both profiles, on the same planes: docs/benchmark.md.
#include <fmt/format.h>

#include <algorithm>
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
#include "incise/lab/method.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/shapes.h"
#include "maintenance_cases.h"
#include "report.h"

namespace incise::bench {

namespace {

constexpr std::array<unsigned, 3> kStrokes = {1, 5, 20};
constexpr std::uint64_t kSeed = 7;
/// Meshes that have grown beyond this are not cut on: what comes after says nothing new, and fills memory.
constexpr std::size_t kMostTets = 1'000'000;

/// The plane normal · x = offset; `normal` of length 1.
struct Plane {
  Vec3 normal;
  double offset = 0;

  [[nodiscard]] double height(const Vec3& point) const { return normal.dot(point) - offset; }
};

struct Body {
  std::string name;
  TetSoup soup;
};

/// What came of all strokes.
struct Outcome {
  TetMesh mesh;
  std::vector<double> wall_distances;  // of points of the walls that the last stroke left, in mean edges of the body
  std::uint64_t cut_tets = 0;          // tets with corners on both sides of a stroke, when it came
  std::uint32_t strokes = 0;           // made
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

/// Cuts one plane after the other, `cut` each with the tag of its walls; nothing where one fails. A mesh that has grown
/// beyond `kMostTets` is not cut on.
template <class CutPlane>
bool cut_all(const Body& body, const std::vector<Plane>& planes, const TetMesh& mesh, CutPlane&& cut, Outcome& out) {
  const Box box = rest_bounds(mesh);
  for (const Plane& plane : planes) {
    if (mesh.tet_count() > kMostTets || mesh.tet_count() == 0) break;
    out.cut_tets += count_crossed(mesh, plane);
    const double start = thread_ms();
    const Status status = cut(*plane_stroke(box, plane.normal, plane.offset), out.strokes + 1);
    out.ms += thread_ms() - start;
    if (!status) {
      std::fprintf(stderr, "%s: %s\n", body.name.c_str(), status.error().message.c_str());
      return false;
    }
    ++out.strokes;
    out.wall_distances.clear();
    measure_walls(mesh, out.strokes, plane, out);
  }
  return true;
}

std::optional<Outcome> by_method(const Body& body, const std::vector<Plane>& planes, LabMethod method) {
  Outcome out;
  out.mesh = *TetMesh::build(body.soup);
  const auto cut = [&](const Stroke& stroke, std::uint32_t tag) -> Status {
    Journal journal;  // of one stroke: nobody goes back
    const Result<CutStatistics> done = cut_by(method, out.mesh, journal, stroke, tag);
    return done ? Status() : Status(done.error());
  };
  return cut_all(body, planes, out.mesh, cut, out) ? std::optional<Outcome>(std::move(out)) : std::nullopt;
}

std::optional<Outcome> by_engine(const Body& body, const std::vector<Plane>& planes, Profile profile) {
  EngineOptions options;
  options.cut.profile = profile;
  Result<Engine> engine = Engine::create(*TetMesh::build(body.soup), options);
  if (!engine) return std::nullopt;
  Outcome out;
  const auto cut = [&](const Stroke& stroke, std::uint32_t tag) -> Status {
    const Result<StrokeReport> report = engine->cut(stroke);
    if (report && tag == planes.size()) static_cast<void>(engine->maintain());
    return report ? Status() : Status(report.error());
  };
  if (!cut_all(body, planes, engine->mesh(), cut, out)) return std::nullopt;
  out.mesh = engine->mesh();
  return out;
}

struct NamedMethod {
  std::string name;
  Method run;
};

/// In the order of the paper's references.
std::vector<NamedMethod> methods() {
  constexpr std::array<const char*, kLabMethodNames.size()> kReferences = {"[7, 8]", "[9]",  "[10]",
                                                                           "[11]",   "[12]", "[13]"};
  std::vector<NamedMethod> methods;
  for (std::size_t k = 0; k < kLabMethodNames.size(); ++k) {
    const auto method = static_cast<LabMethod>(k);
    methods.push_back({fmt::format("{} {}", kLabMethodNames[k], kReferences[k]),
                       [method](const Body& b, const std::vector<Plane>& p) { return by_method(b, p, method); }});
  }
  methods.push_back(
      {"profile paper", [](const Body& b, const std::vector<Plane>& p) { return by_engine(b, p, Profile::kPaper); }});
  methods.push_back(
      {"profile incise", [](const Body& b, const std::vector<Plane>& p) { return by_engine(b, p, Profile::kIncise); }});
  return methods;
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

void add_row(const Body& body, unsigned strokes, const std::string& method, const Outcome& out, Table& table) {
  const QualityStats quality = measure_quality(out.mesh);
  const double before = volume_of(*TetMesh::build(body.soup)), edge = mean_edge(body.soup);
  const double lost = 100 * (1 - volume_of(out.mesh) / before);
  double sum = 0, greatest = 0;
  for (const double d : out.wall_distances) {
    sum += d / edge;
    greatest = std::max(greatest, d / edge);
  }
  const auto walls = static_cast<double>(std::max<std::size_t>(out.wall_distances.size(), 1));
  const auto added = static_cast<double>(out.mesh.tet_count()) - static_cast<double>(body.soup.tets.size());
  table.add({body.name, std::to_string(strokes), method, std::to_string(out.strokes),
             std::to_string(body.soup.tets.size()), std::to_string(find_components(out.mesh).count()),
             fmt::format("{:.2f}", std::abs(lost) < 0.005 ? 0.0 : lost), fmt::format("{:+.0f}", added),
             fmt::format("{:.2f}", quality.lr_min), fmt::format("{:.2f}", quality.lr_mean),
             fmt::format("{:.4g}", quality.lr_max), fmt::format("{:.2g}", quality.lr_over_200_pct),
             std::to_string(quality.flat_tets), fmt::format("{:.2g}", quality.dihedral_min_deg),
             fmt::format("{:.4g}", quality.dihedral_max_deg), fmt::format("{:.2g}", sum / walls),
             fmt::format("{:.2g}", greatest),
             fmt::format("{:.1f}", 1e3 * out.ms / static_cast<double>(std::max<std::uint64_t>(out.cut_tets, 1)))});
}

/// Gives each group of tets at a vertex that hang together by faces there a vertex of its own: the lab's methods, and
/// maintenance, refuse bodies that touch themselves.
void part_where_it_touches(TetSoup& soup) {
  std::vector<std::vector<std::uint32_t>> stars(soup.points.size());
  for (std::uint32_t t = 0; t < soup.tets.size(); ++t) {
    for (const std::uint32_t v : soup.tets[t]) stars[v].push_back(t);
  }
  const auto share_a_face = [&](std::uint32_t a, std::uint32_t b) {
    unsigned common = 0;
    for (const std::uint32_t v : soup.tets[a]) {
      common += std::count(soup.tets[b].begin(), soup.tets[b].end(), v) > 0 ? 1U : 0U;
    }
    return common == 3;
  };
  for (std::uint32_t v = 0; v < stars.size(); ++v) {
    std::vector<std::uint32_t> rest = stars[v];
    for (bool is_first = true; !rest.empty(); is_first = false) {
      std::vector<std::uint32_t> group = {rest.back()};
      rest.pop_back();
      for (std::size_t k = 0; k < group.size(); ++k) {
        const auto joined = std::stable_partition(rest.begin(), rest.end(),
                                                  [&](std::uint32_t t) { return !share_a_face(group[k], t); });
        const std::vector<std::uint32_t> found(joined, rest.end());
        group.insert(group.end(), found.begin(), found.end());
        rest.erase(joined, rest.end());
      }
      if (is_first) continue;
      const auto copy = static_cast<std::uint32_t>(soup.points.size());
      const Vec3 place = soup.points[v];
      soup.points.push_back(place);
      for (const std::uint32_t t : group) std::replace(soup.tets[t].begin(), soup.tets[t].end(), v, copy);
    }
  }
}

std::vector<Body> bodies(const std::filesystem::path& root) {
  std::vector<Body> bodies = {{"cube", kuhn_cube(5)}};
  for (const char* name : {"bunny", "liver"}) {
    const Result<io::LoadedMesh> loaded = io::load_mesh(root / "models" / (std::string(name) + ".mesh"));
    if (loaded.ok()) {
      bodies.push_back({name, soup_of(loaded->mesh)});
      part_where_it_touches(bodies.back().soup);
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
      "Methods on the same planes. Volume lost and tets added over the body's; L/r and dihedral angles of all tets "
      "but the flat ones, which are counted; "
      "distance of the last wall's points from its plane in mean edges; processor time by tet that a plane met. Made: "
      "strokes until the mesh had more than a million tets, or none",
      {"body", "strokes", "method", "made", "tets before", "pieces", "volume lost %", "tets added", "L/r min", "mean",
       "max", "> 200 %", "flat", "dihedral min", "max", "wall off, mean", "max", "us / cut tet"});
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
