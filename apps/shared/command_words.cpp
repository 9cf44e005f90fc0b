// SPDX-License-Identifier: Apache-2.0
// Levenshtein's distance to what is known, at most a third of the word: nearer words are suggested.
#include "shared/command_words.h"

#include <algorithm>
#include <utility>

namespace incise_apps {
namespace {

/// How many letters must be changed, added or left out to make one word of another.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, changed}));
    }
  }
  return row[b.size()];
}

Words commands_of(const CLI::App& root) {
  Words names = {"help"};
  for (const CLI::App* command : root.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

bool has_commands(const CLI::App& root) {
  return !root.get_subcommands({}).empty();
}

/// Where the command is to be: at the first word that is no option. What comes before takes no values.
Words::const_iterator command_word(const Words& words) {
  return std::find_if(words.begin(), words.end(), [](const auto& word) { return !word.empty() && word[0] != '-'; });
}

}  // namespace

std::string suggestion(const std::string& word, const Words& known) {
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  const std::string* nearest = nullptr;
  for (const std::string& candidate : known) {
    const std::size_t steps = distance(word, candidate);
    if (steps < least) {
      least = steps;
      nearest = &candidate;
    }
  }
  return nearest == nullptr ? "" : " (did you mean " + *nearest + "?)";
}

Words options_of(const CLI::App& command) {
  Words names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

const CLI::App* command_named(const CLI::App& root, const std::string& name) {
  for (const CLI::App* command : root.get_subcommands({})) {
    if (command->get_name() == name) return command;
  }
  return nullptr;
}

std::string unknown_command(const CLI::App& root, const Words& words) {
  const auto word = command_word(words);
  if (word == words.end() || command_named(root, *word) != nullptr) return "";
  return "'" + *word + "' is no command" + suggestion(*word, commands_of(root)) + "; see " + root.get_name() + " help";
}

std::string explain(const CLI::App& root, const Words& words, const CLI::ParseError& error) {
  Words known = options_of(root);
  std::string text = error.what(), see = "; see " + root.get_name() + (has_commands(root) ? " help" : " --help");
  const auto command = has_commands(root) ? command_word(words) : words.end();
  if (command != words.end()) {
    const Words more = options_of(*command_named(root, *command));
    known.insert(known.end(), more.begin(), more.end());
    see += " " + *command;
  }
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    const bool is_unknown = name.rfind("--", 0) == 0 && std::find(known.begin(), known.end(), name) == known.end();
    if (is_unknown) text += suggestion(name, known);
  }
  return text + see;
}

void take_help(Words& words) {
  const auto word = command_word(words);
  if (word == words.end() || *word != "help") return;
  words.erase(std::remove(words.begin(), words.end(), "help"), words.end());
  words.emplace_back("--help");
}

}  // namespace incise_apps
