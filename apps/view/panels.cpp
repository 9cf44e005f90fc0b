// SPDX-License-Identifier: Apache-2.0
// Panels in the order in which they stand on the screen. They keep no state of the body: figures are read from the
// view, wishes go to the viewer.
#include "panels.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "app/text/formatted.h"
#include "app/view/color_map.h"
#include "panel_parts.h"
#include "render/ink_style.h"

namespace incise_view {

using namespace incise;
using app::Action;
using app::Viewer;

namespace {

// All in heights of text.
constexpr float kToolsWidth = 13.5F, kFiguresWidth = 19;  // of the panels
constexpr float kHistogramHeight = 4.2F, kForceHeight = 3.2F, kLegendHeight = 0.8F;
constexpr float kTimeHalfWidth = 15.5F, kTimeHeight = 11;
constexpr float kBarHalfWidth = 16.2F, kReplayHalfWidth = 24;  // of the bar of time without Research
constexpr float kReplayHigher = 0.8F;                          // that bar, where a recording is played
constexpr float kExerciseWidth = 25, kNarrowExerciseWidth = 20.5F;
constexpr float kProbeWidth = 20.5F, kLeastWidth = 15;  // of the probe's panel, and of what is beside research's tools
constexpr int kLogLines = 5;

void tool_buttons(Viewer& viewer, const PanelContext& context) {
  heading("Tools");
  for (unsigned i = 0; i < static_cast<unsigned>(app::ToolKind::kCount); ++i) {
    const auto tool = static_cast<app::ToolKind>(i);
    const Action action = app::action_of(tool);
    const std::string label = app::formatted("{} {}", app::key_of(action), app::name_of(tool));
    const float half = 0.5F * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
    if (i % 2 == 1) ImGui::SameLine();
    action_button(viewer, context, action, label.c_str(), viewer.tools().tool() == tool, half);
  }
}

const char* name_of(app::ColorBy color) {
  constexpr std::array<const char*, 5> kNames = {"Tissue", "Region", "Stroke", "Quality", "Defects"};
  return kNames[static_cast<std::size_t>(color)];
}

void view_buttons(Viewer& viewer, const PanelContext& context) {
  const app::ViewerState& state = std::as_const(viewer).state();
  const app::ViewOptions& view = state.options;
  heading("View");
  const float half = 0.5F * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
  action_button(viewer, context, Action::kWireframe, "Edges", view.shows_wireframe, half);
  ImGui::SameLine();
  action_button(viewer, context, Action::kClipPlane, "Clip", state.is_clipped, half);
  action_button(viewer, context, Action::kTransparency, "See in", view.skin_opacity < 1, half);
  ImGui::SameLine();
  action_button(viewer, context, Action::kWorstTets, "Worst", state.shows_worst, half);
  action_button(viewer, context, Action::kOcclusion, "Shade", view.shows_occlusion, half);
  ImGui::SameLine();
  action_button(viewer, context, Action::kTheme, view.theme == app::Theme::kDark ? "Light" : "Dark", false, half);
  const std::string color = app::formatted("Colour: {}", name_of(view.color));
  if (ImGui::Button((color + "###color").c_str(), {-1, 0})) viewer.act(Action::kColor, context.viewport);
  hint(app::formatted("{}  ({})", text_of(Action::kColor), app::key_of(Action::kColor)));
  if (!state.is_clipped) return;
  auto depth = static_cast<float>(state.clip_depth);
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::SliderFloat("##clip", &depth, 0, 1, "Clip at %.2f")) return;
  viewer.set_clip_depth(static_cast<double>(depth));
}

void draw_tools(Viewer& viewer, const PanelContext& context) {
  const float screen = ImGui::GetMainViewport()->Size.y;
  if (begin_panel("tools", {0, 0}, kToolsWidth * em(), screen - 2 * kMargin * em())) {
    tool_buttons(viewer, context);
    tool_settings(viewer);
    view_buttons(viewer, context);
    heading("More");
    const float half = 0.5F * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
    action_button(viewer, context, Action::kScreenshot, "Picture", false, half);
    ImGui::SameLine();
    action_button(viewer, context, Action::kHelp, "Keys", std::as_const(viewer).state().shows_help, half);
  }
  ImGui::End();
}

// --- the figures

void begin_columns(const char* name, int count) {
  ImGui::BeginTable(name, count, ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_NoSavedSettings);
}

void rows(const char* name, const std::vector<app::HudRow>& lines) {
  begin_columns(name, 3);
  for (const app::HudRow& row : lines) {
    ImGui::TableNextColumn();
    faint(row.label);
    ImGui::TableNextColumn();
    text(row.value);
    ImGui::TableNextColumn();
    faint(row.remark);
  }
  ImGui::EndTable();
}

void stage_table(const app::Hud& hud) {
  begin_columns("stages", 3);
  ImGui::TableSetupColumn("stage", ImGuiTableColumnFlags_WidthFixed, 2.2F * em());
  ImGui::TableSetupColumn("time", ImGuiTableColumnFlags_WidthFixed, 5.2F * em());
  ImGui::TableSetupColumn("share", ImGuiTableColumnFlags_WidthStretch);
  for (const app::StageRow& row : hud.stages()) {
    ImGui::TableNextColumn();
    faint(row.label);
    ImGui::TableNextColumn();
    text(app::formatted("{:.2f} ms", row.ms));
    ImGui::TableNextColumn();
    ImGui::ProgressBar(static_cast<float>(row.percent / 100), {-1, 0.9F * em()},
                       app::formatted("{:.0f} %", row.percent).c_str());
  }
  ImGui::EndTable();
}

/// Shares of tets by L/r, logarithmic: bars for now, steps for before. Colours are those of the quality's map.
void histogram(const app::SessionView& view) {
  const auto& before = view.quality_before;
  const auto& now = view.quality;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, kHistogramHeight * em());
  ImGui::Dummy(size);
  constexpr std::size_t kBins = app::QualityFigures::kBins;
  const auto share = [](const app::QualityFigures& f, std::size_t bin) {
    return f.tets > 0 ? static_cast<float>(f.histogram[bin]) / static_cast<float>(f.tets) : 0.0F;
  };
  float most = 1e-6F;
  for (std::size_t i = 0; i < kBins; ++i) most = std::max({most, share(before, i), share(now, i)});
  // The square root of the share: few bad tets must be seen beside many good ones.
  const auto top = [&](float value) { return at.y + size.y * (1 - std::sqrt(value / most)); };
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float bottom = at.y + size.y;
  list->AddLine({at.x, bottom}, {at.x + size.x, bottom}, color_of(ImGuiCol_TextDisabled));
  for (std::size_t i = 0; i < kBins; ++i) {
    const float left = at.x + size.x * static_cast<float>(i) / kBins;
    const float right = at.x + size.x * static_cast<float>(i + 1) / kBins;
    const float height = top(share(now, i));
    list->AddRectFilled({left, height}, {right - 1, bottom},
                        color_of(app::quality_color(static_cast<std::uint8_t>(i * 8 + 4))));
    list->AddRect({left, height}, {right - 1, bottom}, color_of(ImGuiCol_Text, 0.35F));
    const float old = top(share(before, i));
    list->AddLine({left, old}, {right, old}, color_of(ImGuiCol_Text), 1.5F);
  }
  faint("L/r: 4.9, good");
  ImGui::SameLine(ImGui::GetContentRegionAvail().x - 4.5F * em());
  faint("bad, 200");
  hint("Bars: now. Lines: before the first cut. Heights grow with the square root of the share.");
}

void quality(const app::SessionView& view) {
  begin_columns("quality", 3);
  for (const char* head : {"L/r", "before", "now"}) {
    ImGui::TableNextColumn();
    faint(head);
  }
  for (const app::QualityRow& row : quality_rows(view)) {
    ImGui::TableNextColumn();
    faint(row.label);
    ImGui::TableNextColumn();
    text(row.before);
    ImGui::TableNextColumn();
    text(row.now);
  }
  ImGui::EndTable();
  histogram(view);
}

void force(const app::SessionView& view) {
  heading("Force on the blade");
  rows("force", force_rows(view));
  std::vector<float> samples;
  for (const app::ForceSample& sample : view.figures.force) samples.push_back(sample.force);
  const float most = std::max(1e-3F, static_cast<float>(1.1 * view.figures.peak_force));
  ImGui::PlotLines("##force", samples.data(), static_cast<int>(samples.size()), 0, nullptr, 0, most,
                   {ImGui::GetContentRegionAvail().x, kForceHeight * em()});
  if (view.figures.force.empty()) return;
  const float seconds = view.figures.force.back().time - view.figures.force.front().time;
  faint(app::formatted("0 to {:.2g} N over the last {:.0f} s", most, seconds));
}

void validity(const app::SessionView& view) {
  constexpr std::array<app::Color, 4> kLights = {{{150, 150, 150}, {240, 228, 66}, {0, 158, 115}, {213, 94, 0}}};
  constexpr std::array<const char*, 4> kMarks = {"?", "...", "OK", "X"};
  const auto state = static_cast<std::size_t>(view.validity.state);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float radius = 0.42F * em();
  ImGui::GetWindowDrawList()->AddCircleFilled({at.x + radius, at.y + 0.55F * em()}, radius, color_of(kLights[state]));
  ImGui::Dummy({2.2F * radius, em()});
  ImGui::SameLine();
  text(app::formatted("Mesh {}", kMarks[state]));
  ImGui::SameLine();
  faint(view.validity.text);
}

void draw_figures(const Viewer& viewer, const PanelContext& context) {
  const app::SessionView& view = viewer.view();
  const float screen = ImGui::GetMainViewport()->Size.y;
  if (begin_panel("figures", {1, 0}, kFiguresWidth * em(), screen - 2 * kMargin * em())) {
    rows("rates", rate_rows(viewer.hud(), view));
    if (context.is_software) faint("drawn by the processor");
    stage_table(viewer.hud());
    heading("Mesh");
    rows("mesh", mesh_rows(view));
    validity(view);
    heading("Quality, 4.9 is best");
    quality(view);
    force(view);
  }
  ImGui::End();
}

// --- time, at the bottom

void log_lines(const app::SessionView& view) {
  if (!view.log || view.log->empty()) return;
  const std::vector<app::Operation>& all = *view.log;
  const std::size_t first = all.size() - std::min<std::size_t>(all.size(), kLogLines);
  for (std::size_t i = first; i < all.size(); ++i) faint(app::formatted("{:6.1f} s  {}", all[i].time, all[i].text));
}

/// In the middle, or to the left of the figures where these would hide a part.
bool begin_time() {
  const ImVec2 screen = ImGui::GetMainViewport()->Size;
  const float figures = screen.x - (kFiguresWidth + 2 * kMargin) * em();
  if (0.5F * screen.x + kTimeHalfWidth * em() <= figures) return begin_panel("time", {0.5F, 1}, 0, 12 * em());
  return begin_panel_at("time", {figures, screen.y - kMargin * em()}, {1, 1}, 0, 12 * em());
}

void draw_time(Viewer& viewer, const PanelContext& context) {
  const app::SessionView& view = viewer.view();
  if (begin_time()) {
    log_lines(view);
    if (view.is_replay) replay_line(viewer, context);
    action_button(viewer, context, Action::kPause, view.is_paused ? "Go on" : "Pause", false);
    ImGui::SameLine();
    action_button(viewer, context, Action::kStep, "Step", false);
    ImGui::SameLine();
    action_button(viewer, context, Action::kReset, "Reset", false);
    ImGui::SameLine();
    action_button(viewer, context, Action::kUndo, "Undo", false);
    ImGui::SameLine();
    action_button(viewer, context, Action::kRedo, "Redo", false);
    ImGui::SameLine();
    action_button(viewer, context, Action::kRecord, view.is_recording ? "End recording" : "Record", view.is_recording);
    ImGui::SameLine();
    text(app::formatted("{:.1f} s", view.figures.seconds));
  }
  ImGui::End();
}

// --- over the picture

void draw_title(const app::SessionView& view, const app::ViewerState& state) {
  const std::string& line = !view.busy.empty() ? view.busy : (!state.notice.empty() ? state.notice : view.title);
  if (line.empty()) return;
  const float width = ImGui::GetMainViewport()->Size.x - (kToolsWidth + kFiguresWidth + 5 * kMargin) * em();
  const float wanted = std::min(ImGui::CalcTextSize(line.c_str()).x + 1.6F * em(), std::max(width, 10 * em()));
  const float centre = 0.5F + 0.5F * (kToolsWidth - kFiguresWidth) * em() / ImGui::GetMainViewport()->Size.x;
  if (begin_panel("title", {state.panels == app::Panels::kAll ? centre : 0.5F, 0}, wanted, 8 * em())) {
    ImGui::PushTextWrapPos(0);
    text(line);
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
}

/// Of a panel in research: at most what tools and figures leave between them where the picture is narrow.
float research_width(float wanted) {
  const float screen = ImGui::GetMainViewport()->Size.x;
  if (2 * (wanted + kTimeHalfWidth * em()) <= screen) return wanted;
  const float room = screen - (kToolsWidth + kFiguresWidth + 4 * kMargin) * em();
  return std::clamp(room, kLeastWidth * em(), wanted);
}

/// Of a panel of this width whose left edge is to be `left` from the left one of all panels.
float share_of_left(float left, float width) {
  const float room = ImGui::GetMainViewport()->Size.x - 2 * kMargin * em() - width;
  return room > 0 ? std::min(1.0F, left / room) : 0;
}

/// The lower left corner; where the picture is too narrow, above the panel of time and beside the tools.
ImVec2 lower_left(float width) {
  const ImVec2 screen = ImGui::GetMainViewport()->Size;
  const bool is_narrow = 2 * (width + kTimeHalfWidth * em()) > screen.x;
  if (!is_narrow) return {0, 1};
  return {share_of_left((kToolsWidth + kMargin) * em(), width), 1 - kTimeHeight * em() / screen.y};
}

/// The same to the right of the column of tools, beside or above the bar of time.
ImVec2 beside_tools(float width, bool is_replay) {
  const ImVec2 screen = ImGui::GetMainViewport()->Size;
  const float half = (is_replay ? kReplayHalfWidth : kBarHalfWidth) * em();
  const bool is_narrow = 2 * (kToolColumn * em() + width + half) > screen.x;
  return {share_of_left(kToolColumn * em(), width),
          is_narrow ? 1 - (kTimeBar + (is_replay ? kReplayHigher : 0)) * em() / screen.y : 1};
}

/// Where an exercise would be; where there is one, across from it or above.
ImVec2 probe_place(const app::SessionView& view, bool is_research, float width) {
  const bool has_exercise = view.scene && view.scene->exercise;
  if (is_research && has_exercise) return {share_of_left((kToolsWidth + kMargin) * em(), width), 0.1F};
  if (is_research) return lower_left(width);
  const ImVec2 at = beside_tools(width, view.is_replay);
  return has_exercise ? ImVec2(1, at.y) : at;
}

void draw_probe(const app::SessionView& view, bool is_research) {
  if (!view.probe) return;
  const float width = is_research ? research_width(kProbeWidth * em()) : kProbeWidth * em();
  const ImVec2 at = probe_place(view, is_research, width);
  if (begin_panel("probe", at, width, 10 * em())) {
    ImGui::PushTextWrapPos(0);
    for (const std::string& line : to_lines(*view.probe)) text(line);
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
}

/// A bar with the value in it; the part within which nothing is lost is marked, and said in words.
void gauge(const app::ExerciseGauge& g) {
  const bool is_known = std::isfinite(g.value);
  faint(is_known ? app::formatted("{}  {:.1f} {}", g.name, g.value, g.unit) : std::string(g.name));
  ImGui::SameLine(8.5F * em());
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, 0.8F * em());
  ImGui::Dummy(size);
  hint("Green: as it is asked for. A mark tells where the blade is");
  const auto x = [&](double value) { return at.x + size.x * static_cast<float>(std::clamp(value / g.most, 0.0, 1.0)); };
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end(at.x + size.x, at.y + size.y);
  list.AddRectFilled(at, end, color_of(ImGuiCol_FrameBg), 3);
  list.AddRectFilled({x(g.low), at.y}, {x(g.high), end.y}, color_of(app::Color{0, 158, 115}), 3);
  if (!is_known) return;
  const bool is_within = g.value >= g.low && g.value <= g.high;
  const float middle = x(g.value);
  list.AddRectFilled({middle - 2, at.y - 3}, {middle + 2, end.y + 3}, color_of(ImGuiCol_Text));
  if (is_within) return;
  list.AddTriangleFilled({middle - 5, at.y - 5}, {middle + 5, at.y - 5}, {middle, at.y + 2}, color_of(ImGuiCol_Text));
}

void gauges(const app::SessionView& view) {
  if (!view.gauges) return;
  for (const app::ExerciseGauge& g : *view.gauges) gauge(g);
}

/// What the ribbon's inks say.
void ribbon_words(app::Theme theme) {
  using app::Ink;
  constexpr std::array<std::pair<Ink, const char*>, 3> kInks = {
      {{Ink::kWithin, "within"}, {Ink::kNear, "near"}, {Ink::kFar, "far off"}}};
  const auto styles = render::ink_styles(theme);
  faint("Ribbon:");
  for (const auto& [ink, word] : kInks) {
    const auto& [red, green, blue] = styles[static_cast<std::size_t>(ink)].color;
    ImGui::SameLine();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + 0.25F * em()}, {at.x + 0.8F * em(), at.y + 0.85F * em()},
                                              ImGui::GetColorU32({red, green, blue, 1}));
    ImGui::Dummy({0.9F * em(), em()});
    ImGui::SameLine();
    text(word);
  }
}

void score_words(const app::ExerciseScore& score, app::Theme theme) {
  ImGui::ProgressBar(static_cast<float>(score.points / 100), {-1, 0},
                     app::formatted("{:.0f} of 100 points", score.points).c_str());
  text(app::formatted("{}: {:.3g} points are asked for", score.is_passed ? "Passed" : "Not passed", score.pass));
  for (const app::ExerciseDeduction& deduction : score.deductions) {
    text(app::formatted("-{:.1f}  {}", deduction.points, deduction.reason));
  }
  if (score.deductions.empty()) text("Nothing to take off.");
  ribbon_words(theme);
}

/// What a trainee shall do; afterwards, how it was done.
void draw_exercise(Viewer& viewer, const PanelContext& context) {
  const app::SessionView& view = viewer.view();
  if (!view.scene || !view.scene->exercise) return;
  const app::Exercise& exercise = *view.scene->exercise;
  const app::ViewerState& state = std::as_const(viewer).state();
  const bool is_research = state.is_research;
  const float width = is_research ? research_width(kExerciseWidth * em()) : kNarrowExerciseWidth * em();
  const ImVec2 at = is_research ? lower_left(width) : beside_tools(width, view.is_replay);
  if (begin_panel("exercise", at, width, 0.6F * ImGui::GetMainViewport()->Size.y)) {
    ImGui::PushTextWrapPos(0);
    faint("Exercise: " + exercise.name);
    if (view.score) {
      score_words(*view.score, state.options.theme);
    } else {
      text(exercise.instructions);
      gauges(view);
    }
    ImGui::PopTextWrapPos();
    action_button(viewer, context, Action::kScore, view.score ? "Score again" : "Finish", false);
    ImGui::SameLine();
    action_button(viewer, context, Action::kIdeal, "Ideal", std::as_const(viewer).state().shows_ideal);
    ImGui::SameLine();
    action_button(viewer, context, Action::kReset, "Try again", false);
  }
  ImGui::End();
}

void draw_legend(const app::ViewerState& state) {
  if (state.options.color != app::ColorBy::kQuality) return;
  if (begin_panel("legend", {0.5F, 0.12F}, 20 * em(), 5 * em())) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = kLegendHeight * em();
    for (int i = 0; i < 64; ++i) {
      const float left = at.x + width * static_cast<float>(i) / 64,
                  right = at.x + width * static_cast<float>(i + 1) / 64;
      ImGui::GetWindowDrawList()->AddRectFilled({left, at.y}, {right, at.y + height},
                                                color_of(app::quality_color(static_cast<std::uint8_t>(4 * i))));
    }
    ImGui::Dummy({width, height});
    text("L/r 4.9, regular");
    ImGui::SameLine(ImGui::GetContentRegionAvail().x - 6 * em());
    text("200 and worse");
  }
  ImGui::End();
}

/// In two columns; a group is not torn apart.
void key_columns() {
  const std::vector<app::KeyRow> all = app::key_rows();
  std::string_view group;
  bool is_second = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].group != group) {
      if (!is_second && 2 * i >= all.size()) {
        ImGui::NextColumn();
        is_second = true;
      }
      heading(std::string(all[i].group).c_str());
    }
    group = all[i].group;
    text(all[i].keys);
    ImGui::SameLine(std::max(9.5F * em(), ImGui::CalcTextSize(all[i].keys.c_str()).x + em()));
    ImGui::PushTextWrapPos(0);
    text(std::string(all[i].text));
    ImGui::PopTextWrapPos();
  }
}

void draw_help(app::ViewerState& state) {
  if (!state.shows_help) return;
  const ImVec2 screen = ImGui::GetMainViewport()->Size;
  ImGui::SetNextWindowPos({0.5F * screen.x, 0.5F * screen.y}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({std::min(66 * em(), 0.97F * screen.x), std::min(52 * em(), 0.98F * screen.y)});
  ImGui::SetNextWindowFocus();  // over the other panels
  ImGui::SetNextWindowBgAlpha(1);
  if (ImGui::Begin("Keys", &state.shows_help, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings)) {
    text("Left drag: the tool. Right or middle drag, or Alt+drag: turn the view; with Shift: move it. Wheel: zoom.");
    text("Shift+drag: grasp, whatever the tool. Drop a scene, a mesh or a recording on the window to open it.");
    ImGui::Separator();
    ImGui::Columns(2, nullptr, false);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, 0.22F * em()});
    key_columns();
    ImGui::PopStyleVar();
    ImGui::Columns(1);
  }
  ImGui::End();
}

}  // namespace

void draw_research_panels(Viewer& viewer, const PanelContext& context) {
  const app::ViewerState& state = std::as_const(viewer).state();
  if (state.panels == app::Panels::kAll) {
    draw_tools(viewer, context);
    draw_time(viewer, context);
  }
  draw_figures(viewer, context);
  draw_title(viewer.view(), state);
}

/// Around the middle, in pixels of the picture.
static float free_width(bool is_research) {
  const float beside = is_research ? kFiguresWidth + 2 * kMargin : kToolColumn;
  const float width = ImGui::GetMainViewport()->Size.x - 2 * beside * em();
  return width * ImGui::GetIO().DisplayFramebufferScale.x;
}

Panels::Panels() : first_(std::make_unique<FirstPanels>()) {}
Panels::~Panels() = default;

void Panels::draw(Viewer& viewer, const PanelContext& context) {
  const app::ViewerState& state = std::as_const(viewer).state();
  viewer.leave_free(static_cast<double>(free_width(state.is_research)));
  if (state.panels != app::Panels::kNone) {
    if (state.is_research) {
      draw_research_panels(viewer, context);
    } else {
      first_->draw(viewer, context);
    }
    const bool has_cards = !state.is_research && first_->shows_cards();
    if (state.panels == app::Panels::kAll && !has_cards) draw_exercise(viewer, context);
    draw_probe(viewer.view(), state.is_research);
    draw_legend(state);
  }
  if (state.shows_help) draw_help(viewer.state());
}

}  // namespace incise_view
