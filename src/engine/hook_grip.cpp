// SPDX-License-Identifier: Apache-2.0
// A ball takes the vertices inside it. A grip on the surface grows from triangle to triangle by the way along edges,
// so that it never leaps over a lip; each vertex then hangs on a spring of its own.
#include "engine/hook_grip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <set>
#include <utility>

#include "engine/constants.h"
#include "incise/geom/closest.h"

namespace incise {
inline namespace v0 {
namespace detail {
namespace {

/// All vertices in the ball; where there is none, the nearest one.
std::vector<VertexId> in_ball(const TetMesh& mesh, std::span<const Vec3> positions, const Hook& hook) {
  std::vector<VertexId> found;
  VertexId nearest;
  double least = 0;
  mesh.for_each_vertex([&](VertexId v) {
    if (!mesh.tet_of(v).is_valid()) return;
    const double distance2 = (positions[v.value] - hook.position).squaredNorm();
    if (!nearest.is_valid() || distance2 < least) {
      nearest = v;
      least = distance2;
    }
    if (distance2 <= hook.radius * hook.radius) found.push_back(v);
  });
  if (found.empty() && nearest.is_valid()) found.push_back(nearest);
  return found;
}

/// Grows over the surface from the place that a hook takes hold of, from triangle to triangle over the edges that they
/// share. Skin goes on over skin, a wall over the same wall: where they meet is a lip, and where two walls meet is the
/// end of the cut. So the other side of a wound is reached only around the end of the cut, which is a long way: the way
/// along the edges, and not the distance through the air, has to be within the radius.
class SurfaceGrowth {
 public:
  SurfaceGrowth(const TetMesh& mesh, std::span<const Vec3> positions, const Hook& hook)
      : mesh_(mesh), positions_(positions), hook_(hook) {
    collect();
    link();
  }

  std::vector<VertexId> run() {
    const std::size_t first = nearest();
    if (first == facets_.size()) return {};
    add(first);
    while (!queue_.empty()) {
      const auto [way, v] = queue_.top();
      queue_.pop();
      if (way > ways_.at(v)) continue;
      if (reached_.insert(v).second) spread_from(v, way);
    }
    if (reached_.empty()) reached_.insert(nearest_corner(facets_[first]));
    return {reached_.begin(), reached_.end()};
  }

 private:
  struct Facet {
    std::array<VertexId, 3> corners;
    std::uint32_t tag = 0;  // 0: skin
    Vec3 normal = Vec3::Zero();
    std::array<std::size_t, 3> across{};  // over the edge after each corner; as many as there are facets: nothing
    bool is_reached = false;
  };
  using Edge = std::pair<VertexId, VertexId>;

  [[nodiscard]] const Vec3& at(VertexId v) const { return positions_[v.value]; }
  [[nodiscard]] double distance2(const Facet& f) const {
    return closest_on_triangle(hook_.position, at(f.corners[0]), at(f.corners[1]), at(f.corners[2])).distance2;
  }

  /// The whole surface; the nearest place may be anywhere.
  void collect() {
    mesh_.for_each_tet([&](TetId tet) {
      for (unsigned s = 0; s < 4; ++s) {
        const Link link = mesh_.links(tet)[s];
        if (!link.is_boundary()) continue;
        Facet f;
        f.corners = mesh_.vertices(Side(tet, s));
        f.tag = link.tag();
        f.normal = (at(f.corners[1]) - at(f.corners[0])).cross(at(f.corners[2]) - at(f.corners[0]));
        facets_.push_back(f);
      }
    });
  }

  /// Seen from outside two neighbours run along their edge in opposite directions.
  void link() {
    std::map<Edge, std::size_t> by_edge;
    for (std::size_t i = 0; i < facets_.size(); ++i) {
      if (!(distance2(facets_[i]) <= hook_.radius * hook_.radius)) continue;
      for (unsigned k = 0; k < 3; ++k) by_edge.emplace(edge_of(facets_[i], k), i);
    }
    for (Facet& f : facets_) {
      for (unsigned k = 0; k < 3; ++k) {
        const auto [from, to] = edge_of(f, k);
        const auto found = by_edge.find({to, from});
        f.across[k] = found != by_edge.end() && goes_on(f, facets_[found->second]) ? found->second : facets_.size();
      }
    }
  }
  static Edge edge_of(const Facet& f, unsigned k) { return {f.corners[k], f.corners[(k + 1) % 3]}; }
  /// The walls of a cut meet back to back where it ends.
  static bool goes_on(const Facet& a, const Facet& b) {
    return (a.tag == 0) == (b.tag == 0) && (a.tag == 0 || a.normal.dot(b.normal) > 0);
  }

  /// Skin before a wall that is as near, as both are at a lip.
  [[nodiscard]] std::size_t nearest() const {
    std::array<std::size_t, 2> found{facets_.size(), facets_.size()};  // skin, wall
    std::array<double, 2> least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < facets_.size(); ++i) {
      const std::size_t kind = facets_[i].tag == 0 ? 0 : 1;
      const double distance = distance2(facets_[i]);
      if (!(distance < least[kind])) continue;
      found[kind] = i;
      least[kind] = distance;
    }
    if (found[0] == facets_.size()) return found[1];
    return std::sqrt(least[0]) <= std::sqrt(least[1]) + kSkinFirst * hook_.radius ? found[0] : found[1];
  }

  /// A facet that is reached: its corners are, from the place itself for the first one.
  void add(std::size_t index) {
    Facet& f = facets_[index];
    if (std::exchange(f.is_reached, true)) return;
    const bool is_first = ways_.empty();
    for (const VertexId v : f.corners) {
      of_vertex_[v].push_back(index);
      if (is_first) {
        reach(v, (at(v) - hook_.position).norm());
      } else if (reached_.count(v) > 0) {
        for (const VertexId w : f.corners) reach(w, ways_.at(v) + (at(w) - at(v)).norm());
      }
    }
  }
  void spread_from(VertexId v, double way) {
    const std::vector<std::size_t> around = of_vertex_[v];
    for (const std::size_t index : around) {
      for (const VertexId w : facets_[index].corners) reach(w, way + (at(w) - at(v)).norm());
    }
    // Over the edges of this vertex alone: an edge is crossed where one of its ends is reached.
    for (std::size_t i = 0; i < of_vertex_[v].size(); ++i) {
      const Facet f = facets_[of_vertex_[v][i]];
      for (unsigned k = 0; k < 3; ++k) {
        const auto [from, to] = edge_of(f, k);
        if ((from == v || to == v) && f.across[k] < facets_.size()) add(f.across[k]);
      }
    }
  }
  void reach(VertexId v, double way) {
    if (!(way <= hook_.radius)) return;
    const auto [known, is_new] = ways_.emplace(v, way);
    if (!is_new && !(way < known->second)) return;
    known->second = way;
    queue_.emplace(way, v);
  }
  [[nodiscard]] VertexId nearest_corner(const Facet& f) const {
    return *std::min_element(f.corners.begin(), f.corners.end(), [&](VertexId a, VertexId b) {
      const double to_a = (at(a) - hook_.position).squaredNorm(), to_b = (at(b) - hook_.position).squaredNorm();
      return to_a < to_b || (to_a == to_b && a < b);
    });
  }

  const TetMesh& mesh_;
  std::span<const Vec3> positions_;
  const Hook& hook_;
  std::vector<Facet> facets_;
  std::map<VertexId, std::vector<std::size_t>> of_vertex_;  // reached facets
  std::map<VertexId, double> ways_;
  std::set<VertexId> reached_;
  // The shortest way first; of equal ones the lowest id.
  std::priority_queue<std::pair<double, VertexId>, std::vector<std::pair<double, VertexId>>, std::greater<>> queue_;
};

std::vector<VertexId> vertices_of(const TetMesh& mesh, std::span<const Vec3> positions, const Hook& hook) {
  if (hook.reach == HookReach::kSurface) return SurfaceGrowth(mesh, positions, hook).run();
  return in_ball(mesh, positions, hook);
}

}  // namespace

HookGrip::HookGrip(const TetMesh& mesh, std::span<const Vec3> positions, const Hook& hook) {
  for (const VertexId v : vertices_of(mesh, positions, hook)) {
    held_.push_back({v, mesh.generation(v), positions[v.value] - hook.position});
  }
}

void HookGrip::add_to(const TetMesh& mesh, const Hook& hook, std::vector<Pull>& pulls) {
  first_pull_ = pulls.size();
  closed_ += std::clamp(hook.closed - closed_, -kJawsPerFrame, kJawsPerFrame);
  const bool is_limited = std::isfinite(hook.strength);
  const auto is_gone = [&](const Held& held) {
    return !mesh.is_live(held.vertex) || mesh.generation(held.vertex) != held.generation;
  };
  if (is_limited) std::erase_if(held_, is_gone);
  for (const Held& held : held_) {
    if (is_gone(held)) continue;
    Pull pull;
    pull.vertices[0] = held.vertex;
    pull.target = hook.position + (1 - closed_) * held.offset;
    pull.stiffness = hook.stiffness;
    if (is_limited && !hook.tears) pull.limit = hook.strength / static_cast<double>(held_.size());
    pulls.push_back(pull);
  }
  pulls_ = pulls.size() - first_pull_;
  springs_.clear();
  if (is_limited) springs_.assign(pulls.begin() + static_cast<std::ptrdiff_t>(first_pull_), pulls.end());
}

/// What slips stays behind by as much as the springs are stretched too far: that takes energy, as friction does.
bool HookGrip::give_way(const Solver& solver, const Hook& hook, double length_unit) {
  if (springs_.empty()) return false;
  if (hook.tears) {
    if (!(force(solver).norm() > hook.strength)) return false;
    held_.clear();
    return true;
  }
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    const Pull& spring = springs_[i];
    const Vec3 off = solver.positions()[spring.vertices[0].value] - spring.target;
    const double most = spring.limit / (spring.stiffness * length_unit), length = off.norm();
    if (length > most) held_[i].offset += (1 - most / length) / (1 - closed_) * off;
  }
  return false;
}

Vec3 HookGrip::force(const Solver& solver) const {
  Vec3 force = Vec3::Zero();
  for (std::size_t i = 0; i < pulls_; ++i) force -= solver.pull_force(first_pull_ + i);
  return force;
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
