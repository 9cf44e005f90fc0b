// SPDX-License-Identifier: Apache-2.0
#include "improve/original_skin.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "improve/constants.h"
#include "incise/mesh/tet_tables.h"

namespace incise {
inline namespace v0 {

namespace {

/// The level whose cells are just as wide as an extent, or wider.
int level_of(double extent) {
  int exponent = 0;
  std::frexp(extent, &exponent);  // below 2^exponent
  const int steps = exponent >= 0 ? (exponent + kLevelStep - 1) / kLevelStep : exponent / kLevelStep;
  return steps * kLevelStep;
}

double mean_edge(const Facet& f) {
  return ((f[1] - f[0]).norm() + (f[2] - f[1]).norm() + (f[0] - f[2]).norm()) / 3.0;
}

Box inflated(Box box, double margin) {
  box.lo.array() -= margin;
  box.hi.array() += margin;
  return box;
}

}  // namespace

std::size_t OriginalSkin::CellHash::operator()(const Cell& cell) const {
  std::uint64_t hash = static_cast<std::uint64_t>(cell.level) * 0x9E3779B97F4A7C15U;
  for (const std::int64_t at : cell.at) {
    hash = (hash ^ static_cast<std::uint64_t>(at)) * 0xD6E8FEB86659FD93U;
    hash ^= hash >> 32U;
  }
  return static_cast<std::size_t>(hash);
}

void OriginalSkin::begin(const TetMesh& mesh, const Journal& journal) {
  if (has_begun_) return;
  const bool has_steps = journal.size() > journal.first();
  tet_slots_ = has_steps ? journal.step(journal.first()).before.tet_slots : mesh.tet_slots();
  has_begun_ = true;
}

void OriginalSkin::skip(const Journal& journal) {
  for (; position_ < journal.position(); ++position_) sizes_.follow(journal.step(position_));
}

void OriginalSkin::rewind(std::size_t position) {
  position_ = std::min(position_, position);
}

/// Whether a tet stands as it did when the journal began; slots above are taken by what edits made.
bool OriginalSkin::is_fresh(TetId tet) const {
  return tet.value < tet_slots_ && !(tet.value < is_noted_.capacity() && is_noted_[tet.value] != 0);
}

void OriginalSkin::follow(const TetMesh& mesh, const Journal& journal) {
  begin(mesh, journal);
  // Where vertices stood when the first of these steps began: later images of them come too late.
  std::unordered_map<std::uint32_t, Vec3> moved;
  for (std::size_t i = position_; i < journal.position(); ++i) {
    for (const VertexImage& image : journal.step(i).before.vertices) moved.emplace(image.id.value, image.rest);
  }
  const auto place_of = [&](VertexId v) {
    const auto at = moved.find(v.value);
    return at == moved.end() ? mesh.rest(v) : at->second;
  };
  for (std::size_t i = position_; i < journal.position(); ++i) {
    const Step& step = journal.step(i);
    for (const TetImage& image : step.before.tets) {
      if (image.vertices[0].is_valid()) note_tet(image.id, image.vertices, image.links, place_of);
    }
    for (const MovedVertex& vertex : step.moved) {
      if (!mesh.is_live(vertex.id)) continue;
      for (const TetId tet : walker_.star(mesh, vertex.id)) {
        note_tet(tet, mesh.vertices(tet), mesh.links(tet), place_of);
      }
    }
    sizes_.follow(step);
  }
  position_ = journal.position();
}

void OriginalSkin::note(const TetMesh& mesh, std::span<const TetId> tets) {
  for (const TetId tet : tets) {
    if (!mesh.is_live(tet)) continue;
    note_tet(tet, mesh.vertices(tet), mesh.links(tet), [&](VertexId v) -> const Vec3& { return mesh.rest(v); });
  }
}

template <class PlaceOf>
void OriginalSkin::note_tet(TetId tet, const TetVertices& vertices, const TetLinks& links, PlaceOf&& place_of) {
  if (!is_fresh(tet)) return;
  is_noted_.ensure(std::size_t{tet.value} + 1);
  is_noted_[tet.value] = 1;
  for (const auto& [a, b] : kEdgeCorners) {
    sizes_.note_edge(vertices[a], vertices[b], (place_of(vertices[a]) - place_of(vertices[b])).norm());
  }
  for (unsigned s = 0; s < 4; ++s) {
    if (links[s] != Link::boundary(0)) continue;
    std::array<VertexId, 3> v;
    Facet facet;
    for (unsigned k = 0; k < 3; ++k) {
      v[k] = vertices[kSideCorners[s][k]];
      facet[k] = place_of(v[k]);
    }
    const Box box = box_of(facet);
    const double extent = (box.hi - box.lo).maxCoeff();
    if (!(extent > 0)) continue;
    const int level = level_of(extent);
    add_facet(facet, level);
    for (unsigned k = 0; k < 3; ++k) add_point(v[k], facet[k], level);
  }
}

namespace {

/// Calls `visit(index)` for the cells of a level that meet a box.
template <class Visit>
void for_each_index(const Box& box, int level, Visit&& visit) {
  const auto at = [&](double coordinate) {
    return static_cast<std::int64_t>(std::floor(std::ldexp(coordinate, -level)));
  };
  const std::array<std::int64_t, 3> hi = {at(box.hi.x()), at(box.hi.y()), at(box.hi.z())};
  for (std::int64_t z = at(box.lo.z()); z <= hi[2]; ++z) {
    for (std::int64_t y = at(box.lo.y()); y <= hi[1]; ++y) {
      for (std::int64_t x = at(box.lo.x()); x <= hi[0]; ++x) visit(std::array{x, y, z});
    }
  }
}

}  // namespace

template <class List>
void OriginalSkin::for_each_place(const Box& box, int level, List&& list) {
  for (int step = 0; step <= kCoarserLevels; ++step) {
    const int at = level + step * kLevelStep;
    for_each_index(box, at, [&](const auto& index) {
      Content& content = cells_[{at, index}];
      list(step == 0 ? content.own : content.finer);
    });
  }
}

void OriginalSkin::add_facet(const Facet& facet, int level) {
  if (std::find(levels_.begin(), levels_.end(), level) == levels_.end()) levels_.push_back(level);
  const auto number = static_cast<std::uint32_t>(facets_.size());
  facets_.push_back(facet);
  for_each_place(box_of(facet), level, [&](Listed& listed) { listed.facets.push_back(number); });
}

void OriginalSkin::add_point(VertexId vertex, const Vec3& place, int level) {
  is_point_.ensure(std::size_t{vertex.value} + 1);
  if (std::exchange(is_point_[vertex.value], std::uint8_t{1}) != 0) return;
  const auto number = static_cast<std::uint32_t>(points_.size());
  points_.push_back(place);
  for_each_place({place, place}, level, [&](Listed& listed) { listed.points.push_back(number); });
}

template <class Visit>
void OriginalSkin::for_each_cell(const Box& box, Visit&& visit) const {
  const int finest = level_of((box.hi - box.lo).maxCoeff());
  const auto look = [&](int level, auto member) {
    for_each_index(box, level, [&](const auto& index) {
      const auto found = cells_.find({level, index});
      if (found != cells_.end()) visit(found->second.*member);
    });
  };
  look(finest, &Content::finer);
  for (const int level : levels_) {
    if (level >= finest) look(level, &Content::own);
  }
}

OriginalSkin::Closest OriginalSkin::closest(const Vec3& place, double greatest) const {
  Closest best;
  for_each_cell(inflated({place, place}, greatest), [&](const Listed& listed) {
    for (const std::uint32_t i : listed.facets) {
      const Facet& f = facets_[i];
      const double distance2 = closest_on_triangle(place, f[0], f[1], f[2]).distance2;
      if (distance2 < best.distance2 || (distance2 == best.distance2 && i < best.facet)) best = {distance2, i};
    }
  });
  return best.distance2 <= greatest * greatest ? best : Closest{};
}

/// In length units, at a piece of skin with this mean edge.
double OriginalSkin::tolerance_at(const Vec3& place, double edge, double share) const {
  const Closest nearest = closest(place, share * kFarthest * edge);
  const bool is_known = nearest.distance2 < std::numeric_limits<double>::infinity();
  if (!is_known) return share * edge;
  const double original = mean_edge(facets_[nearest.facet]);
  return share * (share < kBadSkinTolerance ? std::min(edge, original) : original);
}

/// Whether a vertex that the skin had is as near to the new piece as it must be; others than the old piece's own are.
bool OriginalSkin::is_covered(const Vec3& point, const Piece& before, const Piece& after, double tolerance) const {
  const double tolerance2 = tolerance * tolerance, before2 = distance2_to(before, point);
  return before2 > kOwn * kOwn * tolerance2 || distance2_to(after, point) <= std::max(tolerance2, before2);
}

/// Whether a piece lies where the skin was, or no further off than the one before it.
bool OriginalSkin::is_near(const Piece& after, const Piece& before, double tolerance) const {
  double reach2 = -1;
  return std::all_of(after.samples.begin(), after.samples.end(), [&](const Vec3& p) {
    if (distance2(p, tolerance) <= tolerance * tolerance) return true;
    const double farthest = kFarthest * tolerance;
    if (reach2 < 0) {
      for (const Vec3& q : before.samples) reach2 = std::max(reach2, distance2(q, farthest));
      reach2 = std::min(reach2, farthest * farthest);
    }
    return distance2(p, farthest) <= reach2;
  });
}

bool OriginalSkin::keeps_vertex(const Vec3& old_place, const Vec3& place, double edge, double share) const {
  if (is_empty()) return true;
  return is_near({{}, {place}}, {{}, {old_place}}, tolerance_at(old_place, edge, share));
}

bool OriginalSkin::keeps(const Piece& before, const Piece& after, double share) const {
  if (is_empty() || after.facets.empty() || before.samples.empty()) return true;
  double edge = 0;
  for (const Facet& f : after.facets) edge += mean_edge(f) / static_cast<double>(after.facets.size());
  const double tolerance = tolerance_at(before.samples.front(), edge, share);
  if (!is_near(after, before, tolerance)) return false;
  Box box;
  for (const Facet& f : before.facets) box.extend(box_of(f));
  bool are_covered = true;
  for_each_cell(inflated(box, kOwn * tolerance), [&](const Listed& listed) {
    for (const std::uint32_t i : listed.points) {
      are_covered = are_covered && is_covered(points_[i], before, after, tolerance);
    }
  });
  return are_covered;
}

}  // namespace v0
}  // namespace incise
