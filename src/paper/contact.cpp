// SPDX-License-Identifier: Apache-2.0
// Vertices get a bit for each half-space outside the sheet's slabs; a tet whose corners share a bit cannot meet it,
// and the rest is asked by the tree of triangles (docs/internals.md, 3.12).
#include "paper/contact.h"

#include <algorithm>

#include "incise/core/parallel.h"

namespace incise {
inline namespace v0 {

namespace {

/// Up to four slabs (the axes and the mean normal) that together enclose a sheet.
class Slabs {
 public:
  explicit Slabs(const Sheet& sheet) {
    const Box& box = sheet.bounds();
    const double margin = 1e-9 * (box.hi - box.lo).norm();
    for (int axis = 0; axis < 3; ++axis) {
      low_[axis] = box.lo[axis] - margin;
      high_[axis] = box.hi[axis] + margin;
    }
    normal_ = sheet.mean_normal();
    low_[3] = 1e300;
    high_[3] = -1e300;
    for (std::uint32_t t = 0; t < sheet.triangle_count(); ++t) {
      for (unsigned c = 0; c < 3; ++c) {
        const double height = normal_.dot(sheet.point(t, c).position);
        low_[3] = std::min(low_[3], height - margin);
        high_[3] = std::max(high_[3], height + margin);
      }
    }
  }
  /// One bit per half-space outside a slab that holds the point.
  [[nodiscard]] std::uint8_t outcode(const Vec3& p) const {
    unsigned code = 0;
    for (int axis = 0; axis < 3; ++axis) {
      code |= static_cast<unsigned>(p[axis] < low_[axis]) << (2 * axis);
      code |= static_cast<unsigned>(p[axis] > high_[axis]) << (2 * axis + 1);
    }
    const double height = normal_.dot(p);
    code |= static_cast<unsigned>(height < low_[3]) << 6U;
    code |= static_cast<unsigned>(height > high_[3]) << 7U;
    return static_cast<std::uint8_t>(code);
  }

 private:
  double low_[4], high_[4];
  Vec3 normal_;
};

Box box_of(const TetMesh& mesh, TetId tet) {
  const TetVertices& v = mesh.vertices(tet);
  Box box{mesh.rest(v[0]), mesh.rest(v[0])};
  for (unsigned c = 1; c < 4; ++c) {
    box.lo = box.lo.cwiseMin(mesh.rest(v[c]));
    box.hi = box.hi.cwiseMax(mesh.rest(v[c]));
  }
  return box;
}

bool meets_some_triangle(const TetMesh& mesh, TetId tet, const Sheet& sheet) {
  bool meets = false;
  sheet.tree().for_each_overlap(box_of(mesh, tet), [&](std::uint32_t) { meets = true; });
  return meets;
}

}  // namespace

std::vector<TetId> find_near_tets(const TetMesh& mesh, const Sheet& sheet, unsigned threads) {
  const Slabs slabs(sheet);
  std::vector<std::uint8_t> outcode(mesh.vertex_slots());
  parallel_blocks(outcode.size(), threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t slot = begin; slot < end; ++slot) {
      outcode[slot] = slabs.outcode(mesh.rest(VertexId(static_cast<std::uint32_t>(slot))));
    }
  });
  const bool is_small = sheet.triangle_count() <= 2;
  std::vector<std::vector<TetId>> found(block_count(mesh.tet_slots()));
  parallel_blocks(mesh.tet_slots(), threads, [&](std::size_t block, std::size_t begin, std::size_t end) {
    for (std::size_t slot = begin; slot < end; ++slot) {
      const TetId tet(static_cast<std::uint32_t>(slot));
      if (!mesh.is_live(tet)) {
        continue;
      }
      const TetVertices& v = mesh.vertices(tet);
      const unsigned outside = outcode[v[0].value] & outcode[v[1].value] & outcode[v[2].value] & outcode[v[3].value];
      if (outside == 0 && (is_small || meets_some_triangle(mesh, tet, sheet))) {
        found[block].push_back(tet);
      }
    }
  });
  std::vector<TetId> near;
  for (const std::vector<TetId>& part : found) {
    near.insert(near.end(), part.begin(), part.end());
  }
  return near;
}

}  // namespace v0
}  // namespace incise
