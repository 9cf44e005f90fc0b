// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "cut/strip.h"
#include "cut/sweep.h"

namespace incise {
inline namespace v0 {

/// What a cut goes along: what the blade swept last, and what it swept shortly before. Tets around a bend are crossed
/// by both: vertices that lie on the one, and edges that the cut itself makes, may meet the other.
class SheetSoFar {
 public:
  /// A sheet that is cut at once, and goes on from none.
  explicit SheetSoFar(const Sheet& sheet) : strip_(sheet), whole_(&sheet) {}
  /// The last strip of a sheet, and those before that it may share tets with; a sheet that is cut at once has one
  /// alone. Cost: they are put together.
  explicit SheetSoFar(const Strip& strip, std::span<const std::shared_ptr<const Strip>> before = {});
  SheetSoFar(const SheetSoFar&) = delete;
  SheetSoFar& operator=(const SheetSoFar&) = delete;

  /// What the blade swept last.
  [[nodiscard]] const Sheet& strip() const { return strip_; }
  /// The same with the strips before; its own triangles have the lowest numbers, as in `strip`.
  [[nodiscard]] const Sheet& whole() const { return *whole_; }
  /// Where the strip is the border of the sheet, where the blade stands among it.
  [[nodiscard]] std::span<const Strip::Segment> border() const { return border_; }
  /// Whether a triangle of `whole` is one of `strip`.
  [[nodiscard]] bool is_of_strip(std::uint32_t triangle) const { return triangle < strip_.triangle_count(); }

 private:
  const Sheet& strip_;
  std::span<const Strip::Segment> border_;
  SweptSurface together_;
  std::optional<Sheet> together_sheet_;
  const Sheet* whole_;
};

}  // namespace v0
}  // namespace incise
