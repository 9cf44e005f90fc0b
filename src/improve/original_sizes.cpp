// SPDX-License-Identifier: Apache-2.0
// The sizes of elements as they were before any cut: a mean per vertex, handed on to the vertices that cuts make.
#include "improve/original_sizes.h"

namespace incise {
inline namespace v0 {

OriginalSizes::Mean& OriginalSizes::entry(VertexId vertex) {
  means_.ensure(std::size_t{vertex.value} + 1);
  return means_[vertex.value];
}

void OriginalSizes::note_edge(VertexId a, VertexId b, double length) {
  for (const VertexId v : {a, b}) {
    Mean& mean = entry(v);
    mean.sum += length;
    mean.count += 1;
  }
}

void OriginalSizes::follow(const Step& step) {
  for (const BornVertex& born : step.born) {
    double sum = 0, weight = 0;
    for (std::size_t i = 0; i < born.parents.size(); ++i) {
      const double size = born.parents[i].is_valid() && born.weights[i] > 0 ? at(born.parents[i]) : 0.0;
      if (size == 0) continue;
      sum += born.weights[i] * size;
      weight += born.weights[i];
    }
    entry(born.id) = {sum, weight};
  }
  for (const CopiedVertex& copied : step.copied) entry(copied.id) = {at(copied.source), 1.0};
}

double OriginalSizes::at(VertexId vertex) const {
  if (vertex.value >= means_.capacity()) return 0.0;
  const Mean& mean = means_[vertex.value];
  return mean.count > 0 ? mean.sum / mean.count : 0.0;
}

}  // namespace v0
}  // namespace incise
