// SPDX-License-Identifier: Apache-2.0
// Names may stand for several regions, and are compared without regard to case. Whoever asks for what is not there is
// told what is.
#include "app/model/find_regions.h"

#include <algorithm>
#include <cctype>
#include <set>

namespace incise {
inline namespace v0 {
namespace app {
namespace {

bool is_same_name(const std::string& a, const std::string& b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

std::string list_of(const io::RegionNames& names) {
  std::string list;
  for (const auto& [region, name] : names) list += (list.empty() ? "" : ", ") + name;
  return list.empty() ? "none has a name" : "there are " + list;
}

}  // namespace

Result<std::vector<std::int32_t>> find_regions(const std::string& name, const io::RegionNames& names) {
  std::vector<std::int32_t> regions;
  for (const auto& [region, other] : names) {
    if (is_same_name(name, other)) regions.push_back(region);
  }
  if (!regions.empty()) return regions;
  return Error{ErrorCode::kBadFile, "no region of the model is called \"" + name + "\"; " + list_of(names)};
}

Status check_regions(const std::vector<std::int32_t>& regions, const TetMesh& mesh) {
  std::set<std::int32_t> there;
  mesh.for_each_tet([&](TetId tet) { there.insert(mesh.region(tet)); });
  for (const std::int32_t region : regions) {
    if (there.contains(region)) continue;
    std::string list;
    for (const std::int32_t other : there) list += (list.empty() ? "" : ", ") + std::to_string(other);
    return Error{ErrorCode::kBadFile,
                 "no tet of the model is in region " + std::to_string(region) + "; there are regions " + list};
  }
  return {};
}

}  // namespace app
}  // namespace v0
}  // namespace incise
