// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "incise/core/profile.h"
#include "incise/core/result.h"
#include "incise/cut/options.h"
#include "incise/cut/stroke.h"
#include "incise/mesh/journal.h"

namespace incise {
inline namespace v0 {

/// A method of cutting that the paper cites, to compare with: docs/benchmark.md says what each is and where its
/// publication had to be read.
enum class LabMethod : std::uint8_t {
  kRemoval,    ///< elements on the path are removed: the paper's [7] and [8]
  kSnapping,   ///< vertices move onto the path, nothing is divided: the paper's [9]
  kMoving,     ///< vertices near the path move onto it, and what is still crossed is divided: the paper's [10]
  kAdaptive,   ///< points on all edges and sides that the path crosses: the paper's [11]
  kSeventeen,  ///< seventeen children of every element on the path: the paper's [12]
  kMinimal,    ///< the fewest children that fill both sides: the paper's [13]
};

/// All of them, by their names, in the order of `LabMethod`.
inline constexpr std::array<std::string_view, 6> kLabMethodNames = {"removal",  "snapping",  "moving",
                                                                    "adaptive", "seventeen", "minimal"};

/// The name of a method.
[[nodiscard]] constexpr std::string_view name_of(LabMethod method) {
  return kLabMethodNames[static_cast<std::size_t>(method)];
}
/// The method of that name, or nothing.
[[nodiscard]] std::optional<LabMethod> find_lab_method(std::string_view name);

/// Whether a method divides tets, or removes them or moves what they span.
[[nodiscard]] constexpr bool keeps_volume(LabMethod method) {
  return method == LabMethod::kAdaptive || method == LabMethod::kSeventeen || method == LabMethod::kMinimal;
}

/// Cuts a mesh at rest along a whole stroke by one of the methods; the mesh is not maintained.
///
/// Walls get `tag`, in [1, `TetMesh::kMaxStroke`). A sweep that meets itself is cut in parts, in the order of time.
/// `threads` in [1, 256] search the mesh; the result does not depend on it. Appends steps to the journal where the
/// blade meets the mesh. Removal, and what moves vertices, change the volume (`keeps_volume`), and removal may leave no
/// tets at all. Of the counts `CutStatistics::cut_tets` are tets that had corners on both sides; where vertices move
/// `snapped_vertices` are those that did and `bent_vertices` those that could not. Errors: kBadArgument for a malformed
/// stroke, and where tets of the input touched without sharing a face (`TetMesh::touched_itself_at_load`), but for
/// kMinimal; kOutOfMemory where ids or memory would run out; the mesh is then as before. Cost: one pass over the mesh
/// for each part, then O(cut tets · log cut tets).
Result<CutStatistics> cut_by(LabMethod method, TetMesh& mesh, Journal& journal, const Stroke& stroke, std::uint32_t tag,
                             unsigned threads = 1);

}  // namespace v0
}  // namespace incise
