// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "incise/mesh/verbs.h"
#include "support/random.h"

namespace incise::test {

/// A few random splits of longest edges, as one step.
inline Step random_step(TetMesh& mesh, Random& random) {
  Transaction transaction(mesh);
  for (unsigned i = 0; i < 6; ++i) {
    TetId tet;
    do {
      tet = TetId(static_cast<std::uint32_t>(random.integer(0, mesh.tet_slots() - 1)));
    } while (!mesh.is_live(tet));
    unsigned longest = 0;
    double length = 0;
    const TetVertices v = mesh.vertices(tet);
    for (unsigned e = 0; e < 6; ++e) {
      const double l = (mesh.rest(v[kEdgeCorners[e][0]]) - mesh.rest(v[kEdgeCorners[e][1]])).norm();
      if (l > length) {
        length = l;
        longest = e;
      }
    }
    apply(transaction, plan_split_edge(mesh, v[kEdgeCorners[longest][0]], v[kEdgeCorners[longest][1]], tet, 0.5));
  }
  return transaction.commit();
}

}  // namespace incise::test
