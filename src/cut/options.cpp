// SPDX-License-Identifier: Apache-2.0
#include "incise/cut/options.h"

#include <array>

namespace incise {
inline namespace v0 {

namespace {

/// All that `CutStatistics` counts.
constexpr std::array kCounts = {&CutStatistics::steps,
                                &CutStatistics::cut_tets,
                                &CutStatistics::created_tets,
                                &CutStatistics::new_vertices,
                                &CutStatistics::copied_vertices,
                                &CutStatistics::incision_faces,
                                &CutStatistics::snapped_vertices,
                                &CutStatistics::bent_vertices,
                                &CutStatistics::crumbs_kept,
                                &CutStatistics::pinched_edges,
                                &CutStatistics::latent_faces,
                                &CutStatistics::blocked_edges,
                                &CutStatistics::sheets};
static_assert(sizeof(CutStatistics) == kCounts.size() * sizeof(std::uint64_t), "a count is missing");

}  // namespace

CutStatistics& CutStatistics::operator+=(const CutStatistics& other) {
  for (const auto count : kCounts) this->*count += other.*count;
  return *this;
}

CutStatistics& CutStatistics::operator-=(const CutStatistics& other) {
  for (const auto count : kCounts) this->*count -= other.*count;
  return *this;
}

}  // namespace v0
}  // namespace incise
