// SPDX-License-Identifier: Apache-2.0
#include "maintenance_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "incise/geom/quality.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/shapes.h"

namespace incise::bench {

namespace {

constexpr double kTurn = 6.283185307179586;
constexpr double kBeside = 1e-3;  // of h: how far a plane passes by vertices

struct Plane {
  Vec3 normal;  // of length 1
  double offset;
  [[nodiscard]] double height(const Vec3& p) const { return normal.dot(p) - offset; }
};

Plane plane_through(const Vec3& normal, const Vec3& point) {
  const Vec3 n = normal.normalized();
  return {n, n.dot(point)};
}

Box box_of(const TetSoup& soup) {
  Box box;
  for (const Vec3& point : soup.points) {
    box.extend(point);
  }
  return box;
}

Stroke stroke_of(const TetSoup& soup, const Plane& plane) {
  const Result<Stroke> stroke = plane_stroke(box_of(soup), plane.normal, plane.offset);
  return stroke.ok() ? *stroke : Stroke();
}

/// Two directions that make a right-handed frame with a direction of length 1.
std::array<Vec3, 2> tangents(const Vec3& n) {
  const Vec3 helper = std::abs(n.x()) < 0.6 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 u = n.cross(helper).normalized();
  return {u, n.cross(u)};
}

/// A sheet over [u0, u1] × [v0, v1]: the blade lies along u and moves along v.
Stroke sheet(const std::array<double, 4>& range, unsigned segments, unsigned steps,
             const std::function<Vec3(double, double)>& point) {
  const auto& [u0, u1, v0, v1] = range;
  Stroke stroke;
  stroke.name = "sheet";
  for (unsigned j = 0; j <= steps; ++j) {
    stroke.times.push_back(j);
    std::vector<Vec3>& edge = stroke.edges.emplace_back();
    for (unsigned i = 0; i <= segments; ++i) {
      edge.push_back(point(u0 + (u1 - u0) * i / segments, v0 + (v1 - v0) * j / steps));
    }
  }
  return stroke;
}

const Vec3 kOblique(0.37, 0.53, 0.76);
const Vec3 kThrough(0.513, 0.492, 0.507);

Plane oblique_plane() {
  return plane_through(kOblique, kThrough);
}

std::size_t nearest_point(const TetSoup& soup, const Vec3& to) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < soup.points.size(); ++i) {
    if ((soup.points[i] - to).squaredNorm() < (soup.points[best] - to).squaredNorm()) {
      best = i;
    }
  }
  return best;
}

Plane plane_beside_vertices(const Cube& cube) {
  const auto [u, v] = tangents(oblique_plane().normal);
  const auto near = [&](const Vec3& at) { return cube.soup.points[nearest_point(cube.soup, at)]; };
  const Vec3 a = near(kThrough + 0.28 * u), b = near(kThrough - 0.2 * u + 0.22 * v), c = near(kThrough - 0.25 * v);
  Plane plane = plane_through((b - a).cross(c - a), a);
  plane.offset += kBeside * cube.h;
  return plane;
}

/// The tets around each point.
std::vector<std::vector<std::uint32_t>> stars_of(const TetSoup& soup) {
  std::vector<std::vector<std::uint32_t>> stars(soup.points.size());
  for (std::uint32_t t = 0; t < soup.tets.size(); ++t) {
    for (const std::uint32_t corner : soup.tets[t]) {
      stars[corner].push_back(t);
    }
  }
  return stars;
}

double volume6(const TetSoup& soup, std::uint32_t tet) {
  const auto& [a, b, c, d] = soup.tets[tet];
  return signed_volume6(soup.points[a], soup.points[b], soup.points[c], soup.points[d]);
}

/// The part of a direction along which a point stays on the faces of the box that it lies on.
Vec3 free_part(const Box& box, const Vec3& point, Vec3 direction) {
  for (int axis = 0; axis < 3; ++axis) {
    if (point[axis] == box.lo[axis] || point[axis] == box.hi[axis]) {
      direction[axis] = 0;
    }
  }
  return direction;
}

/// Moves a point of the box to a height above the plane, where that leaves all tets a tenth of their volume.
void move_to_height(TetSoup& soup, const Box& box, const std::vector<std::uint32_t>& star, std::uint32_t point,
                    const Plane& plane, double height) {
  const Vec3 old = soup.points[point], along = free_part(box, old, plane.normal);
  const double slope = along.dot(plane.normal);
  if (slope < 0.1) {
    return;
  }
  std::vector<double> volumes;
  for (const std::uint32_t tet : star) {
    volumes.push_back(volume6(soup, tet));
  }
  soup.points[point] = old + (height - plane.height(old)) / slope * along;
  for (std::size_t i = 0; i < star.size(); ++i) {
    if (volume6(soup, star[i]) < 0.1 * volumes[i]) {
      soup.points[point] = old;
      return;
    }
  }
}

/// A carpet of vertices right beside the plane, on either side by turns.
TetSoup with_carpet(const Cube& cube, const Plane& plane) {
  TetSoup soup = cube.soup;
  const Box box = box_of(soup);
  const auto stars = stars_of(soup);
  for (std::uint32_t i = 0; i < soup.points.size(); ++i) {
    if (std::abs(plane.height(soup.points[i])) < 0.15 * cube.h) {
      move_to_height(soup, box, stars[i], i, plane, (i % 2 == 0 ? kBeside : -kBeside) * cube.h);
    }
  }
  return soup;
}

/// Puts a middle layer of a Kuhn cube right below a plane.
TetSoup with_layer(const Cube& cube, const Plane& plane, std::uint32_t layer) {
  TetSoup soup = cube.soup;
  const Box box = box_of(soup);
  const auto stars = stars_of(soup);
  for (std::uint32_t i = layer; i < soup.points.size(); i += cube.cells + 1) {
    move_to_height(soup, box, stars[i], i, plane, -kBeside * cube.h);
  }
  return soup;
}

Trial layer_trial(const Cube& cube) {
  const std::uint32_t layer = cube.cells / 2;
  const double x = static_cast<double>(layer) / cube.cells;
  const Plane plane = plane_through(Vec3(1, 0.02, -0.013), Vec3(x, 0.5, 0.5));
  Trial trial{"D", with_layer(cube, plane, layer), {}, true};
  trial.stroke = stroke_of(trial.soup, plane);
  return trial;
}

/// A smooth sheet with an amplitude of 0.08 of the cube, slightly tilted; a few of its quads per cell.
Stroke wavy_sheet(double h) {
  const auto quads = static_cast<unsigned>(std::ceil(3.0 * 1.2 / h));
  return sheet({-0.1, 1.1, -0.1, 1.1}, quads, quads, [](double x, double y) {
    const double wave = 0.08 * std::sin(kTurn * x + 0.4) * std::cos(kTurn * y - 0.3);
    return Vec3(x, y, 0.507 + wave + 0.11 * (x - 0.5) - 0.07 * (y - 0.5));
  });
}

Trial plane_trial(const char* name, TetSoup soup, const Plane& plane) {
  Stroke stroke = stroke_of(soup, plane);
  return {name, std::move(soup), std::move(stroke), true};
}

TetSoup soup_of(const TetMesh& mesh) {
  TetSoup soup;
  for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) {
    soup.points.push_back(mesh.rest(VertexId(v)));
  }
  mesh.for_each_tet([&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    soup.tets.push_back({v[0].value, v[1].value, v[2].value, v[3].value});
  });
  return soup;
}

double mean_edge(const TetSoup& soup) {
  double sum = 0;
  for (const auto& tet : soup.tets) {
    for (const auto& [i, j] : kEdgeCorners) {
      sum += (soup.points[tet[i]] - soup.points[tet[j]]).norm();
    }
  }
  return soup.tets.empty() ? 1.0 : sum / (6.0 * static_cast<double>(soup.tets.size()));
}

}  // namespace

double Noise::next() {
  state_ += 0x9E3779B97F4A7C15ULL;
  std::uint64_t x = state_;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
  return static_cast<double>((x ^ (x >> 31U)) >> 11U) * 0x1p-52 - 1;
}

Vec3 Noise::direction() {
  while (true) {
    const double x = next(), y = next(), z = next();
    const Vec3 v(x, y, z);
    if (v.squaredNorm() > 0.01 && v.squaredNorm() < 1) {
      return v.normalized();
    }
  }
}

Cube make_cube(std::uint32_t n, std::uint64_t seed) {
  Cube cube{"kuhn" + std::to_string(n) + (seed == 0 ? "/even" : "/seed" + std::to_string(seed)), kuhn_cube(n), 1.0 / n,
            n};
  if (seed != 0) {
    jitter(cube.soup, 0.15, seed);
  }
  return cube;
}

Cube make_cube(std::string name, const TetMesh& mesh) {
  TetSoup soup = soup_of(mesh);
  const double h = mean_edge(soup);
  return {std::move(name), std::move(soup), h, 0};
}

std::vector<char> cuts_of(const Cube& cube) {
  return cube.cells == 0 ? std::vector<char>{'A', 'B', 'C', 'W'} : std::vector<char>{'A', 'B', 'C', 'D', 'W'};
}

Trial make_trial(const Cube& cube, char cut) {
  switch (cut) {
    case 'B':
      return plane_trial("B", cube.soup, plane_beside_vertices(cube));
    case 'C':
      return plane_trial("C", with_carpet(cube, oblique_plane()), oblique_plane());
    case 'D':
      return layer_trial(cube);
    case 'W':
      return {"W", cube.soup, wavy_sheet(cube.h), false};
    default:
      return plane_trial("A", cube.soup, oblique_plane());
  }
}

namespace {

/// Where a stroke through a body goes: a frame near its middle, and the body's size.
struct Pose {
  Vec3 centre, normal, u, v;
  double size;
  [[nodiscard]] Vec3 at(double a, double b, double c) const { return centre + size * (a * u + b * v + c * normal); }
};

Vec3 centroid(const TetMesh& mesh) {
  Vec3 sum = Vec3::Zero();
  double volume = 0;
  mesh.for_each_tet([&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    const double part = mesh.rest_volume(tet);
    sum += part * 0.25 * (mesh.rest(v[0]) + mesh.rest(v[1]) + mesh.rest(v[2]) + mesh.rest(v[3]));
    volume += part;
  });
  return sum / volume;
}

Pose random_pose(const Box& box, const Vec3& middle, Noise& noise) {
  const Vec3 extent = box.hi - box.lo;
  Pose pose;
  pose.size = extent.norm();
  pose.centre = middle + 0.12 * extent.cwiseProduct(Vec3(noise.next(), noise.next(), noise.next()));
  pose.normal = noise.direction();
  const auto [u, v] = tangents(pose.normal);
  pose.u = u;
  pose.v = v;
  return pose;
}

BodyStroke body_plane(const Box& box, const Pose& pose) {
  const Result<Stroke> stroke = plane_stroke(box, pose.normal, pose.normal.dot(pose.centre));
  return {"plane", stroke.ok() ? *stroke : Stroke(), true};
}

/// A saddle or a bowl with a curvature of up to 0.6 per size of the body.
BodyStroke body_sheet(const Pose& pose, Noise& noise, bool is_partial) {
  const double p = 0.3 * noise.next(), q = 0.3 * noise.next(), end = is_partial ? 0.04 * noise.next() : 1.1;
  const auto point = [&](double a, double b) { return pose.at(a, b, p * a * a + q * b * b); };
  return {is_partial ? "partial" : "curved", sheet({-1.1, 1.1, -1.1, end}, 32, is_partial ? 16 : 32, point), false};
}

}  // namespace

std::vector<BodyStroke> make_body_strokes(const TetMesh& mesh, std::uint64_t seed) {
  Noise noise(seed);
  const Box box = rest_bounds(mesh);
  const Vec3 middle = centroid(mesh);
  std::vector<BodyStroke> strokes;
  for (unsigned i = 0; i < kBodyStrokes; ++i) {
    const Pose pose = random_pose(box, middle, noise);
    strokes.push_back(i < 4 ? body_plane(box, pose) : body_sheet(pose, noise, i >= 7));
    strokes.back().name += std::to_string(i);
  }
  return strokes;
}

Stroke shaken_plane(Noise& noise, double amount) {
  const Plane plane = oblique_plane();
  const auto [u, v] = tangents(plane.normal);
  // Half of it by shifting; the cube lies within 0.87 of its centre, so that the tilts add up to less than the rest.
  const Vec3 normal = plane.normal + amount / 0.87 * 0.35 * (noise.next() * u + noise.next() * v);
  const Plane shaken = plane_through(normal, kThrough + 0.5 * amount * noise.next() * plane.normal);
  const Result<Stroke> stroke = plane_stroke({Vec3::Zero(), Vec3::Ones()}, shaken.normal, shaken.offset);
  return stroke.ok() ? *stroke : Stroke();
}

Stroke random_patch(Noise& noise, double width) {
  const double x = noise.next(), y = noise.next(), z = noise.next(), turn = 0.5 * kTurn * noise.next();
  const Vec3 centre = Vec3::Constant(0.5) + 0.5 * Vec3(x, y, z);
  const auto [a, b] = tangents(noise.direction());
  const Vec3 u = std::cos(turn) * a + std::sin(turn) * b, v = std::cos(turn) * b - std::sin(turn) * a;
  const double half = 0.5 * width;
  return sheet({-half, half, -half, half}, 1, 1, [&](double s, double t) -> Vec3 { return centre + s * u + t * v; });
}

}  // namespace incise::bench
