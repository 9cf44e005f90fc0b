// SPDX-License-Identifier: Apache-2.0
#include "soak/motions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "incise/io/mesh_loader.h"
#include "soak/models.h"
#include "support/bodies.h"
#include "support/random_strokes.h"
#include "support/strokes.h"

namespace incise::test {
namespace {

using Kind = BodyPlan::Kind;

// --- bodies
// -------------------------------------------------------------------------------------------------------------------

BodyPlan random_body(Random& random, const std::vector<std::filesystem::path>& models) {
  constexpr std::array<Kind, 10> kKinds = {Kind::kKuhn,     Kind::kKuhn,       Kind::kJittered, Kind::kJittered,
                                           Kind::kJittered, Kind::kRenumbered, Kind::kBall,     Kind::kBall,
                                           Kind::kPlate,    Kind::kNeedle};
  BodyPlan plan;
  plan.kind = random.integer(0, 24) == 0 ? Kind::kDoubled : kKinds[static_cast<std::size_t>(random.integer(0, 9))];
  plan.n = static_cast<std::uint32_t>(random.integer(2, 7));
  plan.seed = static_cast<std::uint64_t>(random.integer(1, 1000));
  if (models.empty()) return plan;
  return {Kind::kModel, 0, 0, models[plan.seed % models.size()]};
}

Box box_of(const TetSoup& soup) {
  Box box;
  for (const Vec3& p : soup.points) box.extend(p);
  return box;
}

/// The mean length of a body's edges, each counted once per tet.
double mean_edge(const TetSoup& soup) {
  double sum = 0;
  for (const auto& tet : soup.tets) {
    for (unsigned i = 0; i < 4; ++i) {
      for (unsigned j = 0; j < i; ++j) sum += (soup.points[tet[i]] - soup.points[tet[j]]).norm();
    }
  }
  return sum / (6.0 * static_cast<double>(soup.tets.size()));
}

// --- surfaces that a blade moves along
// ------------------------------------------------------------------------------------------------------

/// A surface with a blade on it at every s in [0, 1], from outside the body to outside; lengths as shares of the body's
/// diagonal.
class Course {
 public:
  Course(Random& random, const Box& box) : placement_(random, box) {
    const bool is_plain = random.integer(0, 2) == 0;
    bend_ = is_plain ? 0 : random.real(-0.5, 0.5);
    bulge_ = is_plain ? 0 : random.real(-0.3, 0.3);
    twist_ = is_plain ? 0 : random.real(-0.2, 0.2);
    points_ = bulge_ == 0 ? 2 : static_cast<unsigned>(random.integer(3, 7));
    if (random.integer(0, 2) == 0) low_ = random.real(-0.25, 0.25);  // the tip stays inside
    if (random.integer(0, 11) == 0) radius_ = random.real(0.08, 0.3);
  }
  /// A course across this one, through the same middle.
  [[nodiscard]] Course across(Random& random) const {
    Course course = *this;
    std::swap(course.placement_.u, course.placement_.v);
    course.placement_.centre += 0.1 * placement_.scale * random.point(-1, 1);
    return course;
  }
  [[nodiscard]] Course beside(double distance) const {
    Course course = *this;
    course.placement_.centre += distance * placement_.v;
    return course;
  }
  [[nodiscard]] std::vector<Vec3> blade(double s) const {
    const double along = -0.75 + 1.5 * s;
    return radius_ > 0 ? ring(along) : edge(along, s);
  }

 private:
  [[nodiscard]] std::vector<Vec3> edge(double along, double s) const {
    const auto [c, d] = on_circle(twist_ * s + 1);
    std::vector<Vec3> result;
    for (unsigned i = 0; i < points_; ++i) {
      const double q = low_ + (kHigh - low_) * i / (points_ - 1);
      const double aside = bend_ * along * along + bulge_ * q * q;
      result.push_back(at(along, aside + q * d, q * c));
    }
    return result;
  }
  [[nodiscard]] std::vector<Vec3> ring(double along) const {
    std::vector<Vec3> result;
    for (unsigned i = 0; i < kRingPoints; ++i) {
      const auto [c, d] = on_circle(static_cast<double>(i) / kRingPoints);
      result.push_back(at(along, radius_ * c, radius_ * d));
    }
    result.push_back(result.front());
    return result;
  }
  [[nodiscard]] Vec3 at(double x, double y, double z) const {
    return placement_.centre + placement_.scale * (x * placement_.u + y * placement_.v + z * placement_.w);
  }

  static constexpr double kHigh = 0.85;
  static constexpr unsigned kRingPoints = 16;
  Placement placement_;
  double bend_ = 0, bulge_ = 0, twist_ = 0, low_ = -kHigh, radius_ = 0;
  unsigned points_ = 2;
};

// --- how it moves along them
// ------------------------------------------------------------------------------------------------------------

/// The places along a course that a blade visits, in order, and how it goes there.
struct Schedule {
  std::string policy;
  std::vector<double> places;  ///< of the course, s
  unsigned steps = 20;         ///< per whole course
  double tremor = 0;           ///< of h
  bool creeps = false;         ///< crawls where it turns
};

Schedule random_schedule(Random& random, double start, double end) {
  constexpr std::array<unsigned, 4> kSteps = {8, 20, 45, 90};
  Schedule schedule{"straight", {start, end}, kSteps[static_cast<std::size_t>(random.integer(0, 3))]};
  const double way = end - start, middle = start + random.real(0.2, 0.9) * way;
  switch (random.integer(0, 9)) {
    case 0:
      schedule.policy = "pause";
      schedule.places = {start, middle, middle, middle, middle, end, end};
      break;
    case 1:
      schedule.policy = "reversal";
      schedule.places = {start, middle, start + random.real(0, 1) * (middle - start), end};
      break;
    case 2:
      schedule.policy = "withdrawal";
      schedule.places = {start, middle, -0.1, end};
      break;
    case 3:
      schedule.policy = "withdrawn";
      schedule.places = {start, middle, -0.1};
      break;
    case 4:
      schedule.policy = "fast";
      schedule.steps = 1;
      break;
    case 5:
      schedule.policy = "slow";
      schedule.places = {start, middle, end};
      schedule.creeps = true;
      break;
    case 6:
      schedule.policy = "tremor";
      schedule.tremor = random.real(0.01, 0.1);
      break;
    case 7:
      schedule.policy = "strong tremor";
      schedule.tremor = random.real(0.1, 0.4);
      break;
    case 8:
      schedule.policy = "random walk";
      for (auto i = random.integer(2, 8); i > 0; --i) schedule.places.push_back(random.real(0.1, 0.9));
      break;
    default:
      break;
  }
  return schedule;
}

/// The values of s at the poses.
std::vector<double> places_of(const Schedule& schedule, double creep) {
  std::vector<double> places = {schedule.places[0]};
  for (std::size_t i = 0; i + 1 < schedule.places.size(); ++i) {
    const double from = schedule.places[i], way = schedule.places[i + 1] - from;
    const double count = std::max(1.0, std::ceil(std::abs(way) * schedule.steps));
    for (double k = 1; k < count; ++k) places.push_back(from + k / count * way);
    places.push_back(schedule.places[i + 1]);
    for (unsigned k = 1; schedule.creeps && k <= 30; ++k) places.push_back(schedule.places[i + 1] + k * creep);
  }
  return places;
}

MotionStroke stroke_along(const Course& course, const Schedule& schedule, double h, double diagonal, Random& random) {
  MotionStroke stroke{schedule.policy, {}, false};
  for (const double s : places_of(schedule, 1e-4 * h / diagonal)) {
    std::vector<Vec3> edge = course.blade(s);
    const bool is_closed = edge.front() == edge.back();
    for (Vec3& p : edge) p += schedule.tremor * h * random.real(0, 1) * random_direction(random);
    if (is_closed) edge.back() = edge.front();
    stroke.edges.push_back(std::move(edge));
  }
  return stroke;
}

/// Makes the strokes of a case one after the other: anew, across, along or on from the one before.
class StrokeMaker {
 public:
  StrokeMaker(Random& random, const TetSoup& soup)
      : random_(random), box_(box_of(soup)), h_(mean_edge(soup)), course_(random, box_) {}

  MotionStroke first() { return make("", 0); }
  MotionStroke next() {
    constexpr std::array<double, 5> kDistances = {0, 1e-12, 1e-6, 0.02, 0.3};  // of h
    switch (random_.integer(0, 4)) {
      case 0:
        return make("continues exactly, ", end_);
      case 1:
        return make("continues with overlap, ", std::max(0.0, end_ - random_.real(0, 0.15)));
      case 2:
        course_ = course_.across(random_);
        return make("across, ", 0);
      case 3:
        course_ = course_.beside(kDistances[static_cast<std::size_t>(random_.integer(0, 4))] * h_);
        return make("again, ", 0);
      default:
        course_ = Course(random_, box_);
        return make("", 0);
    }
  }

 private:
  MotionStroke make(const std::string& relation, double start) {
    const bool is_through = random_.integer(0, 1) == 0;
    end_ = is_through ? 1.0 : start + random_.real(0.3, 0.8) * (1 - start);
    const Schedule schedule = random_schedule(random_, start, end_);
    MotionStroke stroke = stroke_along(course_, schedule, h_, (box_.hi - box_.lo).norm(), random_);
    stroke.policy = relation + stroke.policy + (is_through ? ", through" : ", partial");
    stroke.is_aborted = random_.integer(0, 11) == 0;
    return stroke;
  }

  Random& random_;
  Box box_;
  double h_;
  Course course_;
  double end_ = 0;
};

}  // namespace

TetSoup make_body(const BodyPlan& plan) {
  switch (plan.kind) {
    case Kind::kKuhn:
      return kuhn_cube(plan.n);
    case Kind::kJittered:
      return jittered_cube(plan.n, plan.seed);
    case Kind::kRenumbered:
      return renumbered(jittered_cube(plan.n, plan.seed), plan.seed);
    case Kind::kBall:
      return ball(2 * std::max(1U, plan.n / 2));
    case Kind::kPlate:
      return kuhn_box(Vec3(0, 0, 0), Vec3(1, 1, 0.5 / plan.n), {2 * plan.n, 2 * plan.n, 1});
    case Kind::kNeedle:
      return needle(2 * plan.n);
    case Kind::kModel:
      return to_soup(io::load_mesh(plan.model).value().mesh);
    default:
      return doubled_cube(plan.n);
  }
}

std::string describe(const BodyPlan& plan) {
  const std::string n = std::to_string(plan.n), seed = std::to_string(plan.seed);
  switch (plan.kind) {
    case Kind::kKuhn:
      return "kuhn_cube(" + n + ")";
    case Kind::kJittered:
      return "jittered_cube(" + n + ", " + seed + ")";
    case Kind::kRenumbered:
      return "renumbered(jittered_cube(" + n + ", " + seed + "), " + seed + ")";
    case Kind::kBall:
      return "ball(" + std::to_string(2 * std::max(1U, plan.n / 2)) + ")";
    case Kind::kPlate:
      return "kuhn_box(Vec3(0, 0, 0), Vec3(1, 1, 0.5 / " + n + "), {2 * " + n + ", 2 * " + n + ", 1})";
    case Kind::kNeedle:
      return "needle(2 * " + n + ")";
    case Kind::kModel:
      return plan.model.filename().string();
    default:
      return "doubled_cube(" + n + ")";
  }
}

MotionCase random_case(std::uint64_t seed, const std::vector<std::filesystem::path>& models) {
  constexpr std::array<double, 5> kSnaps = {0.2, 0.2, 0.0, 0.0, 0.1};
  Random random(seed);
  MotionCase made;
  made.seed = seed;
  made.body = random_body(random, models);
  made.snap = kSnaps[static_cast<std::size_t>(random.integer(0, 4))];
  made.maintains = random.integer(0, 3) == 0;
  made.wave = random.integer(0, 3) == 0 ? random.real(0.005, 0.08) : 0;
  StrokeMaker maker(random, make_body(made.body));
  made.strokes.push_back(maker.first());
  for (auto i = random.integer(0, 3); i > 0; --i) made.strokes.push_back(maker.next());
  return made;
}

Vec3 waved(const Vec3& p, double t, double amplitude, double diagonal) {
  const Vec3 q = 0.4 / diagonal * p;
  const auto [a, b] = on_circle(q.y() + 0.7 * q.z() + t);
  const auto [c, d] = on_circle(q.x() - 0.6 * q.y() - 1.3 * t);
  return p + amplitude * diagonal * Vec3(0.6 * a, 0.6 * (b - c), 0.6 * d);
}

}  // namespace incise::test
