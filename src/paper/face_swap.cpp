// SPDX-License-Identifier: Apache-2.0
#include "paper/face_swap.h"

#include <algorithm>
#include <iterator>

#include "incise/mesh/remesh.h"
#include "incise/mesh/star.h"
#include "paper/paper_stage.h"

namespace incise {
inline namespace v0 {
namespace paper {

namespace {

class FaceSwapper : private PaperStage {
 public:
  explicit FaceSwapper(Transaction& transaction) : PaperStage(transaction) {}

  MaintainStatistics run(const std::vector<TetId>& tets) {
    for (const TetId tet : tets) {
      if (mesh_.is_live(tet) && !swap_a_face(tet)) {
        swap_an_edge(tet);
      }
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
    if (!(worst_after(plan) < worst_before(plan))) {
      return false;
    }
    apply(transaction_, plan, produced_);
    return true;
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

  std::vector<TetId> produced_;
};

}  // namespace

MaintainStatistics swap_faces(Transaction& transaction, const std::vector<TetId>& tets) {
  return FaceSwapper(transaction).run(tets);
}

}  // namespace paper
}  // namespace v0
}  // namespace incise
