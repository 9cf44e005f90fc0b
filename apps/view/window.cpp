// SPDX-License-Identifier: Apache-2.0
// GLFW's callbacks become events in a list, with places in pixels of the framebuffer; keys go by what the person's
// layout prints on them.
#include "window.h"

#include <epoxy/gl.h>
// After epoxy, which brings OpenGL's names.
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace incise_view {
namespace {

using namespace incise;
using app::InputEvent;
using app::KeyPress;
using app::PointerEvent;

constexpr int kFirstPrintable = 33, kLastPrintable = 96;  // GLFW's codes of these keys are ASCII

Error no_display() {
  const char* why = nullptr;
  glfwGetError(&why);
  return {ErrorCode::kUnsupported,
          std::string("no window can be opened: ") + (why != nullptr ? why : "no display") +
              "; run it where DISPLAY leads to a screen with OpenGL 3.3, or make pictures with --headless --screenshot "
              "OUT.png",
          {}};
}

/// Keys without a character, by their names in `KeyPress`.
const char* special_name(int key) {
  static const std::map<int, const char*> kNames = {
      {GLFW_KEY_SPACE, "Space"},    {GLFW_KEY_ESCAPE, "Escape"}, {GLFW_KEY_ENTER, "Enter"},
      {GLFW_KEY_KP_ENTER, "Enter"}, {GLFW_KEY_LEFT, "Left"},     {GLFW_KEY_RIGHT, "Right"},
      {GLFW_KEY_UP, "Up"},          {GLFW_KEY_DOWN, "Down"},     {GLFW_KEY_HOME, "Home"},
      {GLFW_KEY_PAGE_UP, "PageUp"}, {GLFW_KEY_F1, "F1"},         {GLFW_KEY_PAGE_DOWN, "PageDown"},
      {GLFW_KEY_F11, "F11"},        {GLFW_KEY_KP_ADD, "+"},      {GLFW_KEY_KP_SUBTRACT, "-"},
      {GLFW_KEY_KP_DECIMAL, "."},   {GLFW_KEY_TAB, "Tab"},
  };
  const auto found = kNames.find(key);
  return found == kNames.end() ? nullptr : found->second;
}

/// What is printed on the key, by the person's layout; empty where nothing is.
std::string printed_name(int key, int scancode) {
  const char* name = glfwGetKeyName(key, scancode);
  std::string text = name != nullptr && name[0] != '\0' && name[1] == '\0' ? name : "";
  if (text.empty() && key >= kFirstPrintable && key <= kLastPrintable) text = std::string(1, static_cast<char>(key));
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// `KeyPress` keeps a view: the names of keys stay for good.
std::string_view kept(const std::string& name) {
  static std::map<std::string, std::string> names;
  return names.emplace(name, name).first->second;
}

/// A ring with a bar across, white around black: GLFW 3.3 has none of its own.
GLFWcursor* make_barred_cursor() {
  constexpr int kSide = 24;
  constexpr double kMiddle = 11.5, kRadius = 8, kInk = 1.2, kCasing = 2.4;
  std::vector<unsigned char> pixels(std::size_t{4} * kSide * kSide, 0);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double from_middle = std::hypot(x - kMiddle, y - kMiddle);
      const double from_bar = from_middle < kRadius ? std::abs(x - y) / std::sqrt(2.0) : kSide;
      const double away = std::min(std::abs(from_middle - kRadius), from_bar);
      if (away > kCasing) continue;
      unsigned char* pixel = &pixels[4 * static_cast<std::size_t>(y * kSide + x)];
      pixel[0] = pixel[1] = pixel[2] = away <= kInk ? 20 : 255;
      pixel[3] = 255;
    }
  }
  const GLFWimage image{kSide, kSide, pixels.data()};
  return glfwCreateCursor(&image, kSide / 2, kSide / 2);
}

std::optional<KeyPress> press_of(int key, int scancode, int mods) {
  KeyPress press;
  press.control = (mods & GLFW_MOD_CONTROL) != 0;
  press.shift = (mods & GLFW_MOD_SHIFT) != 0;
  if ((mods & (GLFW_MOD_ALT | GLFW_MOD_SUPER)) != 0) return std::nullopt;
  if (const char* special = special_name(key)) {
    press.key = special;
    return press;
  }
  const std::string name = printed_name(key, scancode);
  if (name.empty()) return std::nullopt;
  press.key = kept(name == "=" && press.shift ? "+" : name);
  if (press.key == "+") press.shift = false;
  return press;
}

}  // namespace

struct Window::State {
  GLFWwindow* window = nullptr;
  std::vector<InputEvent> events;
  // Of the pointer, as its last event had it: asked for, it is where the pointer has got to meanwhile, and a window
  // that is late would take a whole drag for a click at its end.
  std::array<double, 2> place{};
  std::array<int, 4> before_full{};  // place and size
  bool is_full = false;
  std::optional<app::Cursor> cursor;     // that is shown; at first whatever the system has
  std::array<GLFWcursor*, 4> cursors{};  // by `app::Cursor`; null: not made yet

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    for (GLFWcursor* one : cursors) {
      if (one != nullptr) glfwDestroyCursor(one);
    }
    if (window != nullptr) glfwDestroyWindow(window);
    glfwTerminate();
  }

  void listen();
  [[nodiscard]] PointerEvent pointer(PointerEvent::Kind kind, int mods) const;
  [[nodiscard]] int held() const;
  [[nodiscard]] bool is_down(int key) const { return glfwGetKey(window, key) == GLFW_PRESS; }

  static State& of(GLFWwindow* window) { return *static_cast<State*>(glfwGetWindowUserPointer(window)); }
  static void on_move(GLFWwindow* window, double x, double y);
  static void on_button(GLFWwindow* window, int button, int action, int mods);
  static void on_wheel(GLFWwindow* window, double x, double y);
  static void on_key(GLFWwindow* window, int key, int scancode, int action, int mods);
  static void on_character(GLFWwindow* window, unsigned code);
  static void on_enter(GLFWwindow* window, int is_inside);
  static void on_drop(GLFWwindow* window, int count, const char** paths);
};

void Window::State::listen() {
  glfwSetWindowUserPointer(window, this);
  glfwSetCursorPosCallback(window, on_move);
  glfwSetMouseButtonCallback(window, on_button);
  glfwSetScrollCallback(window, on_wheel);
  glfwSetKeyCallback(window, on_key);
  glfwSetCharCallback(window, on_character);
  glfwSetCursorEnterCallback(window, on_enter);
  glfwSetDropCallback(window, on_drop);
}

int Window::State::held() const {
  int mods = 0;
  if (is_down(GLFW_KEY_LEFT_SHIFT) || is_down(GLFW_KEY_RIGHT_SHIFT)) mods |= GLFW_MOD_SHIFT;
  if (is_down(GLFW_KEY_LEFT_CONTROL) || is_down(GLFW_KEY_RIGHT_CONTROL)) mods |= GLFW_MOD_CONTROL;
  if (is_down(GLFW_KEY_LEFT_ALT) || is_down(GLFW_KEY_RIGHT_ALT)) mods |= GLFW_MOD_ALT;
  return mods;
}

PointerEvent Window::State::pointer(PointerEvent::Kind kind, int mods) const {
  int width = 0, height = 0, pixel_width = 0, pixel_height = 0;
  glfwGetWindowSize(window, &width, &height);
  glfwGetFramebufferSize(window, &pixel_width, &pixel_height);
  PointerEvent event;
  event.kind = kind;
  event.pixel = {place[0] * pixel_width / std::max(width, 1), place[1] * pixel_height / std::max(height, 1)};
  event.shift = (mods & GLFW_MOD_SHIFT) != 0;
  event.control = (mods & GLFW_MOD_CONTROL) != 0;
  event.alt = (mods & GLFW_MOD_ALT) != 0;
  return event;
}

void Window::State::on_move(GLFWwindow* window, double x, double y) {
  State& s = of(window);
  s.place = {x, y};
  s.events.emplace_back(s.pointer(PointerEvent::Kind::kMove, s.held()));
}

void Window::State::on_button(GLFWwindow* window, int button, int action, int mods) {
  if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
  State& s = of(window);
  const bool is_press = action == GLFW_PRESS;
  PointerEvent event = s.pointer(is_press ? PointerEvent::Kind::kPress : PointerEvent::Kind::kRelease, mods);
  event.button = static_cast<PointerEvent::Button>(button);  // GLFW's order: left, right, middle
  s.events.emplace_back(event);
}

void Window::State::on_wheel(GLFWwindow* window, double x, double y) {
  State& s = of(window);
  PointerEvent event = s.pointer(PointerEvent::Kind::kWheel, s.held());
  event.wheel = y != 0 ? y : x;  // with Shift some systems turn the wheel sideways
  s.events.emplace_back(event);
}

void Window::State::on_key(GLFWwindow* window, int key, int scancode, int action, int mods) {
  app::KeyChange change{key, scancode, action, mods, {}};
  if (action != GLFW_RELEASE) change.press = press_of(key, scancode, mods);
  of(window).events.emplace_back(change);
}

void Window::State::on_character(GLFWwindow* window, unsigned code) {
  of(window).events.emplace_back(app::TypedCharacter{code});
}

void Window::State::on_enter(GLFWwindow* window, int is_inside) {
  if (is_inside == 0) of(window).events.emplace_back(app::PointerLeft{});
}

void Window::State::on_drop(GLFWwindow* window, int count, const char** paths) {
  for (int i = 0; i < count; ++i) of(window).events.emplace_back(app::DroppedFile{paths[i]});
}

Result<Window> Window::open(const std::string& title, const app::Viewport& size, unsigned samples) {
  if (glfwInit() != GLFW_TRUE) return no_display();
  auto state = std::make_unique<State>();  // from here on it ends GLFW
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
  glfwWindowHint(GLFW_SAMPLES, static_cast<int>(samples));
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  state->window = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
  if (state->window == nullptr) {
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_NO_ROBUSTNESS);  // some drivers know none
    state->window = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
  }
  if (state->window == nullptr) return no_display();
  glfwMakeContextCurrent(state->window);
  glfwSwapInterval(1);
  glfwGetCursorPos(state->window, &state->place[0], &state->place[1]);
  state->listen();
  return Window(std::move(state));
}

Window::Window(std::unique_ptr<State> state) : state_(std::move(state)) {}
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;
Window::~Window() = default;

void Window::wait(double seconds) {
  glfwWaitEventsTimeout(seconds);
}
bool Window::should_close() const {
  return glfwWindowShouldClose(state_->window) != 0;
}
void Window::ask_to_close(bool closes) {
  glfwSetWindowShouldClose(state_->window, closes ? GLFW_TRUE : GLFW_FALSE);
}
std::vector<InputEvent> Window::take_events() {
  return std::exchange(state_->events, {});
}

app::Viewport Window::viewport() const {
  app::Viewport viewport;
  glfwGetFramebufferSize(state_->window, &viewport.width, &viewport.height);
  return {std::max(viewport.width, 1), std::max(viewport.height, 1)};
}

double Window::density() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(state_->window, &x, &y);
  return std::max(static_cast<double>(std::max(x, y)), 1.0);
}

void Window::show_title(const std::string& title) {
  glfwSetWindowTitle(state_->window, title.c_str());
}

void Window::set_full_screen(bool is_full) {
  State& s = *state_;
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  if (is_full == s.is_full || monitor == nullptr) return;
  s.is_full = is_full;
  auto& [x, y, width, height] = s.before_full;
  if (is_full) {
    const GLFWvidmode* mode = glfwGetVideoMode(monitor);
    glfwGetWindowPos(s.window, &x, &y);
    glfwGetWindowSize(s.window, &width, &height);
    glfwSetWindowMonitor(s.window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
  } else {
    glfwSetWindowMonitor(s.window, nullptr, x, y, width, height, 0);
  }
}

void Window::show_cursor(app::Cursor cursor) {
  State& s = *state_;
  if (s.cursor == cursor) return;
  s.cursor = cursor;
  GLFWcursor*& made = s.cursors[static_cast<std::size_t>(cursor)];
  if (made == nullptr && cursor == app::Cursor::kArrow) made = glfwCreateStandardCursor(GLFW_ARROW_CURSOR);
  if (made == nullptr && cursor == app::Cursor::kCross) made = glfwCreateStandardCursor(GLFW_CROSSHAIR_CURSOR);
  if (made == nullptr && cursor == app::Cursor::kHand) made = glfwCreateStandardCursor(GLFW_HAND_CURSOR);
  if (made == nullptr && cursor == app::Cursor::kBarred) made = make_barred_cursor();
  glfwSetCursor(s.window, made);
}

void Window::swap() {
  glfwSwapBuffers(state_->window);
}

bool Window::is_lost() const {
  const bool can_tell = epoxy_has_gl_extension("GL_ARB_robustness");
  return can_tell && glGetGraphicsResetStatusARB() != GL_NO_ERROR;
}

std::string Window::renderer_name() const {
  const GLubyte* name = glGetString(GL_RENDERER);
  return name != nullptr ? reinterpret_cast<const char*>(name) : "";
}

GLFWwindow* Window::handle() const {
  return state_->window;
}

}  // namespace incise_view
