// SPDX-License-Identifier: Apache-2.0
// The commands `incise info` and `incise check`.
#include <memory>
#include <optional>
#include <string>

#include "app/model/mesh_info.h"
#include "command.h"
#include "command_options.h"
#include "command_support.h"
#include "incise/io/mesh_loader.h"
#include "input_kind.h"

namespace incise_cli {
namespace {

using namespace incise;

/// Percent of the time of a million tets in a binary file that has gone by when it is read.
constexpr unsigned kRead = 20;

struct InfoArguments {
  std::string mesh;
  bool as_json = false;
};

int run_info(const InfoArguments& arguments, const Terminal& terminal) {
  std::optional<ProgressBar> bar(std::in_place, terminal);
  bar->show_stage("reading", 0);
  const Result<io::MeshFile> file = io::read_mesh(input_of(arguments.mesh));
  if (file.ok()) bar->show_stage("measuring", kRead);
  if (!file.ok()) bar.reset();
  if (!file.ok()) return fail(terminal, explain_kind(file.error(), arguments.mesh, FileKind::kMesh), kBadInput);
  const app::MeshInfo info = app::inspect(*file, name_of_input(arguments.mesh));
  bar.reset();
  return finish(terminal, terminal.data(arguments.as_json ? app::to_json(info) : app::to_text(info)));
}

int run_check(const InfoArguments& arguments, const Terminal& terminal) {
  std::optional<ProgressBar> bar(std::in_place, terminal);
  bar->show_stage("reading", 0);
  Result<io::MeshFile> file = io::read_mesh(input_of(arguments.mesh));
  bar.reset();
  if (!file.ok()) return fail(terminal, explain_kind(file.error(), arguments.mesh, FileKind::kMesh), kBadInput);
  bar.emplace(terminal);
  const auto progress = [&bar](std::size_t done, std::size_t total) {
    bar->show_stage("checking", static_cast<unsigned>(100 * done / total));
  };
  const Result<app::MeshCheck> check =
      app::check_mesh(std::move(file).value(), name_of_input(arguments.mesh), progress);
  bar.reset();
  if (!check.ok()) return fail(terminal, check.error(), kBadInput);
  const int code = finish(terminal, terminal.data(arguments.as_json ? app::to_json(*check) : app::to_text(*check)));
  return code == kDone && !check->ok ? kCheckFailed : code;
}

}  // namespace

Command add_info(CLI::App& root) {
  const auto arguments = std::make_shared<InfoArguments>();
  CLI::App* info = add_command(root, "info", "Say what is in a mesh file and what is wrong with it",
                               "  incise info liver.msh\n  incise info liver.msh --json");
  info->add_option("MESH", arguments->mesh, kMeshHelp)->required();
  add_json(*info, arguments->as_json);
  return {info, [arguments](const Terminal& terminal) { return run_info(*arguments, terminal); }};
}

Command add_check(CLI::App& root) {
  const auto arguments = std::make_shared<InfoArguments>();
  CLI::App* check = add_command(root, "check", "Check validity and quality; exit 4 where the mesh is invalid",
                                "  incise check liver.msh\n  incise check cut.vtu --json");
  check->add_option("MESH", arguments->mesh, kMeshHelp)->required();
  add_json(*check, arguments->as_json);
  return {check, [arguments](const Terminal& terminal) { return run_check(*arguments, terminal); }};
}

}  // namespace incise_cli
