// SPDX-License-Identifier: Apache-2.0
// A window with an OpenGL 3.3 context, and what happens to it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/view/camera.h"
#include "app/viewer/input_steps.h"
#include "app/viewer/viewer.h"
#include "incise/core/result.h"

struct GLFWwindow;

namespace incise_view {

class Window {
 public:
  /// Opens it and makes its context current. Errors: kUnsupported without a display or OpenGL 3.3, with a remedy.
  static incise::Result<Window> open(const std::string& title, const incise::app::Viewport& size, unsigned samples);
  Window(Window&&) noexcept;
  Window& operator=(Window&&) noexcept;
  ~Window();

  /// Waits for something to happen, at most for the given seconds.
  void wait(double seconds);
  [[nodiscard]] bool should_close() const;
  void ask_to_close(bool closes);
  /// What happened since, in order; pixels are those of `viewport`.
  [[nodiscard]] std::vector<incise::app::InputEvent> take_events();
  /// In pixels of the screen. At least 1 × 1.
  [[nodiscard]] incise::app::Viewport viewport() const;
  /// Pixels per pixel of an ordinary screen: 2 on many high-density ones.
  [[nodiscard]] double density() const;
  void show_title(const std::string& title);
  void set_full_screen(bool is_full);
  void show_cursor(incise::app::Cursor cursor);
  void swap();
  /// Whether the context is gone, as after a reset of the graphics processor.
  [[nodiscard]] bool is_lost() const;
  [[nodiscard]] std::string renderer_name() const;
  [[nodiscard]] GLFWwindow* handle() const;

 private:
  struct State;
  explicit Window(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace incise_view
