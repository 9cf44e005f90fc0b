// SPDX-License-Identifier: Apache-2.0
// Dear ImGui on a window: its context, its fonts, its two themes.
#pragma once

#include <array>
#include <span>

#include "app/view/picture.h"
#include "app/viewer/input_steps.h"
#include "window.h"

namespace incise_view {

class Interface {
 public:
  explicit Interface(const Window& window);
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;
  ~Interface();

  /// Begins a frame in which panels see one step of what the person did (`incise::app::step_length`). `text_scale` is
  /// the person's; the screen's density comes on top.
  void begin(incise::app::Theme theme, double text_scale, std::span<const incise::app::InputEvent> step);
  /// Ends it and draws it into the current framebuffer.
  void draw();
  /// Ends it without drawing.
  void skip();
  /// Whether a panel is under the pointer, or a drag began on one: such events are not the picture's.
  [[nodiscard]] bool wants_pointer() const;
  [[nodiscard]] bool wants_keys() const;

 private:
  void make_fonts(float pixels);
  void take(const incise::app::PointerEvent& event);
  void take(const incise::app::PointerLeft& event);
  void take(const incise::app::KeyChange& change);
  void take(const incise::app::TypedCharacter& character);
  void take(const incise::app::DroppedFile& file);
  void show_pointer() const;

  const Window& window_;
  float font_pixels_ = 0;
  incise::app::Vec2 pixel_ = incise::app::Vec2::Zero();  // of the pointer
  bool is_outside_ = true;                               // of the window
  std::array<bool, 3> is_down_{};                        // buttons, in the order of `PointerEvent::Button`
};

}  // namespace incise_view
