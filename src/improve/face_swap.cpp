// SPDX-License-Identifier: Apache-2.0
#include "improve/face_swap.h"

#include <algorithm>

#include "improve/paper_quality.h"
#include "incise/mesh/remesh.h"

namespace incise::inline v0::paper {

namespace {

class FaceSwapper {
 public:
  explicit FaceSwapper(Transaction& transaction)
      : transaction_(transaction), mesh_(transaction.mesh()), meter_(transaction.mesh()) {}

  MaintainStatistics run(const std::vector<TetId>& tets) {
    for (const TetId tet : tets) {
      if (mesh_.is_live(tet) && !swap_a_face(tet)) {
        swap_an_edge(tet);
      }
    }
    done_.work_units = meter_.evaluations();
    return done_;
  }

 private:
  /// Two tets become three.
  bool swap_a_face(TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (swap(plan_swap_23(mesh_, Side(tet, s)))) {
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
      if (swap(plan_swap_32(mesh_, v[a], v[b], tet))) {
        ++done_.removed_edges;
        return true;
      }
    }
    return false;
  }
  bool swap(const RemeshPlan& plan) {
    if (!plan || !(worst_after(plan) < worst_before(plan))) {
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

  Transaction& transaction_;
  const TetMesh& mesh_;
  QualityMeter meter_;
  std::vector<TetId> produced_;
  MaintainStatistics done_;
};

}  // namespace

MaintainStatistics swap_faces(Transaction& transaction, const std::vector<TetId>& tets) {
  return FaceSwapper(transaction).run(tets);
}

}  // namespace incise::inline v0::paper
