// SPDX-License-Identifier: Apache-2.0
// The tools that cut: what each does with a drag.
#include <cmath>

#include "app/hands/punch.h"
#include "app/hands/scalpel.h"
#include "app/hands/scissors.h"
#include "app/scene/tool_table.h"
#include "app/view/plane_cut.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

double reach_of(const Box& body) {
  const double size = body.is_empty() ? 0 : (body.hi - body.lo).norm();
  return size > 0 && std::isfinite(size) ? size : 1;
}

Instrument scalpel_at(const Vec3& tip, const Vec3& up, const Vec3& ahead, double millimetre) {
  Instrument scalpel;
  scalpel.tip = tip;
  scalpel.up = up;
  scalpel.ahead = ahead;
  scalpel.millimetre = millimetre;
  return scalpel;
}

/// How deep a blade would go in: a thin arc below the surface, with the tip where it would be.
void draw_depth(const SurfaceHit& hit, double depth, const Camera& camera, Marks& marks) {
  constexpr int kSteps = 12;
  constexpr double kHalfArc = 0.7;  // rad
  Vec3 side = camera.right() - camera.right().dot(hit.normal) * hit.normal;
  side = side.norm() > 1e-6 ? side.normalized() : Vec3(hit.normal.unitOrthogonal());
  const auto place = [&](int i) {
    const double turn = kHalfArc * (2.0 * i / kSteps - 1);
    return Eigen::Vector3f((hit.point + depth * (std::sin(turn) * side - std::cos(turn) * hit.normal)).cast<float>());
  };
  for (int i = 1; i <= kSteps; ++i) marks.lines.push_back({place(i - 1), place(i), Ink::kHook, 1, true, false});
  const Eigen::Vector3f at = hit.point.cast<float>();
  marks.lines.push_back({at, place(kSteps / 2), Ink::kHook, 1, true, false});
  marks.balls.push_back({place(kSteps / 2), Ink::kPreview, 3, true});
}

/// The blade pushes the skin that lies under the pointer, and a picture is some frames old. So a stroke goes by the
/// surface as it stood when the pointer went down: there the hand is where it was aimed.
class ScalpelTool final : public HandTool {
 public:
  void press(const DragMoment& moment) override {
    aimed_at_ = moment.context.surface != nullptr ? *moment.context.surface : SurfaceFrame();
    millimetre_ = millimetre_of(moment.settings);
    scalpel_.press(moment.place_on(aimed_at_), moment.settings);
  }
  void move(const DragMoment& moment) override {
    scalpel_.move(moment.place_on(aimed_at_), moment.settings, reach_of(moment.context.body));
  }
  void release(bool is_click, const ToolSettings& /*settings*/, std::uint32_t& /*next_hook*/,
               DragResults& results) override {
    if (!scalpel_.pose()) {
      results.refusal = "The scalpel cuts where it goes over the body; this drag was beside it";
    } else if (is_click) {
      results.refusal = "A click cuts nothing: drag the scalpel along the skin";
    }
  }
  void stop() override {
    scalpel_.end();
    aimed_at_ = {};
  }
  void add_to(HandState& hands) const override {
    if (std::optional<BladePose> pose = scalpel_.pose()) {
      hands.blade = *std::move(pose);
      hands.cuts_with = ToolKind::kScalpel;
    }
  }
  void draw(const Camera& camera, Marks& marks) const override {
    scalpel_.draw(marks);
    if (!scalpel_.pose()) return;
    const BladePose& pose = *scalpel_.pose();
    const Vec3 way = pose.edge.front() - pose.edge.back();
    const Vec3 ahead = pose.direction.isZero(0) ? camera.right() : pose.direction;
    marks.instruments.push_back(scalpel_at(pose.edge.back(), way.normalized(), ahead, millimetre_));
  }
  void draw_hover(const SurfaceHit& hit, const ToolSettings& settings, const Camera& camera,
                  Marks& marks) const override {
    draw_depth(hit, settings.depth, camera, marks);
    marks.instruments.push_back(scalpel_at(hit.point, hit.normal, camera.right(), millimetre_of(settings)));
  }

 private:
  Scalpel scalpel_;
  double millimetre_ = 0.001;
  SurfaceFrame aimed_at_;
};

class PlaneCutTool final : public HandTool {
 public:
  void move(const DragMoment& moment) override {
    plane_ = plane_cut_between(moment.camera, moment.context.viewport, moment.pressed, moment.event.pixel,
                               moment.context.body);
  }
  void release(bool /*is_click*/, const ToolSettings& /*settings*/, std::uint32_t& /*next_hook*/,
               DragResults& results) override {
    if (plane_) {
      results.stroke = to_stroke(*plane_);
    } else {
      results.refusal = "The line is too short to say where the plane goes: drag further";
    }
  }
  void stop() override { plane_.reset(); }
  void draw(const Camera& camera, Marks& marks) const override {
    if (plane_) app::draw(*plane_, camera, marks);
  }

 private:
  std::optional<PlaneCut> plane_;
};

class ScissorsTool final : public HandTool {
 public:
  void press(const DragMoment& moment) override {
    aimed_at_ = moment.context.surface != nullptr ? *moment.context.surface : SurfaceFrame();
    from_ = moment.place_on(aimed_at_);
  }
  void move(const DragMoment& moment) override {
    if (from_) place_ = place_scissors(*from_, moment.place_on(aimed_at_), moment.settings);
    millimetre_ = millimetre_of(moment.settings);
  }
  void release(bool /*is_click*/, const ToolSettings& /*settings*/, std::uint32_t& /*next_hook*/,
               DragResults& results) override {
    if (place_) {
      results.stroke = to_stroke(*place_);
    } else {
      results.refusal = "Scissors close along a drag: one of its ends must be on the skin";
    }
  }
  void stop() override {
    from_.reset();
    place_.reset();
    aimed_at_ = {};
  }
  void draw(const Camera& /*camera*/, Marks& marks) const override {
    if (!place_) return;
    app::draw(*place_, marks);
    Instrument scissors;
    scissors.kind = InstrumentKind::kScissors;
    scissors.tip = place_->lower_tip;
    scissors.other_tip = place_->upper_tip;
    scissors.hinge = place_->hinge;
    scissors.millimetre = millimetre_;
    marks.instruments.push_back(scissors);
  }

 private:
  double millimetre_ = 0.001;
  SurfaceFrame aimed_at_;
  std::optional<PointerPlace> from_;
  std::optional<ScissorsPlace> place_;
};

class PunchTool final : public HandTool {
 public:
  void press(const DragMoment& moment) override { hit_ = moment.place().hit; }
  void release(bool is_click, const ToolSettings& settings, std::uint32_t& /*next_hook*/,
               DragResults& results) override {
    if (is_click && hit_) {
      results.stroke = punch_stroke(hit_->point, hit_->normal, settings);
    } else {
      results.refusal = hit_ ? "A punch goes in at a click, without a drag" : "There is no tissue under the pointer";
    }
  }
  void stop() override { hit_.reset(); }
  void draw_hover(const SurfaceHit& hit, const ToolSettings& settings, const Camera& /*camera*/,
                  Marks& marks) const override {
    draw_punch(hit.point, hit.normal, settings, marks);
    Instrument punch;
    punch.kind = InstrumentKind::kPunch;
    punch.tip = hit.point;
    punch.up = hit.normal;
    punch.opening = settings.punch_radius;
    punch.millimetre = millimetre_of(settings);
    punch.is_ghost = true;  // it stands on what it is aimed at
    marks.instruments.push_back(punch);
  }

 private:
  std::optional<SurfaceHit> hit_;
};

}  // namespace

std::unique_ptr<HandTool> make_scalpel_tool() {
  return std::make_unique<ScalpelTool>();
}
std::unique_ptr<HandTool> make_plane_cut_tool() {
  return std::make_unique<PlaneCutTool>();
}
std::unique_ptr<HandTool> make_scissors_tool() {
  return std::make_unique<ScissorsTool>();
}
std::unique_ptr<HandTool> make_punch_tool() {
  return std::make_unique<PunchTool>();
}

}  // namespace app
}  // namespace v0
}  // namespace incise
