// SPDX-License-Identifier: Apache-2.0
// One tet of stable neo-Hookean tissue, ψ = μ/2 (|F|² − 3) + λ/2 (J − 1)² − μ (J − 1), split into what each corner sees
// of it (Smith et al. 2018 for the energy, whose λ is Lamé's + μ; Chen et al. 2024 for block descent). Linear in the
// corner:
//   stretch  Σ_j laplacian(i, j) x_j, a constant finite-element Laplacian;
//   swelling (bulk · V − pressure) n, V six volumes as they stand, n their slope in the corner.
#pragma once

#include <array>
#include <cstdint>

#include "incise/geom/vec.h"
#include "incise/mesh/tet_tables.h"

namespace incise {
inline namespace v0 {
namespace detail {

struct Element {
  std::array<double, 6> laplacian{};  ///< by edge: μ V ∇φi·∇φj
  double bulk = 0;                    ///< λ / (36 V), by the square of six volumes
  double pressure = 0;                ///< (λ + μ) / 6
  double give = 0;                    ///< six volumes by the stiffness that its vertices share: 0: they share none
  double offset = 0;                  ///< what the energy below is at rest
};

/// The element of a tet with rest positions `p`, positive; `lambda` and `mu` in the units of energy per cubed length.
/// A tet thinner than `thinnest` of its longest edge is as soft as a layer that thick would be: slivers would hold the
/// descent up for hundreds of sweeps otherwise. `shared`: what its vertices resist with as one (`NodalVolumes`),
/// besides `lambda`. One of less than `crumb` six volumes only resists stretch, and shrinks where nothing else holds
/// it: what it swells by as its corners move would hold or throw all around it.
[[nodiscard]] Element element_of(const std::array<Vec3, 4>& p, double lambda, double mu, double thinnest,
                                 double crumb = 0, double shared = 0);
/// The same, without its offset.
[[nodiscard]] Element slopes_of(const std::array<Vec3, 4>& p, double lambda, double mu, double thinnest,
                                double crumb = 0, double shared = 0);

/// Six volumes of a tet, positive where it is not turned inside out.
inline double six_volumes(const std::array<Vec3, 4>& p) {
  return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
}

/// How six volumes change with corner `i`.
inline Vec3 volume_slope(const std::array<Vec3, 4>& p, unsigned i) {
  const auto& [a, b, c] = kSideCorners[i];
  return -(p[b] - p[a]).cross(p[c] - p[a]);
}

/// The energy of a tet as it stands, 0 at rest.
[[nodiscard]] double energy_of(const Element& element, const std::array<Vec3, 4>& p);
/// The energy's slope in corner `i`.
[[nodiscard]] Vec3 slope_of(const Element& element, const std::array<Vec3, 4>& p, unsigned i);

}  // namespace detail
}  // namespace v0
}  // namespace incise
