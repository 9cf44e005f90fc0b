// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/io/mesh_file.h"

namespace incise::test {

/// A mesh format of one's own: "toy N M", then N lines "x y z", then M lines "a b c d region".
[[nodiscard]] io::MeshFormat toy_format();

}  // namespace incise::test
