// SPDX-License-Identifier: Apache-2.0
// Frames without input after strokes, undo and redo in any order: pieces fall, touch and come to rest, and no frame
// puts energy into them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "incise/engine/simulation.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/shapes.h"
#include "support/bodies.h"
#include "support/campaign.h"
#include "support/random.h"
#include "support/random_strokes.h"

namespace incise::test::idle_energy_test {
namespace {

/// J: of the energies that the solver compares, 2e-7 of sums that do not start at 0.
constexpr double kRounding = 3e-6;

class Scene {
 public:
  explicit Scene(unsigned seed) : random_(seed), simulation_(make(seed, random_)), box_(rest_bounds(sim().mesh())) {
    sim().mesh().for_each_vertex([&](VertexId v) {
      if (sim().mesh().rest(v).x() > 1e-3) return;
      EXPECT_TRUE(sim().body().hold(v, 1e31).ok());
    });
    for (unsigned i = 0; i < 38; ++i) random_.real(0, 1);
  }

  void act() {
    const auto kind = random_.integer(0, 9);
    if (kind < 4) {
      stroke();
    } else if (kind < 6) {
      sim().undo();
    } else if (kind < 8) {
      sim().redo();
    }
  }

  /// The most that a frame has added to the energy, of the most that has been stored.
  double idle() {
    double worst = 0;
    BodyEnergy before = sim().body().energy();
    double stored = before.elastic + 1e-6;
    for (auto i = random_.integer(1, 12); i > 0; --i) {
      const bool is_maintained = sim().engine().has_maintenance();
      EXPECT_TRUE(sim().frame({}).ok());
      const BodyEnergy now = sim().body().energy();
      if (!is_maintained && !sim().engine().has_maintenance()) {
        worst = std::max(worst, (now.total() - before.total() - kRounding) / stored);
      }
      before = now;
      stored = std::max(stored, now.elastic);
    }
    return worst;
  }

 private:
  static Simulation make(unsigned seed, Random& random) {
    TetSoup soup = jittered_box(5, 4, 3, seed);
    for (Vec3& p : soup.points) p *= 0.01;
    SimulationOptions options;
    options.body.damping = 1;
    options.materials.fallback.young = 5e3 * std::pow(10.0, random.real(0, 1.5));
    options.body.self.on = seed % 2 != 0;
    options.body.gravity = Vec3(0, 0, seed % 3 != 0 ? -9.81 : 0);
    return Simulation::create(TetMesh::build(std::move(soup)).value(), options).value();
  }
  Simulation& sim() { return simulation_; }

  void stroke() {
    for (const auto& edge : random_stroke(random_, box_).edges) {
      FrameInput input;
      input.blade = BladePose{edge, Vec3::Zero()};
      EXPECT_TRUE(sim().frame(input).ok());
    }
    EXPECT_TRUE(sim().frame({}).ok());
  }

  Random random_;
  Simulation simulation_;
  Box box_;
};

double worst_gain(unsigned seed) {
  Scene scene(seed);
  double worst = 0;
  for (unsigned call = 0; call < 14; ++call) {
    scene.act();
    worst = std::max(worst, scene.idle());
  }
  return worst;
}

}  // namespace

/// The energy of contacts is not counted: what they give back may be seen, and no more.
TEST(IdleEnergy, FramesAfterStrokesGainNone) {
  using Seeds = std::vector<unsigned>;
  for (const unsigned seed :
       of_campaign<Seeds>({0, 1, 6, 12, 18, 24, 50, 52}, {0, 1, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 50, 52})) {
    EXPECT_LT(worst_gain(seed), seed % 2 != 0 ? 0.05 : 0.005) << "seed " << seed;
  }
}

}  // namespace incise::test::idle_energy_test
