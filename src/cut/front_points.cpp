// SPDX-License-Identifier: Apache-2.0
#include "cut/front_points.h"

#include <algorithm>
#include <optional>

#include "cut/division.h"
#include "incise/geom/box.h"
#include "incise/geom/quality.h"

namespace incise::inline v0 {

namespace {

/// The border of a sheet turns where its direction changes by more than this cosine tells.
constexpr double kStraight = 0.94;
/// The front point inside keeps this barycentric share from every side.
constexpr double kInnerMargin = 0.08;

using Face = std::array<VertexId, 3>;

Face face_of(const Master& master, unsigned side) {
  const auto& k = kSideCorners[side];
  return {master.vertices[k[0]], master.vertices[k[1]], master.vertices[k[2]]};
}

/// Weights made positive, with sum 1.
template <std::size_t N>
std::array<double, N> normalised(std::array<double, N> weights) {
  double sum = 0;
  for (double& w : weights) sum += w = std::max(w, 0.0);
  for (double& w : weights) w = sum > 0 ? w / sum : 1.0 / static_cast<double>(N);
  return weights;
}

/// Weights of at least `margin`; what the others give for it, they give in proportion to what they have beyond it.
template <std::size_t N>
std::array<double, N> kept_off(std::array<double, N> weights, double margin) {
  double lacking = 0, excess = 0;
  for (const double w : weights) {
    (w < margin ? lacking : excess) += w < margin ? margin - w : w - margin;
  }
  for (double& w : weights) w = w < margin ? margin : w - (w - margin) * (lacking / excess);
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
      if (!needs_point(complex_[master], s)) {
        if (at != Master::kNone) drop(at);
      } else if (at == Master::kNone) {
        create(master, s);
      } else {
        refresh(at, face_of(complex_[master], s));
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
  void create(std::uint32_t master, unsigned side) {
    const Face face = face_of(complex_[master], side);
    auto pierced = find_piercing(face);
    if (!pierced) pierced = find_earlier_piercing(face);
    FrontPoint point;
    place(point, face, pierced ? *pierced : std::array<double, 3>{1.0, 1.0, 1.0});
    point.is_explained = pierced.has_value();
    point.tested = step_;
    point.masters = {master, complex_[master].behind[side]};
    guessed_ += pierced ? 0U : 1U;
    const std::uint32_t at = complex_.add_point(point);
    complex_[master].points[side] = at;
    if (const std::uint32_t behind = point.masters[1]; behind != Master::kNone) {
      const auto& sides = complex_[behind].behind;
      complex_[behind].points[static_cast<std::size_t>(std::find(sides.begin(), sides.end(), master) - sides.begin())] =
          at;
    }
    mark_dirty(point);
  }
  void refresh(std::uint32_t at, const Face& face) {
    FrontPoint& point = complex_.point(at);
    if (point.tested == step_) return;
    point.tested = step_;
    const auto pierced = find_piercing(face);
    if (!pierced) return;
    point.is_explained = true;
    FrontPoint moved = point;
    place(moved, face, *pierced);
    if ((moved.position - point.position).squaredNorm() <= rules_.reach * rules_.reach) return;
    point = moved;
    mark_dirty(point);
  }
  void place(FrontPoint& point, const Face& face, const std::array<double, 3>& weights) const {
    point.face = face;
    point.weights = normalised(weights);
    point.position = blend(mesh_, face, kept_off(point.weights, rules_.margin));
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
      set_corner(master, index, turn.key, blend(mesh_, master.vertices, kept_off(weights, kInnerMargin)));
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

void place_front_points(const TetMesh& mesh, double margin, ClosedComplex& complex) {
  for (std::uint32_t index = 0; index < complex.size(); ++index) {
    if (complex[index].split == nullptr) continue;
    for (const std::uint32_t at : complex[index].points) {
      if (at == Master::kNone) continue;
      FrontPoint& point = complex.point(at);
      const Vec3 place = blend(mesh, point.face, kept_off(point.weights, margin));
      if (place != point.position) point.position = place;
      if (!point.vertex.is_valid() || mesh.rest(point.vertex) != place) complex.mark_dirty(index);
    }
  }
}

}  // namespace incise::inline v0
