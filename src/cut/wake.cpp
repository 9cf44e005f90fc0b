// SPDX-License-Identifier: Apache-2.0
// Vertices of near masters are marked with the number of the round, and a master is settled if it has none of them,
// let go if its neighbours by a vertex are settled, too (docs/internals.md, 3.10).
#include "cut/wake.h"

#include <algorithm>

#include "incise/geom/box.h"

namespace incise {
inline namespace v0 {

namespace {

Box box_of(const TetMesh& mesh, const Master& master) {
  Box box;
  for (const VertexId v : master.vertices) box.extend(mesh.rest(v));
  return box;
}

bool is_near_row(const TetMesh& mesh, const Master& master, std::span<const SosPoint> row, double band) {
  const Box box = box_of(mesh, master);
  bool is_near = false;
  for (std::size_t c = 0; c + 1 < row.size() && !is_near; ++c) {
    is_near = segment_meets(box, band, row[c].position, row[c + 1].position);
  }
  return is_near;
}

/// Whether the sheet does anything to a master: those that were merely looked at may lie ahead.
bool is_touched(const Master& master) {
  return master.split != nullptr && (master.flagged != 0 || master.is_divided());
}

/// Whether incision faces of a master were left joined, to be looked at again.
bool waits(const Master& master) {
  return master.is_pinched || master.has_latent_faces;
}

}  // namespace

void Wake::mark(const Master& master) {
  for (const VertexId v : master.vertices) {
    marks_.ensure(std::size_t{v.value} + 1);
    marks_[v.value] = round_;
  }
}

void Wake::mark_kept(const ClosedComplex& complex) {
  for (const std::uint32_t i : kept_) {
    if (i < complex.size() && complex[i].split != nullptr) mark(complex[i]);
  }
}

bool Wake::has_near(const Master& master) const {
  return std::any_of(master.vertices.begin(), master.vertices.end(), [&](VertexId v) { return is_near(v); });
}

void Wake::find(const TetMesh& mesh, ClosedComplex& complex, std::span<const SosPoint> row, double band,
                std::span<const std::uint32_t> pinned) {
  settling_.clear();
  kept_.assign(pinned.begin(), pinned.end());
  ++round_;
  for (std::uint32_t i = 0; i < complex.size(); ++i) {
    Master& master = complex[i];
    if (master.split == nullptr) continue;
    const bool is_far = master.is_behind || !is_near_row(mesh, master, row, band);
    master.is_behind = is_far && is_touched(master);
    if (!is_far || (!row.empty() && waits(master))) mark(master);
    if (!is_far && !is_touched(master)) kept_.push_back(i);
  }
  mark_kept(complex);
  for (std::uint32_t i = 0; i < complex.size(); ++i) {
    const Master& master = complex[i];
    if (is_touched(master) && !master.is_settled && !has_near(master)) settling_.push_back(i);
  }
}

std::size_t Wake::let_go(ClosedComplex& complex) {
  for (const std::uint32_t i : settling_) {
    complex[i].is_settled = true;
    for (const VertexId v : complex[i].vertices) complex.settle(v);
  }
  settling_.clear();
  ++round_;
  for (std::uint32_t i = 0; i < complex.size(); ++i) {
    if (is_touched(complex[i]) && (!complex[i].is_settled || waits(complex[i]))) mark(complex[i]);
  }
  mark_kept(complex);
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < complex.size(); ++i) {
    if (complex[i].split == nullptr || has_near(complex[i])) continue;
    complex.release(i);
    ++count;
  }
  return count;
}

}  // namespace v0
}  // namespace incise
