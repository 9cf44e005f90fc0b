// SPDX-License-Identifier: Apache-2.0
// The command `incise`: reads arguments, runs one command, returns its exit code.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "command.h"
#include "command_support.h"
#include "incise/version.h"
#include "shared/command_words.h"
#include "terminal.h"

namespace incise_cli {
namespace {

constexpr const char* kExitCodes =
    "Exit codes: 0 done, 1 failure, 2 usage, 3 bad input, 4 a check failed, 5 no display, 130 interrupted.\n"
    "Formats: .mesh .msh .vtk .vtu .node/.ele .veg .inp, tetrahedral .ply (read only); all also gzipped.\n"
    "- for a mesh reads it from stdin, and -o - writes it to stdout, with --format.";

/// Adds all commands; what is read here, `--help`, the manual pages and the completion all tell.
std::vector<Command> add_commands(CLI::App& root) {
  root.require_subcommand(1);
  root.footer(std::string("incise help COMMAND tells more of a command.\n\nExamples:\n  incise info liver.msh\n  "
                          "incise cut cube.mesh --plane 1,0,0,0.5 -o halves.vtu\n"
                          "  incise improve halves.vtu -o better.vtu\n  incise help cut\n\n") +
              kExitCodes);
  std::vector<Command> commands;
  for (const AddCommand add : command_table()) commands.push_back(add(root));
  return commands;
}

int run(int argc, char** argv) {
  CLI::App root("Cut tetrahedral meshes, and keep them fit to simulate", "incise");
  Terminal terminal;
  root.set_version_flag("--version", "incise " INCISE_VERSION);
  root.add_flag("-q,--quiet", terminal.is_quiet, "Print errors and asked-for data only");
  root.add_flag("-v,--verbose", terminal.is_verbose, "Print more of what happens");
  const std::vector<Command> commands = add_commands(root);
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  incise_apps::take_help(words);
  if (const std::string unknown = incise_apps::unknown_command(root, words); !unknown.empty()) {
    return fail(terminal, unknown, kUsage);
  }
  try {
    root.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 takes the last word first
  } catch (const CLI::Success& asked) {
    return root.exit(asked);
  } catch (const CLI::ParseError& error) {
    return fail(terminal, incise_apps::explain(root, words, error), kUsage);
  }
  const auto asked =
      std::find_if(commands.begin(), commands.end(), [](const Command& command) { return command.words->parsed(); });
  return asked->run(terminal);
}

int run_guarded(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    Terminal().error("out of memory; use a smaller mesh or a larger machine");
  } catch (const std::exception& error) {
    Terminal().error(error.what());
  }
  return kFailure;
}

/// The exit code of a command that returned `code`: what it printed has to arrive.
int with_stdout(int code) {
  const incise::Status status = Terminal().data({});
  return code == kDone ? finish(Terminal(), status) : code;
}

}  // namespace
}  // namespace incise_cli

int main(int argc, char** argv) {
  incise_cli::catch_interrupts();
  return incise_cli::with_stdout(incise_cli::run_guarded(argc, argv));
}
