// SPDX-License-Identifier: Apache-2.0
// Little more than the body and the tools: what a person sees first.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <vector>

#include "app/text/formatted.h"
#include "icons.h"
#include "panel_parts.h"

namespace incise_view {
namespace {

using namespace incise;
using app::Action;
using app::Viewer;

constexpr float kIconSide = 1.55F, kButtonSide = 2.35F;  // heights of text
constexpr float kCardWidth = 10.6F, kCardHeight = 2.9F, kCardIcon = 1.9F;
constexpr float kCompactWidth = 7.9F, kCompactHeight = 2.3F,
                kCompactIcon = 1.5F;  // of cards where there is little room
constexpr float kRowName = 5.2F;      // "Exercises", beside the cards
constexpr float kSmallText = 0.87F;
constexpr std::size_t kCardsInRow = 5;
constexpr float kTimeLine = 13;
constexpr double kInSkin = 7;  // mm of the ghost's scalpel, about
constexpr double kFew = 0.9;   // simulated seconds per second that still count as keeping up

/// A square with an icon. Returns whether it was pressed.
bool icon_button(const char* id, Icon icon, bool is_on, const std::string& told) {
  const float side = kButtonSide * em(), inner = kIconSide * em();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::PushStyleColor(ImGuiCol_Button, is_on ? ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive) : ImVec4(0, 0, 0, 0));
  const bool is_pressed = ImGui::Button(id, {side, side});
  ImGui::PopStyleColor();
  const float off = 0.5F * (side - inner);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  draw_icon(list, icon, {at.x + off, at.y + off}, inner, color_of(ImGuiCol_Text));
  if (is_on)
    list.AddRectFilled({at.x, at.y + 0.2F * side}, {at.x + 0.14F * em(), at.y + 0.8F * side}, color_of(ImGuiCol_Text));
  hint(told);
  return is_pressed;
}

void action_icon(Viewer& viewer, const PanelContext& context, Action action, Icon icon, bool is_on = false) {
  const std::string id = app::formatted("###action{}", static_cast<int>(action));
  if (icon_button(id.c_str(), icon, is_on, app::formatted("{}  ({})", text_of(action), app::key_of(action)))) {
    viewer.act(action, context.viewport);
  }
}

/// A hand for a tool that has no drawing of its own.
Icon icon_of(app::ToolKind tool) {
  const auto icon = static_cast<Icon>(tool);
  return icon <= Icon::kStaple ? icon : Icon::kHand;
}

void draw_tool_column(Viewer& viewer, const PanelContext& context) {
  if (begin_panel("tool icons", {0, 0}, 0, ImGui::GetMainViewport()->Size.y - 2 * kMargin * em())) {
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.15F * em(), 0.15F * em()});
    // Two columns where one is too long.
    const float needed = static_cast<float>(app::kToolCount + 2) * (kButtonSide + 0.15F) * em();
    const bool is_tall = needed < ImGui::GetMainViewport()->Size.y - 3 * kMargin * em();
    for (unsigned i = 0; i < app::kToolCount; ++i) {
      const auto tool = static_cast<app::ToolKind>(i);
      if (!is_tall && i % 2 == 1) ImGui::SameLine();
      action_icon(viewer, context, app::action_of(tool), icon_of(tool), viewer.tools().tool() == tool);
    }
    action_icon(viewer, context, Action::kResearch, Icon::kResearch);
    if (!is_tall) ImGui::SameLine();
    action_icon(viewer, context, Action::kHelp, Icon::kHelp, std::as_const(viewer).state().shows_help);
    ImGui::PopStyleVar();
  }
  const float right = ImGui::GetWindowPos().x + ImGui::GetWindowSize().x;
  ImGui::End();
  const app::ToolKind tool = viewer.tools().tool();
  ImGui::SetNextWindowPos({right + kMargin * em(), kMargin * em()});
  ImGui::SetNextWindowSize({13.5F * em(), 0});
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                                      ImGuiWindowFlags_NoNav;
  if (ImGui::Begin("chosen tool", nullptr, kFlags)) {
    text(app::name_of(tool));
    ImGui::SameLine();
    faint(app::formatted("({})", app::key_of(app::action_of(tool))));
    tool_settings(viewer);
  }
  ImGui::End();
}

/// What a card shows.
struct Card {
  Icon icon;
  std::string name, few;  // below it
  std::string told;       // where the pointer rests on it
  bool is_on;
};

/// How cards lie, by the room beside the tools.
struct CardLayout {
  float width = 0, height = 0, icon = 0;
  float name = 0;  // of a row, to its left; 0: none is written
  std::size_t columns = 1;

  [[nodiscard]] bool is_compact() const { return !(name > 0); }
};

CardLayout card_layout() {
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float room = ImGui::GetMainViewport()->Size.x - 2 * (kToolColumn + kMargin) * em() -
                     2 * ImGui::GetStyle().WindowPadding.x + gap;
  const auto columns = [&](float width) {
    return std::clamp(static_cast<std::size_t>(room / (width * em() + gap)), std::size_t{1}, kCardsInRow);
  };
  const bool is_wide = room >= kRowName * em() + kCardsInRow * (kCardWidth * em() + gap);
  if (is_wide) return {kCardWidth * em(), kCardHeight * em(), kCardIcon * em(), kRowName * em(), kCardsInRow};
  return {kCompactWidth * em(), kCompactHeight * em(), kCompactIcon * em(), 0, columns(kCompactWidth)};
}

/// Returns whether it was pressed.
bool draw_card(const char* id, const Card& card, const CardLayout& layout) {
  const ImVec2 at = ImGui::GetCursorScreenPos(), size(layout.width, layout.height);
  if (card.is_on) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
  const bool is_pressed = ImGui::Button(id, size);
  if (card.is_on) ImGui::PopStyleColor();
  hint(card.told);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float side = layout.icon, left = at.x + side + 0.8F * em();
  const ImU32 ink = color_of(ImGuiCol_Text);
  draw_icon(list, card.icon, {at.x + 0.4F * em(), at.y + 0.5F * (size.y - side)}, side, ink);
  list.AddText({left, at.y + (layout.is_compact() ? 0.5F * (size.y - em()) : 0.3F * em())}, ink, card.name.c_str());
  if (layout.is_compact()) return is_pressed;
  list.AddText(ImGui::GetFont(), kSmallText * em(), {left, at.y + 1.5F * em()}, color_of(ImGuiCol_Text, 0.8F),
               card.few.c_str());
  return is_pressed;
}

std::string capital(std::string word) {
  if (!word.empty() && word[0] >= 'a' && word[0] <= 'z') word[0] = static_cast<char>(word[0] - 'a' + 'A');
  return word;
}

/// Cards in a row, or in rows that are as long as the window is wide. Returns which one was pressed.
std::optional<std::size_t> draw_card_row(const char* name, const std::vector<Card>& cards) {
  const CardLayout layout = card_layout();
  const ImVec2 at = ImGui::GetCursorPos();
  if (!layout.is_compact()) {
    ImGui::SetCursorPosY(at.y + 0.5F * (layout.height - em()));
    faint(name);
    ImGui::SetCursorPosY(at.y);
  }
  std::optional<std::size_t> pressed;
  for (std::size_t i = 0; i < cards.size(); ++i) {
    const std::size_t column = i % layout.columns;
    if (column != 0) ImGui::SameLine();
    const float step = layout.width + ImGui::GetStyle().ItemSpacing.x;
    ImGui::SetCursorPosX(at.x + layout.name + static_cast<float>(column) * step);
    if (draw_card(app::formatted("###{}{}", name, i).c_str(), cards[i], layout)) pressed = i;
  }
  return pressed;
}

void draw_body_cards(Viewer& viewer, FileList& files) {
  std::vector<Card> cards;
  for (std::size_t i = 0; i < app::kStartingBodies.size(); ++i) {
    const app::StartingBodyRow& row = app::kStartingBodies[i];
    cards.push_back({static_cast<Icon>(static_cast<std::size_t>(Icon::kSkin) + i), capital(row.name), row.few, row.text,
                     viewer.view().title == row.text});
  }
  cards.push_back({Icon::kFolder, "Open...", "a file of yours", "A mesh, a scene or a recording of your own", false});
  const std::optional<std::size_t> pressed = draw_card_row("Bodies", cards);
  if (pressed && *pressed < app::kStartingBodies.size()) viewer.open(static_cast<app::StartingBody>(*pressed));
  if (pressed && *pressed == app::kStartingBodies.size()) files.open();
}

void draw_exercise_cards(Viewer& viewer) {
  std::vector<Card> cards;
  for (std::size_t i = 0; i < app::kStartingExercises.size(); ++i) {
    const app::StartingExerciseRow& row = app::kStartingExercises[i];
    cards.push_back({static_cast<Icon>(static_cast<std::size_t>(Icon::kStraightCut) + i), row.name, row.few, row.text,
                     viewer.view().title == row.title});
  }
  const std::optional<std::size_t> pressed = draw_card_row("Exercises", cards);
  if (pressed) viewer.open(static_cast<app::StartingExercise>(*pressed));
}

void draw_cards(Viewer& viewer, FileList& files) {
  const float screen = ImGui::GetMainViewport()->Size.y;
  if (begin_panel("bodies", {0.5F, 1 - kTimeBar * em() / screen}, 0, 0.6F * screen)) {
    draw_body_cards(viewer, files);
    draw_exercise_cards(viewer);
    if (const std::optional<std::filesystem::path> file = files.draw()) viewer.open(*file);
  }
  ImGui::End();
}

/// What was done so far, as dots on a line; of a recording that is played, where it stands.
void draw_time_line(const app::SessionView& view) {
  const ImVec2 at = ImGui::GetCursorScreenPos(), size(kTimeLine * em(), kButtonSide * em());
  ImGui::Dummy(size);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float middle = at.y + 0.5F * size.y;
  list.AddLine({at.x, middle}, {at.x + size.x, middle}, color_of(ImGuiCol_TextDisabled), 2);
  const double end = std::max(view.figures.seconds, 1e-3);
  std::string newest;
  for (const app::Operation& operation : *view.log) {
    const float x = at.x + size.x * static_cast<float>(std::clamp(operation.time / end, 0.0, 1.0));
    const bool is_cut = operation.kind == app::Operation::Kind::kStroke;
    list.AddCircleFilled({x, middle}, (is_cut ? 0.32F : 0.2F) * em(),
                         color_of(is_cut ? ImGuiCol_Text : ImGuiCol_TextDisabled));
    newest += app::formatted("{}{:.1f} s  {}", newest.empty() ? "" : "\n", operation.time, operation.text);
  }
  hint(newest.empty() ? "What you do is marked on this line" : newest);
}

void draw_time_bar(Viewer& viewer, const PanelContext& context, bool& shows_bodies) {
  const app::SessionView& view = viewer.view();
  if (begin_panel("time bar", {0.5F, 1}, 0, 2 * kTimeBar * em())) {
    action_icon(viewer, context, Action::kUndo, Icon::kUndo);
    ImGui::SameLine();
    action_icon(viewer, context, Action::kRedo, Icon::kRedo);
    ImGui::SameLine();
    action_icon(viewer, context, Action::kPause, view.is_paused ? Icon::kGo : Icon::kPause);
    ImGui::SameLine();
    if (view.is_replay) {
      // As high as the icons beside it.
      ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                          {ImGui::GetStyle().FramePadding.x, 0.5F * (kButtonSide - 1) * em()});
      replay_line(viewer, context);
      ImGui::PopStyleVar();
    } else {
      draw_time_line(view);
    }
    ImGui::SameLine();
    action_icon(viewer, context, Action::kReset, Icon::kRestart);
    ImGui::SameLine();
    action_icon(viewer, context, Action::kScreenshot, Icon::kPicture);
    ImGui::SameLine();
    if (icon_button("###other bodies", Icon::kBodies, shows_bodies, "Other bodies to cut, and exercises"))
      shows_bodies = !shows_bodies;
  }
  ImGui::End();
}

/// A dot and a few words on a rounded ground. Returns where its left edge is.
float pill(float right, const app::Color& light, const std::string& words, const std::string& told, const char* id) {
  const float pad = 0.7F * em(), height = 1.9F * em(), dot = 0.36F * em();
  const float width = ImGui::CalcTextSize(words.c_str()).x + 2 * pad + 1.1F * em();
  const ImVec2 at(right - width, kMargin * em());
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowSize({width, height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.5F * height);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                                      ImGuiWindowFlags_NoNav;
  if (ImGui::Begin(id, nullptr, kFlags)) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddCircleFilled({at.x + pad + dot, at.y + 0.5F * height}, dot, color_of(light));
    list.AddText({at.x + pad + 1.1F * em(), at.y + 0.5F * (height - em())}, color_of(ImGuiCol_Text), words.c_str());
    if (ImGui::IsWindowHovered()) ImGui::SetTooltip("%s", told.c_str());
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
  return at.x - 0.5F * em();
}

void draw_pills(const Viewer& viewer, const PanelContext& context) {
  constexpr app::Color kGrey = {150, 150, 150}, kYellow = {240, 228, 66}, kGreen = {0, 158, 115}, kRed = {213, 94, 0};
  const app::SessionView& view = viewer.view();
  float right = ImGui::GetMainViewport()->Size.x - kMargin * em();
  constexpr std::array<const char*, 4> kWords = {"Not checked yet", "Checking", "Sound mesh", "Broken mesh"};
  constexpr std::array<app::Color, 4> kLights = {kGrey, kYellow, kGreen, kRed};
  const auto state = static_cast<std::size_t>(view.validity.state);
  right = pill(right, kLights[state], kWords[state],
               "Whether the mesh can be simulated, checked after every stroke: " + view.validity.text, "validity pill");
  const bool keeps_up = view.real_time >= kFew;
  const std::string rate = view.is_paused ? "Paused"
                           : keeps_up     ? "Real time"
                                          : app::formatted("{:.0f} % of real time", 100 * view.real_time);
  const std::string told = app::formatted("{:.0f} pictures and {:.0f} steps of the simulation each second{}",
                                          viewer.hud().pictures_per_second(), view.steps_per_second,
                                          context.is_software ? "; the processor draws" : "");
  pill(right, view.is_paused ? kGrey : keeps_up ? kGreen : kYellow, rate, told, "rate pill");
}

/// One line in the upper middle: what happens, what was refused, or what to do next.
void draw_caption(const Viewer& viewer) {
  const app::SessionView& view = viewer.view();
  const std::string& notice = viewer.state().notice;
  const std::string_view next = viewer.next_step();
  const std::string line = !view.busy.empty() ? view.busy + "..." : !notice.empty() ? notice : std::string(next);
  if (line.empty()) return;
  const ImVec2 screen = ImGui::GetMainViewport()->Size;
  const float most = std::max(10 * em(), screen.x - 44 * em());
  const float wanted = std::min(ImGui::CalcTextSize(line.c_str()).x + 2 * ImGui::GetStyle().WindowPadding.x + 1, most);
  // Below the pills, which may be wide.
  ImGui::SetNextWindowPos({0.5F * screen.x, 3.1F * em()}, ImGuiCond_Always, {0.5F, 0});
  ImGui::SetNextWindowSize({wanted, 0});
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoInputs |
                                      ImGuiWindowFlags_NoNav;
  if (ImGui::Begin("caption", nullptr, kFlags)) {
    ImGui::PushTextWrapPos(0);
    text(line);
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
}

/// Beside the blade that nobody holds.
void draw_ghost_hand(const Viewer& viewer, const PanelContext& context) {
  if (!viewer.is_demonstrating()) return;
  for (const app::Instrument& instrument : viewer.view().marks.instruments) {
    if (!instrument.is_ghost) continue;
    if (instrument.kind != app::InstrumentKind::kScalpel) continue;
    const Vec3 on_skin = instrument.tip + kInSkin * instrument.millimetre * instrument.up;
    const std::optional<app::Vec2> at = to_pixel(viewer.picture().camera, context.viewport, on_skin);
    if (!at) continue;
    const float side = 2.6F * em();
    const ImVec2 finger(static_cast<float>(at->x()), static_cast<float>(at->y()));
    const ImVec2 corner(finger.x - 0.43F * side, finger.y - 0.12F * side);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddCircle(finger, 0.55F * em(), IM_COL32(255, 255, 255, 190), 24, 2);
    draw_icon(list, Icon::kHand, {corner.x + 1.5F, corner.y + 1.5F}, side, IM_COL32(0, 0, 0, 150));
    draw_icon(list, Icon::kHand, corner, side, IM_COL32(255, 255, 255, 230));
  }
}

}  // namespace

void FirstPanels::draw(Viewer& viewer, const PanelContext& context) {
  const app::SessionView& view = viewer.view();
  // The first cut of one's own: now the body is what matters.
  if (!viewer.is_demonstrating() && view.figures.strokes > strokes_) shows_bodies_ = false;
  strokes_ = view.figures.strokes;
  // An exercise says what to do where the cards would lie; they wait behind their button.
  const bool is_exercise = view.scene && view.scene->exercise;
  if (is_exercise && view.session != session_) shows_bodies_ = false;
  session_ = view.session;
  draw_ghost_hand(viewer, context);
  draw_tool_column(viewer, context);
  draw_pills(viewer, context);
  draw_time_bar(viewer, context, shows_bodies_);
  if (shows_bodies_) draw_cards(viewer, files_);
  draw_caption(viewer);
}

}  // namespace incise_view
