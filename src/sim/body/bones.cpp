// SPDX-License-Identifier: Apache-2.0
// The fit of a shape to points is that of shape matching (Müller et al. 2005), weighted by mass: it keeps their centre,
// and to first order their angular momentum.
#include "sim/body/bones.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "sim/body/body_state.h"
#include "sim/body/constants.h"
#include "sim/body/turning.h"

namespace incise {
inline namespace v0 {
namespace detail {

namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// The turning in a sum of products: its polar factor. None where it is flat or turned inside out.
Mat3 turning_of(const Mat3& products) {
  Mat3 turn = products / products.norm();
  for (unsigned i = 0; i < kBoneTurnRounds; ++i) {
    if (!(turn.determinant() > 1e-18)) return Mat3::Identity();
    const Mat3 other = turn.inverse().transpose();
    const double scale = std::sqrt(other.norm() / turn.norm());
    turn = (0.5 * (scale * turn + other / scale)).eval();
  }
  return turn;
}

Vec3 place_of(const DeformableBody::State& s, std::uint32_t slot) {
  const float* x = s.single(VertexId(slot));
  return {static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
}

void put(DeformableBody::State& s, std::uint32_t slot, const Vec3& place) {
  for (unsigned i = 0; i < 3; ++i) s.single(VertexId(slot))[i] = static_cast<float>(place.data()[i]);
}

/// Where a shape is: `place_at(slot)` are the points that it is fitted to.
struct Pose {
  Vec3 rest_centre = Vec3::Zero(), centre = Vec3::Zero();
  Mat3 turn = Mat3::Identity();

  template <class PlaceAt>
  Pose(const DeformableBody::State& s, const std::vector<std::uint32_t>& vertices, const PlaceAt& place_at) {
    double mass = 0;
    for (const std::uint32_t v : vertices) {
      const double m = s.mass_of(VertexId(v));
      mass += m;
      rest_centre += m * s.rest[VertexId(v)];
      centre += m * place_at(v);
    }
    rest_centre /= mass;
    centre /= mass;
    Mat3 products = Mat3::Zero();
    for (const std::uint32_t v : vertices) {
      products += s.mass_of(VertexId(v)) * (place_at(v) - centre) * (s.rest[VertexId(v)] - rest_centre).transpose();
    }
    turn = turning_of(products);
  }

  [[nodiscard]] Vec3 of(const Vec3& rest) const { return centre + turn * (rest - rest_centre); }
};

Mat3 matrix_of(const std::array<double, 6>& upper) {
  Mat3 m;
  m << upper[0], upper[1], upper[2], upper[1], upper[3], upper[4], upper[2], upper[4], upper[5];
  return m;
}

}  // namespace

void Bones::find(DeformableBody::State& s) {
  std::vector<std::uint32_t> to_settle;
  for (const Bone& bone : bones_) {
    for (const std::uint32_t v : bone.vertices) {
      if (v >= s.motions.size()) continue;
      s.motions[VertexId(v)].is_rigid = false;
      if (is_fixed(VertexId(v))) to_settle.push_back(v);
    }
  }
  bones_.clear();
  fixed_.resize(s.places.size());
  std::fill(fixed_.begin(), fixed_.end(), std::uint8_t{0});
  std::vector<std::uint8_t> is_seen(s.places.size(), 0);
  std::vector<std::uint32_t> stack;
  const auto take = [&](VertexId v) {
    if (is_seen[v.value] != 0) return;
    is_seen[v.value] = 1;
    stack.push_back(v.value);
  };
  for (std::uint32_t t = 0; t < s.tets.size(); ++t) {
    const TetVertices& seeds = s.tets[TetId(t)];
    if (!seeds[0].is_valid() || !s.is_bone(TetId(t)) || is_seen[seeds[0].value] != 0) continue;
    Bone& bone = bones_.emplace_back();
    take(seeds[0]);
    while (!stack.empty()) {
      const VertexId v(stack.back());
      stack.pop_back();
      bone.vertices.push_back(v.value);
      bone.is_held = bone.is_held || s.held[v] == Held::kRigidly;
      s.stars.for_each_tet(v, [&](TetId other) {
        if (!s.is_bone(other)) return;
        for (const VertexId w : s.tets[other]) take(w);
      });
    }
    std::sort(bone.vertices.begin(), bone.vertices.end());
    for (const std::uint32_t v : bone.vertices) {
      bool is_outer = false;
      s.stars.for_each_tet(VertexId(v), [&](TetId other) { is_outer = is_outer || !s.is_bone(other); });
      bone.is_outer.push_back(is_outer ? 1 : 0);
      s.motions[VertexId(v)].is_rigid = true;
      fixed_[VertexId(v)] = bone.is_held ? 1 : 0;
      if (bone.is_held) to_settle.push_back(v);
    }
  }
  s.bones_changed = false;
  for (const std::uint32_t v : to_settle) {
    if (v < s.places.size()) s.settle_vertex(VertexId(v));
  }
}

void Bones::wake(DeformableBody::State& s) const {
  for (const Bone& bone : bones_) {
    if (bone.is_held) continue;
    const auto is_awake = [&](std::uint32_t v) { return s.order.is_awake(VertexId(v)); };
    const auto awake = static_cast<std::size_t>(std::count_if(bone.vertices.begin(), bone.vertices.end(), is_awake));
    if (awake == 0 || awake == bone.vertices.size()) continue;
    for (const std::uint32_t v : bone.vertices) s.order.wake(VertexId(v));
  }
}

void Bones::begin(const DeformableBody::State& s) {
  awake_.clear();
  for (std::uint32_t i = 0; i < bones_.size(); ++i) {
    const auto moves = [&](std::uint32_t v) { return s.order.moves(VertexId(v)) && s.order.is_awake(VertexId(v)); };
    if (std::all_of(bones_[i].vertices.begin(), bones_[i].vertices.end(), moves)) awake_.push_back(i);
  }
}

void Bones::straighten(DeformableBody::State& s) const {
  for (const std::uint32_t i : awake_) {
    const Pose pose(s, bones_[i].vertices, [&](std::uint32_t v) { return place_of(s, v); });
    for (const std::uint32_t v : bones_[i].vertices) put(s, v, pose.of(s.rest[VertexId(v)]));
  }
}

void Bones::settle(DeformableBody::State& s) const {
  for (const std::uint32_t i : awake_) {
    const Pose pose(s, bones_[i].vertices, [&](std::uint32_t v) { return Vec3(s.places[v] - s.middle); });
    for (const std::uint32_t v : bones_[i].vertices) {
      s.places[v] = s.middle + pose.of(s.rest[VertexId(v)]);
      s.round_place(VertexId(v));
    }
  }
}

void Bones::make_rigid(const DeformableBody::State& s, std::span<std::array<float, 4>> steps) const {
  const auto step_of = [&](std::uint32_t v) {
    return Vec3(static_cast<double>(steps[v][0]), static_cast<double>(steps[v][1]), static_cast<double>(steps[v][2]));
  };
  for (const std::uint32_t i : awake_) {
    double mass = 0;
    Vec3 centre = Vec3::Zero(), shift = Vec3::Zero(), spin = Vec3::Zero();
    for (const std::uint32_t v : bones_[i].vertices) {
      const double m = s.mass_of(VertexId(v));
      mass += m;
      centre += m * place_of(s, v);
      shift += m * step_of(v);
    }
    centre /= mass;
    shift /= mass;
    Mat3 inertia = Mat3::Zero();
    for (const std::uint32_t v : bones_[i].vertices) {
      const double m = s.mass_of(VertexId(v));
      const Vec3 arm = place_of(s, v) - centre;
      spin += m * arm.cross(step_of(v));
      inertia += m * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
    }
    const Vec3 turn = turn_for(spin, inertia);
    for (const std::uint32_t v : bones_[i].vertices) {
      const Vec3 step = shift + turn.cross(place_of(s, v) - centre);
      for (unsigned k = 0; k < 3; ++k) steps[v][k] = static_cast<float>(step.data()[k]);
    }
  }
}

namespace {

/// One bone's energy by its six unknowns, about its centre of inertia.
class BoneVisit {
 public:
  BoneVisit(DeformableBody::State& s, std::span<const std::uint32_t> vertices, std::span<const std::uint8_t> is_outer)
      : s_(s), vertices_(vertices), is_outer_(is_outer) {
    double weight = 0;
    for (const std::uint32_t v : vertices_) {
      from_.push_back(place_of(s_, v));
      weight += s_.motions[VertexId(v)].weight;
      centre_ += s_.motions[VertexId(v)].weight * from_.back();
      reach_ += static_cast<double>(s_.motions[VertexId(v)].reach) / static_cast<double>(vertices_.size());
    }
    centre_ /= weight;
  }

  /// To where Newton's step leads, or along it to where the slope vanishes: the vertices' own curvatures alone are
  /// known, and what joins two vertices of a bone may be a few times as stiff, or as soft.
  void run() {
    sum();
    Vec6 step = -curvature_.ldlt().solve(slope_);
    double farthest = 0;
    for (const Vec3& x : from_) farthest = std::max(farthest, move_of(step, x).norm());
    if (!std::isfinite(farthest) || !(farthest > 0)) return;
    step *= std::min(1.0, kFarthestVisit * reach_ / farthest);
    const double at_start = slope_.dot(step);
    if (!(at_start < 0)) return;
    go(step, 1);
    sum();
    const double at_end = slope_along(step), bend = at_end - at_start;
    if (!std::isfinite(at_end)) return go(step, 0);
    if (bend > 0) go(step, std::min(2.0, -at_start / bend));
  }

 private:
  [[nodiscard]] static Vec3 arm_move(const Vec6& step, const Vec3& arm) {
    return step.head<3>() + step.tail<3>().cross(arm);
  }
  [[nodiscard]] Vec3 move_of(const Vec6& step, const Vec3& x) const { return arm_move(step, x - centre_); }

  /// Slope and curvature as the bone stands, about where its centre was.
  void sum() {
    slope_.setZero();
    curvature_.setZero();
    slopes_.clear();
    const Descent d = s_.descent();
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      const std::uint32_t v = vertices_[i];
      const Motion& motion = s_.motions[VertexId(v)];
      const Vec3 x = place_of(s_, v), arm = x - centre_;
      Vec3 slope;
      Mat3 bend = motion.weight * Mat3::Identity();
      if (is_outer_[i] != 0 || motion.pulls > 0 || motion.contacts > 0) {
        const Quadratic q = quadratic_of(d, s_.rows.of(VertexId(v)));
        slope = Vec3(q.slope[0], q.slope[1], q.slope[2]);
        bend = matrix_of(q.curvature);
      } else {
        for (unsigned k = 0; k < 3; ++k) {
          slope.data()[k] =
              motion.weight * (x.data()[k] - static_cast<double>(motion.start[k]) - static_cast<double>(motion.aim[k]));
        }
      }
      add(arm, slope, bend);
      slopes_.push_back(slope);
    }
  }
  void add(const Vec3& arm, const Vec3& slope, const Mat3& bend) {
    Mat3 cross;
    cross << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
    slope_.head<3>() += slope;
    slope_.tail<3>() += arm.cross(slope);
    const Mat3 by_turn = cross * bend;
    curvature_.topLeftCorner<3, 3>() += bend;
    curvature_.bottomLeftCorner<3, 3>() += by_turn;
    curvature_.topRightCorner<3, 3>() += by_turn.transpose();
    curvature_.bottomRightCorner<3, 3>() -= by_turn * cross;
  }

  /// Where the bone stands after a whole step.
  [[nodiscard]] double slope_along(const Vec6& step) const {
    double along = 0;
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      const Vec3 arm = place_of(s_, vertices_[i]) - centre_ - step.head<3>();
      along += slopes_[i].dot(arm_move(step, arm));
    }
    return along;
  }

  void go(const Vec6& step, double share) {
    const Mat3 turn = turning_by(share * step.tail<3>());
    const Vec3 centre = centre_ + share * step.head<3>();
    for (std::size_t i = 0; i < vertices_.size(); ++i) put(s_, vertices_[i], centre + turn * (from_[i] - centre_));
    s_.find_pressures();
  }

  DeformableBody::State& s_;
  std::span<const std::uint32_t> vertices_;
  std::span<const std::uint8_t> is_outer_;
  std::vector<Vec3> from_, slopes_;
  Vec3 centre_ = Vec3::Zero();
  double reach_ = 0;
  Vec6 slope_ = Vec6::Zero();
  Mat6 curvature_ = Mat6::Zero();
};

}  // namespace

void Bones::visit(DeformableBody::State& s) const {
  for (const std::uint32_t i : awake_) BoneVisit(s, bones_[i].vertices, bones_[i].is_outer).run();
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
