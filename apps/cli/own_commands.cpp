// SPDX-License-Identifier: Apache-2.0
// The commands that tell about the program: `incise completion` and `incise man`.
#include <memory>
#include <nlohmann/json.hpp>
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

/// `text` as it is, or as the one member of an object.
int print(const std::string& text, const char* name, bool as_json, const Terminal& terminal) {
  return finish(terminal, terminal.data(as_json ? nlohmann::json{{name, text}}.dump(2) + "\n" : text));
}

int print_completion(const CLI::App& root, const std::string& shell, bool as_json, const Terminal& terminal) {
  const std::string script =
      shell == "zsh" ? incise_apps::zsh_completion(root)
                     : incise_apps::bash_completion(root) + incise_apps::bash_completion_by_help("incise-view");
  return print(script, "script", as_json, terminal);
}

int print_manual(const CLI::App& root, const std::string& name, bool as_json, const Terminal& terminal) {
  const CLI::App* command = name.empty() ? &root : incise_apps::command_named(root, name);
  if (command == nullptr) return fail(terminal, incise_apps::unknown_command(root, {name}), kUsage);
  return print(incise_apps::manual_page(root, *command, INCISE_VERSION), "page", as_json, terminal);
}

}  // namespace

Command add_completion(CLI::App& root) {
  const auto shell = std::make_shared<std::string>();
  const auto as_json = std::make_shared<bool>(false);
  CLI::App* completion =
      add_command(root, "completion", "Print a script that completes commands and options in a shell",
                  "  source <(incise completion bash)\n"
                  "  incise completion zsh > ~/.zsh/functions/_incise");
  completion->add_option("SHELL", *shell, "bash or zsh")->required()->check(CLI::IsMember({"bash", "zsh"}));
  add_json(*completion, *as_json);
  return {completion, [shell, as_json, &root](const Terminal& terminal) {
            return print_completion(root, *shell, *as_json, terminal);
          }};
}

Command add_man(CLI::App& root) {
  const auto page = std::make_shared<std::string>();
  const auto as_json = std::make_shared<bool>(false);
  CLI::App* man = add_command(root, "man", "Print the manual page of incise, or of one of its commands, for man(1)",
                              "  incise man | man -l -\n  incise man cut > incise-cut.1");
  man->add_option("COMMAND", *page, "The command; without it the page of incise itself");
  add_json(*man, *as_json);
  return {man,
          [page, as_json, &root](const Terminal& terminal) { return print_manual(root, *page, *as_json, terminal); }};
}

}  // namespace incise_cli
