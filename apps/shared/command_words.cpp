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

std::string without_dots(std::string text) {
  while (!text.empty() && text.back() == '.') text.pop_back();
  return text;
}

/// `text` where it begins with `before`: what follows, up to `between`, and what follows that.
bool take_apart(const std::string& text, const std::string& before, const std::string& between, std::string& first,
                std::string& second) {
  const std::size_t at = text.find(between, before.size());
  if (text.rfind(before, 0) != 0 || at == std::string::npos) return false;
  first = text.substr(before.size(), at - before.size());
  second = text.substr(at + between.size());
  return true;
}

/// The words that nothing takes, in the order of the call: CLI11 gives them from the last to the first.
std::string left_over(const std::string& listed, const Words& words) {
  Words found;
  for (std::size_t at = 0; at < listed.size();) {
    const std::size_t end = std::min(listed.find(' ', at), listed.size());
    found.insert(found.begin(), listed.substr(at, end - at));
    at = end + 1;
  }
  std::string text;
  for (const std::string& word : found) {
    const bool is_word = std::find(words.begin(), words.end(), word) != words.end();
    text += (text.empty() || !is_word ? "" : ", ") + word;
  }
  return text;
}

/// The first word that begins as an option and is none of these programs and commands; empty where there is none.
std::string unknown_option(std::initializer_list<const CLI::App*> apps, const Words& words) {
  Words known;
  std::string letters;
  for (const CLI::App* app : apps) {
    const Words names = options_of(*app);
    known.insert(known.end(), names.begin(), names.end());
    for (const CLI::Option* option : app->get_options()) {
      for (const std::string& name : option->get_snames()) letters += name;
    }
  }
  for (const std::string& word : words) {
    if (word.size() < 2 || word[0] != '-') continue;
    const bool is_known = word[1] == '-'
                              ? std::find(known.begin(), known.end(), word.substr(0, word.find('='))) != known.end()
                              : word.find_first_not_of(letters, 1) == std::string::npos;
    if (!is_known) return word;
  }
  return "";
}

/// CLI11's message in our words.
std::string in_plain_words(const CLI::ParseError& error, const Words& words) {
  const std::string text = error.what();
  std::string first, second;
  if (text == "A subcommand is required") return "no command is given";
  if (take_apart(text, "Could not convert: ", " = ", first, second)) return first + ": '" + second + "' is no number";
  if (take_apart(text, "", " were not expected: ", first, second) ||
      take_apart(text, "", " was not expected: ", first, second)) {
    return left_over(second, words) + ": not known here";
  }
  if (take_apart(text, "", ": 1 required ", first, second)) return first + ": its value is missing";
  if (take_apart(text, "", " is required", first, second)) return first + " is missing";
  if (take_apart(text, "", ": At Most 1 required but received ", first, second)) {
    return first + " is given " + second + " times; once is enough";
  }
  if (take_apart(text, "", " not in {", first, second)) {
    for (std::size_t at = 0; (at = second.find(',', at)) != std::string::npos; at += 2) second.replace(at, 1, ", ");
    return first + " is none of " + second.substr(0, second.rfind('}'));
  }
  if (take_apart(text, "", ": Value ", first, second)) {
    std::string value, range;
    if (take_apart(second, "", " not in range ", value, range)) return first + ": " + value + " is not within " + range;
  }
  return without_dots(text);
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
  const Words options = options_of(root);
  const bool is_option = std::find(options.begin(), options.end(), "--" + *word) != options.end();
  return "'" + *word + "' is no command" +
         (is_option ? " (did you mean --" + *word + "?)" : suggestion(*word, commands_of(root))) + "; see " +
         root.get_name() + " help";
}

std::string explain(const CLI::App& root, const Words& words, const CLI::ParseError& error) {
  Words known = options_of(root);
  std::string text = in_plain_words(error, words),
              see = "; see " + root.get_name() + (has_commands(root) ? " help" : " --help");
  const auto command = has_commands(root) ? command_word(words) : words.end();
  std::string unknown;
  if (command != words.end()) {
    const CLI::App* named = command_named(root, *command);
    const Words more = options_of(*named);
    known.insert(known.end(), more.begin(), more.end());
    see += " " + *command;
    if (text.ends_with(" is missing") && !text.ends_with("value is missing")) {
      unknown = unknown_option({&root, named}, words);
    }
  } else {
    unknown = unknown_option({&root}, words);
  }
  if (!unknown.empty()) text = unknown + ": not known here";
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
