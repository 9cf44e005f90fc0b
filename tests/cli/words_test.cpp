// SPDX-License-Identifier: Apache-2.0
// What the programs share: messages, the words of a command line, completion and manual pages.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "cli/program.h"
#include "shared/command_words.h"
#include "shared/message_text.h"

namespace words_test {
namespace {

using namespace incise_test;

TEST(MessageText, is_one_line_of_at_most_480_bytes_with_both_ends) {
  EXPECT_EQ(incise_apps::one_line("two\nlines\x1b[31m"), "two lines [31m");
  const std::string text = "begin " + std::string(1000, 'x') + " end";
  const std::string line = incise_apps::one_line(text);
  EXPECT_LE(line.size(), 480U);
  EXPECT_EQ(line.substr(0, 6), "begin ");
  EXPECT_EQ(line.substr(line.size() - 4), " end");
  std::string umlauts;
  for (int i = 0; i < 500; ++i) umlauts += "\xC3\xA4";
  for (const std::string& shift : {std::string(), std::string("x")}) {
    const std::string cut = incise_apps::one_line(shift + umlauts);
    const std::size_t gap = cut.find(" ... ");
    EXPECT_EQ((gap - shift.size()) % 2, 0U) << "a character was cut through";
    EXPECT_EQ((cut.size() - gap - 5) % 2, 0U) << "a character was cut through";
  }
}

TEST(MessageText, tells_how_far_work_is_and_how_long_it_takes_yet) {
  EXPECT_EQ(incise_apps::progress_text({0, 50, "frames", 0, 9}), "[" + std::string(30, ' ') + "] 0 of 50 frames, 0:09");
  EXPECT_EQ(incise_apps::progress_text({25, 50, "frames", 0.5, 0.5}),
            "[" + std::string(15, '#') + std::string(15, ' ') + "] 25 of 50 frames");
  const auto left = [](double changed, double now) {
    const std::string text = incise_apps::progress_text({1, 4, "x", changed, now});
    return text.substr(text.find(", "));
  };
  EXPECT_EQ(left(2, 2), ", 0:06 left");
  EXPECT_EQ(left(60, 60), ", 3:00 left");
  EXPECT_EQ(left(60, 100), ", 2:20 left") << "it runs down while nothing more is done";
  EXPECT_EQ(left(60, 300), ", 5:00") << "it takes longer than it should";
  EXPECT_EQ(left(1300, 1300), ", 1:05:00 left");
}

TEST(MessageText, tells_which_stage_work_is_at_and_how_long_it_takes_yet) {
  const std::string bar = "[" + std::string(7, '#') + std::string(23, ' ') + "] 25 %: cutting, ";
  EXPECT_EQ(incise_apps::stage_text({"cutting", 25, 30, 75}), bar + "0:45 left");
  EXPECT_EQ(incise_apps::stage_text({"cutting", 25, 30, 125}), bar + "2:05") << "it takes longer than it should";
  EXPECT_EQ(incise_apps::stage_text({"reading", 0, 0, 7}), "[" + std::string(30, ' ') + "] 0 %: reading, 0:07");
}

TEST(CommandWords, suggest_the_nearest_word_or_none) {
  const std::vector<std::string> known = {"cut", "convert", "check"};
  EXPECT_EQ(incise_apps::suggestion("cutt", known), " (did you mean cut?)");
  EXPECT_EQ(incise_apps::suggestion("chekc", known), "");
  EXPECT_EQ(incise_apps::suggestion("converts", known), " (did you mean convert?)");
  EXPECT_EQ(incise_apps::suggestion("zzz", known), "");
}

/// What a shell prints; skips the test where there is no such shell.
std::string shell_says(const std::string& shell, const std::string& script) {
  const Folder folder;
  const std::string file = folder.write("script", script);
  std::string out;
  std::FILE* pipe = popen((shell + " '" + file + "' 2>&1").c_str(), "r");
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) out += static_cast<char>(c);
  pclose(pipe);
  return out;
}

bool has_program(const std::string& name) {
  return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
}

/// What bash offers for the last of the words.
std::string completed(const std::string& words) {
  const std::string script = run({"completion", "bash"}).out;
  return shell_says("bash", script + "\nCOMP_WORDS=(" + words +
                                "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _incise; echo ${COMPREPLY[@]}\n");
}

TEST(Completion, of_bash_knows_commands_options_and_values) {
  if (!has_program("bash")) GTEST_SKIP() << "there is no bash";
  EXPECT_EQ(completed("incise c"), "check cut convert completion\n");
  EXPECT_EQ(completed("incise cut --re"), "--report --record\n");
  EXPECT_EQ(completed("incise cut --profile ''"), "incise paper removal snapping moving adaptive seventeen minimal\n");
  EXPECT_EQ(completed("incise -q cut --pla"), "--plane\n");
  EXPECT_EQ(completed("incise cut cube.m"), "\n") << "files are the shell's own";
  EXPECT_EQ(completed("incise convert a.vtu b.msh --format msh2"), "msh22\n");
  EXPECT_EQ(completed("incise completion ''"), "bash zsh\n");
  EXPECT_EQ(completed("incise help cu"), "cut\n");
  EXPECT_EQ(completed("incise man cu"), "cut\n");
  EXPECT_EQ(completed("incise cut --profile = pap"), "paper\n") << "bash parts --profile=pap at '='";
  EXPECT_EQ(completed("incise cut --profile ="), "incise paper removal snapping moving adaptive seventeen minimal\n");
}

TEST(Completion, of_bash_asks_the_window_for_its_options) {
  if (!has_program("bash")) GTEST_SKIP() << "there is no bash";
  const std::string script = run({"completion", "bash"}).out +
                             "incise-view() { echo '  --headless  Draw'; echo '  -h,--help  Help'; }\n"
                             "COMP_WORDS=(incise-view --he); COMP_CWORD=1; _incise_view; echo ${COMPREPLY[@]}\n"
                             "complete -p incise-view\n";
  EXPECT_EQ(shell_says("bash", script), "--headless --help\ncomplete -o default -F _incise_view incise-view\n");
}

TEST(Completion, of_zsh_is_sound) {
  if (!has_program("zsh")) GTEST_SKIP() << "there is no zsh";
  const std::string script = run({"completion", "zsh"}).out;
  EXPECT_EQ(script.substr(0, 15), "#compdef incise");
  EXPECT_EQ(shell_says("zsh -n", script), "");
}

TEST(Completion, is_for_shells_that_are_known) {
  EXPECT_EQ(run({"completion", "fish"}).code, 2);
  EXPECT_EQ(run({"completion"}).code, 2);
}

TEST(Manual, says_of_every_command_what_its_help_says) {
  for (const std::string command :
       {"info", "check", "cut", "improve", "simulate", "replay", "batch", "convert", "completion"}) {
    const std::string page = run({"man", command}).out;
    EXPECT_EQ(page.rfind(".TH INCISE\\-", 0), 0U) << page;
    EXPECT_NE(page.find(".SH EXAMPLES\n"), std::string::npos) << command;
    const std::string help = run({command, "--help"}).out;
    for (std::size_t at = help.find(" --"); at != std::string::npos; at = help.find(" --", at + 1)) {
      const std::string option = help.substr(at + 3, help.find_first_of(" =\n,", at + 3) - at - 3);
      std::string escaped = "\\-\\-";
      for (const char c : option) escaped += c == '-' ? std::string("\\-") : std::string(1, c);
      EXPECT_NE(page.find(escaped), std::string::npos) << command << " " << option;
    }
  }
  const std::string page = run({"man"}).out;
  EXPECT_NE(page.find(".BR incise\\-cut (1)\n"), std::string::npos) << page;
  EXPECT_EQ(run({"man", "cat"}).err, "incise: error: 'cat' is no command (did you mean cut?); see incise help\n");
}

TEST(Manual, is_sound_roff) {
  if (!has_program("groff")) GTEST_SKIP() << "there is no groff";
  for (const std::string command : {"cut", "convert", "simulate"}) {
    EXPECT_EQ(shell_says("groff -man -ww -z", run({"man", command}).out), "") << command;
  }
}

}  // namespace

}  // namespace words_test
