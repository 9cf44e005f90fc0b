// SPDX-License-Identifier: Apache-2.0
// Which side a wall is on its normal tells, against that of the sheet beside it; some are told wrong where the sheet
// turns. Pieces are found from all walls at once (docs/internals.md, 3.12).
#include "paper/ring.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "cut/blade_constants.h"
#include "cut/contact_walk.h"
#include "incise/geom/closest.h"
#include "paper/constants.h"
#include "paper/contact.h"
#include "paper/paper_classes.h"

namespace incise {
inline namespace v0 {

bool Ring::is_near_beginning(const Vec3& point, double distance) const {
  for (std::size_t c = 0; c + 1 < row_.size(); ++c) {
    const Vec3 &a = row_[c], &b = row_[c + 1];
    if (closest_on_triangle(point, a, b, b).distance2 <= std::pow(distance, 2)) return true;
  }
  return false;
}

void Ring::note(const std::shared_ptr<const Strip>& strip, std::span<const Vec3> row, double spacing) {
  if (row_.empty() || is_full_) return;
  strips_.push_back(strip);
  travel_ += travel_of(strip->surface);
  is_full_ = travel_ >= kRingTravel * spacing && std::all_of(row.begin(), row.end(), [&](const Vec3& point) {
               return is_near_beginning(point, kClosesWithin * spacing);
             });
}

bool Ring::passes_through(const TetMesh& mesh, const SurfaceIndex& surface) const {
  const auto is_outside = [&](const Vec3& end) { return !locate(mesh, surface, {end, kFirstBladeKey}).is_valid(); };
  return is_outside(row_.front()) && is_outside(row_.back());
}

Strip Ring::sheet() const {
  SweptSurface surface;
  for (const auto& strip : strips_) append(surface, strip->surface);
  return {std::move(surface), {}};
}

bool is_joined_around(const TetMesh& mesh, const Sheet& sheet, const IncisionFront& front, PieceFinder& finder) {
  std::vector<TetId> beside;
  std::vector<std::size_t> sides;
  for (const TetId tet : find_near_tets(mesh, sheet)) {
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(tet)[s];
      if (!link.is_boundary() || link.tag() == 0 || !front.is_of_sheet(link.tag())) continue;
      const auto face = mesh.vertices(Side(tet, s));
      const Vec3 a = mesh.rest(face[0]), b = mesh.rest(face[1]), c = mesh.rest(face[2]);
      const auto hit = sheet.tree().closest((a + b + c) / 3, (b - a).norm() + (c - a).norm());
      if (!hit.is_valid()) continue;
      const Vec3 outward = paper::area_vector(mesh, {tet, s}).normalized();
      const double cosine = outward.dot(sheet.normal(hit.triangle).normalized());
      if (std::abs(cosine) < kAlongCosine) continue;
      beside.push_back(tet);
      sides.push_back(cosine > 0 ? 1 : 0);
    }
  }
  std::vector<std::array<std::size_t, 2>> walls(finder.find(mesh, beside), {0, 0});
  for (std::size_t i = 0; i < beside.size(); ++i) ++walls[finder.piece_of(i)][sides[i]];
  return std::any_of(walls.begin(), walls.end(), [](const auto& of) {
    return static_cast<double>(std::min(of[0], of[1])) > kJoinedShare * static_cast<double>(of[0] + of[1]);
  });
}

}  // namespace v0
}  // namespace incise
