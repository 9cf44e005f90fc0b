// SPDX-License-Identifier: Apache-2.0
// What a step touched is looked at anew: the triangles whose boxes come near a tet that came, went or moved at rest.
// For each, its corners are bound, its edges are parted where they cross walls, and its parts are made; what comes out
// as it was is left alone, slots included. So the surface is a function of what was given and of the mesh.
#include "mesh/surface_keeper.h"

#include <algorithm>
#include <string>
#include <tuple>

#include "incise/mesh/edge_length.h"
#include "incise/mesh/journal_visitor.h"
#include "mesh/constants.h"

namespace incise {
inline namespace v0 {
namespace {

bool is_below(const Vec3& a, const Vec3& b) {
  return std::make_tuple(a.x(), a.y(), a.z()) < std::make_tuple(b.x(), b.y(), b.z());
}

/// The tets that a step touched, with repeats, and the vertices that it moved.
struct TouchedTets final : JournalVisitor {
  std::vector<TetId> tets;
  std::vector<VertexId> moved_vertices;

  void moved(const MovedVertex& vertex) override { moved_vertices.push_back(vertex.id); }
  void replaced(std::span<const ConsumedTet> consumed, std::span<const ProducedTet> produced) override {
    for (const ConsumedTet& tet : consumed) tets.push_back(tet.id);
    for (const ProducedTet& tet : produced) tets.push_back(tet.id);
  }
  void rewired(const RewiredTet& tet) override { tets.push_back(tet.id); }
  void opened(const OpenedFace& face) override {
    tets.push_back(face.a.tet());
    tets.push_back(face.b.tet());
  }
  void closed(const OpenedFace& face) override { opened(face); }
};

/// The slots that a batch wrote or appended, to `slots`.
template <class Log>
void append_slots(const Log& log, std::vector<std::uint32_t>& slots) {
  for (const auto& [slot, value] : log.written) slots.push_back(slot);
  for (std::size_t slot = log.size_before; slot < log.size_after; ++slot) {
    slots.push_back(static_cast<std::uint32_t>(slot));
  }
}

/// Walls that lie on each other, or run along an edge, cross it many times in one place: only what is before and behind
/// that place counts.
void merge_close(const TetMesh& mesh, const Vec3& from, const Vec3& to, std::vector<WallCrossing>& crossings) {
  std::size_t kept = 0;
  for (std::size_t i = 0, end = 0; i < crossings.size(); i = end) {
    WallCrossing merged = crossings[i];
    for (end = i + 1; end < crossings.size() && crossings[end].t - crossings[end - 1].t < kLeastGap; ++end) {
      merged.high = crossings[end].high;
    }
    merged.t = (crossings[i].t + crossings[end - 1].t) / 2;
    if (end - i == 1 || are_parted(mesh, merged.low, merged.high, from + merged.t * (to - from))) {
      crossings[kept++] = merged;
    }
  }
  crossings.resize(kept);
}

}  // namespace

EmbeddedSurface::Keeper::Keeper(FineSurface surface, const TetMesh& mesh, const Journal& journal)
    : surface_(std::move(surface)),
      tree_(surface_.points, surface_.triangles),
      grid_(mesh),
      near_(extent()),
      mean_edge_(mean_edge_length(mesh)),
      base_(journal.position()),
      base_serial_(journal.serial_before(journal.position())) {
  if (surface_.normals.empty()) make_normals();
  list_edges();
  points_.begin();
  triangles_.begin();
  roots_.begin();
  for (std::size_t i = 0; i < surface_.points.size(); ++i) {
    FinePoint point;
    point.rest = surface_.points[i];
    if (!surface_.texture.empty()) point.texture = surface_.texture[i];
    point.normal = surface_.normals[i];
    points_.append(point);
  }
  for (std::uint32_t root = 0; root < surface_.triangles.size(); ++root) {
    FineTriangle triangle;
    triangle.points = surface_.triangles[root];
    triangle.root = root;
    triangles_.append(triangle);
    roots_.append({});
  }
  root_marks_.assign(surface_.triangles.size(), 0);
  edge_marks_.assign(edges_.size(), 0);
  point_marks_.assign(surface_.points.size(), 0);
}

void EmbeddedSurface::Keeper::list_edges() {
  struct Use {
    std::uint32_t a, b, root, corner;
  };
  std::vector<Use> uses;
  for (std::uint32_t root = 0; root < surface_.triangles.size(); ++root) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t p = surface_.triangles[root][i], q = surface_.triangles[root][(i + 1) % 3];
      const bool is_ordered = is_below(surface_.points[p], surface_.points[q]) ||
                              (!is_below(surface_.points[q], surface_.points[p]) && p < q);
      uses.push_back({is_ordered ? p : q, is_ordered ? q : p, root, i});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const Use& x, const Use& y) {
    return std::tie(x.a, x.b, x.root, x.corner) < std::tie(y.a, y.b, y.root, y.corner);
  });
  edges_of_.resize(surface_.triangles.size());
  edges_.begin();
  for (std::size_t i = 0; i < uses.size(); ++i) {
    if (i == 0 || uses[i].a != uses[i - 1].a || uses[i].b != uses[i - 1].b) {
      first_root_.push_back(static_cast<std::uint32_t>(i));
      edges_.append({uses[i].a, uses[i].b, {}});
    }
    roots_of_.push_back(uses[i].root);
    edges_of_[uses[i].root][uses[i].corner] = static_cast<std::uint32_t>(edges_.size() - 1);
  }
  first_root_.push_back(static_cast<std::uint32_t>(uses.size()));
}

/// Means over the triangles at a place, by area; points at one place have one normal.
void EmbeddedSurface::Keeper::make_normals() {
  const auto& places = surface_.points;
  std::vector<Vec3> sums(places.size(), Vec3::Zero());
  for (const auto& [a, b, c] : surface_.triangles) {
    const Vec3 normal = (places[b] - places[a]).cross(places[c] - places[a]);
    for (const std::uint32_t p : {a, b, c}) sums[p] += normal;
  }
  std::vector<std::uint32_t> order(places.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::uint32_t p, std::uint32_t q) {
    return is_below(places[p], places[q]) || (!is_below(places[q], places[p]) && p < q);
  });
  surface_.normals.assign(places.size(), Vec3::Zero());
  for (std::size_t i = 0, end = 0; i < order.size(); i = end) {
    Vec3 sum = Vec3::Zero();
    for (; end < order.size() && places[order[end]] == places[order[i]]; ++end) sum += sums[order[end]];
    const double length = sum.norm();
    for (std::size_t k = i; k < end; ++k) surface_.normals[order[k]] = length > 0 ? Vec3(sum / length) : Vec3::UnitZ();
  }
}

std::uint32_t EmbeddedSurface::Keeper::bind_all(const TetMesh& mesh, double most) {
  begin();
  std::vector<bool> is_used(points_.size(), false);
  for (const auto& triangle : surface_.triangles) {
    for (const std::uint32_t p : triangle) is_used[p] = true;
  }
  std::vector<double> distances(points_.size(), 0);
  for (std::uint32_t p = 0; p < points_.size(); ++p) {
    if (!is_used[p]) continue;
    Box box;
    box.extend(points_[p].rest);
    near_.gather(mesh, grid_, box, mean_edge_);
    const Binding binding = bind_to(mesh, near_.locate(points_[p].rest), points_[p].rest);
    distances[p] = binding.offset.norm();
    greatest_distance_ = std::max(greatest_distance_, distances[p]);
    if (greatest_distance_ > most * mean_edge_) return p;
  }
  reach_ = greatest_distance_ + kReachMargin * mean_edge_;
  for (const auto& [a, b, c] : surface_.triangles) {
    reaches_.push_back(std::max({distances[a], distances[b], distances[c]}) + kReachMargin * mean_edge_);
  }
  for (std::uint32_t root = 0; root < surface_.triangles.size(); ++root) queue(root);
  work_queue(mesh);
  end();
  return kInvalidIndex;
}

void EmbeddedSurface::Keeper::begin() {
  points_.begin();
  triangles_.begin();
  edges_.begin();
  roots_.begin();
  ++batch_;
  queue_.clear();
  has_changed_ = false;
}

EmbeddedSurface::Keeper::Record EmbeddedSurface::Keeper::end() {
  Record record;
  record.points = points_.end();
  record.triangles = triangles_.end();
  record.edges = edges_.end();
  record.roots = roots_.end();
  return record;
}

// ---- Following -----------------------------------------------------------------------------------------------------

bool EmbeddedSurface::Keeper::find_common(const Journal& journal, std::size_t& common) const {
  for (common = applied_ + 1; common-- > 0;) {
    const std::size_t position = common == 0 ? base_ : records_[common - 1].position;
    if (position > journal.position()) continue;
    if (position < journal.first()) return false;
    const std::uint64_t serial = common == 0 ? base_serial_ : records_[common - 1].serial;
    if (journal.serial_before(position) == serial) return true;
  }
  return false;
}

Status EmbeddedSurface::Keeper::no_way(const Journal& journal) const {
  return Error{ErrorCode::kBadArgument,
               "the journal stands at step " + std::to_string(journal.position()) + " and keeps those from " +
                   std::to_string(journal.first()) + " on: the surface, which stands at step " +
                   std::to_string(position()) + ", cannot get there; bind it anew",
               {journal.position(), journal.first(), position()}};
}

Status EmbeddedSurface::Keeper::follow(const Journal& journal, const TetMesh& mesh) {
  looked_at_ = 0;
  std::size_t common = 0;
  if (!find_common(journal, common)) return no_way(journal);
  std::vector<TetId> moved_back;  // the grid is set right by the mesh as it stands
  while (applied_ > common) {
    const auto& touched = records_[applied_ - 1].touched;
    moved_back.insert(moved_back.end(), touched.begin(), touched.end());
    go_back();
  }
  while (applied_ < records_.size() && records_[applied_].position <= journal.position() &&
         journal.serial_before(records_[applied_].position) == records_[applied_].serial) {
    const auto& touched = records_[applied_].touched;
    moved_back.insert(moved_back.end(), touched.begin(), touched.end());
    go_forward();
  }
  for (const TetId tet : moved_back) grid_.update(mesh, tet);
  if (position() < journal.position()) go_on(journal, mesh);
  close_changes();
  forget_trimmed(journal);
  return {};
}

void EmbeddedSurface::Keeper::note(const Record& record) {
  append_slots(record.points, next_changes_.points);
  append_slots(record.triangles, next_changes_.triangles);
}

void EmbeddedSurface::Keeper::close_changes() {
  if (next_changes_.points.empty() && next_changes_.triangles.empty()) return;
  next_changes_.from = changes_.to;
  next_changes_.to = changes_.to + 1;
  std::swap(changes_, next_changes_);
  next_changes_.points.clear();
  next_changes_.triangles.clear();
}

/// Takes all slots one step back or forth: `go(slots, changes)`.
template <class Go>
void EmbeddedSurface::Keeper::restore(Record& record, Go&& go) {
  note(record);
  go(points_, record.points);
  go(triangles_, record.triangles);
  go(edges_, record.edges);
  go(roots_, record.roots);
  std::swap(free_point_, record.free_point);
  std::swap(free_triangle_, record.free_triangle);
  ++version_;
}

void EmbeddedSurface::Keeper::go_back() {
  restore(records_[--applied_], [](auto& slots, auto& changes) { slots.undo(changes); });
}

void EmbeddedSurface::Keeper::go_forward() {
  restore(records_[applied_++], [](auto& slots, auto& changes) { slots.redo(changes); });
}

void EmbeddedSurface::Keeper::go_on(const Journal& journal, const TetMesh& mesh) {
  records_.resize(applied_);
  TouchedTets touched;
  for (std::size_t i = position(); i < journal.position(); ++i) visit(journal.step(i), touched, StepReading::kNet);
  for (const VertexId v : touched.moved_vertices) {
    if (!mesh.is_live(v)) continue;
    const auto& star = walker_.star(mesh, v);
    touched.tets.insert(touched.tets.end(), star.begin(), star.end());
  }
  std::sort(touched.tets.begin(), touched.tets.end());
  touched.tets.erase(std::unique(touched.tets.begin(), touched.tets.end()), touched.tets.end());
  begin();
  const std::uint32_t free_point = free_point_, free_triangle = free_triangle_;
  for (const TetId tet : touched.tets) {
    queue_near(grid_.box_of(tet));
    grid_.update(mesh, tet);
    queue_near(grid_.box_of(tet));
  }
  work_queue(mesh);
  Record record = end();
  note(record);
  record.free_point = free_point;
  record.free_triangle = free_triangle;
  record.position = journal.position();
  record.serial = journal.serial_before(journal.position());
  record.touched = std::move(touched.tets);
  records_.push_back(std::move(record));
  ++applied_;
}

void EmbeddedSurface::Keeper::forget_trimmed(const Journal& journal) {
  while (applied_ > 0 && records_.front().position <= journal.first()) {
    base_ = records_.front().position;
    base_serial_ = records_.front().serial;
    records_.pop_front();
    --applied_;
  }
}

// ---- Looking at triangles ------------------------------------------------------------------------------------------

void EmbeddedSurface::Keeper::queue_near(const Box& box) {
  if (box.is_empty()) return;
  const Vec3 margin = Vec3::Constant(reach_);
  tree_.for_each_overlap(Box{box.lo - margin, box.hi + margin}, [&](std::uint32_t root) {
    if (root_marks_[root] == batch_) return;
    const Box own = box_of(root);
    const Vec3 own_margin = Vec3::Constant(reaches_[root]);
    if (Box{own.lo - own_margin, own.hi + own_margin}.overlaps(box)) queue(root);
  });
}

Box EmbeddedSurface::Keeper::box_of(std::uint32_t root) const {
  Box box;
  for (const std::uint32_t p : surface_.triangles[root]) box.extend(surface_.points[p]);
  return box;
}

void EmbeddedSurface::Keeper::queue(std::uint32_t root) {
  if (root_marks_[root] == batch_) return;
  root_marks_[root] = batch_;
  queue_.push_back(root);
}

/// In the order of the roots, so that slots are taken in the same order however the boxes were met.
void EmbeddedSurface::Keeper::work_queue(const TetMesh& mesh) {
  mesh_ = &mesh;
  std::sort(queue_.begin(), queue_.end());
  for (std::size_t i = 0; i < queue_.size(); ++i) look_at(mesh, queue_[i]);
  looked_at_ = queue_.size();
  if (has_changed_) ++version_;
}

void EmbeddedSurface::Keeper::look_at(const TetMesh& mesh, std::uint32_t root) {
  near_.gather(mesh, grid_, box_of(root), reaches_[root]);
  for (const std::uint32_t p : surface_.triangles[root]) place_corner(mesh, p);
  for (const std::uint32_t edge : edges_of_[root]) part_edge(mesh, edge);
  rebuild_parts(root);
}

void EmbeddedSurface::Keeper::place_corner(const TetMesh& mesh, std::uint32_t point) {
  if (point_marks_[point] == batch_) return;
  point_marks_[point] = batch_;
  rebind(point, bind_to(mesh, near_.locate(points_[point].rest), points_[point].rest));
}

void EmbeddedSurface::Keeper::part_edge(const TetMesh& mesh, std::uint32_t edge) {
  if (edge_marks_[edge] == batch_) return;
  edge_marks_[edge] = batch_;
  const std::uint32_t a = edges_[edge].a, b = edges_[edge].b;
  for (const std::uint32_t p : {a, b}) place_corner(mesh, p);
  plan_edge(mesh, a, b);
  if (fits_plan(edges_[edge].chain)) return rebind_chain(edges_[edge].chain);
  free_chain(edges_[edge].chain);
  EdgeChain chain = make_chain(a, b);
  edges_.write(edge).chain = std::move(chain);
  for (std::uint32_t i = first_root_[edge]; i < first_root_[edge + 1]; ++i) queue(roots_of_[i]);
}

/// Into `plan_`: where walls part the edge, and between two of them a point that divides it.
void EmbeddedSurface::Keeper::plan_edge(const TetMesh& mesh, std::uint32_t from, std::uint32_t to) {
  plan_.clear();
  if (!near_.has_walls()) return;
  const FinePoint &a = points_[from], &b = points_[to];
  near_.find_crossings(mesh, a.rest, a.binding.tet, b.rest, b.binding.tet, crossings_);
  merge_close(mesh, a.rest, b.rest, crossings_);
  const auto at = [&](double t) -> Vec3 { return a.rest + t * (b.rest - a.rest); };
  for (std::size_t i = 0; i < crossings_.size(); ++i) {
    const WallCrossing& crossing = crossings_[i];
    double t = crossing.t;
    if (i == 0 && t < kSnapToEnd) t = 0;
    if (i + 1 == crossings_.size() && t > 1 - kSnapToEnd) t = 1;
    const Vec3 place = t < 1 ? at(t) : b.rest;
    plan_.push_back({t, bind_to(mesh, crossing.low, place), bind_to(mesh, crossing.high, place), true});
    if (i + 1 == crossings_.size()) break;
    const double middle = (crossing.t + crossings_[i + 1].t) / 2;
    const Binding binding = bind_to(mesh, near_.locate(at(middle)), at(middle));
    plan_.push_back({middle, binding, binding, false});
  }
}

bool EmbeddedSurface::Keeper::fits_plan(const EdgeChain& chain) const {
  return std::equal(
      chain.begin(), chain.end(), plan_.begin(), plan_.end(),
      [](const EdgePoint& p, const PlannedPoint& q) { return p.t == q.t && p.is_parted() == q.is_parted; });
}

/// At t = 0 and t = 1 the end itself is one of the two points.
EdgeChain EmbeddedSurface::Keeper::make_chain(std::uint32_t from, std::uint32_t to) {
  const std::vector<PlannedPoint> plan = plan_;
  EdgeChain chain;
  for (const PlannedPoint& planned : plan) {
    EdgePoint point;
    point.t = planned.t;
    point.low = planned.t == 0 ? from : take_point(between(from, to, planned.t, planned.low));
    point.high = !planned.is_parted ? point.low
                 : planned.t == 1   ? to
                                    : take_point(between(from, to, planned.t, planned.high));
    chain.push_back(point);
  }
  return chain;
}

void EmbeddedSurface::Keeper::rebind_chain(const EdgeChain& chain) {
  for (std::size_t i = 0; i < chain.size(); ++i) {
    if (chain[i].t > 0) rebind(chain[i].low, plan_[i].low);
    if (chain[i].t < 1 && chain[i].is_parted()) rebind(chain[i].high, plan_[i].high);
  }
}

/// The last one first, so that a chain which is made anew takes the slots that it had.
void EmbeddedSurface::Keeper::free_chain(const EdgeChain& chain) {
  for (std::size_t i = chain.size(); i-- > 0;) {
    if (chain[i].t < 1 && chain[i].is_parted()) free_point(chain[i].high);
    if (chain[i].t > 0) free_point(chain[i].low);
  }
}

void EmbeddedSurface::Keeper::rebuild_parts(std::uint32_t root) {
  DividedTriangle triangle{surface_.triangles[root], {}};
  bool is_whole = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const Edge& edge = edges_[edges_of_[root][i]];
    if (edge.chain.empty()) continue;
    is_whole = false;
    triangle.chains[i] = edge.a == triangle.points[i] ? edge.chain : reversed(edge.chain);
  }
  if (is_whole && triangles_[root].next == kInvalidIndex && triangles_[root].points == triangle.points) return;
  const std::vector<std::uint32_t> old_points = roots_[root].own_points;
  for (std::size_t i = old_points.size(); i-- > 0;) free_point(old_points[i]);
  parts_.clear();
  new_points_.clear();
  divide_triangle(triangle, *this, parts_);
  if (parts_.empty()) {
    parts_.emplace_back();
    parts_.back().points = {triangle.points[0], triangle.points[0], triangle.points[0]};
  }
  if (new_points_ != old_points) roots_.write(root).own_points = new_points_;
  replace_parts(root);
}

void EmbeddedSurface::Keeper::replace_parts(std::uint32_t root) {
  std::vector<std::uint32_t> slots;
  for (std::uint32_t slot = root; slot != kInvalidIndex; slot = triangles_[slot].next) slots.push_back(slot);
  for (FineTriangle& part : parts_) part.root = root;
  if (std::equal(parts_.begin(), parts_.end(), slots.begin(), slots.end(),
                 [&](const FineTriangle& part, std::uint32_t slot) { return part == triangles_[slot]; })) {
    return;
  }
  has_changed_ = true;
  for (std::size_t i = slots.size(); i-- > 1;) {
    FineTriangle& triangle = triangles_.write(slots[i]);
    triangle = {};
    triangle.next = free_triangle_;
    free_triangle_ = slots[i];
  }
  std::uint32_t next = kInvalidIndex;
  std::vector<std::uint32_t> taken(parts_.size(), root);
  for (std::size_t i = 1; i < parts_.size(); ++i) taken[i] = take_triangle(parts_[i]);
  for (std::size_t i = parts_.size(); i-- > 0;) {
    parts_[i].next = next;
    triangles_.write(taken[i]) = parts_[i];
    next = taken[i];
  }
}

EdgeChain EmbeddedSurface::Keeper::divide(std::uint32_t from, std::uint32_t to) {
  plan_edge(*mesh_, from, to);
  EdgeChain chain = make_chain(from, to);
  for (const EdgePoint& point : chain) {
    if (point.t > 0) new_points_.push_back(point.low);
    if (point.t < 1 && point.is_parted()) new_points_.push_back(point.high);
  }
  return chain;
}

std::array<std::uint32_t, 3> EmbeddedSurface::Keeper::copy_to_middle(const std::array<std::uint32_t, 3>& points) {
  Vec3 middle = Vec3::Zero();
  for (const std::uint32_t p : points) middle += points_[p].rest / 3;
  const TetId tet = near_.locate(middle);
  std::array<std::uint32_t, 3> copies{};
  for (std::size_t i = 0; i < 3; ++i) {
    FinePoint copy = points_[points[i]];
    copy.binding = bind_to(*mesh_, tet, copy.rest);
    copies[i] = take_point(copy);
    new_points_.push_back(copies[i]);
  }
  return copies;
}

// ---- Slots ---------------------------------------------------------------------------------------------------------

FinePoint EmbeddedSurface::Keeper::between(std::uint32_t from, std::uint32_t to, double t,
                                           const Binding& binding) const {
  const FinePoint &a = points_[from], &b = points_[to];
  FinePoint point;
  point.rest = t < 1 ? Vec3(a.rest + t * (b.rest - a.rest)) : b.rest;
  point.binding = binding;
  for (std::size_t k = 0; k < 2; ++k) point.texture[k] = a.texture[k] + t * (b.texture[k] - a.texture[k]);
  const Vec3 normal = a.normal + t * (b.normal - a.normal);
  const double length = normal.norm();
  point.normal = length > 0 ? Vec3(normal / length) : a.normal;
  return point;
}

std::uint32_t EmbeddedSurface::Keeper::take_point(const FinePoint& point) {
  if (free_point_ == kInvalidIndex) return points_.append(point);
  const std::uint32_t slot = free_point_;
  free_point_ = points_[slot].next_free;
  points_.write(slot) = point;
  return slot;
}

void EmbeddedSurface::Keeper::free_point(std::uint32_t slot) {
  FinePoint& point = points_.write(slot);
  point.binding = {};
  point.next_free = free_point_;
  free_point_ = slot;
}

void EmbeddedSurface::Keeper::rebind(std::uint32_t slot, const Binding& binding) {
  if (!(points_[slot].binding == binding)) points_.write(slot).binding = binding;
}

std::uint32_t EmbeddedSurface::Keeper::take_triangle(const FineTriangle& triangle) {
  if (free_triangle_ == kInvalidIndex) return triangles_.append(triangle);
  const std::uint32_t slot = free_triangle_;
  free_triangle_ = triangles_[slot].next;
  triangles_.write(slot) = triangle;
  return slot;
}

}  // namespace v0
}  // namespace incise
