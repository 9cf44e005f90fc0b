// SPDX-License-Identifier: Apache-2.0
#include "cut/crossing.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "incise/core/parallel.h"

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
    if (edge.crossings == 0 || t < edge.t || (t == edge.t && triangle < edge.triangle)) {
      edge.t = t;
      edge.triangle = triangle;
    }
    if (edge.crossings == 0 || t > edge.t_second || (t == edge.t_second && triangle > edge.triangle_second)) {
      edge.t_second = t;
      edge.triangle_second = triangle;
    }
    ++edge.crossings;
  };
  if (sheet.triangle_count() <= 2) {
    for (std::uint32_t triangle = 0; triangle < sheet.triangle_count(); ++triangle) test(triangle);
    return;
  }
  sheet.tree().for_each_overlap({p.position.cwiseMin(q.position), p.position.cwiseMax(q.position)}, test);
}

/// Which vertices coincide with the sheet, each asked once.
class CoincidenceMemo {
 public:
  CoincidenceMemo(const TetMesh& mesh, const Sheet& sheet) : mesh_(mesh), sheet_(sheet), known_(mesh.vertex_slots()) {}
  /// The triangle that the vertex lies on, within `kCoincident` of `length`.
  std::optional<std::uint32_t> find(VertexId vertex, double length) {
    std::uint32_t& known = known_[vertex.value];
    if (known == 0) {
      const auto hit = sheet_.tree().closest(mesh_.rest(vertex), kCoincident * length);
      known = hit.is_valid() ? hit.triangle + 2 : 1;
    }
    return known == 1 ? std::nullopt : std::optional(known - 2);
  }

 private:
  const TetMesh& mesh_;
  const Sheet& sheet_;
  ZeroedArray<std::uint32_t> known_;  // 1 apart, 2 + triangle on it
};

/// A chord that stays this share of its length away from a surface is as good as on it.
constexpr double kChordShare = 0.1;

/// Whether the piece of an edge between two crossings is a chord of one smooth part of the sheet: it leaves and enters
/// it again from the same side, or stays close to it all along.
bool is_graze(const Sheet& sheet, const Vec3& from, std::uint32_t first, const Vec3& to, std::uint32_t second) {
  const Vec3 chord = to - from, n = sheet.normal(first), m = sheet.normal(second);
  if (!(n.dot(m) > 0)) {
    return false;
  }
  if ((chord.dot(n) > 0) != (chord.dot(m) > 0)) {
    return true;
  }
  return sheet.tree().closest(0.5 * (from + to), kChordShare * chord.norm()).is_valid();
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

void find_crossings(const TetMesh& mesh, const Sheet& sheet, const std::vector<TetId>& near, Neighbourhood& out,
                    unsigned threads) {
  collect(mesh, near, out);
  GrowArray<CutEdge>& edges = out.edges.edges();
  if (threads <= 1) {
    SideMemo sides(mesh, sheet, near.size() / 2 + 8);
    for (CutEdge& edge : edges) {
      count_crossings(mesh, sheet, sides, edge);
    }
  } else {
    parallel_blocks(edges.size(), threads, [&](std::size_t, std::size_t begin, std::size_t end) {
      SideMemo sides(mesh, sheet, end - begin);
      for (std::size_t i = begin; i < end; ++i) {
        count_crossings(mesh, sheet, sides, edges[i]);
      }
    });
  }
  for (NearTet& tet : out.tets) {
    tet.flagged = flags_of(tet, out.edges);
    tet.is_complete = !has_odd_face(tet.flagged);
  }
}

std::vector<DoublyCrossed> find_doubly_crossed(const TetMesh& mesh, const Sheet& sheet,
                                               const Neighbourhood& neighbourhood, double gap) {
  std::vector<DoublyCrossed> found;
  CoincidenceMemo coincidence(mesh, sheet);
  for (std::uint32_t i = 0; i < neighbourhood.edges.size(); ++i) {
    const CutEdge& edge = neighbourhood.edges[i];
    if (edge.crossings == 0) {
      continue;
    }
    const Vec3& origin = mesh.rest(edge.a);
    const Vec3 along = mesh.rest(edge.b) - origin;
    const auto test = [&](double from, std::uint32_t first, double to, std::uint32_t second) {
      const bool is_apart = to - from > gap;
      if (is_apart && !is_graze(sheet, origin + from * along, first, origin + to * along, second)) {
        found.push_back({i, 0.5 * (from + to)});
      }
      return is_apart;
    };
    if (edge.crossings > 1 && test(edge.t, edge.triangle, edge.t_second, edge.triangle_second)) {
      continue;
    }
    const double length = along.norm();
    const auto at_a = coincidence.find(edge.a, length), at_b = coincidence.find(edge.b, length);
    const bool is_inner = edge.t > gap && edge.t_second < 1.0 - gap;
    if (is_inner && at_a.has_value() && test(0.0, *at_a, edge.t, edge.triangle)) {
      continue;
    }
    if (is_inner && at_b.has_value()) {
      test(edge.t_second, edge.triangle_second, 1.0, *at_b);
    }
  }
  return found;
}

}  // namespace incise::inline v0
