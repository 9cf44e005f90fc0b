// SPDX-License-Identifier: Apache-2.0
#include "cut/crossing.h"

#include <algorithm>
#include <cmath>

namespace incise::inline v0 {

namespace {

constexpr std::size_t kMaxSignTable = std::size_t{1} << 25U;
constexpr std::int8_t kUnknown = 2;

/// The side of each triangle's plane on which a vertex lies, computed once per pair.
class SideMemo {
 public:
  SideMemo(const TetMesh& mesh, const Sheet& sheet, std::size_t vertex_estimate)
      : mesh_(mesh), sheet_(sheet), index_(mesh.vertex_slots()) {
    is_used_ = vertex_estimate * sheet.triangle_count() <= kMaxSignTable;
  }
  int side(VertexId vertex, std::uint32_t triangle) {
    if (!is_used_) {
      return compute(vertex, triangle);
    }
    std::uint32_t& index = index_[vertex.value];
    if (index == 0) {
      index = ++count_;
      signs_.resize(count_ * sheet_.triangle_count(), kUnknown);
    }
    std::int8_t& sign = signs_[(index - std::size_t{1}) * sheet_.triangle_count() + triangle];
    if (sign == kUnknown) {
      sign = static_cast<std::int8_t>(compute(vertex, triangle));
    }
    return sign;
  }

 private:
  int compute(VertexId vertex, std::uint32_t triangle) const {
    return orient3d_sos(sheet_.point(triangle, 0), sheet_.point(triangle, 1), sheet_.point(triangle, 2),
                        {mesh_.rest(vertex), vertex.value});
  }

  const TetMesh& mesh_;
  const Sheet& sheet_;
  ZeroedArray<std::uint32_t> index_;
  std::vector<std::int8_t> signs_;
  std::uint32_t count_ = 0;
  bool is_used_ = false;
};

bool passes_through(const SosPoint& p, const SosPoint& q, const Sheet& sheet, std::uint32_t triangle) {
  const SosPoint& a = sheet.point(triangle, 0);
  const SosPoint& b = sheet.point(triangle, 1);
  const SosPoint& c = sheet.point(triangle, 2);
  const int first = orient3d_sos(p, q, a, b);
  return first == orient3d_sos(p, q, b, c) && first == orient3d_sos(p, q, c, a);
}

/// Where the plane of a triangle divides the segment, from p (0) to q (1).
double crossing_parameter(const Vec3& p, const Vec3& q, const Sheet& sheet, std::uint32_t triangle) {
  const Vec3 normal = sheet.normal(triangle);
  const Vec3& origin = sheet.point(triangle, 0).position;
  const double from = normal.dot(p - origin), to = normal.dot(q - origin);
  const double t = from / (from - to);
  return t >= 0.0 && t <= 1.0 ? t : (std::abs(from) <= std::abs(to) ? 0.0 : 1.0);
}

void count_crossings(const TetMesh& mesh, const Sheet& sheet, SideMemo& sides, CutEdge& edge) {
  const SosPoint p{mesh.rest(edge.a), edge.a.value}, q{mesh.rest(edge.b), edge.b.value};
  const auto test = [&](std::uint32_t triangle) {
    if (sides.side(edge.a, triangle) == sides.side(edge.b, triangle) || !passes_through(p, q, sheet, triangle)) {
      return;
    }
    const double t = crossing_parameter(p.position, q.position, sheet, triangle);
    // Of several crossings keep the two that lie furthest apart.
    if (edge.crossings == 0) {
      edge.t = edge.t_second = t;
    } else {
      edge.t_second = edge.crossings == 1 ? std::max(edge.t, t) : std::max(edge.t_second, t);
      edge.t = std::min(edge.t, t);
    }
    ++edge.crossings;
  };
  if (sheet.triangle_count() <= 2) {
    for (std::uint32_t triangle = 0; triangle < sheet.triangle_count(); ++triangle) test(triangle);
    return;
  }
  sheet.tree().for_each_overlap({p.position.cwiseMin(q.position), p.position.cwiseMax(q.position)}, test);
}

std::uint8_t flags_of(const NearTet& tet, const EdgeTable& edges) {
  unsigned flags = 0;
  for (unsigned e = 0; e < 6; ++e) {
    flags |= static_cast<unsigned>(edges[tet.edges[e]].is_flagged()) << e;
  }
  return static_cast<std::uint8_t>(flags);
}

void collect(const TetMesh& mesh, const std::vector<TetId>& near, Neighbourhood& out) {
  out.clear(mesh);
  out.tets.reserve(near.size());
  for (const TetId id : near) {
    NearTet tet;
    tet.id = id;
    const TetVertices& v = mesh.vertices(id);
    for (unsigned e = 0; e < 6; ++e) {
      tet.edges[e] = out.edges.find_or_add(v[kEdgeCorners[e][0]], v[kEdgeCorners[e][1]]);
    }
    out.tets.push_back(tet);
    out.index_of_tet[id.value] = static_cast<std::uint32_t>(out.tets.size());
  }
}

}  // namespace

void find_crossings(const TetMesh& mesh, const Sheet& sheet, const std::vector<TetId>& near, Neighbourhood& out) {
  collect(mesh, near, out);
  SideMemo sides(mesh, sheet, near.size() / 2 + 8);
  for (CutEdge& edge : out.edges.edges()) {
    count_crossings(mesh, sheet, sides, edge);
  }
  for (NearTet& tet : out.tets) {
    tet.flagged = flags_of(tet, out.edges);
    tet.is_complete = !has_odd_face(tet.flagged);
  }
}

std::vector<std::uint32_t> find_multiply_crossed(const Neighbourhood& neighbourhood, double gap) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < neighbourhood.edges.size(); ++i) {
    const CutEdge& edge = neighbourhood.edges[i];
    if (edge.crossings > 1 && edge.t_second - edge.t > gap) {
      found.push_back(i);
    }
  }
  return found;
}

}  // namespace incise::inline v0
