// SPDX-License-Identifier: Apache-2.0
// A fine triangle surface that a coarser tet mesh carries, and that is cut with it (docs/organs.md, "A fine surface").
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "incise/core/result.h"
#include "incise/mesh/journal.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// Triangles to be carried by a tet mesh, as they are before anything is cut. Along a seam of the texture, or a crease,
/// points stand twice, at exactly equal places.
struct FineSurface {
  std::vector<Vec3> points;                             ///< `n_points`, where the mesh is at rest, in its length unit
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< `n_triangles × 3`, counter-clockwise seen from outside
  std::vector<std::array<double, 2>> texture;           ///< `n_points` or empty: texture coordinates
  std::vector<Vec3> normals;                            ///< `n_points` or empty: unit normals; made where empty
};

/// How a point hangs on a tet: by the point of the tet that is nearest to it, and the way from there.
struct Binding {
  TetId tet;                        ///< invalid for a free slot
  std::array<double, 4> weights{};  ///< of the tet's corners, of the nearest point: in [0, 1], sum 1
  std::uint8_t side = 4;            ///< the side that this point lies on; 4: the point is inside
  Vec3 offset = Vec3::Zero();       ///< from it to the point, length unit, in the frame of the side; 0 inside
  friend bool operator==(const Binding& a, const Binding& b) {
    return a.tet == b.tet && a.weights == b.weights && a.side == b.side && a.offset == b.offset;
  }
};

/// A point of an embedded surface.
struct FinePoint {
  Vec3 rest = Vec3::Zero();                 ///< its place at rest; it never changes
  Binding binding;                          ///< what carries it now
  std::array<double, 2> texture{};          ///< texture coordinates; interpolated where a cut made the point
  Vec3 normal = Vec3::Zero();               ///< at rest, unit length; likewise
  std::uint32_t next_free = kInvalidIndex;  ///< of a free slot: the free slot after it

  /// Whether the slot is in use.
  [[nodiscard]] bool is_live() const { return binding.tet.is_valid(); }
};

/// A triangle of an embedded surface: one that was given, or a part of one that a cut passes through.
struct FineTriangle {
  std::array<std::uint32_t, 3> points{};  ///< slots of points
  std::uint32_t root = kInvalidIndex;     ///< the triangle that was given; invalid for a free slot
  std::uint8_t lips = 0;                  ///< bit i: the edge from corner i to the next one runs along a wall
  std::uint32_t next = kInvalidIndex;     ///< the next part of the same root, or the free slot after it

  /// Whether the slot is in use.
  [[nodiscard]] bool is_live() const { return root != kInvalidIndex; }
  friend bool operator==(const FineTriangle& a, const FineTriangle& b) {
    return a.points == b.points && a.root == b.root && a.lips == b.lips;
  }
};

/// What a call of `EmbeddedSurface::follow` changed, for those who keep something for each slot.
struct FineChanges {
  std::uint64_t from = 0, to = 1;        ///< numbers of the surface's states before and after that call
  std::vector<std::uint32_t> points;     ///< slots, with repeats; one beyond `EmbeddedSurface::points` is there no more
  std::vector<std::uint32_t> triangles;  ///< likewise
};

/// How a fine surface may be bound.
struct EmbedOptions {
  /// The farthest that a point may lie outside the mesh, in mean edges of the mesh at rest; > 0.
  double greatest_distance = 2;
};

/// A fine triangle surface on a coarser tet mesh.
///
/// Points hang on the tets that they lie in at rest, or on the nearest ones. Where a wall of a cut parts the tets at
/// the two ends of an edge the edge is parted there, and its triangles are divided, so that no triangle spans a wound;
/// each side hangs on its own lip. Beyond the mesh a wall goes on as far as tets of both its lips are equally near.
/// A cut that ends in a triangle goes through to its far corner, and one that no edge of a triangle meets leaves it
/// whole. Where walls meet within a triangle the piece between them hangs on one tet.
///
/// What `follow` makes depends on the surface and the mesh as it stands, and on nothing that was between; only the
/// slots depend on the way. Slots of the points and triangles that were given are their numbers. Equal on every
/// compiler. Not thread-safe; others may read the mesh at the same time.
/// Memory: about 1 kB per triangle, and what `follow` keeps for undo.
class EmbeddedSurface {
 public:
  /// Binds a surface to a mesh as it stands, its walls included. Steps before cannot be followed back.
  /// Errors: kBadArgument for no triangles, a point that is out of range, not finite or too far from the mesh, arrays
  /// of a wrong length, a mesh without tets. Cost: O(n log n), about 10 µs per triangle.
  static Result<EmbeddedSurface> bind(FineSurface surface, const TetMesh& mesh, const Journal& journal = {},
                                      const EmbedOptions& options = {});

  EmbeddedSurface(EmbeddedSurface&&) noexcept;
  EmbeddedSurface& operator=(EmbeddedSurface&&) noexcept;
  ~EmbeddedSurface();

  /// Catches up with the journal, forwards or backwards; `mesh` is its mesh as it stands. What is undone or redone is
  /// bit for bit what it was, if the surface followed when it was there.
  /// Errors: kBadArgument where the journal went back behind where the surface began, or has trimmed steps that it has
  /// not seen: it must be bound anew. Cost: O(tets touched and the triangles near them).
  Status follow(const Journal& journal, const TetMesh& mesh);
  /// The journal position that it stands at.
  [[nodiscard]] std::size_t position() const;
  /// Grows whenever a triangle changes.
  [[nodiscard]] std::uint64_t version() const;
  /// The last change of anything, bindings among it. Whoever knows the surface as it was in state `from` needs to look
  /// at these slots alone; others at all of it.
  [[nodiscard]] const FineChanges& changes() const;

  /// All slots of points; the first ones are those that were given.
  [[nodiscard]] std::span<const FinePoint> points() const;
  /// All slots of triangles, likewise.
  [[nodiscard]] std::span<const FineTriangle> triangles() const;
  /// As it was given.
  [[nodiscard]] const FineSurface& source() const;
  /// How far its points lay outside the mesh when it was bound, at most; length unit.
  [[nodiscard]] double greatest_distance() const;
  /// How far from a triangle tets of the mesh may matter to it, at most; length unit.
  [[nodiscard]] double reach() const;
  /// Triangles that the last `follow` looked at, a measure of its work.
  [[nodiscard]] std::size_t looked_at() const;

  /// Where each point slot is as the body stands; free slots are at their places at rest. Cost: O(points).
  void fill(const TetMesh& mesh, std::vector<Vec3>& positions) const;
  /// The normals that belong to such positions: those at rest, turned as the triangles around turned; unit length.
  /// Cost: O(triangles).
  void fill_normals(std::span<const Vec3> positions, std::vector<Vec3>& normals) const;

  /// Binds a place at rest as a point of the surface would be: to the tet that holds it or is nearest, of those that
  /// hold it too the one that holds more of the way to `towards`. Cost: O(tets near it).
  [[nodiscard]] Binding locate(const TetMesh& mesh, const Vec3& rest, const Vec3& towards) const;
  /// The nearest point of the surface, as it was given, to a place at rest, within `reach`. Cost: O(log n).
  [[nodiscard]] std::optional<Vec3> find_nearest(const Vec3& rest, double reach) const;

 private:
  class Keeper;
  explicit EmbeddedSurface(std::unique_ptr<Keeper> keeper);
  std::unique_ptr<Keeper> keeper_;
};

/// Binds a place at rest to a tet: by the nearest point of the tet, and the way from there. Cost: O(1).
[[nodiscard]] Binding bind_to(const TetMesh& mesh, TetId tet, const Vec3& rest);
/// Where a bound place is as the body stands. Cost: O(1).
[[nodiscard]] Vec3 current_place(const TetMesh& mesh, const Binding& binding);

}  // namespace v0
}  // namespace incise
