// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/view/fine_view.h"
#include "app/view/picture.h"
#include "incise/mesh/journal.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace app {

/// A picture of what cuts did to a body at rest, where lips lie on each other: several pieces stand apart, and where
/// there is one piece its skin lets the walls inside be seen. The eye is where it sees the walls at a slant.
/// @param fine  a surface that is seen in the place of the mesh's skin; may be null. Errors: as `FineView::show`.
/// Cost: O(tets).
[[nodiscard]] Result<Picture> picture_of_cut(const TetMesh& mesh, const Journal& journal, const Viewport& viewport,
                                             FineView* fine = nullptr);

}  // namespace app
}  // namespace v0
}  // namespace incise
