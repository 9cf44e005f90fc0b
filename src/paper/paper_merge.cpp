// SPDX-License-Identifier: Apache-2.0
// Figure 6 by the lengths of six edges: which of them are short tells the case and which vanish. Three places are
// tried for each merge, and each condition is asked in turn (docs/paper_map.md, section 2.5).
#include "paper/paper_merge.h"

#include <algorithm>
#include <cmath>

#include "cut/spacing.h"
#include "improve/standing.h"
#include "incise/geom/quality.h"
#include "incise/mesh/collapse.h"
#include "paper/constants.h"
#include "paper/paper_classes.h"
#include "paper/paper_stage.h"

namespace incise {
inline namespace v0 {
namespace paper {

namespace {

/// Six times the volume of a regular tet with edges of length 1: √½.
constexpr double kRegularVolume6 = 0.70710678118654752440;

struct Edge {
  unsigned number;
  double length2;
};

/// The edges of a tet, the shortest first.
std::array<Edge, 6> sorted_edges(const TetMesh& mesh, TetId tet) {
  const TetVertices& v = mesh.vertices(tet);
  std::array<Edge, 6> edges{};
  for (unsigned e = 0; e < 6; ++e) {
    const auto [a, b] = kEdgeCorners[e];
    edges[e] = {e, (mesh.rest(v[a]) - mesh.rest(v[b])).squaredNorm()};
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return a.length2 != b.length2 ? a.length2 < b.length2 : a.number < b.number;
  });
  return edges;
}

/// The side that two edges of a tet share.
unsigned common_side(unsigned first, unsigned second) {
  const auto has = [](unsigned side, unsigned edge) {
    return std::find(kSideEdges[side].begin(), kSideEdges[side].end(), edge) != kSideEdges[side].end();
  };
  unsigned side = 0;
  while (!has(side, first) || !has(side, second)) {
    ++side;
  }
  return side;
}

bool is_surface_edge(const TetMesh& mesh, TetId tet, VertexId a, VertexId b) {
  return !walk_edge_ring(
      mesh, a, b, tet, [](Side) { return false; }, [](TetId) {});
}

}  // namespace

ThinTet find_thin_shape(const TetMesh& mesh, TetId tet, double length) {
  const std::array<Edge, 6> edges = sorted_edges(mesh, tet);
  const auto is_short = [&](const Edge& e) { return length * length * e.length2 < edges[5].length2; };
  ThinTet thin;
  const auto add = [&](const Edge& e) {
    const auto [a, b] = kEdgeCorners[e.number];
    thin.edges[thin.count++] = {mesh.vertices(tet)[a], mesh.vertices(tet)[b]};
  };
  if (!is_short(edges[0])) {
    return thin;
  }
  if (!is_short(edges[1])) {
    thin.shape = ThinShape::kShortEdge;
    add(edges[0]);
  } else if (edges[1].number == opposite_edge(edges[0].number)) {
    thin.shape = ThinShape::kTwoShortEdges;
    add(edges[0]);
    add(edges[1]);
  } else {
    thin.shape = ThinShape::kShortFace;
    const auto& face = kSideEdges[common_side(edges[0].number, edges[1].number)];
    for (const Edge& e : edges) {
      if (std::find(face.begin(), face.end(), e.number) != face.end()) add(e);
    }
  }
  return thin;
}

ThinTet find_short_edges(const TetMesh& mesh, TetId tet, double length, double typical) {
  ThinTet small;
  for (const Edge& e : sorted_edges(mesh, tet)) {
    if (!(length * length * e.length2 < typical * typical)) break;
    const auto [a, b] = kEdgeCorners[e.number];
    small.shape = ThinShape::kSmall;
    small.edges[small.count++] = {mesh.vertices(tet)[a], mesh.vertices(tet)[b]};
  }
  return small;
}

bool is_safe_to_merge(const TetMesh& mesh, TetId tet, VertexId b, VertexId c) {
  const TetVertices& v = mesh.vertices(tet);
  const unsigned corner_b = mesh.corner_of(tet, b), corner_c = mesh.corner_of(tet, c);
  const unsigned edge = opposite_edge(kEdgeOfCorners[corner_b][corner_c]);
  const unsigned corner_a = kEdgeCorners[edge][0], corner_d = kEdgeCorners[edge][1];
  const auto surf_edge = [&](VertexId x, unsigned y) { return is_surface_edge(mesh, tet, x, v[y]); };
  const auto surf_face_opposite = [&](unsigned corner) { return mesh.links(tet)[corner].is_boundary(); };
  const bool abc = surf_face_opposite(corner_d), bcd = surf_face_opposite(corner_a);
  const bool abd = surf_face_opposite(corner_c), acd = surf_face_opposite(corner_b);
  return is_safe_at_face(surf_edge(b, corner_a), surf_edge(c, corner_a), abc, abd, acd) &&
         is_safe_at_face(surf_edge(b, corner_d), surf_edge(c, corner_d), bcd, abd, acd);
}

bool is_safe_around(const TetMesh& mesh, std::span<const TetId> ring, VertexId b, VertexId c) {
  return std::all_of(ring.begin(), ring.end(), [&](TetId tet) { return is_safe_to_merge(mesh, tet, b, c); });
}

namespace {

class EdgeMerger : private PaperStage {
 public:
  EdgeMerger(Transaction& transaction, const MergeThresholds& thresholds, const Held& held, MergeCensus* census)
      : PaperStage(transaction, held),
        thresholds_(thresholds),
        census_(census),
        typical_(typical_spacing(transaction.mesh())),
        least_volume6_(thresholds.size * kRegularVolume6 * typical_ * typical_ * typical_) {}

  MaintainStatistics run(const std::vector<TetId>& tets) {
    bool has_merged = true;
    while (has_merged) {
      has_merged = false;
      for (const TetId tet : tets) {
        has_merged |= mesh_.is_live(tet) && !held_.holds(mesh_, tet) && eliminate(tet);
      }
    }
    return done();
  }

 private:
  /// Merges what Figure 6 marks in a negligible tet, or what is short in one that is too small. Returns whether
  /// anything was merged.
  bool eliminate(TetId tet) {
    const ThinTet thin = find_thin_shape(mesh_, tet, thresholds_.length);
    if (thin.shape != ThinShape::kNone && meter_.of(tet) > thresholds_.shape) {
      return merge_all(thin);
    }
    return mesh_.rest_volume6(tet) < least_volume6_ &&
           merge_one(find_short_edges(mesh_, tet, thresholds_.length, typical_));
  }
  bool merge_one(const ThinTet& small) {
    return std::any_of(small.edges.begin(), small.edges.begin() + small.count,
                       [&](const auto& edge) { return merge(edge[0], edge[1]); });
  }
  bool merge_all(ThinTet thin) {
    bool has_merged = false;
    for (unsigned i = 0; i < thin.count; ++i) {
      const auto [a, b] = thin.edges[i];
      if (a != b && merge(a, b)) {
        has_merged = true;
        for (auto& [c, d] : thin.edges) {
          c = c == plan_.from ? plan_.into : c;
          d = d == plan_.from ? plan_.into : d;
        }
      }
    }
    return has_merged;
  }

  bool merge(VertexId a, VertexId b) {
    if (held_.holds(a) || held_.holds(b)) {
      return false;
    }
    const VertexClass class_a = classes_.classify(mesh_, a), class_b = classes_.classify(mesh_, b);
    const bool b_goes = class_a != class_b ? class_b < class_a : a < b;
    const VertexId from = b_goes ? b : a, into = b_goes ? a : b;
    if (!may_go_to(from, into)) {
      return false;
    }
    planner_.plan(mesh_, from, into, plan_);
    if (!is_safe_as_printed() || !plan_) {
      return false;
    }
    const Vec3 at_from = mesh_.rest(from), at_into = mesh_.rest(into);
    if (class_a != class_b) {
      return merge_at(at_into);
    }
    return merge_at(0.5 * (at_from + at_into)) || merge_at(at_into) || merge_at(at_from);
  }
  bool merge_at(const Vec3& place) {
    return stays_positive(mesh_, plan_, place) && keeps_surface(place) && keeps_skin(place) && keeps_quality(place) &&
           keeps_standing(place) && carry_out(place);
  }
  /// What the class of a vertex allows. Whether an edge between surface vertices lies on the surface, the link
  /// condition tells.
  bool may_go_to(VertexId from, VertexId into) {
    switch (classes_.classify(mesh_, from)) {
      case VertexClass::kInside:
      case VertexClass::kSurface:
        return true;
      case VertexClass::kContour:
        return classes_.contour()[0] == into || classes_.contour()[1] == into;
      default:
        return false;
    }
  }
  bool is_safe_as_printed() {
    const bool is_safe = is_safe_around(mesh_, plan_.ring, plan_.from, plan_.into);
    if (census_ != nullptr) {
      ++census_->asked;
      census_->refused += is_safe ? 0U : 1U;
    }
    return is_safe;
  }
  /// Calls `visit(tet, moved vertex)` for the tets that the merge leaves, changed.
  template <class Visit>
  void for_each_changed(const Vec3& place, Visit&& visit) const {
    for (const TetId tet : plan_.fan) {
      visit(tet, plan_.from);
    }
    for (const TetId tet : plan_.around) {
      if (place != mesh_.rest(plan_.into) && mesh_.corner_of(tet, plan_.from) == 4) {
        visit(tet, plan_.into);
      }
    }
  }
  /// Whether no boundary face turns sharply.
  [[nodiscard]] bool keeps_surface(const Vec3& place) const {
    bool keeps = true;
    for_each_changed(place, [&](TetId tet, VertexId moved) {
      for (unsigned s = 0; s < 4; ++s) {
        const bool is_moved_face = mesh_.links(tet)[s].is_boundary() && mesh_.vertices(tet)[s] != moved;
        keeps =
            keeps && (!is_moved_face || is_smooth(area_vector(mesh_, {tet, s}), moved_area({tet, s}, moved, place)));
      }
    });
    return keeps;
  }
  /// Whether the body's skin stays where it is, but for little volume beside that of the tets there. What lies between
  /// the skin as it is and as it would be are the cones from the place over the faces that move. Walls of cuts may
  /// give: smoothing moves them as well.
  [[nodiscard]] bool keeps_skin(const Vec3& place) const {
    double between = 0, all = 0;
    const auto add = [&](TetId tet) {
      all += mesh_.rest_volume6(tet);
      for (unsigned s = 0; s < 4; ++s) {
        if (is_moving_skin({tet, s})) between += cone6({tet, s}, place);
      }
    };
    for (const TetId tet : plan_.ring) add(tet);
    for (const TetId tet : plan_.fan) add(tet);
    for (const TetId tet : plan_.around) {
      if (mesh_.corner_of(tet, plan_.from) == 4) add(tet);
    }
    return std::abs(between) <= kMostSkinChange * all;
  }
  [[nodiscard]] bool is_moving_skin(Side side) const {
    const Link link = mesh_.link(side);
    if (!link.is_boundary() || link.tag() != 0) return false;
    const auto v = mesh_.vertices(side);
    return std::any_of(v.begin(), v.end(), [&](VertexId w) { return w == plan_.from || w == plan_.into; });
  }
  [[nodiscard]] double cone6(Side side, const Vec3& apex) const {
    const auto v = mesh_.vertices(side);
    return signed_volume6(apex, mesh_.rest(v[0]), mesh_.rest(v[1]), mesh_.rest(v[2]));
  }
  [[nodiscard]] Vec3 moved_area(Side face, VertexId moved, const Vec3& place) const {
    const auto v = mesh_.vertices(face);
    const auto at = [&](unsigned k) { return v[k] == moved ? place : mesh_.rest(v[k]); };
    return (at(1) - at(0)).cross(at(2) - at(0));
  }
  /// Whether the worst of the changed tets is not bad-shaped, or no worse than the worst was, those that vanish
  /// included. Where the edge is tiny, they may be several times worse: a layer that a cut leaves beside a plane of
  /// vertices is merged corner by corner, and gets thinner on the way.
  bool keeps_quality(const Vec3& place) {
    double before = kBadShape, after = 0;
    for (const TetId tet : plan_.ring) {
      before = std::max(before, meter_.of(tet));
    }
    for_each_changed(place, [&](TetId tet, VertexId moved) {
      before = std::max(before, meter_.of(tet));
      after = std::max(after, meter_.of_moved(tet, moved, place));
    });
    return after <= (is_tiny() ? kMostWorse : 1.0) * before;
  }
  [[nodiscard]] bool is_tiny() const {
    const double most = kTinyEdge * typical_;
    return (mesh_.rest(plan_.from) - mesh_.rest(plan_.into)).squaredNorm() < most * most;
  }
  /// Whether tets that stand upright now stay so, with the merged vertex where it will stand.
  [[nodiscard]] bool keeps_standing(const Vec3& place) const {
    Vec3 merged = mesh_.current(plan_.into);
    if (place != mesh_.rest(plan_.into)) {
      const MaterialPoint point = locate(mesh_, place, plan_.around);
      merged = current_after_move(mesh_, plan_.into, place, point.basis, point.weights);
    }
    bool keeps = true;
    for_each_changed(place, [&](TetId tet, VertexId moved) {
      const TetVertices& v = mesh_.vertices(tet);
      const auto at = [&](unsigned c) -> const Vec3& { return v[c] == moved ? merged : mesh_.current(v[c]); };
      keeps = keeps && (signed_volume6(at(0), at(1), at(2), at(3)) > 0 || !is_sound_now(mesh_, v));
    });
    return keeps;
  }
  bool carry_out(const Vec3& place) {
    if (place != mesh_.rest(plan_.into)) {
      const MoveVertexPlan move = plan_move_vertex(mesh_, plan_.into, place);
      if (!move) {
        return false;
      }
      apply(transaction_, move);
      ++done_.moved_vertices;
    }
    apply(transaction_, plan_);
    ++done_.collapsed_edges;
    return true;
  }

  MergeThresholds thresholds_;
  MergeCensus* census_;
  double typical_, least_volume6_;
  ClassFinder classes_{&held_};
  CollapsePlanner planner_;
  CollapsePlan plan_;
};

}  // namespace

MaintainStatistics merge_edges(Transaction& transaction, const std::vector<TetId>& tets,
                               const MergeThresholds& thresholds, const Held& held, MergeCensus* census) {
  return EdgeMerger(transaction, thresholds, held, census).run(tets);
}

}  // namespace paper
}  // namespace v0
}  // namespace incise
