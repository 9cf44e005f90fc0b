// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace incise::bench {

/// Processor time of this thread in milliseconds: what a run would take on a core of its own. Wall time where the
/// system does not tell.
double thread_ms();

/// The middle value (the mean of the two middle ones); 0 where there is none.
double median(std::vector<double> values);

/// A table of text cells: printed with aligned columns, and written as CSV.
class Table {
 public:
  /// @param name  of the CSV file, without extension.
  Table(std::string name, std::string caption, std::vector<std::string> columns);
  /// Adds a row; one cell per column.
  void add(std::vector<std::string> cells);
  /// To stdout.
  void print() const;
  /// To `folder`/name.csv. Says on stderr where it cannot.
  void write_csv(const std::filesystem::path& folder) const;

 private:
  std::string name_, caption_;
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// One figure that a release must reach.
struct Acceptance {
  std::string figure;
  std::string must;
  std::string goal;  ///< "-" where there is none beyond the must
  std::string measured;
  bool is_met = false;
};

/// The figures of one program: printed, and written as CSV for the summary of `script/bench`.
void report_acceptance(const std::string& name, const std::vector<Acceptance>& figures,
                       const std::filesystem::path& folder);

}  // namespace incise::bench
