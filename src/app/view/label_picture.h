// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/view/picture.h"
#include "incise/mesh/journal.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace app {

/// A picture of a body's regions, each in its own colour, with the edges of the tets. Where there are several, the half
/// towards the eye is left out, so that those inside are seen. The body lies as scans do (RAS): its front is y, its
/// top z. Cost: O(tets).
[[nodiscard]] Picture picture_of_labels(const TetMesh& mesh, const Journal& journal, const Viewport& viewport);

}  // namespace app
}  // namespace v0
}  // namespace incise
