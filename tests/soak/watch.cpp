// SPDX-License-Identifier: Apache-2.0
#include "soak/watch.h"

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstring>
#include <string_view>

namespace incise::test {
namespace {

char doing_now[512];

void say(std::string_view text) {
  [[maybe_unused]] const ssize_t n = write(STDOUT_FILENO, text.data(), text.size());
}

void report(int signal) {
  say(signal == SIGALRM ? "HANGS: " : "CRASHES: ");
  say({doing_now, std::strlen(doing_now)});
  say("\n");
  _exit(1);
}

}  // namespace

void start_watch() {
  for (const int signal : {SIGALRM, SIGSEGV, SIGABRT, SIGFPE, SIGBUS}) std::signal(signal, report);
}

void watch(const std::string& what) {
  std::snprintf(doing_now, sizeof doing_now, "%s", what.c_str());
  go_on_watching();
}

const char* watched() {
  return doing_now;
}

void go_on_watching() {
  alarm(kStrokeSeconds);
}

void stop_watching() {
  alarm(0);
}

}  // namespace incise::test
