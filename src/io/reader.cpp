// SPDX-License-Identifier: Apache-2.0
// What a reader made is checked once, here, for all formats: indices, finite points, mid-edge nodes that are corners
// elsewhere.
#include "io/reader.h"

#include <algorithm>
#include <cmath>

#include "incise/core/id.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

bool all_zero(const std::vector<std::int32_t>& labels) {
  return std::all_of(labels.begin(), labels.end(), [](std::int32_t v) { return v == 0; });
}

void clear_if_zero(std::vector<std::int32_t>& labels) {
  if (all_zero(labels)) labels = {};
}

bool check_tets(Job& job) {
  const auto& soup = job.out.data.soup;
  if (soup.tets.empty()) {
    return job.fail("holds no tetrahedra; Incise cuts volumes: fill the surface first (incise mesh)");
  }
  if (soup.tets.size() > kInvalidIndex / 4 || soup.points.size() >= kInvalidIndex) {
    return job.fail("holds more elements than 32-bit numbers can name; cut the mesh into parts",
                    ErrorCode::kOutOfMemory);
  }
  for (std::size_t t = 0; t < soup.tets.size(); ++t) {
    for (const std::uint32_t v : soup.tets[t]) {
      if (v >= soup.points.size()) {
        return job.fail("tet " + std::to_string(t) + " (from 0) names vertex " + std::to_string(v) + " (from 0) of " +
                        std::to_string(soup.points.size()) + "; export the mesh again");
      }
    }
  }
  return true;
}

bool check_triangles(Job& job) {
  const auto& data = job.out.data;
  for (const auto& triangle : data.triangles) {
    for (const std::uint32_t v : triangle) {
      if (v >= data.soup.points.size()) {
        return job.fail("a triangle names vertex " + std::to_string(v) + " (from 0) of " +
                        std::to_string(data.soup.points.size()) + "; export the mesh again");
      }
    }
  }
  return true;
}

bool find_mid_nodes(Job& job) {
  if (job.mids.empty()) return true;
  const auto& soup = job.out.data.soup;
  std::vector<bool> corner(soup.points.size(), false);
  for (const auto& tet : soup.tets) {
    for (const std::uint32_t v : tet) corner[v] = true;
  }
  auto& mids = job.mids;
  std::sort(mids.begin(), mids.end());
  mids.erase(std::unique(mids.begin(), mids.end()), mids.end());
  if (mids.back() >= soup.points.size()) {
    return job.fail("a mid-edge node " + std::to_string(mids.back()) + " (from 0) is out of range");
  }
  mids.erase(std::remove_if(mids.begin(), mids.end(), [&corner](std::uint32_t v) { return corner[v]; }), mids.end());
  job.out.ten_node = true;
  job.out.mid_nodes = std::move(mids);
  return true;
}

bool check_finite(Job& job) {
  const auto& points = job.out.data.soup.points;
  const auto bad = std::find_if(points.begin(), points.end(), [](const Vec3& p) { return !p.allFinite(); });
  if (bad == points.end()) return true;
  return job.fail("vertex " + std::to_string(bad - points.begin()) + " (from 0) is not finite; export the mesh again");
}

}  // namespace

bool finish(Job& job) {
  if (!check_tets(job) || !check_triangles(job) || !check_finite(job) || !find_mid_nodes(job)) return false;
  auto& data = job.out.data;
  clear_if_zero(data.soup.regions);
  clear_if_zero(data.triangle_stroke);
  data.has_foreign_labels = data.has_foreign_labels && !data.triangle_stroke.empty();
  job.out.file_vertices = data.soup.points.size();
  job.out.file_tets = data.soup.tets.size();
  return true;
}

void IdMap::add(std::int64_t id) {
  if (size_ == 0) first_ = id;
  const bool consecutive = id >= first_ && static_cast<std::uint64_t>(id) - static_cast<std::uint64_t>(first_) == size_;
  if (entries_.empty() && !consecutive) {
    for (std::uint32_t i = 0; i < size_; ++i) entries_.push_back({first_ + i, i});
  }
  if (!entries_.empty()) entries_.push_back({id, static_cast<std::uint32_t>(size_)});
  ++size_;
}

bool IdMap::seal() {
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.id < b.id; });
  const auto twice =
      std::adjacent_find(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.id == b.id; });
  if (twice == entries_.end()) return true;
  repeated_ = twice->id;
  return false;
}

std::uint32_t IdMap::find(std::int64_t id) const {
  if (entries_.empty()) {
    const bool known = id >= first_ && static_cast<std::uint64_t>(id) - static_cast<std::uint64_t>(first_) < size_;
    return known ? static_cast<std::uint32_t>(id - first_) : kInvalidIndex;
  }
  const auto at = std::lower_bound(entries_.begin(), entries_.end(), id,
                                   [](const Entry& e, std::int64_t value) { return e.id < value; });
  return at != entries_.end() && at->id == id ? at->position : kInvalidIndex;
}

void LeftOut::add(std::string_view kind, std::uint64_t n) {
  if (kind.empty() || n == 0) return;
  const auto at = counts_.find(kind);
  if (at != counts_.end()) {
    at->second += n;
  } else {
    counts_.emplace(kind, n);
  }
}

namespace {

constexpr std::size_t kMostKindsTold = 12;

std::string counted_kind(std::uint64_t count, std::string_view kind) {
  return std::to_string(count) + " " + (count == 1 ? singular(kind) : std::string(kind));
}

}  // namespace

std::string singular(std::string_view kind) {
  // The noun ends before "of type 99" and before the digits of "hexahedra27".
  std::size_t end = std::min(kind.find(" of "), kind.size());
  while (end > 0 && kind[end - 1] >= '0' && kind[end - 1] <= '9') --end;
  const std::string_view noun = kind.substr(0, end);
  const std::string rest(kind.substr(end));
  if (noun.ends_with("hedra")) return std::string(noun.substr(0, noun.size() - 1)) + "on" + rest;
  return std::string(noun.substr(0, noun.ends_with('s') ? noun.size() - 1 : noun.size())) + rest;
}

void LeftOut::note(std::vector<std::string>& notes) const {
  std::vector<std::string> told;
  std::uint64_t all = 0, more = 0;
  for (const auto& [kind, count] : counts_) {
    all += count;
    if (told.size() < kMostKindsTold) {
      told.push_back(counted_kind(count, kind));
    } else {
      more += count;
    }
  }
  if (more > 0) {
    told.push_back(std::to_string(more) + " of " + std::to_string(counts_.size() - kMostKindsTold) + " more kinds");
  }
  std::string text;
  for (std::size_t i = 0; i < told.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == told.size() ? " and " : ", ") + told[i];
  }
  if (!text.empty()) notes.push_back(text + (all == 1 ? " was" : " were") + " left out; only tets are cut");
}

bool to_label(double value, std::int32_t& out) {
  if (!(std::abs(value) <= 2147483647.0) || std::floor(value) != value) return false;
  out = static_cast<std::int32_t>(value);
  return true;
}

int region_rank(std::string_view name) {
  constexpr std::array<std::string_view, 18> kNames = {
      "region",      "regions",       "region_id", "regionid",      "modelregionid", "label",
      "labels",      "medit:ref",     "subdomain", "gmsh:physical", "material",      "materialid",
      "materialids", "cellentityids", "domain",    "tissue",        "tetgen:ref",    "mat_id"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (same_word(name, kNames[i])) return static_cast<int>(kNames.size() - i);
  }
  return 0;
}

bool parse_suffix(std::string_view text, std::string_view prefix, std::int32_t& out) {
  std::int64_t value = 0;
  return text.size() > prefix.size() && same_word(text.substr(0, prefix.size()), prefix) &&
         parse_int(text.substr(prefix.size()), value) && to_label(value, out);
}

}  // namespace io
}  // namespace v0
}  // namespace incise
