// SPDX-License-Identifier: Apache-2.0
// One tet of stable neo-Hookean tissue, ψ = μ/2 (|F|² − 3) + λ/2 (J − 1)² − μ (J − 1), split into what each corner sees
// of it (Smith et al. 2018 for the energy, whose λ is Lamé's + μ; Chen et al. 2024 for block descent). Linear in the
// corner:
//   stretch  Σ_j laplacian(i, j) x_j, a constant finite-element Laplacian;
//   swelling (bulk · V − pressure) n, V six volumes as they stand, n their slope in the corner.
//
// Tissue that stiffens as it is strained has the energy W = μ/2b [(1 + Q/8)⁸ − 1], Q = 2bψ/μ, instead: as good as
// Fung's exponential of a quadratic energy (Fung 1967, μ/2b [exp Q − 1]) up to Q of 2 or so, and of Knowles' power-law
// form (1977) beyond, so that it neither needs an exponential nor runs out of numbers. All slopes are those of ψ times
// (1 + Q/8)⁷. ψ holds the volume, too: a tet that is pressed flat stiffens like one that is drawn out.
//
// Fibres along a at rest add k/2 (|F a| − 1)² to ψ where they are longer than at rest: F a = Σ_j (∇φj·a) x_j, so that
// the part of each corner is a number. Transversely isotropic, as in Spencer (1972) and Weiss et al. (1996), with the
// simplest energy that only pulls.
//
// Where tissue relaxes (material.h, `prony`) a part of the stretch is seen from a metric B that flows after C⁻¹ (Reese
// and Govindjee 1998; here det B = 1): tr(C B) for |F|². Seen from a corner that is a Laplacian as well.
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
  double offset = 0;                  ///< what ψ is at rest
  double stiffening = 0;              ///< Q/8 by the tet's energy ψ; 0: it does not stiffen
  std::array<double, 4> along{};      ///< Σ along · corners: F a of the fibres
  double fibre = 0;                   ///< V k of the fibres; 0: there are none
};

/// What stiffening does to a tet of energy ψ: its energy, by how much its slopes are greater, and how that grows with
/// ψ.
struct Stiffened {
  double energy = 0, factor = 1, growth = 0;
};
[[nodiscard]] Stiffened stiffened(const Element& element, double energy);

/// The element of a tet with rest positions `p`, positive; `lambda` and `mu` in the units of energy per cubed length.
/// A tet thinner than `thinnest` of its longest edge is as soft as a layer that thick would be: slivers would hold the
/// descent up for hundreds of sweeps otherwise. `shared`: what its vertices resist with as one (`NodalVolumes`),
/// besides `lambda`. One of less than `crumb` six volumes only resists stretch, and shrinks where nothing else holds
/// it: what it swells by as its corners move would hold or throw all around it. `stiffening`: of `Material`.
[[nodiscard]] Element element_of(const std::array<Vec3, 4>& p, double lambda, double mu, double thinnest,
                                 double crumb = 0, double shared = 0, double stiffening = 0);
/// The same, without its offset where it does not stiffen.
[[nodiscard]] Element slopes_of(const std::array<Vec3, 4>& p, double lambda, double mu, double thinnest,
                                double crumb = 0, double shared = 0, double stiffening = 0);

/// Whether the least altitude of a tet is below a share of its longest edge.
[[nodiscard]] bool is_thinner(const std::array<Vec3, 4>& p, double thinnest);

/// Gives a tet at rest fibres of stiffness `young` (energy per cubed length) along `direction`, of any length but 0.
void add_fibres(const std::array<Vec3, 4>& p, const Vec3& direction, double young, double thinnest, Element& element);

/// A symmetric metric: xx xy xz yy yz zz.
using Metric = std::array<double, 6>;
/// Takes a share `mu` of the stretch of a tet at rest at `p` with the metric instead of the unit one.
void set_metric(const std::array<Vec3, 4>& p, double mu, double thinnest, const Metric& metric, Element& element);
/// The metric without stress at a deformation: C⁻¹ with determinant 1. The unit one where it is turned inside out.
[[nodiscard]] Metric relaxed_metric(const std::array<Vec3, 4>& rest, const std::array<Vec3, 4>& now);
/// `from`, gone on to `to` by a share in [0, 1], with determinant 1. Its stress never stores more than before.
[[nodiscard]] Metric flowed(const Metric& from, const Metric& to, double share);
/// exp(−x) to 1e-12, without libm.
[[nodiscard]] double decay(double x);

/// Six volumes of a tet, positive where it is not turned inside out.
inline double six_volumes(const std::array<Vec3, 4>& p) {
  return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
}

/// How six volumes change with corner `i`.
inline Vec3 volume_slope(const std::array<Vec3, 4>& p, unsigned i) {
  const auto& [a, b, c] = kSideCorners[i];
  return -(p[b] - p[a]).cross(p[c] - p[a]);
}

/// ψ of a tet as it stands, 0 at rest.
[[nodiscard]] double soft_energy_of(const Element& element, const std::array<Vec3, 4>& p);
/// The energy of a tet as it stands, 0 at rest.
[[nodiscard]] double energy_of(const Element& element, const std::array<Vec3, 4>& p);
/// The energy's slope in corner `i`.
[[nodiscard]] Vec3 slope_of(const Element& element, const std::array<Vec3, 4>& p, unsigned i);
/// Its curvature there.
[[nodiscard]] Mat3 stiffness_at(const Element& element, const std::array<Vec3, 4>& p, unsigned i);

}  // namespace detail
}  // namespace v0
}  // namespace incise
