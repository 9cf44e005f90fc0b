// SPDX-License-Identifier: Apache-2.0
// Contact of a body with itself and of its pieces with each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "moving_body.h"
#include "sim/body/contact_grid.h"
#include "sim/body/contact_surface.h"
#include "sim/body/contact_terms.h"
#include "support/campaign.h"

namespace incise::test::self_contact_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSide = 0.04;  // m

BodyOptions touching(double friction = 0.3, double damping = 2) {
  BodyOptions options;
  options.damping = damping;
  options.self.on = true;
  options.self.friction = friction;
  return options;
}

// --- parts

/// The surface that followed the journal is that of the mesh as it stands.
void expect_surface_of_mesh(const MovingBody& moving) {
  const detail::ContactSurface& surface = moving.state().contact.surface();
  std::vector<detail::ContactFace> expected;
  std::vector<double> area(moving.mesh().vertex_slots());
  moving.mesh().for_each_tet([&](TetId t) {
    if (!moving.state().tets[t][0].is_valid()) return;
    for (unsigned side = 0; side < 4; ++side) {
      if (!moving.mesh().links(t)[side].is_boundary()) continue;
      const auto v = moving.mesh().vertices(Side(t, side));
      expected.push_back({Side(t, side), {v[0].value, v[1].value, v[2].value}, false});
      const Vec3 a = moving.mesh().rest(v[0]), b = moving.mesh().rest(v[1]), c = moving.mesh().rest(v[2]);
      for (const VertexId corner : v) area[corner.value] += (b - a).cross(c - a).norm() / 6;
    }
  });
  ASSERT_EQ(surface.faces().size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(surface.faces()[i].side, expected[i].side);
    ASSERT_EQ(surface.faces()[i].corners, expected[i].corners);
  }
  for (std::uint32_t v = 0; v < area.size(); ++v) {
    if (!moving.mesh().is_live(VertexId(v))) continue;
    ASSERT_NEAR(surface.vertex(v).area, area[v], 1e-12 * area[v] + 1e-30) << v;
    const bool is_at_front = (moving.mesh().shape_of(VertexId(v)) & shape::kFront) != 0;
    if (area[v] > 0) {
      ASSERT_EQ(surface.vertex(v).is_at_front, is_at_front) << v;
    }
  }
}

TEST(ContactSurface, FollowsWhateverIsDone) {
  for (std::uint64_t seed = 1; seed <= of_campaign(1U, 3U); ++seed) {
    SCOPED_TRACE(seed);
    MovingBody moving(jittered_cube(4, seed), {tissue(20e3), {}}, touching());
    moving.hold_where(0);
    expect_surface_of_mesh(moving);
    RandomCalls calls(moving, seed);
    calls.run(25, [&] { expect_surface_of_mesh(moving); });
    EXPECT_TRUE(moving.body().is_finite());
  }
}

TEST(ContactGrid, FindsAllBoxesThatHoldAPoint) {
  Random random(3);
  const auto point = [&] { return Vec3(random.real(0, 4), random.real(0, 1), random.real(0, 2)); };
  std::vector<Box> boxes(300);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (i % 7 == 0) continue;  // empty
    boxes[i].extend(point());
    boxes[i].extend(boxes[i].lo + 0.2 * point());
  }
  detail::ContactGrid grid;
  grid.build(boxes, 0.3);
  for (int k = 0; k < 500; ++k) {
    const Vec3 p = point();
    const auto found = grid.near(p);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      const bool holds = !boxes[i].is_empty() && boxes[i].distance2(p) == 0;
      if (holds) {
        EXPECT_TRUE(std::binary_search(found.begin(), found.end(), i));
      }
    }
  }
  grid.build({}, 0.3);
  EXPECT_TRUE(grid.near(Vec3::Zero()).empty());
}

/// What a visit is told of a term is the slope of its energy, pressing, sticking and slipping.
TEST(ContactTerms, SlopesAreThoseOfTheEnergy) {
  Random random(5);
  for (int trial = 0; trial < 60; ++trial) {
    detail::ContactTerm term;
    term.vertices = {0, 1, 2, 3};
    const float a = static_cast<float>(random.real(0, 0.5)), b = static_cast<float>(random.real(0, 0.5));
    term.share = {a, b, 1 - a - b};
    const Vec3 n = Vec3(random.real(-1, 1), random.real(-1, 1), 1).normalized();
    term.normal = {static_cast<float>(n.x()), static_cast<float>(n.y()), static_cast<float>(n.z())};
    term.reference = {static_cast<float>(random.real(-0.1, 0.1)), 0.05F, static_cast<float>(random.real(-0.1, 0.1))};
    term.stiffness = 3;
    term.limit = trial % 3 == 0 ? 0.0F : static_cast<float>(random.real(0.01, 2));
    std::vector<float> places(16);
    for (float& x : places) x = static_cast<float>(random.real(-1, 1));
    detail::Motion motion;
    motion.contacts = 1;
    detail::Descent descent;
    descent.places = places.data();
    descent.contact_terms = &term;
    const std::array<std::uint32_t, 4> rows = {0, 1, 2, 3};
    descent.rows = rows.data();
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
      const detail::ContactUse use = corner;
      descent.contact_uses = &use;
      detail::Quadratic q;
      detail::add_contacts(descent, motion, q);
      for (unsigned k = 0; k < 3; ++k) {
        const float step = 1e-2F;
        std::vector<float> up = places, down = places;
        up[4 * corner + k] += step;
        down[4 * corner + k] -= step;
        const auto energy = [&](const auto& at) { return detail::contact_energy(term, at.data(), rows.data()); };
        const double slope = (energy(up) - energy(down)) / (2 * static_cast<double>(step));
        EXPECT_NEAR(q.slope[k], slope, 0.05) << trial;
      }
      EXPECT_GE(q.curvature[0], 0);
      EXPECT_GE(q.curvature[3], 0);
      EXPECT_GE(q.curvature[5], 0);
    }
  }
}

// --- blocks that are cut through

/// A block of 40 mm on the ground, cut by a plane that rises by `rise` along x.
MovingBody cut_block(const BodyOptions& options, double rise, bool is_cut = true) {
  constexpr unsigned kCells = 8;
  MovingBody moving(kuhn_box(Vec3::Zero(), {kSide, kSide, kSide}, {kCells, kCells, kCells}), {tissue(10e3), {}},
                    options);
  moving.mesh().for_each_vertex([&](VertexId v) {
    if (moving.mesh().rest(v).z() < 1e-9) {
      ASSERT_TRUE(moving.body().hold(v, kInfinity).ok());
    }
  });
  const double z = kSide / 2 + 0.31 * kSide / kCells;
  const double low = z - 0.03 * rise, high = z + 0.03 * rise;
  if (is_cut) {
    moving.cut(
        quad_stroke(Vec3(-0.01, -0.01, low), Vec3(-0.01, 0.05, low), Vec3(0.05, -0.01, high), Vec3(0.05, 0.05, high)));
  }
  return moving;
}

/// Mean place of the block's top.
Vec3 top_of(const MovingBody& moving) {
  Vec3 sum = Vec3::Zero();
  std::size_t count = 0;
  moving.mesh().for_each_vertex([&](VertexId v) {
    if (moving.mesh().rest(v).z() < kSide - 1e-9) return;
    sum += moving.state().places[v.value] - moving.mesh().rest(v);
    ++count;
  });
  return sum / static_cast<double>(count);
}

double energy_with_contacts(MovingBody& moving) {
  double energy = moving.body().energy().total();
  for (const detail::ContactTerm& term : moving.state().contact.terms()) {
    energy += detail::contact_energy(term, moving.state().floats.data(), moving.state().rows.rows());
  }
  return energy;
}

TEST(SelfContact, ABlockCutLevelStandsAsTheWholeOneDoes) {
  MovingBody whole = cut_block(touching(), 0, false), cut = cut_block(touching(0.5), 0);
  whole.advance(300);
  cut.advance(60);
  const Vec3 early = top_of(cut);
  cut.advance(240);
  const double sag = -top_of(whole).z(), cut_sag = -top_of(cut).z();
  const Vec3 slid = top_of(cut) - early;
  std::printf("sag %.4f mm, cut %.4f mm; slid %.4f mm in 4 s\n", 1e3 * sag, 1e3 * cut_sag, 1e3 * slid.norm());
  EXPECT_EQ(cut.state().pieces.size(), 2U);
  EXPECT_NEAR(cut_sag, sag, 0.1 * sag);
  EXPECT_LT(slid.norm(), 1e-4);
  EXPECT_EQ(cut.body().active_vertices(), 0U);
}

TEST(SelfContact, FrictionHoldsAHalfOnASlope) {
  MovingBody moving = cut_block(touching(0.5), 0.2);  // 11°
  moving.advance(30);
  const Vec3 early = top_of(moving);
  moving.advance(270);
  EXPECT_LT((top_of(moving) - early).norm(), 1e-4);
  EXPECT_EQ(moving.body().active_vertices(), 0U);
}

/// A slide on a long base, under gravity that is turned instead of the base.
double acceleration_on_slope(double friction, double degrees) {
  const double angle = degrees * 3.14159265358979 / 180;
  BodyOptions options = touching(friction, 0);
  options.gravity = 9.81 * Vec3(-std::sin(angle), 0, -std::cos(angle));
  TetSoup soup = kuhn_box(Vec3(-0.12, -0.01, -0.01), Vec3(0.05, 0.05, 0), {34, 12, 2});
  const TetSoup block = kuhn_box(Vec3(0, 0, 0.0002), Vec3(0.04, 0.04, 0.02), {8, 8, 4});
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  soup.points.insert(soup.points.end(), block.points.begin(), block.points.end());
  for (auto tet : block.tets) {
    for (std::uint32_t& v : tet) v += first;
    soup.tets.push_back(tet);
  }
  MovingBody moving(std::move(soup), {tissue(10e3), {}}, options);
  moving.mesh().for_each_vertex([&](VertexId v) {
    if (moving.mesh().rest(v).z() < -0.0099) {
      ASSERT_TRUE(moving.body().hold(v, kInfinity).ok());
    }
  });
  const auto velocity = [&] {
    Vec3 sum = Vec3::Zero();
    double mass = 0;
    for (std::uint32_t v = first; v < moving.mesh().vertex_slots(); ++v) {
      sum += moving.body().mass(VertexId(v)) * moving.body().velocity(VertexId(v));
      mass += moving.body().mass(VertexId(v));
    }
    return Vec3(sum / mass);
  };
  moving.advance(9);
  const Vec3 early = velocity();
  moving.advance(6);
  return -(velocity() - early).x() / 0.1;
}

TEST(SelfContact, AHalfSlidesDownAsCoulombSays) {
  for (const double friction : {0.3, 0.1, 0.0}) {
    const double expected =
        9.81 * (std::sin(25 * 3.14159265358979 / 180) - friction * std::cos(25 * 3.14159265358979 / 180));
    const double found = acceleration_on_slope(friction, 25);
    std::printf("friction %.1f: %.3f m/s^2, expected %.3f\n", friction, found, expected);
    EXPECT_NEAR(found, expected, 0.1 * expected) << friction;
  }
}

/// In no frame that nothing is done in does the energy rise, those of the first contacts included.
TEST(SelfContact, TheEnergyNeverRises) {
  for (const double rise : {0.0, 0.2, 0.4663}) {
    SCOPED_TRACE(rise);
    MovingBody moving = cut_block(touching(0.3, 0), rise);
    double last = energy_with_contacts(moving), greatest_rise = 0, low = last, high = last;
    for (unsigned i = 0; i < 120; ++i) {
      moving.advance();
      const double now = energy_with_contacts(moving);
      greatest_rise = std::max(greatest_rise, now - last);
      last = now;
      low = std::min(low, now);
      high = std::max(high, now);
    }
    EXPECT_LT(greatest_rise, 1e-3 * high);
    EXPECT_TRUE(moving.body().is_finite());
  }
}

// --- pieces that fall

/// A slab that is cut into bricks keeps its shape, on a base that holds it, and comes to rest.
TEST(SelfContact, BricksLieOnEachOtherAndRest) {
  MovingBody moving(kuhn_box(Vec3::Zero(), {0.04, 0.04, 0.024}, {8, 8, 6}), {tissue(10e3), {}}, touching());
  moving.mesh().for_each_vertex([&](VertexId v) {
    if (moving.mesh().rest(v).z() < 1e-9) {
      ASSERT_TRUE(moving.body().hold(v, kInfinity).ok());
    }
  });
  moving.cut_plane(Vec3(0, 0, 1), 0.0101);
  for (const double d : {0.0131, 0.0271}) {
    moving.cut_plane(Vec3(1, 0, 0), d);
    moving.cut_plane(Vec3(0, 1, 0), d);
  }
  const auto is_loose = [&](VertexId v) { return !moving.state().pieces[moving.state().piece_of[v]].is_held; };
  moving.advance(240);
  ASSERT_EQ(moving.state().pieces.size(), 18U);
  for (std::uint32_t slot = 0; slot < moving.state().places.size(); ++slot) {
    const VertexId v(slot);
    if (!moving.state().is_live(v) || !is_loose(v)) continue;
    EXPECT_LT((moving.state().places[slot] - moving.state().rest[v]).norm(), 0.002);
  }
  EXPECT_EQ(moving.body().active_vertices(), 0U);
  EXPECT_EQ(moving.body().count_inverted(), 0U);
}

/// Free bricks that touch each other fall as one, and keep their momenta.
TEST(SelfContact, FreePiecesThatTouchKeepTheirMomentum) {
  MovingBody moving(kuhn_box(Vec3::Zero(), {0.04, 0.04, 0.04}, {6, 6, 6}), {tissue(10e3), {}}, touching(0.3, 0));
  moving.mesh().for_each_vertex([&](VertexId v) {
    const Vec3 r = moving.mesh().rest(v) - Vec3(0.02, 0.02, 0.02);
    ASSERT_TRUE(moving.body().set_velocity(v, Vec3(0.1, 0, 0) - 4 * r + Vec3(0, 0, 3).cross(r)).ok());  // it shrinks
  });
  moving.cut_plane(Vec3(1, 0.1, 0), 0.0213);
  moving.cut_plane(Vec3(0, 0.2, 1), 0.0201);
  const Vec3 before = moving.body().momentum();
  moving.advance(60);
  const Vec3 expected = before + moving.body().mass() * Vec3(0, 0, -9.81);
  EXPECT_LT((moving.body().momentum() - expected).norm(), 1e-10 * expected.norm());
  EXPECT_EQ(moving.state().pieces.size(), 4U);
}

TEST(SelfContact, WithoutItPiecesPassThroughEachOther) {
  BodyOptions alone;
  alone.damping = 2;
  MovingBody moving = cut_block(alone, 0);
  moving.advance(30);
  EXPECT_LT(top_of(moving).z(), -0.02);
}

// --- the same bits, and arguments

std::uint64_t cut_and_undo(unsigned threads, Relaxation relaxation = Relaxation::kBlockDescent) {
  BodyOptions options = touching();
  options.threads = threads;
  options.relaxation = relaxation;
  MovingBody moving(jittered_cube(8, 6), {tissue(5e3), {}}, options);
  moving.hold_where(0);
  moving.advance(5);
  Random random(6);
  const Box box = rest_bounds(moving.mesh());
  for (int i = 0; i < 4; ++i) {
    moving.cut(random_stroke(random, box));
    moving.advance(5);
  }
  moving.cut_in_steps(random_stroke(random, box));
  EXPECT_TRUE(moving.engine().undo());
  moving.follow();
  moving.advance(5);
  EXPECT_TRUE(moving.engine().redo());
  moving.follow();
  moving.advance(10);
  expect_sound_order(moving.state());
  EXPECT_TRUE(moving.body().is_finite());
  return moving.body().hash();
}

TEST(SelfContact, TheSameBitsOnOneThreadAndTwo) {
  const std::uint64_t hash = cut_and_undo(2);
  EXPECT_EQ(cut_and_undo(1), hash);
  if (is_whole_campaign()) {
    EXPECT_EQ(cut_and_undo(2), hash);
  }
}

/// Undo takes slots of tets back: what was in contact with their faces must not look at them any more.
TEST(SelfContact, UndoLeavesNoContactWithWhatIsGone) {
  MovingBody moving(jittered_cube(5, 3), {tissue(5e3), {}}, touching());
  moving.hold_where(0);
  Random random(3);
  const Box box = rest_bounds(moving.mesh());
  std::size_t contacts = 0;
  for (int round = 0; round < 6; ++round) {
    for (int i = 0; i < 2; ++i) {
      moving.cut(random_stroke(random, box));
      moving.advance(8);
    }
    contacts += moving.state().contact.contacts().size();
    for (int i = 0; i < 2; ++i) {
      ASSERT_TRUE(moving.engine().undo());
      moving.follow();
      for (const detail::Contact& contact : moving.state().contact.contacts()) {
        ASSERT_TRUE(moving.mesh().is_live(VertexId(contact.vertex)));
        if (contact.face.value == kInvalidIndex) continue;
        ASSERT_LT(contact.face.tet().value, moving.state().tets.size());
        ASSERT_TRUE(moving.mesh().is_live(contact.face.tet()));
      }
      moving.advance(2);
    }
  }
  EXPECT_GT(contacts, 0U);
}

/// No vertex of the first part shares a contact with one of the second.
TEST(SelfContact, ContactsAcrossThePartsAreVisitedWithTheSeam) {
  BodyOptions options = touching();
  MovingBody moving(kuhn_box(Vec3::Zero(), {0.08, 0.04, 0.04}, {16, 8, 8}), {tissue(10e3), {}}, options);
  moving.mesh().for_each_vertex([&](VertexId v) {
    if (moving.mesh().rest(v).z() < 1e-9) {
      ASSERT_TRUE(moving.body().hold(v, kInfinity).ok());
    }
  });
  moving.cut_plane(Vec3(1, 0, 0.3), 0.046);  // near the middle of the longest axis
  moving.advance(20);
  using Part = detail::SweepOrder::Part;
  std::vector<unsigned> part_of(moving.state().places.size(), 3);
  for (unsigned part = 0; part < 3; ++part) {
    for (const std::uint32_t v : moving.state().order.awake(static_cast<Part>(part))) part_of[v] = part;
  }
  std::size_t across = 0;
  for (const detail::ContactTerm& term : moving.state().contact.terms()) {
    bool touches[4] = {}, base[4] = {};
    for (const std::uint32_t v : term.vertices) {
      touches[part_of[v]] = true;
      base[static_cast<unsigned>(moving.state().order.part_of(VertexId(v)))] = true;
    }
    EXPECT_FALSE(touches[0] && touches[1]);
    across += base[0] && base[1] ? 1U : 0U;
  }
  EXPECT_GT(across, 0U);
}

TEST(SelfContact, ThePositionBasedRelaxationGoesOnWithoutIt) {
  EXPECT_EQ(cut_and_undo(1, Relaxation::kPositionBased), cut_and_undo(2, Relaxation::kPositionBased));
}

TEST(SelfContact, OptionsOutOfRangeAreRefused) {
  const TetMesh mesh = TetMesh::build(kuhn_cube(1)).value();
  BodyOptions options = touching();
  options.self.friction = -0.1;
  EXPECT_FALSE(DeformableBody::create(mesh, {}, {}, options).ok());
  options.self.friction = 0.1;
  options.self.stiffness = kInfinity;
  EXPECT_FALSE(DeformableBody::create(mesh, {}, {}, options).ok());
}

}  // namespace
}  // namespace incise::test::self_contact_test
