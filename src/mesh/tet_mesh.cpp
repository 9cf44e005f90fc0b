// SPDX-License-Identifier: Apache-2.0
// Building from a soup, pass by pass: sizes, orientation, links by buckets of faces, walls of earlier cuts, then the
// shape bits of vertices (docs/internals.md, 1).
#include "incise/mesh/tet_mesh.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <string>
#include <tuple>
#include <utility>

#include "incise/core/hash.h"
#include "incise/geom/predicates.h"
#include "incise/geom/quality.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/star.h"
#include "mesh/constants.h"

namespace incise {
inline namespace v0 {

namespace {

/// Vertex slots of one face in ascending order.
struct FaceKey {
  std::uint32_t low, middle, high;
  bool operator<(const FaceKey& other) const {
    return std::tie(low, middle, high) < std::tie(other.low, other.middle, other.high);
  }
};

FaceKey key_of(const std::array<VertexId, 3>& face) {
  std::uint32_t a = face[0].value, b = face[1].value, c = face[2].value;
  if (a > b) std::swap(a, b);
  if (b > c) std::swap(b, c);
  if (a > b) std::swap(a, b);
  return {a, b, c};
}

std::uint64_t edge_key(VertexId a, VertexId b) {
  const auto [low, high] = std::minmax(a.value, b.value);
  return (std::uint64_t{low} << 32U) | high;
}

Error bad_tet(std::size_t tet, const std::string& what) {
  return {ErrorCode::kBadArgument, "tet " + std::to_string(tet) + " " + what, {tet}};
}

Error bad_wall(std::size_t wall, const std::string& what) {
  return {ErrorCode::kBadArgument, "wall " + std::to_string(wall) + " " + what, {wall}};
}

/// Whether what a soup says of earlier cuts fits its points.
Status check_cuts(const TetSoup& soup) {
  const std::size_t n = soup.points.size();
  if ((!soup.origins.empty() && soup.origins.size() != n) || (!soup.fronts.empty() && soup.fronts.size() != n)) {
    return Error{ErrorCode::kBadArgument, "the number of origins or fronts differs from the number of points", {}};
  }
  for (std::size_t i = 0; i < soup.walls.size(); ++i) {
    const SoupWall& wall = soup.walls[i];
    const std::uint32_t last = *std::max_element(wall.points.begin(), wall.points.end());
    if (last >= n) return bad_wall(i, "refers to point " + std::to_string(last) + ", which does not exist");
    if (wall.stroke == 0 || wall.stroke > TetMesh::kMaxStroke) {
      return bad_wall(i, "is of stroke " + std::to_string(wall.stroke) + "; strokes are numbered 1 to 2^30");
    }
  }
  return {};
}

/// One face that walls claim, and the boundary sides that are there.
struct ClaimedFace {
  FaceKey key;
  std::uint32_t stroke;  // 0: walls of several strokes claim it
  std::uint32_t sides = 0;
  Side side = {};
  bool operator<(const ClaimedFace& other) const { return key < other.key; }
};

std::vector<ClaimedFace> claimed_faces(const std::vector<SoupWall>& walls) {
  std::vector<ClaimedFace> faces;
  faces.reserve(walls.size());
  for (const SoupWall& wall : walls) {
    const auto& [a, b, c] = wall.points;
    faces.push_back({key_of({VertexId(a), VertexId(b), VertexId(c)}), wall.stroke});
  }
  std::sort(faces.begin(), faces.end());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (kept == 0 || faces[kept - 1] < faces[i]) {
      faces[kept++] = faces[i];
    } else if (faces[kept - 1].stroke != faces[i].stroke) {
      faces[kept - 1].stroke = 0;
    }
  }
  faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(kept), faces.end());
  return faces;
}

/// Three digits are enough to tell a unit by.
std::string in_short(double length) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", length);
  return text.data();
}

Error bad_extent(const std::string& what) {
  return {ErrorCode::kBadArgument,
          what + ": lengths between " + in_short(kLeastExtent) + " and " + in_short(kGreatestExtent) +
              " can be computed with; rescale mesh and blade to another unit",
          {}};
}

}  // namespace

void TetMesh::set_current(std::span<const Vec3> positions) {
  assert(positions.size() == vertex_slots());
  for (std::uint32_t slot = 0; slot < vertex_slots(); ++slot) {
    if (is_live(VertexId(slot))) {
      current_[VertexId(slot)] = positions[slot];
    }
  }
}

double TetMesh::rest_volume6(TetId tet) const {
  const TetVertices& v = tet_vertices_[tet];
  const Vec3& a = rest_[v[0]];
  return (rest_[v[1]] - a).cross(rest_[v[2]] - a).dot(rest_[v[3]] - a);
}

Result<TetMesh> TetMesh::build(TetSoup soup) {
  TetMesh mesh;
  if (Status status = check_cuts(soup); !status) {
    return status.error();
  }
  if (Status status = mesh.take_points(soup); !status) {
    return status.error();
  }
  std::vector<Vec3>().swap(soup.points);
  if (Status status = mesh.take_tets(soup); !status) {
    return status.error();
  }
  decltype(soup.tets)().swap(soup.tets);
  decltype(soup.regions)().swap(soup.regions);
  if (Status status = mesh.check_extent(); !status) {
    return status.error();
  }
  if (Status status = mesh.check_orientation(); !status) {
    return status.error();
  }
  mesh.link_faces();
  mesh.tag_walls(soup.walls);
  mesh.find_loose_edges();
  mesh.mark_shapes();
  mesh.mark_fronts(soup);
  mesh.find_folds();
  return mesh;
}

Status TetMesh::take_points(const TetSoup& soup) {
  const std::size_t count = soup.points.size();
  if (count >= kMaxTets) {
    return Error{ErrorCode::kOutOfMemory, "more than 2^28 points", {}};
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3& p = soup.points[i];
    if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z())) {
      return Error{ErrorCode::kBadArgument, "point " + std::to_string(i) + " is not finite", {i}};
    }
    rest_.push_back(p);
    if (soup.origins.empty()) {
      vertex_origin_.push_back(VertexId(static_cast<std::uint32_t>(i)));
    } else {
      vertex_origin_.push_back(soup.origins[i] < 0 ? VertexId()
                                                   : VertexId(static_cast<std::uint32_t>(soup.origins[i])));
    }
  }
  current_ = rest_;
  vertex_tet_.resize(count);
  vertex_generation_.resize(count, 0);
  vertex_shape_.resize(count, 0);
  live_vertices_ = count;
  return {};
}

Status TetMesh::take_tets(const TetSoup& soup) {
  const std::size_t count = soup.tets.size();
  if (count >= kMaxTets) {
    return Error{ErrorCode::kOutOfMemory, "more than 2^28 tets", {}};
  }
  if (!soup.regions.empty() && soup.regions.size() != count) {
    return Error{ErrorCode::kBadArgument, "the number of regions differs from the number of tets", {}};
  }
  for (std::size_t t = 0; t < count; ++t) {
    const TetId id(static_cast<std::uint32_t>(t));
    TetVertices corners;
    for (unsigned c = 0; c < 4; ++c) {
      const std::uint32_t point = soup.tets[t][c];
      if (point >= vertex_slots()) {
        return bad_tet(t, "refers to point " + std::to_string(point) + ", which does not exist");
      }
      corners[c] = VertexId(point);
      vertex_tet_[corners[c]] = id;
    }
    if (corners[0] == corners[1] || corners[0] == corners[2] || corners[0] == corners[3] || corners[1] == corners[2] ||
        corners[1] == corners[3] || corners[2] == corners[3]) {
      return bad_tet(t, "names a point twice");
    }
    tet_vertices_.push_back(corners);
    tet_region_.push_back(soup.regions.empty() ? 0 : soup.regions[t]);
    has_regions_ |= tet_region_.back() != tet_region_[TetId(0)];
  }
  tet_links_.resize(count);
  tet_generation_.resize(count, 0);
  live_tets_ = count;
  for_each_tet([&](TetId id) {
    const TetVertices& v = tet_vertices_[id];
    if (is_flat(rest_[v[0]], rest_[v[1]], rest_[v[2]], rest_[v[3]])) {
      flat_at_load_.push_back(id);
    }
  });
  return {};
}

Status TetMesh::check_extent() const {
  const Box box = rest_bounds(*this);
  if (box.is_empty()) {
    return {};
  }
  const double extent = (box.hi - box.lo).maxCoeff();
  const double farthest = box.lo.cwiseAbs().cwiseMax(box.hi.cwiseAbs()).maxCoeff();
  if (!(farthest <= kGreatestExtent)) {
    return bad_extent("the mesh reaches to a coordinate of " + in_short(farthest));
  }
  if (extent > 0 && !(extent >= kLeastExtent)) {
    return bad_extent("the mesh extends over " + in_short(extent) + " only");
  }
  return {};
}

Status TetMesh::check_orientation() const {
  for (std::uint32_t slot = 0; slot < tet_slots(); ++slot) {
    const TetVertices& v = tet_vertices_[TetId(slot)];
    if (orient3d(rest_[v[0]], rest_[v[1]], rest_[v[2]], rest_[v[3]]) < 0) {
      return bad_tet(slot,
                     "is inverted: its volume is negative; exchange two of its corners, or let normalise() "
                     "turn all such tets before the mesh is built");
    }
  }
  return {};
}

/// Pairs the faces by bucket of their lowest vertex: one pass to count, one to fill, one to match.
void TetMesh::link_faces() {
  std::vector<std::uint32_t> start(vertex_slots() + std::size_t{1}, 0);
  for_each_tet([&](TetId id) {
    for (unsigned s = 0; s < 4; ++s) {
      ++start[key_of(vertices(Side(id, s))).low + std::size_t{1}];
    }
  });
  for (std::size_t v = 1; v < start.size(); ++v) {
    start[v] += start[v - 1];
  }
  std::vector<Side> bucket(start.back());
  for_each_tet([&](TetId id) {
    for (unsigned s = 0; s < 4; ++s) {
      const Side side(id, s);
      bucket[start[key_of(vertices(side)).low]++] = side;
    }
  });
  struct Entry {
    std::uint64_t key;
    Side side;
    bool operator<(const Entry& other) const { return key != other.key ? key < other.key : side < other.side; }
  };
  std::vector<Entry> faces;
  for (std::size_t begin = 0, v = 0; v < vertex_slots(); begin = start[v++]) {
    faces.clear();
    for (std::size_t i = begin; i < start[v]; ++i) {
      const FaceKey key = key_of(vertices(bucket[i]));
      faces.push_back({(std::uint64_t{key.middle} << 32U) | key.high, bucket[i]});
    }
    std::sort(faces.begin(), faces.end());
    for (std::size_t i = 0; i < faces.size();) {
      std::size_t next = i + 1;
      while (next < faces.size() && faces[next].key == faces[i].key) {
        ++next;
      }
      // More than two tets on a face are a defect of the input; all its sides stay boundary.
      if (next - i > 2) {
        const auto face = vertices(faces[i].side);
        for (unsigned k = 0; k < 3; ++k) {
          overshared_edges_.push_back(edge_key(face[k], face[(k + 1) % 3]));
        }
      }
      if (next - i == 2) {
        const Side a = faces[i].side, b = faces[i + 1].side;
        tet_links_[a.tet()][a.side()] = Link(b);
        tet_links_[b.tet()][b.side()] = Link(a);
      }
      i = next;
    }
  }
}

void TetMesh::tag_walls(const std::vector<SoupWall>& walls) {
  if (walls.empty()) {
    return;
  }
  std::vector<ClaimedFace> faces = claimed_faces(walls);
  for_each_tet([&](TetId id) {
    for (unsigned s = 0; s < 4; ++s) {
      if (!tet_links_[id][s].is_boundary()) continue;
      const ClaimedFace wanted{key_of(vertices(Side(id, s))), 0};
      const auto face = std::lower_bound(faces.begin(), faces.end(), wanted);
      if (face == faces.end() || wanted < *face) continue;
      ++face->sides;
      face->side = Side(id, s);
    }
  });
  for (const ClaimedFace& face : faces) {
    if (face.sides == 1) tet_links_[face.side.tet()][face.side.side()] = Link::boundary(face.stroke);
  }
}

bool TetMesh::is_flat_at_load(TetId tet) const {
  if (!std::binary_search(flat_at_load_.begin(), flat_at_load_.end(), tet)) {
    return false;
  }
  const TetVertices& v = tet_vertices_[tet];  // maintenance may have given the slot to a sound tet
  return is_flat(rest_[v[0]], rest_[v[1]], rest_[v[2]], rest_[v[3]]);
}

bool TetMesh::is_overshared_at_load(VertexId a, VertexId b) const {
  return std::binary_search(overshared_edges_.begin(), overshared_edges_.end(), edge_key(a, b));
}

void TetMesh::mark_shapes() {
  std::vector<std::uint32_t> incident(vertex_slots(), 0);
  std::vector<std::uint8_t> surfaces(vertex_slots(), 0);
  for_each_tet([&](TetId id) {
    for (unsigned s = 0; s < 4; ++s) {
      ++incident[tet_vertices_[id][s].value];
      const Link link = tet_links_[id][s];
      if (link.is_boundary()) {
        for (const VertexId v : vertices(Side(id, s))) {
          surfaces[v.value] |= link.tag() == 0 ? shape::kSkin : shape::kWall;
        }
      }
    }
  });
  StarWalker walker;
  for (std::uint32_t slot = 0; slot < vertex_slots(); ++slot) {
    const VertexId v(slot);
    // A vertex inside has one closed star, unless the input's parts overlap.
    if (surfaces[slot] == 0 && !touched_itself_at_load_) {
      continue;
    }
    vertex_shape_[v] = surfaces[slot];
    if (walker.star(*this, v).size() != incident[slot]) {
      vertex_shape_[v] |= shape::kPinched;
      touched_itself_at_load_ = true;
    }
  }
}

/// Whether the lips of a cut meet at the edge of a wall between its corners `corner` and `corner` + 1: the next
/// boundary face around the edge is a wall that lies on this one, and the body is all around the edge instead of a thin
/// wedge between the two.
bool TetMesh::is_front_edge(Side wall, unsigned corner) const {
  const auto face = vertices(wall);
  const VertexId a = face[corner], b = face[(corner + 1) % 3], c = face[(corner + 2) % 3];
  const Vec3 along = rest_[b] - rest_[a];
  // Into the wall, square to the edge; of any length.
  const Vec3 inwards = along.dot(along) * (rest_[c] - rest_[a]) - along.dot(rest_[c] - rest_[a]) * along;
  bool is_all_around = false;
  Side at = wall;
  while (true) {  // the side of the same tet that shares the edge, then the neighbour behind it
    const TetId tet = at.tet();
    unsigned out = 0;
    while (out == at.side() || tet_vertices_[tet][out] == a || tet_vertices_[tet][out] == b) ++out;
    const Vec3 behind = rest_[tet_vertices_[tet][at.side()]] - rest_[a];
    is_all_around |= behind.dot(inwards) < 0;
    at = Side(tet, out);
    if (link(at).is_boundary()) break;
    at = link(at).side();
  }
  if (link(at).tag() == 0 || !is_all_around) {
    return false;
  }
  const auto other = vertices(at);
  const Vec3 n = along.cross(rest_[c] - rest_[a]);
  const Vec3 m = (rest_[other[1]] - rest_[other[0]]).cross(rest_[other[2]] - rest_[other[0]]);
  return n.dot(m) < -kFolded * (n.norm() * m.norm());
}

void TetMesh::mark_fronts(const TetSoup& soup) {
  for (std::uint32_t slot = 0; slot < soup.fronts.size(); ++slot) {
    if (soup.fronts[slot] != 0) vertex_shape_[VertexId(slot)] |= shape::kFront;
  }
  if (soup.walls.empty() || !soup.fronts.empty()) {
    return;
  }
  for_each_tet([&](TetId id) {
    for (unsigned s = 0; s < 4; ++s) {
      const Side side(id, s);
      if (!link(side).is_boundary() || link(side).tag() == 0) continue;
      for (unsigned k = 0; k < 3; ++k) {
        if (!is_front_edge(side, k)) continue;
        vertex_shape_[vertices(side)[k]] |= shape::kFront;
        vertex_shape_[vertices(side)[(k + 1) % 3]] |= shape::kFront;
      }
    }
  });
}

/// Two tets on one side of the face between them overlap: they see its vertices turn the same way.
bool TetMesh::is_folded(Side side) const {
  const Link link = this->link(side);
  if (link.is_boundary()) {
    return false;
  }
  const auto face = vertices(side), other = vertices(link.side());
  const auto first = static_cast<std::size_t>(std::find(other.begin(), other.end(), face[0]) - other.begin());
  return other[(first + 1) % 3] == face[1];
}

void TetMesh::find_folds() {
  for_each_tet([&](TetId id) {
    for (unsigned s = 0; s < 4 && !folds_over_at_load_; ++s) {
      folds_over_at_load_ = is_folded({id, s});
    }
  });
}

void TetMesh::find_loose_edges() {
  std::sort(overshared_edges_.begin(), overshared_edges_.end());
  touched_itself_at_load_ = !overshared_edges_.empty();
  std::vector<std::uint64_t> edges;
  for_each_tet([&](TetId id) {
    for (unsigned s = 0; s < 4; ++s) {
      if (tet_links_[id][s].is_boundary()) {
        const auto face = vertices(Side(id, s));
        for (unsigned k = 0; k < 3; ++k) {
          edges.push_back(edge_key(face[k], face[(k + 1) % 3]));
        }
      }
    }
  });
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 2; i < edges.size() && !touched_itself_at_load_; ++i) {
    touched_itself_at_load_ = edges[i] == edges[i - 2];
  }
}

std::uint64_t TetMesh::hash() const {
  StateHash hash;
  const auto pair = [](std::uint32_t a, std::uint32_t b) { return (std::uint64_t{a} << 32U) | b; };
  hash.add(pair(tet_slots(), vertex_slots()));
  for_each_tet([&](TetId id) {
    const TetVertices& v = tet_vertices_[id];
    const TetLinks& n = tet_links_[id];
    hash.add(pair(id.value, static_cast<std::uint32_t>(tet_region_[id])));
    hash.add(pair(v[0].value, v[1].value));
    hash.add(pair(v[2].value, v[3].value));
    hash.add(pair(n[0].value, n[1].value));
    hash.add(pair(n[2].value, n[3].value));
  });
  for_each_vertex([&](VertexId id) {
    hash.add(pair(id.value, vertex_tet_[id].value));
    hash.add(pair(vertex_origin_[id].value, vertex_shape_[id]));
    for (int axis = 0; axis < 3; ++axis) {
      hash.add(rest_[id][axis]);
    }
  });
  for (const std::uint32_t slot : free_tets_) hash.add(std::uint64_t{slot});
  for (const std::uint32_t slot : free_vertices_) hash.add(std::uint64_t{slot});
  return hash.value();
}

MeshArrays TetMesh::arrays() const {
  const auto span_of = [](const auto& array) { return std::span(array.data(), array.size()); };
  return {span_of(tet_vertices_), span_of(tet_links_), span_of(tet_region_),    span_of(tet_generation_),
          span_of(rest_),         span_of(current_),   span_of(vertex_origin_), span_of(vertex_generation_),
          span_of(vertex_shape_)};
}

bool TetMesh::has_stable_addresses() const {
  return tet_vertices_.has_stable_address() && tet_links_.has_stable_address() && tet_region_.has_stable_address() &&
         tet_generation_.has_stable_address() && rest_.has_stable_address() && current_.has_stable_address() &&
         vertex_origin_.has_stable_address() && vertex_generation_.has_stable_address() &&
         vertex_shape_.has_stable_address();
}

std::size_t TetMesh::memory_bytes() const {
  const std::size_t per_tet = sizeof(TetVertices) + sizeof(TetLinks) + sizeof(std::int32_t) + sizeof(std::uint32_t);
  const std::size_t per_vertex = 2 * sizeof(Vec3) + sizeof(TetId) + sizeof(VertexId) + sizeof(std::uint32_t) + 1;
  return tet_slots() * per_tet + vertex_slots() * per_vertex +
         (free_tets_.size() + free_vertices_.size()) * sizeof(std::uint32_t);
}

}  // namespace v0
}  // namespace incise
