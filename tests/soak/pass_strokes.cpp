// SPDX-License-Identifier: Apache-2.0
#include "soak/pass_strokes.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "soak/sheet.h"
#include "support/strokes.h"

namespace incise::test {
namespace {

Frame axis_frame(Random& random) {
  const auto n = static_cast<Eigen::Index>(random.integer(0, 2)), b = (n + random.integer(1, 2)) % 3;
  return {Vec3::Unit(n), Vec3::Unit(3 - n - b), Vec3::Unit(b)};
}

Frame frame_of(Random& random) {
  return random.integer(0, 1) == 0 ? axis_frame(random) : random_frame(random);
}

/// Makes the passes of each kind on one sheet, or on two that cross.
class PassMaker {
 public:
  PassMaker(const AttackedBody& body, Random& random)
      : body_(body),
        random_(random),
        sheet_(body, frame_of(random), random),
        strokes_(kStrokes[static_cast<std::size_t>(random.integer(0, kStrokes.size() - 1))]),
        d_(body.diagonal),
        h_(body.edge) {}

  Attack make(std::size_t kind) { return kMakers[kind](*this); }

 private:
  // --- one plane

  /// Each over the last one and beyond it.
  Attack deeper() {
    const Span depths = {random_.real(-0.3, 0) * d_, sheet_.width.to};
    const auto count = static_cast<unsigned>(random_.integer(2, 3));
    for (unsigned i = 0; i < count; ++i) {
      const double depth = depths.at(static_cast<double>(i) / (count - 1));
      pass(sheet_, sheet_.way, {sheet_.width.from, depth});
    }
    return plane();
  }
  /// Each beside the last one.
  Attack slices() {
    const double at = random_.real(-0.3, 0.3) * d_;
    pass(sheet_, sheet_.way, {sheet_.width.from, at});
    pass(sheet_, sheet_.way, {at, sheet_.width.to});
    return plane();
  }
  Attack both_sides() {
    const double middle = sheet_.way.at(random_.real(0.3, 0.7)), over = random_.real(0, 1) * h_;
    pass(sheet_, {sheet_.way.from, middle + over}, sheet_.width);
    pass(sheet_, {sheet_.way.to, middle - over}, sheet_.width);
    return plane();
  }
  Attack overlap() {
    const double middle = sheet_.way.at(random_.real(0.3, 0.7)), over = random_.real(0.1, 2.5) * h_;
    pass(sheet_, {sheet_.way.from, middle}, sheet_.width);
    pass(sheet_, {middle - over, sheet_.way.to}, sheet_.width);
    return plane();
  }
  /// The second pass begins where the first one ended, and takes the rest of the plane on the way back.
  Attack back() {
    const double at = random_.real(-0.3, 0.3) * d_, over = random_.real(0, 1) * h_;
    pass(sheet_, sheet_.way, {sheet_.width.from, at + over});
    pass(sheet_, {sheet_.way.to, sheet_.way.from}, {at - over, sheet_.width.to});
    return plane();
  }
  /// A plane across the sheet is cut before the second pass: what it divides is known by the planes.
  Attack between() {
    const Sheet other = across();
    const double at = random_.real(-0.2, 0.2) * d_;
    pass(sheet_, sheet_.way, {sheet_.width.from, at});
    pass(other, other.way, other.width);
    pass(sheet_, sheet_.way, {at - random_.real(0, 1) * h_, sheet_.width.to});
    return star(other);
  }

  // --- two planes

  Attack cross() {
    const Sheet other = oblique();
    pass(sheet_, sheet_.way, sheet_.width);
    pass(other, other.way, other.width);
    return star(other);
  }
  /// The edge of the second pass ends on the first plane, or a little behind it.
  Attack tee() {
    const Sheet other = across();
    const double from = -(random_.integer(0, 1) == 0 ? 0.0 : random_.real(0, 0.1) * h_);
    pass(sheet_, sheet_.way, sheet_.width);
    pass(other, other.way, {from - sheet_.plane().height(other.q), other.width.to});
    if (body_.is_convex) {
      attack_.pieces = pieces_of_tee(body_.soup, sheet_.plane(), other.plane(), from, kThin * h_);
    }
    return std::move(attack_);
  }

  // --- what they share

  /// A plane across the sheet, through another point; its edge goes along the sheet's normal.
  Sheet across() { return {body_, Frame{sheet_.a, sheet_.n, sheet_.b}, random_}; }
  /// A plane that meets the sheet at 60 to 120 degrees.
  Sheet oblique() {
    const double turns = random_.real(60, 120) / 360;
    const Vec3 u = Sheet::turned(sheet_.a, sheet_.n, turns), n = Sheet::turned(sheet_.n, Vec3(-sheet_.a), turns);
    return {body_, Frame{n, u, sheet_.b}, sheet_.q};
  }
  void pass(const Sheet& sheet, const Span& way, const Span& width) {
    const unsigned steps = kSteps / strokes_;
    const Edges edges = sheet.sweep(way, steps * strokes_, width);
    for (unsigned i = 0; i < strokes_; ++i) {
      const auto from = edges.begin() + static_cast<std::ptrdiff_t>(i) * steps;
      Stroke stroke = stroke_of({from, from + steps + 1});
      stroke.name = "s" + std::to_string(attack_.strokes.size());
      attack_.strokes.push_back(std::move(stroke));
    }
  }
  Attack plane() {
    attack_.single = {stroke_of(sheet_.whole(20))};
    attack_.pieces = pieces_of_plane(body_.soup, sheet_.plane(), kThin * h_);
    return std::move(attack_);
  }
  Attack star(const Sheet& other) {
    if (body_.is_convex) {
      attack_.pieces = pieces_of_star(body_.soup, {sheet_.plane(), other.plane()}, kThin * h_);
    }
    return std::move(attack_);
  }

  static constexpr unsigned kSteps = 28;
  static constexpr std::array<unsigned, 6> kStrokes = {1, 2, 4, 7, 14, 28};  ///< of a pass
  template <Attack (PassMaker::*kMake)()>
  static Attack call(PassMaker& maker) {
    return (maker.*kMake)();
  }
  using Maker = Attack (*)(PassMaker&);
  static constexpr std::array<Maker, kPassKinds.size()> kMakers = {
      call<&PassMaker::deeper>, call<&PassMaker::slices>,  call<&PassMaker::both_sides>, call<&PassMaker::overlap>,
      call<&PassMaker::back>,   call<&PassMaker::between>, call<&PassMaker::cross>,      call<&PassMaker::tee>};

  const AttackedBody& body_;
  Random& random_;
  Sheet sheet_;
  unsigned strokes_;
  double d_, h_;  // the body's diagonal, its edges
  Attack attack_;
};

}  // namespace

Attack make_passes(std::size_t kind, const AttackedBody& body, Random& random) {
  return PassMaker(body, random).make(kind);
}

}  // namespace incise::test
