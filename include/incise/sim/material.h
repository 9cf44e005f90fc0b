// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "incise/core/result.h"

namespace incise {
inline namespace v0 {

/// What tissue is made of, in SI units.
struct Material {
  double density = 1000;    ///< kg/m³, above 0
  double young = 10e3;      ///< Young's modulus, Pa, above 0; soft tissue has about 1e3 to 1e6
  double poisson = 0.45;    ///< Poisson's ratio, in [0, 0.499]
  double toughness = 0;     ///< fracture toughness, J/m² of cut face, at least 0; 0: a blade meets no resistance
  double cut_friction = 0;  ///< N per metre of engaged edge while the blade cuts on, at least 0

  /// Lamé's first parameter λ, Pa.
  [[nodiscard]] double lambda() const { return young * poisson / ((1 + poisson) * (1 - 2 * poisson)); }
  /// The shear modulus μ, Pa.
  [[nodiscard]] double mu() const { return young / (2 * (1 + poisson)); }
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
