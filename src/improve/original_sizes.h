// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/core/grow_array.h"
#include "incise/mesh/journal.h"

namespace incise {
inline namespace v0 {

/// How long the edges of a mesh were around its vertices when its journal began.
///
/// Cuts make edges shorter. What a surface may give way to is measured by the elements that the body came with, not by
/// those that happen to stand there now.
class OriginalSizes {
 public:
  /// Notes an edge of a tet that nothing has changed yet.
  void note_edge(VertexId a, VertexId b, double length);
  /// Vertices that a step made have the size of the place where they were born. Cost: O(vertices born and copied).
  void follow(const Step& step);
  /// The mean length of the edges noted at a vertex, in the mesh's unit; 0 where nothing is known. Cost: O(1).
  [[nodiscard]] double at(VertexId vertex) const;

 private:
  struct Mean {
    double sum = 0, count = 0;
  };

  Mean& entry(VertexId vertex);

  ZeroedArray<Mean> means_;  // by vertex slot
};

}  // namespace v0
}  // namespace incise
