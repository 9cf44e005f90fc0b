// SPDX-License-Identifier: Apache-2.0
// The commands that tell about the program: `incise completion` and `incise man`.
#include <memory>
#include <string>

#include "command.h"
#include "command_options.h"
#include "command_support.h"
#include "incise/version.h"
#include "shared/command_words.h"
#include "shared/completion.h"
#include "shared/manual.h"

namespace incise_cli {
namespace {

int print_completion(const CLI::App& root, const std::string& shell, const Terminal& terminal) {
  const std::string script =
      shell == "zsh" ? incise_apps::zsh_completion(root)
                     : incise_apps::bash_completion(root) + incise_apps::bash_completion_by_help("incise-view");
  return finish(terminal, terminal.data(script));
}

int print_manual(const CLI::App& root, const std::string& name, const Terminal& terminal) {
  const CLI::App* command = name.empty() ? &root : incise_apps::command_named(root, name);
  if (command == nullptr) return fail(terminal, incise_apps::unknown_command(root, {name}), kUsage);
  return finish(terminal, terminal.data(incise_apps::manual_page(root, *command, INCISE_VERSION)));
}

}  // namespace

Command add_completion(CLI::App& root) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* completion =
      add_command(root, "completion", "Print a script that completes commands and options in a shell",
                  "  source <(incise completion bash)\n"
                  "  incise completion zsh > ~/.zsh/functions/_incise");
  completion->add_option("SHELL", *shell, "bash or zsh")->required()->check(CLI::IsMember({"bash", "zsh"}));
  return {completion, [shell, &root](const Terminal& terminal) { return print_completion(root, *shell, terminal); }};
}

Command add_man(CLI::App& root) {
  const auto page = std::make_shared<std::string>();
  CLI::App* man = add_command(root, "man", "Print the manual page of incise, or of one of its commands, for man(1)",
                              "  incise man | man -l -\n  incise man cut > incise-cut.1");
  man->add_option("COMMAND", *page, "The command; without it the page of incise itself");
  return {man, [page, &root](const Terminal& terminal) { return print_manual(root, *page, terminal); }};
}

}  // namespace incise_cli
