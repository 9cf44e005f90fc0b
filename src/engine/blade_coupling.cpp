// SPDX-License-Identifier: Apache-2.0
#include "engine/blade_coupling.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace incise {
inline namespace v0 {
namespace detail {

namespace {

constexpr double kGiveAt = 0.1;   // of the spacing: by how much the spring is pressed where the tissue yields
constexpr double kAhead = 0.05;   // of the spacing: how far ahead of the front the edge has hold of the tissue
constexpr double kBehind = 0.25;  // of the spacing: how far behind the front an edge is told to be that does not yield
constexpr double kSpan = 0.5;     // of the spacing: between points of the edge
constexpr double kLetGo = 0.5;    // of the spacing: withdrawn so far, the blade has let go of the tissue
constexpr std::size_t kMostSamples = 64;
constexpr std::size_t kMostTets = 200;  // that are looked at for material that has come into another tet

double resistance(const Material& material) {
  return material.toughness + material.cut_friction;
}

bool any_resists(const Materials& materials) {
  return resistance(materials.fallback) > 0 ||
         std::any_of(materials.by_region.begin(), materials.by_region.end(),
                     [](const Materials::Entry& entry) { return resistance(entry.material) > 0; });
}

Vec3 on_edge(const std::vector<Vec3>& edge, std::size_t segment, double share) {
  return edge[segment] + share * (edge[segment + 1] - edge[segment]);
}

}  // namespace

void BladeCoupling::begin(const BladePose& pose, const Materials& materials, double length_unit, double spacing) {
  materials_ = &materials;
  unit_ = length_unit;
  spacing_ = spacing;
  resists_ = any_resists(materials);
  direction_ = pose.direction.norm() > 0 ? Vec3(pose.direction.normalized()) : Vec3(Vec3::Zero());
  state_ = {};
  samples_.clear();
  if (resists_) sample(pose, spacing);
}

/// Points along the edge, its own among them: as many for all poses of the stroke.
void BladeCoupling::sample(const BladePose& pose, double spacing) {
  const std::size_t segments = pose.edge.size() - 1, most = std::max<std::size_t>(1, kMostSamples / segments);
  for (std::size_t i = 0; i < segments; ++i) {
    const double parts = (pose.edge[i + 1] - pose.edge[i]).norm() / (kSpan * spacing);
    const auto count = std::min(most, static_cast<std::size_t>(std::max(1.0, parts)));
    for (std::size_t k = 0; k < count; ++k) {
      Sample& s = samples_.emplace_back();
      s.segment = i;
      s.share = static_cast<double>(k) / static_cast<double>(count);
    }
  }
  Sample& last = samples_.emplace_back();
  last.segment = segments - 1;
  last.share = 1;
  for (Sample& s : samples_) s.place = s.before = s.cut = on_edge(pose.edge, s.segment, s.share);
}

void BladeCoupling::move_to(const BladePose& pose) {
  middle_ = Vec3::Zero();
  for (const Vec3& point : pose.edge) middle_ += point / static_cast<double>(pose.edge.size());
  Vec3 motion = Vec3::Zero();
  for (Sample& s : samples_) {
    s.before = s.place;
    s.place = on_edge(pose.edge, s.segment, s.share);
    motion += s.place - s.before;
  }
  if (pose.direction.norm() > 0) {
    direction_ = pose.direction.normalized();
  } else {  // along the edge nothing is cut
    const Vec3 chord = pose.edge.back() - pose.edge.front();
    const double chord2 = chord.squaredNorm();
    if (chord2 > 0) motion -= motion.dot(chord) / chord2 * chord;
    if (motion.norm() > 1e-9 * spacing_) direction_ = motion.normalized();
  }
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const double back = i > 0 ? (samples_[i].place - samples_[i - 1].place).norm() : 0;
    const double on = i + 1 < samples_.size() ? (samples_[i + 1].place - samples_[i].place).norm() : 0;
    samples_[i].length = 0.5 * (back + on) * unit_;
  }
}

/// N/m: pressed by `kGiveAt` of the spacing it bears what the tissue bears.
double BladeCoupling::stiffness(const Sample& sample) const {
  return sample.limit() / (kGiveAt * spacing_ * unit_);
}

TetId BladeCoupling::any_grip() const {
  const auto held = std::find_if(samples_.begin(), samples_.end(), [](const Sample& s) { return s.grip.has_value(); });
  return held == samples_.end() ? TetId() : held->grip->tet;
}

void BladeCoupling::grip(Sample& sample, const TissuePoint& point, const TetMesh& mesh) {
  sample.grip = point;
  sample.rest = point.place(mesh, BodyShape::kRest);
  const Material& material = materials_->of(mesh.region(point.tet));
  sample.toughness = material.toughness;
  sample.friction = material.cut_friction;
}

/// Points of the edge that were outside and are in tissue now.
void BladeCoupling::enter(const TetMesh& mesh) {
  std::vector<std::size_t> outside;
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (samples_[i].grip) continue;
    outside.push_back(i);
    places.push_back(samples_[i].place);
  }
  if (outside.empty()) return;
  const TetId near = any_grip();
  const auto found =
      near.is_valid() ? std::vector<std::optional<TissuePoint>>{} : find_tissue(mesh, BodyShape::kCurrent, places);
  for (std::size_t k = 0; k < outside.size(); ++k) {
    const auto inside = near.is_valid() ? walk_to(mesh, BodyShape::kCurrent, places[k], near) : found[k];
    if (inside) enter(samples_[outside[k]], *inside, mesh);
  }
}

/// Where the point's way met the tissue: there it takes hold, and has cut nothing yet.
void BladeCoupling::enter(Sample& sample, const TissuePoint& inside, const TetMesh& mesh) {
  double out = 0, in = 1;
  TissuePoint entry = inside;
  for (unsigned i = 0; i < 10; ++i) {
    const double half = 0.5 * (out + in);
    const auto found = walk_to(mesh, BodyShape::kCurrent, sample.cut + half * (sample.place - sample.cut), entry.tet);
    if (found) entry = *found;
    (found ? in : out) = half;
  }
  sample.cut += out * (sample.place - sample.cut);
  sample.ahead = direction_.dot(entry.place(mesh) - sample.cut);
  grip(sample, entry, mesh);
}

void BladeCoupling::press(const BladePose& pose, const TetMesh& mesh, std::vector<Pull>& pulls) {
  move_to(pose);
  enter(mesh);
  for (const Sample& s : samples_) {
    if (!s.grip || s.limit() <= 0) continue;
    Pull pull;
    pull.vertices = mesh.vertices(s.grip->tet);
    pull.weights = s.grip->weights;
    pull.axis = direction_;
    pull.target = s.place + s.ahead * direction_;
    pull.stiffness = stiffness(s);
    pull.pushes_only = true;
    pull.limit = s.limit();
    pulls.push_back(pull);
  }
}

/// What does not yield stays behind the front: the engine cuts on where the edge is ahead of it alone.
BladePose BladeCoupling::yield(const TetMesh& mesh) {
  state_ = {};
  const double most = kGiveAt * spacing_;
  for (Sample& s : samples_) {
    s.force_before = std::exchange(s.force, 0.0);
    s.has_slipped = !s.grip;
    s.retreat = 0;
    if (!s.grip) continue;
    const double lag = direction_.dot(s.place - s.grip->place(mesh)) + s.ahead;
    const double pressed = std::min(most, std::max(lag, 0.0));
    s.has_slipped = lag > most;
    s.retreat = s.has_slipped ? most : std::max(lag, 0.0) + s.ahead + kBehind * spacing_;
    s.force = stiffness(s) * pressed * unit_;
    account(s);
  }
  retreat_outside();
  BladePose pose;
  pose.direction = direction_;
  for (Sample& s : samples_) {
    s.cut = s.place - s.retreat * direction_;
    pose.edge.push_back(s.cut);
    if (s.grip && direction_.dot(s.place - s.grip->place(mesh)) + s.ahead < -kLetGo * spacing_) s.grip.reset();
  }
  return pose;
}

/// Points outside the tissue go with the nearest one inside: the edge between them would cut where nothing bears it.
void BladeCoupling::retreat_outside() {
  const auto go_with = [](Sample& sample, const Sample& before) {
    if (!sample.grip) sample.retreat = std::max(sample.retreat, before.retreat);
  };
  for (std::size_t i = 1; i < samples_.size(); ++i) go_with(samples_[i], samples_[i - 1]);
  for (std::size_t i = samples_.size() - 1; i > 0; --i) go_with(samples_[i - 1], samples_[i]);
}

void BladeCoupling::account(Sample& sample) {
  const double way = direction_.dot(sample.place - sample.before) * unit_;
  state_.touches = state_.touches || sample.force > 0;
  state_.yields = state_.yields || sample.has_slipped;
  state_.engaged_length += sample.length;
  state_.force -= sample.force * direction_;
  state_.tool_work += 0.5 * (sample.force + sample.force_before) * way;
  if (sample.has_slipped) state_.friction_work += sample.friction * sample.length * std::max(way, 0.0);
}

void BladeCoupling::pay_for(double area) {
  double toughness = 0, length = 0;
  for (const Sample& s : samples_) {
    if (!s.has_slipped || s.length <= 0 || s.limit() <= 0) continue;
    toughness += s.toughness * s.length;
    length += s.length;
  }
  if (length > 0) state_.fracture_work += toughness / length * area * unit_ * unit_;
}

void BladeCoupling::take_hold(const TetMesh& mesh, std::span<const TetId> fresh) {
  for (Sample& s : samples_) {
    if (s.grip) take_hold(s, mesh, fresh);
  }
}

/// What has not slipped keeps its material, in whichever tet that is now.
void BladeCoupling::take_hold(Sample& sample, const TetMesh& mesh, std::span<const TetId> fresh) {
  if (!sample.has_slipped && sample.grip->holds(mesh)) {
    grip(sample, *sample.grip, mesh);
    return;
  }
  const BodyShape shape = sample.has_slipped ? BodyShape::kCurrent : BodyShape::kRest;
  const Vec3 place = sample.has_slipped ? Vec3(sample.cut + kAhead * spacing_ * direction_) : sample.rest;
  auto found = find_among(mesh, shape, place, fresh);
  if (!found) found = find_around(mesh, shape, place, sample.grip->vertices, kMostTets);
  sample.grip.reset();
  if (!found) return;
  if (sample.has_slipped) sample.ahead = kAhead * spacing_;
  grip(sample, *found, mesh);
}

HapticSnapshot BladeCoupling::snapshot(const Solver& solver, const TetMesh& mesh) const {
  HapticSnapshot snapshot;
  Mat3 stiffness = Mat3::Zero();
  double limit = 0, friction = 0, held = 0;
  for (const Sample& s : samples_) {
    if (!s.grip) continue;
    held += 1;
    snapshot.contact_point += unit_ * s.cut;
    limit += s.toughness * s.length;
    friction += s.friction * s.length;
    for (unsigned i = 0; i < 4; ++i) {
      stiffness += s.grip->weights[i] * s.grip->weights[i] * solver.local_stiffness(mesh.vertices(s.grip->tet)[i]);
    }
  }
  if (held == 0 || direction_.isZero(0)) return snapshot;
  snapshot.touches = true;
  snapshot.tool_position = unit_ * middle_;
  snapshot.ruptured = state_.yields;
  snapshot.contact_point /= held;
  snapshot.force = state_.force;
  stiffness.diagonal().array() += 1e-6 * stiffness.trace() + 1e-6;  // no compliance at all would mean a rigid wall
  const Eigen::FullPivLU<Mat3> lu(stiffness);
  if (lu.isInvertible()) snapshot.compliance = lu.inverse();
  snapshot.compliance = (0.5 * (snapshot.compliance + snapshot.compliance.transpose())).eval();
  snapshot.cutting_direction = direction_;
  const Vec3 chord = samples_.back().place - samples_.front().place;
  const Vec3 normal = direction_.cross(chord);
  snapshot.flat_normal = normal.norm() > 0 ? Vec3(normal.normalized()) : Vec3(direction_.unitOrthogonal());
  snapshot.engaged_length = state_.engaged_length;
  snapshot.toughness = state_.engaged_length > 0 ? limit / state_.engaged_length : 0;
  snapshot.cut_friction = state_.engaged_length > 0 ? friction / state_.engaged_length : 0;
  return snapshot;
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
