// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "improve/constants.h"
#include "improve/region_volumes.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// A smooth part of a boundary, or of a border between regions, as one of its vertices sees it.
struct SurfaceAt {
  std::uint32_t tag = 0;             ///< of `Link`; `kBorderTag` for a border between regions
  Vec3 vector_area = Vec3::Zero();   ///< twice the sum of its faces' vector areas, outwards
  Vec3 first_normal = Vec3::Zero();  ///< unit
  bool is_flat = true;               ///< all faces in one plane, within `kOnePlane`, which moves do not leave
};

/// Tag of borders between regions.
inline constexpr std::uint32_t kBorderTag = 0x7FFFFFFFU;

/// Whether faces with these tags may be parts of one surface: walls of successive cuts continue each other.
inline bool are_alike(std::uint32_t a, std::uint32_t b) {
  const auto is_wall = [](std::uint32_t tag) { return tag != 0 && tag != kBorderTag; };
  return a == b || (is_wall(a) && is_wall(b));
}
/// The least cosine between the normals of two faces with these tags that are parts of one surface; above 1 for none.
inline double least_cosine(std::uint32_t a, std::uint32_t b) {
  return a == b ? kSmoothCosine : (are_alike(a, b) ? kSeamCosine : 2.0);
}

/// How freely a vertex may move.
enum class Mobility : std::uint8_t {
  kFree,     ///< interior
  kSurface,  ///< within one surface
  kLine,     ///< along the line where two surfaces meet
  kFixed,    ///< a corner, a front, a pinched vertex
};

/// The surfaces that a vertex is part of: what it may do in smoothing and collapses alike.
struct VertexSurfaces {
  std::array<SurfaceAt, 2> surfaces;
  unsigned count = 0;  ///< of surfaces found; above 2 they are not kept
  Mobility mobility = Mobility::kFree;
  Vec3 along = Vec3::Zero();  ///< kLine: unit direction; kSurface: unit normal
  /// Where the two lips of a cut meet inside the body: the neighbours on the front. Invalid elsewhere.
  std::array<VertexId, 2> front_ends;

  [[nodiscard]] bool is_front() const { return front_ends[0].is_valid(); }
  [[nodiscard]] bool is_flat() const {
    return (count < 1 || surfaces[0].is_flat) && (count < 2 || surfaces[1].is_flat);
  }
  /// The surface that a face with this tag and unit normal belongs to; `count` where none does.
  [[nodiscard]] unsigned find(std::uint32_t tag, const Vec3& normal) const;
};

/// Adds a face, by tag and twice its vector area, to the surfaces of a vertex; `decide_mobility` closes the list.
void add_face(VertexSurfaces& found, std::uint32_t tag, const Vec3& area2);
void decide_mobility(VertexSurfaces& found);

/// Twice the vector area of a side, outwards.
Vec3 vector_area2(const TetMesh& mesh, Side side);

/// Adds what a tet at a vertex has to do with the volume of its region.
void add_tet(RegionVolumes& volumes, const TetMesh& mesh, TetId tet, VertexId vertex);

/// The tag of a side as maintenance sees it: of the boundary, `kBorderTag`, or -1 for an inner face.
std::int64_t surface_tag(const TetMesh& mesh, Side side);

/// Finds the surfaces at a vertex from its star. Moving it orthogonally to the vector area of every surface keeps the
/// volume on either side exactly: the volume is linear in the vertex, with that gradient. Where regions meet it moves
/// orthogonally to the gradient of each region's volume instead, which is the same unless a border meets something
/// curved. Cost: O(star), about 0.2 µs.
/// **Source:** Paper §2.5 (inside, surface and contour vertices). Differs: what a vertex may do follows from the faces
/// around it, sharp edges of the skin included.
VertexSurfaces surfaces_at(const TetMesh& mesh, VertexId vertex, const std::vector<TetId>& star);

/// The step of a vertex that gives every surface at it back the volume that it lost: `lost6[i]` is six times that of
/// surface i. Returns false where the vertex is on no surface, on more than two, or on two that are nearly parallel.
bool find_volume_step(const VertexSurfaces& surfaces, const std::array<double, 2>& lost6, Vec3& step);

/// Whether the front is straight at a place of a vertex that slides along it: it lies within `tolerance` of the line
/// between its neighbours there.
bool keeps_front(const TetMesh& mesh, const Vec3& place, const VertexSurfaces& surfaces, double tolerance);

}  // namespace v0
}  // namespace incise
