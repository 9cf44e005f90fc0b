// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "incise/engine/engine.h"
#include "report.h"

namespace incise::bench {

/// What the command line asked for.
struct Settings {
  std::filesystem::path folder = "bench-results";
  std::string only;  ///< cases whose names contain this
  bool is_quick = false;
  EngineOptions engine;
  std::vector<std::string> boxes, bodies;

  [[nodiscard]] bool wants(const std::string& name) const { return name.find(only) != std::string::npos; }
};

/// A number as text, small or large ones alike.
std::string figure(double value);

/// The worst of a figure, and which case it came from.
class Worst {
 public:
  explicit Worst(bool is_low_bad = false) : is_low_bad_(is_low_bad) {}
  void note(double value, const std::string& where);
  [[nodiscard]] bool has_value() const { return !where_.empty(); }
  [[nodiscard]] double value() const { return value_; }
  /// Lines of acceptance.
  [[nodiscard]] Acceptance line(const std::string& what, std::string must, std::string goal, bool is_met) const;
  [[nodiscard]] Acceptance at_most(const std::string& what, double must, const std::string& goal) const;
  [[nodiscard]] Acceptance at_least(const std::string& what, double must, const std::string& goal) const;

 private:
  bool is_low_bad_;
  double value_ = 0;
  std::string where_;
};

}  // namespace incise::bench
