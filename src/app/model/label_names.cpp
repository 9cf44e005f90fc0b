// SPDX-License-Identifier: Apache-2.0
// A line is a number, then whatever parts it from the name, then the name: in quotes if there are any.
#include "app/model/label_names.h"

#include <cstdlib>
#include <sstream>
#include <string_view>

#include "app/text/text_file.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 20U;
constexpr const char* kSpace = " \t\r=,:";

/// What is in quotes, or else all of the text without what may part it from the label.
std::string name_in(const std::string& text) {
  const std::size_t quote = text.find('"'), end = text.rfind('"');
  if (quote != std::string::npos && end > quote) return text.substr(quote + 1, end - quote - 1);
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace

Result<io::RegionNames> read_label_names(const std::filesystem::path& file) {
  const Result<std::string> text = read_text_file(file, kMostBytes);
  if (!text.ok()) return text.error();
  io::RegionNames names;
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // editors on Windows begin files with it
  const bool is_marked = std::string_view(*text).substr(0, kByteOrderMark.size()) == kByteOrderMark;
  std::istringstream lines(is_marked ? text->substr(kByteOrderMark.size()) : *text);
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    char* end = nullptr;
    const long label = std::strtol(line.c_str(), &end, 10);
    const std::string name = name_in(end);
    if (end == line.c_str() || name.empty() || label != static_cast<std::int32_t>(label)) {
      return Error{ErrorCode::kBadFile, file.string() + ":" + std::to_string(number) +
                                            ": a label and its name are needed, as in: 3 left kidney"};
    }
    names[static_cast<std::int32_t>(label)] = name;
  }
  return names;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
