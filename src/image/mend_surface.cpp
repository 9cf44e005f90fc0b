// SPDX-License-Identifier: Apache-2.0
// Repeats are found by sorted corners; turns spread over the edges of two triangles, and the smaller number of what
// hangs together is turned.
#include "image/mend_surface.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace incise {
inline namespace v0 {
namespace image {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Two triangles on both sides of an edge.
struct Neighbours {
  std::uint32_t a, b;
  bool disagree;  ///< both go along the edge in the same direction
};

std::vector<Neighbours> find_neighbours(const std::vector<Triangle>& triangles) {
  struct Use {
    std::uint32_t low, high, triangle;
    bool is_upwards;
  };
  std::vector<Use> uses;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = triangles[t][i], to = triangles[t][(i + 1) % 3];
      uses.push_back({std::min(from, to), std::max(from, to), t, from < to});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const Use& x, const Use& y) {
    return std::tie(x.low, x.high, x.triangle) < std::tie(y.low, y.high, y.triangle);
  });
  std::vector<Neighbours> neighbours;
  for (std::size_t i = 0, end = 0; i < uses.size(); i = end) {
    while (end < uses.size() && uses[end].low == uses[i].low && uses[end].high == uses[i].high) ++end;
    if (end - i != 2) continue;
    neighbours.push_back({uses[i].triangle, uses[i + 1].triangle, uses[i].is_upwards == uses[i + 1].is_upwards});
  }
  return neighbours;
}

/// The neighbours of each triangle, one list after the other.
struct Adjacency {
  std::vector<std::uint32_t> first;  // of each triangle; one more
  std::vector<std::pair<std::uint32_t, bool>> to;

  explicit Adjacency(const std::vector<Triangle>& triangles) : first(triangles.size() + 1, 0) {
    const std::vector<Neighbours> neighbours = find_neighbours(triangles);
    for (const Neighbours& n : neighbours) {
      ++first[n.a + 1];
      ++first[n.b + 1];
    }
    for (std::size_t t = 0; t < triangles.size(); ++t) first[t + 1] += first[t];
    to.resize(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (const Neighbours& n : neighbours) {
      to[next[n.a]++] = {n.b, n.disagree};
      to[next[n.b]++] = {n.a, n.disagree};
    }
  }
};

}  // namespace

std::size_t drop_repeated(std::vector<Triangle>& triangles) {
  std::erase_if(triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[0] == t[2]; });
  std::vector<std::pair<Triangle, std::uint32_t>> corners;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    Triangle sorted = triangles[i];
    std::sort(sorted.begin(), sorted.end());
    corners.emplace_back(sorted, i);
  }
  std::sort(corners.begin(), corners.end());
  std::vector<bool> is_repeated(triangles.size(), false);
  std::size_t count = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (corners[i].first != corners[i - 1].first) continue;
    is_repeated[corners[i].second] = true;
    ++count;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (!is_repeated[i]) triangles[kept++] = triangles[i];
  }
  triangles.resize(kept);
  return count;
}

std::size_t turn_alike(std::vector<Triangle>& triangles) {
  const Adjacency adjacency(triangles);
  enum class Way : std::uint8_t { kUnknown, kAsItIs, kTurned };
  std::vector<Way> ways(triangles.size(), Way::kUnknown);
  std::vector<std::uint32_t> patch;  // what hangs together
  std::size_t count = 0;
  for (std::uint32_t seed = 0; seed < triangles.size(); ++seed) {
    if (ways[seed] != Way::kUnknown) continue;
    patch.assign(1, seed);
    ways[seed] = Way::kAsItIs;
    std::size_t turned = 0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      const std::uint32_t here = patch[i];
      for (std::uint32_t k = adjacency.first[here]; k < adjacency.first[here + 1]; ++k) {
        const auto& [other, disagree] = adjacency.to[k];
        if (ways[other] != Way::kUnknown) continue;
        const bool is_turned = (ways[here] == Way::kTurned) != disagree;
        ways[other] = is_turned ? Way::kTurned : Way::kAsItIs;
        turned += is_turned ? 1U : 0U;
        patch.push_back(other);
      }
    }
    const Way fewer = 2 * turned <= patch.size() ? Way::kTurned : Way::kAsItIs;
    for (const std::uint32_t t : patch) {
      if (ways[t] != fewer) continue;
      std::swap(triangles[t][1], triangles[t][2]);
      ++count;
    }
  }
  return count;
}

}  // namespace image
}  // namespace v0
}  // namespace incise
