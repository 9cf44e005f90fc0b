// SPDX-License-Identifier: Apache-2.0
// Both of Bielser's divisions as one pipeline with two schemes of points; parts, walls and links are those of
// `Refinement`.
#include "lab/bielser.h"

#include "lab/opening.h"
#include "lab/refinement.h"
#include "paper/contact.h"
#include "paper/crossing.h"

namespace incise {
inline namespace v0 {
namespace lab {

namespace {

/// No tet gets more parts: the points of a tet span fewer.
constexpr std::size_t kMostParts = 30;

Status divide(const CutContext& context, const Sheet& sheet, std::uint32_t tag, unsigned threads, Scheme scheme) {
  Neighbourhood near;
  find_crossings(context.mesh, sheet, find_near_tets(context.mesh, sheet, threads), near, threads);
  Refinement refinement(context.mesh, near, scheme);
  if (std::size_t{context.mesh.tet_slots()} + kMostParts * refinement.filled_tets() >= TetMesh::kMaxTets) {
    return Error{ErrorCode::kOutOfMemory, "the cut would need more than 2^28 tets; use a coarser mesh", {}};
  }
  const std::size_t before = context.mesh.tet_count();
  context.statistics.cut_tets += refinement.divided_tets();
  context.statistics.blocked_edges += refinement.blocked_edges();
  Transaction transaction(context.mesh);
  const std::vector<IncisionFace> faces = refinement.apply(transaction);
  open_faces(transaction, faces, tag, context.statistics);
  commit(context, transaction, sides_of(faces));
  context.statistics.created_tets += growth(before, context.mesh.tet_count());
  return {};
}

}  // namespace

Status divide_into_17(const CutContext& context, const Sheet& sheet, std::uint32_t tag, unsigned threads) {
  return divide(context, sheet, tag, threads, Scheme::kSeventeen);
}

Status divide_adaptively(const CutContext& context, const Sheet& sheet, std::uint32_t tag, unsigned threads) {
  return divide(context, sheet, tag, threads, Scheme::kAdaptive);
}

}  // namespace lab
}  // namespace v0
}  // namespace incise
