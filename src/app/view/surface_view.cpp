// SPDX-License-Identifier: Apache-2.0
// Triangles and points have slots that are used again when they are free, so that a step changes a few of them. A
// step's tets, and those whose sides it opened, are hidden and shown anew; the topology is copied when it is
// published.
#include "app/view/surface_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "incise/geom/quality.h"
#include "incise/mesh/journal_cursor.h"
#include "incise/mesh/journal_visitor.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/shapes.h"
#include "incise/mesh/star.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr float kUnknownDepth = 1e9F;              // length units
constexpr double kIdealRatio = 4.898979485566356;  // 2√6, of a regular tet
constexpr double kMostBytes = 255;

/// Points of different kinds are never shared.
enum PointKind : std::size_t { kSkinPoint, kWallPoint, kInsidePoint, kKinds };

PointKind kind_of(const TriangleLook& look) {
  if ((look.flags & TriangleLook::kInside) != 0) return kInsidePoint;
  return (look.flags & TriangleLook::kWall) != 0 ? kWallPoint : kSkinPoint;
}

std::uint8_t quality_byte_of(const TetMesh& mesh, TetId tet) {
  const TetVertices& v = mesh.vertices(tet);
  return quality_byte(longest_edge_over_inradius(mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3])));
}

double mean_volume(const TetMesh& mesh) {
  double sum = 0;
  mesh.for_each_tet([&](TetId tet) { sum += mesh.rest_volume(tet); });
  return sum / static_cast<double>(std::max<std::size_t>(mesh.tet_count(), 1));
}

/// Both lips have an edge of the front once each, and in opposite directions: it is seen once. An edge within the lips
/// whose ends are on the front is seen once per lip.
void keep_single(std::vector<std::array<std::uint32_t, 2>>& edges) {
  std::sort(edges.begin(), edges.end());
  std::size_t kept = 0;
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    if (end - i == 1) edges[kept++] = edges[i];
  }
  edges.resize(kept);
}

/// The tets whose sides a step may have changed, with repeats, and the vertices that it moved.
struct ChangedTets final : JournalVisitor {
  std::vector<std::uint32_t> tets;
  std::vector<VertexId> moved_vertices;

  void clear() {
    tets.clear();
    moved_vertices.clear();
  }
  void moved(const MovedVertex& vertex) override { moved_vertices.push_back(vertex.id); }
  void replaced(std::span<const ConsumedTet> consumed, std::span<const ProducedTet> produced) override {
    for (const ConsumedTet& tet : consumed) tets.push_back(tet.id.value);
    for (const ProducedTet& tet : produced) tets.push_back(tet.id.value);
  }
  void rewired(const RewiredTet& tet) override { tets.push_back(tet.id.value); }
  void opened(const OpenedFace& face) override {
    tets.push_back(face.a.tet().value);
    tets.push_back(face.b.tet().value);
  }
};

}  // namespace

std::uint8_t quality_byte(double lr) {
  if (!(lr < kBadRatio)) return 255;
  if (!(lr > kIdealRatio)) return 0;
  const double share = std::log(lr / kIdealRatio) / std::log(kBadRatio / kIdealRatio);
  return static_cast<std::uint8_t>(std::min(share * kMostBytes, kMostBytes - 1));
}

double lr_of_quality_byte(std::uint8_t byte) {
  return kIdealRatio * std::pow(kBadRatio / kIdealRatio, byte / kMostBytes);
}

struct SurfaceView::State {
  SurfaceOptions options;
  SurfaceTopology work;
  std::shared_ptr<const SurfaceTopology> published;
  std::vector<std::uint32_t> slot_of_side;                  // per tet slot · 4 + side
  std::vector<std::uint32_t> free_slots;                    // of triangles
  std::array<std::vector<std::uint32_t>, kKinds> point_of;  // per vertex slot
  std::vector<std::uint32_t> uses;                          // per point: triangles at it
  std::vector<std::uint32_t> free_points;
  std::vector<char> is_clipped;  // per tet slot; empty without a clip plane
  StarWalker walker;             // scratch
  ChangedTets changes;           // scratch
  std::uint32_t newest = 0;      // the greatest tag of a wall
  double small_volume = 0;       // below it a tet is too small
  JournalCursor cursor;
  bool is_stale = true;  // the options changed

  void rebuild(const TetMesh& mesh);
  void apply(const Step& step, const TetMesh& mesh);
  void publish(const TetMesh& mesh);

 private:
  void find_clipped(const TetMesh& mesh);
  [[nodiscard]] bool is_hidden(TetId tet) const { return !is_clipped.empty() && is_clipped[tet.value] != 0; }
  void show_tet(const TetMesh& mesh, TetId tet);
  void show_side(const TetMesh& mesh, Side side, std::uint8_t quality);
  void hide_tet(TetId tet);
  void hide_side(Side side);
  void grade(const TetMesh& mesh, TetId tet);
  [[nodiscard]] std::uint8_t size_flag(const TetMesh& mesh, TetId tet) const {
    return mesh.rest_volume(tet) < small_volume ? TriangleLook::kSmall : std::uint8_t{0};
  }
  std::uint32_t take_slot();
  std::uint32_t take_point(VertexId vertex, PointKind kind);
  void drop_point(std::uint32_t point, PointKind kind);
  void mark_newest(const TetMesh& mesh);
  void find_front(const TetMesh& mesh);
  void find_contour();
  void find_rest(const TetMesh& mesh);
  void find_depths();
  bool carry_depth(const std::array<std::uint32_t, 3>& corners);
  void drop_clipped(std::vector<std::array<std::uint32_t, 2>>& edges) const;
};

void SurfaceView::State::rebuild(const TetMesh& mesh) {
  const std::uint64_t version = work.version;
  work = {};
  work.version = version;
  const std::size_t sides = std::size_t{mesh.tet_slots()} * 4;
  slot_of_side.reserve(sides + sides / 2);  // so that the first steps of a blade need not move all of it
  slot_of_side.assign(sides, kNone);
  free_slots.clear();
  free_points.clear();
  uses.clear();
  for (auto& points : point_of) points.assign(mesh.vertex_slots(), kNone);
  newest = 0;
  find_clipped(mesh);
  if (small_volume == 0) small_volume = kSmallShare * mean_volume(mesh);
  mesh.for_each_tet([&](TetId tet) { show_tet(mesh, tet); });
  publish(mesh);
}

void SurfaceView::State::find_clipped(const TetMesh& mesh) {
  is_clipped.clear();
  if (!options.clip) return;
  is_clipped.assign(mesh.tet_slots(), 0);
  mesh.for_each_tet([&](TetId tet) {
    Vec3 centroid = Vec3::Zero();
    for (const VertexId v : mesh.vertices(tet)) centroid += 0.25 * mesh.current(v);
    is_clipped[tet.value] = options.clip->normal.dot(centroid) <= options.clip->offset ? 1 : 0;
  });
}

void SurfaceView::State::apply(const Step& step, const TetMesh& mesh) {
  slot_of_side.resize(std::size_t{mesh.tet_slots()} * 4, kNone);
  for (auto& points : point_of) points.resize(mesh.vertex_slots(), kNone);
  changes.clear();
  visit(step, changes, StepReading::kNet);
  std::vector<std::uint32_t>& touched = changes.tets;
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  for (const std::uint32_t slot : touched) hide_tet(TetId(slot));
  for (const std::uint32_t slot : touched) {
    if (mesh.is_live(TetId(slot))) show_tet(mesh, TetId(slot));
  }
  for (const VertexId vertex : changes.moved_vertices) {
    if (!mesh.is_live(vertex)) continue;
    for (const TetId tet : walker.star(mesh, vertex)) grade(mesh, tet);
  }
}

void SurfaceView::State::show_tet(const TetMesh& mesh, TetId tet) {
  if (is_hidden(tet)) return;
  std::optional<std::uint8_t> quality;
  for (unsigned s = 0; s < 4; ++s) {
    const Link link = mesh.links(tet)[s];
    if (!link.is_boundary() && !is_hidden(link.side().tet())) {
      hide_side(link.side());  // where a wall has closed
      continue;
    }
    if (!quality) quality = quality_byte_of(mesh, tet);
    show_side(mesh, Side(tet, s), *quality);
  }
}

void SurfaceView::State::show_side(const TetMesh& mesh, Side side, std::uint8_t quality) {
  const Link link = mesh.link(side);
  TriangleLook look{0, 0, static_cast<std::uint8_t>(mesh.region(side.tet())), quality};
  if (!link.is_boundary()) {
    look.flags = TriangleLook::kInside;
  } else if (link.tag() > 0) {
    newest = std::max(newest, link.tag());
    look.flags = TriangleLook::kWall;
    look.stroke = static_cast<std::uint8_t>(link.tag());
  }
  look.flags |= size_flag(mesh, side.tet());
  const std::uint32_t slot = take_slot();
  const auto corners = mesh.vertices(side);
  for (std::size_t i = 0; i < 3; ++i) work.triangles[slot][i] = take_point(corners[i], kind_of(look));
  work.looks[slot] = look;
  work.sides[slot] = side;
  slot_of_side[side.value] = slot;
  ++work.used;
}

void SurfaceView::State::hide_tet(TetId tet) {
  for (unsigned s = 0; s < 4; ++s) hide_side(Side(tet, s));
}

void SurfaceView::State::hide_side(Side side) {
  const std::uint32_t slot = slot_of_side[side.value];
  if (slot == kNone) return;
  slot_of_side[side.value] = kNone;
  for (const std::uint32_t point : work.triangles[slot]) drop_point(point, kind_of(work.looks[slot]));
  work.triangles[slot] = {0, 0, 0};
  work.looks[slot] = {};
  work.sides[slot] = {};
  free_slots.push_back(slot);
  --work.used;
}

void SurfaceView::State::grade(const TetMesh& mesh, TetId tet) {
  std::optional<std::uint8_t> quality;
  for (unsigned s = 0; s < 4; ++s) {
    const std::uint32_t slot = slot_of_side[Side(tet, s).value];
    if (slot == kNone) continue;
    if (!quality) quality = quality_byte_of(mesh, tet);
    work.looks[slot].quality = *quality;
    const unsigned other_flags = work.looks[slot].flags & ~unsigned{TriangleLook::kSmall};
    work.looks[slot].flags = static_cast<std::uint8_t>(other_flags | size_flag(mesh, tet));
  }
}

std::uint32_t SurfaceView::State::take_slot() {
  if (!free_slots.empty()) {
    const std::uint32_t slot = free_slots.back();
    free_slots.pop_back();
    return slot;
  }
  work.triangles.emplace_back();
  work.looks.emplace_back();
  work.sides.emplace_back();
  return static_cast<std::uint32_t>(work.triangles.size() - 1);
}

std::uint32_t SurfaceView::State::take_point(VertexId vertex, PointKind kind) {
  std::uint32_t& point = point_of[kind][vertex.value];
  if (point == kNone && !free_points.empty()) {
    point = free_points.back();
    free_points.pop_back();
    work.vertices[point] = vertex;
  } else if (point == kNone) {
    point = static_cast<std::uint32_t>(work.vertices.size());
    work.vertices.push_back(vertex);
    uses.push_back(0);
  }
  ++uses[point];
  return point;
}

void SurfaceView::State::drop_point(std::uint32_t point, PointKind kind) {
  if (--uses[point] > 0) return;
  point_of[kind][work.vertices[point].value] = kNone;
  work.vertices[point] = {};
  free_points.push_back(point);
}

void SurfaceView::State::mark_newest(const TetMesh& mesh) {
  for (std::size_t slot = 0; slot < work.looks.size(); ++slot) {
    TriangleLook& look = work.looks[slot];
    if ((look.flags & TriangleLook::kWall) == 0) continue;
    const bool is_newest = mesh.link(work.sides[slot]).tag() == newest;  // `stroke` alone repeats after 256
    const unsigned others = look.flags & ~unsigned{TriangleLook::kNewest};
    look.flags = static_cast<std::uint8_t>(others | (is_newest ? TriangleLook::kNewest : 0U));
  }
}

void SurfaceView::State::find_front(const TetMesh& mesh) {
  auto& edges = work.front_edges;
  edges.clear();
  const auto is_front = [&](std::uint32_t point) { return (mesh.shape_of(work.vertices[point]) & shape::kFront) != 0; };
  for (std::size_t slot = 0; slot < work.triangles.size(); ++slot) {
    if ((work.looks[slot].flags & TriangleLook::kWall) == 0) continue;
    const auto& corners = work.triangles[slot];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = corners[i], to = corners[(i + 1) % 3];
      if (from < to && is_front(from) && is_front(to)) edges.push_back({from, to});
    }
  }
  keep_single(edges);
}

void SurfaceView::State::publish(const TetMesh& mesh) {
  mark_newest(mesh);
  find_front(mesh);
  find_contour();
  find_rest(mesh);
  find_depths();
  ++work.version;
  published = std::make_shared<const SurfaceTopology>(work);
}

void SurfaceView::State::find_rest(const TetMesh& mesh) {
  work.rest.resize(work.vertices.size(), Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < work.vertices.size(); ++i) {
    if (work.vertices[i].is_valid()) work.rest[i] = mesh.rest(work.vertices[i]).cast<float>();
  }
}

/// By the edges of the walls, from the rims inwards. A few passes over all of them, to and fro, are as good as exact:
/// what they have not reached lies deep.
void SurfaceView::State::find_depths() {
  constexpr int kPasses = 6;
  const float deep = std::numeric_limits<float>::max();
  work.depths.assign(work.vertices.size(), 0);
  std::vector<std::uint32_t> walls;
  for (std::uint32_t slot = 0; slot < work.triangles.size(); ++slot) {
    if ((work.looks[slot].flags & TriangleLook::kWall) == 0) continue;
    walls.push_back(slot);
    for (const std::uint32_t point : work.triangles[slot]) work.depths[point] = deep;
  }
  for (const auto& [from, to] : work.contour_edges) work.depths[from] = work.depths[to] = 0;
  bool has_changed = !walls.empty();
  for (int pass = 0; pass < kPasses && has_changed; ++pass) {
    has_changed = false;
    for (const std::uint32_t slot : walls) has_changed = carry_depth(work.triangles[slot]) || has_changed;
    std::reverse(walls.begin(), walls.end());
  }
  // A wall without a rim, as of a cut that lies within the body: as deep as can be told.
  for (float& depth : work.depths) depth = depth == deep ? kUnknownDepth : depth;
}

/// From the corners of a triangle that lie higher to the others. Returns whether any is higher now.
bool SurfaceView::State::carry_depth(const std::array<std::uint32_t, 3>& corners) {
  bool has_changed = false;
  for (std::size_t i = 0; i < 6; ++i) {
    const std::uint32_t from = corners[i % 3], to = corners[(i + 1 + i / 3) % 3];
    const float depth = work.depths[from] + (work.rest[to] - work.rest[from]).norm();
    if (!(depth < work.depths[to])) continue;
    work.depths[to] = depth;
    has_changed = true;
  }
  return has_changed;
}

/// Where a wall has no other wall beside it: an edge of walls that is there once.
void SurfaceView::State::find_contour() {
  auto& edges = work.contour_edges;
  edges.clear();
  for (std::size_t slot = 0; slot < work.triangles.size(); ++slot) {
    if ((work.looks[slot].flags & TriangleLook::kWall) == 0) continue;
    const auto& corners = work.triangles[slot];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = corners[i], to = corners[(i + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to)});
    }
  }
  keep_single(edges);
  drop_clipped(edges);
}

/// Where a clip plane ends a wall there is no rim.
void SurfaceView::State::drop_clipped(std::vector<std::array<std::uint32_t, 2>>& edges) const {
  std::vector<std::array<std::uint32_t, 2>> clipped;
  const auto wall_point = [&](std::uint32_t point) { return point_of[kWallPoint][work.vertices[point].value]; };
  for (std::size_t slot = 0; slot < work.triangles.size(); ++slot) {
    if ((work.looks[slot].flags & TriangleLook::kInside) == 0) continue;
    const auto& corners = work.triangles[slot];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = wall_point(corners[i]), to = wall_point(corners[(i + 1) % 3]);
      clipped.push_back({std::min(from, to), std::max(from, to)});
    }
  }
  std::sort(clipped.begin(), clipped.end());
  std::erase_if(edges, [&](const auto& edge) { return std::binary_search(clipped.begin(), clipped.end(), edge); });
}

SurfaceView::SurfaceView(const TetMesh& mesh, const Journal& journal) : state_(std::make_unique<State>()) {
  follow(mesh, journal);
}
SurfaceView::SurfaceView(SurfaceView&&) noexcept = default;
SurfaceView& SurfaceView::operator=(SurfaceView&&) noexcept = default;
SurfaceView::~SurfaceView() = default;

void SurfaceView::set_options(const SurfaceOptions& options) {
  state_->options = options;
  state_->is_stale = true;
}

bool SurfaceView::follow(const TetMesh& mesh, const Journal& journal) {
  State& s = *state_;
  const JournalCursor::Way way = s.cursor.way_to(journal);
  if (way == JournalCursor::Way::kNone && !s.is_stale) return false;
  if (way == JournalCursor::Way::kElsewhere || s.is_stale || s.options.clip) {
    s.rebuild(mesh);
  } else {
    // What a step did to a tet that later steps changed again no longer matters: the mesh tells.
    for (std::size_t i = s.cursor.position(); i < journal.position(); ++i) s.apply(journal.step(i), mesh);
    s.publish(mesh);
  }
  s.cursor.move_to(journal);
  s.is_stale = false;
  return true;
}

void SurfaceView::fill(const TetMesh& mesh, SurfaceFrame& frame) const {
  frame.topology = state_->published;
  const std::vector<VertexId>& vertices = frame.topology->vertices;
  frame.positions.resize(vertices.size());
  Eigen::Vector3f last = Eigen::Vector3f::Zero();
  for (const VertexId v : vertices) {
    if (v.is_valid()) {
      last = mesh.current(v).cast<float>();
      break;
    }
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (vertices[i].is_valid()) last = mesh.current(vertices[i]).cast<float>();
    frame.positions[i] = last;  // free points stand somewhere on the surface
  }
}

}  // namespace app
}  // namespace v0
}  // namespace incise
