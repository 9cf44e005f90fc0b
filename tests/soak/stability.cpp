// SPDX-License-Identifier: Apache-2.0
#include "soak/stability.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "incise/sim/body.h"
#include "soak/watch.h"
#include "support/beam.h"
#include "support/random.h"

namespace incise::test {
namespace {

constexpr int kFrames = 120;
constexpr double kFastestKept = 10;  // m/s: a vertex that is thrown across the beam comes back at 7
constexpr double kNoise = 1e-6;      // of stiffness by volume: what rounding may add to the energy

struct Combination {
  double young = 0, thinnest = 0;
  bool is_random = false;
};

struct Figures {
  bool is_finite = true;
  double start = 0, end = 0;  ///< energy, J
  double gain = 0;            ///< the most above the start, J
  double rise = 0;            ///< the most in one frame, J
  double fastest = 0, last = 0, sag = 0;
};

void throw_anywhere(const TetMesh& mesh, const Beam& beam, DeformableBody& body) {
  Random random(7);
  mesh.for_each_vertex([&](VertexId v) {
    if (!body.is_held(v)) (void)body.place(v, beam.size.cwiseProduct(random.point(0, 1)));
  });
}

Figures hang(const TetMesh& mesh, const Beam& beam, const Combination& combination) {
  Materials materials;
  materials.fallback.young = combination.young;
  BodyOptions options;
  options.thinnest = combination.thinnest;
  DeformableBody body = DeformableBody::create(mesh, {}, materials, options).value();
  for (const VertexId v : vertices_at(mesh, 0)) (void)body.hold(v, std::numeric_limits<double>::infinity());
  if (combination.is_random) throw_anywhere(mesh, beam, body);
  Figures figures;
  figures.start = figures.end = body.energy().total();
  for (int i = 0; i < kFrames && figures.is_finite; ++i) {
    const Result<AdvanceReport> report = body.advance(1.0 / 60);
    figures.is_finite = report.ok() && body.is_finite();
    const double energy = body.energy().total();
    figures.rise = std::max(figures.rise, energy - figures.end);
    figures.gain = std::max(figures.gain, energy - figures.start);
    figures.end = energy;
    figures.last = report->fastest;
    figures.fastest = std::max(figures.fastest, report->fastest);
  }
  figures.sag = tip_sag(mesh, {body.positions().begin(), body.positions().end()}, beam);
  return figures;
}

bool is_stable(const Figures& figures, double young, double volume) {
  return figures.is_finite && figures.fastest < kFastestKept && figures.gain < kNoise * young * volume;
}

}  // namespace

int soak_stability(unsigned every) {
  const Beam beam;
  const double volume = beam.size.prod();
  unsigned number = 0, runs = 0, failures = 0;
  std::printf(
      "  L/r      kPa   thinnest  start     energy at start   end       rise     fastest  at end m/s  sag mm\n");
  for (const double eps : {0.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    const TetMesh mesh = eps > 0 ? cut_beam(beam, eps).mesh : make_beam(beam);
    for (const double young : {3e3, 30e3, 300e3}) {
      for (const double thinnest : {0.05, 0.2}) {
        for (const bool is_random : {false, true}) {
          if (number++ % every != 0) continue;
          watch("stability: eps " + std::to_string(eps) + ", " + std::to_string(young) + " Pa, thinnest " +
                std::to_string(thinnest) + (is_random ? ", random start" : ""));
          const Figures f = hang(mesh, beam, {young, thinnest, is_random});
          const bool is_sound = is_stable(f, young, volume);
          ++runs;
          failures += is_sound ? 0U : 1U;
          std::printf("  %-8.2g %-5g %-9g %-8s %10.3g J %12.3g J %9.2g J %7.3g %10.2g %9.3f%s\n", worst_aspect(mesh),
                      1e-3 * young, thinnest, is_random ? "random" : "normal", f.start, f.end, f.rise, f.fastest,
                      f.last, 1e3 * f.sag, is_sound ? "" : "  FAILED");
        }
      }
    }
  }
  stop_watching();
  std::printf("stability: %u runs, %u failures\n", runs, failures);
  return failures == 0 ? 0 : 1;
}

}  // namespace incise::test
