// SPDX-License-Identifier: Apache-2.0
// Algorithm 3 line by line; a move that would turn a tet over has infinite quality (docs/paper_map.md, section 3.2).
#include "paper/smart_laplacian.h"

#include "improve/standing.h"
#include "incise/mesh/verbs.h"
#include "paper/paper_classes.h"
#include "paper/paper_region.h"
#include "paper/paper_stage.h"

namespace incise {
inline namespace v0 {
namespace paper {

namespace {

class InsideSmoother : private PaperStage {
 public:
  InsideSmoother(Transaction& transaction, const Held& held) : PaperStage(transaction, held) {}

  /// Algorithm 3.
  MaintainStatistics run(const std::vector<VertexId>& vertices) {
    for (const VertexId v : vertices) {
      if (mesh_.is_live(v) && classes_.classify(mesh_, v) == VertexClass::kInside && smooth(v)) {
        ++done_.moved_vertices;
      }
    }
    return done();
  }

 private:
  /// Lines 2 to 6 for one vertex.
  bool smooth(VertexId v) {
    star_ = walker_.star(mesh_, v);
    const Vec3 centre = centre_of_neighbours(v);
    if (!(average_quality(v, centre) < average_quality(v, mesh_.rest(v)))) {
      return false;
    }
    const MoveVertexPlan plan = plan_move_vertex(mesh_, v, centre);
    if (!plan || !may_move(mesh_, v, centre, star_)) return false;
    apply(transaction_, plan);
    return true;
  }
  /// Equation 1.
  [[nodiscard]] Vec3 centre_of_neighbours(VertexId v) const {
    const std::vector<VertexId> vertices = find_corners_of(mesh_, star_);
    Vec3 sum = Vec3::Zero();
    for (const VertexId other : vertices) {
      if (other != v) sum += mesh_.rest(other);
    }
    return sum / static_cast<double>(vertices.size() - 1);
  }
  /// Infinite where a tet would turn over, so that such a place is never better.
  double average_quality(VertexId v, const Vec3& place) {
    double sum = 0;
    for (const TetId tet : star_) {
      sum += meter_.of_moved(tet, v, place);
    }
    return sum / static_cast<double>(star_.size());
  }

  ClassFinder classes_{&held_};
  std::vector<TetId> star_;
};

}  // namespace

MaintainStatistics smooth_inside(Transaction& transaction, const std::vector<VertexId>& vertices, const Held& held) {
  return InsideSmoother(transaction, held).run(vertices);
}

}  // namespace paper
}  // namespace v0
}  // namespace incise
