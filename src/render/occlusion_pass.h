// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/core/result.h"
#include "render/canvas.h"
#include "render/gl_object.h"
#include "render/view_matrices.h"

namespace incise {
inline namespace v0 {
namespace render {

/// Darkens hollows of what was drawn, from its depth, at half the resolution.
///
/// **Source:** the estimator of McGuire, Mara and Luebke, Scalable Ambient Obscurance (2012). *Differs:* ten taps on a
/// spiral turned in a 4 × 4 pattern, and one blur of that size, which removes the pattern.
class OcclusionPass {
 public:
  static Result<OcclusionPass> create();

  /// Leaves the canvas bound. `is_tissue`: shadows are warm instead of neutral. Errors: kOutOfMemory, kInternal.
  Status draw(const Canvas& canvas, const ViewMatrices& view, bool is_tissue);

 private:
  Status fit(const app::Viewport& viewport);
  void use(const GlObject& program, const Canvas& canvas, const ViewMatrices& view, const GlObject* source) const;

  GlObject estimate_, blur_, apply_;  // programs
  GlObject array_;                    // without attributes
  GlObject estimated_, blurred_, estimated_target_, blurred_target_;
  app::Viewport half_{0, 0};
};

}  // namespace render
}  // namespace v0
}  // namespace incise
