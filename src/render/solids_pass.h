// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "app/view/picture.h"
#include "incise/core/result.h"
#include "render/gl_object.h"
#include "render/mirrored_buffer.h"
#include "render/renderer.h"
#include "render/shadow_pass.h"
#include "render/solid_rows.h"
#include "render/view_matrices.h"

namespace incise {
inline namespace v0 {
namespace render {

/// Instruments, and what lies around the body.
class SolidsPass {
 public:
  static Result<SolidsPass> create();

  /// Makes the triangles of the instruments and uploads what changed.
  void upload(const app::Picture& picture, DrawStatistics& statistics);
  /// What is opaque; writes depth. `shadows`: null for none.
  void draw_opaque(const ViewMatrices& view, const ShadowPass* shadows) const;
  /// What is seen through: only its nearest triangles.
  void draw_ghosts(const ViewMatrices& view) const;
  /// Depths of what throws shadows: instruments, opaque or not.
  void draw_shadows() const;

  [[nodiscard]] bool is_empty() const { return rows_.corners().empty(); }

 private:
  void set_up();
  void use(const GlObject& program, const ViewMatrices& view) const;

  GlObject plain_, shadowed_;  // programs
  GlObject array_;
  MirroredBuffer buffer_;
  SolidRows rows_;
};

}  // namespace render
}  // namespace v0
}  // namespace incise
