// SPDX-License-Identifier: Apache-2.0
// Both scripts are written from CLI11's own tree, so that no option is listed twice.
#include "shared/completion.h"

#include <algorithm>

#include "shared/option_shape.h"

namespace incise_apps {
namespace {

using Words = std::vector<std::string>;

std::string joined(const Words& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

/// A name that a shell function may have.
std::string function_of(const CLI::App& root) {
  std::string name = "_" + root.get_name();
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

Words command_names(const CLI::App& root) {
  Words names;
  for (const CLI::App* command : root.get_subcommands({})) names.push_back(command->get_name());
  if (!names.empty()) names.emplace_back("help");
  return names;
}

/// Those of the command and, where it is not the root itself, of the root: they may stand behind it.
std::vector<const CLI::Option*> options_at(const CLI::App& root, const CLI::App& command) {
  std::vector<const CLI::Option*> options;
  for (const CLI::Option* option : command.get_options()) {
    if (option->nonpositional()) options.push_back(option);
  }
  if (&command == &root) return options;
  for (const CLI::Option* option : root.get_options()) {
    const auto is_same = [&](const CLI::Option* other) { return dashed_names(*other) == dashed_names(*option); };
    if (option->nonpositional() && std::none_of(options.begin(), options.end(), is_same)) options.push_back(option);
  }
  return options;
}

/// What a positional of a command may be, where it is one of a set, or itself a command.
Words positional_choices(const CLI::App& root, const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional()) continue;
    if (option->get_name(true) == "COMMAND") return command_names(root);
    if (!choices_of(*option).empty()) return choices_of(*option);
  }
  return {};
}

/// The part of bash's script about what may stand behind one command.
std::string bash_case(const CLI::App& root, const CLI::App& command) {
  Words names;
  std::string values;
  for (const CLI::Option* option : options_at(root, command)) {
    const Words dashed = dashed_names(*option);
    names.insert(names.end(), dashed.begin(), dashed.end());
    if (is_flag(*option)) continue;
    values += "        " + joined(dashed, "|") + ")";
    const Words choices = choices_of(*option);
    if (!choices.empty()) values += " COMPREPLY=($(compgen -W '" + joined(choices, " ") + "' -- \"$word\"))";
    values += " return ;;\n";
    if (!choices.empty()) values.replace(values.rfind(" return"), 7, "; return");
  }
  std::string text;
  if (!values.empty()) text += "      case $before in\n" + values + "      esac\n";
  text += "      options='" + joined(names, " ") + "'\n";
  const Words choices = positional_choices(root, command);
  if (!choices.empty()) text += "      words='" + joined(choices, " ") + "'\n";
  return text;
}

/// In single quotes for a shell, without what _arguments of zsh reads as marks.
std::string zsh_words(std::string text) {
  std::string out;
  for (const char c : text.substr(0, text.find('\n'))) {
    if (c == '\'') {
      out += "'\\''";
    } else if (c == '[' || c == ']' || c == ':') {
      out += std::string("\\") + c;
    } else {
      out += c;
    }
  }
  return out;
}

std::string zsh_value(const CLI::Option& option) {
  if (is_flag(option)) return "";
  const Words choices = choices_of(option);
  if (!choices.empty()) return ":value:(" + joined(choices, " ") + ")";
  return takes_file(option) ? ":file:_files" : ":value: ";
}

std::string zsh_arguments(const CLI::App& root, const CLI::App& command, const std::string& indent) {
  std::string text = "_arguments -s";
  for (const CLI::Option* option : options_at(root, command)) {
    const Words names = dashed_names(*option);
    for (const std::string& name : names) {
      const bool is_long = name.size() > 2;
      const std::string value = zsh_value(*option);
      text += " \\\n" + indent + "'(" + joined(names, " ") + ")" + name + (value.empty() || !is_long ? "" : "=") + "[" +
              zsh_words(option->get_description()) + "]" + value + "'";
    }
  }
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) text += " \\\n" + indent + "':" + option->get_name(true) + zsh_value(*option) + "'";
  }
  return text;
}

}  // namespace

std::string bash_completion(const CLI::App& root) {
  const std::string name = root.get_name(), function = function_of(root);
  std::string text =
      "# Completes " + name + " in bash. For this shell: source <(" + name + " completion bash)\n" + function +
      "() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command= options= words= i\n"
      "  COMPREPLY=()\n"
      "  [ \"$word\" != = ] || word=\n"
      "  [ \"$before\" != = ] || before=${COMP_WORDS[COMP_CWORD - 2]}\n"
      "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
      "    case ${COMP_WORDS[i]} in -*) ;; *) command=${COMP_WORDS[i]} && break ;; esac\n"
      "  done\n"
      "  case $command in\n";
  for (const CLI::App* command : root.get_subcommands({})) {
    text += "    " + command->get_name() + ")\n" + bash_case(root, *command) + "      ;;\n";
  }
  const std::string commands = joined(command_names(root), " ");
  text += "    help) words='" + commands + "' ;;\n";
  text += "    '')\n" + bash_case(root, root) + "      words='" + commands + "'\n      ;;\n  esac\n";
  text +=
      "  case $word in\n"
      "    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
      "    *) [ -z \"$words\" ] || COMPREPLY=($(compgen -W \"$words\" -- \"$word\")) ;;\n"
      "  esac\n"
      "}\n"
      "complete -o default -F " +
      function + " " + name + "\n";
  return text;
}

std::string bash_completion_by_help(const std::string& name) {
  std::string function = "_" + name;
  std::replace(function.begin(), function.end(), '-', '_');
  return function +
         "() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} options=\n"
         "  COMPREPLY=()\n"
         "  case $word in -*) ;; *) return ;; esac\n"
         "  options=$(\"${COMP_WORDS[0]}\" --help 2>/dev/null | grep -oE -e '--[a-z][a-z-]*' | sort -u)\n"
         "  COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
         "}\n"
         "complete -o default -F " +
         function + " " + name + "\n";
}

std::string zsh_completion(const CLI::App& root) {
  const std::string name = root.get_name(), function = function_of(root);
  std::string text = "#compdef " + name + "\n# Completes " + name + " in zsh. For this shell: source <(" + name +
                     " completion zsh)\n" + function + "() {\n  local state\n  local -a commands\n  commands=(\n";
  for (const CLI::App* command : root.get_subcommands({})) {
    text += "    '" + command->get_name() + ":" + zsh_words(command->get_description()) + "'\n";
  }
  text += "    'help:Tell more of a command'\n  )\n  " + zsh_arguments(root, root, "    ") +
          " \\\n    '1:command:->command' '*::argument:->argument' && return\n  case $state in\n"
          "    command) _describe command commands ;;\n    argument)\n      case $words[1] in\n";
  for (const CLI::App* command : root.get_subcommands({})) {
    text +=
        "        " + command->get_name() + ")\n          " + zsh_arguments(root, *command, "            ") + " ;;\n";
  }
  text += "        help) _describe command commands ;;\n      esac ;;\n  esac\n}\n";
  text += "if [ \"$funcstack[1]\" = " + function + " ]; then\n  " + function + " \"$@\"\nelse\n  compdef " + function +
          " " + name + "\nfi\n";
  return text;
}

}  // namespace incise_apps
