// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/view/picture.h"
#include "incise/core/result.h"
#include "render/gl_object.h"

namespace incise {
inline namespace v0 {
namespace render {

/// What is behind everything: a quiet gradient from top to bottom.
class BackgroundPass {
 public:
  static Result<BackgroundPass> create();
  /// Covers all; leaves depth alone.
  void draw(app::Theme theme) const;

 private:
  GlObject program_, array_;
};

}  // namespace render
}  // namespace v0
}  // namespace incise
