// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>

namespace incise {
inline namespace v0 {

/// The stages of the pipeline (paper, Figure 1), in the order in which a step runs them.
enum class Stage : unsigned char { kCollision, kSubdivide, kSeparate, kMerge, kImprove, kRelax, kCount };

/// The names of the stages in reports, by `Stage`.
inline constexpr std::array<const char*, 6> kStageNames = {"collision", "subdivide", "separate",
                                                           "merge",     "improve",   "relax"};

/// Milliseconds spent in each stage. Times are only reported; no decision reads them.
struct StageTimes {
  std::array<double, static_cast<std::size_t>(Stage::kCount)> ms{};  ///< by `Stage`

  double& operator[](Stage stage) { return ms[static_cast<std::size_t>(stage)]; }              ///< ms
  const double& operator[](Stage stage) const { return ms[static_cast<std::size_t>(stage)]; }  ///< ms
  /// The sum over all stages, ms.
  [[nodiscard]] double total() const {
    double sum = 0;
    for (const double stage_ms : ms) {
      sum += stage_ms;
    }
    return sum;
  }
  StageTimes& operator+=(const StageTimes& other) {
    for (std::size_t i = 0; i < ms.size(); ++i) {
      ms[i] += other.ms[i];
    }
    return *this;
  }
  /// Takes a part of the sum away again.
  StageTimes& operator-=(const StageTimes& other) {
    for (std::size_t i = 0; i < ms.size(); ++i) {
      ms[i] -= other.ms[i];
    }
    return *this;
  }
};

/// Adds the time from its construction to its destruction to one stage.
class StageZone {
 public:
  /// Starts the clock; `times` must outlive it.
  StageZone(StageTimes& times, Stage stage) : times_(times), stage_(stage), start_(Clock::now()) {}
  StageZone(const StageZone&) = delete;
  StageZone& operator=(const StageZone&) = delete;
  ~StageZone() { times_[stage_] += std::chrono::duration<double, std::milli>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  StageTimes& times_;
  Stage stage_;
  Clock::time_point start_;
};

}  // namespace v0
}  // namespace incise
