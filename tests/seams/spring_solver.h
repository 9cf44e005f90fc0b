// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "incise/mesh/journal_visitor.h"
#include "incise/sim/solver.h"

namespace incise::test {

/// A solver of one's own: equal masses on springs along the edges of tets, damped, held where it stands highest.
///
/// It has its own copy of the tets and follows the mesh by `JournalVisitor` alone; it knows no undo.
class SpringSolver final : public Solver, private JournalVisitor {
 public:
  explicit SpringSolver(const TetMesh& mesh);

  Result<FollowReport> follow(const Journal& journal, const TetMesh& mesh) override;
  Result<AdvanceReport> advance(double dt) override;
  Status set_pulls(std::vector<Pull> pulls) override;
  [[nodiscard]] Vec3 pull_force(std::size_t index) const override;
  [[nodiscard]] std::span<const Vec3> positions() const override { return place_; }
  void slow_down(double factor) override;
  [[nodiscard]] Mat3 local_stiffness(VertexId vertex) const override;
  [[nodiscard]] std::uint64_t hash() const override;

  /// Whether its tets are those of a mesh.
  [[nodiscard]] bool fits(const TetMesh& mesh) const;

 private:
  void born(const BornVertex& born) override;
  void moved(const MovedVertex& moved) override;
  void copied(const CopiedVertex& copied) override;
  void replaced(std::span<const ConsumedTet> consumed, std::span<const ProducedTet> produced) override;
  void rewired(const RewiredTet& tet) override;
  void grow(std::size_t vertices, std::size_t tets);
  void fall(double dt);

  std::vector<Vec3> rest_, place_, velocity_;
  std::vector<bool> is_held_;
  std::vector<TetVertices> tets_;  // the first vertex is invalid where the slot is free
  std::vector<Pull> pulls_;
  std::size_t position_ = 0, fresh_ = 0, added_ = 0, removed_ = 0;
};

}  // namespace incise::test
