// SPDX-License-Identifier: Apache-2.0
// The sutures of a simulation: where in the mesh their ends are, and which of them act.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "incise/core/hash.h"
#include "incise/core/result.h"
#include "incise/engine/suture.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// Ends are places of the rest shape: cutting and maintenance leave the material where it is there. So after every
/// change of the mesh an end is in the tet that holds that place now: what was a function of the mesh and the place
/// alone is so after undo and redo.
class Sutures {
 public:
  /// @param reach  length unit: an end that is no further than this outside of the tissue, as where maintenance has
  ///               smoothed the surface, is in the tissue nearest to it.
  /// @param unit   metres per length unit.
  Sutures(double reach, double unit) : reach_(reach), unit_(unit) {}

  [[nodiscard]] bool is_empty() const { return all_.empty(); }
  /// Errors: kBadArgument for an end that is in no live tet, or for numbers out of range.
  Result<std::uint32_t> add(const TetMesh& mesh, const std::array<TissuePoint, 2>& ends, const Suture& suture);
  /// Likewise; for a place of the rest shape without tissue.
  Result<std::uint32_t> add(const TetMesh& mesh, const std::array<Vec3, 2>& rest, const Suture& suture);
  /// Errors: kBadArgument where there is none of that id.
  Status remove(std::uint32_t id);

  /// Takes those whose turn comes into action.
  void begin_frame(std::uint64_t frame);
  /// Finds the ends in the mesh as it stands. Cost: O(sutures); O(tets) for each end whose tet has changed.
  void follow(const TetMesh& mesh);
  /// Takes out of action what pulls harder than it bears; returns their ids.
  std::vector<std::uint32_t> tear(const TetMesh& mesh);

  /// Those that act.
  [[nodiscard]] std::vector<Tie> ties() const;
  /// In the order in which they were added.
  [[nodiscard]] std::vector<SutureState> states(const TetMesh& mesh) const;
  void add_to(StateHash& hash) const;

 private:
  struct End {
    TissuePoint point;
    Vec3 rest = Vec3::Zero();
    std::array<Vec3, 4> corners;  // at rest, of the tet when the point was found
  };
  struct Entry {
    std::uint32_t id = 0;
    Suture suture;
    SutureStatus status = SutureStatus::kWaits;
    bool waits = true;  // for its first frame
    std::array<End, 2> ends;
  };

  [[nodiscard]] bool find(const TetMesh& mesh, End& end) const;
  [[nodiscard]] SutureState state_of(const TetMesh& mesh, const Entry& entry) const;
  std::uint32_t put(Entry entry);

  double reach_, unit_;
  std::uint32_t next_id_ = 0;
  std::vector<Entry> all_;
};

}  // namespace detail
}  // namespace v0
}  // namespace incise
