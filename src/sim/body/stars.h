// SPDX-License-Identifier: Apache-2.0
// The tets around each vertex as the vertex sees them, in blocks of 8 lanes: what the descent reads in its inner loop.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "incise/core/grow_array.h"
#include "incise/core/id_array.h"
#include "incise/mesh/tet_mesh.h"
#include "sim/body/element.h"

namespace incise {
inline namespace v0 {
namespace detail {

inline constexpr std::uint32_t kLanes = 8;

/// A number from 1 on in a byte, within an eighth of it: its three first binary places and its exponent, as floats have
/// them.
inline constexpr std::uint32_t kPowerOne = 0x3F800000U;
[[nodiscard]] constexpr float power_of(std::uint8_t code) {
  float power = 1 + 0.125F * static_cast<float>(code % 8);
  for (unsigned i = 0; i < code / 8U; ++i) power *= 2;
  return power;
}
/// The least code whose number is not below `value`.
[[nodiscard]] constexpr std::uint8_t power_code(double value) {
  std::uint8_t code = 0;
  while (code < 255 && static_cast<double>(power_of(code)) < value) ++code;
  return code;
}

/// Eight tets of one star. Unused lanes name the vertex itself and weigh nothing.
struct StarBlock {
  std::array<std::uint32_t, kLanes> a, b, c;   ///< the other corners, as `kSideCorners` orders them
  std::array<float, kLanes> bulk;              ///< of `Element`
  std::array<float, kLanes> pressure;          ///< likewise; below 0 where the vertices share nothing of the tet
  std::array<float, kLanes> to_a, to_b, to_c;  ///< the row of its Laplacian
  std::array<std::uint8_t, kLanes> bend;       ///< `power_code` of the curvature that a visit takes, by `bulk`
};

/// What else is known of the tets of a block where tissue stiffens: their energies, seen from the vertex.
struct StiffeningBlock {
  std::array<float, kLanes> a_b, b_c, c_a;  ///< of the Laplacian, between the other corners
  std::array<float, kLanes> offset;         ///< of `Element`
  std::array<float, kLanes> by;             ///< `Element::stiffening`
  std::array<float, kLanes> most;           ///< ψ beyond which it stiffens no more
};

/// What is known of the fibres of the tets of a block, seen from the vertex.
struct FibreBlock {
  std::array<float, kLanes> a, b, c;    ///< of `Element::along`, of the other corners
  std::array<float, kLanes> stiffness;  ///< `Element::fibre`
};

/// The blocks of one vertex.
struct Star {
  std::uint32_t first = 0;   ///< block
  std::uint16_t lanes = 0;   ///< tets
  std::uint16_t blocks = 0;  ///< taken

  [[nodiscard]] std::uint32_t used_blocks() const { return (lanes + kLanes - 1) / kLanes; }
};

/// All stars of a body. Stars grow and shrink as tets come and go, in O(1) each, and are read and written as little as
/// can be: where a body is cut they are cold. Blocks of stars that outgrew their place are used again.
class Stars {
 public:
  /// Whether tets may stiffen; to be set before anything is laid out.
  bool stiffens = false;
  /// Whether tets may have fibres; then they may stiffen, too.
  bool has_fibres = false;

  /// Makes room for as many slots.
  void ensure(std::uint32_t vertex_slots, std::uint32_t tet_slots);
  /// Lays an empty star out for `tets` tets, behind those laid out before: called in the order of the sweeps.
  void lay_out(VertexId vertex, std::uint32_t tets);
  /// Adds the four views of a tet that is not there.
  void add(TetId tet, const TetVertices& vertices, const Element& element);
  /// Takes the four views of a tet out that is there; `vertices` as they were when it was added. It leaves holes, which
  /// tets that are added next fill: nothing but these two calls may be made before `close` was called for each vertex.
  void remove(TetId tet, const TetVertices& vertices);
  /// Replaces the Laplacian of a tet that is there.
  void set_laplacian(TetId tet, const TetVertices& vertices, const Element& element);
  /// Closes the holes of a star. Cost: O(its tets) where there are any.
  void close(VertexId vertex);

  [[nodiscard]] const StarBlock* blocks() const { return blocks_.data(); }
  /// As many, or null where nothing stiffens.
  [[nodiscard]] const StiffeningBlock* stiffening() const { return stiffens ? stiffening_.data() : nullptr; }
  /// Likewise, where nothing has fibres.
  [[nodiscard]] const FibreBlock* fibres() const { return has_fibres ? fibres_.data() : nullptr; }
  [[nodiscard]] const Star& of(VertexId vertex) const { return stars_[vertex]; }
  [[nodiscard]] const Star* all() const { return stars_.data(); }
  /// The sum of the Laplacian's diagonal over the star: its stretch part of the stiffness.
  [[nodiscard]] double diagonal(VertexId vertex) const;
  /// Calls `visit(TetId)` for the tets of a star, in its order.
  template <class Visit>
  void for_each_tet(VertexId vertex, Visit&& visit) const {
    const Star& star = stars_[vertex];
    for (std::uint32_t lane = 0; lane < star.lanes; ++lane) visit(TetId(owner(star, lane) / 4));
  }

 private:
  using Owners = std::array<std::uint32_t, kLanes>;

  [[nodiscard]] std::uint32_t owner(const Star& star, std::uint32_t lane) const {
    return owners_[star.first + lane / kLanes][lane % kLanes];
  }
  [[nodiscard]] std::uint32_t take(std::uint16_t count);
  /// Of a star's lanes: how many are holes, and one before which there are none.
  struct Holes {
    std::uint16_t count = 0, from = 0;
  };

  [[nodiscard]] std::uint32_t fill_hole(const Star& star, Holes& holes) const;
  void grow(Star& star, VertexId vertex);
  void clear_lane(const Star& star, std::uint32_t lane, VertexId vertex);
  void move_lane(const Star& star, std::uint32_t from, std::uint32_t to);

  void put_laplacian(std::uint32_t at, std::uint32_t slot, unsigned corner, const Element& element);
  void put_stiffening(std::uint32_t at, std::uint32_t slot, unsigned corner, const Element& element);
  void put_fibres(std::uint32_t at, std::uint32_t slot, unsigned corner, const Element& element);

  GrowArray<StarBlock> blocks_;
  GrowArray<StiffeningBlock> stiffening_;
  GrowArray<FibreBlock> fibres_;
  GrowArray<Owners> owners_;  // by lane: tet · 4 + corner
  IdArray<VertexId, Star> stars_;
  IdArray<VertexId, Holes> holes_;
  IdArray<TetId, std::array<std::uint16_t, 4>> lane_of_;  // of each corner's view in its star
  std::vector<std::vector<std::uint32_t>> free_;          // first blocks, by how many they are
};

}  // namespace detail
}  // namespace v0
}  // namespace incise
