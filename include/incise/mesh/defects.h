// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "incise/geom/quality.h"  // kFlatTetRatio
#include "incise/mesh/tet_soup.h"

namespace incise {
inline namespace v0 {

/// Names one kind of defect; also the index into `Defects::examples`.
enum class DefectKind : std::uint8_t {
  kInverted,
  kZeroVolume,
  kUnreferencedVertices,
  kDuplicateVertices,
  kDuplicateTets,
  kOversharedFaces,
  kNonmanifoldEdges,
  kSingletonVertices,
};

/// The number of kinds.
inline constexpr std::size_t kDefectKinds = 8;

/// How many examples of each defect are kept for messages.
inline constexpr std::size_t kDefectExamples = 4;

/// What is wrong with a soup of tets: counts, and the first few elements of each kind.
struct Defects {
  std::uint64_t inverted = 0;               ///< tets of the minority sign of volume, flat ones left out
  std::uint64_t zero_volume = 0;            ///< tets with |V| <= `kFlatTetRatio` L³, L the longest edge
  std::uint64_t unreferenced_vertices = 0;  ///< points that no tet uses
  std::uint64_t duplicate_vertices = 0;     ///< used points minus distinct positions among them
  std::uint64_t duplicate_tets = 0;         ///< tets minus distinct vertex sets
  std::uint64_t overshared_faces = 0;       ///< faces of more than two tets
  std::uint64_t nonmanifold_edges = 0;      ///< edges of boundary faces with a number of them other than two
  std::uint64_t singleton_vertices = 0;     ///< vertices whose tets are not all linked by faces at the vertex
  std::uint64_t components = 0;             ///< parts linked by faces of exactly two tets
  bool negative = false;                    ///< true where most tets have negative volume
  /// The first elements of each kind, by `DefectKind`, in rising order: tet numbers (for faces the first tet
  /// of each), vertex numbers, and for edges both vertices of each edge one after the other.
  std::array<std::vector<std::uint32_t>, kDefectKinds> examples;

  /// True where every count but `components` is zero.
  [[nodiscard]] bool none() const;
};

/// One line of a list of defects.
struct NamedDefect {
  std::string_view name;                ///< as in `incise info --json`, for instance "zero_volume"
  std::uint64_t count = 0;              ///< how many there are
  std::vector<std::uint32_t> examples;  ///< as in `Defects::examples`
};

/// Count what is wrong with a soup.
///
/// A boundary face is a face of exactly one tet; only faces of exactly two tets link tets.
/// @param soup  `n_tets × 4` indices, all below `n_points`; finite points.
/// @return counts; a soup without tets has none but unreferenced vertices.
/// Errors: none. Cost: O(n log n) time, about 120 bytes per tet; 1 s for a million tets. Thread-safe.
/// **Source:** singleton vertices: Paper §2.4; the other definitions are those of `docs/formats.md`.
[[nodiscard]] Defects find_defects(const TetSoup& soup);

/// List all kinds of defects in a fixed order, zero counts included.
///
/// @return `kDefectKinds` entries. Cost: O(1).
[[nodiscard]] std::vector<NamedDefect> list_defects(const Defects& defects);

/// Tets whose set of vertices a tet before them has, rising: a mesh of them cannot be cut there, since they have their
/// faces in common and lie in one place. Cost: O(n log n).
[[nodiscard]] std::vector<std::uint32_t> find_duplicate_tets(const TetSoup& soup);

/// What `normalise` changed.
struct Normalised {
  std::uint64_t flipped = 0;                ///< tets turned to positive volume
  std::uint64_t dropped = 0;                ///< exact duplicates removed
  std::uint64_t zero_volume = 0;            ///< flat tets that remain, as in `Defects`
  std::vector<std::uint32_t> dropped_tets;  ///< their old numbers, rising; for arrays kept beside the soup
};

/// Turn every negative tet to positive volume and drop exact duplicates.
///
/// A negative tet (by exact sign) has its last two vertices swapped; of equal vertex sets the first tet stays.
/// @param soup  `n_tets × 4` indices, all below `n_points`; `regions` is compacted along.
/// Errors: none. Cost: O(n log n). Points are left as they are.
Normalised normalise(TetSoup& soup);

}  // namespace v0
}  // namespace incise
