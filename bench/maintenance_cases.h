// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "incise/cut/stroke.h"
#include "incise/mesh/tet_mesh.h"
#include "incise/mesh/tet_soup.h"

namespace incise::bench {

/// A box-shaped mesh that the cuts of the study are made for.
struct Cube {
  std::string name;
  TetSoup soup;
  double h = 0;             ///< length of a cell, or of the mean edge where the cube is unstructured
  std::uint32_t cells = 0;  ///< per side; 0 where the cube is unstructured
};

/// The Kuhn cube of n³ cells, jittered by 0.15 of its cells where `seed` is not 0.
Cube make_cube(std::uint32_t n, std::uint64_t seed);
/// An unstructured mesh of a box along the axes.
Cube make_cube(std::string name, const TetMesh& mesh);

/// A mesh, perhaps prepared for the cut, and the stroke to make in it.
struct Trial {
  std::string name;
  TetSoup soup;
  Stroke stroke;
  bool is_planar = true;
};

/// The cuts of a cube, by letter.
/// A: a generic oblique plane. B: the oblique plane through three vertices, and 1e-3 h beyond. C: oblique, every vertex
/// within 0.15 h of the plane moved to 1e-3 h on either side of it. D: nearly along the axes, 1e-3 h from a whole layer
/// of vertices (not for unstructured cubes). W: a wavy sheet of many quads.
std::vector<char> cuts_of(const Cube& cube);
Trial make_trial(const Cube& cube, char cut);

/// Strokes through a body, repeatable: planes near the centre, gently curved sheets, and sheets that stop inside.
struct BodyStroke {
  std::string name;
  Stroke stroke;
  bool is_planar = false;
};
inline constexpr unsigned kBodyStrokes = 10;
std::vector<BodyStroke> make_body_strokes(const TetMesh& mesh, std::uint64_t seed);

/// Repeatable numbers in [-1, 1).
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15ULL + 1) {}
  double next();
  /// A direction, evenly spread over the sphere.
  Vec3 direction();

 private:
  std::uint64_t state_;
};

/// The oblique plane of cut A, shifted and tilted by up to `amount` length units within the unit cube.
Stroke shaken_plane(Noise& noise, double amount);
/// A flat rectangle in a random pose in the unit cube, `width` wide.
Stroke random_patch(Noise& noise, double width);

}  // namespace incise::bench
