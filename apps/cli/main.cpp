// SPDX-License-Identifier: Apache-2.0
// The command `incise`: reads arguments, runs one command, returns its exit code.
#include <algorithm>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "command_line.h"
#include "command_support.h"
#include "incise/version.h"
#include "shared/command_words.h"
#include "shared/completion.h"
#include "shared/manual.h"
#include "terminal.h"

namespace incise_cli {
namespace {

int print_completion(const CLI::App& root, const std::string& shell, const Terminal& terminal) {
  const bool is_zsh = shell == "zsh";
  return finish(terminal,
                terminal.data(is_zsh ? incise_apps::zsh_completion(root) : incise_apps::bash_completion(root)));
}

int print_manual(const CLI::App& root, const std::string& name, const Terminal& terminal) {
  const CLI::App* command = name.empty() ? &root : incise_apps::command_named(root, name);
  if (command == nullptr) return fail(terminal, incise_apps::unknown_command(root, {name}), kUsage);
  return finish(terminal, terminal.data(incise_apps::manual_page(root, *command, INCISE_VERSION)));
}

int dispatch(const CLI::App& root, Arguments& a, const Terminal& terminal) {
  if (root.got_subcommand("info")) return run_info(a.info, terminal);
  if (root.got_subcommand("check")) return run_check(a.check, terminal);
  if (root.got_subcommand("improve")) return run_improve(a.improve, terminal);
  if (root.got_subcommand("simulate")) return run_simulate(a.simulate, terminal);
  if (root.got_subcommand("replay")) return run_replay(a.replay, terminal);
  if (root.got_subcommand("convert")) return run_convert(a.convert, terminal);
  if (root.got_subcommand("completion")) return print_completion(root, a.shell, terminal);
  if (root.got_subcommand("man")) return print_manual(root, a.manual, terminal);
  a.cut.has_snap = root.get_subcommand("cut")->count("--snap") > 0;
  return run_cut(a.cut, terminal);
}

int run(int argc, char** argv) {
  CLI::App root("incise cuts tetrahedral meshes", "incise");
  Arguments arguments;
  Terminal terminal;
  root.set_version_flag("--version", "incise " INCISE_VERSION);
  root.add_flag("-q,--quiet", terminal.is_quiet, "Print errors and asked-for data only");
  root.add_flag("-v,--verbose", terminal.is_verbose, "Print more of what happens");
  add_commands(root, arguments);
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
  return dispatch(root, arguments, terminal);
}

}  // namespace
}  // namespace incise_cli

int main(int argc, char** argv) {
  incise_cli::catch_interrupts();
  try {
    return incise_cli::run(argc, argv);
  } catch (const std::bad_alloc&) {
    incise_cli::Terminal().error("out of memory; use a smaller mesh or a larger machine");
  } catch (const std::exception& error) {
    incise_cli::Terminal().error(error.what());
  }
  return incise_cli::kFailure;
}
