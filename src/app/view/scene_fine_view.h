// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "app/scene/scene.h"
#include "app/view/fine_view.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The fine surface that a scene's model names, bound to its mesh as it stands; none where it names none. Errors: as
/// `find_model`, `read_fine_surface` and `EmbeddedSurface::bind`.
[[nodiscard]] Result<std::optional<FineView>> fine_view_of(const Scene& scene, const TetMesh& mesh,
                                                           const Journal& journal);

}  // namespace app
}  // namespace v0
}  // namespace incise
