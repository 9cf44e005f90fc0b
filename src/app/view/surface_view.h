// SPDX-License-Identifier: Apache-2.0
// What is seen of a mesh: its boundary as triangles that a renderer can take as they are.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "app/scene/half_space.h"
#include "incise/mesh/journal.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace app {

/// What a triangle is, in four bytes as a renderer takes them.
struct TriangleLook {
  static constexpr std::uint8_t kWall = 1;      ///< of a cut; else skin
  static constexpr std::uint8_t kNewest = 2;    ///< a wall of the newest stroke
  static constexpr std::uint8_t kInside = 4;    ///< between two tets, seen because of a clip plane
  static constexpr std::uint8_t kSmall = 8;     ///< its tet is too small: see `kSmallShare`
  static constexpr std::uint8_t kUnused = 128;  ///< a free slot: its corners are all the same point

  std::uint8_t flags = kUnused;
  std::uint8_t stroke = 0;   ///< of a wall: its stroke's number, modulo 256
  std::uint8_t region = 0;   ///< of its tet, modulo 256
  std::uint8_t quality = 0;  ///< of its tet, see `quality_byte`

  friend bool operator==(const TriangleLook&, const TriangleLook&) = default;
};

/// A tet of less than this share of the body's mean tet, as it is when it is first shown, is too small: the size
/// threshold of the paper's edge merging, by which its Figure 7 has yellow tets.
inline constexpr double kSmallShare = 0.01;
/// Above this L/r it is bad-shaped there, and red: the shape threshold.
inline constexpr double kRedRatio = 15;

/// L/r as a byte: 0 for a regular tet (2√6), 255 from 200 on, logarithmic between. 255 for flat tets.
[[nodiscard]] std::uint8_t quality_byte(double lr);
/// The least L/r that `quality_byte` gives this byte.
[[nodiscard]] double lr_of_quality_byte(std::uint8_t byte);

/// The triangles of a surface. Slots are stable: from one topology to the next only what changed differs, so that
/// comparing blocks tells what to upload. Immutable once published.
struct SurfaceTopology {
  std::uint64_t version = 0;  ///< grows with every change
  /// Per slot: three indices of points, counter-clockwise seen from outside. Skin and walls share no points, nor do
  /// `kInside` triangles with either, so that normals averaged at points keep the rims sharp.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<TriangleLook> looks;    ///< per slot
  std::vector<Side> sides;            ///< per slot: which side of which tet it is
  std::vector<VertexId> vertices;     ///< per point: the mesh vertex that it stands for
  std::vector<Eigen::Vector3f> rest;  ///< per point: its place in the rest shape, length unit
  std::vector<float> depths;  ///< per point: of a wall, how far below the rim it is along the wall at rest; else 0
  std::vector<std::array<std::uint32_t, 2>> contour_edges;  ///< pairs of points: where walls meet skin, a wound's rim
  std::vector<std::array<std::uint32_t, 2>> front_edges;    ///< pairs of points: where cuts end inside the body
  std::size_t used = 0;                                     ///< slots that are no free ones
};

/// A surface as it stands at one moment. Copies share the topology.
struct SurfaceFrame {
  std::shared_ptr<const SurfaceTopology> topology;  ///< never null once taken from a `SurfaceView`
  std::vector<Eigen::Vector3f> positions;           ///< per point, length unit
};

struct SurfaceOptions {
  std::optional<HalfSpace> clip;  ///< tets whose centroid lies in it, when it is set or the mesh changes, are left out
};

/// Follows a mesh through its journal and keeps its surface.
///
/// Cost: O(tets) at first, after an undo or redo and, while there is a clip plane, at every change; else O(changed
/// tets) and a copy of the topology per change, about 20 bytes per triangle. Not thread-safe.
class SurfaceView {
 public:
  explicit SurfaceView(const TetMesh& mesh, const Journal& journal);
  SurfaceView(SurfaceView&&) noexcept;
  SurfaceView& operator=(SurfaceView&&) noexcept;
  ~SurfaceView();

  /// Other options from the next `follow` on.
  void set_options(const SurfaceOptions& options);
  /// Catches up with the journal. Returns whether the topology changed.
  bool follow(const TetMesh& mesh, const Journal& journal);
  /// The topology as `follow` left it, with current positions. Cost: O(points), about 3 ns each.
  void fill(const TetMesh& mesh, SurfaceFrame& frame) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
