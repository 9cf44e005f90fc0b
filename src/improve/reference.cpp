// SPDX-License-Identifier: Apache-2.0
#include "improve/reference.h"

#include <algorithm>
#include <cmath>

namespace incise::inline v0 {

namespace {

/// Facets of a fresh wall that are measured at most, and the share of them that counts as typical.
constexpr std::size_t kMostSamples = 200;
constexpr double kTypicalShare = 0.9;
/// By this share of them chords are told from bends: in a plane nothing lies off it that has not bent.
constexpr double kChordShare = 0.25, kChordSlack = 6.0, kGreatestChord = 0.07;
/// What a piece of wall may go beyond where it was, as a share of the tolerance.
constexpr double kSlack = 0.3;
/// However coarse a wall is, it may leave its place by no more than this share of the local edge.
constexpr double kGreatestTolerance = 2.25 * kWallTolerance;

bool are_near(const Piece& piece, const Piece& other, double tolerance2) {
  return std::all_of(piece.samples.begin(), piece.samples.end(),
                     [&](const Vec3& p) { return distance2_to(other, p) <= tolerance2; });
}

double farthest(const TriangleTree& sweep, const Piece& piece) {
  double farthest2 = 0;
  for (const Vec3& p : piece.samples) {
    farthest2 = std::max(farthest2, sweep.closest(p).distance2);
  }
  return std::sqrt(farthest2);
}

}  // namespace

double mean_spoke(const Piece& piece) {
  double sum = 0;
  for (const Facet& f : piece.facets) {
    sum += (f[1] - f[0]).norm() + (f[2] - f[0]).norm();
  }
  return sum / static_cast<double>(2 * piece.facets.size());
}

void References::measure(const TetMesh& mesh, const std::vector<OpenedFace>& opened) {
  const auto sweep = opened.empty() ? sweeps_.end() : sweeps_.find(opened.front().tag);
  if (sweep == sweeps_.end()) {
    return;
  }
  std::vector<double> shares;
  const std::size_t stride = 1 + opened.size() / kMostSamples;
  for (std::size_t i = 0; i < opened.size(); i += stride) {
    if (!mesh.is_live(opened[i].a.tet()) || mesh.link(opened[i].a) != Link::boundary(opened[i].tag)) {
      continue;  // a later part of the same stroke has divided it
    }
    const auto v = mesh.vertices(opened[i].a);
    const Vec3 &p = mesh.rest(v[0]), &q = mesh.rest(v[1]), &r = mesh.rest(v[2]);
    const double edge = ((p - q).norm() + (q - r).norm() + (r - p).norm()) / 3.0;
    shares.push_back(std::sqrt(sweep->second.tree.closest((p + q + r) / 3.0).distance2) / edge);
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

bool References::allows_apex(std::uint32_t tag, const Vec3& old_place, const Vec3& place, double tolerance,
                             double edge) const {
  if (tag == 0) {
    return skin_.keeps_vertex(old_place, place, edge);
  }
  const auto sweep = sweeps_.find(tag);
  if (sweep == sweeps_.end() ||
      sweep->second.tree.closest(place, std::max(tolerance, sweep->second.chord * edge)).is_valid()) {
    return true;
  }
  const double old_distance = std::sqrt(sweep->second.tree.closest(old_place).distance2);
  return sweep->second.tree.closest(place, old_distance).is_valid();
}

bool References::allows(std::uint32_t tag, const Piece& before, const Piece& after, double tolerance,
                        Reach& reach) const {
  const auto sweep = sweeps_.find(tag);
  if (sweep == sweeps_.end()) {
    return are_near(after, before, tolerance * tolerance) && are_near(before, after, tolerance * tolerance) &&
           (tag != 0 || skin_.keeps(before, after));
  }
  const TriangleTree& tree = sweep->second.tree;
  return std::all_of(after.samples.begin(), after.samples.end(), [&](const Vec3& p) {
    if (tree.closest(p, tolerance).is_valid()) return true;
    if (!reach) reach = farthest(tree, before) + kSlack * tolerance;
    return *reach > tolerance && tree.closest(p, *reach).is_valid();
  });
}

}  // namespace incise::inline v0
