// SPDX-License-Identifier: Apache-2.0
// Nothing here may call libm but for square roots: the strokes' bits decide the bits of what they cut.
#include "app/jobs/random_strokes.h"

#include <cmath>
#include <string>

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr unsigned kStrokeSteps = 12;  // of the blade
constexpr unsigned kEdgePoints = 5;    // of a straight edge: tissue that moves takes it where these are
constexpr unsigned kRingPoints = 24;
constexpr double kReach = 0.8;  // of the body's diagonal: from its middle half beyond all of it

/// SplitMix64, by Sebastiano Vigna (public domain; Steele, Lea and Flood, OOPSLA 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }
  double real(double low, double high) { return low + (high - low) * (static_cast<double>(bits() >> 11U) * 0x1p-53); }
  Vec3 point(double low, double high) {
    const double x = real(low, high);
    const double y = real(low, high);
    return {x, y, real(low, high)};
  }
  Vec3 direction() {
    while (true) {
      const Vec3 p = point(-1, 1);
      const double length = p.norm();
      if (length > 0.1 && length < 1) return p / length;
    }
  }

 private:
  std::uint64_t state_;
};

/// Where a stroke is put: a frame in the body, and its diagonal as the unit of length.
struct Place {
  Vec3 centre, u, v, w;
  double scale;

  Place(Random& random, const Box& body) {
    const Vec3 size = body.hi - body.lo;
    centre = body.lo + size.cwiseProduct(random.point(0.25, 0.75));
    scale = size.norm();
    w = random.direction();
    u = w.cross(random.direction()).normalized();
    v = w.cross(u);
  }
  [[nodiscard]] Vec3 operator()(double x, double y, double z) const { return centre + scale * (x * u + y * v + z * w); }
};

/// A straight edge along w from `from` to `to`, on the way along the parabola y = bend x² + turn x.
struct Sweep {
  double begin = -kReach, end = kReach;
  double bend = 0, turn = 0;
  double from = -kReach, to = kReach;
};

void sweep_edge(const Place& place, const Sweep& sweep, Stroke& stroke) {
  for (unsigned i = 0; i <= kStrokeSteps; ++i) {
    const double x = sweep.begin + (sweep.end - sweep.begin) * i / kStrokeSteps;
    std::vector<Vec3>& edge = stroke.edges.emplace_back();
    for (unsigned k = 0; k < kEdgePoints; ++k) {
      const double z = sweep.from + (sweep.to - sweep.from) * k / (kEdgePoints - 1);
      edge.push_back(place(x, sweep.bend * x * x + sweep.turn * x, z));
    }
  }
}

/// A ring about w that goes down from outside to the height `to`.
void sweep_ring(const Place& place, double radius, double to, Stroke& stroke) {
  const double cosine = (std::sqrt(6.0) + std::sqrt(2.0)) / 4;  // of 15 degrees
  const double sine = (std::sqrt(6.0) - std::sqrt(2.0)) / 4;
  for (unsigned i = 0; i <= kStrokeSteps; ++i) {
    const double z = kReach + (to - kReach) * i / kStrokeSteps;
    std::vector<Vec3>& edge = stroke.edges.emplace_back();
    double x = radius;
    double y = 0;
    for (unsigned k = 0; k < kRingPoints; ++k) {
      edge.push_back(place(x, y, z));
      const double turned = cosine * x - sine * y;
      y = sine * x + cosine * y;
      x = turned;
    }
    edge.push_back(edge.front());
  }
}

void shape(RandomKind kind, const Place& place, Random& random, Stroke& stroke) {
  Sweep sweep;
  switch (kind) {
    case RandomKind::kPlane:
      return sweep_edge(place, sweep, stroke);
    case RandomKind::kArc:
      sweep.bend = random.real(-1, 1);
      sweep.turn = random.real(-0.3, 0.3);
      return sweep_edge(place, sweep, stroke);
    case RandomKind::kSlit:
      sweep.end = random.real(0.1, 0.4);
      sweep.begin = -sweep.end;
      sweep.bend = random.real(-1, 1);
      sweep.from = random.real(-0.15, 0.15);
      return sweep_edge(place, sweep, stroke);
    case RandomKind::kCore: {
      const double radius = random.real(0.06, 0.2);
      const bool is_through = random.real(0, 1) < 0.5;
      return sweep_ring(place, radius, is_through ? -kReach : random.real(-0.15, 0.15), stroke);
    }
  }
}

}  // namespace

std::vector<Stroke> random_strokes(const RandomStrokes& wanted, const Box& body) {
  Random random(wanted.seed);
  std::vector<Stroke> strokes(wanted.strokes);
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const RandomKind kind = wanted.kinds[static_cast<std::size_t>(random.bits() % wanted.kinds.size())];
    const Place place(random, body);
    shape(kind, place, random, strokes[i]);
    strokes[i].name = kRandomKindNames[static_cast<std::size_t>(kind)];
    const double start = wanted.start + static_cast<double>(i) * (wanted.seconds + wanted.pause);
    for (unsigned k = 0; k <= kStrokeSteps; ++k) strokes[i].times.push_back(start + wanted.seconds * k / kStrokeSteps);
  }
  return strokes;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
