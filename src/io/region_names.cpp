// SPDX-License-Identifier: Apache-2.0
// Names are cleaned when they are written and when they are read, so that none breaks a line or repeats a number.
#include "io/region_names.h"

#include "io/reader.h"
#include "io/text.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

constexpr std::size_t kMostBytes = 200;
constexpr std::size_t kMostNames = 4096;
constexpr std::string_view kPrefix = "region_";

}  // namespace

std::string to_file_name_of_region(std::string_view name) {
  std::string out;
  for (const char c : trim(name.substr(0, kMostBytes))) {
    const bool breaks = static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
    out += breaks ? ' ' : (c == '"' ? '\'' : c);
  }
  return out;
}

std::string written_name(const RegionNames& names, std::int32_t region) {
  const auto found = names.find(region);
  std::string name = found == names.end() ? std::string() : to_file_name_of_region(found->second);
  return name.empty() ? std::string(kPrefix) + std::to_string(region) : name;
}

void take_region_name(std::int32_t region, std::string_view name, RegionNames& names) {
  std::string clean = to_file_name_of_region(name);
  std::int32_t number = 0;
  const bool says_nothing = clean.empty() || (parse_suffix(clean, kPrefix, number) && number == region);
  if (!says_nothing && names.size() < kMostNames) names.emplace(region, std::move(clean));
}

std::string to_entry(std::int32_t region, std::string_view name) {
  return std::to_string(region) + " " + to_file_name_of_region(name);
}

void take_entry(std::string_view entry, RegionNames& names) {
  entry = trim(entry);
  const std::size_t space = entry.find(' ');
  std::int64_t number = 0;
  std::int32_t region = 0;
  if (space == std::string_view::npos || !parse_int(entry.substr(0, space), number) || !to_label(number, region))
    return;
  take_region_name(region, entry.substr(space + 1), names);
}

}  // namespace io
}  // namespace v0
}  // namespace incise
