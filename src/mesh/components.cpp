// SPDX-License-Identifier: Apache-2.0
// Floods from each tet that has no label yet, in the order of slots.
#include "incise/mesh/components.h"

#include "mesh/sum_internal.h"

namespace incise {
inline namespace v0 {
namespace {

// Labels everything that `seed` reaches through faces. `pending` is scratch.
void flood(const TetMesh& mesh, TetId seed, std::uint32_t piece, std::vector<std::uint32_t>& label,
           std::vector<TetId>& pending) {
  label[seed.value] = piece;
  pending.assign(1, seed);
  while (!pending.empty()) {
    const TetId tet = pending.back();
    pending.pop_back();
    for (const Link link : mesh.links(tet)) {
      if (link.is_boundary()) continue;
      const TetId next = link.side().tet();
      if (next.value >= label.size() || label[next.value] != kInvalidIndex) continue;
      label[next.value] = piece;
      pending.push_back(next);
    }
  }
}

}  // namespace

Components find_components(const TetMesh& mesh) {
  Components found;
  found.label.assign(mesh.tet_slots(), kInvalidIndex);
  std::vector<TetId> pending;
  std::vector<detail::Sum> volumes;
  mesh.for_each_tet([&](TetId tet) {
    if (found.label[tet.value] == kInvalidIndex) {
      flood(mesh, tet, static_cast<std::uint32_t>(volumes.size()), found.label, pending);
      volumes.emplace_back();
      found.tet_count.push_back(0);
    }
    const std::uint32_t piece = found.label[tet.value];
    ++found.tet_count[piece];
    volumes[piece].add(mesh.rest_volume(tet));
  });
  for (const detail::Sum& sum : volumes) found.volume.push_back(sum.value());
  return found;
}

}  // namespace v0
}  // namespace incise
