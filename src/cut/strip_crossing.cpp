// SPDX-License-Identifier: Apache-2.0
#include "cut/strip_crossing.h"

#include <cmath>
#include <optional>

#include "cut/neighbourhood.h"

namespace incise::inline v0 {

namespace {

constexpr std::size_t kMaxSignTable = std::size_t{1} << 25U;
constexpr std::int8_t kUnknown = 2;

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

/// The triangle that a vertex lies on, within `kCoincident` of `length`.
std::optional<std::uint32_t> find_coincident(const TetMesh& mesh, const Sheet& sheet, VertexId vertex, double length) {
  const auto hit = sheet.tree().closest(mesh.rest(vertex), kCoincident * length);
  return hit.is_valid() ? std::optional(hit.triangle) : std::nullopt;
}

}  // namespace

int StripCrossings::side(const TetMesh& mesh, const Sheet& sheet, VertexId vertex, std::uint32_t triangle) {
  const auto compute = [&] {
    return orient3d_sos(sheet.point(triangle, 0), sheet.point(triangle, 1), sheet.point(triangle, 2),
                        {mesh.rest(vertex), vertex.value});
  };
  std::uint32_t& row = index_[vertex.value];
  if (row == 0) {
    if ((known_.size() + 1) * sheet.triangle_count() > kMaxSignTable) {
      return compute();
    }
    known_.push_back(vertex);
    row = static_cast<std::uint32_t>(known_.size());
    signs_.resize(known_.size() * sheet.triangle_count(), kUnknown);
  }
  std::int8_t& sign = signs_[(row - std::size_t{1}) * sheet.triangle_count() + triangle];
  if (sign == kUnknown) {
    sign = static_cast<std::int8_t>(compute());
  }
  return sign;
}

void StripCrossings::count(const TetMesh& mesh, const Sheet& sheet, const ClosedEdge& edge, StripCrossing& crossing) {
  const SosPoint p{mesh.rest(edge.a), edge.a.value}, q{mesh.rest(edge.b), edge.b.value};
  const auto test = [&](std::uint32_t triangle) {
    if (side(mesh, sheet, edge.a, triangle) == side(mesh, sheet, edge.b, triangle) ||
        !passes_through(p, q, sheet, triangle)) {
      return;
    }
    const double t = crossing_parameter(p.position, q.position, sheet, triangle);
    if (crossing.count == 0 || t < crossing.t || (t == crossing.t && triangle < crossing.triangle)) {
      crossing.t = t;
      crossing.triangle = triangle;
    }
    if (crossing.count == 0 || t > crossing.t_last || (t == crossing.t_last && triangle > crossing.triangle_last)) {
      crossing.t_last = t;
      crossing.triangle_last = triangle;
    }
    ++crossing.count;
  };
  if (sheet.triangle_count() <= 2) {
    for (std::uint32_t triangle = 0; triangle < sheet.triangle_count(); ++triangle) test(triangle);
    return;
  }
  sheet.tree().for_each_overlap({p.position.cwiseMin(q.position), p.position.cwiseMax(q.position)}, test);
}

const std::vector<StripCrossing>& StripCrossings::find(const TetMesh& mesh, const Strip& strip,
                                                       std::span<const std::uint32_t> masters, ClosedComplex& complex,
                                                       std::uint32_t step) {
  crossed_.clear();
  index_.ensure(mesh.vertex_slots());
  for (const std::uint32_t m : masters) {
    for (const std::uint32_t e : complex[m].edges) {
      ClosedEdge& edge = complex.edges()[e];
      if (edge.tested == step) continue;
      edge.tested = step;
      StripCrossing crossing{e, m};
      count(mesh, strip.sheet, edge, crossing);
      if (crossing.count > 0) crossed_.push_back(crossing);
    }
  }
  for (const VertexId vertex : known_) index_[vertex.value] = 0;
  known_.clear();
  signs_.clear();
  return crossed_;
}

std::vector<BetweenCrossings> find_doubly_crossed(const TetMesh& mesh, const Strip& strip,
                                                  std::span<const StripCrossing> crossings,
                                                  const ClosedComplex& complex, double gap) {
  const Sheet& sheet = strip.sheet;
  std::vector<BetweenCrossings> found;
  if (sheet.triangle_count() == 1) return found;
  for (const StripCrossing& crossing : crossings) {
    const ClosedEdge& edge = complex.edges()[crossing.edge];
    const Vec3& origin = mesh.rest(edge.a);
    const Vec3 along = mesh.rest(edge.b) - origin;
    const auto test = [&](double from, std::uint32_t first, double to, std::uint32_t second) {
      const bool is_apart = to - from > gap;
      if (is_apart && !is_graze(sheet, origin + from * along, first, origin + to * along, second)) {
        found.push_back({crossing.edge, crossing.master, 0.5 * (from + to)});
      }
      return is_apart;
    };
    if (crossing.count > 1 && test(crossing.t, crossing.triangle, crossing.t_last, crossing.triangle_last)) {
      continue;
    }
    if (sheet.triangle_count() == 2 || !(crossing.t > gap && crossing.t_last < 1.0 - gap)) {
      continue;
    }
    const double length = along.norm();
    const auto at_a = find_coincident(mesh, sheet, edge.a, length), at_b = find_coincident(mesh, sheet, edge.b, length);
    if (at_a.has_value() && test(0.0, *at_a, crossing.t, crossing.triangle)) {
      continue;
    }
    if (at_b.has_value()) {
      test(crossing.t_last, crossing.triangle_last, 1.0, *at_b);
    }
  }
  return found;
}

}  // namespace incise::inline v0
