// SPDX-License-Identifier: Apache-2.0
#include "soak/attack_strokes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "soak/models.h"
#include "soak/sheet.h"
#include "support/random_strokes.h"
#include "support/strokes.h"

namespace incise::test {
namespace {

double mean_first_edge(const TetSoup& soup) {
  double sum = 0;
  for (const auto& t : soup.tets) sum += (soup.points[t[0]] - soup.points[t[1]]).norm();
  return sum / static_cast<double>(soup.tets.size());
}

double diagonal_of(const TetSoup& soup) {
  Box box;
  for (const Vec3& p : soup.points) box.extend(p);
  return (box.hi - box.lo).norm();
}

/// Makes the strokes of each kind on one sheet, or on several.
class Attacker {
 public:
  Attacker(const AttackedBody& body, Random& random)
      : body_(body), random_(random), sheet_(body, random_frame(random), random), d_(body.diagonal), h_(body.edge) {}

  Attack make(std::size_t kind) { return kMakers[kind](*this); }

 private:
  // --- one whole plane

  /// What any way to cut the whole plane must come to.
  [[nodiscard]] Attack whole_plane(const std::vector<Edges>& strokes) const {
    Attack attack;
    add(attack, strokes);
    attack.single = {named_stroke(sheet_.whole(20))};
    attack.pieces = pieces_of_plane(body_.soup, sheet_.plane(), kThin * h_);
    return attack;
  }
  Attack one() {
    Attack attack = whole_plane({sheet_.whole(20)});
    attack.single.clear();
    return attack;
  }
  /// Stroke after stroke, each from `lap` before where the last one ended.
  [[nodiscard]] Attack chain(unsigned count, double lap) const {
    const Span way = sheet_.way;
    const double length = way.length() / count;
    const auto steps = static_cast<unsigned>(std::clamp(length / h_, 2.0, 12.0));
    std::vector<Edges> strokes;
    for (unsigned i = 0; i < count; ++i) {
      const Span part = {std::max(way.from, way.from + i * length - lap), way.from + (i + 1) * length};
      strokes.push_back(sheet_.sweep(part, steps, sheet_.width));
    }
    return whole_plane(strokes);
  }
  Attack again2() { return chain(2, 0); }
  Attack again5() { return chain(5, 0); }
  Attack again17() { return chain(17, 0); }
  Attack overlap() {
    const auto count = static_cast<unsigned>(random_.integer(2, 6));
    return chain(count, random_.real(0.02, 2.5) * h_);
  }
  Attack both_sides() {
    const double middle = sheet_.way.at(random_.real(0.3, 0.7)), over = random_.real(0, 1) * h_;
    return whole_plane({sheet_.sweep({sheet_.way.from, middle + over}, 8, sheet_.width),
                        sheet_.sweep({sheet_.way.to, middle - over}, 8, sheet_.width)});
  }
  /// Several passes along the same line, each deeper.
  Attack deeper() {
    const auto count = static_cast<unsigned>(random_.integer(2, 4));
    const Span depths = {-0.25 * d_, 1.3 * d_};
    std::vector<Edges> strokes;
    for (unsigned i = 0; i < count; ++i) {
      const double depth = depths.at(static_cast<double>(i) / (count - 1));
      strokes.push_back(sheet_.sweep(sheet_.way, 10, {sheet_.width.from, depth}));
    }
    return whole_plane(strokes);
  }
  /// Forth and back, and forth again.
  Attack zigzag() {
    std::array<double, 3> turns{};
    for (double& s : turns) s = sheet_.way.at(random_.real(0.1, 0.9));
    std::sort(turns.begin(), turns.end());
    Edges edges = sheet_.sweep({sheet_.way.from, turns[1]}, 6, sheet_.width);
    go_on(edges, {turns[1], turns[0]}, 3);
    go_on(edges, {turns[0], turns[2]}, 6);
    go_on(edges, {turns[2], sheet_.way.to}, 4);
    return whole_plane({edges});
  }
  /// The blade's end stops inside; a second stroke takes the rest.
  Attack finish_behind() {
    const double end = random_.real(-0.2, 0.2) * d_, over = random_.real(0, 0.5) * h_;
    return whole_plane({sheet_.sweep(sheet_.way, 10, {sheet_.width.from, end + over}),
                        sheet_.sweep(sheet_.way, 10, {end - over, sheet_.width.to})});
  }

  // --- a part of a plane, over and over

  struct Part {
    Span way, width;
  };
  Part part() {
    Part part{sheet_.way, sheet_.width};
    part.way.to = sheet_.way.at(random_.real(0.3, 0.6));
    if (random_.integer(0, 1) == 0) part.width.from = -random_.real(0.1, 0.5) * d_;
    return part;
  }
  [[nodiscard]] Edges sweep(const Part& part, double lift = 0) const {
    return sheet_.sweep(part.way, 8, part.width, lift);
  }
  Attack part_one() { return several({sweep(part())}); }
  Attack retrace(unsigned count) {
    const Edges piece = sweep(part());
    Attack attack = several(std::vector<Edges>(count, piece));
    attack.single = {named_stroke(piece)};
    attack.growth_limit = 1.1;
    return attack;
  }
  Attack retrace2() { return retrace(2); }
  Attack retrace5() { return retrace(5); }
  Attack jitter5() {
    const Part piece = part();
    std::vector<Edges> strokes;
    for (unsigned i = 0; i < 5; ++i) strokes.push_back(sweep(piece, random_.real(-0.1, 0.1) * h_));
    Attack attack = several(strokes);
    // The sheet in the middle is another one: it may cut off other chips, and make half as many tets or twice as many.
    attack.single = {named_stroke(strokes.front())};
    return attack;
  }

  // --- planes that meet

  /// A plane across the sheet, through another point; its edge goes along the sheet's normal.
  Sheet across() { return {body_, Frame{sheet_.a, sheet_.n, sheet_.b}, random_}; }

  /// Where the edge of a second sheet begins, above the first: anywhere, exactly on it, or just behind it.
  double tee_start(const Sheet& divider) {
    switch (random_.integer(0, 3)) {
      case 0:
        return 0;
      case 1:
        return -random_.real(0, 0.1) * h_;
      default:
        return sheet_.plane().height(divider.q);
    }
  }
  Attack tee() {
    const Sheet divider = across();
    const double from = tee_start(divider), begin = from - sheet_.plane().height(divider.q);
    Attack attack = several({sheet_.whole(20), divider.sweep(divider.way, 16, {begin, divider.width.to})});
    if (body_.is_convex) {
      attack.pieces = pieces_of_tee(body_.soup, sheet_.plane(), divider.plane(), from, kThin * h_);
    }
    return attack;
  }
  Attack cross() {
    const Sheet other = across();
    Attack attack = several({sheet_.whole(20), other.whole(16)});
    expect_star(attack, {sheet_.plane(), other.plane()});
    return attack;
  }
  Attack star() {
    const auto count = static_cast<unsigned>(random_.integer(2, 5));
    std::vector<Edges> strokes;
    std::vector<SheetPlane> planes;
    for (unsigned i = 0; i < count; ++i) {
      const Vec3 u = Sheet::turned(sheet_.a, sheet_.n, 0.5 * i / count);
      Edges edges;
      for (unsigned k = 0; k < 12; ++k)
        edges.push_back(segment(sheet_.q + sheet_.way.at(k / 11.0) * sheet_.b, 1.3 * d_ * u));
      strokes.push_back(edges);
      planes.push_back({sheet_.q, u.cross(sheet_.b)});
    }
    Attack attack = several(strokes);
    expect_star(attack, planes);
    return attack;
  }
  Attack parallel() {
    return several({sheet_.whole(20), sheet_.sweep(sheet_.way, 16, sheet_.width, random_.real(0.1, 2) * h_)});
  }

  // --- one stroke that is no plane

  Attack coil() {
    const double end = random_.real(3, 9);
    Edges edges;
    for (unsigned i = 0; i < 30; ++i) {
      const double angle = end * i / 29.0;
      const Vec3 p = sheet_.q + (0.1 + 0.02 * angle) * d_ * Sheet::turned(sheet_.a, sheet_.n, angle / kTurn);
      edges.push_back({p - d_ * sheet_.b, p + random_.real(0, 0.1) * d_ * sheet_.b});
    }
    return several({edges});
  }
  Attack twist() {
    const double end = random_.real(1, 7);
    Edges edges;
    for (unsigned i = 0; i <= 24; ++i) {
      const Vec3 u = Sheet::turned(sheet_.a, sheet_.b, end * i / 24.0 / kTurn);
      edges.push_back(segment(sheet_.q + (i / 12.0 - 1) * 0.9 * d_ * sheet_.n, 0.8 * d_ * u));
    }
    return several({edges});
  }
  /// A closed edge, pushed through or a little way in.
  Attack core() {
    const auto count = static_cast<unsigned>(random_.integer(8, 39));
    const double down = (random_.integer(0, 1) == 0 ? 1.2 : random_.real(0, 0.2)) * d_;
    Edge above, below;
    for (unsigned i = 0; i <= count; ++i) {
      const Vec3 p = sheet_.q + 0.15 * d_ * Sheet::turned(sheet_.a, sheet_.b, static_cast<double>(i % count) / count);
      above.push_back(p - 1.2 * d_ * sheet_.n);
      below.push_back(p + down * sheet_.n);
    }
    return several({{above, below}});
  }
  /// An edge of very many points that waves and trembles.
  Attack fine() {
    Edge first, last;
    const double way = random_.real(0.3, 1) * sheet_.way.length();
    for (unsigned i = 0; i < 300; ++i) {
      const double u = (-1.1 + 2.2 * i / 299.0) * d_;
      const double wave = random_.real(0.01, 0.02) * d_ * on_circle(40 * u / d_ / kTurn).second;
      first.push_back(sheet_.q + u * sheet_.a + wave * sheet_.n + sheet_.way.from * sheet_.b);
      last.push_back(first.back() + way * sheet_.b);
    }
    return several({{first, last}});
  }
  /// A scalpel smaller than an element, around a point inside.
  Attack tiny() {
    const double z = random_.real(0.02, 0.4) * h_;
    return several({sheet_.sweep({-2 * z, 2 * z}, 1, {-z, z})});
  }

  // --- what they share

  static Edge segment(const Vec3& middle, const Vec3& half) { return {middle - half, middle + half}; }
  static Stroke named_stroke(Edges edges, const std::string& name = "s0") {
    Stroke stroke = stroke_of(std::move(edges));
    stroke.name = name;
    return stroke;
  }
  static void add(Attack& attack, const std::vector<Edges>& strokes) {
    for (const Edges& edges : strokes) {
      attack.strokes.push_back(named_stroke(edges, "s" + std::to_string(attack.strokes.size())));
    }
  }
  static Attack several(const std::vector<Edges>& strokes) {
    Attack attack;
    add(attack, strokes);
    return attack;
  }
  /// Goes on from where the blade stands.
  void go_on(Edges& edges, const Span& s, unsigned steps) const {
    const Edges more = sheet_.sweep(s, steps, sheet_.width);
    edges.insert(edges.end(), more.begin() + 1, more.end());
  }
  void expect_star(Attack& attack, const std::vector<SheetPlane>& planes) const {
    if (body_.is_convex) attack.pieces = pieces_of_star(body_.soup, planes, kThin * h_);
  }

  static constexpr double kTurn = 6.283185307179586;
  template <Attack (Attacker::*kMake)()>
  static Attack call(Attacker& attacker) {
    return (attacker.*kMake)();
  }
  using Maker = Attack (*)(Attacker&);
  static constexpr std::array<Maker, kAttackKinds.size()> kMakers = {
      call<&Attacker::one>,           call<&Attacker::again2>,     call<&Attacker::again5>,   call<&Attacker::again17>,
      call<&Attacker::overlap>,       call<&Attacker::both_sides>, call<&Attacker::deeper>,   call<&Attacker::zigzag>,
      call<&Attacker::finish_behind>, call<&Attacker::retrace2>,   call<&Attacker::retrace5>, call<&Attacker::jitter5>,
      call<&Attacker::part_one>,      call<&Attacker::tee>,        call<&Attacker::cross>,    call<&Attacker::star>,
      call<&Attacker::parallel>,      call<&Attacker::coil>,       call<&Attacker::twist>,    call<&Attacker::core>,
      call<&Attacker::fine>,          call<&Attacker::tiny>};

  const AttackedBody& body_;
  Random& random_;
  Sheet sheet_;
  double d_, h_;  // the body's diagonal, its edges
};

}  // namespace

AttackedBody::AttackedBody(std::string called, std::filesystem::path from, TetMesh whole)
    : name(std::move(called)),
      file(std::move(from)),
      mesh(std::move(whole)),
      soup(to_soup(mesh)),
      before(review(soup)),
      is_convex(test::is_convex(soup)),
      diagonal(diagonal_of(soup)),
      edge(mean_first_edge(soup)) {}

Attack make_attack(std::size_t kind, const AttackedBody& body, Random& random) {
  return Attacker(body, random).make(kind);
}

}  // namespace incise::test
