// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// A face along which material will be separated: its two sides.
struct IncisionFace {
  Side a, b;
};

}  // namespace v0
}  // namespace incise
