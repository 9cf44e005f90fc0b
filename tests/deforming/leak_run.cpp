// SPDX-License-Identifier: Apache-2.0
#include "deforming/leak_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "deforming/swaying_field.h"
#include "incise/geom/closest.h"
#include "incise/geom/quality.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "incise/mesh/remesh.h"
#include "incise/mesh/transaction.h"
#include "incise/mesh/validate.h"
#include "support/bodies.h"

namespace incise::test {

namespace {

constexpr double kSeconds = 2;     // of motion
constexpr double kCrumb = 0.02;    // of the spacing cubed
constexpr unsigned kSettle = 600;  // sweeps before the blade comes

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

TetSoup beam(std::uint64_t seed) {
  TetSoup soup = kuhn_box(Vec3(0, 0, 0), Vec3(2, 1, 2.0 / 3.0), {12, 6, 4});
  jitter(soup, 0.15, seed);
  return soup;
}

TetSoup soup_of(const TetMesh& mesh) {
  TetSoup soup;
  for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) soup.points.push_back(mesh.rest(VertexId(v)));
  mesh.for_each_tet([&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    soup.tets.push_back({v[0].value, v[1].value, v[2].value, v[3].value});
  });
  return soup;
}

/// Swaps faces at random, as long as no tet becomes thin.
TetSoup shuffled(const TetSoup& soup, double least_volume, std::uint64_t seed) {
  TetMesh mesh = TetMesh::build(soup).value();
  Random random(seed);
  const auto is_thin = [&](const NewTet& tet) {
    const auto at = [&](unsigned c) { return mesh.rest(tet.vertices[c]); };
    return (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) < 6 * least_volume;
  };
  std::vector<TetId> produced;
  for (std::size_t tries = 4 * soup.tets.size(); tries > 0; --tries) {
    const TetId tet(static_cast<std::uint32_t>(random.integer(0, mesh.tet_slots() - 1)));
    const auto side = static_cast<unsigned>(random.integer(0, 3));
    if (!mesh.is_live(tet)) continue;
    const RemeshPlan plan = plan_swap_23(mesh, {tet, side});
    if (!plan || std::any_of(plan.produced.begin(), plan.produced.end(), is_thin)) continue;
    Transaction transaction(mesh);
    apply(transaction, plan, produced);
    transaction.commit();
  }
  return renumbered(soup_of(mesh), seed);
}

/// The body as it stands.
struct Shape {
  const TetMesh& mesh;

  [[nodiscard]] bool contains(TetId tet, const Vec3& p) const {
    for (unsigned side = 0; side < 4; ++side) {
      const auto [a, b, c] = mesh.vertices(Side(tet, side));
      const Vec3& o = mesh.current(a);
      if ((mesh.current(b) - o).cross(mesh.current(c) - o).dot(p - o) > 0) return false;
    }
    return true;
  }
  [[nodiscard]] Box box(TetId tet) const {
    Box box;
    for (const VertexId v : mesh.vertices(tet)) box.extend(mesh.current(v));
    return box;
  }
};

/// Distances from points of the blade that lie in tissue to the nearest lip of the stroke; to the skin before there is
/// any.
class FrontError {
 public:
  void add(const TetMesh& mesh, std::uint32_t stroke, const std::vector<Vec3>& blade, LeakResult& result) {
    const std::vector<Vec3> inside = points_in_tissue({mesh}, blade);
    if (inside.empty()) return;
    const std::vector<Side> lips = boundary(mesh, stroke);
    for (const Vec3& p : inside) add(std::sqrt(distance2(mesh, p, lips)), result);
  }
  void finish(double spacing, LeakResult& result) const {
    result.front_mean = result.front_points > 0 ? sum_ / static_cast<double>(result.front_points) / spacing : 0;
    result.front_max /= spacing;
  }

 private:
  static std::vector<Vec3> points_in_tissue(const Shape& shape, const std::vector<Vec3>& blade) {
    Box reach;
    for (const Vec3& p : blade) reach.extend(p);
    std::vector<bool> is_inside(blade.size());
    shape.mesh.for_each_tet([&](TetId tet) {
      const Box box = shape.box(tet);
      if (!box.overlaps(reach)) return;
      for (std::size_t i = 0; i < blade.size(); ++i) {
        is_inside[i] = is_inside[i] || (box.distance2(blade[i]) == 0 && shape.contains(tet, blade[i]));
      }
    });
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < blade.size(); ++i) {
      if (is_inside[i]) points.push_back(blade[i]);
    }
    return points;
  }
  static std::vector<Side> boundary(const TetMesh& mesh, std::uint32_t stroke) {
    std::vector<Side> lips, all;
    mesh.for_each_tet([&](TetId tet) {
      for (unsigned side = 0; side < 4; ++side) {
        const Link link = mesh.links(tet)[side];
        if (!link.is_boundary()) continue;
        all.emplace_back(tet, side);
        if (link.tag() == stroke) lips.emplace_back(tet, side);
      }
    });
    return lips.empty() ? all : lips;
  }
  static double distance2(const TetMesh& mesh, const Vec3& p, const std::vector<Side>& sides) {
    double least = std::numeric_limits<double>::infinity();
    for (const Side side : sides) {
      const auto [a, b, c] = mesh.vertices(side);
      least = std::min(least, closest_on_triangle(p, mesh.current(a), mesh.current(b), mesh.current(c)).distance2);
    }
    return least;
  }
  void add(double distance, LeakResult& result) {
    ++result.front_points;
    sum_ += distance;
    result.front_max = std::max(result.front_max, distance);
  }

  double sum_ = 0;
};

/// An engine, what moves its body, and what has been seen so far.
class Run {
 public:
  explicit Run(const LeakSettings& settings)
      : settings_(settings), engine_(make_engine()), motion_(make_motion()), stroke_(engine_.next_stroke()) {
    result_.expected = motion_.expected_pieces();
    volume_ = validate(engine_.mesh(), ValidateLevel::kGeometry).volume;
    if (settings.mover == Mover::kSolver) {
      solver_.emplace(engine_.mesh(), solver_options());
      solver_->settle(kSettle);
    } else {
      field_.emplace(rest_bounds(engine_.mesh()), settings.amplitude * spacing_, settings.seed);
    }
    move(0);
  }

  LeakResult run() {
    if (note(engine_.begin_stroke(motion_.pose(0)))) {
      for (unsigned i = 1; i <= settings_.steps && result_.failure.empty(); ++i) step(i);
    }
    if (result_.failure.empty() && watched([&] { return note(engine_.end_stroke()); })) follow();
    finish();
    return std::move(result_);
  }

 private:
  Engine make_engine() {
    EngineOptions options;
    options.cut = settings_.cut;
    options.maintain.merge = options.maintain.improve = settings_.maintains;
    return Engine::create(TetMesh::build(make_body(settings_.body, settings_.seed, spacing_)).value(), options).value();
  }
  [[nodiscard]] BladeMotion make_motion() const {
    return {settings_.motion, rest_bounds(engine_.mesh()), spacing_, settings_.seed * 8191 + 17};
  }
  [[nodiscard]] SoftBodyOptions solver_options() const {
    SoftBodyOptions options;
    options.stretch = settings_.stretch;
    options.spacing = spacing_;
    if (settings_.body == BodyKind::kBall) options.held = 0.1;
    return options;
  }

  void step(unsigned index) {
    const double time = static_cast<double>(index) / settings_.steps;
    const BladePose pose = motion_.pose(time);
    const auto start = Clock::now();
    if (!watched([&] { return note(engine_.step(pose)); })) return;
    result_.engine_ms += ms_since(start);
    if (settings_.check_every > 0 && index % settings_.check_every == 0) check();
    front_.add(engine_.mesh(), stroke_, pose.edge, result_);
    follow();
    move(time);
  }
  /// A call of the engine; what stands inside out after it and did not before is noted.
  template <class Call>
  bool watched(Call&& call) {
    const double before = turned_volume();
    const bool is_fine = call();
    result_.turned_over = std::max(result_.turned_over, (turned_volume() - before) / volume_);
    return is_fine;
  }
  [[nodiscard]] double turned_volume() const {
    const TetMesh& mesh = engine_.mesh();
    double sum = 0;
    mesh.for_each_tet([&](TetId tet) {
      const auto [a, b, c, d] = mesh.vertices(tet);
      sum += std::max(0.0, -signed_volume6(mesh.current(a), mesh.current(b), mesh.current(c), mesh.current(d)) / 6);
    });
    return sum;
  }
  void follow() {
    if (!solver_) return;
    const FollowReport report = solver_->follow(engine_.journal());
    peak_ = std::max({peak_, report.energy_before, solver_->elastic_energy()});
    if (!report.has_changed) return;
    result_.energy_up = std::max(result_.energy_up, report.energy_relaxed - report.energy_before);
    result_.energy_up_raw = std::max(result_.energy_up_raw, report.energy_after - report.energy_before);
    result_.energy_down = std::max(result_.energy_down, report.energy_before - report.energy_relaxed);
    result_.inverted = std::max(result_.inverted, solver_->inverted());
  }
  /// To where the body stands at a share of the time.
  void move(double time) {
    const auto start = Clock::now();
    if (solver_ && time > 0) solver_->step(kSeconds / settings_.steps);
    if (solver_ && !solver_->is_finite()) fail("the solver's places are not finite");
    if (!result_.failure.empty()) return;
    const std::vector<Vec3> places =
        solver_ ? solver_->positions() : field_->positions(engine_.mesh(), kSeconds * time);
    if (const Status status = engine_.set_positions(places); !status) fail(status.error().message);
    result_.solver_ms += ms_since(start);
    if (!solver_) return;
    for (const auto& vertex : solver_->mirror().vertices()) {
      if (vertex.is_live) result_.speed = std::max(result_.speed, vertex.velocity.norm());
    }
  }
  void check() {
    ValidateOptions options;
    options.expected_volume = volume_;
    if (settings_.maintains) options.volume_tolerance = is_paper() ? kPaperVolume : 1e-9;
    const ValidityReport report = validate(engine_.mesh(), ValidateLevel::kGeometry, options);
    result_.volume_change = std::abs(report.volume - volume_) / volume_;
    if (report.ok) return;
    ++result_.invalid;
    const ViolationKind kind = report.first.empty() ? ViolationKind::kVolumeDrift : report.first[0].kind;
    if (first_fault_.empty()) first_fault_ = name_of(kind);
  }
  void finish() {
    check();
    const Components pieces = find_components(engine_.mesh());
    const double crumb = kCrumb * spacing_ * spacing_ * spacing_;
    for (const double volume : pieces.volume) ++(volume < crumb ? result_.crumbs : result_.pieces);
    front_.finish(spacing_, result_);
    if (peak_ > 0) {
      for (double* energy : {&result_.energy_up, &result_.energy_up_raw, &result_.energy_down}) *energy /= peak_;
    }
    result_.tets = engine_.mesh().tet_count();
    if (result_.failure.empty()) result_.failure = first_fault_;
  }

  [[nodiscard]] bool is_paper() const { return settings_.cut.profile == Profile::kPaper; }

  template <class T>
  bool note(const Result<T>& result) {
    if (!result) fail(result.error().message);
    return result.ok();
  }
  void fail(const std::string& what) {
    if (result_.failure.empty()) result_.failure = what;
  }

  LeakSettings settings_;
  double spacing_ = 0;
  Engine engine_;
  BladeMotion motion_;
  std::uint32_t stroke_;
  std::optional<SoftBody> solver_;
  std::optional<SwayingField> field_;
  FrontError front_;
  LeakResult result_;
  std::string first_fault_;
  double volume_ = 0, peak_ = 0;
};

}  // namespace

const char* name_of(BodyKind kind) {
  static constexpr std::array<const char*, kBodyKinds> kNames = {"beam", "cube", "ball", "shuffled"};
  return kNames[static_cast<std::size_t>(kind)];
}

TetSoup make_body(BodyKind kind, std::uint64_t seed, double& spacing) {
  spacing = 1.0 / 6.0;
  if (kind == BodyKind::kBeam) return beam(seed);
  if (kind == BodyKind::kCube) return jittered_cube(6, seed);
  if (kind == BodyKind::kShuffled) return shuffled(beam(seed), 0.02 * spacing * spacing * spacing, seed);
  TetSoup soup = ball(8);
  for (Vec3& p : soup.points) p *= 0.6;
  spacing = 0.15;
  return renumbered(soup, seed);
}

LeakResult run_leak(const LeakSettings& settings) {
  return Run(settings).run();
}

}  // namespace incise::test
