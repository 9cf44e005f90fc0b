// SPDX-License-Identifier: Apache-2.0
// A ribbon of two triangles for each part of the line, between the line and the cut's contour.
#include "app/view/exercise_marks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/scene/exercise_grade.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr double kLeastRibbon = 0.5;  // tolerances of the line
constexpr double kRibbonLift = 0.5;   // tolerances of the line, above the skin, which rises beside a cut
constexpr float kRibbonOpacity = 0.85F;
constexpr float kPatchOpacity = 0.45F;
constexpr float kLumpLine = 1.5F;  // pixels
constexpr double kSteep = 0.1;     // sine, of the way to up: below, the picture would turn about itself
constexpr double kLinePad = 0.2;   // of the line, that a picture from above shows around it

Ink ink_of(ExerciseOff off) {
  if (off == ExerciseOff::kWithin) return Ink::kWithin;
  return off == ExerciseOff::kNear ? Ink::kNear : Ink::kFar;
}

/// Both rims of the ribbon at a place: beyond the line on one side, and beyond the cut on the other.
/// @param along  of the line there.
std::array<Eigen::Vector3f, 2> ribbon_rims(const Exercise& exercise, const ExercisePlace& place, const Vec3& along) {
  const double tolerance = exercise.tolerances.line, half = 0.5 * kLeastRibbon * tolerance;
  Vec3 across = place.normal.cross(along);
  across = across.isZero(0) ? Vec3(place.normal.unitOrthogonal()) : Vec3(across.normalized());
  const double off = place.beside.dot(across);
  const Vec3 middle = place.ideal + kRibbonLift * tolerance * place.normal;
  const Vec3 low = middle + (std::min(off, 0.0) - half) * across, high = middle + (std::max(off, 0.0) + half) * across;
  return {low.cast<float>(), high.cast<float>()};
}

}  // namespace

ExerciseOff off_of(const Exercise& exercise, const ExercisePlace& place) {
  if (!place.is_cut) return ExerciseOff::kMissed;
  double tolerances = place.beside.norm() / exercise.tolerances.line;
  if (!exercise.remove) {
    tolerances = std::max(tolerances, std::abs(place.depth - exercise.depth) / exercise.tolerances.depth);
  }
  if (tolerances <= 1) return ExerciseOff::kWithin;
  return tolerances <= kFullFault ? ExerciseOff::kNear : ExerciseOff::kFar;
}

void mark_deviation(const Exercise& exercise, const ExerciseScore& score, Marks& marks) {
  for (std::size_t i = 1; i < score.profile.size(); ++i) {
    const ExercisePlace &a = score.profile[i - 1], &b = score.profile[i];
    if (!a.is_cut || !b.is_cut) continue;
    const Vec3 along = b.ideal - a.ideal;
    const auto [p, s] = ribbon_rims(exercise, a, along);
    const auto [q, r] = ribbon_rims(exercise, b, along);
    const Ink ink = ink_of(std::max(off_of(exercise, a), off_of(exercise, b)));
    marks.triangles.push_back({{p, q, r}, ink, kRibbonOpacity});
    marks.triangles.push_back({{p, r, s}, ink, kRibbonOpacity});
  }
}

void look_at_line(const ExerciseScore& score, const Viewport& viewport, Camera& camera) {
  if (score.profile.empty()) return;
  Vec3 normal = Vec3::Zero();
  Box line;
  for (const ExercisePlace& place : score.profile) {
    normal += place.normal;
    line.extend(place.ideal);
  }
  if (normal.isZero(0)) return;
  const Vec3 way = -normal.normalized();
  if (camera.up.cross(way).norm() < kSteep) camera.up = way.unitOrthogonal();
  const Vec3 pad = Vec3::Constant(kLinePad * score.target_length);
  look_along(camera, way);
  frame_all(camera, viewport, Box{line.lo - pad, line.hi + pad});
}

void mark_removal(const Exercise& exercise, const TetMesh& mesh, Marks& marks) {
  if (!exercise.remove) return;
  const std::vector<std::int32_t>& regions = exercise.remove->stop_at;
  const auto has = [&](TetId tet) {
    return std::find(regions.begin(), regions.end(), mesh.region(tet)) != regions.end();
  };
  const auto place = [&](VertexId v) -> Eigen::Vector3f { return mesh.current(v).cast<float>(); };
  mesh.for_each_tet([&](TetId tet) {
    if (!has(tet)) return;
    for (unsigned s = 0; s < 4; ++s) {
      const auto link = mesh.links(tet)[s];
      const auto v = mesh.vertices(Side(tet, s));
      if (link.is_boundary() && link.tag() == 0) {
        marks.triangles.push_back({{place(v[0]), place(v[1]), place(v[2])}, Ink::kSpot, kPatchOpacity});
      } else if (!link.is_boundary() && !has(link.side().tet())) {
        for (unsigned i = 0; i < 3; ++i) {
          if (v[i].value > v[(i + 1) % 3].value) continue;  // the neighbour's face has it the other way round
          marks.lines.push_back({place(v[i]), place(v[(i + 1) % 3]), Ink::kSpot, kLumpLine, true, false});
        }
      }
    }
  });
}

}  // namespace app
}  // namespace v0
}  // namespace incise
