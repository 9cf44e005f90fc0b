// SPDX-License-Identifier: Apache-2.0
// Each tet tries its faces, its edges, then its flat pairs; a swap is a remesh plan, kept where its worst tet is
// better and nothing that it makes is there already (docs/paper_map.md, section 3.3).
#include "paper/face_swap.h"

#include <algorithm>
#include <iterator>

#include "improve/standing.h"
#include "incise/geom/predicates.h"
#include "incise/mesh/remesh.h"
#include "incise/mesh/star.h"
#include "paper/paper_stage.h"

namespace incise {
inline namespace v0 {
namespace paper {

namespace {

class FaceSwapper : private PaperStage {
 public:
  FaceSwapper(Transaction& transaction, const Held& held) : PaperStage(transaction, held) {}

  MaintainStatistics run(const std::vector<TetId>& tets) {
    for (const TetId tet : tets) {
      static_cast<void>(mesh_.is_live(tet) && (swap_a_face(tet) || swap_an_edge(tet) || swap_a_flat_pair(tet)));
    }
    return done();
  }

 private:
  /// Two tets become three.
  bool swap_a_face(TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      const RemeshPlan plan = plan_swap_23(mesh_, Side(tet, s));
      if (plan && !exists({plan.produced[0].vertices[2], plan.produced[0].vertices[3]}) && swap(plan)) {
        ++done_.removed_faces;
        return true;
      }
    }
    return false;
  }
  /// Three tets become two.
  bool swap_an_edge(TetId tet) {
    const TetVertices v = mesh_.vertices(tet);
    for (const auto& [a, b] : kEdgeCorners) {
      const RemeshPlan plan = plan_swap_32(mesh_, v[a], v[b], tet);
      if (plan && !exists(shared_face(plan)) && swap(plan)) {
        ++done_.removed_edges;
        return true;
      }
    }
    return false;
  }
  /// Two tets become two others: a pair whose outer faces at an edge lie in one plane, on the boundary; inside the body
  /// four become four, the pair and the one behind that plane.
  bool swap_a_flat_pair(TetId tet) {
    const TetVertices v = mesh_.vertices(tet);
    return std::any_of(kEdgeCorners.begin(), kEdgeCorners.end(), [&](const auto& edge) {
      const VertexId a = v[edge[0]], b = v[edge[1]];
      find_edge_ring(mesh_, a, b, tet, ring_);
      if (!has_one_region()) return false;
      if (!ring_.is_closed) return ring_.tets.size() == 2 && has_one_tag(a, b) && turn(a, b, 0, 2, {{0, 1, 2}});
      return ring_.tets.size() == 4 &&
             (turn(a, b, 0, 2, {{0, 1, 2}, {0, 2, 3}}) || turn(a, b, 1, 3, {{0, 1, 3}, {1, 2, 3}}));
    });
  }
  /// Puts the edge between two vertices of the ring in place of (a, b), if the four lie in one plane.
  bool turn(VertexId a, VertexId b, std::size_t i, std::size_t j, const std::vector<RingTriangle>& triangles) {
    const VertexId p = ring_.vertices[i], q = ring_.vertices[j];
    if (!is_flat(a, b, p, q) || exists({p, q})) return false;
    RemeshPlan plan;
    fill_edge_removal(mesh_, a, b, ring_, triangles, plan);
    const bool is_positive = std::all_of(plan.produced.begin(), plan.produced.end(), [&](const NewTet& tet) {
      const TetVertices& v = tet.vertices;
      return orient3d(mesh_.rest(v[0]), mesh_.rest(v[1]), mesh_.rest(v[2]), mesh_.rest(v[3])) > 0;
    });
    if (!is_positive || !swap(plan)) return false;
    ++done_.removed_edges;
    return true;
  }
  /// Whether (a, b, p) and (b, a, q) lie in one plane, and beside each other.
  [[nodiscard]] bool is_flat(VertexId a, VertexId b, VertexId p, VertexId q) const {
    const Vec3 &at = mesh_.rest(a), along = mesh_.rest(b) - at;
    const Vec3 n = along.cross(mesh_.rest(p) - at), m = (mesh_.rest(q) - at).cross(along);
    return n.dot(m) > 0 && n.cross(m).squaredNorm() <= kFlatSine * kFlatSine * n.squaredNorm() * m.squaredNorm();
  }
  [[nodiscard]] bool has_one_region() const {
    return std::all_of(ring_.tets.begin(), ring_.tets.end(),
                       [&](TetId tet) { return mesh_.region(tet) == mesh_.region(ring_.tets.front()); });
  }
  /// Whether the boundary faces at the edge of an open ring carry one tag.
  [[nodiscard]] bool has_one_tag(VertexId a, VertexId b) const {
    const auto tag_at = [&](TetId tet) {
      std::uint32_t tag = 0;
      for (unsigned s = 0; s < 4; ++s) {
        const Link link = mesh_.links(tet)[s];
        const VertexId opposite = mesh_.vertices(tet)[s];
        if (link.is_boundary() && opposite != a && opposite != b) tag = link.tag() + 1;
      }
      return tag;
    };
    return tag_at(ring_.tets.front()) == tag_at(ring_.tets.back());
  }
  /// The three corners that the two tets of a 3-2 swap have in common.
  static std::vector<VertexId> shared_face(const RemeshPlan& plan) {
    const TetVertices &first = plan.produced[0].vertices, &second = plan.produced[1].vertices;
    std::vector<VertexId> shared;
    std::copy_if(first.begin(), first.end(), std::back_inserter(shared),
                 [&](VertexId v) { return std::find(second.begin(), second.end(), v) != second.end(); });
    return shared;
  }
  /// Whether some tet has all of these corners. Where a cut ends inside, its two lips share vertices, and the edge or
  /// face that a swap makes on one lip may be there already, on the other.
  bool exists(const std::vector<VertexId>& corners) {
    const std::vector<TetId>& star = walker_.star(mesh_, corners.front());
    return std::any_of(star.begin(), star.end(), [&](TetId tet) {
      return std::all_of(corners.begin(), corners.end(), [&](VertexId v) { return mesh_.corner_of(tet, v) < 4; });
    });
  }
  bool swap(const RemeshPlan& plan) {
    const bool is_held =
        std::any_of(plan.consumed.begin(), plan.consumed.end(), [&](TetId tet) { return held_.holds(mesh_, tet); });
    if (is_held || !(worst_after(plan) < worst_before(plan)) || !keeps_standing(plan)) {
      return false;
    }
    apply(transaction_, plan, produced_);
    return true;
  }
  /// Whether no tet would stand inside out where none does now.
  [[nodiscard]] bool keeps_standing(const RemeshPlan& plan) const {
    return std::all_of(plan.produced.begin(), plan.produced.end(),
                       [&](const NewTet& tet) { return is_sound_now(mesh_, tet.vertices); }) ||
           !std::all_of(plan.consumed.begin(), plan.consumed.end(),
                        [&](TetId tet) { return is_sound_now(mesh_, mesh_.vertices(tet)); });
  }
  double worst_before(const RemeshPlan& plan) {
    double worst = 0;
    for (const TetId tet : plan.consumed) worst = std::max(worst, meter_.of(tet));
    return worst;
  }
  double worst_after(const RemeshPlan& plan) {
    double worst = 0;
    for (const NewTet& tet : plan.produced) worst = std::max(worst, meter_.of(tet.vertices));
    return worst;
  }

  EdgeRing ring_;
  std::vector<TetId> produced_;
};

}  // namespace

MaintainStatistics swap_faces(Transaction& transaction, const std::vector<TetId>& tets, const Held& held) {
  return FaceSwapper(transaction, held).run(tets);
}

}  // namespace paper
}  // namespace v0
}  // namespace incise
