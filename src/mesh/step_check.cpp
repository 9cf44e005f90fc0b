// SPDX-License-Identifier: Apache-2.0
// What a step touched is collected with marks, each tet and vertex once; tets are asked for their links, vertices for
// their stars and the faces around them.
#include "incise/mesh/step_check.h"

#include <algorithm>
#include <string>

#include "incise/geom/predicates.h"
#include "incise/mesh/validate.h"

namespace incise {
inline namespace v0 {

namespace {

Error broken(ViolationKind kind, const std::string& element, std::uint32_t slot) {
  return {ErrorCode::kInternal,
          "the mesh would have been left broken (" + std::string(name_of(kind)) + " at " + element + " " +
              std::to_string(slot) + "); the step was taken back: please report it, with the mesh and the blade",
          {slot}};
}
Error broken(ViolationKind kind, TetId tet) {
  return broken(kind, "tet", tet.value);
}
Error broken(ViolationKind kind, VertexId vertex) {
  return broken(kind, "vertex", vertex.value);
}

bool is_positive(const TetMesh& mesh, TetId tet) {
  const TetVertices& v = mesh.vertices(tet);
  return orient3d(mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3])) > 0 || mesh.is_flat_at_load(tet);
}

bool has_corners(const TetMesh& mesh, TetId tet) {
  const TetVertices& corners = mesh.vertices(tet);
  for (unsigned c = 0; c < 4; ++c) {
    if (!mesh.is_live(corners[c]) || mesh.corner_of(tet, corners[c]) != c) return false;
  }
  return true;
}

/// Whether a neighbour names the side back, and sees the same three vertices.
bool is_returned(const TetMesh& mesh, Side side) {
  const Link link = mesh.link(side);
  if (link.is_boundary()) return true;
  const TetId other = link.side().tet();
  if (!mesh.is_live(other) || other == side.tet() || mesh.link(link.side()) != Link(side)) return false;
  const auto face = mesh.vertices(side), behind = mesh.vertices(link.side());
  return std::all_of(face.begin(), face.end(),
                     [&](VertexId v) { return std::find(behind.begin(), behind.end(), v) != behind.end(); });
}

/// Whether each entry of a sorted list is there exactly `times` times.
template <class T>
bool is_each_there(const std::vector<T>& sorted, std::size_t times) {
  for (std::size_t first = 0, end = 0; first < sorted.size(); first = end) {
    while (end < sorted.size() && sorted[end] == sorted[first]) ++end;
    if (end - first != times) return false;
  }
  return true;
}

}  // namespace

Status TouchedCheck::operator()(const TetMesh& mesh, const Journal& journal, std::size_t first_step) {
  collect(mesh, journal, first_step);
  Status status;
  for (std::size_t i = 0; i < tets_.size() && status.ok(); ++i) status = check_tet(mesh, tets_[i]);
  if (status) status = check_corners(mesh);
  if (status) status = check_moved(mesh, journal, first_step);
  forget();
  return status;
}

void TouchedCheck::collect(const TetMesh& mesh, const Journal& journal, std::size_t first_step) {
  has_tet_.ensure(mesh.tet_slots());
  has_vertex_.ensure(mesh.vertex_slots());
  for (std::size_t i = first_step; i < journal.position(); ++i) {
    const Step& step = journal.step(i);
    step.for_each_tet_before([&](TetId tet) { add(mesh, tet); });
    for (std::size_t k = 0; k < step.consumed.size(); ++k) {
      if (!mesh.is_live(step.consumed[k].id)) add_neighbours(mesh, step.gone[k]);
    }
    for (const TetId tet : step.new_tets) add(mesh, tet);
    step.for_each_vertex_before([&](VertexId vertex) { add(mesh, vertex); });
    for (const VertexId vertex : step.new_vertices) add(mesh, vertex);
  }
}

/// Those of a tet that is gone name others now.
void TouchedCheck::add_neighbours(const TetMesh& mesh, const GoneTet& gone) {
  for (const Link link : gone.links) {
    if (!link.is_boundary()) add(mesh, link.side().tet());
  }
}

void TouchedCheck::add(const TetMesh& mesh, TetId tet) {
  if (!mesh.is_live(tet) || has_tet_[tet.value] != 0) return;
  has_tet_[tet.value] = 1;
  tets_.push_back(tet);
}

void TouchedCheck::add(const TetMesh& mesh, VertexId vertex) {
  if (!mesh.is_live(vertex) || has_vertex_[vertex.value] != 0) return;
  has_vertex_[vertex.value] = 1;
  vertices_.push_back(vertex);
}

void TouchedCheck::forget() {
  for (const TetId tet : tets_) has_tet_[tet.value] = 0;
  for (const VertexId vertex : vertices_) has_vertex_[vertex.value] = 0;
  tets_.clear();
  vertices_.clear();
  corners_.clear();
}

Status TouchedCheck::check_tet(const TetMesh& mesh, TetId tet) {
  if (!has_corners(mesh, tet)) return broken(ViolationKind::kBadCorner, tet);
  for (unsigned s = 0; s < 4; ++s) {
    if (!is_returned(mesh, Side(tet, s))) return broken(ViolationKind::kBadLink, tet);
  }
  if (!is_positive(mesh, tet)) return broken(ViolationKind::kNotPositive, tet);
  return {};
}

Status TouchedCheck::check_corners(const TetMesh& mesh) {
  for (const TetId tet : tets_) {
    for (const VertexId vertex : mesh.vertices(tet)) {
      add(mesh, vertex);
      corners_.push_back({vertex, tet});
    }
  }
  std::sort(vertices_.begin(), vertices_.end());
  std::sort(corners_.begin(), corners_.end(), [](const Corner& a, const Corner& b) { return a.vertex < b.vertex; });
  std::span<const Corner> rest = corners_;
  for (const VertexId vertex : vertices_) {
    const auto end =
        std::find_if(rest.begin(), rest.end(), [&](const Corner& corner) { return corner.vertex != vertex; });
    const auto count = static_cast<std::size_t>(end - rest.begin());
    if (Status status = check_vertex(mesh, vertex, rest.first(count)); !status) return status;
    rest = rest.subspan(count);
  }
  return {};
}

/// `corners`: where touched tets have the vertex. All of them must be in its star, which is walked from one tet.
Status TouchedCheck::check_vertex(const TetMesh& mesh, VertexId vertex, std::span<const Corner> corners) {
  if (!mesh.rest(vertex).allFinite() || !mesh.current(vertex).allFinite()) {
    return broken(ViolationKind::kNotFinite, vertex);
  }
  const TetId tet = mesh.tet_of(vertex);
  if (!tet.is_valid() && corners.empty()) return broken(ViolationKind::kOrphanVertex, vertex);
  if (!mesh.is_live(tet) || mesh.corner_of(tet, vertex) == 4) return broken(ViolationKind::kBadTetOf, vertex);
  if (mesh.touched_itself_at_load()) return {};
  const std::vector<TetId>& star = walker_.star(mesh, vertex);
  const bool is_whole =
      std::all_of(corners.begin(), corners.end(), [&](const Corner& corner) { return walker_.is_seen(corner.tet); });
  if (!is_whole) return broken(ViolationKind::kSingletonCutVertex, vertex);
  return check_star(mesh, vertex, star);
}

Status TouchedCheck::check_star(const TetMesh& mesh, VertexId vertex, const std::vector<TetId>& star) {
  ends_.clear();
  faces_.clear();
  for (const TetId tet : star) {
    const unsigned corner = mesh.corner_of(tet, vertex);
    for (unsigned s = 0; s < 4; ++s) {
      if (s == corner) continue;
      const Side side(tet, s);
      const Link link = mesh.link(side);
      if (!link.is_boundary() && link.side() < side) continue;  // the face is seen from there
      std::array<VertexId, 2> others;
      std::size_t count = 0;
      for (const VertexId v : mesh.vertices(side)) {
        if (v != vertex) others[count++] = v;
      }
      if (link.is_boundary()) ends_.insert(ends_.end(), others.begin(), others.end());
      if (others[1] < others[0]) std::swap(others[0], others[1]);
      if (vertex < others[0]) faces_.push_back(others);
    }
  }
  std::sort(ends_.begin(), ends_.end());
  std::sort(faces_.begin(), faces_.end());
  if (!is_each_there(faces_, 1)) return broken(ViolationKind::kUnseparatedFace, vertex);
  if (!is_each_there(ends_, 2)) return broken(ViolationKind::kNonmanifoldCutEdge, vertex);
  return {};
}

Status TouchedCheck::check_moved(const TetMesh& mesh, const Journal& journal, std::size_t first_step) {
  for (std::size_t i = first_step; i < journal.position(); ++i) {
    for (const MovedVertex& moved : journal.step(i).moved) {
      if (!mesh.is_live(moved.id)) continue;
      for (const TetId tet : walker_.star(mesh, moved.id)) {
        if (!is_positive(mesh, tet)) return broken(ViolationKind::kNotPositive, tet);
      }
    }
  }
  return {};
}

StepCheck default_step_check() {
#ifdef NDEBUG
  return {};
#else
  return TouchedCheck();
#endif
}

}  // namespace v0
}  // namespace incise
