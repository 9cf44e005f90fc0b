// SPDX-License-Identifier: Apache-2.0
// What panels are made of.
#pragma once

#include <imgui.h>

#include <string>
#include <string_view>

#include "app/view/color_map.h"
#include "app/viewer/viewer.h"
#include "file_list.h"
#include "panels.h"

namespace incise_view {

inline constexpr float kMargin = 0.6F;      // around panels, in heights of text
inline constexpr float kToolColumn = 4.3F;  // icons of tools, and the way to what is beside them, likewise
inline constexpr float kTimeBar = 4.6F;     // with what lies above it, likewise

/// The height of text, which all sizes go by.
[[nodiscard]] float em();
void text(const std::string& line);
void faint(const std::string& line);
[[nodiscard]] ImU32 color_of(ImGuiCol name, float opacity = 1);
[[nodiscard]] ImU32 color_of(const incise::app::Color& c);
void heading(const char* name);
/// Of the item before, where the pointer rests on it.
void hint(const std::string& line);
[[nodiscard]] std::string_view text_of(incise::app::Action action);
/// A window at a corner or an edge of the picture: `at` and `pivot` as shares of it and of the panel. Call
/// `ImGui::End`.
bool begin_panel(const char* name, const ImVec2& at, float width, float most_height);
/// The same where `pivot` of the panel is at a place of the picture.
bool begin_panel_at(const char* name, const ImVec2& place, const ImVec2& pivot, float width, float most_height);
/// The chosen tool's settings, over the width that there is. Returns whether it has any.
bool tool_settings(incise::app::Viewer& viewer);
/// Winds a recording on.
void replay_line(incise::app::Viewer& viewer, const PanelContext& context);
/// A button that does what a key does, and names the key.
void action_button(incise::app::Viewer& viewer, const PanelContext& context, incise::app::Action action,
                   const char* label, bool is_on, float width = 0);

/// What the first minute shows: tools, time, bodies to choose from, two lights, and one line of advice.
class FirstPanels {
 public:
  void draw(incise::app::Viewer& viewer, const PanelContext& context);
  /// Whether cards of bodies and exercises lie where an exercise says what to do.
  [[nodiscard]] bool shows_cards() const { return shows_bodies_; }

 private:
  FileList files_;
  bool shows_bodies_ = true;
  std::uint64_t strokes_ = 0, session_ = 0;  // when it was last drawn
};
/// Every figure.
void draw_research_panels(incise::app::Viewer& viewer, const PanelContext& context);

}  // namespace incise_view
