// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "cut/closed_complex.h"

namespace incise {
inline namespace v0 {

/// The lines in which the cut meets the sides of a master that the blade is still in: pairs of template codes. From
/// split point to split point in an even side, from split points to the front point in an odd one; a corner that takes
/// part in the cut stands for all crossings that it absorbed, and lines met twice are none.
class IncisionLines {
 public:
  /// Both must outlive the object. Cost: O(1).
  IncisionLines(const Master& master, const ClosedComplex& complex);

  [[nodiscard]] bool contains(std::uint8_t a, std::uint8_t b) const { return ((unsigned{to_[a]} >> b) & 1U) != 0; }

 private:
  [[nodiscard]] std::uint8_t crossing_of(unsigned edge) const;
  [[nodiscard]] bool is_on(std::uint8_t corner) const { return ((unsigned{master_.on} >> corner) & 1U) != 0; }
  [[nodiscard]] std::uint64_t rank(std::uint8_t corner) const { return complex_.rank(master_.vertices[corner]); }
  void add_side(unsigned side);
  void toggle(std::uint8_t a, std::uint8_t b);

  const Master& master_;
  const ClosedComplex& complex_;
  std::array<std::uint16_t, SplitTemplate::kCodes> to_{};  // by code: those that lines go to from there, as bits
};

}  // namespace v0
}  // namespace incise
