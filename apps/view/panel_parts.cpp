// SPDX-License-Identifier: Apache-2.0
// Sizes in heights of text, so that panels grow with it; buttons take their hints from the table of keys.
#include "panel_parts.h"

#include <algorithm>
#include <numbers>

#include "app/text/formatted.h"

namespace incise_view {

using namespace incise;
using app::Action;
using app::Viewer;

namespace {

constexpr ImGuiWindowFlags kPanel = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;

}  // namespace

float em() {
  return ImGui::GetFontSize();
}
void text(const std::string& line) {
  ImGui::TextUnformatted(line.c_str());
}
void faint(const std::string& line) {
  ImGui::TextDisabled("%s", line.c_str());
}
ImU32 color_of(ImGuiCol name, float opacity) {
  return ImGui::GetColorU32(name, opacity);
}
ImU32 color_of(const app::Color& c) {
  return IM_COL32(c[0], c[1], c[2], 255);
}

void heading(const char* name) {
  ImGui::Spacing();
  faint(name);
}

bool begin_panel(const char* name, const ImVec2& at, float width, float most_height) {
  const ImVec2 screen = ImGui::GetMainViewport()->Size;
  const float margin = kMargin * em();
  const ImVec2 place(margin + at.x * (screen.x - 2 * margin), margin + at.y * (screen.y - 2 * margin));
  return begin_panel_at(name, place, at, width, most_height);
}

bool begin_panel_at(const char* name, const ImVec2& place, const ImVec2& pivot, float width, float most_height) {
  const float most_width = ImGui::GetMainViewport()->Size.x - 2 * kMargin * em();
  ImGui::SetNextWindowPos(place, ImGuiCond_Always, pivot);
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width > 0 ? width : most_width, most_height});
  return ImGui::Begin(name, nullptr, kPanel | ImGuiWindowFlags_AlwaysAutoResize);
}

void hint(const std::string& line) {
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", line.c_str());
}

std::string_view text_of(Action action) {
  for (const app::KeyBinding& binding : app::key_bindings()) {
    if (binding.action == action) return binding.text;
  }
  return {};
}

void action_button(Viewer& viewer, const PanelContext& context, Action action, const char* label, bool is_on,
                   float width) {
  if (is_on) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
  const std::string caption = app::formatted("{}{}###{}", is_on ? "> " : "", label, label);  // not by colour alone
  if (ImGui::Button(caption.c_str(), {width, 0})) viewer.act(action, context.viewport);
  if (is_on) ImGui::PopStyleColor();
  hint(app::formatted("{}  ({})", text_of(action), app::key_of(action)));
}

bool tool_settings(Viewer& viewer) {
  app::ToolSettings settings = viewer.tools().settings();
  const double unit = viewer.view().scene ? 1e3 * viewer.view().scene->options.body.length_unit : 1;  // mm
  bool has_changed = false, has_any = false;
  ImGui::PushItemWidth(-1);
  const unsigned turned = app::row_of(viewer.tools().tool()).settings;
  const auto length = [&](const char* name, const char* format, double& value) {
    has_any = true;
    auto shown = static_cast<float>(value * unit);
    if (!ImGui::DragFloat(name, &shown, 0.02F * shown, 1e-3F, 1e4F, format)) return;
    value = static_cast<double>(shown) / unit;
    has_changed = true;
  };
  if ((turned & app::tool_setting::kDepth) != 0) {
    length("##depth", "Depth %.1f mm", settings.depth);
    hint("Drag, or Ctrl+wheel over the picture");
  }
  if ((turned & app::tool_setting::kRing) != 0) length("##ring", "Ring %.1f mm", settings.punch_radius);
  if ((turned & app::tool_setting::kAngle) != 0) {
    auto angle = static_cast<float>(settings.angle * 180 / std::numbers::pi);
    if (ImGui::DragFloat("##angle", &angle, 0.5F, -68, 68, "Angle %.0f deg")) {
      settings.angle = static_cast<double>(angle) * std::numbers::pi / 180;
      has_changed = true;
    }
    hint("Drag, or Shift+wheel over the picture");
  }
  if ((turned & app::tool_setting::kGrip) != 0) length("##radius", "Grip %.1f mm", settings.grasp_radius);
  ImGui::PopItemWidth();
  if (has_changed) viewer.tools().set(settings);
  return has_any;
}

void replay_line(Viewer& viewer, const PanelContext& context) {
  const app::SessionView& view = viewer.view();
  auto call = static_cast<int>(view.place.call);
  ImGui::SetNextItemWidth(18 * em());
  const std::string format = app::formatted("%d of {}", view.place.calls);
  if (ImGui::SliderInt("##place", &call, 0, static_cast<int>(view.place.calls), format.c_str())) {
    viewer.session().seek(static_cast<std::uint64_t>(std::max(call, 0)));
  }
  ImGui::SameLine();
  action_button(viewer, context, Action::kNextStep, "Next step", false);
  ImGui::SameLine();
  action_button(viewer, context, Action::kTakeOver, "Take over", false);
}

}  // namespace incise_view
