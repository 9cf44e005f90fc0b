// SPDX-License-Identifier: Apache-2.0
// A separate program, built by script/bench alone and never installed: it uses CGAL's tetrahedral remeshing, which is
// GPL-3.0-or-later, so a binary made from this file is under those terms.
//
// usage: bench_peer_cgal IN.mesh OUT.mesh EDGE_LENGTH [ITERATIONS]
//
// Coincident vertices are merged and the pieces become subdomains: CGAL wants one mesh with interfaces. Walls within a
// piece, of a cut that ends inside, become surface patches. Where merging spoils the mesh (the two sides of a wall no
// longer match), the sides stay apart, as boundary.
// Prints one line: the processor time of the remeshing in seconds and "interface" or "two-sided".
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_3/tet_soup_to_c3t3.h>
#include <CGAL/Tetrahedral_remeshing/Remeshing_triangulation_3.h>
#include <CGAL/tetrahedral_remeshing.h>

#include <algorithm>
#include <array>
#include <boost/property_map/property_map.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangulation = CGAL::Tetrahedral_remeshing::Remeshing_triangulation_3<Kernel>;
using VertexHandle = Triangulation::Vertex_handle;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Edge = std::array<int, 2>;
using Face = std::array<int, 3>;

/// Corners and, last, the region (input) or the subdomain (output), as CGAL's builder takes them.
using Tet = std::array<int, 5>;

struct Soup {
  std::vector<Point> points;
  std::vector<Tet> tets;
};

/// The corners of side s, counter-clockwise seen from outside.
Face side_of(const Tet& tet, int s) {
  constexpr int kSides[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  return {tet[kSides[s][0]], tet[kSides[s][1]], tet[kSides[s][2]]};
}

Face sorted(Face face) {
  std::sort(face.begin(), face.end());
  return face;
}

bool read_points(std::istream& in, Soup& soup) {
  std::size_t count = 0;
  in >> count;
  for (double x, y, z, label; soup.points.size() < count && in >> x >> y >> z >> label;) {
    soup.points.emplace_back(x, y, z);
  }
  return soup.points.size() == count;
}

bool read_tets(std::istream& in, Soup& soup) {
  std::size_t count = 0;
  in >> count;
  for (Tet t; soup.tets.size() < count && in >> t[0] >> t[1] >> t[2] >> t[3] >> t[4];) {
    soup.tets.push_back({t[0] - 1, t[1] - 1, t[2] - 1, t[3] - 1, t[4]});
  }
  return soup.tets.size() == count;
}

/// Reads ASCII MEDIT: vertices and tets, whatever stands between.
std::optional<Soup> read_medit(const std::string& path) {
  std::ifstream in(path);
  Soup soup;
  bool is_good = true;
  for (std::string word; is_good && in >> word;) {
    if (word == "Vertices") {
      is_good = read_points(in, soup);
    } else if (word == "Tetrahedra") {
      is_good = read_tets(in, soup);
    }
  }
  return is_good && !soup.tets.empty() ? std::optional<Soup>(std::move(soup)) : std::nullopt;
}

/// The tets on each face, as 4 · tet + side.
std::map<Face, std::vector<int>> sides_by_face(const Soup& soup) {
  std::map<Face, std::vector<int>> sides;
  for (int t = 0; t < static_cast<int>(soup.tets.size()); ++t) {
    for (int s = 0; s < 4; ++s) {
      sides[sorted(side_of(soup.tets[t], s))].push_back(4 * t + s);
    }
  }
  return sides;
}

int root_of(std::vector<int>& parents, int element) {
  while (parents[element] != element) {
    element = parents[element] = parents[parents[element]];
  }
  return element;
}

/// Numbers the pieces (tets linked by faces), region by region, from 1: CGAL's subdomains.
std::vector<int> label_pieces(const Soup& soup) {
  std::vector<int> parents(soup.tets.size());
  std::iota(parents.begin(), parents.end(), 0);
  for (const auto& [face, sides] : sides_by_face(soup)) {
    for (const int side : sides) {
      parents[root_of(parents, side / 4)] = root_of(parents, sides.front() / 4);
    }
  }
  std::map<std::pair<int, int>, int> numbers;
  std::vector<int> labels;
  for (std::size_t t = 0; t < soup.tets.size(); ++t) {
    const auto key = std::make_pair(root_of(parents, static_cast<int>(t)), soup.tets[t][4]);
    labels.push_back(numbers.emplace(key, static_cast<int>(numbers.size()) + 1).first->second);
  }
  return labels;
}

/// The same tets on points that differ from one another.
Soup merge_coincident(const Soup& soup) {
  Soup merged;
  std::map<Point, int> numbers;
  std::vector<int> now;
  for (const Point& point : soup.points) {
    const auto [place, is_new] = numbers.emplace(point, static_cast<int>(merged.points.size()));
    if (is_new) {
      merged.points.push_back(point);
    }
    now.push_back(place->second);
  }
  for (const Tet& t : soup.tets) {
    merged.tets.push_back({now[t[0]], now[t[1]], now[t[2]], now[t[3]], t[4]});
  }
  return merged;
}

/// Has every edge of the boundary two boundary faces?
bool is_closed(const std::map<Face, std::vector<int>>& sides) {
  std::map<Edge, int> counts;
  for (const auto& [face, both] : sides) {
    if (both.size() == 1) {
      ++counts[{face[0], face[1]}];
      ++counts[{face[0], face[2]}];
      ++counts[{face[1], face[2]}];
    }
  }
  return std::all_of(counts.begin(), counts.end(), [](const auto& entry) { return entry.second == 2; });
}

/// Faces to which CGAL has to hold besides those between subdomains, as its builder wants them: least corner first.
using Patches = std::map<Face, int>;

/// Is this still a mesh: no face of more than two tets, and a closed boundary?
bool is_sound(const Soup& soup) {
  const auto sides = sides_by_face(soup);
  return is_closed(sides) &&
         std::none_of(sides.begin(), sides.end(), [](const auto& entry) { return entry.second.size() > 2; });
}

/// The faces within a subdomain that merging has joined: walls of cuts that end inside.
Patches inner_walls(const Soup& merged, const Soup& soup) {
  Patches walls;
  const auto original = [&](int side) { return sorted(side_of(soup.tets[side / 4], side % 4)); };
  for (const auto& [face, sides] : sides_by_face(merged)) {
    if (sides.size() == 2 && merged.tets[sides[0] / 4][4] == merged.tets[sides[1] / 4][4] &&
        original(sides[0]) != original(sides[1])) {
      walls.emplace(face, 1);
    }
  }
  return walls;
}

/// What CGAL gets.
struct Input {
  Soup soup;
  Patches walls;
  bool has_interface = false;
};

/// Labels the pieces and merges coincident vertices where that leaves a mesh.
Input prepare(Soup soup) {
  const std::vector<int> labels = label_pieces(soup);
  for (std::size_t t = 0; t < labels.size(); ++t) {
    soup.tets[t][4] = labels[t];
  }
  Soup merged = merge_coincident(soup);
  if (!is_sound(merged)) {
    return {std::move(soup), {}, false};
  }
  Patches walls = inner_walls(merged, soup);
  return {std::move(merged), std::move(walls), true};
}

Vector unit_normal(const Soup& soup, const Face& face) {
  const Vector n =
      CGAL::cross_product(soup.points[face[1]] - soup.points[face[0]], soup.points[face[2]] - soup.points[face[0]]);
  return n / std::sqrt(n.squared_length());
}

/// Normals of the faces of boundary, interfaces and walls, collected at their edges; at an interface seen from the
/// lower subdomain.
std::map<Edge, std::vector<Vector>> normals_at_edges(const Soup& soup, const Patches& walls) {
  std::map<Edge, std::vector<Vector>> normals;
  for (const auto& [face, sides] : sides_by_face(soup)) {
    const auto subdomain = [&, &sides = sides](std::size_t i) { return soup.tets[sides[i] / 4][4]; };
    if (sides.size() == 2 && subdomain(0) == subdomain(1) && walls.count(face) == 0) {
      continue;
    }
    const int side = sides.size() == 2 && subdomain(1) < subdomain(0) ? sides[1] : sides[0];
    const Vector normal = unit_normal(soup, side_of(soup.tets[side / 4], side % 4));
    for (const Edge edge : {Edge{face[0], face[1]}, Edge{face[0], face[2]}, Edge{face[1], face[2]}}) {
      normals[edge].push_back(normal);
    }
  }
  return normals;
}

/// Edges of surface where other than two faces meet (the contour and the end of a cut), or two at more than 60 degrees.
std::vector<Edge> find_ridges(const Soup& soup, const Patches& walls) {
  constexpr double kCosineOfRidge = 0.5;
  std::vector<Edge> ridges;
  for (const auto& [edge, normals] : normals_at_edges(soup, walls)) {
    if (normals.size() != 2 || normals[0] * normals[1] < kCosineOfRidge) {
      ridges.push_back(edge);
    }
  }
  return ridges;
}

using VertexPair = std::pair<VertexHandle, VertexHandle>;

/// Runs CGAL's remesher on the input's triangulation and returns the processor time in seconds.
double remesh(Triangulation& triangulation, const Input& input, const std::vector<VertexHandle>& handles,
              double edge_length, unsigned iterations) {
  std::map<VertexPair, bool> edges;
  for (const Edge& edge : find_ridges(input.soup, input.walls)) {
    // CGAL's builder puts the infinite vertex first.
    edges[CGAL::Tetrahedral_remeshing::make_vertex_pair(handles[edge[0] + 1], handles[edge[1] + 1])] = true;
  }
  const std::clock_t start = std::clock();
  CGAL::tetrahedral_isotropic_remeshing(triangulation, edge_length,
                                        CGAL::parameters::number_of_iterations(iterations)
                                            .edge_is_constrained_map(boost::make_assoc_property_map(edges)));
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// The triangulation's tets that belong to a subdomain.
Soup soup_of(const Triangulation& triangulation) {
  Soup soup;
  std::map<VertexHandle, int> numbers;
  for (const auto& cell : triangulation.finite_cell_handles()) {
    if (cell->subdomain_index() == 0) {
      continue;
    }
    Tet tet{0, 0, 0, 0, cell->subdomain_index()};
    for (int corner = 0; corner < 4; ++corner) {
      const VertexHandle vertex = cell->vertex(corner);
      const auto [place, is_new] = numbers.emplace(vertex, static_cast<int>(soup.points.size()));
      if (is_new) {
        soup.points.push_back(vertex->point());
      }
      tet[corner] = place->second;
    }
    soup.tets.push_back(tet);
  }
  return soup;
}

bool write_medit(const Soup& soup, const char* path) {
  std::FILE* out = std::fopen(path, "w");
  if (out == nullptr) {
    return false;
  }
  std::fprintf(out, "MeshVersionFormatted 2\nDimension 3\nVertices\n%zu\n", soup.points.size());
  for (const Point& p : soup.points) {
    std::fprintf(out, "%.17g %.17g %.17g 0\n", p.x(), p.y(), p.z());
  }
  std::fprintf(out, "Tetrahedra\n%zu\n", soup.tets.size());
  for (const Tet& t : soup.tets) {
    std::fprintf(out, "%d %d %d %d %d\n", t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1, t[4]);
  }
  std::fprintf(out, "End\n");
  return std::fclose(out) == 0;
}

int fail(const char* what, int status) {
  std::fprintf(stderr, "bench_peer_cgal: %s\n", what);
  return status;
}

/// Input to output; the exit status.
int run(const char* in, const char* out, double edge_length, unsigned iterations) {
  std::optional<Soup> soup = read_medit(in);
  if (!soup) {
    return fail("the input is no ASCII MEDIT mesh with tets", 3);
  }
  const Input input = prepare(std::move(*soup));
  Triangulation triangulation;
  std::vector<VertexHandle> handles;
  // `true`: without the check by Euler's relation, which does not hold for several bodies.
  if (!CGAL::build_triangulation<Triangulation, true>(triangulation, input.soup.points, input.soup.tets, input.walls,
                                                      handles)) {
    return fail("CGAL does not take this mesh", 1);
  }
  const double seconds = remesh(triangulation, input, handles, edge_length, iterations);
  std::printf("%.6f %s\n", seconds, input.has_interface ? "interface" : "two-sided");
  return write_medit(soup_of(triangulation), out) ? 0 : fail("the output cannot be written", 1);
}

}  // namespace

int main(int argc, char** argv) {
  const double edge_length = argc > 3 ? std::atof(argv[3]) : 0;
  if (argc < 4 || argc > 5 || !(edge_length > 0)) {
    return fail("usage: bench_peer_cgal IN.mesh OUT.mesh EDGE_LENGTH [ITERATIONS]", 2);
  }
  try {
    return run(argv[1], argv[2], edge_length, argc > 4 ? static_cast<unsigned>(std::atoi(argv[4])) : 5);
  } catch (const std::exception& error) {
    return fail(error.what(), 1);
  }
}
