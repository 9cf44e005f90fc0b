// SPDX-License-Identifier: Apache-2.0
#include "sim/body/star_kernel.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "incise/mesh/shapes.h"
#include "incise/mesh/tet_mesh.h"
#include "plain_kernel.h"
#include "sim/body/kernel_rows.h"
#include "sim/body/nodal_volumes.h"
#include "sim/body/packed_stars.h"
#include "support/random.h"

#if INCISE_WITH_HIGHWAY
#define HWY_DISABLED_TARGETS (HWY_AVX3 | HWY_AVX3_DL)  // as in star_kernel.cpp
#include <hwy/targets.h>
#endif

namespace incise::star_kernel_test {
namespace {

using detail::Descent;
using detail::Quadratic;
using test::Random;

/// A small body whose vertices stand anywhere, move anyhow, and are pulled in every way.
struct Scene {
  static constexpr std::size_t kPulls = 12;

  explicit Scene(std::uint64_t seed, double size = 0.1, bool averages = false, double stiffening = 0, double fibres = 0)
      : Scene(seed, jittered_cube(seed), size, averages, stiffening, fibres) {}
  Scene(std::uint64_t seed, TetSoup soup, double size, bool averages = false, double stiffening = 0, double fibres = 0)
      : random(seed) {
    mesh = *TetMesh::build(std::move(soup));
    stars.stiffens = stiffening > 0 || fibres > 0;
    stars.has_fibres = fibres > 0;
    stars.ensure(mesh.vertex_slots(), mesh.tet_slots());
    mesh.for_each_tet([&](TetId t) {
      const double shared = averages && t.value % 7 != 0 ? 9e3 : 0.0;
      elements.push_back(
          detail::element_of(corners(t, true), 3e3, 1e3, 0.05, 0, shared, t.value % 5 != 0 ? stiffening : 0.0));
      if (fibres > 0 && t.value % 3 != 0) {
        detail::add_fibres(corners(t, true), Vec3(1, 0.5, t.value % 2 == 0 ? 1 : -1), fibres, 0.05, elements.back());
      }
      stars.add(t, mesh.vertices(t), elements.back());
    });
    rows.ensure(mesh.vertex_slots());
    packed.ensure(mesh.vertex_slots());
    for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) packed.update(VertexId(v), stars, rows);
    if (averages) average();
    for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) {
      const Vec3 place = mesh.rest(VertexId(v)) + random.point(-size, size);
      for (int i = 0; i < 3; ++i) places.push_back(static_cast<float>(place[i]));
      places.push_back(0);
      order.push_back(v);
      motions.push_back(any_motion(VertexId(v)));
    }
    add_pulls();
  }

  static TetSoup jittered_cube(std::uint64_t seed) {
    TetSoup soup = kuhn_cube(3);
    jitter(soup, 0.15, seed);
    return soup;
  }
  [[nodiscard]] std::array<Vec3, 4> corners(TetId t, bool at_rest = false) const {
    std::array<Vec3, 4> p;
    for (unsigned c = 0; c < 4; ++c) p[c] = at_rest ? mesh.rest(mesh.vertices(t)[c]) : place(mesh.vertices(t)[c]);
    return p;
  }
  [[nodiscard]] Vec3 place(VertexId v) const {
    const float* p = places.data() + std::size_t{4} * v.value;
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  }
  void average() {
    nodal.is_on = true;
    nodal.ensure(mesh.vertex_slots(), mesh.tet_slots());
    mesh.for_each_tet([&](TetId t) { nodal.put(t, detail::six_volumes(corners(t, true)), elements[t.value]); });
    for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) nodal.update(VertexId(v), stars);
  }
  detail::Motion any_motion(VertexId v) {
    detail::Motion motion;
    for (unsigned i = 0; i < 3; ++i) {
      motion.start[i] = places[std::size_t{4} * v.value + i] + static_cast<float>(random.real(-0.01, 0.01));
      motion.aim[i] = static_cast<float>(random.real(-0.01, 0.01));
    }
    motion.weight = random.real(10, 1000);
    motion.diagonal = stars.diagonal(v);
    motion.reach = 0.1F;
    motion.leaps = true;
    return motion;
  }
  void add_pulls() {
    for (std::size_t i = 0; i < kPulls; ++i) {
      detail::PullTerm term;
      const TetVertices& v = mesh.vertices(TetId(static_cast<std::uint32_t>(13 * i)));
      const double w = random.real(0, 1);
      for (unsigned c = 0; c < 4; ++c) term.vertices[c] = v[c].value;
      term.weights = {w, 1 - w, 0, 0};
      term.target = random.point(-1, 1);
      term.stiffness = random.real(100, 1000);
      term.has_axis = i % 3 != 0;
      if (term.has_axis) term.axis = random.point(-1, 1).normalized();
      term.pushes_only = i % 3 == 1;
      term.limit = i % 2 == 0 ? 1e30 : 1.0;
      terms.push_back(term);
    }
    for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) {
      motions[v].first_pull = static_cast<std::uint32_t>(uses.size());
      for (std::uint32_t t = 0; t < terms.size(); ++t) {
        for (unsigned c = 0; c < 2; ++c) {
          if (terms[t].vertices[c] == v) uses.push_back({t, terms[t].weights[c]});
        }
      }
      motions[v].pulls = static_cast<std::uint32_t>(uses.size()) - motions[v].first_pull;
    }
  }
  [[nodiscard]] Descent descent() {
    Descent d{places.data(), stars.blocks(), stars.all(), motions.data(), terms.data(), uses.data()};
    give_stars(d);
    if (nodal.is_on) give_nodes(d);
    return d;
  }
  template <class To>
  void give_stars(To& d) {
    d.rows = rows.rows();
    d.slots = rows.slots();
    d.packed = packed.all();
    d.parts = packed.parts();
    d.near = packed.near();
    d.tets = packed.tets();
    d.stiffening = stars.stiffening();
    d.fibres = stars.fibres();
  }
  template <class To>
  void give_nodes(To& d) {
    d.nodes = nodal.terms();
  }
  [[nodiscard]] test::PlainDescent plain_descent() {
    test::PlainDescent d{places.data(), stars.blocks(), stars.all(), motions.data(), terms.data(), uses.data()};
    give_stars(d);
    if (nodal.is_on) give_nodes(d);
    return d;
  }

  Random random;
  TetMesh mesh;
  detail::Stars stars;
  detail::KernelRows rows;
  detail::PackedStars packed;
  detail::NodalVolumes nodal{rows};
  std::vector<detail::Element> elements;
  std::vector<float> places;
  std::vector<detail::Motion> motions;
  std::vector<detail::PullTerm> terms;
  std::vector<detail::PullUse> uses;
  std::vector<std::uint32_t> order;
};

/// The vertex' energy as its definition says, in double precision, against nothing.
double energy_at(const Scene& s, VertexId v, const Vec3& at) {
  const detail::Motion& motion = s.motions[v.value];
  double energy = 0;
  s.stars.for_each_tet(v, [&](TetId t) {
    std::array<Vec3, 4> p = s.corners(t);
    p[s.mesh.corner_of(t, v)] = at;
    energy += detail::energy_of(s.elements[t.value], p);
  });
  Vec3 off = at;
  for (unsigned i = 0; i < 3; ++i) off[i] -= static_cast<double>(motion.start[i]) + static_cast<double>(motion.aim[i]);
  return energy + 0.5 * motion.weight * off.squaredNorm();
}

TEST(StarKernel, QuadraticIsTheEnergysUpToSinglePrecision) {
  Scene s(1);
  for (detail::Motion& motion : s.motions) motion.pulls = 0;
  for (const std::uint32_t slot : s.order) {
    const VertexId v(slot);
    const Quadratic q = detail::quadratic_of(s.descent(), slot);
    Vec3 slope = Vec3::Zero();
    double size = 0;
    s.stars.for_each_tet(v, [&](TetId t) {
      const Vec3 part = detail::slope_of(s.elements[t.value], s.corners(t), s.mesh.corner_of(t, v));
      slope += part;
      size += part.norm();
    });
    for (unsigned i = 0; i < 3; ++i) {
      const detail::Motion& m = s.motions[slot];
      slope[i] += m.weight * (s.place(v)[i] - static_cast<double>(m.start[i]) - static_cast<double>(m.aim[i]));
    }
    for (unsigned i = 0; i < 3; ++i) EXPECT_NEAR(q.slope[i], slope[i], 3e-6 * (size + slope.norm()));
    const double here = energy_at(s, v, s.place(v));
    for (int k = 0; k < 5; ++k) {
      const Vec3 d = s.random.point(-0.3, 0.3);
      const auto& [xx, xy, xz, yy, yz, zz] = q.curvature;
      const Vec3 bent(xx * d.x() + xy * d.y() + xz * d.z(), xy * d.x() + yy * d.y() + yz * d.z(),
                      xz * d.x() + yz * d.y() + zz * d.z());
      const double expected = energy_at(s, v, s.place(v) + d) - here;
      EXPECT_NEAR(slope.dot(d) + 0.5 * d.dot(bent), expected, 3e-6 * d.dot(bent));
    }
  }
}

TEST(StarKernel, TissueThatStiffensHasTheSlopeTheCurvatureAndTheEnergyOfItsElements) {
  Scene s(6, 0.05, false, 10);
  for (detail::Motion& motion : s.motions) motion.pulls = 0;
  double stiffest = 0, energy = 0;
  s.mesh.for_each_tet([&](TetId t) {
    const detail::Element& element = s.elements[t.value];
    energy += detail::energy_of(element, s.corners(t));
    stiffest = std::max(stiffest, detail::stiffened(element, detail::soft_energy_of(element, s.corners(t))).factor);
  });
  EXPECT_GT(stiffest, 5);
  std::vector<std::uint32_t> turned;
  EXPECT_NEAR(detail::energy_share(s.descent(), s.order, turned), energy, 1e-4 * energy);
  for (const std::uint32_t slot : s.order) {
    const VertexId v(slot);
    const Quadratic q = detail::quadratic_of(s.descent(), slot);
    Vec3 slope = Vec3::Zero();
    Mat3 bend = s.motions[slot].weight * Mat3::Identity();
    double size = 0;
    s.stars.for_each_tet(v, [&](TetId t) {
      const unsigned corner = s.mesh.corner_of(t, v);
      const Vec3 part = detail::slope_of(s.elements[t.value], s.corners(t), corner);
      slope += part;
      size += part.norm();
      bend += detail::stiffness_at(s.elements[t.value], s.corners(t), corner);
    });
    for (unsigned i = 0; i < 3; ++i) {
      const detail::Motion& m = s.motions[slot];
      slope[i] += m.weight * (s.place(v)[i] - static_cast<double>(m.start[i]) - static_cast<double>(m.aim[i]));
    }
    for (unsigned i = 0; i < 3; ++i) EXPECT_NEAR(q.slope[i], slope[i], 1e-4 * (size + slope.norm()));
    const std::array<double, 6> upper = {bend(0, 0), bend(0, 1), bend(0, 2), bend(1, 1), bend(1, 2), bend(2, 2)};
    for (unsigned i = 0; i < 6; ++i) EXPECT_NEAR(q.curvature[i], upper[i], 1e-4 * bend.norm());
  }
}

/// The curvature holds those that are about to be taut as well: it is no less than the elements'.
TEST(StarKernel, FibresHaveTheSlopeAndTheEnergyOfTheirElements) {
  Scene s(6, 0.05, false, 3, 2e4);
  for (detail::Motion& motion : s.motions) motion.pulls = 0;
  double energy = 0;
  s.mesh.for_each_tet([&](TetId t) { energy += detail::energy_of(s.elements[t.value], s.corners(t)); });
  std::vector<std::uint32_t> turned;
  EXPECT_NEAR(detail::energy_share(s.descent(), s.order, turned), energy, 1e-4 * energy);
  for (const std::uint32_t slot : s.order) {
    const VertexId v(slot);
    const Quadratic q = detail::quadratic_of(s.descent(), slot);
    Vec3 slope = Vec3::Zero();
    Mat3 bend = s.motions[slot].weight * Mat3::Identity();
    double size = 0;
    s.stars.for_each_tet(v, [&](TetId t) {
      const unsigned corner = s.mesh.corner_of(t, v);
      const Vec3 part = detail::slope_of(s.elements[t.value], s.corners(t), corner);
      slope += part;
      size += part.norm();
      bend += detail::stiffness_at(s.elements[t.value], s.corners(t), corner);
    });
    for (unsigned i = 0; i < 3; ++i) {
      const detail::Motion& m = s.motions[slot];
      slope[i] += m.weight * (s.place(v)[i] - static_cast<double>(m.start[i]) - static_cast<double>(m.aim[i]));
    }
    for (unsigned i = 0; i < 3; ++i) EXPECT_NEAR(q.slope[i], slope[i], 1e-4 * (size + slope.norm()));
    const double trace = q.curvature[0] + q.curvature[3] + q.curvature[5];
    EXPECT_GE(trace, bend.trace() * (1 - 1e-4));
    EXPECT_LE(trace, bend.trace() + 1e5);
  }
}

/// A ball of tets that all meet in its middle, vertex 0.
TetSoup urchin(std::uint32_t rings, std::uint32_t sectors) {
  TetSoup soup;
  soup.points = {Vec3::Zero(), Vec3(0, 0, 1), Vec3(0, 0, -1)};
  const auto at = [&](std::uint32_t ring, std::uint32_t sector) { return 3 + ring * sectors + sector % sectors; };
  constexpr double kPi = 3.14159265358979323846;
  for (std::uint32_t i = 0; i < rings; ++i) {
    for (std::uint32_t k = 0; k < sectors; ++k) {
      const double up = kPi * (i + 1) / (rings + 1), round = 2 * kPi * k / sectors;
      soup.points.emplace_back(std::sin(up) * std::cos(round), std::sin(up) * std::sin(round), std::cos(up));
    }
  }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) { soup.tets.push_back({0, a, b, c}); };
  for (std::uint32_t k = 0; k < sectors; ++k) {
    add(1, at(0, k), at(0, k + 1));
    add(2, at(rings - 1, k + 1), at(rings - 1, k));
    for (std::uint32_t i = 0; i + 1 < rings; ++i) {
      add(at(i, k), at(i + 1, k), at(i + 1, k + 1));
      add(at(i, k), at(i + 1, k + 1), at(i, k + 1));
    }
  }
  return soup;
}

TEST(StarKernel, AStarOfSeveralPartsHasTheSlopeAndTheCurvatureOfItsElements) {
  Scene s(3, urchin(20, 20), 0.02);
  ASSERT_NE(s.packed.all()[0].next, 0U);
  s.motions[0].pulls = 0;
  const Quadratic q = detail::quadratic_of(s.descent(), 0);
  Vec3 slope = Vec3::Zero();
  Mat3 bend = s.motions[0].weight * Mat3::Identity();
  double size = 0;
  s.stars.for_each_tet(VertexId(0), [&](TetId t) {
    const Vec3 part = detail::slope_of(s.elements[t.value], s.corners(t), s.mesh.corner_of(t, VertexId(0)));
    slope += part;
    size += part.norm();
    bend += detail::stiffness_at(s.elements[t.value], s.corners(t), s.mesh.corner_of(t, VertexId(0)));
  });
  const detail::Motion& m = s.motions[0];
  for (unsigned i = 0; i < 3; ++i) {
    slope[i] += m.weight * (s.place(VertexId(0))[i] - static_cast<double>(m.start[i]) - static_cast<double>(m.aim[i]));
    EXPECT_NEAR(q.slope[i], slope[i], 3e-6 * (size + slope.norm()));
  }
  const std::array<double, 6> upper = {bend(0, 0), bend(0, 1), bend(0, 2), bend(1, 1), bend(1, 2), bend(2, 2)};
  for (unsigned i = 0; i < 6; ++i) EXPECT_NEAR(q.curvature[i], upper[i], 3e-6 * bend.norm());
}

TEST(StarKernel, PullsAddTheSlopeOfTheirEnergy) {
  Scene s(2);
  for (const std::uint32_t slot : s.order) {
    detail::Motion motion = s.motions[slot];
    Quadratic sum;
    detail::add_pulls(s.descent(), motion, sum);
    Vec3 expected = Vec3::Zero();
    for (std::uint32_t i = 0; i < motion.pulls; ++i) {
      const detail::PullUse& use = s.uses[motion.first_pull + i];
      const detail::PullTerm& term = s.terms[use.term];
      const Vec3 off = term.weights[0] * s.place(VertexId(term.vertices[0])) +
                       term.weights[1] * s.place(VertexId(term.vertices[1])) - term.target;
      if (!term.has_axis) {
        expected += use.weight * std::min(term.stiffness, term.limit / off.norm()) * off;
        continue;
      }
      const double along = term.axis.dot(off);
      if (term.pushes_only && along >= 0) continue;
      const double force = std::min(std::abs(term.stiffness * along), term.limit);
      expected += use.weight * (along < 0 ? -force : force) * term.axis;
    }
    for (unsigned i = 0; i < 3; ++i) EXPECT_NEAR(sum.slope[i], expected[i], 1e-12 * (1 + expected.norm()));
  }
}

TEST(StarKernel, AVisitMovesAVertexToItsLeastEnergyOrAsFarAsItMay) {
  Scene s(3, 0.02);
  for (detail::Motion& motion : s.motions) motion.pulls = 0;
  unsigned free = 0;
  for (const std::uint32_t slot : s.order) {
    const VertexId v(slot);
    const Vec3 before = s.place(v);
    const double high = energy_at(s, v, before);
    detail::sweep(s.descent(), std::span(&slot, 1), false);
    const double low = energy_at(s, v, s.place(v)), reach = static_cast<double>(s.motions[slot].reach);
    EXPECT_LE(low, high + 1e-6 * std::abs(high));
    const double way = (s.place(v) - before).norm();
    EXPECT_LE(way, reach * (1 + 1e-5));
    if (way > 0.99 * reach) continue;
    ++free;
    for (int i = 0; i < 6; ++i)
      EXPECT_GE(energy_at(s, v, s.place(v) + s.random.point(-0.01, 0.01)), low - 1e-5 * std::abs(high));
  }
  EXPECT_GT(free, s.order.size() / 2);
}

TEST(StarKernel, VerticesThatCostLessAtTheirStartGoBackThere) {
  Scene s(4, 0.02);
  for (detail::Motion& motion : s.motions) motion.pulls = 0;
  unsigned back = 0, there = 0;
  for (const std::uint32_t slot : s.order) {
    const VertexId v(slot);
    const auto& start = s.motions[slot].start;
    const Vec3 from(static_cast<double>(start[0]), static_cast<double>(start[1]), static_cast<double>(start[2]));
    const double at_start = energy_at(s, v, from), here = energy_at(s, v, s.place(v));
    if (std::abs(at_start - here) < 1e-5 * std::abs(here)) continue;
    s.motions[slot].leaps = slot % 4 != 0;  // those that hardly move are not asked
    detail::pick_starts(s.descent(), std::span(&slot, 1));
    EXPECT_EQ(s.place(v) == from, at_start < here && s.motions[slot].leaps);
    ++(s.place(v) == from ? back : there);
  }
  EXPECT_GT(back, 5U);
  EXPECT_GT(there, 5U);
}

/// What a few sweeps and picks make of a scene.
template <class Sweep, class Pick>
std::vector<float> outcome(Scene& scene, const Sweep& sweep, const Pick& pick) {
  pick(std::span<const std::uint32_t>(scene.order));
  for (unsigned i = 0; i < 6; ++i) sweep(std::span<const std::uint32_t>(scene.order), i % 2 == 1);
  return scene.places;
}

/// Odd ones average their volumes; two of three stiffen, and from the sixth on there are fibres. The tenth has a star
/// of several parts.
Scene any_scene(std::uint64_t seed) {
  if (seed == 10) return Scene(seed, urchin(20, 20), 0.05);
  return Scene(seed, 0.1, seed % 2 == 1, seed % 3 == 0 ? 0.0 : 5.0, seed > 5 ? 2e4 : 0.0);
}

std::vector<float> outcome_here(std::uint64_t seed) {
  Scene scene = any_scene(seed);
  const Descent d = scene.descent();
  if (scene.nodal.is_on) detail::find_pressures(d, scene.order);
  return outcome(
      scene, [&](auto order, bool backward) { detail::sweep(d, order, backward); },
      [&](auto order) { detail::pick_starts(d, order); });
}

std::vector<float> plain_outcome(std::uint64_t seed) {
  Scene scene = any_scene(seed);
  const test::PlainDescent d = scene.plain_descent();
  if (scene.nodal.is_on) test::plain_find_pressures(d, scene.order);
  return outcome(
      scene, [&](auto order, bool backward) { test::plain_sweep(d, order, backward); },
      [&](auto order) { test::plain_pick_starts(d, order); });
}

bool is_same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(StarKernel, PlainCodeGivesTheSameBits) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const std::vector<float> places = outcome_here(seed);
    EXPECT_FALSE(is_same_bits(places, any_scene(seed).places));
    EXPECT_TRUE(is_same_bits(places, plain_outcome(seed))) << seed;
  }
}

/// Several vertices are visited at once where none reads what another one moves.
TEST(StarKernel, ASweepIsAsGoodAsVisitsOneByOne) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Scene together = any_scene(seed), alone = any_scene(seed);
    for (Scene* scene : {&together, &alone}) {
      if (scene->nodal.is_on) detail::find_pressures(scene->descent(), scene->order);
    }
    detail::pick_starts(together.descent(), together.order);
    for (const std::uint32_t v : alone.order) detail::pick_starts(alone.descent(), std::span(&v, 1));
    EXPECT_TRUE(is_same_bits(together.places, alone.places)) << seed;
    for (unsigned i = 0; i < 3; ++i) {
      detail::sweep(together.descent(), together.order, false);
      for (const std::uint32_t v : alone.order) detail::sweep(alone.descent(), std::span(&v, 1), false);
      EXPECT_TRUE(is_same_bits(together.places, alone.places)) << seed;
    }
  }
}

#if INCISE_WITH_HIGHWAY
TEST(StarKernel, EveryInstructionSetGivesTheSameBits) {
  const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  std::string names;
  for (const std::int64_t target : targets) {
    names += std::string(" ") + hwy::TargetName(target);
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    for (std::uint64_t seed = 1; seed <= 9; ++seed) {
      EXPECT_TRUE(is_same_bits(outcome_here(seed), plain_outcome(seed))) << hwy::TargetName(target) << ' ' << seed;
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
  RecordProperty("targets", names);
  EXPECT_FALSE(targets.empty());
}
#endif

}  // namespace
}  // namespace incise::star_kernel_test
