// SPDX-License-Identifier: Apache-2.0
// Sums over lists of members, so that a count which is added to the struct and not to a list does not compile.
#include "incise/cut/options.h"

#include <array>

namespace incise {
inline namespace v0 {

namespace {

/// All that `CutStatistics` counts: growth, and what only ever becomes more.
constexpr std::array kGrowth = {&CutStatistics::created_tets, &CutStatistics::new_vertices,
                                &CutStatistics::incision_faces};
constexpr std::array kCounts = {&CutStatistics::steps,           &CutStatistics::cut_tets,
                                &CutStatistics::copied_vertices, &CutStatistics::snapped_vertices,
                                &CutStatistics::bent_vertices,   &CutStatistics::crumbs_kept,
                                &CutStatistics::pinched_edges,   &CutStatistics::latent_faces,
                                &CutStatistics::blocked_edges,   &CutStatistics::sheets};
static_assert(sizeof(CutStatistics) == (kGrowth.size() + kCounts.size()) * sizeof(std::uint64_t), "a count is missing");

}  // namespace

CutStatistics& CutStatistics::operator+=(const CutStatistics& other) {
  for (const auto growth : kGrowth) this->*growth += other.*growth;
  for (const auto count : kCounts) this->*count += other.*count;
  return *this;
}

CutStatistics& CutStatistics::operator-=(const CutStatistics& other) {
  for (const auto growth : kGrowth) this->*growth -= other.*growth;
  for (const auto count : kCounts) this->*count -= other.*count;
  return *this;
}

}  // namespace v0
}  // namespace incise
