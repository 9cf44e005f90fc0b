// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

namespace incise {
inline namespace v0 {

/// The number that stands for "no element" in every id.
inline constexpr std::uint32_t kInvalidIndex = 0xFFFFFFFFU;

/// A typed 32-bit slot number; ids of different tags neither convert nor compare.
///
/// Default-constructed ids are invalid. A slot may be reused after its element dies; a user who keeps
/// an element across steps also keeps the slot's generation (see `TetMesh::generation`).
template <class Tag>
struct Id {
  std::uint32_t value = kInvalidIndex;  ///< the slot

  constexpr Id() = default;
  /// The id of a slot.
  constexpr explicit Id(std::uint32_t slot) : value(slot) {}

  [[nodiscard]] constexpr bool is_valid() const { return value != kInvalidIndex; }  ///< names some slot
  friend constexpr bool operator==(Id a, Id b) { return a.value == b.value; }
  friend constexpr bool operator!=(Id a, Id b) { return a.value != b.value; }
  friend constexpr bool operator<(Id a, Id b) { return a.value < b.value; }
};

struct VertexTag;
struct TetTag;

/// A vertex of a mesh.
using VertexId = Id<VertexTag>;
/// A tet of a mesh.
using TetId = Id<TetTag>;

}  // namespace v0
}  // namespace incise

template <class Tag>
struct std::hash<incise::Id<Tag>> {
  std::size_t operator()(incise::Id<Tag> id) const noexcept { return id.value; }
};
