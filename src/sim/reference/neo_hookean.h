// SPDX-License-Identifier: Apache-2.0
// Stable neo-Hookean tissue, in the gradient of displacement H = F - 1, so that small strains lose no digits.
//
// psi = μ/2 (|F|² - 3) - μ (J - 1) + λ'/2 (J - 1)², which is μ/2 (|F|² - 3) + λ'/2 (J - α)² with α = 1 + μ/λ', up to a
// constant. **Source:** B. Smith, F. de Goes, T. Kim, "Stable neo-Hookean flesh simulation", 2018, sections 3.3
// and 3.4, without the logarithm.
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "incise/geom/vec.h"
#include "incise/sim/material.h"

namespace incise {
inline namespace v0 {

using Mat3 = Eigen::Matrix3d;
using Mat9 = Eigen::Matrix<double, 9, 9>;

/// The two stiffnesses of the energy, Pa.
struct NeoHookean {
  double mu = 0;
  double lambda = 0;  ///< λ' = λ + μ of Lamé, above 0: the energy's own α term takes μ away again at small strains

  NeoHookean() = default;
  /// Chosen so that small strains have the material's Young's modulus and Poisson's ratio. With Lamé's λ itself the
  /// energy has no minimum at rest below Poisson's ratio 1/8, and is unbounded at 0. `scale` softens.
  NeoHookean(const Material& material, double scale)
      : mu(scale * material.mu()), lambda(scale * (material.lambda() + material.mu())) {}

  /// Energy per rest volume, J/m³; 0 at rest.
  [[nodiscard]] double energy(const Mat3& h) const;
  /// The first Piola–Kirchhoff stress ∂psi/∂F, Pa.
  [[nodiscard]] Mat3 stress(const Mat3& h) const;
  /// ∂²psi/∂F², Pa, for F column by column; indefinite where the tet is squeezed or inverted.
  [[nodiscard]] Mat9 stiffness(const Mat3& h) const;
};

/// The second invariant (sum of the principal 2×2 minors).
inline double second_invariant(const Mat3& h) {
  return h(0, 0) * h(1, 1) - h(0, 1) * h(1, 0) + h(1, 1) * h(2, 2) - h(1, 2) * h(2, 1) + h(0, 0) * h(2, 2) -
         h(0, 2) * h(2, 0);
}

/// The matrix of cofactors: the gradient of the determinant.
inline Mat3 cofactors(const Mat3& f) {
  Mat3 result;
  result << f.col(1).cross(f.col(2)), f.col(2).cross(f.col(0)), f.col(0).cross(f.col(1));
  return result;
}

/// det(1 + h) - 1.
inline double dilation(const Mat3& h) {
  return h.trace() + second_invariant(h) + h.determinant();
}

inline double NeoHookean::energy(const Mat3& h) const {
  const double j = dilation(h);
  // The linear terms of |F|² - 3 and of J - 1 cancel.
  return mu * (0.5 * h.squaredNorm() - second_invariant(h) - h.determinant()) + 0.5 * lambda * j * j;
}

inline Mat3 NeoHookean::stress(const Mat3& h) const {
  const Mat3 inner = h.trace() * Mat3::Identity() - h.transpose() + cofactors(h);  // cofactors of F, less 1
  return mu * (h - inner) + lambda * dilation(h) * (Mat3::Identity() + inner);
}

inline Mat9 NeoHookean::stiffness(const Mat3& h) const {
  const auto cross = [](const Vec3& v) {
    Mat3 m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
  };
  const Mat3 f = h + Mat3::Identity();
  const Mat3 cof = cofactors(f);
  const Eigen::Map<const Eigen::Matrix<double, 9, 1>> g(cof.data());
  const double twist = lambda * dilation(h) - mu;
  Mat9 result = mu * Mat9::Identity() + lambda * g * g.transpose();
  for (Eigen::Index i = 0; i < 3; ++i) {
    // The determinant's second derivative by columns i and i+1 is minus the cross product with column i+2.
    const Eigen::Index j = (i + 1) % 3;
    const Mat3 block = twist * cross(f.col((i + 2) % 3));
    result.block<3, 3>(3 * i, 3 * j) -= block;
    result.block<3, 3>(3 * j, 3 * i) += block;
  }
  return result;
}

/// The nearest matrix without negative eigenvalues.
inline Mat9 without_negative_part(const Mat9& m) {
  const Eigen::SelfAdjointEigenSolver<Mat9> eigen(m);
  if (eigen.eigenvalues()[0] >= 0) return m;
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace v0
}  // namespace incise
