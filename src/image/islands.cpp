// SPDX-License-Identifier: Apache-2.0
// Islands of labels: components of runs of voxels along i.
#include <algorithm>
#include <map>

#include "image/label_volume.h"

namespace incise {
inline namespace v0 {
namespace image {
namespace {

/// Voxels [begin, end) of one row, all of one label.
struct Run {
  std::int64_t begin, end;
  LabelIndex label;
  std::uint32_t parent;
};

/// Runs of all rows, row after row, joined into components.
class Runs {
 public:
  explicit Runs(const LabelVolume& volume) : size_(volume.size()) {
    first_.reserve(static_cast<std::size_t>(size_[1] * size_[2] + 1));
    for (std::int64_t k = 0; k < size_[2]; ++k) {
      for (std::int64_t j = 0; j < size_[1]; ++j) add_row(volume.row(j, k));
    }
    first_.push_back(runs_.size());
    for (std::int64_t k = 0; k < size_[2]; ++k) {
      for (std::int64_t j = 0; j < size_[1]; ++j) {
        if (j > 0) join_rows(row(j - 1, k), row(j, k));
        if (k > 0) join_rows(row(j, k - 1), row(j, k));
      }
    }
    for (std::uint32_t r = 0; r < runs_.size(); ++r) (void)root(r);
    voxels_.assign(runs_.size(), 0);
    for (const Run& run : runs_) voxels_[run.parent] += static_cast<std::uint64_t>(run.end - run.begin);
  }

  [[nodiscard]] std::size_t row(std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>(k * size_[1] + j);
  }
  [[nodiscard]] std::size_t first(std::size_t row) const { return first_[row]; }
  [[nodiscard]] const Run& run(std::size_t r) const { return runs_[r]; }
  [[nodiscard]] std::uint64_t voxels_around(std::size_t r) const { return voxels_[runs_[r].parent]; }

 private:
  void add_row(const LabelIndex* voxel) {
    first_.push_back(runs_.size());
    for (std::int64_t i = 0; i < size_[0];) {
      const std::int64_t begin = i;
      while (i < size_[0] && voxel[i] == voxel[begin]) ++i;
      runs_.push_back({begin, i, voxel[begin], static_cast<std::uint32_t>(runs_.size())});
    }
  }

  void join_rows(std::size_t a, std::size_t b) {
    std::size_t x = first_[a], y = first_[b];
    while (x < first_[a + 1] && y < first_[b + 1]) {
      if (runs_[x].label == runs_[y].label) join(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
      const std::int64_t end_x = runs_[x].end, end_y = runs_[y].end;
      if (end_x <= end_y) ++x;
      if (end_y <= end_x) ++y;
    }
  }

  std::uint32_t root(std::uint32_t r) {
    std::uint32_t top = r;
    while (runs_[top].parent != top) top = runs_[top].parent;
    while (runs_[r].parent != top) {
      const std::uint32_t next = runs_[r].parent;
      runs_[r].parent = top;
      r = next;
    }
    return top;
  }

  void join(std::uint32_t x, std::uint32_t y) {
    const std::uint32_t a = root(x), b = root(y);
    runs_[std::max(a, b)].parent = std::min(a, b);
  }

  std::array<std::int64_t, 3> size_;
  std::vector<Run> runs_;
  std::vector<std::size_t> first_;     // run of each row
  std::vector<std::uint64_t> voxels_;  // of each component, at its first run
};

}  // namespace

std::uint64_t LabelVolume::join_islands(std::uint64_t least_voxels) {
  const Runs runs(*this);
  std::map<std::pair<std::uint32_t, LabelIndex>, std::uint64_t> faces;  // of an island with a label
  const auto each_island_run = [&](const auto& work) {
    for (std::int64_t k = 0; k < size_[2]; ++k) {
      for (std::int64_t j = 0; j < size_[1]; ++j) {
        const std::size_t row = runs.row(j, k);
        for (std::size_t r = runs.first(row); r < runs.first(row + 1); ++r) {
          if (runs.voxels_around(r) < least_voxels) work(runs.run(r), j, k);
        }
      }
    }
  };
  each_island_run([&](const Run& run, std::int64_t j, std::int64_t k) {
    const auto count = [&](LabelIndex other) {
      if (other != run.label) ++faces[{run.parent, other}];
    };
    count(at(run.begin - 1, j, k));
    count(at(run.end, j, k));
    for (std::int64_t i = run.begin; i < run.end; ++i) {
      count(at(i, j - 1, k));
      count(at(i, j + 1, k));
      count(at(i, j, k - 1));
      count(at(i, j, k + 1));
    }
  });
  std::map<std::uint32_t, std::pair<std::uint64_t, LabelIndex>> most;
  for (const auto& [key, n] : faces) {
    auto& best = most[key.first];
    if (n > best.first) best = {n, key.second};
  }
  std::uint64_t changed = 0;
  each_island_run([&](const Run& run, std::int64_t j, std::int64_t k) {
    const auto to = most.find(run.parent);
    if (to == most.end()) return;
    LabelIndex* voxel = voxels_.data() + (k * size_[1] + j) * size_[0];
    std::fill(voxel + run.begin, voxel + run.end, to->second.second);
    changed += static_cast<std::uint64_t>(run.end - run.begin);
  });
  if (changed > 0) index_blocks();
  return changed;
}

}  // namespace image
}  // namespace v0
}  // namespace incise
