// SPDX-License-Identifier: Apache-2.0
// The two options are one pair: a drawn surface needs a surface, which messages say before any work is done.
#include "fine_output.h"

#include <CLI/CLI.hpp>
#include <utility>

#include "app/model/fine_file.h"

namespace incise_cli {

using namespace incise;

void add_fine(CLI::App& command, FineArguments& arguments) {
  command.add_option("--surface", arguments.surface,
                     "A fine triangle surface (.obj .stl .ply .off) that the mesh carries, and that is cut with it");
  command.add_option("--drawn", arguments.drawn,
                     "Write that surface and the walls of the cuts as they are drawn: .glb, or .obj .stl .ply .off");
}

std::string fine_problem(const FineArguments& a, bool has_surface) {
  if (a.drawn.empty()) return {};
  if (a.surface.empty() && !has_surface) return "--drawn writes the surface that --surface names; give both";
  if (a.drawn == "-" || a.drawn == a.surface) return "--drawn needs a file of its own";
  return app::drawn_file_problem(a.drawn);
}

Result<std::optional<app::FineView>> bind_fine(const FineArguments& a, const TetMesh& mesh) {
  if (a.surface.empty()) return std::optional<app::FineView>();
  Result<FineSurface> surface = app::read_fine_surface(a.surface);
  if (!surface.ok()) return surface.error();
  Result<app::FineView> fine = app::FineView::bind(std::move(surface).value(), mesh, Journal());
  if (!fine.ok()) return Error{fine.error().code, a.surface + ": " + fine.error().message, fine.error().ids};
  return std::optional<app::FineView>(std::move(fine).value());
}

Result<app::GltfBody> body_of(app::FineView& fine, const TetMesh& mesh, const Journal& journal,
                              double metres_per_unit) {
  app::SurfaceFrame frame;
  if (const Status shown = fine.show(mesh, journal, frame); !shown.ok()) return shown.error();
  app::GltfBody body;
  body.surface = fine.drawn();
  body.metres_per_unit = metres_per_unit;
  fill(body.surface, mesh, body.positions, body.normals);
  return body;
}

}  // namespace incise_cli
