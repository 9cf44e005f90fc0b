// SPDX-License-Identifier: Apache-2.0
// Points along the edge have hold of material ahead of the front; springs on the vertices around it slip at what the
// material bears, and what has slipped pays for the way that the front goes on (docs/coupling.md).
#include "engine/blade_coupling.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/constants.h"
#include "incise/mesh/bounds.h"

namespace incise {
inline namespace v0 {
namespace detail {

namespace {

double resistance(const Material& material) {
  return material.toughness + material.cut_friction;
}

bool any_resists(const Materials& materials) {
  return resistance(materials.fallback) > 0 ||
         std::any_of(materials.by_region.begin(), materials.by_region.end(),
                     [](const Materials::Entry& entry) { return resistance(entry.material) > 0; });
}

/// Of a way, what is across an axis of any length.
Vec3 across(const Vec3& way, const Vec3& axis) {
  const double length2 = axis.squaredNorm();
  return length2 > 0 ? Vec3(way - way.dot(axis) / length2 * axis) : way;
}

Vec3 on_edge(const std::vector<Vec3>& edge, std::size_t segment, double share) {
  return edge[segment] + share * (edge[segment + 1] - edge[segment]);
}

}  // namespace

void BladeCoupling::begin(const BladePose& pose, const TetMesh& mesh, const Materials& materials, double length_unit,
                          double spacing) {
  materials_ = &materials;
  unit_ = length_unit;
  spacing_ = spacing;
  resists_ = any_resists(materials);
  direction_ = pose.direction.norm() > 0 ? Vec3(pose.direction.normalized()) : Vec3(Vec3::Zero());
  state_ = {};
  samples_.clear();
  if (!resists_) return;
  const Box box = rest_bounds(mesh);
  const double widest = std::min(kWidestZone * (box.hi - box.lo).minCoeff(), kMostZoneReach * spacing);
  widest_zone_ = std::max(widest, kNarrowestZone * spacing);
  sample(pose);
  zone_ = {};
}

/// Points along the edge, its own among them: as many for all poses of the stroke.
void BladeCoupling::sample(const BladePose& pose) {
  const std::size_t segments = pose.edge.size() - 1, most = std::max<std::size_t>(1, kMostEdgePoints / segments);
  for (std::size_t i = 0; i < segments; ++i) {
    const double parts = (pose.edge[i + 1] - pose.edge[i]).norm() / (kEdgeSpan * spacing_);
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
    s.pushed = 1 / (1 + pose.slicing * pose.slicing);
    motion += s.place - s.before;
  }
  const Vec3 before = direction_;
  if (pose.direction.norm() > 0) {
    direction_ = pose.direction.normalized();
  } else {  // along the edge nothing is cut
    const Vec3 chord = pose.edge.back() - pose.edge.front();
    const double chord2 = chord.squaredNorm();
    if (chord2 > 0) motion -= motion.dot(chord) / chord2 * chord;
    if (motion.norm() > 1e-9 * spacing_) direction_ = motion.normalized();
  }
  turn_springs(before);
}

/// Springs press along the direction of cutting: of what they were pressed across it nothing is left.
void BladeCoupling::turn_springs(const Vec3& before) {
  const double kept = std::max(0.0, before.dot(direction_));
  if (before.isZero(0) || before == direction_) return;
  for (Sample& s : samples_) s.lag *= kept;
  for (ProcessZone::Bearer& bearer : zone_.bearers()) bearer.lag *= kept;
}

/// The direction of the edge at rest, around a point that has hold of the tissue. Over some points: the front is seldom
/// straight, and the edge is not longer for that.
Vec3 BladeCoupling::tangent_at(std::size_t sample) const {
  std::size_t first = sample, last = sample;
  while (first > 0 && sample - first < kTangentSpan && samples_[first - 1].grip) --first;
  while (last + 1 < samples_.size() && last - sample < kTangentSpan && samples_[last + 1].grip) ++last;
  const Vec3 way = across(samples_[last].rest - samples_[first].rest, samples_[sample].rest - samples_[sample].front);
  return way.norm() > 0 ? Vec3(way.normalized()) : Vec3(Vec3::Zero());
}

/// The edge is as long as the material along it is at rest: tissue that is pressed bulges, and no more of it is cut for
/// that. Where the edge ends in the tissue, or goes through its skin, only what is within counts.
void BladeCoupling::measure(const TetMesh& mesh) {
  for (Sample& s : samples_) s.length = 0;
  for (std::size_t i = 1; i < samples_.size(); ++i) {
    Sample &a = samples_[i - 1], &b = samples_[i];
    const Vec3 way = b.place - a.place;
    if (a.grip && b.grip) {
      const double length = 0.5 * std::clamp(tangent_at(i).dot(b.rest - a.rest), 0.0, kMostBulge * way.norm()) * unit_;
      a.length += length;
      b.length += length;
    } else if (a.grip) {
      a.length += length_within(i - 1, way, mesh) * unit_;
    } else if (b.grip) {
      b.length += length_within(i, -way, mesh) * unit_;
    }
  }
}

/// How far a way from where the point has hold of the tissue lies within, at rest.
double BladeCoupling::length_within(std::size_t index, const Vec3& way, const TetMesh& mesh) const {
  const Sample& sample = samples_[index];
  const Vec3 from = sample.grip->place(mesh);
  Vec3 last = sample.rest;
  double in = 0, out = 1;
  for (unsigned i = 0; i < kPlaceHalvings; ++i) {
    const double half = 0.5 * (in + out);
    const auto found = walk_to(mesh, BodyShape::kCurrent, from + half * way, sample.grip->tet);
    if (found) last = found->place(mesh, BodyShape::kRest);
    (found ? in : out) = half;
  }
  const Vec3 tangent = tangent_at(index);
  return tangent.isZero(0) ? (last - sample.rest).norm() : std::abs(tangent.dot(last - sample.rest));
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
  sample.rupture = material.rupture;
  sample.stiffens = material.stiffening > 0;
  const double narrowest = kNarrowestZone * spacing_;
  sample.radius = std::clamp(material.toughness / material.young / unit_, narrowest, widest_zone_);
}

/// The edge slides along itself without cutting: a point that does so has hold of other material.
void BladeCoupling::slide(const TetMesh& mesh) {
  for (Sample& s : samples_) {
    if (!s.grip) continue;
    s.slid += across(s.place - s.before, direction_);
    if (s.slid.norm() <= kSlides * spacing_) continue;
    const Vec3 at = s.grip->place(mesh) + std::exchange(s.slid, Vec3::Zero());
    const std::optional<TissuePoint> found = walk_to(mesh, BodyShape::kCurrent, at, s.grip->tet);
    if (found) {
      const Vec3 before = s.rest;
      grip(s, *found, mesh);
      s.front += s.rest - before;
    } else {
      s.grip.reset();
    }
  }
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
  for (unsigned i = 0; i < kPlaceHalvings; ++i) {
    const double half = 0.5 * (out + in);
    const auto found = walk_to(mesh, BodyShape::kCurrent, sample.cut + half * (sample.place - sample.cut), entry.tet);
    if (found) entry = *found;
    (found ? in : out) = half;
  }
  sample.cut += out * (sample.place - sample.cut);
  sample.ahead = direction_.dot(entry.place(mesh) - sample.cut);
  grip(sample, entry, mesh);
  sample.front = sample.rest;
  sample.is_open = sample.runs = false;
  sample.lag = sample.paid = 0;
  sample.slid = Vec3::Zero();
}

/// The vertices that bear the edge now, and how much each of them bears.
void BladeCoupling::find_zone(const TetMesh& mesh) {
  std::vector<FrontPoint> points;
  sample_of_.clear();
  for (std::uint32_t i = 0; i < samples_.size(); ++i) {
    const Sample& s = samples_[i];
    if (!s.grip || s.limit() <= 0) continue;
    points.push_back({*s.grip, s.front, s.radius});
    sample_of_.push_back(i);
  }
  zone_.find(mesh, points);
  std::vector<double> lags(zone_.bearers().size());
  for_each_share([&](Sample& s, ProcessZone::Bearer& bearer, double weight) {
    bearer.limit += weight * s.limit();
    lags[static_cast<std::size_t>(&bearer - zone_.bearers().data())] += weight * s.limit() * s.lag;
  });
  for (std::size_t i = 0; i < lags.size(); ++i) {
    ProcessZone::Bearer& bearer = zone_.bearers()[i];
    if (zone_.is_fresh(i) && bearer.limit > 0) bearer.lag = lags[i] / bearer.limit;
  }
}

/// Calls `visit(sample, bearer, weight)`.
template <class Visit>
void BladeCoupling::for_each_share(const Visit& visit) {
  for (const ProcessZone::Share& share : zone_.shares()) {
    visit(samples_[sample_of_[share.point]], zone_.bearers()[share.bearer], share.weight);
  }
}

void BladeCoupling::press(const BladePose& pose, const TetMesh& mesh, std::vector<Pull>& pulls) {
  move_to(pose);
  slide(mesh);
  enter(mesh);
  measure(mesh);
  find_zone(mesh);
  std::vector<ProcessZone::Bearer>& bearers = zone_.bearers();
  std::vector<double> ways(bearers.size()), bears(bearers.size());
  for_each_share([&](Sample& s, ProcessZone::Bearer& bearer, double weight) {
    const auto i = static_cast<std::size_t>(&bearer - bearers.data());
    ways[i] += weight * s.limit() * direction_.dot(s.place - s.before);
    bears[i] += weight * s.limit() * s.bears();
  });
  for (std::size_t i = 0; i < bearers.size(); ++i) {
    ProcessZone::Bearer& bearer = bearers[i];
    if (!(bearer.limit > 0)) continue;
    bearer.target = mesh.current(bearer.vertex) + (bearer.lag + ways[i] / bearer.limit) * direction_;
    Pull pull;
    pull.vertices[0] = bearer.vertex;
    pull.axis = direction_;
    pull.target = bearer.target;
    pull.stiffness = bearer.limit / (kGiveAt * spacing_ * unit_);
    pull.pushes_only = true;
    pull.limit = bears[i];
    bearer.limit = bears[i];
    bearer.stiffness = pull.stiffness;
    pulls.push_back(pull);
  }
}

/// By its share of the limit: a front at rest bears more than one that runs.
double BladeCoupling::Sample::bears() const {
  return runs ? 1 - rupture : 1 + (is_open ? rupture : 2 * rupture);
}

/// Springs that are pressed too far slip, which is work that pays for the front.
void BladeCoupling::settle_springs(const TetMesh& mesh) {
  for (ProcessZone::Bearer& bearer : zone_.bearers()) {
    if (!(bearer.limit > 0)) continue;
    const double lag = direction_.dot(bearer.target - mesh.current(bearer.vertex));
    bearer.lag = std::min(lag, bearer.limit / bearer.stiffness / unit_);
    bearer.slipped = lag - bearer.lag;
    bearer.force = std::max(bearer.lag, 0.0) * unit_ * bearer.stiffness;
  }
  for (Sample& s : samples_) s.lag = 0;
  for_each_share([&](Sample& s, ProcessZone::Bearer& bearer, double weight) {
    s.lag += weight * bearer.lag;
    const double share = weight * s.limit() * s.bears() / bearer.limit;
    s.force += share * bearer.force;
    s.paid += share * bearer.force * bearer.slipped / s.limit();
  });
}

/// What does not yield stays behind the front: the engine cuts on where the edge is ahead of it alone.
BladePose BladeCoupling::yield(const TetMesh& mesh) {
  state_ = {};
  for (Sample& s : samples_) {
    s.force_before = std::exchange(s.force, 0.0);
    s.has_slipped = !s.grip;
    s.retreat = s.advance = 0;
    if (s.grip) s.lead = direction_.dot(s.place - s.grip->place(mesh)) + s.ahead;
  }
  settle_springs(mesh);
  pool();
  for (Sample& s : samples_) {
    if (!s.grip) continue;
    s.retreat = std::max(s.lead, 0.0) + s.ahead + kToldBehind * spacing_;
    go_on(s, mesh);
    account(s);
  }
  retreat_outside();
  if (is_point()) retreat_together();
  BladePose pose;
  pose.direction = direction_;
  for (Sample& s : samples_) {
    s.cut = s.place - s.retreat * direction_;
    pose.edge.push_back(s.cut);
    if (s.grip && s.lag <= 0 && s.lead < -kWithdrawn * spacing_) s.grip.reset();
  }
  return pose;
}

/// Points of the front that have come to the blade, or are ahead of it, cannot use what their springs have paid: it is
/// for the others, whose zones overlap with theirs.
void BladeCoupling::pool() {
  double pool = 0, limits = 0;
  for (Sample& s : samples_) {
    if (!s.grip || s.limit() <= 0) continue;
    if (s.lead > 0) {
      limits += s.limit();
    } else if (s.is_open && s.paid > 0) {
      pool += std::exchange(s.paid, 0.0) * s.limit();
    }
  }
  for (Sample& s : samples_) {
    if (s.grip && s.lead > 0 && limits > 0) s.paid += pool / limits;
  }
}

/// The front goes on where the tissue bears no more, as far as that is paid for: by its length of material at rest. In
/// tissue that is pressed together that is less than its way through space.
void BladeCoupling::go_on(Sample& s, const TetMesh& mesh) {
  if (s.force >= kYieldsAt * s.bears() * s.limit()) s.runs = s.is_open = true;
  if (!s.stiffens && s.runs) {  // what does not stiffen gives way to the edge at once
    s.paid = std::max(s.paid, s.lead - kGiveAt * spacing_);
  }
  if (!s.runs || s.paid <= 0 || s.lead <= 0) {
    s.runs = false;
    return;
  }
  const double way = paid_way(s, mesh);
  s.has_slipped = way > 0;
  if (s.has_slipped) s.retreat = s.lead - way;
  if (s.advance <= direction_.dot(s.place - s.before)) s.runs = false;
}

/// How far the front may go through space: the material that the blade has come to is looked at in steps. Where it
/// begins in this frame counts, not where the front was: material flows along the edge.
double BladeCoupling::paid_way(Sample& sample, const TetMesh& mesh) const {
  const auto at = [&](double way) {
    return walk_to(mesh, BodyShape::kCurrent, sample.place - (sample.lead - way) * direction_, sample.grip->tet);
  };
  std::optional<Vec3> first;
  Vec3 last = sample.front;
  double way = 0, beyond = 0;
  const auto try_at = [&](double next) {
    const std::optional<TissuePoint> found = at(next);
    if (!found) return !first.has_value();
    const Vec3 rest = found->place(mesh, BodyShape::kRest);
    if (!first) first = rest;
    if ((rest - *first).norm() > sample.paid) return false;
    way = next;
    last = rest;
    return true;
  };
  for (unsigned i = 0; i <= kStepsAhead; ++i) {
    beyond = sample.lead * i / kStepsAhead;
    if (!try_at(beyond)) break;
  }
  for (unsigned i = 0; i < 5 && way < beyond; ++i) {
    const double half = 0.5 * (way + beyond);
    if (!try_at(half)) beyond = half;
  }
  if (!first) return sample.lead;  // no tissue there
  sample.advance = (last - *first).norm();
  sample.front = last;
  return way;
}

/// Points outside the tissue go with the nearest one inside: the edge between them would cut where nothing bears it.
void BladeCoupling::retreat_outside() {
  const auto go_with = [](Sample& sample, const Sample& before) {
    if (!sample.grip) sample.retreat = std::max(sample.retreat, before.retreat);
  };
  for (std::size_t i = 1; i < samples_.size(); ++i) go_with(samples_[i], samples_[i - 1]);
  for (std::size_t i = samples_.size() - 1; i > 0; --i) go_with(samples_[i - 1], samples_[i]);
}

/// Whether the edge has drawn together, as a ring does that closes below what it has cut around.
bool BladeCoupling::is_point() const {
  return std::all_of(samples_.begin(), samples_.end(), [&](const Sample& s) {
    return (s.place - samples_.front().place).norm() <= kPointWidth * spacing_;
  });
}

/// A point stays one, wherever the tissue holds it back: the cut ends in it.
void BladeCoupling::retreat_together() {
  double most = 0;
  for (const Sample& s : samples_) most = std::max(most, s.retreat);
  for (Sample& s : samples_) s.retreat = most;
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

/// What was opened is paid for, wherever the edge was told to be: tets open as wholes. It is taken from the points that
/// went on, as far as they went, or where none did, from all.
void BladeCoupling::pay_for(double area) {
  double planned = 0, length = 0;
  for (const Sample& s : samples_) {
    if (!s.grip || s.limit() <= 0) continue;
    planned += s.advance * s.length;
    length += s.length;
  }
  if (!(length > 0)) return;
  for (Sample& s : samples_) {
    if (!s.grip || s.limit() <= 0) continue;
    const double opened = planned > 0 ? s.advance * area * unit_ / planned : area * unit_ / length;
    s.paid -= opened;
    const double work = s.toughness * s.length * opened * unit_;
    state_.fracture_work += work;
    state_.tool_work += (1 - s.pushed) * work;  // by what moves the edge along itself
  }
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
  const Vec3 place = sample.has_slipped ? Vec3(sample.cut + kHoldsAhead * spacing_ * direction_) : sample.rest;
  auto found = find_among(mesh, shape, place, fresh);
  if (!found) found = find_around(mesh, shape, place, sample.grip->vertices, kMostSearchedTets);
  sample.grip.reset();
  if (!found) return;
  if (sample.has_slipped) sample.ahead = kHoldsAhead * spacing_;
  sample.slid = Vec3::Zero();
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
    limit += s.pushed * s.toughness * s.length;
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
