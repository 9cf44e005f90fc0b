// SPDX-License-Identifier: Apache-2.0
// The walls of one incision: strokes that go on from one another have numbers in a row.
#pragma once

#include <cstdint>

#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// The strokes that an incision was made in, so far: [first, last].
struct StrokeTags {
  std::uint32_t first = 1, last = 1;

  /// Whether a link is a wall of the incision.
  [[nodiscard]] bool own(Link link) const { return link.is_boundary() && link.tag() >= first && link.tag() <= last; }
  /// What new walls are linked to.
  [[nodiscard]] Link wall() const { return Link::boundary(last); }
};

}  // namespace v0
}  // namespace incise
