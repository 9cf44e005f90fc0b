// SPDX-License-Identifier: Apache-2.0
// Dear ImGui on a window: its context, its fonts, its two themes.
#pragma once

#include "app/view/picture.h"
#include "window.h"

namespace incise_view {

class Interface {
 public:
  explicit Interface(const Window& window);
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;
  ~Interface();

  /// Begins a frame. `text_scale` is the person's; the screen's density comes on top.
  void begin(incise::app::Theme theme, double text_scale);
  /// Ends it and draws it into the current framebuffer.
  void draw();
  /// Ends it without drawing.
  void skip();
  /// Whether a panel is under the pointer, or a drag began on one: such events are not the picture's.
  [[nodiscard]] bool wants_pointer() const;
  [[nodiscard]] bool wants_keys() const;

 private:
  void make_fonts(float pixels);

  const Window& window_;
  float font_pixels_ = 0;
};

}  // namespace incise_view
