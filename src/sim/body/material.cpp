// SPDX-License-Identifier: Apache-2.0
// Bounds of what a material may be, and which one a region has; a message names whose number is wrong.
#include "incise/sim/material.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/body/bounds.h"

namespace incise {
inline namespace v0 {

namespace {

Status check(const Material& material, const std::string& whose) {
  const auto bad = [&](const char* what) { return Error{ErrorCode::kBadArgument, whose + ": " + what, {}}; };
  if (!detail::is_real_size(material.density)) return bad("the density must be above 0 kg/m³, at most 1e+30");
  if (!detail::is_real_size(material.young)) return bad("Young's modulus must be above 0 Pa, at most 1e+30");
  if (!(material.poisson >= 0 && material.poisson <= 0.499)) return bad("Poisson's ratio must lie in [0, 0.499]");
  if (!detail::is_size(material.toughness)) return bad("the toughness must be at least 0 J/m², at most 1e+30");
  if (!detail::is_size(material.cut_friction)) {
    return bad("the friction of cutting must be at least 0 N/m, at most 1e+30");
  }
  if (!(material.stiffening >= 0 && material.stiffening <= 100)) return bad("the stiffening must lie in [0, 100]");
  if (!detail::is_size(material.fibre_young)) {
    return bad("what fibres add to Young's modulus must be at least 0 Pa, at most 1e+30");
  }
  const auto [x, y, z] = material.fibre;
  const double length2 = x * x + y * y + z * z;
  if (!std::isfinite(length2) || (material.fibre_young > 0 && !(length2 > 0))) {
    return bad("fibres need a direction that is not zero");
  }
  for (const PronyTerm& term : material.prony) {
    if (!(term.share >= 0 && term.share <= 100)) return bad("the share of a Prony term must lie in [0, 100]");
    if (term.share > 0 && !(term.seconds >= 1e-4 && term.seconds <= 1e4)) {
      return bad("a Prony term must relax within 1e-4 to 1e4 s");
    }
  }
  if (!(material.rupture >= 0 && material.rupture <= 0.5)) return bad("the rupture must lie in [0, 0.5]");
  return {};
}

}  // namespace

const Material& Materials::of(std::int32_t region) const {
  const auto entry =
      std::find_if(by_region.begin(), by_region.end(), [&](const Entry& e) { return e.region == region; });
  return entry == by_region.end() ? fallback : entry->material;
}

Status check(const Materials& materials) {
  if (Status status = check(materials.fallback, "the material of all other regions"); !status) return status;
  for (std::size_t i = 0; i < materials.by_region.size(); ++i) {
    const std::int32_t region = materials.by_region[i].region;
    const std::string whose = "the material of region " + std::to_string(region);
    if (Status status = check(materials.by_region[i].material, whose); !status) return status;
    for (std::size_t j = 0; j < i; ++j) {
      if (materials.by_region[j].region == region) return Error{ErrorCode::kBadArgument, whose + " is given twice", {}};
    }
  }
  return {};
}

}  // namespace v0
}  // namespace incise
