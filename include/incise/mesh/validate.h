// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// How much `validate` looks at; each level includes those before it.
enum class ValidateLevel : std::uint8_t {
  kCounts,    ///< live counts, vertex ids, finite positions
  kTopology,  ///< reciprocal links, faces, boundary edges, vertex stars, orphans, duplicates
  kGeometry,  ///< the sign of every rest volume, and the total
};

/// One way to break the validity contract; also the index into `ValidityReport::counts`. The ids of a `Violation` are
/// named behind each.
enum class ViolationKind : std::uint8_t {
  kCount,            ///< a live count differs from the slots in use: counted, found
  kNotFinite,        ///< a position is infinite or not a number: vertex
  kBadCorner,        ///< a corner is no live vertex, or repeats another corner: tet, corner
  kBadLink,          ///< a link leads to no live tet or is not returned: tet, side
  kFaceMismatch,     ///< two linked sides have different vertices: tet, side
  kBadTetOf,         ///< `tet_of` is no live tet with that vertex: vertex
  kOrphanVertex,     ///< a live vertex without tets: vertex
  kDuplicateTet,     ///< a tet has the vertices of an earlier one: tet
  kOversharedFace,   ///< a face of skin with more than one boundary side, or a link beside: the first side's tet, side
  kUnseparatedFace,  ///< the same where a side is a cut wall: opened, but without vertices of its own
  kNonmanifoldEdge,  ///< a boundary edge of skin without exactly two boundary faces: vertex, vertex
  kNonmanifoldCutEdge,  ///< the same where one of its faces is a cut wall
  kSingletonVertex,     ///< the tets around a vertex are not face-connected: vertex
  kSingletonCutVertex,  ///< the same for a vertex on a cut wall
  kNotPositive,         ///< exact sign of rest volume ≤ 0: tet
  kVolumeDrift,         ///< total rest volume differs from the expected one
};

/// The number of kinds.
inline constexpr std::size_t kViolationKinds = 16;

/// The name of a kind in reports, for instance "nonmanifold_cut_edge".
[[nodiscard]] std::string_view name_of(ViolationKind kind);

/// One place where the contract is broken.
struct Violation {
  ViolationKind kind = ViolationKind::kCount;  ///< in which way
  std::array<std::uint64_t, 2> ids{};          ///< slots, meaning by kind; unused ones are 0
};

/// What `validate` lists and compares.
struct ValidateOptions {
  std::size_t max_listed = 16;      ///< violations kept with ids, over all kinds
  double expected_volume = 0;       ///< cubed length units; compared where > 0
  double volume_tolerance = 1e-12;  ///< relative; the validity contract's
};

/// What `validate` found.
struct ValidityReport {
  bool ok = true;                                       ///< no violation at all, the input's own included
  ValidateLevel level = ValidateLevel::kCounts;         ///< as asked for
  std::array<std::uint64_t, kViolationKinds> counts{};  ///< by `ViolationKind`
  std::vector<Violation> first;                         ///< the first `max_listed`, in order of discovery
  double volume = 0;                                    ///< total rest volume, where the level is kGeometry
  double volume_error = 0;                              ///< relative to the expected one, 0 where none was given

  /// Violations of one kind.
  [[nodiscard]] std::uint64_t count(ViolationKind kind) const { return counts[static_cast<std::size_t>(kind)]; }
};

/// Checks the validity contract of a mesh and reports what breaks it, with ids.
///
/// A mesh that came from dirty input reports the input's own defects too; `compare_with_input` tells them from those
/// that an edit made. Where corners or links are broken the levels above are skipped.
/// @return counts of all violations and the first few. Errors: none; any mesh may be passed.
/// Cost: O(n log n) in the faces of single vertices, about 1 µs per tet and 40 bytes of scratch per tet.
/// Thread-safe between commits. **Source:** the validity contract, `docs/internals.md`; singleton vertices: Paper §2.4.
[[nodiscard]] ValidityReport validate(const TetMesh& mesh, ValidateLevel level, const ValidateOptions& options = {});

/// What an edit did to the violations of a mesh.
struct ValidityChange {
  bool ok = true;                                      ///< nothing grew
  std::array<std::uint64_t, kViolationKinds> grown{};  ///< by how many each kind grew
};

/// Compares two reports of the same level, of one mesh before and after edits: violations that were there before are
/// the input's named defects, which must not grow; everything above is the edit's.
[[nodiscard]] ValidityChange compare_with_input(const ValidityReport& before, const ValidityReport& after);

}  // namespace v0
}  // namespace incise
