// SPDX-License-Identifier: Apache-2.0
#include "soak/hand_strokes.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "support/random_strokes.h"
#include "support/strokes.h"

namespace incise::test {
namespace {

/// The way of a blade that stays parallel to itself: x along it, y across it, in edges of the mesh.
struct Place {
  double x = 0, y = 0;
};
using Path = std::vector<Place>;

Vec3 middle_of(const TetSoup& soup) {
  Box box;
  for (const Vec3& p : soup.points) box.extend(p);
  return 0.5 * (box.lo + box.hi);
}

/// Moves a blade that reaches through the body, or into it, along a path across its middle.
class Hand {
 public:
  Hand(const AttackedBody& body, Random& random) : body_(body), random_(random), h_(body.edge) {
    n_ = random_direction(random);
    a_ = n_.cross(random_direction(random)).normalized();
    b_ = n_.cross(a_);
    q_ = middle_of(body.soup) + 0.12 * body.diagonal * random.point(-1, 1);
    out_ = 0.75 * body.diagonal / h_;
  }

  Attack make(std::size_t kind) { return kMakers[kind](*this); }

 private:
  // --- straight through, shaken

  /// Each pose is off by up to some amplitude in any direction.
  Attack tremor() {
    const double a = random_.real(0.02, 0.6), step = random_.real(0.08, 1);
    Path path = line({-out_, 0}, {out_, 0}, step);
    shake(path, a);
    return judged(path, line({-out_, 0}, {out_, 0}, 0.5), 2);
  }
  Attack zigzag() {
    const double a = random_.real(0.03, 0.7), step = random_.real(0.04, 0.8);
    Path path = line({-out_, 0}, {out_, 0}, step);
    for (std::size_t i = 0; i < path.size(); ++i) path[i].y += i % 2 == 0 ? a : -a;
    return judged(path, line({-out_, 0}, {out_, 0}, 0.5), 2);
  }
  Attack wave() {
    const double a = random_.real(0.05, 0.8), length = random_.real(0.3, 3);
    const double per_wave = static_cast<double>(random_.integer(5, 12));
    Path path = line({-out_, 0}, {out_, 0}, length / per_wave);
    for (Place& p : path) p.y += a * on_circle(p.x / length).second;
    return judged(path, line({-out_, 0}, {out_, 0}, 0.5), 2);
  }
  Attack walk() {
    const double step = random_.real(0.03, 0.3), drift = random_.real(0.1, 0.6);
    Path path;
    for (Place p{-out_, 0}; p.x < out_; path.push_back(p)) {
      const auto [c, s] = on_circle(random_.real(0, 1));
      p.x += step * (drift + c);
      p.y += step * s - 0.05 * step * p.y;
      p.x = std::max(p.x, -out_);
    }
    path.push_back({out_, path.back().y});
    return judged(path, line({-out_, 0}, {out_, 0}, 0.5), 2);
  }
  /// Shakes on the spot, and goes on.
  Attack dwell() {
    const double a = random_.real(0.05, 0.7), at = random_.real(-0.4, 0.4) * out_;
    Path path = line({-out_, 0}, {at, 0}, 0.4), there(static_cast<std::size_t>(random_.integer(5, 40)), Place{at, 0});
    shake(there, a);
    path.insert(path.end(), there.begin(), there.end());
    join(path, line({at, 0}, {out_, 0}, 0.4));
    return judged(path, line({-out_, 0}, {out_, 0}, 0.4), 2);
  }
  /// Goes back again and again.
  Attack back() {
    const double a = random_.real(0, 0.3);
    Path path = line({-out_, 0}, {-0.5 * out_, 0}, 0.4);
    for (auto i = random_.integer(1, 4); i > 0; --i) {
      const Place at = path.back(), behind{at.x - random_.real(0.2, 3), 0};
      join(path, line(at, behind, 0.3));
      join(path, line(behind, {at.x + random_.real(0.5, 3), 0}, 0.3));
    }
    join(path, line(path.back(), {out_, 0}, 0.4));
    shake(path, a);
    return judged(path, line({-out_, 0}, {out_, 0}, 0.4), 2);
  }
  /// A blade whose end stays inside, or that stops inside.
  Attack partial() {
    const double a = random_.real(0.02, 0.5), end = random_.real(-0.3, 0.3) * out_;
    if (random_.integer(0, 1) == 0) from_ = random_.real(-0.3, 0.1) * body_.diagonal;
    Path path = line({-out_, 0}, {end, 0}, random_.real(0.1, 0.8));
    shake(path, a);
    return judged(path, line({-out_, 0}, {end, 0}, 0.4), 1);
  }
  /// A blade that starts and ends inside.
  Attack inside() {
    const double a = random_.real(0.02, 0.5), end = random_.real(0.12, 0.22) * out_;
    Path path = line({-end, 0}, {end, 0}, random_.real(0.1, 0.8));
    shake(path, a);
    return judged(path, line({-end, 0}, {end, 0}, 0.4), 1);
  }

  // --- other ways

  Attack corner() {
    const double a = random_.real(0, 0.4), step = random_.real(0.1, 0.6);
    const auto [c, s] = on_circle(random_.real(0.15, 0.4));
    Path smooth = line({-out_, 0}, {0, 0}, 0.4), path = line({-out_, 0}, {0, 0}, step);
    join(path, line({0, 0}, {1.5 * out_ * c, 1.5 * out_ * s}, step));
    join(smooth, line({0, 0}, {1.5 * out_ * c, 1.5 * out_ * s}, 0.4));
    shake(path, a);
    return judged(path, smooth, 2);
  }
  /// Turns round, and comes back beside its way.
  Attack uturn() {
    const double a = random_.integer(0, 1) == 0 ? 0 : random_.real(0.02, 0.25), apart = random_.real(1.2, 4);
    const double y = 0.5 * apart, end = random_.real(-0.15, 0.15) * out_;
    Path path = line({-out_, -y}, {end, -y}, random_.real(0.15, 0.6));
    const bool is_round = random_.integer(0, 1) == 0;
    for (unsigned i = 1; is_round && i < 8; ++i) {
      const auto [c, s] = on_circle(0.75 + i / 16.0);
      path.push_back({end + y * c, y * s});
    }
    if (!is_round) join(path, line({end, -y}, {end, y}, random_.real(0.15, 0.6)));
    join(path, line({end, y}, {-out_, y}, random_.real(0.15, 0.6)));
    const Path smooth = path;
    shake(path, a);
    return judged(path, smooth, 2);
  }
  /// Treads and risers, in small steps.
  Attack stairs() {
    const double tread = random_.real(0.2, 2), riser = random_.real(0.2, 2), step = random_.real(0.05, 0.4);
    const double a = random_.integer(0, 1) == 0 ? 0 : random_.real(0, 0.2);
    Path path = {{-out_, 0}};
    Place p = path.back();
    for (bool up = false; p.x < out_; up = !up) {
      const Place next = up ? Place{p.x, p.y + (p.y > 0 ? -riser : riser)} : Place{p.x + tread, p.y};
      join(path, line(p, next, step));
      p = next;
    }
    Path smooth = path;
    shake(path, a);
    return judged(path, smooth, 2);
  }
  /// Turns about one of its ends, inside the body: two pieces once it has come round.
  Attack fan() {
    const double a = random_.real(0, 0.15);
    const bool is_whole = random_.integer(0, 2) > 0;
    const double turns = is_whole ? random_.real(1.03, 1.3) : random_.real(0.3, 0.9);
    const auto steps = static_cast<unsigned>(random_.integer(16, 60));
    const auto edges_of = [&](double amplitude) {
      std::vector<std::vector<Vec3>> edges;
      for (unsigned i = 0; i <= steps; ++i) {
        const auto [c, s] = on_circle(turns * i / steps);
        const Vec3 off = amplitude * h_ * random_.real(-1, 1) * n_;
        edges.push_back({q_ + off, q_ + off + 1.3 * body_.diagonal * (c * a_ + s * b_)});
      }
      return edges;
    };
    Attack attack;
    attack.strokes = {named(edges_of(a))};
    attack.single = {named(edges_of(0))};
    attack.growth_limit = 2;
    return with_limits(std::move(attack), is_whole ? 2 : 1);
  }

  // --- what they share

  static Path line(const Place& from, const Place& to, double step) {
    const double dx = to.x - from.x, dy = to.y - from.y;
    const double parts = std::max(1.0, std::round(std::sqrt(dx * dx + dy * dy) / step));
    Path path;
    for (double k = 0; k <= parts; ++k) path.push_back({from.x + k / parts * dx, from.y + k / parts * dy});
    return path;
  }
  static double length_of(const Path& path) {
    double length = 0;
    for (std::size_t i = 1; i < path.size(); ++i) {
      const double dx = path[i].x - path[i - 1].x, dy = path[i].y - path[i - 1].y;
      length += std::sqrt(dx * dx + dy * dy);
    }
    return length;
  }
  static void join(Path& path, const Path& more) { path.insert(path.end(), more.begin() + 1, more.end()); }
  void shake(Path& path, double amplitude) {
    for (Place& p : path) {
      p.x += amplitude * random_.real(-1, 1);
      p.y += amplitude * random_.real(-1, 1);
    }
    tilt_ = 0.3 * amplitude;
  }
  /// The blade's poses along a path; a shaking hand moves its ends a little apart from each other.
  std::vector<std::vector<Vec3>> edges_of(const Path& path, double tilt) {
    std::vector<std::vector<Vec3>> edges;
    for (const Place& p : path) {
      const Vec3 at = q_ + h_ * (p.x * b_ + p.y * n_);
      std::vector<Vec3> edge = {at + from_ * a_, at + 1.3 * body_.diagonal * a_};
      for (Vec3& point : edge) point += tilt * h_ * random_.point(-1, 1);
      edges.push_back(std::move(edge));
    }
    return edges;
  }
  Attack judged(const Path& path, const Path& smooth, std::size_t pieces) {
    if (from_ == 0) from_ = -1.3 * body_.diagonal;
    Attack attack;
    attack.strokes = {named(edges_of(path, tilt_))};
    attack.single = {named(edges_of(smooth, 0))};
    attack.growth_limit = 2 * std::min(length_of(path) / length_of(smooth), 2.0);  // a wave is a larger wall
    return with_limits(std::move(attack), pieces);
  }
  Attack with_limits(Attack attack, std::size_t pieces) const {
    if (body_.is_convex) attack.pieces = pieces;
    attack.few_tets =
        2 * std::cbrt(std::pow(static_cast<double>(body_.before.tets), 2));  // that a wall across it meets
    attack.encloses_nothing = body_.before.surfaces == body_.before.components;
    return attack;
  }
  static Stroke named(std::vector<std::vector<Vec3>> edges) {
    Stroke stroke = stroke_of(std::move(edges));
    stroke.name = "s0";
    return stroke;
  }

  template <Attack (Hand::*kMake)()>
  static Attack call(Hand& hand) {
    return (hand.*kMake)();
  }
  using Maker = Attack (*)(Hand&);
  static constexpr std::array<Maker, kHandKinds.size()> kMakers = {
      call<&Hand::tremor>, call<&Hand::zigzag>, call<&Hand::wave>,    call<&Hand::corner>,
      call<&Hand::uturn>,  call<&Hand::stairs>, call<&Hand::fan>,     call<&Hand::walk>,
      call<&Hand::dwell>,  call<&Hand::back>,   call<&Hand::partial>, call<&Hand::inside>};

  const AttackedBody& body_;
  Random& random_;
  double h_, out_ = 0;  // an edge; how many of them lead out of the body
  Vec3 n_, a_, b_, q_;
  double from_ = 0, tilt_ = 0;  // where the blade's edge begins, 0: outside the body; how far its ends shake, in edges
};

}  // namespace

Attack make_hand(std::size_t kind, const AttackedBody& body, Random& random) {
  return Hand(body, random).make(kind);
}

}  // namespace incise::test
