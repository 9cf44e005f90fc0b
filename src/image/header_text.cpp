// SPDX-License-Identifier: Apache-2.0
// What headers of text have in common: words, lines, lists of numbers, and how more than three axes come down to
// three.
#include <algorithm>
#include <cmath>

#include "image/image_header.h"
#include "incise/io/numbers.h"

namespace incise {
inline namespace v0 {
namespace image {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return out;
}

std::string_view next_line(std::string_view bytes, std::size_t& at) {
  const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
  std::string_view line = bytes.substr(at, end - at);
  at = std::min(end + 1, bytes.size());
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

std::vector<double> numbers_of(std::string_view text) {
  constexpr std::string_view kBetween = " \t,()";
  std::vector<double> numbers;
  for (std::size_t at = 0; (at = text.find_first_not_of(kBetween, at)) != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kBetween, at), text.size());
    double number = 0;
    if (!io::parse_double(text.substr(at, end - at), number)) return {};
    numbers.push_back(number);
    at = end;
  }
  return numbers;
}

bool to_sizes(const std::vector<double>& numbers, std::vector<std::uint64_t>& sizes) {
  sizes.clear();
  for (const double x : numbers) {
    if (!(x >= 0 && x <= 9e15) || std::floor(x) != x) return false;
    sizes.push_back(static_cast<std::uint64_t>(x));
  }
  return true;
}

bool find_three_axes(const std::vector<std::uint64_t>& sizes, std::array<std::size_t, 3>& keep) {
  std::vector<std::size_t> axes;
  for (std::size_t a = 0; a < sizes.size(); ++a) axes.push_back(a);
  for (std::size_t a = axes.size(); a-- > 0 && axes.size() > 3;) {
    if (sizes[axes[a]] == 1) axes.erase(axes.begin() + static_cast<std::ptrdiff_t>(a));
  }
  if (axes.size() > 3) return false;
  for (std::size_t a = 0; a < 3; ++a) keep[a] = a < axes.size() ? axes[a] : sizes.size();
  return true;
}

}  // namespace image
}  // namespace v0
}  // namespace incise
