// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "incise/core/result.h"

namespace incise {
inline namespace v0 {

/// A spring and a dashpot in a row, beside the tissue's own stiffness: one term of a Prony series.
struct PronyTerm {
  double share = 0;    ///< of the shear modulus, which it adds at once, in [0, 100]; 0: there is none
  double seconds = 0;  ///< in which its stress falls to 1/e where the strain stays, in [1e-4, 1e4]
};

/// What tissue is made of, in SI units.
struct Material {
  double density = 1000;    ///< kg/m³, above 0
  double young = 10e3;      ///< Young's modulus, Pa, above 0; soft tissue has about 1e3 to 1e6
  double poisson = 0.45;    ///< Poisson's ratio, in [0, 0.499]
  double toughness = 0;     ///< fracture toughness, J/m² of cut face, at least 0; 0: a blade meets no resistance
  double cut_friction = 0;  ///< N per metre of engaged edge while the blade cuts on, at least 0
  /// How fast the tissue stiffens as it is strained, b in [0, 100]; 0: neo-Hookean at any strain. With ψ the
  /// neo-Hookean energy and μ the shear modulus, all stresses are (1 + 2bψ / 8μ)⁷ times what they were without.
  double stiffening = 0;
  /// Share by which a front at rest bears more than a mean one, and one that runs less, in [0, 0.5]; skin that is not
  /// open yet bears more by twice that. The mean force of cutting is the same for all.
  double rupture = 0;
  /// Where fibres run in the rest shape, of any length but 0 where there are any.
  std::array<double, 3> fibre{};
  /// What they add to Young's modulus along them, Pa, at least 0; 0: no fibres. They only pull: at the stretch s along
  /// them ψ has fibre_young/2 (s − 1)² more where s > 1. They stiffen with the rest.
  double fibre_young = 0;
  /// Of a shear modulus μ (1 + Σ share exp(−t / seconds)) at t after a sudden strain; `young` is that of tissue at
  /// rest. Volume does not relax. Each frame relaxes the stresses of the one before.
  std::array<PronyTerm, 3> prony{};
  /// Bone: it moves, and does not deform, where it hangs together. `young` counts in contact alone.
  bool rigid = false;

  /// Lamé's first parameter λ, Pa.
  [[nodiscard]] double lambda() const { return young * poisson / ((1 + poisson) * (1 - 2 * poisson)); }
  /// The shear modulus μ, Pa.
  [[nodiscard]] double mu() const { return young / (2 * (1 + poisson)); }
  /// Whether any Prony term acts.
  [[nodiscard]] bool is_viscous() const { return prony[0].share > 0 || prony[1].share > 0 || prony[2].share > 0; }
};

/// A material for each region label of a mesh.
struct Materials {
  /// The material of one region.
  struct Entry {
    std::int32_t region = 0;  ///< label of the tets
    Material material;        ///< what they are made of
  };

  Material fallback;             ///< of every region that `by_region` does not name
  std::vector<Entry> by_region;  ///< each region once

  /// The material of a region; `fallback` where it has no entry.
  [[nodiscard]] const Material& of(std::int32_t region) const;
};

/// Errors: kBadArgument names the first number that is out of its range, or a region that is named twice.
[[nodiscard]] Status check(const Materials& materials);

}  // namespace v0
}  // namespace incise
