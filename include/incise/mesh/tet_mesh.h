// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "incise/core/id_array.h"
#include "incise/core/result.h"
#include "incise/geom/vec.h"
#include "incise/mesh/tet_soup.h"
#include "incise/mesh/tet_tables.h"

namespace incise {
inline namespace v0 {

/// One side of one tet: the face opposite a corner, as that tet sees it.
struct Side {
  std::uint32_t value = kInvalidIndex;  ///< tet slot · 4 + side

  constexpr Side() = default;
  /// Side `side`, in [0, 3], of a tet.
  constexpr Side(TetId tet, unsigned side) : value(tet.value * 4 + side) {}
  [[nodiscard]] constexpr TetId tet() const { return TetId(value >> 2U); }  ///< the tet that sees it
  [[nodiscard]] constexpr unsigned side() const { return value & 3U; }      ///< in [0, 3]: the corner opposite
  friend constexpr bool operator==(Side a, Side b) { return a.value == b.value; }
  friend constexpr bool operator!=(Side a, Side b) { return a.value != b.value; }
  friend constexpr bool operator<(Side a, Side b) { return a.value < b.value; }
};

/// What lies behind a side of a tet: the matching side of its neighbour, or the boundary with a tag.
struct Link {
  static constexpr std::uint32_t kBoundaryBit = 0x80000000U;  ///< set: boundary
  std::uint32_t value = kBoundaryBit;                         ///< the neighbour's `Side`, or the bit and a tag

  constexpr Link() = default;
  /// The other tet's view of the shared face.
  constexpr explicit Link(Side other) : value(other.value) {}
  /// A boundary: tag 0 is skin, tag k > 0 is the cut wall of stroke k.
  static constexpr Link boundary(std::uint32_t tag) {
    Link link;
    link.value = kBoundaryBit | tag;
    return link;
  }
  [[nodiscard]] constexpr bool is_boundary() const { return (value & kBoundaryBit) != 0; }  ///< no tet behind
  [[nodiscard]] constexpr std::uint32_t tag() const { return value & ~kBoundaryBit; }       ///< of a boundary alone
  /// The same face as the neighbour sees it; only where it is no boundary.
  [[nodiscard]] constexpr Side side() const {
    Side other;
    other.value = value;
    return other;
  }
  friend constexpr bool operator==(Link a, Link b) { return a.value == b.value; }
  friend constexpr bool operator!=(Link a, Link b) { return a.value != b.value; }
};

/// The corners of a tet, in the order of `tet_tables.h`; positive: (1-0)×(2-0)·(3-0) > 0.
using TetVertices = std::array<VertexId, 4>;
/// Those of a free slot.
inline constexpr TetVertices kNoVertices{};
/// What lies behind the sides of a tet; side s is opposite corner s.
using TetLinks = std::array<Link, 4>;

namespace detail {

struct TransactionLists;

/// The lists of a mesh's transactions, made when they are first asked for. A copy has none yet.
class OwnLists {
 public:
  OwnLists() = default;
  OwnLists(const OwnLists& /*other*/) noexcept {}
  OwnLists(OwnLists&&) = default;
  OwnLists& operator=(const OwnLists& /*other*/) noexcept { return *this; }
  OwnLists& operator=(OwnLists&&) = default;
  ~OwnLists() = default;

  TransactionLists& get();

 private:
  std::shared_ptr<TransactionLists> lists_;
};

}  // namespace detail

/// What a vertex is part of: one bit mask that snapping, collapse, flips and smoothing read alike.
/// No bit: an interior vertex.
namespace shape {
inline constexpr std::uint8_t kSkin = 1;     ///< on the body's original surface
inline constexpr std::uint8_t kWall = 2;     ///< on a cut wall; with kSkin: on the contour of a cut
inline constexpr std::uint8_t kFront = 4;    ///< where a cut ends inside the body
inline constexpr std::uint8_t kPinched = 8;  ///< its tets were not face-connected at load: a defect of the input
inline constexpr std::uint8_t kDead = 128;   ///< the slot is free
}  // namespace shape

class Transaction;

/// The arrays of a mesh by slot, free slots included: for bindings that pass them on without a copy.
struct MeshArrays {
  std::span<const TetVertices> tets;               ///< by tet slot; the first vertex is invalid where the slot is free
  std::span<const TetLinks> links;                 ///< by tet slot
  std::span<const std::int32_t> regions;           ///< by tet slot: labels
  std::span<const std::uint32_t> tet_generations;  ///< by tet slot
  std::span<const Vec3> rest, current;             ///< by vertex slot, length unit
  std::span<const VertexId> origins;               ///< by vertex slot: see `TetMesh::origin`
  std::span<const std::uint32_t> vertex_generations;  ///< by vertex slot
  std::span<const std::uint8_t> shapes;               ///< by vertex slot: bits of `shape`
};

/// Bodies extend over lengths between these, in whatever unit, and no coordinate lies further from the origin: what is
/// computed of edges goes up to their eighth powers, and must neither overflow nor vanish.
inline constexpr double kLeastExtent = 1e-30, kGreatestExtent = 1e30;

/// A tetrahedral mesh as a structure of arrays with tet-to-tet adjacency.
///
/// Slots: every tet and vertex lives in a numbered slot until it dies; freed slots are reused, last freed first, but
/// never inside the transaction that freed them. A generation per slot tells reuse apart and only grows.
/// Faces and edges are not stored: a face is a `Side`, an edge a pair of vertices.
/// Edits go through `Transaction`; const reads are safe from any thread between commits.
/// Memory: about 52 bytes per tet, vertices included, on meshes with 5 to 6 tets per vertex.
class TetMesh {
 public:
  /// The largest number of tet slots that a `Link` can address.
  static constexpr std::uint32_t kMaxTets = 1U << 28U;
  /// The largest number of a stroke that walls may come with; 2^30 more find room above it.
  static constexpr std::uint32_t kMaxStroke = 1U << 30U;

  TetMesh() = default;

  /// Builds the mesh and its adjacency from a soup.
  ///
  /// Every tet must be positive or flat, by exact sign, and appear once (`normalise` sees to both); indices must be in
  /// range and points finite. A face with more than two tets gets no neighbours: each of its sides is boundary.
  /// Points without tets are kept as vertices. Slot numbers equal positions in the soup.
  /// A wall tags the boundary side over its three points. It is passed over where there is none (two tets that share
  /// the face have closed it) or more than one, and where walls of several strokes claim the side. Without
  /// `soup.fronts` a cut ends at the edges where its lips meet: two walls that lie on one another with the body all
  /// around.
  /// Errors: kBadArgument names the first offending tet (inverted ones too), point or wall (a point out of range, a
  /// stroke outside [1, `kMaxStroke`]), or the array of a wrong length, or what the tets extend over where that is not
  /// within `kLeastExtent` and `kGreatestExtent` (a body of no extent at all is flat, and sound); kOutOfMemory above
  /// 2^28 tets. Cost: O(n), about 0.15 µs per tet and 16 bytes of scratch per tet; with walls O(surface · log walls)
  /// more.
  static Result<TetMesh> build(TetSoup soup);

  /// Live tets.
  [[nodiscard]] std::size_t tet_count() const { return live_tets_; }
  /// Live vertices.
  [[nodiscard]] std::size_t vertex_count() const { return live_vertices_; }
  /// One past the largest slot in use; loop over slots and skip those that are not live.
  [[nodiscard]] std::uint32_t tet_slots() const { return static_cast<std::uint32_t>(tet_vertices_.size()); }
  /// The same of vertices.
  [[nodiscard]] std::uint32_t vertex_slots() const { return static_cast<std::uint32_t>(vertex_tet_.size()); }

  /// Whether a slot holds a tet; any id may be asked for.
  [[nodiscard]] bool is_live(TetId tet) const { return tet.value < tet_slots() && tet_vertices_[tet][0].is_valid(); }
  /// Whether a slot holds a vertex; any id may be asked for.
  [[nodiscard]] bool is_live(VertexId vertex) const {
    return vertex.value < vertex_slots() && (vertex_shape_[vertex] & shape::kDead) == 0;
  }
  /// How often the slot was freed: who keeps an element over several steps compares it.
  [[nodiscard]] std::uint32_t generation(TetId tet) const { return tet_generation_[tet]; }
  /// The same of a vertex slot.
  [[nodiscard]] std::uint32_t generation(VertexId vertex) const { return vertex_generation_[vertex]; }

  /// The four corners, positive in this order.
  [[nodiscard]] const TetVertices& vertices(TetId tet) const { return tet_vertices_[tet]; }
  /// What lies behind the four sides.
  [[nodiscard]] const TetLinks& links(TetId tet) const { return tet_links_[tet]; }
  /// What lies behind one side.
  [[nodiscard]] Link link(Side side) const { return tet_links_[side.tet()][side.side()]; }
  /// The label that the input gave the tet, or its parent.
  [[nodiscard]] std::int32_t region(TetId tet) const { return tet_region_[tet]; }
  /// Whether the input named more than one region.
  [[nodiscard]] bool has_regions() const { return has_regions_; }
  /// The three vertices of a side, counter-clockwise seen from outside.
  [[nodiscard]] std::array<VertexId, 3> vertices(Side side) const {
    const TetVertices& corners = tet_vertices_[side.tet()];
    const auto& order = kSideCorners[side.side()];
    return {corners[order[0]], corners[order[1]], corners[order[2]]};
  }
  /// The corner of `tet` that holds `vertex`; 4 where none does.
  [[nodiscard]] unsigned corner_of(TetId tet, VertexId vertex) const {
    const TetVertices& corners = tet_vertices_[tet];
    unsigned corner = 0;
    while (corner < 4 && corners[corner] != vertex) {
      ++corner;
    }
    return corner;
  }

  /// One tet that contains the vertex; invalid for a vertex without tets.
  [[nodiscard]] TetId tet_of(VertexId vertex) const { return vertex_tet_[vertex]; }
  /// The bits of `shape`.
  [[nodiscard]] std::uint8_t shape_of(VertexId vertex) const { return vertex_shape_[vertex]; }
  /// The input vertex that this one is, or was duplicated from; invalid where a cut made it. Where the input was cut
  /// before, a vertex of what was cut first, and no slot of this mesh.
  [[nodiscard]] VertexId origin(VertexId vertex) const { return vertex_origin_[vertex]; }
  /// The place in the rest shape, length unit.
  [[nodiscard]] const Vec3& rest(VertexId vertex) const { return rest_[vertex]; }
  /// Where the body stands now, length unit.
  [[nodiscard]] const Vec3& current(VertexId vertex) const { return current_[vertex]; }
  /// Puts every live vertex where `positions[slot]` says: where the body stands now. One entry per vertex slot; finite.
  /// No step of the journal: the rest shape, and with it the hash, stays. Not while a transaction is open.
  void set_current(std::span<const Vec3> positions);
  /// Six times the signed rest volume; positive for a sound tet.
  [[nodiscard]] double rest_volume6(TetId tet) const;
  /// The signed rest volume, in cubed length units.
  [[nodiscard]] double rest_volume(TetId tet) const { return rest_volume6(tet) / 6.0; }

  /// The tets without volume to speak of at load (`is_flat`), ascending. They are never divided.
  [[nodiscard]] const std::vector<TetId>& flat_at_load() const { return flat_at_load_; }
  /// Cost: O(log of their number).
  [[nodiscard]] bool is_flat_at_load(TetId tet) const;

  /// Whether the input's tets touched along an edge or at a vertex without sharing a face (a boundary edge with more
  /// than two boundary faces, or a pinched vertex).
  [[nodiscard]] bool touched_itself_at_load() const { return touched_itself_at_load_; }

  /// Whether two neighbours lay on one side of the face between them at load: the space around it is taken twice. Such
  /// a mesh is cut, but not maintained.
  [[nodiscard]] bool folds_over_at_load() const { return folds_over_at_load_; }

  /// Whether an edge belonged to a face with more than two tets at load. Where the input overlaps itself so, its edges
  /// cannot be divided without making more of the defect. Cost: O(log of the number of such edges).
  [[nodiscard]] bool is_overshared_at_load(VertexId a, VertexId b) const;

  /// Whether there were such edges: the input overlapped itself. Cost: O(1).
  [[nodiscard]] bool overlaps_at_load() const { return !overshared_edges_.empty(); }

  /// Calls `visit(TetId)` for every live tet, ascending.
  template <class Visit>
  void for_each_tet(Visit&& visit) const {
    for (std::uint32_t slot = 0; slot < tet_slots(); ++slot) {
      if (tet_vertices_[TetId(slot)][0].is_valid()) {
        visit(TetId(slot));
      }
    }
  }
  /// Calls `visit(VertexId)` for every live vertex, ascending.
  template <class Visit>
  void for_each_vertex(Visit&& visit) const {
    for (std::uint32_t slot = 0; slot < vertex_slots(); ++slot) {
      if ((vertex_shape_[VertexId(slot)] & shape::kDead) == 0) {
        visit(VertexId(slot));
      }
    }
  }

  /// The hash of connectivity, rest positions, regions, tags, shape bits, origins and free lists; generations and
  /// current positions stay out of it, so that undo restores it. Equal on every compiler and target. Cost: O(slots),
  /// about 20 ns per tet.
  [[nodiscard]] std::uint64_t hash() const;

  /// Valid until the next commit, undo or redo; where `has_stable_addresses`, the memory stays as long as the mesh.
  [[nodiscard]] MeshArrays arrays() const;
  /// Whether the arrays stay in their places while they grow. False where no address space can be reserved: under a
  /// limit on virtual memory, on systems without overcommitment, and in WebAssembly.
  [[nodiscard]] bool has_stable_addresses() const;

  /// Bytes held by the arrays, as used (not as reserved).
  [[nodiscard]] std::size_t memory_bytes() const;

  /// Whether the lips of a cut meet at the edge between the corners `corner` and (`corner` + 1) mod 3 of a wall's
  /// `vertices(wall)`: the next boundary face around the edge is a wall that lies on this one, and the body is all
  /// around. Cost: O(tets around the edge).
  [[nodiscard]] bool is_front_edge(Side wall, unsigned corner) const;

 private:
  friend class Transaction;
  friend class Journal;

  Status take_points(const TetSoup& soup);
  Status take_tets(const TetSoup& soup);
  [[nodiscard]] Status check_extent() const;
  [[nodiscard]] Status check_orientation() const;
  void link_faces();
  void tag_walls(const std::vector<SoupWall>& walls);
  void mark_shapes();
  void mark_fronts(const TetSoup& soup);
  void find_loose_edges();
  [[nodiscard]] bool is_folded(Side side) const;
  void find_folds();

  IdArray<TetId, TetVertices> tet_vertices_;
  IdArray<TetId, TetLinks> tet_links_;
  IdArray<TetId, std::int32_t> tet_region_;
  IdArray<TetId, std::uint32_t> tet_generation_;
  IdArray<VertexId, Vec3> rest_;
  IdArray<VertexId, Vec3> current_;
  IdArray<VertexId, TetId> vertex_tet_;
  IdArray<VertexId, VertexId> vertex_origin_;
  IdArray<VertexId, std::uint32_t> vertex_generation_;
  IdArray<VertexId, std::uint8_t> vertex_shape_;
  GrowArray<std::uint32_t> free_tets_;
  GrowArray<std::uint32_t> free_vertices_;
  ZeroedArray<std::uint32_t> edit_tet_marks_;     // scratch of the open transaction; all zero between transactions
  ZeroedArray<std::uint32_t> edit_vertex_marks_;  // likewise
  detail::OwnLists edit_lists_;                   // likewise; a copy of the mesh has its own
  std::vector<TetId> flat_at_load_;
  std::vector<std::uint64_t> overshared_edges_;  // ascending; lower slot · 2^32 + higher slot
  bool touched_itself_at_load_ = false;
  bool folds_over_at_load_ = false;
  bool has_regions_ = false;
  std::size_t live_tets_ = 0;
  std::size_t live_vertices_ = 0;
};

}  // namespace v0
}  // namespace incise
