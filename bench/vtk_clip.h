// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "incise/geom/vec.h"
#include "incise/mesh/tet_soup.h"

namespace incise::bench {

/// VTK's `vtkTableBasedClipDataSet` on one mesh, as a peer: it clips without adjacency and repeats on request.
class VtkClip {
 public:
  explicit VtkClip(const TetSoup& soup);
  VtkClip(VtkClip&&) noexcept;
  ~VtkClip();

  /// Clips along n·x = d and returns the processor time in milliseconds. Each run starts from the input anew.
  /// @param keeps_both  also makes the part behind the plane (GenerateClippedOutput), as a cut does.
  double run_ms(const Vec3& normal, double offset, bool keeps_both);
  /// Cells of the last run's outputs, both together.
  [[nodiscard]] std::uint64_t output_cells() const;
  static std::string version();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace incise::bench
