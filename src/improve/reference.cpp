// SPDX-License-Identifier: Apache-2.0
// Each sweep is a few trees of triangles of falling size, merged as they grow, as in a binary counter; pieces are
// compared by samples, and what already lay further off may stay so (docs/internals.md, 3.13).
#include "improve/reference.h"

#include <algorithm>
#include <cmath>

#include "improve/constants.h"

namespace incise {
inline namespace v0 {

namespace {

bool are_near(const Piece& piece, const Piece& other, double tolerance2) {
  return std::all_of(piece.samples.begin(), piece.samples.end(),
                     [&](const Vec3& p) { return distance2_to(other, p) <= tolerance2; });
}

TriangleTree tree_of(std::span<const Vec3> points, std::span<const TriangleTree::Triangle> triangles) {
  std::vector<Vec3> used;
  std::vector<TriangleTree::Triangle> renumbered;
  for (const TriangleTree::Triangle& triangle : triangles) {
    const auto first = static_cast<std::uint32_t>(used.size());
    for (const std::uint32_t p : triangle) used.push_back(points[p]);
    renumbered.push_back({first, first + 1, first + 2});
  }
  return {used, renumbered};
}

}  // namespace

/// Parts that are not much smaller than the one before are made one with it, so that there are few.
void References::extend(std::uint32_t stroke, std::span<const Vec3> points,
                        std::span<const TriangleTree::Triangle> triangles) {
  std::vector<Part>& parts = sweeps_[stroke].parts;
  std::size_t first = parts.empty() ? 0 : parts.back().last;
  if (first == triangles.size()) return;
  while (!parts.empty() && parts.back().last - parts.back().first <= 2 * (triangles.size() - first)) {
    first = parts.back().first;
    parts.pop_back();
  }
  parts.push_back({tree_of(points, triangles.subspan(first)), first, triangles.size()});
}

TriangleTree::Hit References::closest(const Sweep& sweep, const Vec3& place, double greatest) {
  TriangleTree::Hit best;
  for (const Part& part : sweep.parts) {
    const TriangleTree::Hit hit = part.tree.closest(place, std::min(greatest, std::sqrt(best.distance2)));
    if (hit.is_valid() && hit.distance2 < best.distance2) best = hit;
  }
  return best;
}

double References::farthest(const Sweep& sweep, const Piece& piece) {
  double farthest2 = 0;
  for (const Vec3& p : piece.samples) {
    farthest2 = std::max(farthest2, closest(sweep, p).distance2);
  }
  return std::sqrt(farthest2);
}

double mean_spoke(const Piece& piece) {
  double sum = 0;
  for (const Facet& f : piece.facets) {
    sum += (f[1] - f[0]).norm() + (f[2] - f[0]).norm();
  }
  return sum / static_cast<double>(2 * piece.facets.size());
}

void References::set_original(const TetMesh& mesh) {
  skin_.measure(mesh);
  sizes_.measure(mesh);
}

void References::measure(const TetMesh& mesh, const std::vector<OpenedFace>& opened) {
  const auto sweep = opened.empty() ? sweeps_.end() : sweeps_.find(opened.front().tag);
  if (sweep == sweeps_.end()) {
    return;
  }
  std::vector<double>& shares = sweep->second.shares;
  const std::size_t stride = 1 + opened.size() / kMostSamples;
  for (std::size_t i = 0; i < opened.size() && shares.size() < kMostShares; i += stride) {
    if (!mesh.is_live(opened[i].a.tet()) || mesh.link(opened[i].a) != Link::boundary(opened[i].tag)) {
      continue;  // a later part of the same stroke has divided it
    }
    const auto v = mesh.vertices(opened[i].a);
    const Vec3 &p = mesh.rest(v[0]), &q = mesh.rest(v[1]), &r = mesh.rest(v[2]);
    const double edge = ((p - q).norm() + (q - r).norm() + (r - p).norm()) / 3.0;
    shares.push_back(std::sqrt(closest(sweep->second, (p + q + r) / 3.0).distance2) / edge);
  }
  if (shares.empty()) {
    return;
  }
  std::sort(shares.begin(), shares.end());
  const auto at = [&](double share) {
    return shares[static_cast<std::size_t>(share * static_cast<double>(shares.size()))];
  };
  sweep->second.chord = std::min(kChordSlack * at(kChordShare), kGreatestChord);
  sweep->second.usual = std::clamp(at(kTypicalShare), kWallTolerance, kGreatestTolerance);
  sweep->second.greatest = std::clamp(shares.back(), kWallTolerance, kGreatestTolerance);
}

double References::tolerance(std::uint32_t tag, bool is_bad) const {
  const auto sweep = sweeps_.find(tag);
  if (sweep == sweeps_.end()) {
    return kWallTolerance;
  }
  return is_bad ? sweep->second.greatest : sweep->second.usual;
}

bool References::allows_apex(std::uint32_t tag, const Vec3& old_place, const Vec3& place, double tolerance, double edge,
                             double skin_share) const {
  if (tag == 0) {
    return skin_.keeps_vertex(old_place, place, edge, skin_share);
  }
  const auto sweep = sweeps_.find(tag);
  if (sweep == sweeps_.end() ||
      closest(sweep->second, place, std::max(tolerance, sweep->second.chord * edge)).is_valid()) {
    return true;
  }
  const double old_distance = std::sqrt(closest(sweep->second, old_place).distance2);
  return closest(sweep->second, place, old_distance).is_valid();
}

bool References::allows(std::uint32_t tag, const Piece& before, const Piece& after, double tolerance, Reach& reach,
                        double skin_share, double retreat) const {
  const auto sweep = sweeps_.find(tag);
  if (sweep == sweeps_.end()) {
    const double left = tag == 0 ? std::max(tolerance, retreat) : tolerance;
    return are_near(after, before, tolerance * tolerance) && are_near(before, after, left * left) &&
           (tag != 0 || skin_.keeps(before, after, skin_share));
  }
  return std::all_of(after.samples.begin(), after.samples.end(), [&](const Vec3& p) {
    if (closest(sweep->second, p, tolerance).is_valid()) return true;
    if (!reach) reach = farthest(sweep->second, before) + kSlack * tolerance;
    return *reach > tolerance && closest(sweep->second, p, *reach).is_valid();
  });
}

}  // namespace v0
}  // namespace incise
