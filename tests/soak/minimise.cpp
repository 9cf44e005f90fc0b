// SPDX-License-Identifier: Apache-2.0
#include "soak/minimise.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <functional>
#include <utility>

namespace incise::test {
namespace {

[[noreturn]] void run_and_exit(const MotionCase& motion) {
  for (const int signal : {SIGALRM, SIGSEGV, SIGABRT, SIGFPE, SIGBUS}) std::signal(signal, SIG_DFL);
  const Outcome outcome = run_case(motion);
  _exit(static_cast<int>(outcome.fault));
}

/// Tries smaller cases as long as they fail in the same way.
class Minimiser {
 public:
  Minimiser(MotionCase motion, FailureKind failure) : motion_(std::move(motion)), failure_(failure) {}

  MotionCase run() {
    for (bool is_smaller = true; is_smaller;) {
      is_smaller = drop_strokes();
      for (std::size_t i = 0; i < motion_.strokes.size(); ++i) is_smaller = drop_poses(i) || is_smaller;
      is_smaller = shrink_body() || is_smaller;
      is_smaller = simplify() || is_smaller;
    }
    return motion_;
  }

 private:
  /// Changes the case; keeps the change if it still fails.
  bool attempt(const std::function<void(MotionCase&)>& change) {
    if (std::chrono::steady_clock::now() > end_) return false;
    MotionCase smaller = motion_;
    change(smaller);
    if (!(failure_of(smaller) == failure_)) return false;
    motion_ = std::move(smaller);
    return true;
  }
  bool drop_strokes() {
    bool is_smaller = false;
    for (std::size_t i = motion_.strokes.size(); motion_.strokes.size() > 1 && i-- > 0;) {
      is_smaller =
          attempt([i](MotionCase& m) { m.strokes.erase(m.strokes.begin() + static_cast<long>(i)); }) || is_smaller;
    }
    return is_smaller;
  }
  /// Runs of poses, shorter and shorter ones.
  bool drop_poses(std::size_t stroke) {
    bool is_smaller = false;
    for (std::size_t length = motion_.strokes[stroke].edges.size() / 2; length > 0; length /= 2) {
      for (std::size_t first = 0; first < motion_.strokes[stroke].edges.size();) {
        const bool is_dropped = drop_run(stroke, first, length);
        is_smaller = is_smaller || is_dropped;
        first += is_dropped ? 0 : length;
      }
    }
    return is_smaller;
  }
  bool drop_run(std::size_t stroke, std::size_t first, std::size_t length) {
    const std::size_t count = motion_.strokes[stroke].edges.size(), last = std::min(first + length, count);
    if (count - (last - first) < 2) return false;
    return attempt([=](MotionCase& m) {
      auto& edges = m.strokes[stroke].edges;
      edges.erase(edges.begin() + static_cast<long>(first), edges.begin() + static_cast<long>(last));
    });
  }
  bool shrink_body() {
    bool is_smaller = false;
    while (motion_.body.n > 1 && attempt([](MotionCase& m) { --m.body.n; })) is_smaller = true;
    using Kind = BodyPlan::Kind;
    for (const auto& [from, to] : {std::pair(Kind::kRenumbered, Kind::kJittered), {Kind::kJittered, Kind::kKuhn}}) {
      if (motion_.body.kind != from) continue;
      is_smaller = attempt([kind = to](MotionCase& m) { m.body.kind = kind; }) || is_smaller;
    }
    return is_smaller;
  }
  bool simplify() {
    bool is_smaller = motion_.maintains && attempt([](MotionCase& m) { m.maintains = false; });
    is_smaller = (motion_.wave != 0 && attempt([](MotionCase& m) { m.wave = 0; })) || is_smaller;
    for (std::size_t i = 0; i < motion_.strokes.size(); ++i) {
      is_smaller = straighten(i) || is_smaller;
      if (!motion_.strokes[i].is_aborted) continue;
      is_smaller = attempt([i](MotionCase& m) { m.strokes[i].is_aborted = false; }) || is_smaller;
    }
    return is_smaller;
  }
  /// The ends of the edge alone.
  bool straighten(std::size_t stroke) {
    const auto& edge = motion_.strokes[stroke].edges.front();
    if (edge.size() == 2 || edge.front() == edge.back()) return false;
    return attempt([=](MotionCase& m) {
      for (auto& e : m.strokes[stroke].edges) e = {e.front(), e.back()};
    });
  }

  MotionCase motion_;
  FailureKind failure_;
  std::chrono::steady_clock::time_point end_ = std::chrono::steady_clock::now() + std::chrono::minutes(5);
};

void write_edge(std::FILE* file, const std::vector<Vec3>& edge, std::size_t time) {
  std::fprintf(file, "%s    {\"t\": %zu, \"points\": [", time == 0 ? "" : ",\n", time);
  for (std::size_t i = 0; i < edge.size(); ++i) {
    std::fprintf(file, "%s[%.17g, %.17g, %.17g]", i == 0 ? "" : ", ", edge[i].x(), edge[i].y(), edge[i].z());
  }
  std::fprintf(file, "]}");
}

}  // namespace

FailureKind failure_of(const MotionCase& motion) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) run_and_exit(motion);
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) < 0) return {};
  if (WIFSIGNALED(status)) return {Fault::kNone, WTERMSIG(status)};
  return {static_cast<Fault>(WEXITSTATUS(status)), 0};
}

MotionCase minimise(MotionCase motion, const FailureKind& failure) {
  return Minimiser(std::move(motion), failure).run();
}

std::string describe(const MotionCase& motion) {
  std::string words = "body " + describe(motion.body) + ", snap " + std::to_string(motion.snap) +
                      (motion.maintains ? ", maintained" : ", not maintained") + ", wave " +
                      std::to_string(motion.wave) + "\n";
  for (const MotionStroke& stroke : motion.strokes) {
    words += "stroke '" + stroke.policy + "', " + std::to_string(stroke.edges.size()) + " poses" +
             (stroke.is_aborted ? ", undone and done again instead of ended" : "") + "\n";
  }
  return words;
}

bool write_blade_file(const MotionCase& motion, const std::filesystem::path& path) {
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (file == nullptr) return false;
  std::fprintf(file, "{\"format\": \"incise-blade\", \"version\": 1, \"strokes\": [");
  for (const MotionStroke& stroke : motion.strokes) {
    std::fprintf(file, "%s\n  {\"name\": \"%s\", \"edges\": [\n", &stroke == &motion.strokes[0] ? "" : ",",
                 stroke.policy.c_str());
    for (std::size_t i = 0; i < stroke.edges.size(); ++i) write_edge(file, stroke.edges[i], i);
    std::fprintf(file, "]}");
  }
  std::fprintf(file, "]}\n");
  return std::fclose(file) == 0;
}

}  // namespace incise::test
