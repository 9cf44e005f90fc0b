// SPDX-License-Identifier: Apache-2.0
// Gradients of shape functions once for each element; energy, forces and stiffness from the displacement gradient, so
// that a body at rest has no rounding errors of its size (docs/internals.md, 4).
#include "sim/reference/elastic_body.h"

#include <algorithm>
#include <numeric>

#include "incise/geom/quality.h"

namespace incise {
inline namespace v0 {

namespace {

std::array<Vec3, 4> rest_corners(const TetMesh& mesh, TetId tet) {
  const TetVertices& v = mesh.vertices(tet);
  return {mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3])};
}

/// How much softer a thin tet is taken to be; 1 for all others.
double softening(const std::array<Vec3, 4>& p, double thinnest) {
  double longest = 0;
  for (const auto& [a, b] : kEdgeCorners) longest = std::max(longest, (p[b] - p[a]).norm());
  double widest = 0;  // twice the area of the greatest side
  for (const auto& c : kSideCorners) widest = std::max(widest, (p[c[1]] - p[c[0]]).cross(p[c[2]] - p[c[0]]).norm());
  const double altitude = signed_volume6(p[0], p[1], p[2], p[3]) / widest;
  return altitude < thinnest * longest ? altitude / (thinnest * longest) : 1.0;
}

/// The gradients of the four shape functions, in 1 / length unit.
Eigen::Matrix<double, 3, 4> shape_gradients(const std::array<Vec3, 4>& p) {
  Eigen::Matrix<double, 3, 4> result;
  const double volume6 = signed_volume6(p[0], p[1], p[2], p[3]);
  for (std::size_t s = 0; s < 4; ++s) {
    const auto& c = kSideCorners[s];  // turns counter-clockwise seen from outside: its normal points away from s
    result.col(static_cast<Eigen::Index>(s)) = -(p[c[1]] - p[c[0]]).cross(p[c[2]] - p[c[0]]) / volume6;
  }
  return result;
}

Mat3 displacement_gradient(const ElasticBody::Element& element, const std::vector<Vec3>& displacements) {
  Mat3 h = Mat3::Zero();
  for (std::size_t a = 0; a < 4; ++a) {
    h += displacements[element.vertices[a]] * element.gradients.col(static_cast<Eigen::Index>(a)).transpose();
  }
  return h;
}

/// Σ w_a[i] w_b[j] D_ij over the 3×3 blocks of the stiffness.
Mat3 corner_block(const ElasticBody::Element& element, const Mat9& stiffness, Eigen::Index a, Eigen::Index b) {
  Mat3 block = Mat3::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      block += element.gradients(i, a) * element.gradients(j, b) * stiffness.block<3, 3>(3 * i, 3 * j);
    }
  }
  return element.volume * block;
}

/// Sets of slots that grow together.
class Parts {
 public:
  explicit Parts(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0U); }

  std::uint32_t root(std::uint32_t slot) {
    while (parents_[slot] != slot) {
      parents_[slot] = parents_[parents_[slot]];
      slot = parents_[slot];
    }
    return slot;
  }
  void join(std::uint32_t a, std::uint32_t b) { parents_[root(b)] = root(a); }

 private:
  std::vector<std::uint32_t> parents_;
};

}  // namespace

ElasticBody::ElasticBody(const ReferenceProblem& problem) : masses_(problem.mesh->vertex_slots(), 0.0) {
  problem.mesh->for_each_tet([&](TetId tet) { add_element(problem, tet); });
  number_unknowns(problem.held);
}

void ElasticBody::add_element(const ReferenceProblem& problem, TetId tet) {
  const std::array<Vec3, 4> corners = rest_corners(*problem.mesh, tet);
  if (is_flat(corners[0], corners[1], corners[2], corners[3])) return;
  const Material& material = problem.materials.of(problem.mesh->region(tet));
  const double unit = problem.length_unit;
  Element element;
  element.volume = problem.mesh->rest_volume(tet) * unit * unit * unit;
  element.gradients = shape_gradients(corners) / unit;
  element.tissue = NeoHookean(material, softening(corners, problem.thinnest));
  for (std::size_t a = 0; a < 4; ++a) {
    element.vertices[a] = problem.mesh->vertices(tet)[a].value;
    masses_[element.vertices[a]] += 0.25 * material.density * element.volume;
  }
  elements_.push_back(element);
}

void ElasticBody::number_unknowns(const std::vector<VertexId>& held) {
  unknowns_.assign(slot_count(), kInvalidIndex);
  std::vector<bool> is_held(slot_count(), false);
  for (const VertexId vertex : held) is_held[vertex.value] = true;
  std::uint32_t count = 0;
  for (std::uint32_t slot = 0; slot < slot_count(); ++slot) {
    if (masses_[slot] > 0 && !is_held[slot]) unknowns_[slot] = count++;
  }
  const std::vector<std::uint32_t> order = BlockMatrix(count, cliques()).elimination_order();
  for (std::uint32_t& unknown : unknowns_) {
    if (unknown != kInvalidIndex) unknown = order[unknown];
  }
  hessian_pattern_ = BlockMatrix(count, cliques());
}

std::vector<std::array<std::uint32_t, 4>> ElasticBody::cliques() const {
  std::vector<std::array<std::uint32_t, 4>> result;
  result.reserve(elements_.size());
  for (const Element& element : elements_) {
    const auto& v = element.vertices;
    result.push_back({unknowns_[v[0]], unknowns_[v[1]], unknowns_[v[2]], unknowns_[v[3]]});
  }
  return result;
}

double ElasticBody::energy(const std::vector<Vec3>& displacements) const {
  double sum = 0;
  for (const Element& element : elements_) {
    sum += element.volume * element.tissue.energy(displacement_gradient(element, displacements));
  }
  return sum;
}

std::vector<Vec3> ElasticBody::gradient(const std::vector<Vec3>& displacements) const {
  std::vector<Vec3> result(slot_count(), Vec3::Zero());
  for (const Element& element : elements_) {
    const Mat3 stress = element.volume * element.tissue.stress(displacement_gradient(element, displacements));
    for (std::size_t a = 0; a < 4; ++a) {
      result[element.vertices[a]] += stress * element.gradients.col(static_cast<Eigen::Index>(a));
    }
  }
  return result;
}

BlockMatrix ElasticBody::hessian(const std::vector<Vec3>& displacements, bool is_projected) const {
  BlockMatrix result = hessian_pattern_;
  for (const Element& element : elements_) {
    Mat9 stiffness = element.tissue.stiffness(displacement_gradient(element, displacements));
    if (is_projected) stiffness = without_negative_part(stiffness);
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < 4; ++b) {
        const std::uint32_t row = unknowns_[element.vertices[a]];
        const std::uint32_t column = unknowns_[element.vertices[b]];
        if (row == kInvalidIndex || column == kInvalidIndex) continue;
        result.at(row, column) +=
            corner_block(element, stiffness, static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
      }
    }
  }
  return result;
}

std::uint32_t ElasticBody::find_loose(const std::vector<VertexId>& held) const {
  Parts parts(slot_count());
  for (const Element& element : elements_) {
    for (std::size_t a = 1; a < 4; ++a) parts.join(element.vertices[0], element.vertices[a]);
  }
  std::vector<std::uint32_t> carried(slot_count(), 0);
  for (const VertexId vertex : held) ++carried[parts.root(vertex.value)];
  for (std::uint32_t slot = 0; slot < slot_count(); ++slot) {
    if (masses_[slot] > 0 && carried[parts.root(slot)] < 3) return slot;
  }
  return kInvalidIndex;
}

}  // namespace v0
}  // namespace incise
