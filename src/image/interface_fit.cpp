// SPDX-License-Identifier: Apache-2.0
// Newton steps towards where labels are alike, point by point in colours that share no tet, each shortened until all
// tets around stay within bounds. Biases of labels follow from the volumes that they lack (docs/internals.md, 6).
#include "image/interface_fit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "incise/core/parallel.h"
#include "incise/geom/quality.h"
#include "incise/mesh/tet_tables.h"

namespace incise {
inline namespace v0 {
namespace image {
namespace {

/// Steps towards an interface are at most this share of the mean edge.
constexpr double kLongestStep = 0.3;
/// The kernel is at least this share of the mean edge wide; where labels differ by more than `kFar`, the interface is
/// too far for that, and it is `kWide` wide.
constexpr double kNarrow = 0.15, kFar = 0.9, kWide = 0.3;
/// Damping of the least squares of three labels and more, relative.
constexpr double kDamping = 0.03;
/// Biases of labels that meet differ by no more than this, change by so much at once, and take this share of what would
/// bring the volumes about.
constexpr double kMostDifference = 0.6, kMostChange = 0.1, kEager = 0.8;
constexpr int kBalanceSweeps = 60;
/// Faces around a point make an edge where the normal of one of them is turned this far from their mean (cosine).
/// Planes are taken near the middles of the faces, the point counting this much beside their other corners; planes that
/// are alike do not move the point along them (damping, relative), nor do any by more than this share of the mean edge.
constexpr double kCrease = 0.8, kCreaseNear = 0.5, kCreaseDamping = 0.03, kMostToCrease = 0.6;

/// Whether a tet is within the bounds.
bool is_sound(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const ShapeBounds& bounds) {
  const Vec3 ab = b - a, ac = c - a, ad = d - a, bc = c - b, bd = d - b, cd = d - c;
  const double volume6 = ab.cross(ac).dot(ad);
  if (!(volume6 > 0)) return false;
  // Twice the area of each side as a vector outwards.
  const std::array<Vec3, 4> normal = {bc.cross(bd), ad.cross(ac), ab.cross(ad), ac.cross(ab)};
  std::array<double, 4> area{};
  double sum = 0;
  for (std::size_t s = 0; s < 4; ++s) sum += area[s] = normal[s].norm();
  const double longest2 = std::max(
      {ab.squaredNorm(), ac.squaredNorm(), ad.squaredNorm(), bc.squaredNorm(), bd.squaredNorm(), cd.squaredNorm()});
  if (std::sqrt(longest2) * sum > bounds.most_lr * volume6) return false;
  for (std::size_t s = 0; s < 4; ++s) {
    for (std::size_t t = 0; t < s; ++t) {
      const double cosine = -normal[s].dot(normal[t]), scale = area[s] * area[t];
      if (cosine > bounds.cos_least * scale || cosine < bounds.cos_greatest * scale) return false;
    }
  }
  return true;
}

/// Inradius over longest edge.
double ratio(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return signed_volume6(a, b, c, d) > 0 ? 1 / longest_edge_over_inradius(a, b, c, d) : 0.0;
}

/// Solves m x = r for up to three unknowns, m symmetric and positive.
void solve(std::array<std::array<double, 3>, 3>& m, std::array<double, 3>& r, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const double f = m[j][i] / m[i][i];
      for (std::size_t k = i; k < n; ++k) m[j][k] -= f * m[i][k];
      r[j] -= f * r[i];
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) r[i] -= m[i][k] * r[k];
    r[i] /= m[i][i];
  }
}

/// The shortest step after which all labels are alike, to first order; zero where their values do not change.
Vec3 step_to_interface(const Shares& shares, const LabelField& field, const std::array<LabelIndex, 4>& label,
                       std::size_t n, double& difference) {
  const auto share = [&](LabelIndex l) {
    const Share* found = shares.find(l);
    return found != nullptr ? *found : Share{l, field.bias(l), Vec3::Zero()};
  };
  const Share first = share(label[0]);
  std::array<Vec3, 3> slope;
  std::array<double, 3> r{};
  std::array<std::array<double, 3>, 3> m{};
  double greatest = 0;
  difference = 0;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Share other = share(label[i + 1]);
    slope[i] = first.slope - other.slope;
    r[i] = first.value - other.value;
    difference = std::max(difference, std::abs(r[i]));
    greatest = std::max(greatest, slope[i].squaredNorm());
  }
  if (!(greatest > 0)) return Vec3::Zero();
  for (std::size_t i = 0; i + 1 < n; ++i) {
    for (std::size_t j = 0; j + 1 < n; ++j)
      m[i][j] = slope[i].dot(slope[j]) + (i == j && n > 2 ? kDamping * greatest : 0);
  }
  solve(m, r, n - 1);
  Vec3 step = Vec3::Zero();
  for (std::size_t i = 0; i + 1 < n; ++i) step -= r[i] * slope[i];
  return step.allFinite() ? step : Vec3(Vec3::Zero());
}

}  // namespace

bool InterfaceFit::Class::has(LabelIndex l) const {
  return std::find(label.begin(), label.begin() + std::min<int>(n, 4), l) != label.begin() + std::min<int>(n, 4);
}

bool InterfaceFit::Class::has_all_of(const Class& other) const {
  for (int i = 0; i < std::min<int>(other.n, 4); ++i) {
    if (!has(other.label[static_cast<std::size_t>(i)])) return false;
  }
  return true;
}

void InterfaceFit::Class::add(LabelIndex l) {
  if (n > 4 || has(l)) return;
  if (n < 4) label[n] = l;
  ++n;
}

InterfaceFit::InterfaceFit(LabelField& field, const std::vector<double>& volumes, const ShapeBounds& bounds,
                           unsigned threads, LabelledTets& mesh)
    : field_(field),
      wanted_(volumes),
      bounds_(bounds),
      threads_(threads),
      mesh_(mesh),
      neighbours_(find_neighbours(mesh)),
      stars_(mesh) {
  find_classes();
  find_interface_neighbours();
  find_colours();
}

void InterfaceFit::find_classes() {
  class_.resize(mesh_.points.size());
  edge_.assign(mesh_.points.size(), 0);
  std::vector<std::uint32_t> edges(mesh_.points.size(), 0);
  for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
    const auto& tet = mesh_.tets[t];
    for (std::size_t s = 0; s < 4; ++s) {
      class_[tet[s]].add(mesh_.labels[t]);
      for (std::size_t e = 0; e < 4; ++e) {
        if (e == s) continue;
        edge_[tet[s]] += (mesh_.points[tet[s]] - mesh_.points[tet[e]]).norm();
        ++edges[tet[s]];
        if (neighbours_[t][s] == kNoTet) class_[tet[e]].add(0);
      }
    }
  }
  double sum = 0, n = 0;
  for (std::size_t p = 0; p < edge_.size(); ++p) {
    edge_[p] /= std::max<double>(1, edges[p]);
    if (class_[p].n < 2) continue;
    sum += edge_[p];
    n += 1;
  }
  mean_edge_ = sum / std::max(1.0, n);
}

void InterfaceFit::find_interface_neighbours() {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
    for (std::size_t s = 0; s < 4; ++s) {
      const std::uint32_t other = neighbours_[t][s];
      if (other != kNoTet && (mesh_.labels[other] == mesh_.labels[t] || other < t)) continue;
      const auto& order = kSideCorners[s];
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = mesh_.tets[t][order[i]], b = mesh_.tets[t][order[(i + 1) % 3]];
        if (class_[b].has_all_of(class_[a])) pairs.emplace_back(a, b);
        if (class_[a].has_all_of(class_[b])) pairs.emplace_back(b, a);
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  first_beside_.assign(mesh_.points.size() + 1, 0);
  for (const auto& [a, b] : pairs) {
    ++first_beside_[a + 1];
    beside_.push_back(b);
  }
  for (std::size_t p = 0; p < mesh_.points.size(); ++p) first_beside_[p + 1] += first_beside_[p];
}

/// Points of one colour share no tet, so that they can move at the same time.
void InterfaceFit::find_colours() {
  std::vector<std::uint8_t> colour(mesh_.points.size(), 0xFF);
  for (std::size_t p = 0; p < mesh_.points.size(); ++p) {
    bool is_near = class_[p].n > 1;
    std::uint64_t taken = 0;
    for (const std::uint32_t t : stars_[p]) {
      for (const std::uint32_t q : mesh_.tets[t]) {
        is_near = is_near || class_[q].n > 1;
        if (colour[q] < 64) taken |= std::uint64_t{1} << colour[q];
      }
    }
    if (!is_near) continue;
    std::uint8_t free = 0;
    while ((taken >> free & 1U) != 0) ++free;
    colour[p] = free;
    if (free >= colours_.size()) colours_.resize(free + std::size_t{1});
    colours_[free].push_back(static_cast<std::uint32_t>(p));
  }
}

void InterfaceFit::move_points(double spread) {
  for (const std::vector<std::uint32_t>& points : colours_) {
    parallel_blocks(points.size(), threads_, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) move_point(points[i], spread);
    });
  }
}

void InterfaceFit::move_point(std::size_t p, double spread) {
  if (class_[p].n > 4) return;
  if (class_[p].n > 1) return move_interface_point(p, spread);
  move_inner_point(p);
}

Vec3 InterfaceFit::projected(const Vec3& from, const Class& labels, double edge) const {
  Shares shares;
  Vec3 x = from;
  for (int i = 0; i < 2; ++i) {
    double difference = 0;
    field_.sample(x, kNarrow * edge, shares);
    Vec3 step = step_to_interface(shares, field_, labels.label, labels.n, difference);
    if (difference > kFar) {
      field_.sample(x, kWide * edge, shares);
      step = step_to_interface(shares, field_, labels.label, labels.n, difference);
    }
    const double length = step.norm(), most = kLongestStep * edge;
    x += length > most ? Vec3(step * (most / length)) : step;
  }
  return x;
}

/// Calls back with the other two corners of each face around a point that parts labels, turned alike.
template <class Work>
void InterfaceFit::for_each_face(std::size_t p, const Work& work) const {
  for (const std::uint32_t t : stars_[p]) {
    const auto& tet = mesh_.tets[t];
    for (std::size_t s = 0; s < 4; ++s) {
      const std::uint32_t other = neighbours_[t][s];
      if (tet[s] == p || (other != kNoTet && mesh_.labels[other] >= mesh_.labels[t])) continue;
      const auto& order = kSideCorners[s];
      std::size_t i = 0;
      while (tet[order[i]] != p) ++i;
      work(mesh_.points[tet[order[(i + 1) % 3]]], mesh_.points[tet[order[(i + 2) % 3]]]);
    }
  }
}

/// Whether a point has two labels, and the faces around it make an edge or a corner.
bool InterfaceFit::is_creased(std::size_t p) const {
  if (class_[p].n != 2) return false;
  const Vec3& at = mesh_.points[p];
  Vec3 sum = Vec3::Zero();
  for_each_face(p, [&](const Vec3& a, const Vec3& b) { sum += (a - at).cross(b - at); });
  const double length = sum.norm();
  bool is_creased = false;
  for_each_face(p, [&](const Vec3& a, const Vec3& b) {
    const Vec3 normal = (a - at).cross(b - at);
    is_creased = is_creased || normal.dot(sum) < kCrease * normal.norm() * length;
  });
  return is_creased;
}

/// The plane of an interface of two labels near a point: false where it is not found.
bool InterfaceFit::find_plane(const Vec3& near, const Class& labels, double edge, Vec3& at, Vec3& normal) const {
  at = projected(near, labels, edge);
  Shares shares;
  field_.sample(at, kNarrow * edge, shares);
  const Share *mine = shares.find(labels.label[0]), *theirs = shares.find(labels.label[1]);
  if (mine == nullptr || theirs == nullptr) return false;
  normal = mine->slope - theirs->slope;
  const double length = normal.norm();
  if (!(length > 0)) return false;
  normal /= length;
  return true;
}

/// Where the planes of the interface around a point of two labels meet: on the edge or corner that they make.
Vec3 InterfaceFit::sharpened(std::size_t p, const Vec3& from) const {
  std::array<std::array<double, 3>, 3> m{};
  std::array<double, 3> step{};
  double planes = 0;
  for_each_face(p, [&](const Vec3& a, const Vec3& b) {
    Vec3 at, normal;
    if (!find_plane((kCreaseNear * from + a + b) / (kCreaseNear + 2), class_[p], edge_[p], at, normal)) return;
    const double away = normal.dot(at - from);
    for (std::size_t i = 0; i < 3; ++i) {
      const double along = normal[static_cast<Eigen::Index>(i)];
      for (std::size_t j = 0; j < 3; ++j) m[i][j] += along * normal[static_cast<Eigen::Index>(j)];
      step[i] += away * along;
    }
    planes += 1;
  });
  if (planes == 0) return from;
  for (std::size_t i = 0; i < 3; ++i) m[i][i] += kCreaseDamping * planes;
  solve(m, step, 3);
  const Vec3 by(step[0], step[1], step[2]);
  return by.norm() > kMostToCrease * edge_[p] ? from : Vec3(from + by);
}

/// Where a point of an interface belongs that is near `from`.
Vec3 InterfaceFit::placed(std::size_t p, const Vec3& from) const {
  const Vec3 at = projected(from, class_[p], edge_[p]);
  return is_creased(p) ? sharpened(p, at) : at;
}

void InterfaceFit::move_interface_point(std::size_t p, double spread) {
  const Vec3 from = mesh_.points[p];
  const std::size_t n = first_beside_[p + 1] - first_beside_[p];
  if (spread > 0 && n >= 2) {
    Vec3 middle = Vec3::Zero();
    for (std::size_t i = first_beside_[p]; i < first_beside_[p + 1]; ++i) middle += mesh_.points[beside_[i]];
    const Vec3 target = from + spread * (middle / static_cast<double>(n) - from);
    if (go_towards(p, placed(p, target), 2)) return;
  }
  if (go_towards(p, placed(p, from), 4) || !is_creased(p)) return;
  (void)go_towards(p, projected(from, class_[p], edge_[p]), 4);
}

/// Moves a point towards a target as far as the bounds allow, in halves of the way.
bool InterfaceFit::go_towards(std::size_t p, const Vec3& target, int halvings) {
  const Vec3 from = mesh_.points[p];
  double share = 1;
  for (int i = 0; i <= halvings; ++i, share *= 0.5) {
    const Vec3 at = from + share * (target - from);
    if (!is_star_sound(p, at)) continue;
    mesh_.points[p] = at;
    return true;
  }
  return false;
}

void InterfaceFit::move_inner_point(std::size_t p) {
  Vec3 sum = Vec3::Zero();
  double n = 0;
  for (const std::uint32_t t : stars_[p]) {
    for (const std::uint32_t q : mesh_.tets[t]) {
      if (q == p) continue;
      sum += mesh_.points[q];
      n += 1;
    }
  }
  const Vec3 from = mesh_.points[p], target = sum / n;
  const double now = worst_ratio(p, from);
  double share = 1;
  for (int i = 0; i < 3; ++i, share *= 0.5) {
    const Vec3 at = from + share * (target - from);
    if (!(worst_ratio(p, at) > now) || !is_star_sound(p, at)) continue;
    mesh_.points[p] = at;
    return;
  }
}

bool InterfaceFit::is_star_sound(std::size_t p, const Vec3& at) const {
  for (const std::uint32_t t : stars_[p]) {
    const auto& tet = mesh_.tets[t];
    const auto corner = [&](std::size_t i) -> const Vec3& { return tet[i] == p ? at : mesh_.points[tet[i]]; };
    if (!is_sound(corner(0), corner(1), corner(2), corner(3), bounds_)) return false;
  }
  return true;
}

double InterfaceFit::worst_ratio(std::size_t p, const Vec3& at) const {
  double worst = 1;
  for (const std::uint32_t t : stars_[p]) {
    const auto& tet = mesh_.tets[t];
    const auto corner = [&](std::size_t i) -> const Vec3& { return tet[i] == p ? at : mesh_.points[tet[i]]; };
    worst = std::min(worst, ratio(corner(0), corner(1), corner(2), corner(3)));
  }
  return worst;
}

std::vector<double> InterfaceFit::volumes() const {
  std::vector<double> volumes(wanted_.size(), 0);
  for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
    const auto& tet = mesh_.tets[t];
    volumes[mesh_.labels[t]] +=
        signed_volume(mesh_.points[tet[0]], mesh_.points[tet[1]], mesh_.points[tet[2]], mesh_.points[tet[3]]);
  }
  return volumes;
}

void InterfaceFit::match_volumes() {
  std::map<std::pair<LabelIndex, LabelIndex>, double> areas;
  for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
    for (std::size_t s = 0; s < 4; ++s) {
      const std::uint32_t other = neighbours_[t][s];
      const LabelIndex mine = mesh_.labels[t], theirs = other == kNoTet ? LabelIndex{0} : mesh_.labels[other];
      if (mine <= theirs) continue;
      const auto& order = kSideCorners[s];
      const Vec3 &a = mesh_.points[mesh_.tets[t][order[0]]], &b = mesh_.points[mesh_.tets[t][order[1]]],
                 &c = mesh_.points[mesh_.tets[t][order[2]]];
      areas[{theirs, mine}] += 0.5 * (b - a).cross(c - a).norm();
    }
  }
  // Each label's interfaces go outwards by `shift`, against those of its neighbours: area · (shift - theirs) = missing.
  const std::vector<double> now = volumes();
  std::vector<double> shift(wanted_.size(), 0), sum(wanted_.size()), area(wanted_.size());
  for (int sweep = 0; sweep < kBalanceSweeps; ++sweep) {
    std::fill(area.begin(), area.end(), 0.0);
    for (std::size_t l = 0; l < sum.size(); ++l) sum[l] = wanted_[l] - now[l];
    for (const auto& [pair, a] : areas) {
      sum[pair.first] += a * shift[pair.second];
      sum[pair.second] += a * shift[pair.first];
      area[pair.first] += a;
      area[pair.second] += a;
    }
    for (std::size_t l = 1; l < shift.size(); ++l) shift[l] = area[l] > 0 ? 0.5 * (shift[l] + sum[l] / area[l]) : 0;
  }
  const double slope = 2 * field_.plane_slope(kNarrow * mean_edge_);
  for (std::size_t l = 1; l < shift.size(); ++l) {
    const auto label = static_cast<LabelIndex>(l);
    const double change = std::clamp(kEager * slope * shift[l], -kMostChange, kMostChange);
    field_.set_bias(label, field_.bias(label) + change);
  }
  for (const auto& [pair, a] : areas) {
    const double low = field_.bias(pair.first), difference = field_.bias(pair.second) - low;
    field_.set_bias(pair.second, low + std::clamp(difference, -kMostDifference, kMostDifference));
  }
}

}  // namespace image
}  // namespace v0
}  // namespace incise
