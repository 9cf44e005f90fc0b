// SPDX-License-Identifier: Apache-2.0
// Gauss and Seidel over tets and pulls in one order, in double precision: two constraints for each tet, one for each
// pull (docs/internals.md, 4).
#include "sim/body/position_based.h"

#include <Eigen/LU>
#include <cmath>

namespace incise {
inline namespace v0 {
namespace detail {

namespace {

class Projection {
 public:
  Projection(DeformableBody::State& state, double h) : s_(state), h_(h), x_(state.places.size()) {}

  void run() {
    start();
    for (unsigned i = 0; i < s_.options.iterations; ++i) {
      for (std::size_t t = 0; t < strains_.size(); ++t) {
        swell(strains_[t]);
        stretch(strains_[t]);
      }
      for (std::size_t t = 0; t < s_.terms.size(); ++t) pull(s_.terms[t], pull_multipliers_[t]);
    }
    finish();
  }

 private:
  struct Strain {
    TetVertices v;
    Mat3 to_rest;                   // inverse of the edges from corner 0 at rest
    double mu_v, lambda_v;          // times the volume
    double wanted;                  // det F where the bulk part is at rest
    double swell = 0, stretch = 0;  // multipliers
  };

  void start() {
    for (std::uint32_t v = 0; v < x_.size(); ++v) {
      const float* f = s_.single(VertexId(v));
      x_[v] = Vec3(static_cast<double>(f[0]), static_cast<double>(f[1]), static_cast<double>(f[2]));
    }
    weights_.assign(x_.size(), 0.0);
    s_.for_each_awake([&](std::uint32_t v) {
      weights_[v] = 1 / s_.masses()[v];
      const Motion& motion = s_.motions[VertexId(v)];
      for (unsigned i = 0; i < 3; ++i) {
        x_[v].data()[i] = static_cast<double>(motion.start[i]) + static_cast<double>(motion.aim[i]);
      }
    });
    for (std::uint32_t t = 0; t < s_.tets.size(); ++t) {
      if (s_.tets[TetId(t)][0].is_valid()) take_up(TetId(t));
    }
    pull_multipliers_.assign(s_.terms.size(), Vec3::Zero());
  }

  void take_up(TetId t) {
    Strain strain;
    strain.v = s_.tets[t];
    double free = 0;
    for (const VertexId v : strain.v) free += weights_[v.value];
    if (free == 0) return;
    const Material& material = s_.materials.of(s_.regions[t]);
    const auto p = s_.corners_at_rest(t);
    Mat3 edges;
    for (unsigned i = 0; i < 3; ++i) edges.col(static_cast<Eigen::Index>(i)) = p[i + 1] - p[0];
    strain.to_rest = edges.inverse();
    const double volume = six_volumes(p) / 6;
    strain.mu_v = material.mu() * s_.unit() * volume;
    strain.lambda_v = (material.lambda() + material.mu()) * s_.unit() * volume;  // the energy's own λ
    strain.wanted = 1 + strain.mu_v / strain.lambda_v;
    strains_.push_back(strain);
  }

  [[nodiscard]] Mat3 gradient(const TetVertices& v, const Mat3& to_rest) const {
    Mat3 edges;
    for (unsigned i = 0; i < 3; ++i) edges.col(static_cast<Eigen::Index>(i)) = x_[v[i + 1].value] - x_[v[0].value];
    return edges * to_rest;
  }

  void stretch(Strain& strain) {
    const Mat3 f = gradient(strain.v, strain.to_rest);
    const double norm = f.norm();
    if (norm > 0) solve(strain, Mat3(f / norm), norm, strain.mu_v, strain.stretch);
  }
  void swell(Strain& strain) {
    const Mat3 f = gradient(strain.v, strain.to_rest);
    Mat3 cofactor;
    for (Eigen::Index i = 0; i < 3; ++i) cofactor.col(i) = f.col((i + 1) % 3).cross(f.col((i + 2) % 3));
    solve(strain, cofactor, f.determinant() - strain.wanted, strain.lambda_v, strain.swell);
  }
  /// One XPBD correction of a constraint with value `c` and derivative `by_f` in the deformation gradient.
  void solve(const Strain& strain, const Mat3& by_f, double c, double stiffness, double& multiplier) {
    const Mat3 slopes = by_f * strain.to_rest.transpose();
    std::array<Vec3, 4> slope;
    slope[0] = -(slopes.col(0) + slopes.col(1) + slopes.col(2));
    for (unsigned i = 0; i < 3; ++i) slope[i + 1] = slopes.col(static_cast<Eigen::Index>(i));
    const double compliance = 1 / (stiffness * h_ * h_);
    double sum = compliance;
    for (unsigned i = 0; i < 4; ++i) sum += weights_[strain.v[i].value] * slope[i].squaredNorm();
    const double more = -(c + compliance * multiplier) / sum;
    multiplier += more;
    for (unsigned i = 0; i < 4; ++i) x_[strain.v[i].value] += weights_[strain.v[i].value] * more * slope[i];
  }

  void pull(const PullTerm& term, Vec3& multiplier) {
    if (term.stiffness <= 0) return;
    Vec3 off = -term.target;
    double sum = 1 / (term.stiffness * h_ * h_);
    const double compliance = sum;
    for (unsigned i = 0; i < term.corners; ++i) {
      if (term.weights[i] == 0) continue;
      off += term.weights[i] * x_[term.vertices[i]];
      sum += weights_[term.vertices[i]] * term.weights[i] * term.weights[i];
    }
    if (term.is_tie()) {
      const double length = off.norm();
      if (length > 0) off *= (length - term.rest_length) / length;
      if (term.pulls_only && length <= term.rest_length) return;
    }
    if (term.has_axis) off = term.axis.dot(off) * term.axis;
    if (term.pushes_only && term.axis.dot(off) >= 0) return;
    const Vec3 before = multiplier;
    multiplier -= (off + compliance * multiplier) / sum;
    const double most = term.limit * h_ * h_;  // multipliers are forces times h²
    if (multiplier.norm() > most) multiplier *= most / multiplier.norm();
    const Vec3 more = multiplier - before;
    for (unsigned i = 0; i < term.corners; ++i) {
      if (term.weights[i] != 0) x_[term.vertices[i]] += weights_[term.vertices[i]] * term.weights[i] * more;
    }
  }

  void finish() {
    s_.for_each_awake([&](std::uint32_t v) {
      if (!x_[v].allFinite()) return;
      for (unsigned i = 0; i < 3; ++i) s_.single(VertexId(v))[i] = static_cast<float>(x_[v].data()[i]);
    });
  }

  DeformableBody::State& s_;
  double h_;
  std::vector<Vec3> x_;
  std::vector<double> weights_;  // inverse masses; 0 for what does not move
  std::vector<Strain> strains_;
  std::vector<Vec3> pull_multipliers_;
};

}  // namespace

void project(DeformableBody::State& state, double h) {
  Projection(state, h).run();
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
