// SPDX-License-Identifier: Apache-2.0
// Lanes come and go in constant time: the last one moves into the gap. A star that is full moves to a place with one
// block more, and its old place waits for another (docs/internals.md, 4).
#include "sim/body/stars.h"

#include <algorithm>
#include <limits>

#include "sim/body/constants.h"

namespace incise {
inline namespace v0 {
namespace detail {

static constexpr std::uint32_t kHole = 0xFFFFFFFFU;  // in place of an owner

/// Of the share of a tet that its vertices have, with the tet's own part as 1.
static std::uint8_t bend_code(const Element& element) {
  if (!(element.give > 0)) return 0;
  return power_code(1 + kSharedBend / (6 * element.give * element.bulk));
}

void Stars::ensure(std::uint32_t vertex_slots, std::uint32_t tet_slots) {
  if (vertex_slots > stars_.size()) {
    stars_.resize(vertex_slots);
    holes_.resize(vertex_slots);
  }
  if (tet_slots > lane_of_.size()) lane_of_.resize(tet_slots);
}

std::uint32_t Stars::take(std::uint16_t count) {
  if (count < free_.size() && !free_[count].empty()) {
    const std::uint32_t first = free_[count].back();
    free_[count].pop_back();
    return first;
  }
  const auto first = static_cast<std::uint32_t>(blocks_.size());
  blocks_.resize(first + count);
  if (stiffens) stiffening_.resize(first + count);
  if (has_fibres) fibres_.resize(first + count);
  owners_.resize(first + count);
  return first;
}

void Stars::clear_lane(const Star& star, std::uint32_t lane, VertexId vertex) {
  StarBlock& block = blocks_[star.first + lane / kLanes];
  const std::uint32_t i = lane % kLanes;
  block.a[i] = block.b[i] = block.c[i] = vertex.value;
  block.bulk[i] = block.pressure[i] = block.to_a[i] = block.to_b[i] = block.to_c[i] = 0;
  block.bend[i] = 0;
  if (stiffens) put_stiffening(star.first + lane / kLanes, i, 0, {});
  if (has_fibres) put_fibres(star.first + lane / kLanes, i, 0, {});
}

void Stars::put_laplacian(std::uint32_t at, std::uint32_t slot, unsigned corner, const Element& element) {
  const auto& [a, b, c] = kSideCorners[corner];
  StarBlock& block = blocks_[at];
  block.to_a[slot] = static_cast<float>(element.laplacian[kEdgeOfCorners[corner][a]]);
  block.to_b[slot] = static_cast<float>(element.laplacian[kEdgeOfCorners[corner][b]]);
  block.to_c[slot] = static_cast<float>(element.laplacian[kEdgeOfCorners[corner][c]]);
}

void Stars::put_fibres(std::uint32_t at, std::uint32_t slot, unsigned corner, const Element& element) {
  const auto& [a, b, c] = kSideCorners[corner];
  FibreBlock& block = fibres_[at];
  block.a[slot] = static_cast<float>(element.along[a]);
  block.b[slot] = static_cast<float>(element.along[b]);
  block.c[slot] = static_cast<float>(element.along[c]);
  block.stiffness[slot] = static_cast<float>(element.fibre);
}

void Stars::set_laplacian(TetId tet, const TetVertices& vertices, const Element& element) {
  for (unsigned i = 0; i < 4; ++i) {
    const std::uint32_t lane = lane_of_[tet][i], at = stars_[vertices[i]].first + lane / kLanes;
    put_laplacian(at, lane % kLanes, i, element);
    if (stiffens) put_stiffening(at, lane % kLanes, i, element);
  }
}

void Stars::put_stiffening(std::uint32_t at, std::uint32_t slot, unsigned corner, const Element& element) {
  const auto& [a, b, c] = kSideCorners[corner];
  StiffeningBlock& block = stiffening_[at];
  block.a_b[slot] = static_cast<float>(element.laplacian[kEdgeOfCorners[a][b]]);
  block.b_c[slot] = static_cast<float>(element.laplacian[kEdgeOfCorners[b][c]]);
  block.c_a[slot] = static_cast<float>(element.laplacian[kEdgeOfCorners[c][a]]);
  block.offset[slot] = static_cast<float>(element.offset);
  block.by[slot] = static_cast<float>(element.stiffening);
  block.most[slot] = element.stiffening > 0 ? static_cast<float>((kStiffest - 1) / element.stiffening)
                                            : std::numeric_limits<float>::max();
}

void Stars::lay_out(VertexId vertex, std::uint32_t tets) {
  Star& star = stars_[vertex];
  star.lanes = 0;
  star.blocks = static_cast<std::uint16_t>((tets + kLanes - 1) / kLanes);
  star.first = take(star.blocks);
  for (std::uint32_t lane = 0; lane < star.blocks * kLanes; ++lane) clear_lane(star, lane, vertex);
}

/// Moves a full star to where it has one block more; a new one begins with two.
void Stars::grow(Star& star, VertexId vertex) {
  const Star old = star;
  star.blocks = static_cast<std::uint16_t>(old.blocks + (old.blocks == 0 ? 2 : 1));
  star.first = take(star.blocks);
  for (std::uint32_t i = 0; i < old.blocks; ++i) {
    blocks_[star.first + i] = blocks_[old.first + i];
    if (stiffens) stiffening_[star.first + i] = stiffening_[old.first + i];
    if (has_fibres) fibres_[star.first + i] = fibres_[old.first + i];
    owners_[star.first + i] = owners_[old.first + i];
  }
  for (std::uint32_t lane = old.blocks * kLanes; lane < star.blocks * kLanes; ++lane) clear_lane(star, lane, vertex);
  if (old.blocks == 0) return;
  if (free_.size() <= old.blocks) free_.resize(old.blocks + 1U);
  free_[old.blocks].push_back(old.first);
}

void Stars::add(TetId tet, const TetVertices& vertices, const Element& element) {
  const std::uint8_t bend = bend_code(element);
  for (unsigned i = 0; i < 4; ++i) {
    Star& star = stars_[vertices[i]];
    std::uint32_t lane = star.lanes;
    if (Holes& holes = holes_[vertices[i]]; holes.count > 0) {
      lane = fill_hole(star, holes);
    } else {
      if (star.lanes == star.blocks * kLanes) grow(star, vertices[i]);
      ++star.lanes;
    }
    const std::uint32_t at = star.first + lane / kLanes, slot = lane % kLanes;
    const auto& [a, b, c] = kSideCorners[i];
    StarBlock& block = blocks_[at];
    block.a[slot] = vertices[a].value;
    block.b[slot] = vertices[b].value;
    block.c[slot] = vertices[c].value;
    block.bulk[slot] = static_cast<float>(element.bulk);
    block.pressure[slot] = static_cast<float>(element.give > 0 ? element.pressure : -element.pressure);
    block.bend[slot] = bend;
    put_laplacian(at, slot, i, element);
    if (stiffens) put_stiffening(at, slot, i, element);
    if (has_fibres) put_fibres(at, slot, i, element);
    owners_[at][slot] = tet.value * 4 + i;
    lane_of_[tet][i] = static_cast<std::uint16_t>(lane);
  }
}

void Stars::move_lane(const Star& star, std::uint32_t from, std::uint32_t to) {
  const StarBlock& source = blocks_[star.first + from / kLanes];
  StarBlock& target = blocks_[star.first + to / kLanes];
  const std::uint32_t i = from % kLanes, j = to % kLanes;
  target.a[j] = source.a[i];
  target.b[j] = source.b[i];
  target.c[j] = source.c[i];
  target.bulk[j] = source.bulk[i];
  target.pressure[j] = source.pressure[i];
  target.to_a[j] = source.to_a[i];
  target.to_b[j] = source.to_b[i];
  target.to_c[j] = source.to_c[i];
  target.bend[j] = source.bend[i];
  if (stiffens) {
    const StiffeningBlock& other = stiffening_[star.first + from / kLanes];
    StiffeningBlock& into = stiffening_[star.first + to / kLanes];
    into.a_b[j] = other.a_b[i];
    into.b_c[j] = other.b_c[i];
    into.c_a[j] = other.c_a[i];
    into.offset[j] = other.offset[i];
    into.by[j] = other.by[i];
    into.most[j] = other.most[i];
  }
  if (has_fibres) {
    const FibreBlock& other = fibres_[star.first + from / kLanes];
    FibreBlock& into = fibres_[star.first + to / kLanes];
    into.a[j] = other.a[i];
    into.b[j] = other.b[i];
    into.c[j] = other.c[i];
    into.stiffness[j] = other.stiffness[i];
  }
  const std::uint32_t moved = owner(star, from);
  owners_[star.first + to / kLanes][j] = moved;
  lane_of_[TetId(moved / 4)][moved % 4] = static_cast<std::uint16_t>(to);
}

std::uint32_t Stars::fill_hole(const Star& star, Holes& holes) const {
  std::uint32_t lane = holes.from;
  while (owner(star, lane) != kHole) ++lane;
  holes.from = static_cast<std::uint16_t>(lane + 1);
  --holes.count;
  return lane;
}

void Stars::remove(TetId tet, const TetVertices& vertices) {
  for (unsigned i = 0; i < 4; ++i) {
    const std::uint16_t lane = lane_of_[tet][i];
    owners_[stars_[vertices[i]].first + lane / kLanes][lane % kLanes] = kHole;
    Holes& holes = holes_[vertices[i]];
    holes.from = holes.count == 0 ? lane : std::min(holes.from, lane);
    ++holes.count;
  }
}

void Stars::close(VertexId vertex) {
  Star& star = stars_[vertex];
  Holes& holes = holes_[vertex];
  while (holes.count > 0) {
    const std::uint32_t last = star.lanes - 1U;
    if (owner(star, last) == kHole) {
      --holes.count;
    } else {
      move_lane(star, last, fill_hole(star, holes));
    }
    clear_lane(star, last, vertex);
    --star.lanes;
  }
}

double Stars::diagonal(VertexId vertex) const {
  const Star& star = stars_[vertex];
  double sum = 0;
  for (std::uint32_t i = 0; i < star.used_blocks(); ++i) {
    const StarBlock& block = blocks_[star.first + i];
    for (std::uint32_t k = 0; k < kLanes; ++k) {
      sum -=
          static_cast<double>(block.to_a[k]) + static_cast<double>(block.to_b[k]) + static_cast<double>(block.to_c[k]);
    }
  }
  return sum;
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
