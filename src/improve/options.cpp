// SPDX-License-Identifier: Apache-2.0
// Sums of what maintenance did, count by count; tets that wait are a state, and the latest one stands.
#include "incise/improve/options.h"

namespace incise {
inline namespace v0 {

MaintainStatistics& MaintainStatistics::operator+=(const MaintainStatistics& other) {
  work_units += other.work_units;
  collapsed_edges += other.collapsed_edges;
  moved_vertices += other.moved_vertices;
  removed_edges += other.removed_edges;
  removed_faces += other.removed_faces;
  inserted_vertices += other.inserted_vertices;
  peeled_tets += other.peeled_tets;
  waiting_tets = other.waiting_tets;
  created_tets += other.created_tets;
  return *this;
}

MaintainStatistics& MaintainStatistics::operator-=(const MaintainStatistics& part) {
  work_units -= part.work_units;
  collapsed_edges -= part.collapsed_edges;
  moved_vertices -= part.moved_vertices;
  removed_edges -= part.removed_edges;
  removed_faces -= part.removed_faces;
  inserted_vertices -= part.inserted_vertices;
  peeled_tets -= part.peeled_tets;
  created_tets -= part.created_tets;
  return *this;
}

}  // namespace v0
}  // namespace incise
