// SPDX-License-Identifier: Apache-2.0
// Each edge of the masters is asked once in a step, whoever has it; edges crossed twice are handed out with the place
// between (docs/internals.md, 3.3).
#include "cut/strip_crossing.h"

#include <optional>

#include "cut/constants.h"

namespace incise {
inline namespace v0 {

const std::vector<StripCrossing>& StripCrossings::find(const TetMesh& mesh, const Strip& strip,
                                                       std::span<const std::uint32_t> masters, ClosedComplex& complex,
                                                       std::uint32_t step) {
  crossed_.clear();
  sides_.begin(mesh, strip.sheet);
  for (const std::uint32_t m : masters) {
    for (const std::uint32_t e : complex[m].edges) {
      ClosedEdge& edge = complex.edges()[e];
      if (edge.tested == step) continue;
      edge.tested = step;
      const SheetCrossings found = find_crossings(mesh, strip.sheet, sides_, edge.a, edge.b);
      if (found.count > 0) crossed_.push_back({found, e, m});
    }
  }
  return crossed_;
}

std::vector<BetweenCrossings> find_doubly_crossed(const TetMesh& mesh, const Strip& strip,
                                                  std::span<const StripCrossing> crossings,
                                                  const ClosedComplex& complex, double gap) {
  const Sheet& sheet = strip.sheet;
  std::vector<BetweenCrossings> found;
  if (sheet.triangle_count() == 1) return found;
  const auto coincident = [&](VertexId vertex, double length) -> std::optional<std::uint32_t> {
    if (sheet.triangle_count() == 2) return std::nullopt;  // hardly folds back onto an edge's end: not worth the search
    const auto hit = sheet.tree().closest(mesh.rest(vertex), kCoincident * length);
    return hit.is_valid() ? std::optional(hit.triangle) : std::nullopt;
  };
  for (const StripCrossing& crossing : crossings) {
    const ClosedEdge& edge = complex.edges()[crossing.edge];
    const auto t = find_between(mesh, sheet, edge.a, edge.b, crossing, gap, coincident);
    if (t.has_value()) found.push_back({crossing.edge, crossing.master, *t});
  }
  return found;
}

}  // namespace v0
}  // namespace incise
