// SPDX-License-Identifier: Apache-2.0
// What is drawn of a body with a fine surface, slot by slot. Each step names tets and triangles that it changed; what
// was drawn of them, and of the tets around their vertices, is taken away and drawn again from what stands now.
#include <algorithm>
#include <array>
#include <unordered_map>

#include "incise/mesh/drawn_surface.h"
#include "incise/mesh/journal_cursor.h"
#include "incise/mesh/journal_visitor.h"
#include "incise/mesh/star.h"
#include "mesh/constants.h"

namespace incise {
inline namespace v0 {
namespace {

constexpr std::uint8_t kContour = shape::kSkin | shape::kWall;

bool is_contour(const TetMesh& mesh, VertexId v) {
  return (mesh.shape_of(v) & kContour) == kContour;
}

/// The axis that a triangle at rest faces along most.
std::size_t facing(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a).cwiseAbs();
  Eigen::Index axis = 0;
  normal.maxCoeff(&axis);
  return static_cast<std::size_t>(axis);
}

bool is_flat(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return !((b - a).cross(c - a).norm() > kLeastWidth * longest);
}

/// The vertex of the wall's rim that a point of the fine rim is nearest to, by its tet.
VertexId rim_vertex(const TetMesh& mesh, const Binding& binding) {
  VertexId best;
  double most = 0;
  for (unsigned c = 0; c < 4; ++c) {
    const VertexId v = mesh.vertices(binding.tet)[c];
    if (!is_contour(mesh, v) || !(binding.weights[c] > most)) continue;
    most = binding.weights[c];
    best = v;
  }
  return best;
}

/// The tets and vertices that steps name, with repeats.
struct NamedParts final : JournalVisitor {
  std::vector<TetId> tets;
  std::vector<VertexId> vertices, moved_vertices;

  void clear() {
    tets.clear();
    vertices.clear();
    moved_vertices.clear();
  }
  void add(TetId tet, const TetVertices& corners) {
    tets.push_back(tet);
    vertices.insert(vertices.end(), corners.begin(), corners.end());
  }
  void moved(const MovedVertex& vertex) override { moved_vertices.push_back(vertex.id); }
  void replaced(std::span<const ConsumedTet> consumed, std::span<const ProducedTet> produced) override {
    for (const ConsumedTet& tet : consumed) add(tet.id, tet.vertices);
    for (const ProducedTet& tet : produced) add(tet.id, tet.vertices);
  }
  void rewired(const RewiredTet& tet) override {
    add(tet.id, tet.old_vertices);
    add(tet.id, tet.vertices);
  }
  void opened(const OpenedFace& face) override {
    tets.push_back(face.a.tet());
    tets.push_back(face.b.tet());
  }
  void closed(const OpenedFace& face) override { opened(face); }
};

template <class Id>
void sort_unique(std::vector<Id>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

/// An array that is `none` beyond its end.
class SlotMap {
 public:
  [[nodiscard]] std::uint32_t operator[](std::size_t key) const {
    return key < slots_.size() ? slots_[key] : kInvalidIndex;
  }
  std::uint32_t& at(std::size_t key) {
    if (key >= slots_.size()) slots_.resize(key + 1 + key / 2, kInvalidIndex);
    return slots_[key];
  }

 private:
  std::vector<std::uint32_t> slots_;
};

}  // namespace

class SurfaceDrawing::State {
 public:
  void draw_all(const EmbeddedSurface& surface, const TetMesh& mesh, const Journal& journal);
  bool follow(const EmbeddedSurface& surface, const TetMesh& mesh, const Journal& journal);

  [[nodiscard]] const std::vector<DrawnPoint>& points() const { return points_; }
  [[nodiscard]] const std::vector<DrawnTriangle>& triangles() const { return triangles_; }
  [[nodiscard]] std::size_t looked_at() const { return looked_at_; }
  [[nodiscard]] DrawnSurface packed() const;

 private:
  /// What a point stands for: a point of the surface as skin or as rim, or a vertex of a wall. Rims and walls have one
  /// for each axis that their triangles face along.
  enum Role : std::uint8_t { kSkin, kRim, kWall };
  struct PointKey {
    Role role;
    std::uint8_t axis;
    std::uint32_t id;  // slot of the fine point, or of the vertex
  };
  /// Where a vertex of a wall is drawn.
  struct Place {
    Vec3 rest;
    Binding binding;
    std::uint32_t stroke;  // the newest of its walls
  };
  /// The rims of a triangle of the surface, and what they depend on.
  struct Rims {
    std::vector<std::uint32_t> triangles;
    std::vector<std::uint64_t> needs;
  };

  static std::uint64_t need_of(TetId tet) { return tet.value; }
  static std::uint64_t need_of(std::uint32_t fine_point) { return std::uint64_t{1} << 32 | fine_point; }

  void find_changes(const TetMesh& mesh, const Journal& journal);
  void add_stars(const TetMesh& mesh);
  void add_stars_of(const TetMesh& mesh, std::vector<VertexId>& vertices);
  void find_rims_in_need();
  void take_away();
  void draw_changes(const EmbeddedSurface& surface, const TetMesh& mesh);
  void update_points(const EmbeddedSurface& surface, const TetMesh& mesh);

  void show_tet(const TetMesh& mesh, TetId tet);
  void hide_tet(TetId tet);
  void show_skin(std::uint32_t triangle);
  void hide_skin(std::uint32_t triangle);
  void show_rims(const TetMesh& mesh, std::uint32_t triangle);
  void hide_rims(std::uint32_t triangle);
  void add_rim(const TetMesh& mesh, std::uint32_t from, std::uint32_t to, Rims& rims);

  const Place& place_of(const TetMesh& mesh, VertexId v);
  [[nodiscard]] DrawnPoint wall_point(const Place& place, std::size_t axis) const;
  [[nodiscard]] DrawnPoint rim_point(std::uint32_t slot, std::size_t axis) const;
  std::uint32_t take_wall_point(const TetMesh& mesh, VertexId v, std::size_t axis) {
    return take_point({kWall, static_cast<std::uint8_t>(axis), v.value}, wall_point(place_of(mesh, v), axis));
  }
  std::uint32_t take_rim_point(std::uint32_t slot, std::size_t axis) {
    return take_point({kRim, static_cast<std::uint8_t>(axis), slot}, rim_point(slot, axis));
  }
  std::uint32_t take_point(const PointKey& key, const DrawnPoint& point);
  void drop_point(std::uint32_t slot);
  std::uint32_t take_triangle(const DrawnTriangle& triangle);
  void drop_triangle(std::uint32_t slot);
  SlotMap& slots_of(const PointKey& key) { return point_slots_[std::size_t{key.role} * 3 + key.axis]; }

  const EmbeddedSurface* surface_ = nullptr;  // while it is drawn
  JournalCursor cursor_;
  std::uint64_t seen_ = 0, version_ = 0;  // state and version of the surface

  std::vector<DrawnPoint> points_;
  std::vector<PointKey> keys_;       // of points
  std::vector<std::uint32_t> uses_;  // of points: triangles at each
  std::vector<DrawnTriangle> triangles_;
  std::vector<std::uint32_t> free_points_, free_triangles_;
  std::array<SlotMap, 9> point_slots_;                                  // by role and axis: of a fine point or a vertex
  SlotMap skin_slots_, wall_slots_;                                     // by triangle of the surface; by side
  std::unordered_map<std::uint32_t, Rims> rims_;                        // by triangle of the surface
  std::unordered_multimap<std::uint64_t, std::uint32_t> rims_by_need_;  // triangles of the surface
  std::unordered_map<std::uint32_t, Place> places_;                     // of vertices

  // Scratch of one `follow`, each sorted and without repeats.
  NamedParts named_;
  std::vector<std::uint32_t> fine_points_, fine_triangles_, rims_to_draw_;
  StarWalker walker_;
  std::size_t looked_at_ = 0;
};

void SurfaceDrawing::State::draw_all(const EmbeddedSurface& surface, const TetMesh& mesh, const Journal& journal) {
  *this = {};
  surface_ = &surface;
  cursor_.move_to(journal);
  seen_ = surface.changes().to;
  version_ = surface.version();
  const auto count = static_cast<std::uint32_t>(surface.triangles().size());
  for (std::uint32_t i = 0; i < count; ++i) show_skin(i);
  mesh.for_each_tet([&](TetId tet) { show_tet(mesh, tet); });
  for (std::uint32_t i = 0; i < count; ++i) show_rims(mesh, i);
  looked_at_ = mesh.tet_count() + count;
}

bool SurfaceDrawing::State::follow(const EmbeddedSurface& surface, const TetMesh& mesh, const Journal& journal) {
  const FineChanges& changes = surface.changes();
  const bool has_seen = seen_ == changes.to, has_moved = cursor_.way_to(journal) != JournalCursor::Way::kNone;
  looked_at_ = 0;
  if (has_seen && !has_moved) return false;
  if ((!has_seen && seen_ != changes.from) || !cursor_.can_walk_to(journal)) {
    draw_all(surface, mesh, journal);
    return true;
  }
  surface_ = &surface;
  fine_points_.clear();
  fine_triangles_.clear();
  if (!has_seen) {
    fine_points_ = changes.points;
    fine_triangles_ = changes.triangles;
  }
  find_changes(mesh, journal);
  take_away();
  update_points(surface, mesh);
  draw_changes(surface, mesh);
  cursor_.move_to(journal);
  seen_ = changes.to;
  version_ = surface.version();
  looked_at_ = named_.tets.size() + fine_triangles_.size() + rims_to_draw_.size();
  return true;
}

void SurfaceDrawing::State::find_changes(const TetMesh& mesh, const Journal& journal) {
  named_.clear();
  const std::size_t begin = std::min(cursor_.position(), journal.position());
  const std::size_t end = std::max(cursor_.position(), journal.position());
  for (std::size_t i = begin; i < end; ++i) visit(journal.step(i), named_, StepReading::kNet);
  add_stars(mesh);
  sort_unique(fine_points_);
  sort_unique(fine_triangles_);
  find_rims_in_need();
}

/// What is drawn of a tet depends on where its vertices are drawn, and that on the tets around them: on which there
/// are, and on their shapes.
void SurfaceDrawing::State::add_stars(const TetMesh& mesh) {
  add_stars_of(mesh, named_.moved_vertices);
  for (const TetId tet : named_.tets) {
    if (tet.value >= mesh.tet_slots() || !mesh.is_live(tet)) continue;
    const TetVertices& corners = mesh.vertices(tet);
    named_.vertices.insert(named_.vertices.end(), corners.begin(), corners.end());
  }
  add_stars_of(mesh, named_.vertices);
}

void SurfaceDrawing::State::add_stars_of(const TetMesh& mesh, std::vector<VertexId>& vertices) {
  sort_unique(vertices);
  for (const VertexId v : vertices) {
    if (v.value >= mesh.vertex_slots() || !mesh.is_live(v)) continue;
    const auto& star = walker_.star(mesh, v);
    named_.tets.insert(named_.tets.end(), star.begin(), star.end());
  }
  sort_unique(named_.tets);
}

/// Rims at the tets, points and triangles that changed.
void SurfaceDrawing::State::find_rims_in_need() {
  rims_to_draw_ = fine_triangles_;
  const auto add = [&](std::uint64_t need) {
    const auto [begin, end] = rims_by_need_.equal_range(need);
    for (auto at = begin; at != end; ++at) rims_to_draw_.push_back(at->second);
  };
  for (const TetId tet : named_.tets) add(need_of(tet));
  for (const std::uint32_t point : fine_points_) add(need_of(point));
  sort_unique(rims_to_draw_);
}

void SurfaceDrawing::State::take_away() {
  for (const std::uint32_t triangle : rims_to_draw_) hide_rims(triangle);
  for (const TetId tet : named_.tets) hide_tet(tet);
  for (const std::uint32_t triangle : fine_triangles_) hide_skin(triangle);
}

/// Points that what was not taken away still has.
void SurfaceDrawing::State::update_points(const EmbeddedSurface& surface, const TetMesh& mesh) {
  for (const VertexId v : named_.vertices) places_.erase(v.value);
  for (const VertexId v : named_.vertices) {
    for (std::uint8_t axis = 0; axis < 3; ++axis) {
      const std::uint32_t slot = point_slots_[std::size_t{kWall} * 3 + axis][v.value];
      if (slot != kInvalidIndex && mesh.is_live(v)) points_[slot] = wall_point(place_of(mesh, v), axis);
    }
  }
  for (const std::uint32_t point : fine_points_) {
    if (point >= surface.points().size()) continue;
    const FinePoint& fine = surface.points()[point];
    const std::uint32_t slot = point_slots_[std::size_t{kSkin} * 3][point];
    if (slot != kInvalidIndex) points_[slot] = {fine.rest, fine.binding, fine.texture, fine.normal};
  }
}

void SurfaceDrawing::State::draw_changes(const EmbeddedSurface& surface, const TetMesh& mesh) {
  for (const std::uint32_t triangle : fine_triangles_) {
    if (triangle < surface.triangles().size()) show_skin(triangle);
  }
  for (const TetId tet : named_.tets) {
    if (tet.value < mesh.tet_slots() && mesh.is_live(tet)) show_tet(mesh, tet);
  }
  for (const std::uint32_t triangle : rims_to_draw_) {
    if (triangle < surface.triangles().size()) show_rims(mesh, triangle);
  }
}

// ---- Skin and walls ------------------------------------------------------------------------------------------------

void SurfaceDrawing::State::show_skin(std::uint32_t triangle) {
  const FineTriangle& fine = surface_->triangles()[triangle];
  if (!fine.is_live() || fine.points[0] == fine.points[1]) return;
  DrawnTriangle drawn;
  drawn.kind = DrawnTriangle::Kind::kSkin;
  for (std::size_t i = 0; i < 3; ++i) {
    const FinePoint& point = surface_->points()[fine.points[i]];
    drawn.points[i] = take_point({kSkin, 0, fine.points[i]}, {point.rest, point.binding, point.texture, point.normal});
  }
  skin_slots_.at(triangle) = take_triangle(drawn);
}

void SurfaceDrawing::State::hide_skin(std::uint32_t triangle) {
  if (skin_slots_[triangle] == kInvalidIndex) return;
  drop_triangle(skin_slots_[triangle]);
  skin_slots_.at(triangle) = kInvalidIndex;
}

void SurfaceDrawing::State::show_tet(const TetMesh& mesh, TetId tet) {
  for (unsigned s = 0; s < 4; ++s) {
    const Link link = mesh.links(tet)[s];
    if (!link.is_boundary() || link.tag() == 0) continue;
    const Side side(tet, s);
    const auto v = mesh.vertices(side);
    const std::size_t axis = facing(mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]));
    DrawnTriangle drawn;
    drawn.kind = DrawnTriangle::Kind::kWall;
    drawn.stroke = link.tag();
    for (std::size_t i = 0; i < 3; ++i) drawn.points[i] = take_wall_point(mesh, v[i], axis);
    wall_slots_.at(side.value) = take_triangle(drawn);
  }
}

void SurfaceDrawing::State::hide_tet(TetId tet) {
  for (unsigned s = 0; s < 4; ++s) {
    const std::uint32_t side = Side(tet, s).value;
    if (wall_slots_[side] == kInvalidIndex) continue;
    drop_triangle(wall_slots_[side]);
    wall_slots_.at(side) = kInvalidIndex;
  }
}

// ---- Rims ----------------------------------------------------------------------------------------------------------

/// Between the rim of the fine surface and that of the walls.
void SurfaceDrawing::State::show_rims(const TetMesh& mesh, std::uint32_t triangle) {
  const FineTriangle& fine = surface_->triangles()[triangle];
  if (!fine.is_live() || fine.lips == 0) return;
  Rims rims;
  for (std::size_t i = 0; i < 3; ++i) {
    if ((fine.lips >> i & 1U) != 0) add_rim(mesh, fine.points[(i + 1) % 3], fine.points[i], rims);
  }
  sort_unique(rims.needs);
  for (const std::uint64_t need : rims.needs) rims_by_need_.emplace(need, triangle);
  rims_.emplace(triangle, std::move(rims));
}

void SurfaceDrawing::State::hide_rims(std::uint32_t triangle) {
  const auto found = rims_.find(triangle);
  if (found == rims_.end()) return;
  for (const std::uint64_t need : found->second.needs) {
    const auto [begin, end] = rims_by_need_.equal_range(need);
    rims_by_need_.erase(std::find_if(begin, end, [&](const auto& entry) { return entry.second == triangle; }));
  }
  for (const std::uint32_t slot : found->second.triangles) drop_triangle(slot);
  rims_.erase(found);
}

/// `from` to `to` is the rim as the wall has it.
void SurfaceDrawing::State::add_rim(const TetMesh& mesh, std::uint32_t from, std::uint32_t to, Rims& rims) {
  const FinePoint &p = surface_->points()[from], &q = surface_->points()[to];
  for (const std::uint32_t point : {from, to}) {
    rims.needs.push_back(need_of(point));
    rims.needs.push_back(need_of(surface_->points()[point].binding.tet));
  }
  const VertexId at_p = rim_vertex(mesh, p.binding), at_q = rim_vertex(mesh, q.binding);
  if (!at_p.is_valid()) return;
  const auto add = [&](const std::array<std::uint32_t, 3>& points, std::uint32_t stroke) {
    rims.triangles.push_back(take_triangle({points, stroke, DrawnTriangle::Kind::kRim}));
  };
  const Place b = place_of(mesh, at_p);
  if (!is_flat(p.rest, q.rest, b.rest)) {
    const std::size_t axis = facing(p.rest, q.rest, b.rest);
    add({take_rim_point(from, axis), take_rim_point(to, axis), take_wall_point(mesh, at_p, axis)}, b.stroke);
  }
  if (!at_q.is_valid() || at_p == at_q) return;
  if (mesh.corner_of(p.binding.tet, at_q) == 4 && mesh.corner_of(q.binding.tet, at_p) == 4) return;
  const Place a = place_of(mesh, at_q);
  if (is_flat(q.rest, a.rest, b.rest)) return;
  const std::size_t axis = facing(q.rest, a.rest, b.rest);
  add({take_rim_point(to, axis), take_wall_point(mesh, at_q, axis), take_wall_point(mesh, at_p, axis)}, a.stroke);
}

// ---- Points --------------------------------------------------------------------------------------------------------

/// A rim's vertex is drawn at the nearest point of the fine surface. It hangs on the first of its tets, so that the way
/// by which the mesh came to be does not matter.
const SurfaceDrawing::State::Place& SurfaceDrawing::State::place_of(const TetMesh& mesh, VertexId v) {
  const auto [found, is_new] = places_.try_emplace(v.value);
  Place& place = found->second;
  if (!is_new) return place;
  place.rest = mesh.rest(v);
  if (is_contour(mesh, v)) {
    const double reach = surface_->reach() + surface_->greatest_distance();
    place.rest = surface_->find_nearest(place.rest, reach).value_or(place.rest);
  }
  place.stroke = 0;
  TetId first = mesh.tet_of(v);
  for (const TetId tet : walker_.star(mesh, v)) {
    first = std::min(first, tet);
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(tet)[s];
      if (mesh.vertices(tet)[s] != v && link.is_boundary()) place.stroke = std::max(place.stroke, link.tag());
    }
  }
  place.binding = bind_to(mesh, first, place.rest);
  return place;
}

/// Coordinates of walls are those at rest along the two axes after the one that they face along.
std::array<double, 2> texture_at(const Vec3& rest, std::size_t axis) {
  const auto at = [&](std::size_t k) { return rest[static_cast<Eigen::Index>(k % 3)]; };
  return {at(axis + 1), at(axis + 2)};
}

DrawnPoint SurfaceDrawing::State::wall_point(const Place& place, std::size_t axis) const {
  return {place.rest, place.binding, texture_at(place.rest, axis), Vec3::Zero()};
}

DrawnPoint SurfaceDrawing::State::rim_point(std::uint32_t slot, std::size_t axis) const {
  const FinePoint& point = surface_->points()[slot];
  return {point.rest, point.binding, texture_at(point.rest, axis), Vec3::Zero()};
}

std::uint32_t SurfaceDrawing::State::take_point(const PointKey& key, const DrawnPoint& point) {
  std::uint32_t& slot = slots_of(key).at(key.id);
  if (slot == kInvalidIndex && !free_points_.empty()) {
    slot = free_points_.back();
    free_points_.pop_back();
    points_[slot] = point;
    keys_[slot] = key;
  } else if (slot == kInvalidIndex) {
    slot = static_cast<std::uint32_t>(points_.size());
    points_.push_back(point);
    keys_.push_back(key);
    uses_.push_back(0);
  }
  ++uses_[slot];
  return slot;
}

void SurfaceDrawing::State::drop_point(std::uint32_t slot) {
  if (--uses_[slot] > 0) return;
  slots_of(keys_[slot]).at(keys_[slot].id) = kInvalidIndex;
  points_[slot].binding.tet = {};
  free_points_.push_back(slot);
}

std::uint32_t SurfaceDrawing::State::take_triangle(const DrawnTriangle& triangle) {
  if (free_triangles_.empty()) {
    triangles_.push_back(triangle);
    return static_cast<std::uint32_t>(triangles_.size() - 1);
  }
  const std::uint32_t slot = free_triangles_.back();
  free_triangles_.pop_back();
  triangles_[slot] = triangle;
  return slot;
}

void SurfaceDrawing::State::drop_triangle(std::uint32_t slot) {
  for (const std::uint32_t point : triangles_[slot].points) drop_point(point);
  triangles_[slot] = {};
  free_triangles_.push_back(slot);
}

// ---- What it draws, in one piece -----------------------------------------------------------------------------------

DrawnSurface SurfaceDrawing::State::packed() const {
  DrawnSurface drawn;
  std::vector<std::uint32_t> numbers(points_.size(), kInvalidIndex);
  const auto number_of = [&](std::uint32_t slot) {
    if (numbers[slot] == kInvalidIndex) {
      numbers[slot] = static_cast<std::uint32_t>(drawn.points.size());
      drawn.points.push_back(points_[slot]);
    }
    return numbers[slot];
  };
  for (const auto kind : {DrawnTriangle::Kind::kSkin, DrawnTriangle::Kind::kWall, DrawnTriangle::Kind::kRim}) {
    for (const DrawnTriangle& triangle : triangles_) {
      if (triangle.kind != kind) continue;
      const auto& [a, b, c] = triangle.points;
      const std::array<std::uint32_t, 3> packed = {number_of(a), number_of(b), number_of(c)};
      (kind == DrawnTriangle::Kind::kSkin ? drawn.skin : drawn.walls).push_back(packed);
      if (kind != DrawnTriangle::Kind::kSkin) drawn.wall_strokes.push_back(triangle.stroke);
      if (kind == DrawnTriangle::Kind::kRim) ++drawn.rim_triangles;
    }
    if (kind == DrawnTriangle::Kind::kSkin) drawn.skin_points = drawn.points.size();
  }
  drawn.version = version_;
  return drawn;
}

SurfaceDrawing::SurfaceDrawing(const EmbeddedSurface& surface, const TetMesh& mesh, const Journal& journal)
    : state_(std::make_unique<State>()) {
  state_->draw_all(surface, mesh, journal);
}
SurfaceDrawing::SurfaceDrawing(SurfaceDrawing&&) noexcept = default;
SurfaceDrawing& SurfaceDrawing::operator=(SurfaceDrawing&&) noexcept = default;
SurfaceDrawing::~SurfaceDrawing() = default;

bool SurfaceDrawing::follow(const EmbeddedSurface& surface, const TetMesh& mesh, const Journal& journal) {
  return state_->follow(surface, mesh, journal);
}
const std::vector<DrawnPoint>& SurfaceDrawing::points() const {
  return state_->points();
}
const std::vector<DrawnTriangle>& SurfaceDrawing::triangles() const {
  return state_->triangles();
}
std::size_t SurfaceDrawing::looked_at() const {
  return state_->looked_at();
}
DrawnSurface SurfaceDrawing::packed() const {
  return state_->packed();
}

}  // namespace v0
}  // namespace incise
