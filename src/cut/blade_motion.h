// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "cut/border_reach.h"
#include "cut/front_course.h"
#include "cut/strip.h"

namespace incise {
inline namespace v0 {

/// Turns the rows of a blade, one after the other, into the strips to cut along. All in the rest shape.
///
/// Points of the blade that move in the stroke's own slit, or hardly at all, are held: the front stays where it is
/// there, and the next strip starts from it. So does the whole blade while it is within a spacing of what it has swept
/// and does not get on along the way that its front has come. So a blade may tremble, pause, turn back, withdraw and
/// come again. Strips share the points of the rows between them, keys included, so that every mesh edge sees one
/// surface without seams.
class BladeMotion {
 public:
  /// What a row asks for.
  struct Move {
    std::unique_ptr<Strip> strip;  ///< null where the blade is held
    bool starts_anew = false;      ///< the strip is the first of a new sheet: the one so far must be finished
    bool is_full_turn = false;     ///< the strip comes round to where the stroke began
  };

  /// Starts a stroke at a row of at least 2 points. `spacing`: the length of a typical edge, for all tolerances.
  void begin(std::span<const Vec3> row, double spacing);
  /// Starts a stroke where the one before ended: its points that stand where that one's front does keep their keys, so
  /// that the sheets of both have no seam.
  void go_on(std::span<const Vec3> row, double spacing);
  /// Starts where a sheet that was laid elsewhere has ended: at its points, so that one that goes on from it has no
  /// seam with it. None of its keys may reach `next_key`.
  void begin_at(std::vector<SosPoint> front, std::uint64_t next_key, double spacing);
  /// After `begin_at`: that sheet is this stroke's own. Its last strip came from a row of as many points.
  void note_laid(std::span<const Vec3> before);
  /// Whether a surface meets the body.
  using Touches = std::function<bool(const SweptSurface&)>;
  /// The strip to the next row, with as many points. Ends that pass an older wall by very little draw back to just
  /// before it. `flushes`: holds nothing merely because it moved too little.
  Move advance(std::span<const Vec3> given, const OwnSheet& sheet, const Touches& touches, const Surroundings& around,
               bool flushes);
  /// A row that was chosen elsewhere, with the surface from the front to it; for `accept`.
  struct Proposal {
    std::vector<SosPoint> row;
    SweptSurface surface;
  };
  [[nodiscard]] Proposal propose(std::span<const Vec3> row);
  /// The strip to a proposed row, without asking whether the blade is in its slit or the sheet meets itself.
  std::unique_ptr<Strip> accept(const Proposal& proposal, const Surroundings& around) {
    return move_to(proposal.row, around).strip;
  }
  /// Divides the segments of the front, and of all rows to come, at shares of their lengths, the last one 1.
  void refine(const std::vector<std::vector<double>>& shares);
  [[nodiscard]] std::vector<Vec3> front() const { return places_of(front_); }
  /// Where it was before the last strip.
  [[nodiscard]] std::vector<Vec3> before() const { return places_of(before_); }
  /// Whether no strip was laid yet.
  [[nodiscard]] bool is_at_start() const { return is_first_strip_; }

  /// Where the last strip came round to the stroke's beginning: the next one of those over its first strips, once more,
  /// as far as a sheet overlaps another one. Where the blade has turned at its beginning both walls end an element
  /// before it. Null where there are none, or no more.
  Move go_over_beginning(const Surroundings& around);

  /// The strip that is left over at the end: to the last row, as far as it was held for moving too little.
  Move end(const OwnSheet& sheet, const Touches& touches, const Surroundings& around);
  /// The last strip once more, as the first of a new sheet: for one that meets what was swept before. The sheet so far
  /// must be finished first, and is an older cut to the new one.
  std::unique_ptr<Strip> lay_anew(const Surroundings& around);
  /// The next strip is the first of a new sheet, which goes on from the front. The sheet so far must be finished first.
  void begin_anew() { start_sheet(Row(front_)); }
  /// The strip by which the front reaches on into older cuts that begin there, once the blade goes no further.
  Move reach_on(const Surroundings& around);

 private:
  using Row = std::vector<SosPoint>;
  using Segments = std::vector<std::array<std::uint64_t, 2>>;

  [[nodiscard]] static std::vector<Vec3> places_of(const Row& row);
  [[nodiscard]] Row number(std::span<const Vec3> row);
  [[nodiscard]] bool goes_in_slit(const Vec3& from, const Vec3& to, const OwnSheet& sheet) const;
  [[nodiscard]] bool comes_round(const Row& to, const OwnSheet& sheet) const;
  void note_beginning(const Row& to);
  [[nodiscard]] bool comes_to_beginning(const Row& to) const;
  [[nodiscard]] bool is_on(const Vec3& point, const OwnSheet& sheet, double distance) const;
  [[nodiscard]] double distance2_to_front(const Vec3& point) const;
  [[nodiscard]] double furthest_from(const OwnSheet& sheet, const Vec3& from, const Vec3& to) const;
  [[nodiscard]] bool closes_ring(std::span<const std::size_t> points, std::span<const Vec3> row,
                                 const OwnSheet& sheet) const;
  [[nodiscard]] bool waits(std::span<const std::size_t> points, std::span<const Vec3> row, const OwnSheet& sheet,
                           bool flushes) const;
  [[nodiscard]] bool comes_by_front(std::span<const std::size_t> points, std::span<const Vec3> to) const;
  [[nodiscard]] SweptSurface lay(const Row& from, const Row& to) const;
  [[nodiscard]] bool meets(const SweptSurface& surface, const OwnSheet& sheet) const;
  [[nodiscard]] std::vector<std::array<std::uint64_t, 2>> inner_segments(const Row& to) const;
  Move leave_slit(std::span<const Vec3> row, const OwnSheet& sheet, const Touches& touches, const Surroundings& around);
  [[nodiscard]] double retreat_of(std::span<const Vec3> from, std::span<const Vec3> row, std::size_t c,
                                  const Surroundings& around) const;
  void stay_before_walls(std::span<const Vec3> from, std::vector<Vec3>& row, const Surroundings& around) const;
  [[nodiscard]] std::vector<Vec3> drawn_back(std::span<const Vec3> row, const Surroundings& around) const;
  void note_swept(const Row& to);
  void leave_behind(const Row& row);
  [[nodiscard]] Row divided_row(const Row& row, const std::vector<std::vector<double>>& shares);
  Move move_to(const Row& to, const Surroundings& around);
  void start_sheet(const Row& from);
  void reach_back(SweptSurface& surface, const Surroundings& around);
  std::vector<std::size_t> reach_from_row(SweptSurface& surface, const Row& row, std::span<const Vec3> outwards,
                                          const Surroundings& around);
  void reach_from_ends(SweptSurface& surface, const Row& to, const Surroundings& around, Segments& inner);

  double spacing_ = 1.0;
  std::uint64_t next_key_ = kFirstBladeKey;
  Row front_, before_;                // now; before the last strip
  std::vector<bool> is_swept_;        // by column: the front there is the end of a strip
  std::vector<Vec3> last_;            // where the blade was last
  std::vector<Vec3> left_;            // by point: where it was last in its slit or at the front
  std::vector<Vec3> ways_;            // by point: how it moved last
  std::vector<Row> trail_;            // the last rows behind the front, oldest first
  std::vector<Row> beginning_;        // the first rows of the stroke
  std::size_t next_over_ = 0;         // of these, to go over next; 0: none
  FrontCourse course_;                // the way that the front has come
  std::array<SosPoint, 2> ends_;      // where the ends of the front reach on to, into an older cut
  std::array<bool, 2> reaches_on_{};  // whether they do
  SweptSurface seams_;                // between the front as it was and as it is divided now
  std::vector<std::array<std::uint64_t, 2>> seam_segments_;
  bool is_first_strip_ = true;
  bool starts_at_wall_ = false;  // the sheet: at one of an earlier sheet of this stroke
  bool is_closed_ = false;       // the edge is a ring
};

}  // namespace v0
}  // namespace incise
