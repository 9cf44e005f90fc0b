// SPDX-License-Identifier: Apache-2.0
// A body whose edges are crossed, vertices ON and faces pierced at will, without a blade.
#pragma once

#include "cut/rebuild.h"
#include "incise/mesh/journal.h"
#include "support/random.h"

namespace incise::test {

/// A body all of whose tets are masters of one closed complex.
class FlaggedBody {
 public:
  explicit FlaggedBody(TetSoup soup);
  FlaggedBody(const FlaggedBody&) = delete;
  FlaggedBody& operator=(const FlaggedBody&) = delete;

  [[nodiscard]] const TetMesh& mesh() const { return mesh_; }
  [[nodiscard]] const ClosedComplex& complex() const { return complex_; }
  [[nodiscard]] ClosedComplex& complex() { return complex_; }
  [[nodiscard]] const Journal& journal() const { return journal_; }

  /// Crosses an edge once more; where it is crossed then, at `t`.
  void toggle(std::uint32_t edge, double t);
  /// Crosses every edge once more with probability `share`, anywhere between 0.05 and 0.95 of it.
  void toggle_some(Random& random, double share);
  /// Lets a vertex take part in the cut itself, unless a tet would get a fourth such vertex.
  void put_on(VertexId vertex);
  void put_some_on(Random& random, double share);
  /// Front points in all faces that need one, somewhere; those that are there move with probability `moved_share`.
  void place_points(Random& random, double moved_share);
  /// Moves every vertex by up to `reach` along each axis from where it is at rest: copies come apart.
  void stand(Random& random, double reach);

  RebuildStatistics rebuild(const Rebuild::Settings& settings = {.crumb_share = 0});
  [[nodiscard]] const Step& last_step() const { return journal_.step(journal_.position() - 1); }
  [[nodiscard]] std::size_t steps() const { return journal_.position(); }
  void undo() { journal_.undo(mesh_); }
  void redo() { journal_.redo(mesh_); }

 private:
  void add_point(Random& random, std::uint32_t master, unsigned side);
  void place(Random& random, FrontPoint& point) const;
  void mark_dirty(const FrontPoint& point);

  TetMesh mesh_;
  Journal journal_;
  SplitTemplates templates_;
  ClosedComplex complex_;
  Rebuild rebuild_;
  OwnSheet no_sheet_;
};

}  // namespace incise::test
