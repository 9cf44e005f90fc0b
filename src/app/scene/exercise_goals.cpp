// SPDX-License-Identifier: Apache-2.0
// What regions are is taken from the uncut mesh, as faces to which distances are measured; what became of them, from
// the walls and the pieces at the end.
#include "app/scene/exercise_goals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "incise/mesh/components.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr double kDividedSlack = 0.25;  // tolerances of depth: what an edge may leave of a layer
constexpr double kLeastWay = 1e-3;      // of the line's tolerance: a ray's first face is the skin itself

bool is_goal_region(const std::vector<std::int32_t>& regions, std::int32_t region) {
  return std::find(regions.begin(), regions.end(), region) != regions.end();
}

/// Where a ray passes through a triangle: the way to it; NaN where it does not.
double way_to(const std::array<Vec3, 3>& t, const Vec3& from, const Vec3& along) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const Vec3 u = t[1] - t[0], v = t[2] - t[0], p = along.cross(v);
  const double scale = u.dot(p);
  if (scale == 0) return kNone;
  const Vec3 s = from - t[0], q = s.cross(u);
  const double x = s.dot(p) / scale, y = along.dot(q) / scale;
  constexpr double kEdge = -1e-9;  // rays through an edge between two triangles meet one of them
  return x < kEdge || y < kEdge || x + y > 1 - kEdge ? kNone : v.dot(q) / scale;
}

}  // namespace

RegionFaces::RegionFaces(const std::vector<std::int32_t>& regions, const TetMesh& mesh) {
  points_.resize(mesh.vertex_slots(), Vec3::Zero());
  mesh.for_each_vertex([&](VertexId v) { points_[v.value] = mesh.rest(v); });
  std::vector<bool> is_rim(mesh.vertex_slots(), false);
  mesh.for_each_tet([&](TetId tet) {
    if (!is_goal_region(regions, mesh.region(tet))) return;
    for (unsigned s = 0; s < 4; ++s) {
      const auto link = mesh.links(tet)[s];
      if (!link.is_boundary() && is_goal_region(regions, mesh.region(link.side().tet()))) continue;
      const std::array<VertexId, 3> v = mesh.vertices(Side(tet, s));
      triangles_.push_back({v[0].value, v[1].value, v[2].value});
      for (const VertexId corner : v) is_rim[corner.value] = is_rim[corner.value] || !link.is_boundary();
    }
  });
  for (std::size_t i = 0; i < is_rim.size(); ++i) {
    if (is_rim[i]) rim_.push_back(points_[i]);
  }
  tree_ = TriangleTree(points_, triangles_);
}

double RegionFaces::distance(const Vec3& point) const {
  const TriangleTree::Hit hit = tree_.closest(point);
  return hit.is_valid() ? std::sqrt(hit.distance2) : std::numeric_limits<double>::infinity();
}

double RegionFaces::thickness(const Vec3& skin, const Vec3& inward) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const TriangleTree::Triangle& t : triangles_) {
    const std::array<Vec3, 3> corners = {points_[t[0]], points_[t[1]], points_[t[2]]};
    const bool leaves = (corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(inward) > 0;
    const double way = leaves ? way_to(corners, skin, inward) : -1;
    if (way > 0 && way < nearest) nearest = way;
  }
  return std::isfinite(nearest) ? nearest : std::numeric_limits<double>::quiet_NaN();
}

ExerciseGoals::ExerciseGoals(const Exercise& exercise, const TargetLine& line, const TetMesh& mesh)
    : exercise_(exercise), line_(line) {
  if (exercise.divide) {
    const RegionFaces faces(exercise.divide->stop_at, mesh);
    const double lift = kLeastWay * exercise.tolerances.line;
    for (std::size_t bin = 0; bin < TargetLine::kBins; ++bin) {
      const Vec3& normal = line.skin_normal(bin);
      thickness_.push_back(faces.thickness(line.skin_at(bin) - lift * normal, -normal) + lift);
    }
  }
  for (const ExerciseSpare& spare : exercise.spare) spared_.emplace_back(spare.stop_at, mesh);
  if (!exercise.remove) return;
  rim_ = RegionFaces(exercise.remove->stop_at, mesh).rim();
  mesh.for_each_tet([&](TetId tet) {
    if (is_goal_region(exercise.remove->stop_at, mesh.region(tet))) volume_ += mesh.rest_volume(tet);
  });
}

void ExerciseGoals::measure(const TetMesh& mesh, ExerciseScore& score) const {
  if (exercise_.divide) measure_divided(score);
  measure_wounds(mesh, score);
  if (exercise_.remove) measure_removed(mesh, score);
}

/// Where the layers do not lie under the line nothing is asked.
void ExerciseGoals::measure_divided(ExerciseScore& score) const {
  std::size_t bins = 0;
  for (std::size_t bin = 0; bin < TargetLine::kBins; ++bin) {
    const ExercisePlace& place = score.profile[bin];
    const double needed = thickness_[bin] - kDividedSlack * exercise_.tolerances.depth;
    if (place.is_cut && !line_.is_end(bin) && place.depth < needed) ++bins;
  }
  score.undivided_length = line_.length() * static_cast<double>(bins) / static_cast<double>(TargetLine::kBins);
}

void ExerciseGoals::measure_wounds(const TetMesh& mesh, ExerciseScore& score) const {
  for (const ExerciseSpare& spare : exercise_.spare) score.wounds.push_back({spare.name, 0, spare.depth, 0});
  if (spared_.empty()) return;
  for_each_boundary_side(mesh, [&](TetId tet, const std::array<VertexId, 3>& v, std::uint32_t tag) {
    if (tag == 0) return;
    for (std::size_t i = 0; i < spared_.size(); ++i) {
      if (!is_goal_region(exercise_.spare[i].stop_at, mesh.region(tet))) continue;
      const Vec3 &a = mesh.rest(v[0]), &b = mesh.rest(v[1]), &c = mesh.rest(v[2]);
      ExerciseWound& wound = score.wounds[i];
      wound.area += 0.25 * (b - a).cross(c - a).norm();
      for (const Vec3& point : {a, b, c, Vec3((a + b + c) / 3)}) {
        wound.depth = std::max(wound.depth, spared_[i].distance(point));
      }
    }
  });
}

namespace {

/// The piece other than the greatest that holds most of some regions.
struct FoundPiece {
  std::uint32_t label = 0;
  double held = 0;  ///< volume of those regions in it; 0: there is no such piece
};

FoundPiece piece_with(const std::vector<std::int32_t>& regions, const TetMesh& mesh, const Components& pieces) {
  std::vector<double> held(pieces.count(), 0.0);
  mesh.for_each_tet([&](TetId tet) {
    if (is_goal_region(regions, mesh.region(tet))) held[pieces.label[tet.value]] += mesh.rest_volume(tet);
  });
  const auto body = std::max_element(pieces.volume.begin(), pieces.volume.end()) - pieces.volume.begin();
  if (!held.empty()) held[static_cast<std::size_t>(body)] = 0;
  FoundPiece best;
  for (std::uint32_t label = 0; label < held.size(); ++label) {
    if (held[label] > best.held) best = {label, held[label]};
  }
  return best;
}

}  // namespace

void ExerciseGoals::measure_removed(const TetMesh& mesh, ExerciseScore& score) const {
  const Components pieces = find_components(mesh);
  const FoundPiece piece = piece_with(exercise_.remove->stop_at, mesh, pieces);
  ExerciseRemoved& removed = score.removed.emplace();
  removed.name = exercise_.remove->name;
  if (!(piece.held > 0)) return;
  removed.has_piece = true;
  removed.share = volume_ > 0 ? std::min(piece.held / volume_, 1.0) : 0;
  removed.volume = pieces.volume[piece.label];
  std::vector<Vec3> points(mesh.vertex_slots(), Vec3::Zero());
  std::vector<TriangleTree::Triangle> walls;
  mesh.for_each_vertex([&](VertexId v) { points[v.value] = mesh.rest(v); });
  for_each_boundary_side(mesh, [&](TetId tet, const std::array<VertexId, 3>& v, std::uint32_t tag) {
    if (tag > 0 && pieces.label[tet.value] == piece.label) walls.push_back({v[0].value, v[1].value, v[2].value});
  });
  const TriangleTree tree(points, walls);
  removed.margin_least = std::numeric_limits<double>::infinity();
  removed.margin_most = 0;
  for (const Vec3& point : rim_) {
    const double way = std::sqrt(tree.closest(point).distance2);
    removed.margin_least = std::min(removed.margin_least, way);
    removed.margin_most = std::max(removed.margin_most, way);
  }
}

}  // namespace app
}  // namespace v0
}  // namespace incise
