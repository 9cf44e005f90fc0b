// SPDX-License-Identifier: Apache-2.0
// One function for each option, so that it has the same words and bounds in every command.
#include "command_options.h"

#include <charconv>
#include <vector>

#include "app/jobs/cut_job.h"
#include "incise/io/mesh_file.h"

namespace incise_cli {
namespace {

constexpr const char* kOutputHelp = "Write the mesh; the extension names the format; - for stdout, with --format";

}  // namespace

CLI::App* add_command(CLI::App& root, const std::string& name, const std::string& what, const std::string& examples) {
  CLI::App* command = root.add_subcommand(name, what);
  command->fallthrough();
  command->footer("Examples:\n" + examples);
  return command;
}

void add_json(CLI::App& command, bool& as_json) {
  command.add_flag("--json", as_json, "Print JSON to stdout");
}

const CLI::Validator& names_a_file() {
  static const CLI::Validator kValidator(
      [](std::string& name) { return name.empty() ? std::string("the name is empty; give one") : std::string(); }, "",
      "names a file");
  return kValidator;
}

const CLI::Validator& names_a_result() {
  static const CLI::Validator kValidator(
      [](std::string& name) {
        if (name == "/dev/stdout") name = "-";
        return names_a_file()(name);
      },
      "", "names a result");
  return kValidator;
}

const CLI::Validator& is_whole() {
  static const CLI::Validator kValidator(
      [](std::string& text) {
        std::uint64_t number = 0;
        const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (code != std::errc() || end != text.data() + text.size()) {
          return "'" + text + "' is no whole number from 0 to 18446744073709551615";
        }
        text = std::to_string(number);  // CLI11 takes 010 for octal
        return std::string();
      },
      "", "is whole");
  return kValidator;
}

void add_report(CLI::App& command, std::string& report, bool& as_json) {
  command.add_option("--report", report, "Write figures as JSON to this file; - for stdout")
      ->transform(names_a_result());
  command.add_flag("--json", as_json, "Print the figures as JSON to stdout, instead of a few lines for people");
}

void add_format(CLI::App& command, std::string& format, const std::vector<std::string>& more) {
  command.add_option("--format", format, "Of what is written, instead of what its extension says: msh is msh41")
      ->check(CLI::IsMember(format_names(more)));
}

void add_output(CLI::App& command, MeshOutput& output) {
  command.add_option("-o,--output", output.file, kOutputHelp)->transform(names_a_result());
  add_format(command, output.format);
}

void add_profile(CLI::App& command, std::string& profile) {
  command.add_option("--profile", profile, "incise (default), or paper: the published method")
      ->check(CLI::IsMember({"incise", "paper"}));
}

void add_budget(CLI::App& command, std::uint64_t& budget_us, const std::string& what) {
  command.add_option("--budget-us", budget_us, what)->check(CLI::Range(std::uint64_t{1}, incise::app::kMaxBudgetUs));
}

void add_threads(CLI::App& command, unsigned& threads) {
  command.add_option("--threads", threads, "Worker threads, 1 to 256; the result does not depend on it")
      ->check(CLI::Range(1, 256));
}

}  // namespace incise_cli
