// SPDX-License-Identifier: Apache-2.0
#include "cli/program.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace incise_test {
namespace {

[[noreturn]] void become_program(const std::vector<std::string>& arguments, int in, const std::string& out,
                                 const std::string& err) {
  std::vector<std::string> words = {INCISE_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int flags = O_WRONLY | O_CREAT | O_TRUNC;
  dup2(in, 0);
  dup2(open(out.c_str(), flags, 0600), 1);
  dup2(open(err.c_str(), flags, 0600), 2);
  execv(argv[0], argv.data());
  _exit(127);
}

/// Sends a signal, if one is given, after `seconds`; no file grows beyond `bytes`.
Outcome run_until(const std::vector<std::string>& arguments, int signal_number, double seconds,
                  rlim_t bytes = RLIM_INFINITY) {
  const Folder folder;
  const std::string out = folder / "stdout";
  const std::string err = folder / "stderr";
  const pid_t child = fork();
  if (child == 0) {
    const rlimit limit{bytes, RLIM_INFINITY};
    setrlimit(RLIMIT_FSIZE, &limit);
    become_program(arguments, open("/dev/null", O_RDONLY), out, err);
  }
  if (signal_number != 0) {
    usleep(static_cast<useconds_t>(seconds * 1e6));
    kill(child, signal_number);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read(out), read(err)};
}

}  // namespace

Outcome run(const std::vector<std::string>& arguments) {
  return run_until(arguments, 0, 0);
}

namespace {

/// Whether the program has taken all.
bool is_written_to(int pipe, const std::string& input) {
  for (std::size_t at = 0; at < input.size();) {
    const ssize_t written = write(pipe, input.data() + at, input.size() - at);
    if (written <= 0) return false;
    at += static_cast<std::size_t>(written);
  }
  return true;
}

/// `feed(pipe)` writes what comes by stdin; the program is stopped where it returns false.
template <class Feed>
Outcome run_fed(const std::vector<std::string>& arguments, const Feed& feed) {
  const Folder folder;
  int ends[2] = {-1, -1};
  if (pipe(ends) != 0) return {};
  const pid_t child = fork();
  if (child == 0) {
    close(ends[1]);
    become_program(arguments, ends[0], folder / "stdout", folder / "stderr");
  }
  close(ends[0]);
  const auto old = std::signal(SIGPIPE, SIG_IGN);  // it may end before it has read all
  const bool has_ended = feed(ends[1]);
  if (!has_ended) kill(child, SIGKILL);
  close(ends[1]);
  std::signal(SIGPIPE, old);
  int status = 0;
  waitpid(child, &status, 0);
  if (!has_ended) return {-1, "", "the program was still reading"};
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read(folder / "stdout"),
          read(folder / "stderr")};
}

}  // namespace

Outcome run_on(const std::string& input, const std::vector<std::string>& arguments) {
  return run_fed(arguments, [&](int pipe) {
    is_written_to(pipe, input);
    return true;
  });
}

Outcome run_on_endless(const std::string& text, const std::vector<std::string>& arguments) {
  std::string block;
  while (block.size() < (1U << 20U)) block += text;
  return run_fed(arguments, [&](int pipe) {
    for (unsigned mebibytes = 0; mebibytes < 64; ++mebibytes) {
      if (!is_written_to(pipe, block)) return true;
    }
    return false;
  });
}

Outcome run_to(const std::string& out, const std::vector<std::string>& arguments) {
  const Folder folder;
  const pid_t child = fork();
  if (child == 0) become_program(arguments, open("/dev/null", O_RDONLY), out, folder / "stderr");
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), "", read(folder / "stderr")};
}

Outcome run_hung_up(const std::vector<std::string>& arguments, double seconds) {
  return run_until(arguments, SIGHUP, seconds);
}

Outcome run_interrupted(const std::vector<std::string>& arguments, double seconds) {
  return run_until(arguments, SIGINT, seconds);
}

Outcome run_limited(const std::vector<std::string>& arguments, unsigned long bytes) {
  return run_until(arguments, 0, 0, bytes);
}

Outcome run_killed(const std::vector<std::string>& arguments, double seconds) {
  return run_until(arguments, SIGKILL, seconds);
}

}  // namespace incise_test
