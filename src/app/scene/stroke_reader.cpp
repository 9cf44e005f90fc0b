// SPDX-License-Identifier: Apache-2.0
// Both ways to write a stroke, an edge at each time and a rigid edge with poses, become edges at times.
#include "app/scene/stroke_reader.h"

#include <cmath>
#include <limits>
#include <string>

#include "app/scene/blade_file.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr double kUnitTolerance = 1e-6;
constexpr std::size_t kMaxStops = 1000;
constexpr std::uint64_t kMaxStrokeRegion = std::numeric_limits<std::int32_t>::max();

/// The columns of the rotation that a unit quaternion w + xi + yj + zk stands for.
struct Pose {
  Vec3 position;
  Vec3 x, y, z;

  [[nodiscard]] Vec3 operator()(const Vec3& p) const { return position + x * p.x() + y * p.y() + z * p.z(); }
};

Pose pose_of(const Vec3& position, const double* quaternion, double length) {
  const double w = quaternion[0] / length;
  const double x = quaternion[1] / length;
  const double y = quaternion[2] / length;
  const double z = quaternion[3] / length;
  return {position, Vec3(1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)),
          Vec3(2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)),
          Vec3(2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y))};
}

class StrokeReader {
 public:
  explicit StrokeReader(JsonReader& reader) : read_(reader) {}

  bool read_stroke(const JsonValue& value, const std::string& path, BladeStroke& blade) {
    Stroke& stroke = blade.stroke;
    const bool is_rigid = value.find("poses") != nullptr || value.find("edge") != nullptr;
    const bool has_keys = is_rigid ? read_.is_object(value, path, {"name", "edge", "poses", "stop_at"})
                                   : read_.is_object(value, path, {"name", "edges", "stop_at"});
    if (!has_keys) return false;
    const JsonValue* name = value.find("name");
    if (name != nullptr && !read_.text(*name, path + ".name", stroke.name)) return false;
    if (!read_stops(read_, value, path, blade.stop_at, blade.stop_names)) return false;
    return is_rigid ? read_rigid(value, path, stroke) : read_polylines(value, path, stroke);
  }

 private:
  bool read_polylines(const JsonValue& value, const std::string& path, Stroke& stroke) {
    const JsonValue* edges = read_.member(value, path, "edges");
    const std::string list = path + ".edges";
    if (edges == nullptr || !read_.is_array(*edges, list, 1, kMaxBladePoints)) return false;
    for (std::size_t i = 0; i < edges->items.size(); ++i) {
      if (!read_polyline(edges->items[i], at(list, i), stroke)) return false;
    }
    return true;
  }

  bool read_polyline(const JsonValue& value, const std::string& path, Stroke& stroke) {
    if (!read_.is_object(value, path, {"t", "points"}) || !read_time(value, path, stroke)) return false;
    const JsonValue* points = read_.member(value, path, "points");
    if (points == nullptr || !read_points(*points, path + ".points", stroke.edges.emplace_back())) return false;
    const std::size_t count = stroke.edges.back().size();
    if (count == stroke.edges.front().size()) return has_room(value, path, stroke);
    return read_.fail(*points, path + ".points",
                      "has " + std::to_string(count) + " points, but the first time has " +
                          std::to_string(stroke.edges.front().size()) + "; give the same number at all times");
  }

  bool read_rigid(const JsonValue& value, const std::string& path, Stroke& stroke) {
    const JsonValue* edge = read_.member(value, path, "edge");
    const JsonValue* poses = edge ? read_.member(value, path, "poses") : nullptr;
    std::vector<Vec3> points;
    if (poses == nullptr || !read_points(*edge, path + ".edge", points)) return false;
    const std::string list = path + ".poses";
    if (!read_.is_array(*poses, list, 1, kMaxBladePoints)) return false;
    for (std::size_t i = 0; i < poses->items.size(); ++i) {
      if (!read_pose(poses->items[i], at(list, i), points, stroke)) return false;
    }
    return true;
  }

  bool read_pose(const JsonValue& value, const std::string& path, const std::vector<Vec3>& edge, Stroke& stroke) {
    if (!read_.is_object(value, path, {"t", "position", "orientation"}) || !read_time(value, path, stroke))
      return false;
    const JsonValue* position = read_.member(value, path, "position");
    const JsonValue* orientation = position ? read_.member(value, path, "orientation") : nullptr;
    Vec3 origin;
    double q[4] = {};
    if (orientation == nullptr || !read_.numbers(*position, path + ".position", origin.data(), 3) ||
        !read_.numbers(*orientation, path + ".orientation", q, 4)) {
      return false;
    }
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(std::abs(length - 1) <= kUnitTolerance)) {
      return read_.fail(*orientation, path + ".orientation",
                        "has length " + short_number(length) + "; a rotation needs a unit quaternion [w,x,y,z]");
    }
    const Pose pose = pose_of(origin, q, length);
    std::vector<Vec3>& points = stroke.edges.emplace_back();
    for (const Vec3& p : edge) {
      points.push_back(pose(p));
      if (!points.back().allFinite()) return read_.fail(value, path, "moves the edge out of the range of numbers");
    }
    return has_room(value, path, stroke);
  }

  bool read_time(const JsonValue& value, const std::string& path, Stroke& stroke) {
    const JsonValue* time = read_.member(value, path, "t");
    double t = 0;
    if (time == nullptr || !read_.number(*time, path + ".t", t)) return false;
    if (!stroke.times.empty() && !(t > stroke.times.back())) {
      return read_.fail(*time, path + ".t", "must be later than the time before it; sort the times");
    }
    stroke.times.push_back(t);
    return true;
  }

  bool read_points(const JsonValue& value, const std::string& path, std::vector<Vec3>& points) {
    return read_.points(value, path, kMaxBladePoints, points);
  }

  bool has_room(const JsonValue& value, const std::string& path, const Stroke& stroke) {
    if (stroke.edges.size() * stroke.edges.front().size() <= kMaxBladePoints) return true;
    return read_.fail(value, path, "brings the stroke above " + std::to_string(kMaxBladePoints) + " points");
  }

  JsonReader& read_;
};

}  // namespace

bool read_stops(JsonReader& reader, const JsonValue& value, const std::string& path, std::vector<std::int32_t>& numbers,
                std::vector<std::string>& names) {
  return read_regions(reader, value, path, "stop_at", numbers, names);
}

bool read_regions(JsonReader& reader, const JsonValue& value, const std::string& path, const std::string& key,
                  std::vector<std::int32_t>& numbers, std::vector<std::string>& names) {
  const JsonValue* list = value.find(key);
  if (list == nullptr) return true;
  const std::string place = path + "." + key;
  if (!reader.is_array(*list, place, 1, kMaxStops)) return false;
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    const JsonValue& item = list->items[i];
    if (item.kind == JsonValue::Kind::kString && !item.text.empty()) {
      names.push_back(item.text);
    } else if (item.is_whole && item.whole <= kMaxStrokeRegion) {
      numbers.push_back(static_cast<std::int32_t>(item.whole));
    } else {
      return reader.fail(item, at(place, i), "must be a region's number or its name");
    }
  }
  return true;
}

bool read_strokes(JsonReader& reader, const JsonValue& list, const std::string& path,
                  std::vector<BladeStroke>& strokes) {
  if (!reader.is_array(list, path, 1, kMaxBladePoints)) return false;
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    if (!StrokeReader(reader).read_stroke(list.items[i], at(path, i), strokes.emplace_back())) return false;
  }
  return true;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
