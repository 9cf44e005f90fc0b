// SPDX-License-Identifier: Apache-2.0
// Faces are matched in the list of their lowest point, by counting sort; stars likewise.
#include "image/labelled_tets.h"

#include <algorithm>

#include "incise/mesh/tet_tables.h"

namespace incise {
inline namespace v0 {
namespace image {
namespace {

/// A face by its two greater points, in the list of its least.
struct Face {
  std::uint32_t middle, greatest, side;
};

struct SortedFace {
  std::uint32_t least;
  Face face;
};

SortedFace face_of(const LabelledTets& mesh, std::size_t tet, std::size_t side) {
  const auto& c = mesh.tets[tet];
  const auto& order = kSideCorners[side];
  std::array<std::uint32_t, 3> p = {c[order[0]], c[order[1]], c[order[2]]};
  std::sort(p.begin(), p.end());
  return {p[0], {p[1], p[2], static_cast<std::uint32_t>(4 * tet + side)}};
}

}  // namespace

void LabelledTets::drop_background() {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < tets.size(); ++t) {
    if (labels[t] == 0) continue;
    tets[kept] = tets[t];
    labels[kept++] = labels[t];
  }
  tets.resize(kept);
  labels.resize(kept);
  std::vector<std::uint32_t> number(points.size(), kNoTet);
  for (const Corners& tet : tets) {
    for (const std::uint32_t p : tet) number[p] = 0;
  }
  std::uint32_t used = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (number[p] == kNoTet) continue;
    points[used] = points[p];
    number[p] = used++;
  }
  points.resize(used);
  for (Corners& tet : tets) {
    for (std::uint32_t& p : tet) p = number[p];
  }
}

std::vector<std::array<std::uint32_t, 4>> find_neighbours(const LabelledTets& mesh) {
  std::vector<std::size_t> first(mesh.points.size() + 1, 0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t s = 0; s < 4; ++s) ++first[face_of(mesh, t, s).least + 1];
  }
  for (std::size_t p = 0; p < mesh.points.size(); ++p) first[p + 1] += first[p];
  std::vector<std::size_t> end(first.begin(), first.end() - 1);
  std::vector<Face> faces(4 * mesh.tets.size());
  std::vector<std::array<std::uint32_t, 4>> out(mesh.tets.size(), {kNoTet, kNoTet, kNoTet, kNoTet});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t s = 0; s < 4; ++s) {
      const SortedFace mine = face_of(mesh, t, s);
      std::size_t& last = end[mine.least];
      faces[last++] = mine.face;
      for (std::size_t f = first[mine.least]; f + 1 < last; ++f) {
        if (faces[f].middle != mine.face.middle || faces[f].greatest != mine.face.greatest) continue;
        const std::uint32_t other = faces[f].side;
        out[t][s] = other / 4;
        out[other / 4][other % 4] = static_cast<std::uint32_t>(t);
      }
    }
  }
  return out;
}

Stars::Stars(const LabelledTets& mesh) : first_(mesh.points.size() + 1, 0), tets_(4 * mesh.tets.size()) {
  for (const auto& tet : mesh.tets) {
    for (const std::uint32_t p : tet) ++first_[p + 1];
  }
  for (std::size_t p = 0; p < mesh.points.size(); ++p) first_[p + 1] += first_[p];
  std::vector<std::size_t> end(first_.begin(), first_.end() - 1);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (const std::uint32_t p : mesh.tets[t]) tets_[end[p]++] = static_cast<std::uint32_t>(t);
  }
}

}  // namespace image
}  // namespace v0
}  // namespace incise
