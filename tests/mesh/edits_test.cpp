// SPDX-License-Identifier: Apache-2.0
// Random programs of collapses, swaps, removals, splits and moves within transactions that keep their edits, and the
// followers of their steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cut/cutter.h"
#include "incise/mesh/attributes.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/collapse.h"
#include "incise/mesh/remesh.h"
#include "incise/mesh/star.h"
#include "incise/mesh/validate.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/mirror_checks.h"
#include "support/random.h"

namespace incise::test::edits_test {
namespace {

constexpr double kLeastVolume = 1e-6;  // of a tet that an edit makes, of the unit cube's: rounding stays below 1e-12

double density_of(std::int32_t region) {
  return 2.5 + region;
}

/// Draws edits that a mesh admits: tets stay positive, flat surfaces flat, and regions where they are.
class Program {
 public:
  Program(Transaction& transaction, Random& random)
      : transaction_(transaction), mesh_(transaction.mesh()), random_(random) {}

  void run(unsigned edits) {
    using Draw = bool (Program::*)();
    static constexpr std::array<Draw, 9> kDraws = {&Program::collapse,   &Program::collapse,  &Program::swap,
                                                   &Program::remove,     &Program::remove,    &Program::split_edge,
                                                   &Program::split_face, &Program::split_tet, &Program::move};
    for (unsigned done = 0; done < edits;) {
      const auto kind = static_cast<std::size_t>(random_.integer(0, kDraws.size() - 1));
      unsigned tries = 0;
      while (tries < 100 && !(this->*kDraws[kind])()) ++tries;
      if (tries == 100) continue;
      ++done;
      ++counts[kind];
    }
  }

  std::array<unsigned, 9> counts{};

 private:
  TetId any_tet() {
    TetId tet;
    do {
      tet = TetId(static_cast<std::uint32_t>(random_.integer(0, mesh_.tet_slots() - 1)));
    } while (!mesh_.is_live(tet));
    return tet;
  }
  unsigned corner() { return static_cast<unsigned>(random_.integer(0, 3)); }
  [[nodiscard]] double volume_with(TetVertices v, VertexId from, const Vec3& place) const {
    std::array<Vec3, 4> p;
    for (unsigned c = 0; c < 4; ++c) p[c] = v[c] == from ? place : mesh_.rest(v[c]);
    return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) / 6.0;
  }
  [[nodiscard]] double volume_of(const TetVertices& v) const { return volume_with(v, {}, Vec3::Zero()); }

  bool collapse() {
    const TetVertices v = mesh_.vertices(any_tet());
    const unsigned a = corner(), b = corner();
    planner_.plan(mesh_, v[a], v[b], plan_);
    if (!plan_ || !stays_positive(mesh_, plan_, mesh_.rest(v[b])) || !keeps_cavity(mesh_.rest(v[b]))) return false;
    apply(transaction_, plan_);
    return true;
  }
  /// Whether the surface stays where it is, and no sliver comes about.
  [[nodiscard]] bool keeps_cavity(const Vec3& place) const {
    double before = 0, after = 0, least = 1;
    for (const TetId tet : plan_.ring) before += mesh_.rest_volume(tet);
    for (const TetId tet : plan_.fan) {
      const double volume = volume_with(mesh_.vertices(tet), plan_.from, place);
      before += mesh_.rest_volume(tet);
      after += volume;
      least = std::min(least, volume);
    }
    return least > kLeastVolume && std::abs(after - before) < 1e-14;
  }
  bool swap() { return refill(plan_swap_23(mesh_, {any_tet(), corner()})); }
  bool remove() {
    const TetId tet = any_tet();
    const auto [i, j] = kEdgeCorners[static_cast<std::size_t>(random_.integer(0, 5))];
    const VertexId a = mesh_.vertices(tet)[i], b = mesh_.vertices(tet)[j];
    EdgeRing ring;
    find_edge_ring(mesh_, a, b, tet, ring);
    const auto has_other_region = [&](TetId t) { return mesh_.region(t) != mesh_.region(tet); };
    if (ring.vertices.size() < 3 || std::any_of(ring.tets.begin(), ring.tets.end(), has_other_region)) return false;
    if (!ring.is_closed && tag_at_end(ring, 0, 1) != tag_at_end(ring, ring.tets.size() - 1, ring.tets.size() - 1)) {
      return false;
    }
    RemeshPlan plan;
    fill_edge_removal(mesh_, a, b, ring, any_fan(ring.vertices.size()), plan);
    return refill(plan);
  }
  [[nodiscard]] std::uint32_t tag_at_end(const EdgeRing& ring, std::size_t tet, std::size_t away_from) const {
    return mesh_.links(ring.tets[tet])[mesh_.corner_of(ring.tets[tet], ring.vertices[away_from])].tag();
  }
  std::vector<RingTriangle> any_fan(std::size_t count) {
    const auto apex = static_cast<std::uint8_t>(random_.integer(0, static_cast<std::int64_t>(count) - 1));
    std::vector<RingTriangle> triangles;
    for (std::uint8_t i = 0; i < count; ++i) {
      const auto next = static_cast<std::uint8_t>((i + 1U) % count);
      if (i == apex || next == apex) continue;
      triangles.push_back({apex, i, next});
      std::sort(triangles.back().begin(), triangles.back().end());
    }
    return triangles;
  }
  bool refill(const RemeshPlan& plan) {
    if (!plan) return false;
    double before = 0, after = 0, least = 1;
    for (const TetId tet : plan.consumed) before += mesh_.rest_volume(tet);
    for (const NewTet& tet : plan.produced) {
      after += volume_of(tet.vertices);
      least = std::min(least, volume_of(tet.vertices));
    }
    if (least < kLeastVolume || std::abs(after - before) > 1e-14) return false;
    std::vector<TetId> produced;
    apply(transaction_, plan, produced);
    return true;
  }
  bool split_edge() {
    const TetId tet = any_tet();
    const auto [i, j] = kEdgeCorners[static_cast<std::size_t>(random_.integer(0, 5))];
    const SplitEdgePlan plan =
        plan_split_edge(mesh_, mesh_.vertices(tet)[i], mesh_.vertices(tet)[j], tet, random_.real(0.3, 0.7));
    const auto is_small = [&](TetId t) { return mesh_.rest_volume(t) < 4 * kLeastVolume; };
    if (!plan || std::any_of(plan.ring.begin(), plan.ring.end(), is_small)) return false;
    apply(transaction_, plan);
    return true;
  }
  bool split_face() {
    const Side face(any_tet(), corner());
    const double a = random_.real(0.2, 0.4), b = random_.real(0.2, 0.4);
    const SplitFacePlan plan = plan_split_face(mesh_, face, {a, b, 1.0 - a - b});
    const Link behind = mesh_.link(face);
    if (!plan || mesh_.rest_volume(face.tet()) < 6 * kLeastVolume ||
        (!behind.is_boundary() && mesh_.rest_volume(behind.side().tet()) < 6 * kLeastVolume)) {
      return false;
    }
    apply(transaction_, plan);
    return true;
  }
  bool split_tet() {
    const TetId tet = any_tet();
    const double a = random_.real(0.1, 0.3), b = random_.real(0.1, 0.3), c = random_.real(0.1, 0.3);
    const SplitTetPlan plan = plan_split_tet(mesh_, tet, {a, b, c, 1.0 - a - b - c});
    if (!plan || mesh_.rest_volume(tet) < 11 * kLeastVolume) return false;
    apply(transaction_, plan);
    return true;
  }
  /// Interior vertices go anywhere, those of the cube's skin within its faces and along its edges.
  bool move() {
    const VertexId vertex = mesh_.vertices(any_tet())[corner()];
    Vec3 place = mesh_.rest(vertex) + random_.point(-0.05, 0.05);
    for (int axis = 0; axis < 3; ++axis) {
      const double x = mesh_.rest(vertex)[axis];
      if (std::abs(x) < 1e-9 || std::abs(x - 1) < 1e-9) place[axis] = x;
    }
    if ((mesh_.shape_of(vertex) & shape::kWall) != 0 || place == mesh_.rest(vertex)) return false;
    const std::vector<TetId>& star = walker_.star(mesh_, vertex);
    const auto is_bad = [&](TetId tet) {
      return mesh_.region(tet) != mesh_.region(star.front()) ||
             volume_with(mesh_.vertices(tet), vertex, place) < kLeastVolume;
    };
    if (std::any_of(star.begin(), star.end(), is_bad)) return false;
    const MoveVertexPlan plan = plan_move_vertex(mesh_, vertex, place);
    if (!plan) return false;
    apply(transaction_, plan);
    return true;
  }

  Transaction& transaction_;
  const TetMesh& mesh_;
  Random& random_;
  CollapsePlanner planner_;
  CollapsePlan plan_;
  StarWalker walker_;
};

/// What a solver keeps: mass by region at the tets, a uniform mass and a linear velocity at the vertices, and labels.
class Body {
 public:
  explicit Body(const TetMesh& mesh) : all(mesh) {
    const auto add = [&](const char* name, Domain domain, std::uint32_t width, Transfer transfer) {
      AttributeSpec spec;
      spec.name = name;
      spec.domain = domain;
      spec.width = width;
      spec.transfer = transfer;
      if (transfer == Transfer::kRecompute) {
        spec.recompute = [](const TetMesh& m, std::uint32_t slot, std::span<double> value) {
          value[0] = m.rest_volume(TetId(slot));
        };
      }
      return *all.add(mesh, spec);
    };
    mass = add("mass", Domain::kVertex, 1, Transfer::kConserve);
    any_mass = add("any mass", Domain::kVertex, 2, Transfer::kConserve);
    velocity = add("velocity", Domain::kVertex, 3, Transfer::kInterpolate);
    label = add("label", Domain::kVertex, 1, Transfer::kInherit);
    tet_mass = add("tet mass", Domain::kTet, 1, Transfer::kConserve);
    any_tet_mass = add("any tet mass", Domain::kTet, 2, Transfer::kConserve);
    region = add("region", Domain::kTet, 1, Transfer::kInherit);
    volume = add("volume", Domain::kTet, 1, Transfer::kRecompute);
    start(mesh);
  }
  void follow(const Journal& journal, const TetMesh& mesh) {
    ASSERT_TRUE(all.follow(journal, mesh).ok());
    expect_sums();
    expect_uniform(mesh);
    expect_tets(mesh);
    expect_nothing_dead(mesh);
  }
  [[nodiscard]] std::vector<std::vector<double>> snapshot() const {
    std::vector<std::vector<double>> values;
    for (std::uint32_t a = 0; a < all.size(); ++a) {
      const auto v = all.values(AttributeId(a));
      values.emplace_back(v.begin(), v.end());
    }
    return values;
  }
  void expect_equal(const std::vector<std::vector<double>>& values) const {
    for (std::uint32_t a = 0; a < all.size(); ++a) {
      const auto v = all.values(AttributeId(a));
      ASSERT_EQ(v.size(), values[a].size());
      EXPECT_EQ(std::memcmp(v.data(), values[a].data(), v.size_bytes()), 0) << all.spec(AttributeId(a)).name;
    }
  }

  Attributes all;
  AttributeId mass, any_mass, velocity, label, tet_mass, any_tet_mass, region, volume;
  double worst = 0;  // relative error of a density

 private:
  void start(const TetMesh& mesh) {
    Random random(99);
    mesh.for_each_vertex([&](VertexId v) {
      const Vec3 speed = affine_velocity(mesh.rest(v));
      all.value(mass, v.value)[0] = 2.5 * all.lumped_volume(v);
      all.value(any_mass, v.value)[0] = random.real(0, 1) < 0.5 ? 0.0 : random.real(0, 1);
      all.value(any_mass, v.value)[1] = random.real(-1, 1);
      all.value(label, v.value)[0] = 1 + v.value;
      std::copy_n(speed.data(), 3, all.value(velocity, v.value).data());
    });
    mesh.for_each_tet([&](TetId t) {
      all.value(tet_mass, t.value)[0] = density_of(mesh.region(t)) * mesh.rest_volume(t);
      all.value(any_tet_mass, t.value)[0] = random.real(0, 1) < 0.5 ? 0.0 : random.real(0, 1);
      all.value(any_tet_mass, t.value)[1] = random.real(-1, 1);
      all.value(region, t.value)[0] = mesh.region(t);
    });
    for (const AttributeId id : {mass, any_mass, tet_mass, any_tet_mass}) sums_.push_back(sums(id));
    momentum_ = momentum();
  }
  [[nodiscard]] std::array<double, 2> sums(AttributeId id) const {
    std::array<double, 2> sum{};
    const auto values = all.values(id);
    const std::uint32_t width = all.spec(id).width;
    for (std::size_t i = 0; i < values.size(); ++i) sum[i % width] += values[i];
    return sum;
  }
  [[nodiscard]] Vec3 momentum() const {
    Vec3 sum = Vec3::Zero();
    const auto masses = all.values(mass), speeds = all.values(velocity);
    for (std::size_t v = 0; v < masses.size(); ++v) {
      sum += masses[v] * Vec3(speeds[3 * v], speeds[3 * v + 1], speeds[3 * v + 2]);
    }
    return sum;
  }
  void expect_sums() const {
    std::size_t i = 0;
    for (const AttributeId id : {mass, any_mass, tet_mass, any_tet_mass}) {
      const auto now = sums(id);
      for (unsigned k = 0; k < 2; ++k) {
        EXPECT_NEAR(now[k], sums_[i][k], 1e-12 * std::max(1.0, std::abs(sums_[i][k]))) << all.spec(id).name;
      }
      ++i;
    }
    EXPECT_LE((momentum() - momentum_).norm(), 1e-12 * momentum_.norm());
    for (const AttributeId id : {any_mass, any_tet_mass}) {
      for (std::size_t k = 0; k < all.values(id).size(); k += 2) EXPECT_GE(all.values(id)[k], -1e-15);
    }
  }
  void expect_uniform(const TetMesh& mesh) {
    std::vector<double> lumped(mesh.vertex_slots());
    mesh.for_each_tet([&](TetId t) {
      for (const VertexId v : mesh.vertices(t)) lumped[v.value] += 0.25 * mesh.rest_volume(t);
    });
    mesh.for_each_vertex([&](VertexId v) {
      EXPECT_NEAR(all.lumped_volume(v), lumped[v.value], 1e-12 * lumped[v.value]);
      note_error(all.value(mass, v.value)[0] / (2.5 * lumped[v.value]));
      const auto speed = all.value(velocity, v.value);
      EXPECT_LE((Vec3(speed[0], speed[1], speed[2]) - affine_velocity(mesh.rest(v))).norm(), 1e-12);
      EXPECT_GE(all.value(label, v.value)[0], 1.0);
    });
  }
  void expect_tets(const TetMesh& mesh) {
    mesh.for_each_tet([&](TetId t) {
      EXPECT_EQ(all.value(region, t.value)[0], mesh.region(t));
      EXPECT_EQ(all.value(volume, t.value)[0], mesh.rest_volume(t));
      note_error(all.value(tet_mass, t.value)[0] / (density_of(mesh.region(t)) * mesh.rest_volume(t)));
    });
    EXPECT_LE(worst, 1e-12);
  }
  void note_error(double ratio) { worst = std::max(worst, std::abs(ratio - 1.0)); }
  void expect_nothing_dead(const TetMesh& mesh) {
    for (std::uint32_t a = 0; a < all.size(); ++a) {
      const bool is_vertex = all.spec(AttributeId(a)).domain == Domain::kVertex;
      const std::uint32_t slots = is_vertex ? mesh.vertex_slots() : mesh.tet_slots();
      for (std::uint32_t slot = 0; slot < slots; ++slot) {
        if (is_vertex ? mesh.is_live(VertexId(slot)) : mesh.is_live(TetId(slot))) continue;
        for (const double value : all.value(AttributeId(a), slot))
          ASSERT_EQ(value, 0.0) << all.spec(AttributeId(a)).name;
      }
    }
  }

  std::vector<std::array<double, 2>> sums_;
  Vec3 momentum_ = Vec3::Zero();
};

/// A mesh with all its followers.
class Scene {
 public:
  Scene(TetMesh start, std::uint64_t seed)
      : mesh(std::move(start)),
        body(mesh),
        by_lists_(mirror_of(mesh, StepReading::kNet)),
        by_edits_(mirror_of(mesh)),
        random_(seed),
        volume_(volume_of(mesh)),
        hashes_{mesh.hash()},
        states_{body.snapshot()} {}

  /// One transaction of random edits, and everything that must hold after it.
  void edit(unsigned count) {
    Transaction transaction(mesh, true);
    Program program(transaction, random_);
    program.run(count);
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += program.counts[i];
    journal.append(transaction.commit());
    check_step();
  }
  /// Undo and redo of everything return every hash, and every bit of the followers' values.
  void expect_reversible() {
    for (std::size_t i = hashes_.size() - 1; i-- > 0;) {
      ASSERT_TRUE(journal.undo(mesh));
      expect_state(i);
    }
    for (std::size_t i = 1; i < hashes_.size(); ++i) {
      ASSERT_TRUE(journal.redo(mesh));
      expect_state(i);
    }
  }

  TetMesh mesh;
  Journal journal;
  Body body;
  std::array<unsigned, 9> counts{};

 private:
  void check_step() {
    expect_valid(mesh, volume_);
    expect_mirrors();
    expect_affine_velocity(by_edits_, 1e-12);
    body.follow(journal, mesh);
    hashes_.push_back(mesh.hash());
    states_.push_back(body.snapshot());
  }
  void expect_mirrors() {
    expect_follows(by_lists_, journal, mesh);
    expect_follows(by_edits_, journal, mesh);
  }
  void expect_state(std::size_t i) {
    ASSERT_EQ(mesh.hash(), hashes_[i]);
    expect_mirrors();
    ASSERT_TRUE(body.all.follow(journal, mesh).ok());
    body.expect_equal(states_[i]);
  }

  JournalMirror by_lists_, by_edits_;
  Random random_;
  double volume_;
  std::vector<std::uint64_t> hashes_;
  std::vector<std::vector<std::vector<double>>> states_;
};

TetMesh cube_of_regions(std::uint32_t n, std::uint64_t seed) {
  TetSoup soup = jittered_cube(n, seed);
  for (const auto& tet : soup.tets) {
    double x = 0;
    for (const std::uint32_t v : tet) x += 0.25 * soup.points[v].x();
    soup.regions.push_back(x < 0.4 ? 0 : 1);
  }
  return build(std::move(soup));
}

TEST(EditProgram, in_one_transaction_is_followed_by_every_follower) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene(build(jittered_cube(3, seed)), seed);
    scene.edit(1000);
    for (const unsigned count : scene.counts) EXPECT_GT(count, 50U);
    EXPECT_GT(scene.journal.step(0).died.size(), 100U);
    scene.expect_reversible();
    if (testing::Test::HasFailure()) break;
  }
}

TEST(EditProgram, in_many_transactions_uses_freed_slots_again) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene(build(jittered_cube(3, seed)), seed);
    for (unsigned chunk = 0; chunk < 12; ++chunk) scene.edit(80);
    unsigned reused = 0;
    scene.mesh.for_each_tet([&](TetId t) { reused += scene.mesh.generation(t) > 0 ? 1U : 0U; });
    EXPECT_GT(reused, 50U);
    scene.expect_reversible();
    if (testing::Test::HasFailure()) break;
  }
}

TEST(EditProgram, leaves_the_mass_of_every_region_to_it) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene(cube_of_regions(3, seed), seed);
    scene.edit(200);
    scene.edit(200);
    scene.expect_reversible();
    if (testing::Test::HasFailure()) break;
  }
}

TEST(EditProgram, works_beside_a_cut) {
  TetMesh mesh = build(jittered_cube(3, 5));
  Cutter cutter({Profile::kIncise, 0.1});
  Journal journal;
  StageTimes times;
  for (const Vec3& normal : {Vec3(0.3, 1, 0.17), Vec3(1, -0.2, 0.31)}) {
    const auto stroke = plane_stroke(rest_bounds(mesh), normal, 0.53);
    ASSERT_TRUE(cutter.cut(mesh, journal, *stroke, 1, times).ok());
  }
  Scene scene(std::move(mesh), 5);
  for (unsigned chunk = 0; chunk < 4; ++chunk) scene.edit(100);
  scene.expect_reversible();
}

TEST(EditProgram, taken_back_leaves_no_trace) {
  TetMesh mesh = build(jittered_cube(3, 2));
  const std::uint64_t hash = mesh.hash();
  Random random(2);
  {
    Transaction transaction(mesh, true);
    Program(transaction, random).run(300);
    EXPECT_NE(mesh.hash(), hash);
  }
  EXPECT_EQ(mesh.hash(), hash);
}

TEST(EditProgram, many_steps_at_once_give_what_they_give_one_by_one) {
  Scene scene(build(jittered_cube(3, 8)), 8);
  Body seldom(scene.mesh);
  for (unsigned chunk = 0; chunk < 5; ++chunk) scene.edit(50);
  ASSERT_TRUE(seldom.all.follow(scene.journal, scene.mesh).ok());
  seldom.expect_equal(scene.body.snapshot());
}

TEST(EditStep, lists_a_vertex_that_was_born_and_merged_away) {
  TetMesh mesh = build(kuhn_cube(3));
  JournalMirror mirror = mirror_of(mesh, StepReading::kNet);
  Body body(mesh);
  Journal journal;
  Transaction transaction(mesh, true);
  const VertexId old = mesh.vertices(TetId(40))[0];
  const VertexId born = apply(transaction, plan_split_tet(mesh, TetId(40), {0.25, 0.25, 0.25, 0.25})).vertex;
  CollapsePlanner planner;
  CollapsePlan plan;
  planner.plan(mesh, born, old, plan);
  ASSERT_TRUE(plan);
  apply(transaction, plan);
  journal.append(transaction.commit());
  const Step& step = journal.step(0);
  EXPECT_EQ(step.died, std::vector<VertexId>{born});
  EXPECT_EQ(step.edits.size(), 2U);
  EXPECT_EQ(step.consumed.size(), 1U);
  EXPECT_EQ(step.produced.size(), 1U);
  expect_follows(mirror, journal, mesh);
  body.follow(journal, mesh);
  expect_valid(mesh, 1.0);
}

TEST(EditStep, may_name_a_vertex_that_no_edit_put_in) {
  TetMesh mesh = build(kuhn_cube(2));
  JournalMirror by_lists = mirror_of(mesh, StepReading::kNet), by_edits = mirror_of(mesh);
  Body body(mesh);
  Journal journal;
  const std::uint64_t hash = mesh.hash();
  Transaction transaction(mesh, true);
  const VertexId given_up = transaction.add_vertex_on_edge(VertexId(0), VertexId(1), 0.5);
  transaction.remove_vertex(given_up);
  const VertexId kept = apply(transaction, plan_split_tet(mesh, TetId(7), {0.25, 0.25, 0.25, 0.25})).vertex;
  journal.append(transaction.commit());
  const Step& step = journal.step(0);
  EXPECT_EQ(step.died, std::vector<VertexId>{given_up});
  EXPECT_EQ(step.born[step.edits[0].vertex].id, kept);
  expect_follows(by_lists, journal, mesh);
  expect_follows(by_edits, journal, mesh);
  body.follow(journal, mesh);
  expect_valid(mesh, 1.0);
  ASSERT_TRUE(journal.undo(mesh));
  EXPECT_EQ(mesh.hash(), hash);
}

TEST(EditStep, that_fills_a_larger_cavity_with_one_tet_keeps_the_mass_of_the_vertex_that_dies) {
  TetSoup soup;  // a tip on a tet, taken away
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1}, {0.3, 0.3, -0.1}};
  soup.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  soup.regions = {0, 0};
  TetMesh mesh = build(soup);
  Body body(mesh);
  Journal journal;
  for (std::uint32_t v = 0; v < 5; ++v) body.all.value(body.any_mass, v)[0] = v == 4 ? 12.0 : 0.0;
  RemeshPlan plan;
  plan.consumed = {TetId(0), TetId(1)};
  plan.produced = {{mesh.vertices(TetId(0)), 0}};
  std::vector<TetId> produced;
  Transaction transaction(mesh, true);
  apply(transaction, plan, produced);
  transaction.remove_vertex(VertexId(4));
  journal.append(transaction.commit());
  ASSERT_TRUE(body.all.follow(journal, mesh).ok());
  for (std::uint32_t v = 0; v < 5; ++v) {
    EXPECT_NEAR(body.all.value(body.any_mass, v)[0], v == 4 ? 0.0 : 3.0, 1e-14);
  }
  expect_valid(mesh, 1.0 / 6.0);
}

TEST(EditStep, of_a_collapse_lists_the_tets_that_live_on_twice) {
  TetMesh mesh = build(kuhn_cube(4));
  CollapsePlanner planner;
  CollapsePlan plan;
  planner.plan(mesh, VertexId(2 + 5 * (2 + 5 * 2)), VertexId(2 + 5 * (2 + 5 * 1)), plan);
  ASSERT_TRUE(plan);
  Transaction transaction(mesh, true);
  apply(transaction, plan);
  const Step step = transaction.commit();
  ASSERT_EQ(step.edits.size(), 1U);
  EXPECT_EQ(step.edit_consumed.size(), plan.ring.size() + plan.fan.size());
  ASSERT_EQ(step.edit_produced.size(), plan.fan.size());
  for (const ProducedTet& tet : step.edit_produced) {
    EXPECT_EQ(tet.parent, tet.id);
    EXPECT_EQ(std::count(tet.vertices.begin(), tet.vertices.end(), plan.into), 1);
  }
}

TEST(EditStep, hands_the_mass_of_a_cavity_to_its_new_tets) {
  TetSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1}, {0.3, 0.3, -1}};
  soup.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  soup.regions = {0, 0};
  TetMesh mesh = build(soup);
  Body body(mesh);
  for (std::uint32_t v = 0; v < 5; ++v) body.all.value(body.any_mass, v)[0] = v == 3 ? 12.0 : 0.0;
  body.all.value(body.any_tet_mass, 0)[0] = 6.0;
  body.all.value(body.any_tet_mass, 1)[0] = 0.0;
  Journal journal;
  Transaction transaction(mesh, true);
  std::vector<TetId> produced;
  apply(transaction, plan_swap_23(mesh, {TetId(0), 3}), produced);
  journal.append(transaction.commit());
  ASSERT_TRUE(body.all.follow(journal, mesh).ok());
  for (const TetId tet : produced) {
    EXPECT_NEAR(body.all.value(body.any_tet_mass, tet.value)[0], 18.0 * mesh.rest_volume(tet), 1e-14);
  }
  for (std::uint32_t v = 0; v < 5; ++v) {
    EXPECT_NEAR(body.all.value(body.any_mass, v)[0], 36.0 * body.all.lumped_volume(VertexId(v)), 1e-14);
  }
}

}  // namespace
}  // namespace incise::test::edits_test
