// SPDX-License-Identifier: Apache-2.0
// A pen on a square of 24 units, and one case for each icon.
#include "icons.h"

#include <cmath>
#include <initializer_list>
#include <numbers>

namespace incise_view {
namespace {

constexpr float kUnits = 24;  // that a side of the square has

/// A pen on the square: places in units, from the upper left corner.
class Pen {
 public:
  Pen(ImDrawList& list, const ImVec2& corner, float side, ImU32 color)
      : list_(list), corner_(corner), unit_(side / kUnits), color_(color) {}

  void line(std::initializer_list<ImVec2> places, bool is_closed = false) {
    for (const ImVec2& place : places) list_.PathLineTo(at(place));
    list_.PathStroke(color_, is_closed ? ImDrawFlags_Closed : 0, width());
  }
  void fill(std::initializer_list<ImVec2> places) {
    for (const ImVec2& place : places) list_.PathLineTo(at(place));
    list_.PathFillConvex(color_);
  }
  /// Angles in quarters of a turn, clockwise from the right.
  void arc(const ImVec2& centre, float radius, float from, float to) {
    constexpr float kQuarter = std::numbers::pi_v<float> / 2;
    list_.PathArcTo(at(centre), radius * unit_, from * kQuarter, to * kQuarter, 24);
    list_.PathStroke(color_, 0, width());
  }
  void circle(const ImVec2& centre, float radius) { list_.AddCircle(at(centre), radius * unit_, color_, 24, width()); }
  void disc(const ImVec2& centre, float radius) { list_.AddCircleFilled(at(centre), radius * unit_, color_, 20); }
  void curve(const ImVec2& a, const ImVec2& b, const ImVec2& c, const ImVec2& d) {
    list_.AddBezierCubic(at(a), at(b), at(c), at(d), color_, width());
  }

 private:
  [[nodiscard]] ImVec2 at(const ImVec2& place) const {
    return {corner_.x + unit_ * place.x, corner_.y + unit_ * place.y};
  }
  [[nodiscard]] float width() const { return std::max(1.2F, 1.7F * unit_); }

  ImDrawList& list_;
  ImVec2 corner_;
  float unit_;
  ImU32 color_;
};

void draw_tool(Icon icon, Pen& p) {
  switch (icon) {
    case Icon::kTurn:
      p.arc({12, 12}, 8, -0.7F, 2.6F);
      p.line({{3.2F, 8.5F}, {5.2F, 13}, {9.4F, 10.6F}});
      break;
    case Icon::kScalpel:
      p.line({{20.5F, 3}, {11.5F, 12}});
      p.fill({{13, 10.4F}, {14.2F, 13.4F}, {9.5F, 18.5F}, {4, 21}, {6.4F, 16}});
      break;
    case Icon::kPlane:
      p.line({{3, 20}, {21, 4}});
      p.line({{4, 9}, {12, 4.5F}, {12, 8}});
      p.line({{20, 15}, {12, 19.5F}, {12, 16}});
      break;
    case Icon::kForceps:
      p.curve({12, 3}, {5, 8}, {6, 15}, {11, 21});
      p.curve({12, 3}, {19, 8}, {18, 15}, {13, 21});
      break;
    case Icon::kPin:
      p.circle({12, 7}, 4);
      p.line({{12, 11}, {12, 21}});
      break;
    case Icon::kProbe:
      p.circle({10, 10}, 6);
      p.line({{14.5F, 14.5F}, {20.5F, 20.5F}});
      break;
    case Icon::kHook:
      p.line({{14, 2.5F}, {14, 15}});
      p.arc({10, 15}, 4, 0, 2.4F);
      break;
    case Icon::kRetractor:
      p.line({{20, 4}, {11, 9}, {7, 13}, {7, 20}});
      p.line({{3.5F, 20}, {10.5F, 20}});
      break;
    case Icon::kScissors:
      p.line({{5, 3}, {15.5F, 16.5F}});
      p.line({{19, 3}, {8.5F, 16.5F}});
      p.circle({6.5F, 19}, 2.8F);
      p.circle({17.5F, 19}, 2.8F);
      break;
    case Icon::kPunch:
      p.line({{8, 3}, {8, 15}});
      p.line({{16, 3}, {16, 15}});
      p.line({{8, 3}, {16, 3}});
      p.arc({12, 13.5F}, 4.3F, 0.2F, 1.8F);
      p.line({{4, 20.5F}, {20, 20.5F}});
      break;
    case Icon::kSuture:
      p.arc({11, 11}, 8, -0.4F, 1.6F);
      p.curve({11.6F, 18.8F}, {8, 22}, {4, 18}, {6.5F, 13});
      break;
    default:
      p.line({{5, 19}, {5, 8}, {19, 8}, {19, 19}});
      p.line({{12, 13}, {12, 22}});
      break;
  }
}

void draw_time(Icon icon, Pen& p) {
  switch (icon) {
    case Icon::kUndo:
      p.line({{9, 4}, {4, 9}, {9, 14}});
      p.line({{4, 9}, {14, 9}});
      p.arc({14, 14}, 5, -1, 1);
      p.line({{14, 19}, {9, 19}});
      break;
    case Icon::kRedo:
      p.line({{15, 4}, {20, 9}, {15, 14}});
      p.line({{20, 9}, {10, 9}});
      p.arc({10, 14}, 5, 1, 3);
      p.line({{10, 19}, {15, 19}});
      break;
    case Icon::kPause:
      p.fill({{6, 5}, {10, 5}, {10, 19}, {6, 19}});
      p.fill({{14, 5}, {18, 5}, {18, 19}, {14, 19}});
      break;
    case Icon::kGo:
      p.fill({{7, 4}, {20, 12}, {7, 20}});
      break;
    default:
      p.arc({12, 12}, 8, -0.6F, 2.6F);
      p.line({{20, 3}, {18.6F, 8.2F}, {13.4F, 7}});
      break;
  }
}

void draw_body(Icon icon, Pen& p) {
  switch (icon) {
    case Icon::kSkin:
      p.line({{3, 8}, {21, 8}, {21, 18}, {3, 18}}, true);
      p.line({{3, 11}, {21, 11}});
      p.curve({3, 15}, {8, 13}, {15, 17}, {21, 14.5F});
      break;
    case Icon::kLiver:
      p.curve({3, 13}, {2, 5}, {12, 5}, {21, 8});
      p.curve({21, 8}, {20, 13}, {13, 12}, {11, 16});
      p.curve({11, 16}, {8, 20}, {3, 19}, {3, 13});
      break;
    case Icon::kVein:
      p.line({{6, 8}, {19, 5}});
      p.line({{6, 18}, {19, 15}});
      p.arc({19, 10}, 5, -1, 1);
      p.circle({6, 13}, 5);
      break;
    default:
      p.circle({12, 8.5F}, 5.5F);
      p.circle({12, 15}, 2);
      p.line({{9.6F, 14}, {3, 17}});
      p.line({{14.4F, 14}, {21, 17}});
      p.line({{12, 17}, {12, 22}});
      break;
  }
}

void draw_exercise_icon(Icon icon, Pen& p) {
  switch (icon) {
    case Icon::kStraightCut:
      p.line({{3, 12}, {21, 12}});
      p.line({{3, 8}, {3, 16}});
      p.line({{21, 8}, {21, 16}});
      break;
    case Icon::kUpToLayer:
      p.line({{2, 8}, {22, 8}});
      p.line({{2, 15}, {22, 15}});
      p.line({{12, 2}, {12, 14}});
      p.line({{9, 11}, {12, 14}, {15, 11}});
      p.curve({2, 20}, {8, 17.5F}, {15, 22.5F}, {22, 19.5F});
      break;
    case Icon::kSlit:
      p.line({{2, 5}, {22, 5}});
      p.line({{2, 19}, {22, 19}});
      p.curve({5, 11}, {9, 7.5F}, {15, 7.5F}, {19, 11});
      p.curve({5, 11}, {9, 14.5F}, {15, 14.5F}, {19, 11});
      break;
    case Icon::kCore:
      p.circle({12, 12}, 8.5F);
      p.disc({12, 12}, 3.6F);
      break;
    default:
      p.curve({2, 12}, {7, 4}, {17, 4}, {22, 12});
      p.curve({2, 12}, {7, 20}, {17, 20}, {22, 12});
      p.disc({12, 12}, 2.8F);
      break;
  }
}

void draw_other(Icon icon, Pen& p) {
  switch (icon) {
    case Icon::kPicture:
      p.line({{3, 8}, {8, 8}, {9.5F, 5}, {14.5F, 5}, {16, 8}, {21, 8}, {21, 19}, {3, 19}}, true);
      p.circle({12, 13}, 3.5F);
      break;
    case Icon::kResearch:
      p.line({{3, 20}, {21, 20}});
      p.line({{6.5F, 17}, {6.5F, 12}});
      p.line({{12, 17}, {12, 5}});
      p.line({{17.5F, 17}, {17.5F, 9}});
      break;
    case Icon::kHelp:
      p.circle({12, 12}, 9);
      p.arc({12, 9.5F}, 3, -2, 0.6F);
      p.line({{12.8F, 12.2F}, {12, 14.5F}});
      p.disc({12, 17.5F}, 1.1F);
      break;
    case Icon::kBodies:
      for (const float x : {4.0F, 14.0F}) {
        for (const float y : {4.0F, 14.0F}) p.line({{x, y}, {x + 6, y}, {x + 6, y + 6}, {x, y + 6}}, true);
      }
      break;
    case Icon::kFolder:
      p.line({{3, 6}, {9, 6}, {11, 8.5F}, {21, 8.5F}, {21, 19}, {3, 19}}, true);
      break;
    default:  // a hand that points
      p.line({{9, 14},
              {9, 4.6F},
              {10.4F, 3.4F},
              {11.8F, 4.6F},
              {11.8F, 10},
              {14, 9.6F},
              {16, 10.4F},
              {18.4F, 11.6F},
              {18.4F, 16},
              {16.6F, 21},
              {10.4F, 21},
              {6, 15.4F},
              {7, 13.6F},
              {9, 14.8F}});
      break;
  }
}

}  // namespace

void draw_icon(ImDrawList& list, Icon icon, const ImVec2& corner, float side, ImU32 color) {
  Pen pen(list, corner, side, color);
  if (icon <= Icon::kStaple) return draw_tool(icon, pen);
  if (icon <= Icon::kRestart) return draw_time(icon, pen);
  if (icon >= Icon::kSkin && icon <= Icon::kVertebra) return draw_body(icon, pen);
  if (icon >= Icon::kStraightCut && icon <= Icon::kEllipse) return draw_exercise_icon(icon, pen);
  draw_other(icon, pen);
}

}  // namespace incise_view
