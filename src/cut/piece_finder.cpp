// SPDX-License-Identifier: Apache-2.0
// Floods from all seeds take turns, tet by tet, and unite where they meet; once one is left that is not done, the rest
// is known to be apart or together without it (docs/internals.md, 3).
#include "cut/piece_finder.h"

#include <algorithm>

namespace incise {
inline namespace v0 {

std::uint32_t PieceFinder::root(std::uint32_t flood) {
  while (floods_[flood].parent != flood) {
    flood = floods_[flood].parent = floods_[floods_[flood].parent].parent;
  }
  return flood;
}

/// The flood that has a tet; a new one where none has.
std::uint32_t PieceFinder::start(TetId seed) {
  flood_of_.ensure(std::size_t{seed.value} + 1);
  std::uint32_t& flood = flood_of_[seed.value];
  if (flood != 0) return flood - 1;
  if (flood_count_ == floods_.size()) floods_.emplace_back();
  Flood& fresh = floods_[flood_count_];
  fresh.parent = flood_count_;
  fresh.queue.assign(1, seed);
  fresh.next = 0;
  touched_.push_back(seed);
  flood = ++flood_count_;
  return flood - 1;
}

/// The longer queue takes up the shorter one.
void PieceFinder::unite(std::uint32_t a, std::uint32_t b) {
  if (floods_[a].queue.size() - floods_[a].next < floods_[b].queue.size() - floods_[b].next) std::swap(a, b);
  Flood &kept = floods_[a], &met = floods_[b];
  kept.queue.insert(kept.queue.end(), met.queue.begin() + static_cast<std::ptrdiff_t>(met.next), met.queue.end());
  met.parent = a;
}

/// Looks at one more tet of a flood.
void PieceFinder::advance(const TetMesh& mesh, std::uint32_t flood) {
  const TetId tet = floods_[flood].queue[floods_[flood].next++];
  for (const Link link : mesh.links(tet)) {
    if (link.is_boundary()) continue;
    const TetId next = link.side().tet();
    flood_of_.ensure(std::size_t{next.value} + 1);
    if (const std::uint32_t known = flood_of_[next.value]; known != 0) {
      const std::uint32_t other = root(known - 1);
      flood = root(flood);
      if (other != flood) unite(flood, other);
      continue;
    }
    flood = root(flood);
    flood_of_[next.value] = flood + 1;
    touched_.push_back(next);
    floods_[flood].queue.push_back(next);
  }
}

std::uint32_t PieceFinder::find(const TetMesh& mesh, std::span<const TetId> seeds) {
  pieces_.clear();
  for (const TetId seed : seeds) pieces_.push_back(start(seed));
  open_.resize(flood_count_);
  for (std::uint32_t i = 0; i < flood_count_; ++i) open_[i] = i;
  const auto is_done = [&](std::uint32_t i) {
    return floods_[i].parent != i || floods_[i].next == floods_[i].queue.size();
  };
  while (open_.size() > 1) {
    for (const std::uint32_t i : open_) {
      if (!is_done(i)) advance(mesh, i);
    }
    std::erase_if(open_, is_done);
  }
  seen_as_.assign(flood_count_, kInvalidIndex);
  std::uint32_t count = 0;
  for (std::uint32_t& piece : pieces_) {
    std::uint32_t& known = seen_as_[root(piece)];
    if (known == kInvalidIndex) known = count++;
    piece = known;
  }
  forget();
  return count;
}

void PieceFinder::forget() {
  for (const TetId tet : touched_) flood_of_[tet.value] = 0;
  touched_.clear();
  flood_count_ = 0;
}

}  // namespace v0
}  // namespace incise
