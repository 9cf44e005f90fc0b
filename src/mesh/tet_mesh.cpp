// SPDX-License-Identifier: Apache-2.0
#include "incise/mesh/tet_mesh.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "incise/core/hash.h"
#include "incise/geom/quality.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/star.h"

namespace incise::inline v0 {

namespace {

/// Vertex slots of one face in ascending order.
struct FaceKey {
  std::uint32_t low, middle, high;
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

/// Three digits are enough to tell a unit by.
std::string in_short(double length) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", length);
  return text.data();
}

Error bad_extent(const std::string& what) {
  return {ErrorCode::kBadArgument,
          what + ": lengths between " + in_short(kLeastExtent) + " and " + in_short(kGreatestExtent) +
              " can be computed with; rescale the mesh, and what shall cut it, to another unit",
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
  if (Status status = mesh.take_points(soup); !status) {
    return status.error();
  }
  std::vector<Vec3>().swap(soup.points);
  if (Status status = mesh.take_tets(soup); !status) {
    return status.error();
  }
  soup = {};
  if (Status status = mesh.check_extent(); !status) {
    return status.error();
  }
  mesh.link_faces();
  mesh.find_loose_edges();
  mesh.mark_shapes();
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
    vertex_origin_.push_back(VertexId(static_cast<std::uint32_t>(i)));
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
  std::vector<bool> is_skin(vertex_slots(), false);
  for_each_tet([&](TetId id) {
    for (unsigned s = 0; s < 4; ++s) {
      ++incident[tet_vertices_[id][s].value];
      if (tet_links_[id][s].is_boundary()) {
        for (const VertexId v : vertices(Side(id, s))) {
          is_skin[v.value] = true;
        }
      }
    }
  });
  StarWalker walker;
  for (std::uint32_t slot = 0; slot < vertex_slots(); ++slot) {
    const VertexId v(slot);
    // A vertex inside has one closed star, unless the input's parts overlap.
    if (!is_skin[slot] && !touched_itself_at_load_) {
      continue;
    }
    vertex_shape_[v] = is_skin[slot] ? shape::kSkin : 0;
    if (walker.star(*this, v).size() != incident[slot]) {
      vertex_shape_[v] |= shape::kPinched;
      touched_itself_at_load_ = true;
    }
  }
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

std::size_t TetMesh::memory_bytes() const {
  const std::size_t per_tet = sizeof(TetVertices) + sizeof(TetLinks) + sizeof(std::int32_t) + sizeof(std::uint32_t);
  const std::size_t per_vertex = 2 * sizeof(Vec3) + sizeof(TetId) + sizeof(VertexId) + sizeof(std::uint32_t) + 1;
  return tet_slots() * per_tet + vertex_slots() * per_vertex +
         (free_tets_.size() + free_vertices_.size()) * sizeof(std::uint32_t);
}

}  // namespace incise::inline v0
