// SPDX-License-Identifier: Apache-2.0
// Looks for the surface where the scene's other files are, reads it and binds it; messages name the file.
#include "app/view/scene_fine_view.h"

#include <utility>

#include "app/model/fine_file.h"
#include "app/scene/scene_simulation.h"

namespace incise {
inline namespace v0 {
namespace app {

Result<std::optional<FineView>> fine_view_of(const Scene& scene, const TetMesh& mesh, const Journal& journal) {
  if (scene.model.surface.empty()) return std::optional<FineView>();
  const Result<std::filesystem::path> path = find_model(scene, scene.model.surface);
  if (!path.ok()) return path.error();
  Result<FineSurface> surface = read_fine_surface(*path);
  if (!surface.ok()) return surface.error();
  Result<FineView> view = FineView::bind(std::move(surface).value(), mesh, journal);
  if (!view.ok()) return Error{view.error().code, path->string() + ": " + view.error().message, view.error().ids};
  return std::optional<FineView>(std::move(view).value());
}

}  // namespace app
}  // namespace v0
}  // namespace incise
