// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <utility>

namespace incise::bench {

namespace {

/// Columns that people read in UTF-8: continuation bytes take no room.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string quoted(const std::string& cell) {
  return cell.find(',') == std::string::npos ? cell : '"' + cell + '"';
}

void print_row(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string pad(widths[i] - width_of(cells[i]), ' ');
    line += i == 0 ? cells[i] + pad : "  " + pad + cells[i];
  }
  std::printf("%s\n", line.c_str());
}

}  // namespace

double thread_ms() {
#ifdef CLOCK_THREAD_CPUTIME_ID
  timespec now{};
  if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) == 0) {
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
  }
#endif
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median(std::vector<double> values) {
  if (values.empty()) {
    return 0;
  }
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

Table::Table(std::string name, std::string caption, std::vector<std::string> columns)
    : name_(std::move(name)), caption_(std::move(caption)), columns_(std::move(columns)) {}

void Table::add(std::vector<std::string> cells) {
  cells.resize(columns_.size());
  rows_.push_back(std::move(cells));
}

void Table::print() const {
  std::vector<std::size_t> widths;
  for (const std::string& column : columns_) {
    widths.push_back(width_of(column));
  }
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], width_of(row[i]));
    }
  }
  std::printf("\n%s\n", caption_.c_str());
  print_row(columns_, widths);
  for (const auto& row : rows_) {
    print_row(row, widths);
  }
  std::fflush(stdout);
}

void Table::write_csv(const std::filesystem::path& folder) const {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  std::ofstream out(folder / (name_ + ".csv"));
  const auto write = [&](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      out << (i == 0 ? "" : ",") << quoted(cells[i]);
    }
    out << '\n';
  };
  write(columns_);
  for (const auto& row : rows_) {
    write(row);
  }
  out.flush();
  if (!out) {
    std::fprintf(stderr, "could not write %s\n", (folder / (name_ + ".csv")).string().c_str());
  }
}

void report_acceptance(const std::string& name, const std::vector<Acceptance>& figures,
                       const std::filesystem::path& folder) {
  Table table("acceptance_" + name, "Acceptance (" + name + ")", {"figure", "must", "goal", "measured", "met"});
  for (const Acceptance& line : figures) {
    table.add({line.figure, line.must, line.goal, line.measured, line.is_met ? "yes" : "NO"});
  }
  table.print();
  table.write_csv(folder);
}

}  // namespace incise::bench
