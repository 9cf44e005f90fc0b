// SPDX-License-Identifier: Apache-2.0
// The tree of options as roff: synopsis, sections of options and commands, and the examples of the footer.
#include "shared/manual.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "shared/option_shape.h"

namespace incise_apps {
namespace {

/// Text as roff reads it: a backslash, a dash and a line's first dot or quote have meanings there.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) out += "\\&";
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
  }
  return out;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

std::string page_name(const CLI::App& root, const CLI::App& command) {
  return &root == &command ? root.get_name() : root.get_name() + "-" + command.get_name();
}

std::string call_of(const CLI::App& root, const CLI::App& command) {
  std::string text = ".B " + roff(root.get_name());
  if (&root != &command) text += " " + roff(command.get_name());
  text += "\n[OPTIONS]";
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional()) continue;
    const std::string name = roff(option->get_name(true));
    text += option->get_required() ? " " + name : " [" + name + "]";
  }
  if (!command.get_subcommands({}).empty()) text += " COMMAND";
  return text + "\n";
}

std::string option_entry(const CLI::Option& option) {
  std::string names;
  if (option.get_positional()) {
    names = ".I " + roff(option.get_name(true));
  } else {
    names = ".B ";
    const std::vector<std::string> dashed = dashed_names(option);
    for (const std::string& name : dashed) names += (&name == &dashed.front() ? "" : ", ") + roff(name);
    if (!is_flag(option)) names += " " + roff(option.get_type_name());
  }
  return ".TP\n" + names + "\n" + roff(option.get_description()) + "\n";
}

std::string options_section(const CLI::App& command, bool of_positionals, const char* heading) {
  std::string entries;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional() == of_positionals) entries += option_entry(*option);
  }
  return entries.empty() ? "" : std::string(".SH ") + heading + "\n" + entries;
}

std::string commands_section(const CLI::App& root, const CLI::App& command) {
  std::string entries;
  for (const CLI::App* one : command.get_subcommands({})) {
    entries += ".TP\n.B " + roff(one->get_name()) + "\n" + roff(one->get_description()) + "; see\n.BR " +
               roff(page_name(root, *one)) + " (1)\n";
  }
  return entries.empty() ? "" : ".SH COMMANDS\n" + entries;
}

/// The footer: paragraphs, of which "Examples:" is a heading.
std::string footer_sections(const CLI::App& command) {
  std::istringstream lines(command.get_footer());
  std::string text, line;
  bool is_plain = false;
  while (std::getline(lines, line)) {
    if (line == "Examples:") {
      text += ".SH EXAMPLES\n.nf\n";
    } else if (line.empty() || line.rfind("  ", 0) == 0) {
      text += roff(line.substr(std::min<std::size_t>(2, line.size()))) + "\n";
    } else {
      if (!is_plain) text += ".fi\n.SH NOTES\n";
      is_plain = true;
      text += roff(line) + "\n.br\n";
    }
    if (line == "Examples:") is_plain = false;
  }
  return text.empty() ? "" : text + ".fi\n";
}

}  // namespace

std::string manual_page(const CLI::App& root, const CLI::App& command, const std::string& version) {
  const std::string name = page_name(root, command);
  std::string text = ".TH " + roff(upper(name)) + " 1 \"\" \"" + roff(root.get_name() + " " + version) + "\"\n";
  text += ".SH NAME\n" + roff(name) + " \\- " + roff(command.get_description()) + "\n.SH SYNOPSIS\n" +
          call_of(root, command);
  text += options_section(command, true, "ARGUMENTS") + options_section(command, false, "OPTIONS");
  return text + commands_section(root, command) + footer_sections(command);
}

}  // namespace incise_apps
