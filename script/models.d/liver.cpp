// SPDX-License-Identifier: Apache-2.0
// A separate program, built and run by script/models alone and never installed: it uses CGAL's Mesh_3, which is
// GPL-3.0-or-later, so a binary made from this file is under those terms.
//
// usage: liver IMAGE.inr OUT.mesh FACET_SIZE FACET_DISTANCE CELL_SIZE      lengths in the image's millimetres
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Image_3.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Random.h>
#include <CGAL/make_mesh_3.h>

#include <cstdio>
#include <cstdlib>
#include <map>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
namespace params = CGAL::parameters;

// MEDIT with 17 digits, the image's labels as regions.
static bool write(const Complex& complex, const char* path) {
  FILE* out = std::fopen(path, "w");
  if (out == nullptr) {
    return false;
  }
  std::map<Triangulation::Vertex_handle, int> index;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    for (int corner = 0; corner < 4; ++corner) {
      index.emplace(cell->vertex(corner), 0);
    }
  }
  // Numbered in the triangulation's order: the map's own order is that of addresses, which differ from run to run.
  std::fprintf(out, "MeshVersionFormatted 2\nDimension 3\nVertices\n%zu\n", index.size());
  int next = 0;
  const auto& triangulation = complex.triangulation();
  for (auto v = triangulation.finite_vertices_begin(); v != triangulation.finite_vertices_end(); ++v) {
    const auto found = index.find(v);
    if (found != index.end()) {
      found->second = ++next;
      const auto& p = v->point();
      std::fprintf(out, "%.17g %.17g %.17g 0\n", CGAL::to_double(p.x()), CGAL::to_double(p.y()),
                   CGAL::to_double(p.z()));
    }
  }
  std::fprintf(out, "Tetrahedra\n%zu\n", static_cast<std::size_t>(complex.number_of_cells_in_complex()));
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    for (int corner = 0; corner < 4; ++corner) {
      std::fprintf(out, "%d ", index.at(cell->vertex(corner)));
    }
    std::fprintf(out, "%d\n", static_cast<int>(complex.subdomain_index(cell)));
  }
  std::fprintf(out, "End\n");
  return std::fclose(out) == 0;
}

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fprintf(stderr, "usage: liver IMAGE.inr OUT.mesh FACET_SIZE FACET_DISTANCE CELL_SIZE\n");
    return 2;
  }
  CGAL::Image_3 image;
  if (!image.read(argv[1])) {
    std::fprintf(stderr, "liver: cannot read the image %s\n", argv[1]);
    return 3;
  }
  // CGAL seeds its random numbers with the clock unless told: the same mesh every time needs a fixed seed.
  CGAL::Random random(0);
  CGAL::get_default_random() = random;
  const Domain domain = Domain::create_labeled_image_mesh_domain(image, params::p_rng = &random);
  const Criteria criteria(params::facet_angle = 25, params::facet_size = std::atof(argv[3]),
                          params::facet_distance = std::atof(argv[4]), params::cell_radius_edge_ratio = 3,
                          params::cell_size = std::atof(argv[5]));
  // Smoothing takes the slivers out here, since CGAL's perturber and exuder give another mesh at every run.
  const Complex complex = CGAL::make_mesh_3<Complex>(domain, criteria, params::odt(params::max_iteration_number = 10),
                                                     params::no_perturb(), params::no_exude());
  if (!write(complex, argv[2])) {
    std::fprintf(stderr, "liver: cannot write %s\n", argv[2]);
    return 1;
  }
  return 0;
}
