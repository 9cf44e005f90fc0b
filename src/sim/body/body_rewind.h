// SPDX-License-Identifier: Apache-2.0
// What undo and redo do to a body that has moved since: it keeps its places and velocities, since the mesh only knows
// those of the time of the cut.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "incise/geom/box.h"
#include "sim/body/body_state.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// Tets by where they are at rest, to find the one that a point is in.
class RestGrid {
 public:
  using Corners = std::array<Vec3, 4>;
  using Weights = std::array<double, 4>;

  void build(std::vector<Corners> tets);
  /// The tet that holds a point, or is nearest to holding it, with the point's barycentric coordinates. There must be
  /// tets. Cost: O(tets that meet a cell).
  [[nodiscard]] std::size_t find(const Vec3& point, Weights& weights) const;
  [[nodiscard]] const Corners& tet(std::size_t index) const { return tets_[index]; }

 private:
  [[nodiscard]] std::array<std::uint32_t, 3> cell_of(const Vec3& point) const;
  [[nodiscard]] std::size_t index(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return x + std::size_t{side_} * (y + std::size_t{side_} * z);
  }
  template <class Visit>
  void for_each_cell(const Corners& tet, const Visit& visit) const;

  std::vector<Corners> tets_;
  Box box_;
  std::uint32_t side_ = 1;  // cells along each axis
  std::vector<std::uint32_t> first_, members_;
};

/// One `follow` over undone or redone steps.
class Rewind {
 public:
  /// Before anything is changed.
  void begin(const DeformableBody::State& s);
  /// Notes what stands otherwise than before: steps that were undone may be gone from the journal.
  void compare(DeformableBody::State& s, const TetMesh& mesh);
  /// Puts what the rest shape has anew, or elsewhere, to where the body has this material, as fast as it is there, and
  /// gives the momentum back that the mesh's own undo took. To be called with the tets in place.
  void put_back(DeformableBody::State& s);

 private:
  struct OldTet {
    TetVertices vertices;
    std::array<Vec3, 4> places, velocities;
  };
  /// Where a point at rest was in the body, with its velocity, before.
  struct Sample {
    const OldTet* tet = nullptr;
    std::array<double, 4> weights{};
    Vec3 place = Vec3::Zero(), velocity = Vec3::Zero();
  };

  [[nodiscard]] Vec3 old_velocity(std::uint32_t vertex) const;
  [[nodiscard]] Sample sample(const Vec3& rest) const;
  void put(DeformableBody::State& s, VertexId v);
  void hold_again(DeformableBody::State& s, VertexId v, const Sample& sample);
  void balance(DeformableBody::State& s);

  std::vector<double> masses_, momenta_;
  std::vector<std::uint8_t> was_live_;
  std::vector<OldTet> old_tets_;
  RestGrid grid_;
  std::vector<Vec3> velocities_;  // of the fresh vertices, as in `touched.fresh`
};

}  // namespace detail
}  // namespace v0
}  // namespace incise
