// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "cut/constants.h"
#include "cut/sweep.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// How a sheet crosses an edge (a, b) of the mesh at rest.
struct SheetCrossings {
  std::uint32_t count = 0;       ///< how often
  double t = 0.5, t_last = 0.5;  ///< of the first and of the last crossing, from a to b, in [0, 1]
  std::uint32_t triangle = 0, triangle_last = 0;

  [[nodiscard]] bool is_odd() const { return (count & 1U) != 0; }
};

/// The sides of a sheet's triangles on which vertices lie, each computed once. Keeps its memory between sheets.
class SideSigns {
 public:
  /// Starts afresh with another sheet.
  void begin(const TetMesh& mesh, const Sheet& sheet);
  /// 1 or −1, never 0: see `orient3d_sos`.
  int side(VertexId vertex, std::uint32_t triangle);

 private:
  [[nodiscard]] int compute(VertexId vertex, std::uint32_t triangle) const;

  const TetMesh* mesh_ = nullptr;
  const Sheet* sheet_ = nullptr;
  ZeroedArray<std::uint32_t> index_;  // by vertex slot: 1 + row of `signs_`
  std::vector<VertexId> known_;
  std::vector<std::int8_t> signs_;
};

/// Counts how often a sheet crosses an edge, by exact signs under Simulation of Simplicity, so that no test is
/// degenerate: every vertex is on one side of every triangle, and neighbours agree. Paper §2.2 (collision points).
/// Differs: the paper tests with a tolerance. Cost: O(1) for few triangles, else O(log triangles).
SheetCrossings find_crossings(const TetMesh& mesh, const Sheet& sheet, SideSigns& sides, VertexId a, VertexId b);

/// How often a sheet crosses the way between two points, whose keys are unlike those of the sheet's. By exact signs, as
/// `find_crossings`. Cost: O(log triangles).
std::uint32_t count_crossings(const Sheet& sheet, const SosPoint& from, const SosPoint& to);

/// A place between two crossings of an edge more than `gap` of it apart: two parts of the sheet pass through it, and it
/// must be bisected in between, or one crossing would hide the other. Halfway, from a to b; none where there is none.
/// An end that coincides with the sheet counts as crossed there: `coincident(vertex, length)` names the triangle that a
/// vertex lies on, if any, for an edge of that length. A single smooth part that an edge leaves and enters again (a
/// graze: the edge is nearly a chord) is left alone; the cut then follows the chord.
template <class Coincident>
std::optional<double> find_between(const TetMesh& mesh, const Sheet& sheet, VertexId a, VertexId b,
                                   const SheetCrossings& crossings, double gap, Coincident&& coincident);

/// Whether the piece of an edge between two crossings, with the sheet's normals there (any length), is a chord of one
/// smooth part of the sheet: it leaves and enters it again from the same side, or stays close to it all along, as
/// `is_near(place, distance)` tells.
template <class IsNear>
bool is_graze(const Vec3& from, const Vec3& normal_from, const Vec3& to, const Vec3& normal_to, IsNear&& is_near) {
  const Vec3 chord = to - from;
  if (!(normal_from.dot(normal_to) > 0)) return false;
  if ((chord.dot(normal_from) > 0) != (chord.dot(normal_to) > 0)) return true;
  return is_near(Vec3(0.5 * (from + to)), kGrazeChord * chord.norm());
}

namespace detail {

/// The same for two triangles of one sheet.
bool is_graze(const Sheet& sheet, const Vec3& from, std::uint32_t first, const Vec3& to, std::uint32_t second);

}  // namespace detail

template <class Coincident>
std::optional<double> find_between(const TetMesh& mesh, const Sheet& sheet, VertexId a, VertexId b,
                                   const SheetCrossings& crossings, double gap, Coincident&& coincident) {
  const Vec3& origin = mesh.rest(a);
  const Vec3 along = mesh.rest(b) - origin;
  std::optional<double> found;
  const auto test = [&](double from, std::uint32_t first, double to, std::uint32_t second) {
    const bool is_apart = to - from > gap;
    if (is_apart && !detail::is_graze(sheet, origin + from * along, first, origin + to * along, second)) {
      found = 0.5 * (from + to);
    }
    return is_apart;
  };
  const bool is_twice = crossings.count > 1;
  if (is_twice && test(crossings.t, crossings.triangle, crossings.t_last, crossings.triangle_last)) return found;
  if (!(crossings.t > gap && crossings.t_last < 1.0 - gap)) return found;
  const double length = along.norm();
  const std::optional<std::uint32_t> at_a = coincident(a, length);
  if (at_a.has_value() && test(0.0, *at_a, crossings.t, crossings.triangle)) return found;
  const std::optional<std::uint32_t> at_b = coincident(b, length);
  if (at_b.has_value()) test(crossings.t_last, crossings.triangle_last, 1.0, *at_b);
  return found;
}

}  // namespace v0
}  // namespace incise
