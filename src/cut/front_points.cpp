// SPDX-License-Identifier: Apache-2.0
// A face's point is computed from its corners in the order of their slots, and so is the same from both sides. Margins
// push it along the line in which the sheet passes through the face, and only then off it (docs/internals.md, 3.6).
#include "cut/front_points.h"

#include <algorithm>
#include <optional>

#include "cut/constants.h"
#include "cut/division.h"
#include "cut/spacing.h"
#include "cut/weights.h"
#include "incise/geom/box.h"
#include "incise/geom/quality.h"

namespace incise {
inline namespace v0 {

namespace {

using Face = std::array<VertexId, 3>;

/// The corners of a side, ascending: the same from both masters, so that what is computed from them is, too.
Face face_of(const Master& master, unsigned side) {
  const auto& k = kSideCorners[side];
  Face face = {master.vertices[k[0]], master.vertices[k[1]], master.vertices[k[2]]};
  std::sort(face.begin(), face.end());
  return face;
}

double mean_edge(const TetMesh& mesh, const Face& face) {
  return ((mesh.rest(face[0]) - mesh.rest(face[1])).norm() + (mesh.rest(face[1]) - mesh.rest(face[2])).norm() +
          (mesh.rest(face[2]) - mesh.rest(face[0])).norm()) /
         3.0;
}

/// Barycentric weights of a place in the plane of a face; they need not be positive.
std::array<double, 3> weights_of(const TetMesh& mesh, const Face& face, const Vec3& x) {
  const Vec3 &a = mesh.rest(face[0]), &b = mesh.rest(face[1]), &c = mesh.rest(face[2]);
  const Vec3 normal = (b - a).cross(c - a);
  const double area2 = normal.squaredNorm();
  const double wb = normal.dot((a - c).cross(x - c)) / area2, wc = normal.dot((b - a).cross(x - a)) / area2;
  return {1.0 - wb - wc, wb, wc};
}

/// How the weights of a point in a face change along a sheet with this normal, per mean edge; zero where the sheet lies
/// in the face.
std::array<double, 3> slide_along(const TetMesh& mesh, const Face& face, const Vec3& sheet_normal) {
  const Vec3 &a = mesh.rest(face[0]), &b = mesh.rest(face[1]), &c = mesh.rest(face[2]);
  const Vec3 along = sheet_normal.cross((b - a).cross(c - a));
  const double length = along.norm();
  if (!(length > 0)) return {};
  const Vec3 step = along * (mean_edge(mesh, face) / length);
  const std::array<double, 3> end = weights_of(mesh, face, a + step);
  return {end[0] - 1.0, end[1], end[2]};
}

/// Weights moved along `slide` by as little as gives each at least `margin`, but by no more than `most`.
std::array<double, 3> slid(std::array<double, 3> weights, const std::array<double, 3>& slide, double margin,
                           double most) {
  double lo = -most, hi = most;
  for (unsigned k = 0; k < 3; ++k) {
    const double lacking = margin - weights[k];
    if (slide[k] > 0) lo = std::max(lo, lacking / slide[k]);
    if (slide[k] < 0) hi = std::min(hi, lacking / slide[k]);
  }
  const double by = lo <= hi ? std::clamp(0.0, lo, hi) : std::clamp(0.5 * (lo + hi), -most, most);
  for (unsigned k = 0; k < 3; ++k) weights[k] += by * slide[k];
  return weights;
}

/// Weights made positive, with sum 1.
template <std::size_t N>
std::array<double, N> normalised(std::array<double, N> weights) {
  double sum = 0;
  for (double& w : weights) sum += w = std::max(w, 0.0);
  for (double& w : weights) w = sum > 0 ? w / sum : 1.0 / static_cast<double>(N);
  return weights;
}

template <std::size_t N>
Vec3 blend(const TetMesh& mesh, const std::array<VertexId, N>& vertices, const std::array<double, N>& weights) {
  Vec3 point = Vec3::Zero();
  for (std::size_t k = 0; k < N; ++k) point += weights[k] * mesh.rest(vertices[k]);
  return point;
}

/// The points where the border of a strip turns.
std::vector<SosPoint> turns_of(const Strip& strip) {
  struct End {
    SosPoint at;
    Vec3 outwards;
  };
  std::vector<End> ends;
  for (const Strip::Segment& s : strip.border) {
    const Vec3 along = (s[1].position - s[0].position).normalized();
    ends.push_back({s[0], along});
    ends.push_back({s[1], -along});
  }
  std::sort(ends.begin(), ends.end(), [](const End& x, const End& y) { return x.at.key < y.at.key; });
  std::vector<SosPoint> turns;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const bool is_pair = ends[i].at.key == ends[i + 1].at.key;
    if (is_pair && !(ends[i].outwards.dot(ends[i + 1].outwards) < -kStraight)) turns.push_back(ends[i].at);
    i += is_pair ? 1U : 0U;
  }
  return turns;
}

/// Where a segment passes through a face, in its barycentric coordinates.
std::array<double, 3> piercing_weights(const TetMesh& mesh, const Face& face, const Strip::Segment& segment) {
  const Vec3 a = mesh.rest(face[0]), b = mesh.rest(face[1]), c = mesh.rest(face[2]);
  const Vec3 normal = (b - a).cross(c - a);
  const Vec3 &p = segment[0].position, &q = segment[1].position;
  const double from = normal.dot(p - a), to = normal.dot(q - a);
  const double t = from == to ? 0.5 : std::clamp(from / (from - to), 0.0, 1.0);
  const Vec3 x = p + t * (q - p);
  return {normal.dot((c - b).cross(x - b)), normal.dot((a - c).cross(x - c)), normal.dot((b - a).cross(x - a))};
}

class PointUpdate {
 public:
  PointUpdate(const TetMesh& mesh, const OwnSheet& sheet, const FrontRules& rules, std::uint32_t step,
              ClosedComplex& complex)
      : mesh_(mesh),
        sheet_(sheet),
        strip_(*sheet.strips().back()),
        rules_(rules),
        step_(step),
        complex_(complex),
        turns_(turns_of(strip_)) {
    for (const Strip::Segment& segment : strip_.border) {
      boxes_.push_back(
          {segment[0].position.cwiseMin(segment[1].position), segment[0].position.cwiseMax(segment[1].position)});
    }
  }

  void visit(std::uint32_t master) {
    if (Divider::is_cone(complex_[master])) update_corner(complex_[master], master);
    for (unsigned s = 0; s < 4; ++s) {
      const std::uint32_t at = complex_[master].points[s];
      if (!is_odd_side(complex_[master], s)) {
        if (at != Master::kNone) drop(at);
      } else if (at == Master::kNone) {
        if (!is_beside_what_was_let_go(complex_[master], s)) create(master, s);
      } else {
        refresh(at, master, s);
      }
    }
  }
  [[nodiscard]] std::uint64_t guessed() const { return guessed_; }

 private:
  void mark_dirty(const FrontPoint& point) {
    for (const std::uint32_t master : point.masters) {
      if (master != Master::kNone) complex_.mark_dirty(master);
    }
  }
  void drop(std::uint32_t at) {
    mark_dirty(complex_.point(at));
    complex_.remove_point(at);
  }
  /// Whether the tet behind a side is no master any more, so that the side keeps the shape that it has.
  [[nodiscard]] bool is_beside_what_was_let_go(const Master& master, unsigned side) const {
    return master.behind[side] == Master::kNone && !complex_.outside(mesh_, master, side).is_boundary();
  }
  /// Where the cut ends in a side.
  struct End {
    bool is_inside = false;   ///< it ends there: there is to be a point
    bool is_pierced = false;  ///< by this strip or an earlier one; else the place is the middle
    std::array<double, 3> weights{};
  };
  [[nodiscard]] End end_in(const Master& master, unsigned side, const Face& face) const {
    auto pierced = find_piercing(face);
    if (!pierced) pierced = find_earlier_piercing(face);
    if (!pierced) return {has_split_on(master, side), false, {1.0 / 3, 1.0 / 3, 1.0 / 3}};
    const std::array<double, 3> weights = normalised(*pierced);
    const bool is_open = has_split_on(master, side) || is_off_edges(master, side, face, weights);
    return {is_open && !lies_in_older_cut(master, side, face, weights), true, weights};
  }
  /// Whether a place in a side without split edges lies off the edges at the vertices that stand for its crossings.
  [[nodiscard]] static bool is_off_edges(const Master& master, unsigned side, const Face& face,
                                         const std::array<double, 3>& weights) {
    const auto is_off = [&](VertexId on) {
      for (unsigned k = 0; k < 3; ++k) {
        if (face[k] != on && weights[k] <= kLeastOpen) return false;
      }
      return true;
    };
    for (const unsigned e : kSideEdges[side]) {
      if (((unsigned{master.flagged} >> e) & 1U) == 0) continue;
      for (const unsigned c : kEdgeCorners[e]) {
        if (((unsigned{master.on} >> c) & 1U) != 0 && !is_off(master.vertices[c])) return false;
      }
    }
    return true;
  }
  [[nodiscard]] bool lies_in_older_cut(const Master& master, unsigned side, const Face& face,
                                       const std::array<double, 3>& weights) const {
    if (rules_.older == nullptr || !rules_.older->exist()) return false;
    const double edge = uncut_length(mean_edge(mesh_, face), rules_.spacing);
    return rules_.older->pass(blend(mesh_, face, weights), crossing_normal(master, side), rules_.beside * edge,
                              kBeyondRim * edge);
  }
  /// The sheet's normal where it crosses an edge of a side: that of the edge with the lowest number.
  [[nodiscard]] Vec3 crossing_normal(const Master& master, unsigned side) const {
    std::uint32_t lowest = kInvalidIndex;
    for (const unsigned e : kSideEdges[side]) {
      if (((unsigned{master.flagged} >> e) & 1U) != 0) lowest = std::min(lowest, master.edges[e]);
    }
    return complex_.edges()[lowest].normal;
  }
  void create(std::uint32_t master, unsigned side) {
    const Face face = face_of(complex_[master], side);
    const End end = end_in(complex_[master], side, face);
    if (!end.is_inside) return;
    FrontPoint point;
    place(point, face, end.weights, crossing_normal(complex_[master], side));
    point.is_explained = end.is_pierced;
    point.tested = step_;
    point.masters = {master, complex_[master].behind[side]};
    guessed_ += end.is_pierced ? 0U : 1U;
    const std::uint32_t at = complex_.add_point(point);
    complex_[master].points[side] = at;
    if (const std::uint32_t behind = point.masters[1]; behind != Master::kNone) {
      const auto& sides = complex_[behind].behind;
      complex_[behind].points[static_cast<std::size_t>(std::find(sides.begin(), sides.end(), master) - sides.begin())] =
          at;
    }
    mark_dirty(point);
  }
  void refresh(std::uint32_t at, std::uint32_t master, unsigned side) {
    FrontPoint& point = complex_.point(at);
    if (point.tested == step_ || point.is_final) return;
    point.tested = step_;
    const Face face = face_of(complex_[master], side);
    const End end = end_in(complex_[master], side, face);
    if (!end.is_inside) {
      drop(at);
      return;
    }
    const auto pierced = find_piercing(face);
    if (!pierced) return;
    point.is_explained = true;
    FrontPoint moved = point;
    place(moved, face, normalised(*pierced), crossing_normal(complex_[master], side));
    const bool stays = (moved.position - point.position).squaredNorm() <= rules_.reach * rules_.reach;
    if (stays) moved.position = point.position;  // for now: where it belongs is asked again at the end
    point = moved;
    if (!stays) mark_dirty(point);
  }
  void place(FrontPoint& point, const Face& face, const std::array<double, 3>& weights, const Vec3& normal) const {
    point.face = face;
    point.weights = weights;
    point.pierced = blend(mesh_, face, weights);
    point.slide = slide_along(mesh_, face, normal);
    point.position = blend(mesh_, face, kept_off(weights, rules_.margin));
  }
  /// Notes the turn of the border inside a master that lies deepest in it. One noted before stays, unless this strip
  /// has its point and found that the border does not turn there any more.
  void update_corner(Master& master, std::uint32_t index) {
    double deepest = 0;
    for (const SosPoint& turn : turns_) {
      const std::array<double, 4> weights = weights_in(master, turn.position);
      const double depth = *std::min_element(weights.begin(), weights.end());
      if (depth <= deepest) continue;
      deepest = depth;
      set_corner(master, index, turn.key, turn.position);
    }
    const auto& points = strip_.surface.points;
    if (deepest == 0 && master.corner_key != 0 &&
        std::any_of(points.begin(), points.end(), [&](const SosPoint& p) { return p.key == master.corner_key; })) {
      set_corner(master, index, 0, Vec3::Zero());
    }
  }
  void set_corner(Master& master, std::uint32_t index, std::uint64_t key, const Vec3& place) {
    if (master.corner_key == key && master.corner == place) return;
    master.corner_key = key;
    master.corner = place;
    complex_.mark_dirty(index);
  }
  [[nodiscard]] std::array<double, 4> weights_in(const Master& master, const Vec3& x) const {
    std::array<Vec3, 4> p;
    for (unsigned c = 0; c < 4; ++c) p[c] = mesh_.rest(master.vertices[c]);
    const double whole = signed_volume6(p[0], p[1], p[2], p[3]);
    return {signed_volume6(x, p[1], p[2], p[3]) / whole, signed_volume6(p[0], x, p[2], p[3]) / whole,
            signed_volume6(p[0], p[1], x, p[3]) / whole, signed_volume6(p[0], p[1], p[2], x) / whole};
  }
  /// Where the strip's border passes through a face: the last of its segments that does.
  [[nodiscard]] std::optional<std::array<double, 3>> find_piercing(const Face& face) const {
    const SosPoint a{mesh_.rest(face[0]), face[0].value}, b{mesh_.rest(face[1]), face[1].value},
        c{mesh_.rest(face[2]), face[2].value};
    const Box box{a.position.cwiseMin(b.position).cwiseMin(c.position),
                  a.position.cwiseMax(b.position).cwiseMax(c.position)};
    for (std::size_t i = strip_.border.size(); i-- > 0;) {
      const Strip::Segment& segment = strip_.border[i];
      if (boxes_[i].overlaps(box) && segment_crosses_triangle(segment[0], segment[1], a, b, c)) {
        return piercing_weights(mesh_, face, segment);
      }
    }
    return std::nullopt;
  }

  /// The same for what earlier strips left of the border.
  [[nodiscard]] std::optional<std::array<double, 3>> find_earlier_piercing(const Face& face) const {
    const SosPoint a{mesh_.rest(face[0]), face[0].value}, b{mesh_.rest(face[1]), face[1].value},
        c{mesh_.rest(face[2]), face[2].value};
    for (std::size_t i = sheet_.border().size() - strip_.border.size(); i-- > 0;) {
      const Strip::Segment& segment = sheet_.border()[i];
      if (segment_crosses_triangle(segment[0], segment[1], a, b, c)) return piercing_weights(mesh_, face, segment);
    }
    return std::nullopt;
  }

  const TetMesh& mesh_;
  const OwnSheet& sheet_;
  const Strip& strip_;
  const FrontRules& rules_;
  std::uint32_t step_;
  ClosedComplex& complex_;
  std::vector<SosPoint> turns_;
  std::vector<Box> boxes_;
  std::uint64_t guessed_ = 0;
};

}  // namespace

std::uint64_t update_front_points(const TetMesh& mesh, const OwnSheet& sheet, std::span<const std::uint32_t> masters,
                                  const FrontRules& rules, std::uint32_t step, ClosedComplex& complex) {
  PointUpdate update(mesh, sheet, rules, step, complex);
  for (const std::uint32_t master : masters) update.visit(master);
  return update.guessed();
}

namespace {

/// The place in the plane of a face where the sheet passes, nearest to `place`: one step, exact for a plane sheet.
Vec3 back_on_sheet(const TetMesh& mesh, const OwnSheet& sheet, const Face& face, const Vec3& place) {
  const std::array<double, 3> weights = weights_of(mesh, face, place);
  const Vec3 flat = blend(mesh, face, weights);
  const double edge = mean_edge(mesh, face);
  const SheetPlace hit = sheet.closest(flat, edge);
  if (!hit.is_valid()) return flat;
  const Vec3 normal = (mesh.rest(face[1]) - mesh.rest(face[0])).cross(mesh.rest(face[2]) - mesh.rest(face[0]));
  const Vec3 across = hit.normal - (hit.normal.dot(normal) / normal.squaredNorm()) * normal;
  const double slope = across.dot(hit.normal);
  return slope > 0.1 ? Vec3(flat - (hit.normal.dot(flat - hit.point) / slope) * across) : flat;
}

}  // namespace

void place_front_points(const TetMesh& mesh, const OwnSheet& sheet, const Wake& wake, double margin,
                        ClosedComplex& complex) {
  const auto is_near = [&](VertexId v) { return wake.is_near(v); };
  for (const std::uint32_t index : wake.settling()) {
    for (const std::uint32_t at : complex[index].points) {
      if (at == Master::kNone || complex.point(at).is_final) continue;
      FrontPoint& point = complex.point(at);
      if (std::any_of(point.face.begin(), point.face.end(), is_near)) continue;
      if (blend(mesh, point.face, point.weights) != point.pierced) {  // a vertex of the face has moved
        point.pierced = back_on_sheet(mesh, sheet, point.face, point.pierced);
        point.weights = normalised(weights_of(mesh, point.face, point.pierced));
      }
      const std::array<double, 3> weights = slid(point.weights, point.slide, margin, kMostSlide);
      const Vec3 place = blend(mesh, point.face, kept_off(normalised(weights), kLeastMargin));
      if (place != point.position) point.position = place;
      point.is_final = true;
      if (point.vertex.is_valid() && mesh.rest(point.vertex) == place) continue;
      for (const std::uint32_t master : point.masters) {
        if (master != Master::kNone) complex.mark_dirty(master);
      }
    }
  }
}

}  // namespace v0
}  // namespace incise
