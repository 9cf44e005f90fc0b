// SPDX-License-Identifier: Apache-2.0
// A pure function of the scene and a frame's number: tracks are interpolated between their two keys around the frame's
// end, shapes field by field.
#include <algorithm>
#include <optional>
#include <type_traits>

#include "app/scene/scene.h"
#include "app/scene/scene_blade.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

/// Where a moment lies between two of a track's keys.
struct KeySpan {
  std::size_t from = 0, to = 0;
  double share = 0;  // of the way, in [0, 1)
};

Vec3 between(const Vec3& a, const Vec3& b, double share) {
  return a + share * (b - a);
}

double between(double a, double b, double share) {
  return a + share * (b - a);
}

/// A frame's end and beginning, in seconds.
struct Moment {
  Moment(double frame_seconds, std::uint64_t frame)
      : begin(static_cast<double>(frame) * frame_seconds), end(static_cast<double>(frame + 1) * frame_seconds) {}

  double begin, end;
};

/// Where a track with these key times is; nothing where it is not there.
std::optional<KeySpan> find_span(const std::vector<double>& times, const Moment& now) {
  const double first = times.front();
  const double last = times.back();
  if (now.end <= first || now.begin >= last) return std::nullopt;
  if (now.begin <= first) return KeySpan{};
  if (now.end >= last) return KeySpan{times.size() - 1, times.size() - 1, 0};
  const auto after = std::upper_bound(times.begin(), times.end(), now.end);
  const auto to = static_cast<std::size_t>(after - times.begin());
  return KeySpan{to - 1, to, (now.end - times[to - 1]) / (times[to] - times[to - 1])};
}

struct Blend {
  double share;

  template <class Shape>
  Tool operator()(Shape a, const Shape& b) const {
    if constexpr (Shape::kMoves) blend(a, b);
    return a;
  }
  template <class A, class B>
  Tool operator()(const A& a, const B&) const {
    return a;
  }

 private:
  /// Fields go by their place in the list.
  template <class Shape>
  void blend(Shape& a, const Shape& b) const {
    std::size_t at = 0;
    Shape::for_each_field(a, [&](const char* /*name*/, auto& field) {
      std::size_t other_at = 0;
      Shape::for_each_field(b, [&](const char* /*name*/, const auto& other) {
        if constexpr (std::is_same_v<std::decay_t<decltype(field)>, std::decay_t<decltype(other)>>) {
          if (other_at == at) field = between(field, other, share);
        }
        ++other_at;
      });
      ++at;
    });
  }
};

}  // namespace

std::optional<BladePose> blade_at(const std::vector<SceneStroke>& strokes, double frame_seconds, std::uint64_t frame) {
  const Moment now(frame_seconds, frame);
  for (const SceneStroke& s : strokes) {
    const auto span = find_span(s.stroke.times, now);
    if (!span) continue;
    BladePose pose{s.stroke.edges[span->from], s.direction, s.slicing};
    const std::vector<Vec3>& next = s.stroke.edges[span->to];
    for (std::size_t i = 0; i < pose.edge.size(); ++i) pose.edge[i] = between(pose.edge[i], next[i], span->share);
    return pose;
  }
  return std::nullopt;
}

std::vector<std::int32_t> scene_stops(const Scene& scene, std::uint64_t frame) {
  const Moment now(scene.options.frame_seconds, frame);
  for (const SceneStroke& s : scene.strokes) {
    if (find_span(s.stroke.times, now)) return s.stop_at;
  }
  return {};
}

FrameInput scene_input(const Scene& scene, std::uint64_t frame) {
  const Moment now(scene.options.frame_seconds, frame);
  FrameInput input;
  input.blade = blade_at(scene.strokes, scene.options.frame_seconds, frame);
  for (std::size_t i = 0; i < scene.hooks.size(); ++i) {
    const SceneHook& hook = scene.hooks[i];
    const auto span = find_span(hook.times, now);
    if (!span) continue;
    input.hooks.push_back({static_cast<std::uint32_t>(i),
                           between(hook.positions[span->from], hook.positions[span->to], span->share), hook.radius,
                           hook.stiffness, HookReach::kBall, 0, hook.strength, hook.tears});
  }
  for (const SceneTool& tool : scene.tools) {
    const auto span = tool.times.empty() ? KeySpan{} : find_span(tool.times, now);
    if (span) input.tools.push_back(std::visit(Blend{span->share}, tool.keys[span->from], tool.keys[span->to]));
  }
  return input;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
