// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "cut/strip.h"

namespace incise::inline v0 {

/// Turns the rows of a blade, one after the other, into the strips to cut along. All in the rest shape.
///
/// Points of the blade that move in the stroke's own slit, or hardly at all, are held: the front stays where it is
/// there, and the next strip starts from it. So a blade may tremble, pause, turn back, withdraw and come again.
/// Strips share the points of the rows between them, keys included, so that every mesh edge sees one surface without
/// seams.
class BladeMotion {
 public:
  /// What a row asks for.
  struct Move {
    std::unique_ptr<Strip> strip;  ///< null where the blade is held
    /// The sheet so far must be finished first: the strip meets it, and starts a new one.
    bool starts_anew = false;
    /// The strip passes so close to what was swept well before that both may cross one edge: where they do, the sheet
    /// must be finished first as well, and `anew` is cut instead.
    bool comes_near = false;
    std::unique_ptr<Strip> anew;
  };

  /// Starts a stroke at a row of at least 2 points. `spacing`: the length of a typical edge, for all tolerances.
  void begin(std::span<const Vec3> row, double spacing);
  /// Whether a surface meets the body.
  using Touches = std::function<bool(const SweptSurface&)>;
  /// The strip to the next row, with as many points. `flushes`: holds nothing merely because it moved too little.
  Move advance(std::span<const Vec3> row, const OwnSheet& sheet, const Touches& touches, bool flushes);
  /// A row that was chosen elsewhere, with the surface from the front to it; for `accept`.
  struct Proposal {
    std::vector<SosPoint> row;
    SweptSurface surface;
  };
  [[nodiscard]] Proposal propose(std::span<const Vec3> row);
  /// The strip to a proposed row, without asking whether the blade is in its slit or the sheet meets itself.
  std::unique_ptr<Strip> accept(const Proposal& proposal) { return move_to(proposal.row, nullptr).strip; }
  /// Divides the segments of the front, and of all rows to come, at shares of their lengths, the last one 1.
  void refine(const std::vector<std::vector<double>>& shares);
  [[nodiscard]] std::vector<Vec3> front() const;

  /// The strip that is left over at the end: to the last row, as far as it was held for moving too little.
  Move end(const OwnSheet& sheet, const Touches& touches);

 private:
  using Row = std::vector<SosPoint>;

  [[nodiscard]] Row number(std::span<const Vec3> row);
  [[nodiscard]] bool is_on(const Vec3& point, const OwnSheet& sheet, double distance) const;
  [[nodiscard]] double distance2_to_front(const Vec3& point) const;
  [[nodiscard]] bool would_cover(const Row& to, const OwnSheet& sheet) const;
  [[nodiscard]] bool returns_to_start(std::span<const Vec3> row) const;
  [[nodiscard]] SweptSurface lay(const Row& from, const Row& to) const;
  [[nodiscard]] bool meets(const SweptSurface& surface, const OwnSheet& sheet) const;
  [[nodiscard]] bool comes_near(const SweptSurface& surface, const OwnSheet& sheet) const;
  [[nodiscard]] std::unique_ptr<Strip> start_anew(const SweptSurface& surface, const OwnSheet& sheet) const;
  [[nodiscard]] SweptSurface with_overlap(const SweptSurface& surface, const OwnSheet& sheet) const;
  [[nodiscard]] std::vector<std::array<std::uint64_t, 2>> inner_segments(const Row& to) const;
  Move leave_slit(std::span<const Vec3> before, std::span<const Vec3> row, const Touches& touches);
  void note_swept(const Row& to);
  Move move_to(const Row& to, const OwnSheet* sheet);

  double spacing_ = 1.0;
  std::uint64_t next_key_ = kFirstBladeKey;
  Row first_, front_;
  std::vector<bool> is_swept_;  // by column: the front there is the end of a strip
  std::vector<Vec3> last_;      // where the blade was last
  Vec3 reach_lo_ = Vec3::Zero(), reach_hi_ = Vec3::Zero();
  SweptSurface seams_;  // between the front as it was and as it is divided now
  std::vector<std::array<std::uint64_t, 2>> seam_segments_;
  bool is_first_strip_ = true;
  bool is_held_ = false;    // wholly, in its own slit
  bool is_closed_ = false;  // the edge is a ring
};

}  // namespace incise::inline v0
