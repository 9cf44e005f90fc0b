// SPDX-License-Identifier: Apache-2.0
// What contact of a body with itself costs: frames of relaxation with it and without it in the same run, by turns, of
// blocks that are cut through and rest on each other, and of a body that is at rest. Medians over the rounds.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "incise/engine/engine.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/shapes.h"
#include "incise/sim/body.h"
#include "report.h"

namespace incise::bench {

namespace {

constexpr double kFrame = 1.0 / 60;  // s
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr unsigned kWarmUp = 5, kRounds = 30;

/// A block of 40 mm with `cells` cells along each side, held below.
struct Block {
  unsigned cells;
  unsigned planes;  ///< level cuts
};

/// A body that follows the cuts of its own engine.
struct Cutting {
  Engine engine;
  DeformableBody body;
};

Result<Cutting> make(const Block& block, bool touches) {
  Result<TetMesh> mesh =
      TetMesh::build(kuhn_box(Vec3::Zero(), {0.04, 0.04, 0.04}, {block.cells, block.cells, block.cells}));
  if (!mesh.ok()) return mesh.error();
  BodyOptions options;
  options.damping = 2;
  options.sleep_below = 0;  // every tet counts in every iteration
  options.self.on = touches;
  if (!touches) options.gravity = Vec3::Zero();  // else the parts fall apart, and sleep
  Result<DeformableBody> body = DeformableBody::create(*mesh, {}, {}, options);
  if (!body.ok()) return body.error();
  mesh->for_each_vertex([&](VertexId v) {
    if (mesh->rest(v).z() == 0) (void)body->hold(v, kInfinity);
  });
  Result<Engine> engine = Engine::create(std::move(*mesh));
  if (!engine.ok()) return engine.error();
  for (unsigned i = 1; i <= block.planes; ++i) {
    const Result<Stroke> stroke =
        plane_stroke(rest_bounds(engine->mesh()), Vec3(0.01, 0, 1), 0.04 * i / (block.planes + 1) + 3e-4);
    if (!stroke.ok()) return stroke.error();
    if (const auto cut = engine->cut(*stroke); !cut.ok()) return cut.error();
    if (const auto followed = body->follow(engine->journal(), engine->mesh()); !followed.ok()) return followed.error();
  }
  return Cutting{std::move(*engine), std::move(*body)};
}

struct Measurement {
  std::size_t tets = 0, contacts = 0;
  std::vector<double> with, without;  ///< ms of a frame
};

double frame_ms(DeformableBody& body, std::size_t& contacts) {
  const double start = thread_ms();
  const Result<AdvanceReport> report = body.advance(kFrame);
  if (report.ok()) contacts = report->self_contacts;
  return thread_ms() - start;
}

Result<Measurement> measure(const Block& block) {
  Result<Cutting> with = make(block, true), without = make(block, false);
  if (!with.ok()) return with.error();
  if (!without.ok()) return without.error();
  Measurement out;
  out.tets = with->engine.mesh().tet_count();
  std::size_t none = 0;
  for (unsigned i = 0; i < kWarmUp + kRounds; ++i) {
    const double a = frame_ms(with->body, out.contacts), b = frame_ms(without->body, none);
    if (i < kWarmUp) continue;
    out.with.push_back(a);
    out.without.push_back(b);
  }
  return out;
}

/// A block in two halves that has come to rest: ms of a frame in which nothing is awake.
double measure_rest() {
  Result<TetMesh> mesh = TetMesh::build(kuhn_box(Vec3::Zero(), {0.04, 0.04, 0.04}, {12, 12, 12}));
  BodyOptions options;
  options.damping = 20;
  options.self.on = true;
  Result<DeformableBody> body = DeformableBody::create(*mesh, {}, {}, options);
  mesh->for_each_vertex([&](VertexId v) {
    if (mesh->rest(v).z() == 0) (void)body->hold(v, kInfinity);
  });
  Result<Engine> engine = Engine::create(std::move(*mesh));
  (void)engine->cut(*plane_stroke(rest_bounds(engine->mesh()), Vec3(0, 0, 1), 0.0213));
  (void)body->follow(engine->journal(), engine->mesh());
  for (unsigned i = 0; i < 2000 && body->active_vertices() > 0; ++i) (void)body->advance(kFrame);
  if (body->active_vertices() > 0) return kInfinity;
  std::vector<double> ms;
  std::size_t contacts = 0;
  for (unsigned i = 0; i < kRounds; ++i) ms.push_back(frame_ms(*body, contacts));
  return median(ms);
}

int run(int argc, char** argv) {
  std::filesystem::path folder = "bench-results";
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "--out" && i + 1 < argc) {
      folder = argv[++i];
      continue;
    }
    std::fputs(
        "usage: bench_contact [--out FOLDER]\nTimes relaxation with contact of a body with itself, and without.\n",
        stderr);
    return 2;
  }
  Table table("contact",
              "A block of 40 mm, 10 kPa, cut level, the parts resting on each other; ms: of a frame, processor "
              "time of one thread; no vertex sleeps",
              {"tets", "cuts", "contacts", "ms with", "ms without", "ratio"});
  double worst = 0;
  for (const Block& block : {Block{12, 1}, Block{12, 3}, Block{24, 1}}) {
    const Result<Measurement> m = measure(block);
    if (!m.ok()) {
      std::fprintf(stderr, "%s\n", m.error().message.c_str());
      return 1;
    }
    const double with = median(m->with), without = median(m->without);
    worst = std::max(worst, with / without);
    table.add({std::to_string(m->tets), std::to_string(block.planes), std::to_string(m->contacts),
               fmt::format("{:.2f}", with), fmt::format("{:.2f}", without), fmt::format("{:.2f}", with / without)});
  }
  table.print();
  table.write_csv(folder);
  const double rest = measure_rest();
  report_acceptance(
      "contact",
      {{"a frame with contact over one without, worst block", "≤ 1.1", "-", fmt::format("{:.2f}", worst), worst <= 1.1},
       {"a frame with contact in which nothing is awake, ms", "≤ 0.02", "-", fmt::format("{:.3f}", rest),
        rest <= 0.02}},
      folder);
  return 0;
}

}  // namespace

}  // namespace incise::bench

int main(int argc, char** argv) {
  return incise::bench::run(argc, argv);
}
