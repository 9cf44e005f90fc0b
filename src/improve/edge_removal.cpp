// SPDX-License-Identifier: Apache-2.0
// The ring's best triangulation by dynamic programming over its intervals, with every tet below the bound cut off
// early (docs/internals.md, 3.13).
#include "improve/edge_removal.h"

#include <algorithm>

#include "geom/constants.h"
#include "improve/surfaces.h"

namespace incise {
inline namespace v0 {

namespace {

/// Whether the two boundary faces at the ends of an open fan lie in one plane and carry one tag.
bool has_flat_ends(const TetMesh& mesh, const EdgeRing& ring) {
  const std::size_t last = ring.tets.size() - 1;
  const Side first_face(ring.tets.front(), mesh.corner_of(ring.tets.front(), ring.vertices[1]));
  const Side last_face(ring.tets.back(), mesh.corner_of(ring.tets.back(), ring.vertices[last]));
  const Vec3 n = vector_area2(mesh, first_face), m = vector_area2(mesh, last_face);
  return are_alike(mesh.link(first_face).tag(), mesh.link(last_face).tag()) && n.dot(m) > 0 &&
         n.cross(m).squaredNorm() <= kOnePlane * kOnePlane * n.squaredNorm() * m.squaredNorm();
}

}  // namespace

bool exists_elsewhere(Care& care, std::span<const VertexId> vertices, const std::vector<TetId>& cavity) {
  const TetMesh& mesh = care.mesh;
  const auto is_pinched = [&](VertexId v) { return (mesh.shape_of(v) & shape::kPinched) != 0; };
  if (std::any_of(vertices.begin(), vertices.end(), is_pinched)) {
    return true;
  }
  const std::vector<TetId>& star = care.walker.star(mesh, vertices.front());
  return std::any_of(star.begin(), star.end(), [&](TetId tet) {
    return std::find(cavity.begin(), cavity.end(), tet) == cavity.end() &&
           std::all_of(vertices.begin(), vertices.end(), [&](VertexId v) { return mesh.corner_of(tet, v) < 4; });
  });
}

bool keeps_current(const TetMesh& mesh, const RemeshPlan& plan) {
  const bool was_sound = std::all_of(plan.consumed.begin(), plan.consumed.end(),
                                     [&](TetId tet) { return is_sound_now(mesh, mesh.vertices(tet)); });
  return !was_sound || std::all_of(plan.produced.begin(), plan.produced.end(),
                                   [&](const NewTet& tet) { return is_sound_now(mesh, tet.vertices); });
}

bool EdgeRemover::improve(Care& care, TetId tet) {
  const TetVertices v = care.mesh.vertices(tet);
  return std::any_of(kEdgeCorners.begin(), kEdgeCorners.end(),
                     [&](const auto& edge) { return try_edge(care, v[edge[0]], v[edge[1]], tet); });
}

bool EdgeRemover::try_edge(Care& care, VertexId a, VertexId b, TetId seed) {
  if ((care.mesh.shape_of(a) & care.mesh.shape_of(b) & shape::kPinched) != 0) {
    return false;
  }
  find_edge_ring(care.mesh, a, b, seed, ring_);
  if (!is_removable(care) || !care.may_change(ring_.tets)) {
    return false;
  }
  const double before = worst_of(care, ring_.tets);
  if (!triangulate(care, a, b, std::max(before * (1.0 + kLeastGain), kLeastRatio))) {
    return false;
  }
  fill_edge_removal(care.mesh, a, b, ring_, triangles_, plan_);
  if (makes_known_face(care) || !keeps_current(care.mesh, plan_)) {
    return false;
  }
  apply(care.transaction, plan_, care.changed);
  ++care.statistics.removed_edges;
  return true;
}

bool EdgeRemover::is_removable(const Care& care) const {
  const std::size_t n = ring_.vertices.size();
  const auto is_pinched = [&](VertexId v) { return (care.mesh.shape_of(v) & shape::kPinched) != 0; };
  if (n >= 3 && !ring_.is_closed && (is_pinched(ring_.vertices.front()) || is_pinched(ring_.vertices.back()))) {
    return false;  // the new boundary edge might be there already
  }
  return n >= 3 && n <= kMostRing && has_one_region(care.mesh, ring_.tets) &&
         (ring_.is_closed || has_flat_ends(care.mesh, ring_));
}

/// Whether a new edge or face exists already: the other lip of a cut may have it where all its ends are on the front.
bool EdgeRemover::makes_known_face(Care& care) const {
  const auto last = ring_.vertices.size() - 1;
  return std::any_of(triangles_.begin(), triangles_.end(), [&](const RingTriangle& t) {
    const std::array<VertexId, 3> v = {ring_.vertices[t[0]], ring_.vertices[t[1]], ring_.vertices[t[2]]};
    const auto is_new = [&](unsigned i, unsigned j) { return j - i > 1 && !(ring_.is_closed && i == 0 && j == last); };
    return (is_new(t[0], t[1]) && exists_elsewhere(care, std::array{v[0], v[1]}, ring_.tets)) ||
           (is_new(t[1], t[2]) && exists_elsewhere(care, std::array{v[1], v[2]}, ring_.tets)) ||
           (is_new(t[0], t[2]) && exists_elsewhere(care, std::array{v[0], v[2]}, ring_.tets)) ||
           exists_elsewhere(care, v, ring_.tets);
  });
}

/// The worse of the two tets that a triangle of the ring makes with the ends of the edge; 0 where it is below the
/// bound.
double EdgeRemover::rate(Care& care, VertexId a, VertexId b, unsigned i, unsigned j, unsigned k, double bound) const {
  const TetMesh& mesh = care.mesh;
  const VertexId p = ring_.vertices[i], q = ring_.vertices[j], r = ring_.vertices[k];
  care.spend(1);
  const double below = inradius_ratio(mesh, {a, p, q, r});
  if (!(below > bound)) {
    return 0.0;
  }
  care.spend(1);
  const double above = inradius_ratio(mesh, {p, q, r, b});
  return above > bound ? std::min(below, above) : 0.0;
}

/// Finds the triangulation of the ring whose worst tet is best; false where none is better than the bound.
bool EdgeRemover::triangulate(Care& care, VertexId a, VertexId b, double bound) {
  const auto n = static_cast<unsigned>(ring_.vertices.size());
  for (unsigned i = 0; i + 1 < n; ++i) {
    best_[i][i + 1] = 2.0;
  }
  for (unsigned width = 2; width < n; ++width) {
    for (unsigned i = 0; i + width < n; ++i) {
      const unsigned k = i + width;
      best_[i][k] = 0.0;
      for (unsigned j = i + 1; j < k; ++j) {
        const double parts = std::min(best_[i][j], best_[j][k]);
        if (!(parts > std::max(best_[i][k], bound))) {
          continue;
        }
        const double worst = std::min(parts, rate(care, a, b, i, j, k, bound));
        if (worst > best_[i][k]) {
          best_[i][k] = worst;
          apex_[i][k] = static_cast<std::uint8_t>(j);
        }
      }
    }
  }
  triangles_.clear();
  if (!(best_[0][n - 1] > bound)) {
    return false;
  }
  collect_triangles(0, n - 1);
  return true;
}

void EdgeRemover::collect_triangles(unsigned i, unsigned k) {
  if (k - i < 2) {
    return;
  }
  const unsigned j = apex_[i][k];
  triangles_.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j), static_cast<std::uint8_t>(k)});
  collect_triangles(i, j);
  collect_triangles(j, k);
}

bool FaceRemover::improve(Care& care, TetId tet) {
  for (unsigned s = 0; s < 4; ++s) {
    if (try_face(care, {tet, s})) {
      return true;
    }
  }
  return false;
}

bool FaceRemover::try_face(Care& care, Side face) {
  const TetMesh& mesh = care.mesh;
  const Link behind = mesh.link(face);
  if (behind.is_boundary() || mesh.region(face.tet()) != mesh.region(behind.side().tet())) {
    return false;
  }
  const TetId other = behind.side().tet();
  const VertexId p = mesh.vertices(face.tet())[face.side()], q = mesh.vertices(other)[behind.side().side()];
  const auto [x, y, z] = mesh.vertices(face);
  const double before =
      std::min(inradius_ratio(mesh, mesh.vertices(face.tet())), inradius_ratio(mesh, mesh.vertices(other)));
  const double bound = std::max(before * (1.0 + kLeastGain), kLeastRatio);
  plan_.consumed.assign({face.tet(), other});
  plan_.produced.assign({{{x, y, p, q}, 0}, {{y, z, p, q}, 0}, {{z, x, p, q}, 1}});
  care.spend(5);
  const bool is_better = std::all_of(plan_.produced.begin(), plan_.produced.end(),
                                     [&](const NewTet& tet) { return inradius_ratio(mesh, tet.vertices) > bound; });
  const std::array<VertexId, 2> edge = {p, q};
  if (!is_better || !care.may_change(plan_.consumed) || exists_elsewhere(care, edge, plan_.consumed) ||
      !keeps_current(mesh, plan_)) {
    return false;
  }
  apply(care.transaction, plan_, care.changed);
  ++care.statistics.removed_faces;
  return true;
}

}  // namespace v0
}  // namespace incise
