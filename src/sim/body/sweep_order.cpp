// SPDX-License-Identifier: Apache-2.0
// Heat by vertex counts down while it rests; lists of the awake are merged with what woke, by rank, and lent vertices
// visit with the seam (docs/internals.md, 4).
#include "sim/body/sweep_order.h"

#include <algorithm>

namespace incise {
inline namespace v0 {
namespace detail {

void SweepOrder::ensure(std::uint32_t vertex_slots) {
  if (vertex_slots <= parts_.size()) return;
  parts_.resize(vertex_slots, Part::kNone);
  heat_.resize(vertex_slots, 0);
  rank_.resize(vertex_slots, 0);
  is_lent_.resize(vertex_slots, 0);
}

void SweepOrder::begin(std::span<const std::uint32_t> order, const std::vector<bool>& is_first, const Stars& stars) {
  for (std::size_t i = 0; i < order.size(); ++i) {
    const VertexId v(order[i]);
    parts_[v] = is_first[i] ? Part::kFirst : Part::kSecond;
    rank_[v] = next_rank_++;
  }
  moving_ = order.size();
  for (const std::uint32_t slot : order) {
    const VertexId v(slot);
    if (part_beside(v, stars) == Part::kSeam && parts_[v] == Part::kFirst) parts_[v] = Part::kSeam;
    wake(v);
  }
}

/// The part that a vertex may be in as its neighbours are; the first where they leave the choice.
SweepOrder::Part SweepOrder::part_beside(VertexId vertex, const Stars& stars) const {
  bool touches[4] = {};
  const auto note = [&](VertexId n) { touches[static_cast<std::size_t>(parts_[n])] = true; };
  for_each_neighbour(stars, vertex, note);
  const Part own = parts_[vertex];
  if (own != Part::kNone) touches[static_cast<std::size_t>(own)] = true;
  if (touches[2] && own == Part::kSeam) return Part::kSeam;
  if (touches[0] && touches[1]) return Part::kSeam;
  return touches[1] ? Part::kSecond : Part::kFirst;
}

void SweepOrder::settle(VertexId vertex, const Stars& stars) {
  const Part part = part_beside(vertex, stars);
  if (part == parts_[vertex]) return;
  if (parts_[vertex] == Part::kNone) {
    rank_[vertex] = next_rank_++;
    ++moving_;
  }
  parts_[vertex] = part;
  is_stale_ = true;
  if (heat_[vertex] > 0) woken_.push_back(vertex.value);
}

void SweepOrder::drop(VertexId vertex) {
  if (parts_[vertex] == Part::kNone) return;
  parts_[vertex] = Part::kNone;
  heat_[vertex] = 0;
  --moving_;
  is_stale_ = true;
}

void SweepOrder::warm(VertexId vertex, std::uint8_t heat) {
  if (parts_[vertex] == Part::kNone) return;
  if (heat_[vertex] == 0) {
    woken_.push_back(vertex.value);
    is_stale_ = true;
  }
  heat_[vertex] = std::max(heat_[vertex], heat);
}

void SweepOrder::put_to_sleep(VertexId vertex) {
  if (heat_[vertex] == 0) return;
  heat_[vertex] = 0;
  is_stale_ = true;
}

void SweepOrder::wake_star(VertexId vertex, const Stars& stars) {
  wake(vertex);
  for_each_neighbour(stars, vertex, [&](VertexId n) { wake(n); });
}

void SweepOrder::lend_to_seam(std::span<const std::uint32_t> vertices) {
  if (std::equal(vertices.begin(), vertices.end(), lent_.begin(), lent_.end())) return;
  const auto move = [&](std::span<const std::uint32_t> list, std::uint8_t lent) {
    for (const std::uint32_t v : list) {
      is_lent_[VertexId(v)] = lent;
      if (heat_[VertexId(v)] > 0) woken_.push_back(v);
    }
  };
  move(lent_, 0);
  move(vertices, 1);
  lent_.assign(vertices.begin(), vertices.end());
  is_stale_ = true;
}

std::size_t SweepOrder::awake_count() const {
  return awake_[0].size() + awake_[1].size() + awake_[2].size();
}

std::size_t SweepOrder::count_awake() const {
  if (!is_stale_) return awake_count();
  return static_cast<std::size_t>(
      std::count_if(heat_.begin(), heat_.end(), [](std::uint8_t heat) { return heat > 0; }));
}

/// Takes out what sleeps or is in another part now, and merges in what woke, by rank. A slot that died and came back
/// since may have another rank in place.
void SweepOrder::refresh() {
  if (!is_stale_) return;
  is_stale_ = false;
  const auto is_before = [&](std::uint32_t a, std::uint32_t b) { return rank_[VertexId(a)] < rank_[VertexId(b)]; };
  std::sort(woken_.begin(), woken_.end(), is_before);
  woken_.erase(std::unique(woken_.begin(), woken_.end()), woken_.end());
  for (std::size_t part = 0; part < kParts; ++part) {
    auto& list = awake_[part];
    const auto belongs = [&](std::uint32_t slot) {
      const VertexId v(slot);
      const Part visited = is_lent_[v] != 0 && parts_[v] != Part::kNone ? Part::kSeam : parts_[v];
      return static_cast<std::size_t>(visited) == part && heat_[v] > 0;
    };
    std::erase_if(list, [&](std::uint32_t v) { return !belongs(v); });
    if (!std::is_sorted(list.begin(), list.end(), is_before)) std::sort(list.begin(), list.end(), is_before);
    const auto kept = static_cast<std::ptrdiff_t>(list.size());
    std::copy_if(woken_.begin(), woken_.end(), std::back_inserter(list), belongs);
    std::inplace_merge(list.begin(), list.begin() + kept, list.end(), is_before);
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  woken_.clear();
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
