// SPDX-License-Identifier: Apache-2.0
// Events are handed to Dear ImGui in steps, since it looks at the pointer once a frame; fonts are made anew where
// their size changes.
#include "interface.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <filesystem>
#include <variant>

namespace incise_view {
namespace {

using namespace incise;

constexpr float kTextPixels = 15;
constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

void use_theme(app::Theme theme) {
  ImGuiStyle style;  // anew each time: scaling it twice would scale twice
  if (theme == app::Theme::kDark) {
    ImGui::StyleColorsDark(&style);
    style.Colors[ImGuiCol_WindowBg] = {0.09F, 0.10F, 0.12F, 0.88F};
    style.Colors[ImGuiCol_Text] = {0.93F, 0.93F, 0.93F, 1};
    style.Colors[ImGuiCol_TextDisabled] = {0.68F, 0.70F, 0.73F, 1};
  } else {
    ImGui::StyleColorsLight(&style);
    style.Colors[ImGuiCol_WindowBg] = {0.98F, 0.98F, 0.98F, 0.90F};
    style.Colors[ImGuiCol_Text] = {0.08F, 0.08F, 0.10F, 1};
    style.Colors[ImGuiCol_TextDisabled] = {0.34F, 0.35F, 0.38F, 1};
  }
  style.Colors[ImGuiCol_PlotHistogram] = style.Colors[ImGuiCol_ButtonActive];  // text is written on bars
  style.WindowRounding = 6;
  style.FrameRounding = 4;
  style.GrabRounding = 4;
  style.WindowBorderSize = 0;
  style.WindowPadding = {10, 9};
  style.ItemSpacing = {7, 5};
  ImGui::GetStyle() = style;
}

}  // namespace

Interface::Interface(const Window& window) : window_(window) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // leaves no file behind
  // The cursor is the application's, and so are the events, which come in steps: GLFW's state would be that at the end.
  ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
  ImGui_ImplGlfw_InitForOpenGL(window.handle(), false);
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

Interface::~Interface() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Interface::make_fonts(float pixels) {
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  if (std::filesystem::exists(kFont)) {
    io.Fonts->AddFontFromFileTTF(kFont, pixels);
  } else {
    ImFontConfig config;  // the font that Dear ImGui brings along, made for 13 pixels
    config.SizePixels = std::max(13.0F, 13 * std::round(pixels / kTextPixels));
    io.Fonts->AddFontDefault(&config);
  }
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
  font_pixels_ = pixels;
}

void Interface::take(const app::PointerEvent& event) {
  using Kind = app::PointerEvent::Kind;
  pixel_ = event.pixel;
  is_outside_ = false;
  const bool is_button = event.kind == Kind::kPress || event.kind == Kind::kRelease;
  if (is_button) is_down_[static_cast<std::size_t>(event.button)] = event.kind == Kind::kPress;
  if (event.kind == Kind::kWheel) ImGui::GetIO().MouseWheel += static_cast<float>(event.wheel);
}
/// A drag goes on beyond the rim.
void Interface::take(const app::PointerLeft& /*event*/) {
  is_outside_ = std::find(is_down_.begin(), is_down_.end(), true) == is_down_.end();
}
void Interface::take(const app::KeyChange& change) {
  ImGui_ImplGlfw_KeyCallback(window_.handle(), change.key, change.scan_code, change.action, change.modifiers);
}
void Interface::take(const app::TypedCharacter& character) {
  ImGui_ImplGlfw_CharCallback(window_.handle(), character.code);
}
void Interface::take(const app::DroppedFile& /*file*/) {}

void Interface::show_pointer() const {
  ImGuiIO& io = ImGui::GetIO();
  const ImVec2& scale = io.DisplayFramebufferScale;
  io.MousePos = is_outside_
                    ? ImVec2(-FLT_MAX, -FLT_MAX)
                    : ImVec2(static_cast<float>(pixel_.x()) / scale.x, static_cast<float>(pixel_.y()) / scale.y);
  std::fill(std::begin(io.MouseDown), std::end(io.MouseDown), false);
  std::copy(is_down_.begin(), is_down_.end(), std::begin(io.MouseDown));
}

void Interface::begin(app::Theme theme, double text_scale, std::span<const app::InputEvent> step) {
  const float pixels = std::round(kTextPixels * static_cast<float>(text_scale * window_.density()));
  if (pixels != font_pixels_) make_fonts(pixels);
  use_theme(theme);
  ImGui::GetStyle().ScaleAllSizes(pixels / kTextPixels);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  for (const app::InputEvent& event : step) std::visit([this](const auto& one) { take(one); }, event);
  show_pointer();
  ImGui::NewFrame();
}

void Interface::draw() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Interface::skip() {
  ImGui::EndFrame();
}

bool Interface::wants_pointer() const {
  return ImGui::GetIO().WantCaptureMouse;
}
bool Interface::wants_keys() const {
  return ImGui::GetIO().WantTextInput;
}

}  // namespace incise_view
