// SPDX-License-Identifier: Apache-2.0
// The pointer is looked for on the skin first, then on the plane through the last good place. Normal and direction are
// smoothed over travel, not time, so that the pace of the hand does not change the cut.
#include "app/hands/scalpel.h"

#include <algorithm>
#include <cmath>

namespace incise {
inline namespace v0 {
namespace app {
namespace {

// In depths of the scalpel.
constexpr double kClearance = 0.5;       // of the edge above the surface: lips that bulge are still cut
constexpr double kNormalReach = 1;       // of travel over which facets are smoothed
constexpr double kDirectionReach = 0.5;  // of travel over which turns are smoothed, and the blade leans over
constexpr double kTipLift = 0.25;        // of the tip above the surface before the blade goes in
constexpr double kLeastTravel = 0.02;    // that changes the pose: the hand trembles
constexpr double kSlack = 0.5;           // that tissue may have risen or sunk under the pointer
constexpr double kMostDrift = 2;         // that the surface may be off the plane after a blind stretch
constexpr double kMostLeadIn = 3;        // back to where the pointer went down beside the body
constexpr double kBackOfBlade = 0.6;     // behind the edge, as drawn
// Others.
constexpr double kSteepestRise = 1.5;  // rise of the surface per travel along the plane
constexpr double kMostOblique = 4;     // along the ray, per rise off the plane
constexpr double kGrazing = 0.02;      // sine of the flattest angle at which a plane is met
constexpr double kSettled = 1e-3;      // length of the smoothed direction below which it says nothing
constexpr double kLeastDrag = 0.5;
constexpr int kTipSegments = 4;  // of the edge

/// Where a ray meets a plane's front.
std::optional<Vec3> meet(const Ray& ray, const Vec3& on_plane, const Vec3& normal) {
  const double sine = -ray.direction.dot(normal);
  if (!(sine > kGrazing)) return std::nullopt;
  const double distance = (ray.origin - on_plane).dot(normal) / sine;
  if (!(distance > 0)) return std::nullopt;
  return Vec3(ray.origin + distance * ray.direction);
}

/// `vector` without its part along a unit `normal`, unit; zero where nothing is left.
Vec3 across(const Vec3& vector, const Vec3& normal) {
  const Vec3 flat = vector - vector.dot(normal) * normal;
  const double length = flat.norm();
  return length > 1e-9 * vector.norm() ? Vec3(flat / length) : Vec3(Vec3::Zero());
}

/// How far towards a new value a low-pass goes in `travel`, in [0, 1].
double low_pass(double travel, double reach) {
  return 1 - std::exp(-travel / reach);
}

/// From one unit vector towards another. Stays where they are opposite.
Vec3 blend(const Vec3& from, const Vec3& to, double travel, double reach) {
  const Vec3 mixed = from + low_pass(travel, reach) * (to - from);
  const double length = mixed.norm();
  return length > 1e-6 ? Vec3(mixed / length) : from;
}

BladePose pose_along(const Vec3& point, const Vec3& up, double above, double below, const Vec3& direction) {
  BladePose pose;
  for (int i = 0; i <= kTipSegments; ++i) {
    pose.edge.emplace_back(point + (above - (above + below) * i / kTipSegments) * up);
  }
  pose.direction = direction;
  return pose;
}

void add_line(Marks& marks, const Vec3& from, const Vec3& to, float width) {
  marks.lines.push_back({from.cast<float>(), to.cast<float>(), Ink::kBlade, width, true, false});
}

}  // namespace

BladePose upright_pose(const Vec3& point, const Vec3& normal, double depth) {
  return pose_along(point, normal, kClearance * depth, depth, Vec3::Zero());
}

void Scalpel::press(const PointerPlace& place, const ToolSettings& settings) {
  *this = {};
  pressed_ = place.ray;
  if (place.hit) begin(place, settings);
}

void Scalpel::begin(const PointerPlace& place, const ToolSettings& settings) {
  point_ = seen_ = place.hit->point;
  normal_ = place.hit->normal;
  pixel_ = place.pixel;
  put(settings, place.pressure);
  // From outside, as blades do: one that stands in tissue which it has not cut has no way to go on from.
  const Vec3 lift = (place.pressure + kTipLift) * settings.depth * normal_;
  for (Vec3& point : pose_->edge) point += lift;
}

void Scalpel::begin_from_air(const PointerPlace& place, const ToolSettings& settings) {
  const Vec3 there = place.hit->point, normal = place.hit->normal;
  const Vec3 from = meet(pressed_, there, normal).value_or(there);
  const double lead = std::min((from - there).norm(), kMostLeadIn * settings.depth);
  normal_ = normal;
  direction_ = across(there - from, normal);
  seen_ = there;
  point_ = there - lead * direction_;
  pixel_ = place.pixel - Vec2(2 * kLeastDrag, 0);  // the next move counts, even one to the same pixel
  put(settings, place.pressure);
}

void Scalpel::move(const PointerPlace& place, const ToolSettings& settings, double size) {
  if (!pose_) {
    if (place.hit) begin_from_air(place, settings);
    return;
  }
  if ((place.pixel - pixel_).norm() < kLeastDrag) return;
  const bool is_seen = is_on_surface(place, settings.depth);
  const std::optional<Vec3> to = is_seen ? place.hit->point : on_plane(place, size + kMostLeadIn * settings.depth);
  if (!to) return;
  const double travel = (*to - point_).norm();
  if (!(travel >= kLeastTravel * settings.depth)) return;
  pixel_ = place.pixel;
  advance(*to, settings.depth);
  if (is_seen) {
    normal_ = blend(normal_, place.hit->normal, travel, kNormalReach * settings.depth);
    seen_ = point_;
  }
  put(settings, place.pressure);
}

/// Whether the pointer is on the skin that the stroke runs along, and not deep in the wound or on what lies behind.
bool Scalpel::is_on_surface(const PointerPlace& place, double depth) const {
  if (!place.hit || place.is_wall) return false;
  const Vec3& hit = place.hit->point;
  const double near = kSlack * depth + std::min(kSteepestRise * (point_ - seen_).norm(), kMostDrift * depth);
  const std::optional<Vec3> expected = meet(place.ray, point_, normal_);
  // Without a place on the plane the surface bends away from the viewer: only what is near can be the same.
  if (!expected) return (hit - point_).norm() <= near;
  const double most = near + kSteepestRise * (*expected - point_).norm();
  // Seen flat, a small rise is far along the ray.
  return std::abs((hit - *expected).dot(normal_)) <= most && (hit - *expected).norm() <= kMostOblique * most;
}

std::optional<Vec3> Scalpel::on_plane(const PointerPlace& place, double furthest) const {
  const std::optional<Vec3> to = meet(place.ray, point_, normal_);
  if (!to || !((*to - seen_).norm() <= furthest)) return std::nullopt;
  return to;
}

void Scalpel::advance(const Vec3& to, double depth) {
  const Vec3 move = to - point_;
  const double travel = move.norm();
  direction_ += low_pass(travel, kDirectionReach * depth) * (move / travel - direction_);
  point_ = to;
}

void Scalpel::put(const ToolSettings& settings, double pressure) {
  const Vec3 left = normal_.cross(across(direction_, normal_));
  const double angle = left.isZero(0) ? 0 : std::min(direction_.norm(), 1.0) * settings.angle;
  const Vec3 up = std::cos(angle) * normal_ + std::sin(angle) * left;
  // A blade that leans has to go in further to reach as deep.
  const double reach = settings.depth / std::cos(angle);
  pose_ = pose_along(point_, up, kClearance * reach, pressure * reach,
                     direction_.norm() > kSettled ? direction_ : Vec3(Vec3::Zero()));
}

void Scalpel::draw(Marks& marks) const {
  if (!pose_) return;
  const std::vector<Vec3>& edge = pose_->edge;
  for (std::size_t i = 1; i < edge.size(); ++i) add_line(marks, edge[i - 1], edge[i], 4);
  const Vec3 top = edge.front(), tip = edge.back();
  const Vec3 along = (top - tip).normalized();
  const Vec3 back = -kBackOfBlade * (top - tip).norm() * across(direction_, along);
  if (back.isZero(0)) return;
  const Vec3 shoulder = tip + 0.4 * (top - tip) + back;
  add_line(marks, tip, shoulder, 1.5F);
  add_line(marks, shoulder, top + back, 1.5F);
  add_line(marks, top + back, top, 1.5F);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
