// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "image/labelled_tets.h"

namespace incise {
inline namespace v0 {
namespace image {

/// What `mend_manifold` found.
struct ManifoldRepair {
  std::uint64_t relabelled = 0;  ///< tets
  std::uint64_t left = 0;        ///< points around which a label is in more than one piece still
};

/// Relabels tets until around each point and each edge the tets of each label, the background included, are connected
/// by faces: no label then touches itself in a point or an edge alone.
ManifoldRepair mend_manifold(LabelledTets& mesh);

}  // namespace image
}  // namespace v0
}  // namespace incise
