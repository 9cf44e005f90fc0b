// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "incise/sim/material.h"

namespace incise {
inline namespace v0 {

/// A tissue with parameters from published measurements; docs/tissues.md names the sources.
struct Tissue {
  std::string_view name;  ///< lower case, for instance "liver"
  Material material;      ///< in SI units
  /// Which numbers are a reading, not a measurement of this tissue: bits of `TissueNumber`.
  unsigned readings = 0;
};

/// The numbers of a `Tissue`, as bits.
enum TissueNumber : std::uint8_t {
  kTissueDensity = 1U,
  kTissueYoung = 2U,
  kTissuePoisson = 4U,
  kTissueToughness = 8U,
  kTissueFriction = 16U,
};

/// All tissues, in the order of the table of docs/tissues.md.
[[nodiscard]] std::span<const Tissue> tissues();

/// The tissue of a name, in upper or lower case; null where there is none.
[[nodiscard]] const Tissue* find_tissue(std::string_view name);

/// The tissue that the name of a region speaks of, by its words: "left kidney", "Subcutaneous_Fat" and "vertebrae_L1"
/// are kidney, fat and bone; of "liver tumor" and "liver vessels" the disease and the vessel count. Null where no word
/// is known.
[[nodiscard]] const Tissue* tissue_of_region_name(std::string_view name);

}  // namespace v0
}  // namespace incise
