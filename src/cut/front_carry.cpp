// SPDX-License-Identifier: Apache-2.0
// A stroke that starts where another ended and is shorter than an element: the front goes on, nothing is cut anew.
#include "cut/front_carry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "cut/blade_constants.h"
#include "cut/old_children.h"
#include "incise/geom/box.h"
#include "incise/geom/quality.h"
#include "incise/mesh/star.h"

namespace incise {
inline namespace v0 {

namespace {

/// A place beside a blade that moves on.
struct BladePlace {
  Vec3 on;          ///< the nearest point of the blade as it stands now
  Vec3 along;       ///< the blade's direction there, unit
  double behind;    ///< how far the place is behind the blade
  double distance;  ///< from `on`
  bool is_beside;   ///< in the sheet between both
};

class FrontCarrier {
 public:
  FrontCarrier(Transaction& transaction, const SurfaceIndex& surface, std::span<const Vec3> from,
               std::span<const Vec3> to, double spacing)
      : transaction_(transaction),
        mesh_(transaction.mesh()),
        surface_(surface),
        from_(from),
        to_(to),
        spacing_(spacing) {}

  double run() {
    find();
    for (unsigned round = 0; round < kCarryRounds; ++round) {
      bool has_moved = false;
      for (const VertexId vertex : front_) has_moved |= carry(vertex);
      if (!has_moved) break;
    }
    double left = 0;
    for (const VertexId vertex : front_) {
      const BladePlace place = place_beside(mesh_.rest(vertex));
      if (place.is_beside) left = std::max(left, place.behind);
    }
    return left;
  }

 private:
  /// The vertices of the front between where the blade was and where it is.
  void find() {
    const Vec3 margin = Vec3::Constant(kCarryBehind * spacing_);
    for (std::size_t c = 0; c + 1 < to_.size(); ++c) {
      Box box;
      for (const Vec3& p : {from_[c], from_[c + 1], to_[c], to_[c + 1]}) box.extend(p);
      surface_.for_each_near(mesh_, {box.lo - margin, box.hi + margin}, [&](Side side) {
        if (mesh_.link(side).tag() == 0) return;
        for (const VertexId v : mesh_.vertices(side)) {
          const unsigned bits = mesh_.shape_of(v) & (shape::kFront | shape::kPinched);
          if (bits == shape::kFront && place_beside(mesh_.rest(v)).is_beside) front_.push_back(v);
        }
      });
    }
    std::sort(front_.begin(), front_.end());
    front_.erase(std::unique(front_.begin(), front_.end()), front_.end());
  }
  [[nodiscard]] BladePlace place_beside(const Vec3& x) const {
    BladePlace best{};
    best.distance = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c + 1 < to_.size(); ++c) {
      const Vec3 edge = to_[c + 1] - to_[c];
      const double length2 = edge.squaredNorm();
      if (!(length2 > 0)) continue;
      const double t = std::clamp(edge.dot(x - to_[c]) / length2, 0.0, 1.0);
      const Vec3 on = to_[c] + t * edge;
      const double distance = (x - on).norm();
      if (!(distance < best.distance)) continue;
      const Vec3 way = on - (from_[c] + t * (from_[c + 1] - from_[c]));
      const double travel = way.norm();
      best = {on, edge / std::sqrt(length2), 0.0, distance, false};
      if (!(travel > 0)) continue;
      const Vec3 normal = best.along.cross(way).normalized();
      const Vec3 ahead = normal.cross(best.along);
      best.behind = (on - x).dot(ahead);
      const double beside = std::abs((on - x).dot(normal)), past = std::abs((on - x).dot(best.along));
      best.is_beside = best.behind > kCarriedThere * spacing_ &&
                       best.behind <= way.dot(ahead) + kCarryBehind * spacing_ && beside <= kCarryBeside * spacing_ &&
                       past <= kCarriedThere * spacing_;
    }
    return best;
  }
  /// The way of a vertex of the front to the blade, in the skin where it is part of that, and such that the star keeps
  /// its volume: the walls of an older cut need not lie on each other any more. None where that would lead elsewhere.
  [[nodiscard]] std::optional<Vec3> way_of(VertexId vertex, const BladePlace& place,
                                           std::span<const TetId> star) const {
    const Vec3 x = mesh_.rest(vertex);
    Vec3 way = place.on - x, growth = Vec3::Zero();
    for (const TetId tet : star) growth -= area_of(Side(tet, mesh_.corner_of(tet, vertex)));
    if ((mesh_.shape_of(vertex) & shape::kSkin) != 0) {
      const std::optional<Vec3> normal = skin_normal(vertex, star);
      if (!normal) return std::nullopt;
      const double slope = place.along.dot(*normal);
      if (!(std::abs(slope) > kLeastSlope)) return std::nullopt;
      way -= (normal->dot(way) / slope) * place.along;
      growth -= normal->dot(growth) * *normal;
    }
    const double length2 = growth.squaredNorm();
    if (!(length2 > 0)) return way;
    const Vec3 across = (way.dot(growth) / length2) * growth;
    const double volume6 = std::abs(way.dot(growth));
    double whole6 = 0;
    for (const TetId tet : star) whole6 += mesh_.rest_volume6(tet);
    if (volume6 <= kCarriedVolume * whole6) return way;
    if (across.squaredNorm() > kMostAcross * kMostAcross * way.squaredNorm()) return std::nullopt;
    return way - across;
  }
  /// Twice the area of a side, as a vector that leads out of its tet.
  [[nodiscard]] Vec3 area_of(Side side) const {
    const auto v = mesh_.vertices(side);
    return (mesh_.rest(v[1]) - mesh_.rest(v[0])).cross(mesh_.rest(v[2]) - mesh_.rest(v[0]));
  }
  /// The skin's normal at a vertex, where it is flat enough to slide in.
  [[nodiscard]] std::optional<Vec3> skin_normal(VertexId vertex, std::span<const TetId> star) const {
    Vec3 sum = Vec3::Zero();
    double area = 0;
    for (const TetId tet : star) {
      for (unsigned s = 0; s < 4; ++s) {
        const Link link = mesh_.links(tet)[s];
        if (!link.is_boundary() || link.tag() != 0 || mesh_.vertices(tet)[s] == vertex) continue;
        const Vec3 side = area_of(Side(tet, s));
        sum += side;
        area += side.norm();
      }
    }
    if (!(sum.norm() > kFlatSkin * area)) return std::nullopt;
    return sum.normalized();
  }
  bool carry(VertexId vertex) {
    const BladePlace place = place_beside(mesh_.rest(vertex));
    if (!place.is_beside) return false;
    const std::vector<TetId>& star = walker_.star(mesh_, vertex);
    const auto is_other = [&](TetId tet) { return mesh_.region(tet) != mesh_.region(star.front()); };
    if (std::any_of(star.begin(), star.end(), is_other)) return false;  // a border between regions stays
    const std::optional<Vec3> way = way_of(vertex, place, star);
    if (!way) return false;
    for (const double share : {1.0, 0.5, 0.25, 0.1}) {
      const Vec3 moved = mesh_.rest(vertex) + share * *way;
      if (!allows(vertex, moved, star)) continue;
      MaterialPlace best;
      for (const TetId tet : star) {
        const MaterialPlace in = place_in(mesh_, tet, moved);
        if (in.inside > best.inside) best = in;
      }
      if (!stands(vertex, current_after_move(mesh_, vertex, moved, best.basis, best.weights), star)) continue;
      transaction_.move(vertex, moved, best.basis, best.weights);
      return true;
    }
    return false;
  }
  [[nodiscard]] bool allows(VertexId vertex, const Vec3& moved, std::span<const TetId> star) const {
    double before = 0, after = 0;
    for (const TetId tet : star) {
      std::array<Vec3, 4> old, p;
      for (unsigned c = 0; c < 4; ++c) {
        const VertexId v = mesh_.vertices(tet)[c];
        old[c] = mesh_.rest(v);
        p[c] = v == vertex ? moved : old[c];
      }
      const double lr = longest_edge_over_inradius(p[0], p[1], p[2], p[3]);
      if (!(lr <= kWorstLr || lr < longest_edge_over_inradius(old[0], old[1], old[2], old[3]))) return false;
      before += signed_volume6(old[0], old[1], old[2], old[3]);
      after += signed_volume6(p[0], p[1], p[2], p[3]);
    }
    return std::abs(after - before) <= 10 * kCarriedVolume * before;
  }
  /// Whether tets that stand upright now stay so.
  [[nodiscard]] bool stands(VertexId vertex, const Vec3& moved, std::span<const TetId> star) const {
    return std::all_of(star.begin(), star.end(), [&](TetId tet) {
      std::array<Vec3, 4> now, p;
      for (unsigned c = 0; c < 4; ++c) {
        const VertexId v = mesh_.vertices(tet)[c];
        now[c] = mesh_.current(v);
        p[c] = v == vertex ? moved : now[c];
      }
      return signed_volume6(p[0], p[1], p[2], p[3]) > 0 || !(signed_volume6(now[0], now[1], now[2], now[3]) > 0);
    });
  }

  Transaction& transaction_;
  const TetMesh& mesh_;
  const SurfaceIndex& surface_;
  std::span<const Vec3> from_, to_;
  double spacing_;
  std::vector<VertexId> front_;
  StarWalker walker_;
};

}  // namespace

double carry_front(Transaction& transaction, const SurfaceIndex& surface, std::span<const Vec3> from,
                   std::span<const Vec3> to, double spacing) {
  return FrontCarrier(transaction, surface, from, to, spacing).run();
}

}  // namespace v0
}  // namespace incise
