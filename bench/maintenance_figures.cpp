// SPDX-License-Identifier: Apache-2.0
#include "maintenance_figures.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace incise::bench {

std::string figure(double value) {
  const bool is_plain = value == 0 || (std::abs(value) >= 1e-3 && std::abs(value) < 1e6);
  return is_plain ? fmt::format("{:.4g}", value) : fmt::format("{:.1e}", value);
}

void Worst::note(double value, const std::string& where) {
  if (where_.empty() || (is_low_bad_ ? value < value_ : value > value_)) {
    value_ = value;
    where_ = where;
  }
}

Acceptance Worst::line(const std::string& what, std::string must, std::string goal, bool is_met) const {
  return {what + " (" + where_ + ")", std::move(must), std::move(goal), figure(value_), is_met};
}

Acceptance Worst::at_most(const std::string& what, double must, const std::string& goal) const {
  return line(what, must == 0 ? "0" : "≤ " + figure(must), goal, value_ <= must);
}

Acceptance Worst::at_least(const std::string& what, double must, const std::string& goal) const {
  return line(what, "≥ " + figure(must), goal, value_ >= must);
}

}  // namespace incise::bench
