// SPDX-License-Identifier: Apache-2.0
#include "incise/mesh/attributes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "incise/engine/engine.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/shapes.h"
#include "incise/mesh/verbs.h"
#include "support/random.h"

namespace incise::attributes_test {
namespace {

AttributeSpec spec_of(const std::string& name, Domain domain, std::uint32_t width, Transfer transfer) {
  AttributeSpec spec;
  spec.name = name;
  spec.domain = domain;
  spec.width = width;
  spec.transfer = transfer;
  return spec;
}

double sum(std::span<const double> values) {
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

bool is_same(const std::vector<double>& a, std::span<const double> b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

std::vector<double> copy_of(std::span<const double> values) {
  return {values.begin(), values.end()};
}

Vec3 velocity_at(const Vec3& x) {
  return {1.0 + 2.0 * x.x() - x.z(), -0.5 + x.x() + 3.0 * x.y(), 0.25 - x.y() + 0.5 * x.z()};
}

/// Lumped volumes, from the mesh alone.
std::vector<double> lumps(const TetMesh& mesh) {
  std::vector<double> lumped(mesh.vertex_slots(), 0.0);
  mesh.for_each_tet([&](TetId t) {
    for (const VertexId v : mesh.vertices(t)) lumped[v.value] += 0.25 * mesh.rest_volume(t);
  });
  return lumped;
}

/// A body with mass and velocity at its vertices, mass and a label at its tets, and functions of the mesh.
struct Body {
  explicit Body(const TetMesh& mesh) : all(mesh) {
    mass = *all.add(mesh, spec_of("mass", Domain::kVertex, 1, Transfer::kConserve));
    velocity = *all.add(mesh, spec_of("velocity", Domain::kVertex, 3, Transfer::kInterpolate));
    label = *all.add(mesh, spec_of("label", Domain::kVertex, 1, Transfer::kInherit));
    tet_mass = *all.add(mesh, spec_of("tet mass", Domain::kTet, 1, Transfer::kConserve));
    region = *all.add(mesh, spec_of("region", Domain::kTet, 1, Transfer::kInherit));
    AttributeSpec volume = spec_of("volume", Domain::kTet, 1, Transfer::kRecompute);
    volume.recompute = [](const TetMesh& m, std::uint32_t slot, std::span<double> value) {
      value[0] = m.rest_volume(TetId(slot));
    };
    tet_volume = *all.add(mesh, volume);
    AttributeSpec place = spec_of("place", Domain::kVertex, 3, Transfer::kRecompute);
    place.recompute = [](const TetMesh& m, std::uint32_t slot, std::span<double> value) {
      for (int axis = 0; axis < 3; ++axis) value[static_cast<std::size_t>(axis)] = m.rest(VertexId(slot))[axis];
    };
    position = *all.add(mesh, place);
    mesh.for_each_vertex([&](VertexId v) {
      const Vec3 speed = velocity_at(mesh.rest(v));
      all.value(mass, v.value)[0] = 2.5 * all.lumped_volume(v);
      all.value(label, v.value)[0] = v.value;
      for (int axis = 0; axis < 3; ++axis) all.value(velocity, v.value)[static_cast<std::size_t>(axis)] = speed[axis];
    });
    mesh.for_each_tet([&](TetId t) {
      all.value(tet_mass, t.value)[0] = 2.5 * mesh.rest_volume(t);
      all.value(region, t.value)[0] = mesh.region(t);
    });
  }

  [[nodiscard]] Vec3 momentum(const TetMesh& mesh) {
    Vec3 total = Vec3::Zero();
    mesh.for_each_vertex([&](VertexId v) {
      const auto speed = all.value(velocity, v.value);
      total += all.value(mass, v.value)[0] * Vec3(speed[0], speed[1], speed[2]);
    });
    return total;
  }
  [[nodiscard]] std::vector<std::vector<double>> snapshot() const {
    std::vector<std::vector<double>> values;
    for (std::uint32_t a = 0; a < all.size(); ++a) values.push_back(copy_of(all.values(AttributeId(a))));
    return values;
  }
  void expect_equal(const std::vector<std::vector<double>>& values) const {
    for (std::uint32_t a = 0; a < all.size(); ++a) {
      EXPECT_TRUE(is_same(values[a], all.values(AttributeId(a)))) << all.spec(AttributeId(a)).name;
    }
  }
  /// Everything that holds for a uniform body in a linear field, whatever was done to the mesh.
  void expect_uniform(const TetMesh& mesh, const Vec3& momentum_at_start) {
    EXPECT_NEAR(sum(all.values(mass)), 2.5, 2.5e-13);
    EXPECT_NEAR(sum(all.values(tet_mass)), 2.5, 2.5e-13);
    EXPECT_LE((momentum(mesh) - momentum_at_start).norm(), 1e-12 * momentum_at_start.norm());
    const std::vector<double> lumped = lumps(mesh);
    mesh.for_each_vertex([&](VertexId v) {
      EXPECT_NEAR(all.lumped_volume(v), lumped[v.value], 1e-15);
      EXPECT_NEAR(all.value(mass, v.value)[0], 2.5 * lumped[v.value], 1e-14);
      const auto speed = all.value(velocity, v.value);
      EXPECT_LE((Vec3(speed[0], speed[1], speed[2]) - velocity_at(mesh.rest(v))).norm(), 1e-12);
      const auto place = all.value(position, v.value);
      EXPECT_EQ(Vec3(place[0], place[1], place[2]), mesh.rest(v));
    });
    mesh.for_each_tet([&](TetId t) {
      EXPECT_NEAR(all.value(tet_mass, t.value)[0], 2.5 * mesh.rest_volume(t), 1e-14);
      EXPECT_EQ(all.value(region, t.value)[0], mesh.region(t));
      EXPECT_EQ(all.value(tet_volume, t.value)[0], mesh.rest_volume(t));
    });
  }

  Attributes all;
  AttributeId mass, velocity, label, tet_mass, region, tet_volume, position;
};

TetMesh jittered_cube(std::uint32_t n, double fraction = 0.1) {
  TetSoup soup = kuhn_cube(n);
  jitter(soup, fraction, 7);
  soup.regions.assign(soup.tets.size(), 3);  // one only: vertices between regions do not move
  return *TetMesh::build(soup);
}

Engine new_engine(TetMesh mesh, EngineOptions options = {}) {
  return Engine::create(std::move(mesh), std::move(options)).value();
}

Box unit_box() {
  Box box;
  box.extend(Vec3(-0.1, -0.1, -0.1));
  box.extend(Vec3(1.1, 1.1, 1.1));
  return box;
}

std::vector<Stroke> three_cuts() {
  // The first passes vertices so closely that they move onto it.
  return {*plane_stroke(unit_box(), {1, 0, 0}, 0.52), *plane_stroke(unit_box(), {-0.3, 1, 0.2}, 0.37),
          *plane_stroke(unit_box(), {0.2, 0.1, 1}, 0.7)};
}

TEST(Attributes, refuses_malformed_specifications) {
  const TetMesh mesh = jittered_cube(1);
  Attributes all(mesh);
  ASSERT_TRUE(all.add(mesh, spec_of("a", Domain::kVertex, 1, Transfer::kInherit)).ok());
  EXPECT_EQ(all.add(mesh, spec_of("a", Domain::kTet, 1, Transfer::kInherit)).error().code, ErrorCode::kBadArgument);
  EXPECT_FALSE(all.add(mesh, spec_of("", Domain::kTet, 1, Transfer::kInherit)).ok());
  EXPECT_FALSE(all.add(mesh, spec_of("b", Domain::kTet, 0, Transfer::kInherit)).ok());
  EXPECT_FALSE(all.add(mesh, spec_of("b", Domain::kTet, 65, Transfer::kInherit)).ok());
  EXPECT_FALSE(all.add(mesh, spec_of("b", Domain::kTet, 1, Transfer::kRecompute)).ok());
  AttributeSpec wrong = spec_of("b", Domain::kTet, 2, Transfer::kConserve);
  wrong.initial = {1.0};
  EXPECT_FALSE(all.add(mesh, wrong).ok());
  EXPECT_EQ(all.size(), 1U);
  EXPECT_FALSE(all.find("b").is_valid());
  EXPECT_EQ(all.find("a"), AttributeId(0));
}

TEST(Attributes, start_with_the_initial_value) {
  const TetMesh mesh = jittered_cube(1);
  Attributes all(mesh);
  AttributeSpec spec = spec_of("pair", Domain::kTet, 2, Transfer::kInterpolate);
  spec.initial = {3.0, 4.0};
  const AttributeId id = *all.add(mesh, spec);
  ASSERT_EQ(all.values(id).size(), 12U);
  EXPECT_EQ(all.value(id, 5)[0], 3.0);
  EXPECT_EQ(all.value(id, 5)[1], 4.0);
}

TEST(Attributes, a_split_edge_hands_values_down) {
  TetSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  soup.tets = {{0, 1, 2, 3}};
  TetMesh mesh = *TetMesh::build(soup);
  Body body(mesh);
  // Not uniform: all mass at vertex 0.
  for (std::uint32_t v = 0; v < 4; ++v) body.all.value(body.mass, v)[0] = v == 0 ? 8.0 : 0.0;
  Journal journal;
  Transaction transaction(mesh);
  const auto split = apply(transaction, plan_split_edge(mesh, VertexId(0), VertexId(1), TetId(0), 0.25));
  journal.append(transaction.commit());
  ASSERT_TRUE(body.all.follow(journal, mesh).ok());
  EXPECT_EQ(body.all.value(body.label, split.vertex.value)[0], 0.0);  // the nearer end
  EXPECT_NEAR(sum(body.all.values(body.mass)), 8.0, 1e-15);
  EXPECT_NEAR(body.all.value(body.mass, 0)[0], 0.25 * 8.0 / 4.0, 1e-15);
  EXPECT_NEAR(body.all.value(body.mass, 1)[0], 0.75 * 8.0 / 4.0, 1e-15);
  EXPECT_NEAR(body.all.value(body.mass, split.vertex.value)[0], 8.0 / 4.0, 1e-15);
  EXPECT_EQ(body.all.value(body.tet_mass, 0)[0], 0.0);  // a dead slot
  EXPECT_NEAR(body.all.value(body.tet_mass, split.halves[0].keeps_a.value)[0], 0.25 * 2.5 / 6.0, 1e-15);
}

TEST(Attributes, equal_weights_inherit_from_the_first_parent) {
  TetMesh mesh = jittered_cube(1);
  Body body(mesh);
  Journal journal;
  Transaction transaction(mesh);
  const TetVertices corners = mesh.vertices(TetId(2));
  const auto split = apply(transaction, plan_split_tet(mesh, TetId(2), {0.25, 0.25, 0.25, 0.25}));
  journal.append(transaction.commit());
  ASSERT_TRUE(body.all.follow(journal, mesh).ok());
  EXPECT_EQ(body.all.value(body.label, split.vertex.value)[0], corners[0].value);
}

TEST(Attributes, a_copy_takes_the_mass_of_the_tets_that_it_takes) {
  TetSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  soup.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  TetMesh mesh = *TetMesh::build(soup);
  Body body(mesh);
  Journal journal;
  Transaction transaction(mesh);
  const VertexId twin = apply(transaction, plan_duplicate_vertex(mesh, VertexId(1), {TetId(1)}), 1);
  journal.append(transaction.commit());
  ASSERT_TRUE(body.all.follow(journal, mesh).ok());
  EXPECT_NEAR(body.all.value(body.mass, 1)[0], 2.5 * mesh.rest_volume(TetId(0)) / 4, 1e-15);
  EXPECT_NEAR(body.all.value(body.mass, twin.value)[0], 2.5 * mesh.rest_volume(TetId(1)) / 4, 1e-15);
  EXPECT_EQ(copy_of(body.all.value(body.velocity, twin.value)), copy_of(body.all.value(body.velocity, 1)));
  EXPECT_EQ(body.all.value(body.label, twin.value)[0], 1.0);
}

TEST(Attributes, a_vertex_that_hands_on_all_but_a_sliver_keeps_the_slivers_mass) {
  TetSoup soup;  // the volumes are as 1 to 3e17: their difference has no digits
  soup.points = {{1.0 / 3, 1.0 / 3, 1.0 / 3 - 1e-11}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1e6, 1e6, 1e6}};
  soup.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  TetMesh mesh = *TetMesh::build(soup);
  Body body(mesh);
  const double before = sum(body.all.values(body.mass));
  Journal journal;
  Transaction transaction(mesh);
  const VertexId twin = apply(transaction, plan_duplicate_vertex(mesh, VertexId(1), {TetId(1)}), 1);
  journal.append(transaction.commit());
  ASSERT_TRUE(body.all.follow(journal, mesh).ok());
  const double sliver = mesh.rest_volume(TetId(0));
  ASSERT_GT(sliver, 0);
  EXPECT_NEAR(body.all.lumped_volume(VertexId(1)), sliver / 4, 1e-9 * sliver);
  EXPECT_NEAR(body.all.value(body.mass, 1)[0], 2.5 * sliver / 4, 1e-9 * sliver);
  EXPECT_NEAR(body.all.value(body.mass, twin.value)[0], 2.5 * mesh.rest_volume(TetId(1)) / 4, 1e-9);
  EXPECT_NEAR(sum(body.all.values(body.mass)), before, 1e-15 * before);
}

TEST(Attributes, a_consumed_tet_without_children_leaves_its_mass_to_its_corners) {
  TetSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  soup.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  TetMesh mesh = *TetMesh::build(soup);
  Body body(mesh);
  const double before = sum(body.all.values(body.mass));
  Journal journal;
  Transaction transaction(mesh);
  transaction.set_link({TetId(0), 0}, Link::boundary(0));
  transaction.remove_tet(TetId(1));
  transaction.remove_vertex(VertexId(4));
  for (const std::uint32_t v : {1U, 2U, 3U}) transaction.set_tet_of(VertexId(v), TetId(0));
  journal.append(transaction.commit());
  ASSERT_TRUE(body.all.follow(journal, mesh).ok());
  EXPECT_NEAR(sum(body.all.values(body.mass)), before, 1e-15);
  EXPECT_EQ(body.all.value(body.mass, 4)[0], 0.0);
}

TEST(Attributes, engine_cuts_keep_mass_density_and_momentum) {
  for (const Profile profile : {Profile::kIncise, Profile::kPaper}) {
    for (const double snap : {0.0, 0.2, 0.3}) {
      EngineOptions options;
      options.cut.profile = profile;
      options.cut.snap = snap;
      Engine engine = new_engine(jittered_cube(4), options);
      Body body(engine.mesh());
      const Vec3 momentum = body.momentum(engine.mesh());
      body.expect_uniform(engine.mesh(), momentum);
      for (const Stroke& stroke : three_cuts()) {
        ASSERT_TRUE(engine.cut(stroke).ok());
        ASSERT_TRUE(body.all.follow(engine.journal(), engine.mesh()).ok());
        SCOPED_TRACE("snap " + std::to_string(snap));
        body.expect_uniform(engine.mesh(), momentum);
      }
    }
  }
}

TEST(Attributes, progressive_cuts_keep_mass_density_and_momentum_after_every_step) {
  EngineOptions options;
  options.maintain.merge = options.maintain.improve = false;  // it moves surfaces a little
  Engine engine = new_engine(jittered_cube(4), options);
  Body body(engine.mesh());
  const Vec3 momentum = body.momentum(engine.mesh());
  const auto blade = [](double z) {
    return BladePose{{Vec3(0.47, -0.2, z), Vec3(0.53, 1.2, z - 0.03)}, Vec3(0, 0, -1)};
  };
  ASSERT_TRUE(engine.begin_stroke(blade(1.1)).ok());
  for (unsigned i = 1; i <= 20; ++i) {
    ASSERT_TRUE(engine.step(blade(1.1 - 0.04 * i)).ok());
    ASSERT_TRUE(body.all.follow(engine.journal(), engine.mesh()).ok());
    SCOPED_TRACE("step " + std::to_string(i));
    body.expect_uniform(engine.mesh(), momentum);
  }
  ASSERT_TRUE(engine.end_stroke().ok());
  ASSERT_TRUE(body.all.follow(engine.journal(), engine.mesh()).ok());
  body.expect_uniform(engine.mesh(), momentum);
}

TEST(Attributes, progressive_cuts_keep_any_mass) {
  Engine engine = new_engine(jittered_cube(4));
  Body body(engine.mesh());
  test::Random random(5);
  for (double& value : body.all.values(body.mass)) value = random.real(-1, 1);
  for (double& value : body.all.values(body.tet_mass)) value = random.real(-1, 1);
  const double before = sum(body.all.values(body.mass)), tets_before = sum(body.all.values(body.tet_mass));
  const auto blade = [](double z) { return BladePose{{Vec3(0.3, -0.2, z), Vec3(0.7, 1.2, z - 0.1)}, Vec3(0, 0, -1)}; };
  ASSERT_TRUE(engine.begin_stroke(blade(1.2)).ok());
  for (unsigned i = 1; i <= 15; ++i) {
    ASSERT_TRUE(engine.step(blade(1.2 - 0.05 * i)).ok());
    ASSERT_TRUE(body.all.follow(engine.journal(), engine.mesh()).ok());
    EXPECT_NEAR(sum(body.all.values(body.mass)), before, 1e-12) << i;
    EXPECT_NEAR(sum(body.all.values(body.tet_mass)), tets_before, 1e-12) << i;
  }
  ASSERT_TRUE(engine.end_stroke().ok());
  ASSERT_TRUE(body.all.follow(engine.journal(), engine.mesh()).ok());
  EXPECT_NEAR(sum(body.all.values(body.mass)), before, 1e-12);
  EXPECT_NEAR(sum(body.all.values(body.tet_mass)), tets_before, 1e-12);
}

TEST(Attributes, engine_cuts_keep_any_mass_and_never_make_it_negative) {
  Engine engine = new_engine(jittered_cube(4));
  Body body(engine.mesh());
  test::Random random(3);
  for (double& value : body.all.values(body.mass)) value = random.real(0, 1) < 0.3 ? 0.0 : random.real(0, 1);
  const double before = sum(body.all.values(body.mass));
  bool has_moved = false;
  for (const Stroke& stroke : three_cuts()) {
    ASSERT_TRUE(engine.cut(stroke).ok());
    has_moved = has_moved || !engine.journal().step(engine.journal().position() - 1).moved.empty();
    ASSERT_TRUE(body.all.follow(engine.journal(), engine.mesh()).ok());
    EXPECT_NEAR(sum(body.all.values(body.mass)), before, 1e-13 * before);
    for (const double value : body.all.values(body.mass)) EXPECT_GE(value, -1e-15);
  }
  EXPECT_TRUE(has_moved);
}

TEST(Attributes, undo_and_redo_restore_every_bit) {
  Engine engine = new_engine(jittered_cube(3));
  Body body(engine.mesh());
  std::vector<std::vector<std::vector<double>>> states = {body.snapshot()};
  for (const Stroke& stroke : three_cuts()) {
    ASSERT_TRUE(engine.cut(stroke).ok());
    ASSERT_TRUE(body.all.follow(engine.journal(), engine.mesh()).ok());
    states.push_back(body.snapshot());
  }
  for (unsigned round = 0; round < 2; ++round) {
    for (std::size_t i = states.size() - 1; i-- > 0;) {
      ASSERT_TRUE(engine.undo());
      ASSERT_TRUE(body.all.follow(engine.journal(), engine.mesh()).ok());
      body.expect_equal(states[i]);
    }
    for (std::size_t i = 1; i < states.size(); ++i) {
      ASSERT_TRUE(engine.redo());
      ASSERT_TRUE(body.all.follow(engine.journal(), engine.mesh()).ok());
      body.expect_equal(states[i]);
    }
  }
}

TEST(Attributes, many_steps_at_once_give_what_they_give_one_by_one) {
  Engine engine = new_engine(jittered_cube(3));
  Body often(engine.mesh()), seldom(engine.mesh());
  std::vector<std::vector<std::vector<double>>> states = {often.snapshot()};
  for (const Stroke& stroke : three_cuts()) {
    ASSERT_TRUE(engine.cut(stroke).ok());
    ASSERT_TRUE(often.all.follow(engine.journal(), engine.mesh()).ok());
    states.push_back(often.snapshot());
  }
  ASSERT_TRUE(seldom.all.follow(engine.journal(), engine.mesh()).ok());
  seldom.expect_equal(states[3]);
  for (const std::size_t target : {2U, 3U, 1U, 0U, 2U, 0U, 3U}) {  // also to states that it passed by
    while (engine.stroke_count() > target) engine.undo();
    while (engine.stroke_count() < target) engine.redo();
    ASSERT_TRUE(seldom.all.follow(engine.journal(), engine.mesh()).ok());
    seldom.expect_equal(states[target]);
  }
}

TEST(Attributes, a_step_that_took_the_place_of_another_is_noticed) {
  const std::vector<Stroke> strokes = three_cuts();
  Engine engine = new_engine(jittered_cube(3));
  Body body(engine.mesh());
  ASSERT_TRUE(engine.cut(strokes[0]).ok());
  ASSERT_TRUE(engine.cut(strokes[1]).ok());
  ASSERT_TRUE(body.all.follow(engine.journal(), engine.mesh()).ok());
  engine.undo();
  ASSERT_TRUE(engine.cut(strokes[2]).ok());
  ASSERT_TRUE(body.all.follow(engine.journal(), engine.mesh()).ok());
  Engine direct = new_engine(jittered_cube(3));
  Body other(direct.mesh());
  ASSERT_TRUE(direct.cut(strokes[0]).ok());
  ASSERT_TRUE(direct.cut(strokes[2]).ok());
  ASSERT_TRUE(other.all.follow(direct.journal(), direct.mesh()).ok());
  body.expect_equal(other.snapshot());
}

/// Cut, undone, changed and cut the same again: the second cut hands on the values of its own time.
TEST(Attributes, follow_a_cut_that_is_made_again_as_a_new_one) {
  Engine engine = new_engine(jittered_cube(3));
  Body body(engine.mesh());
  const Stroke stroke = three_cuts()[0];
  ASSERT_TRUE(engine.cut(stroke).ok());
  ASSERT_TRUE(body.all.follow(engine.journal(), engine.mesh()).ok());
  engine.undo();
  ASSERT_TRUE(body.all.follow(engine.journal(), engine.mesh()).ok());
  for (const AttributeId mass : {body.mass, body.tet_mass}) {
    for (double& value : body.all.values(mass)) value *= 5;
  }
  for (double& value : body.all.values(body.velocity)) value = 2;
  for (const AttributeId label : {body.label, body.region}) {
    for (double& value : body.all.values(label)) value = 7;
  }
  ASSERT_TRUE(engine.cut(stroke).ok());
  ASSERT_TRUE(body.all.follow(engine.journal(), engine.mesh()).ok());
  EXPECT_NEAR(sum(body.all.values(body.mass)), 12.5, 1e-12);
  EXPECT_NEAR(sum(body.all.values(body.tet_mass)), 12.5, 1e-12);
  engine.mesh().for_each_vertex([&](VertexId v) {
    for (const double speed : body.all.value(body.velocity, v.value)) EXPECT_NEAR(speed, 2, 1e-14);
    EXPECT_EQ(body.all.value(body.label, v.value)[0], 7);
    const auto place = body.all.value(body.position, v.value);
    EXPECT_EQ(Vec3(place[0], place[1], place[2]), engine.mesh().rest(v));
  });
  engine.mesh().for_each_tet([&](TetId t) {
    EXPECT_EQ(body.all.value(body.region, t.value)[0], 7);
    EXPECT_EQ(body.all.value(body.tet_volume, t.value)[0], engine.mesh().rest_volume(t));
  });
}

TEST(Attributes, follow_what_is_left_of_a_trimmed_history_and_are_told_where_they_cannot) {
  Engine engine = new_engine(jittered_cube(3));
  Body body(engine.mesh()), late(engine.mesh());
  const Vec3 momentum = body.momentum(engine.mesh());
  const std::vector<std::vector<double>> before = late.snapshot();
  ASSERT_TRUE(engine.keep_undo(1).ok());
  std::vector<std::vector<double>> middle;
  for (const Stroke& stroke : three_cuts()) {
    middle = body.snapshot();
    ASSERT_TRUE(engine.cut(stroke).ok());
    ASSERT_TRUE(body.all.follow(engine.journal(), engine.mesh()).ok());
  }
  EXPECT_GT(engine.journal().first(), 0U);
  body.expect_uniform(engine.mesh(), momentum);
  const Status status = late.all.follow(engine.journal(), engine.mesh());
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::kBadArgument);
  EXPECT_NE(status.error().message.find("construct them anew"), std::string::npos);
  late.expect_equal(before);
  ASSERT_TRUE(engine.undo());
  ASSERT_TRUE(body.all.follow(engine.journal(), engine.mesh()).ok());
  body.expect_equal(middle);
  ASSERT_TRUE(engine.redo());
  ASSERT_TRUE(body.all.follow(engine.journal(), engine.mesh()).ok());
  body.expect_uniform(engine.mesh(), momentum);
}

TEST(Attributes, do_not_follow_back_beyond_their_beginning) {
  Engine engine = new_engine(jittered_cube(2));
  ASSERT_TRUE(engine.cut(three_cuts()[0]).ok());
  Attributes all(engine.mesh(), engine.journal());
  engine.undo();
  EXPECT_EQ(all.follow(engine.journal(), engine.mesh()).error().code, ErrorCode::kBadArgument);
}

TEST(Attributes, a_younger_attribute_gives_revived_elements_its_initial_value) {
  Engine engine = new_engine(jittered_cube(2));
  Attributes all(engine.mesh());
  const auto before = engine.mesh().tet_slots();
  ASSERT_TRUE(engine.cut(three_cuts()[0]).ok());
  AttributeSpec spec = spec_of("late", Domain::kTet, 1, Transfer::kInherit);
  spec.initial = {4.0};
  EXPECT_FALSE(all.add(engine.mesh(), spec).ok());  // not followed yet
  ASSERT_TRUE(all.follow(engine.journal(), engine.mesh()).ok());
  const AttributeId late = *all.add(engine.mesh(), spec);
  engine.undo();
  ASSERT_TRUE(all.follow(engine.journal(), engine.mesh()).ok());
  ASSERT_EQ(all.values(late).size(), before);
  for (const double value : all.values(late)) EXPECT_EQ(value, 4.0);
}

TEST(Attributes, moved_vertices_sample_anew_and_keep_a_uniform_density) {
  TetMesh mesh = jittered_cube(3);
  Body body(mesh);
  const Vec3 momentum = body.momentum(mesh);
  Journal journal;
  test::Random random(11);
  for (unsigned i = 0; i < 40; ++i) {
    Transaction transaction(mesh);
    mesh.for_each_vertex([&](VertexId v) {
      if (mesh.shape_of(v) != 0) return;
      const MoveVertexPlan plan = plan_move_vertex(mesh, v, mesh.rest(v) + random.point(-0.03, 0.03));
      if (plan) apply(transaction, plan);
    });
    journal.append(transaction.commit());
    ASSERT_TRUE(body.all.follow(journal, mesh).ok());
  }
  body.expect_uniform(mesh, momentum);
}

}  // namespace
}  // namespace incise::attributes_test
