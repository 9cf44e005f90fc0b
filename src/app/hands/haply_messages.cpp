// SPDX-License-Identifier: Apache-2.0
// Reads what a blade needs and passes over the rest, so that newer versions of the service, with more fields, are
// still understood.
#include "app/hands/haply_messages.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace incise {
inline namespace v0 {
namespace app {
namespace {

using nlohmann::json;

constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
constexpr std::array<const char*, 3> kButtons = {"a", "b", "c"};
constexpr double kLeastTurn = 1e-3;  // of a quaternion's length: below it says nothing

/// A member of an object; null where there is none, or no object.
const json* find(const json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

std::optional<double> number(const json& object, const char* key) {
  const json* found = find(object, key);
  if (found == nullptr || !found->is_number()) return std::nullopt;
  const double value = found->get<double>();
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

std::optional<Vec3> vector(const json& object, const char* key) {
  const json* found = find(object, key);
  if (found == nullptr) return std::nullopt;
  Vec3 vector;
  for (std::size_t i = 0; i < kAxes.size(); ++i) {
    const std::optional<double> part = number(*found, kAxes[i]);
    if (!part) return std::nullopt;
    vector[static_cast<Eigen::Index>(i)] = *part;
  }
  return vector;
}

/// As JSON: ids were numbers before they were texts, and a force goes to the arm whose id it has, as it has it. Empty
/// where there is none.
std::string id_of(const json& entry) {
  const json* id = find(entry, "device_id");
  const bool is_one = id != nullptr && (id->is_number_integer() || (id->is_string() && *id != ""));
  return is_one ? id->dump() : std::string();
}

/// The entry of a list that has an id, or the first where none is asked for; null where there is none.
const json* entry_of(const json& message, const char* list, const std::string& id) {
  const json* entries = find(message, list);
  if (entries == nullptr || !entries->is_array()) return nullptr;
  for (const json& entry : *entries) {
    if (id.empty() || id_of(entry) == id) return &entry;
  }
  return nullptr;
}

void read_grip(const json& state, HaplyReading& reading) {
  if (const json* turn = find(state, "orientation")) {
    const std::array<std::optional<double>, 4> q = {number(*turn, "w"), number(*turn, "x"), number(*turn, "y"),
                                                    number(*turn, "z")};
    if (q[0] && q[1] && q[2] && q[3]) {
      const Eigen::Quaterniond given(*q[0], *q[1], *q[2], *q[3]);
      if (given.norm() > kLeastTurn && std::isfinite(given.norm())) reading.state.orientation = given.normalized();
    }
  }
  const json* buttons = find(state, "buttons");
  for (std::size_t i = 0; buttons != nullptr && i < kButtons.size(); ++i) {
    const json* button = find(*buttons, kButtons[i]);
    if (button != nullptr && button->is_boolean() && button->get<bool>()) reading.state.buttons |= 1U << i;
  }
  reading.has_grip = true;
}

}  // namespace

std::optional<HaplyReading> parse_haply(std::string_view text, const std::string& device) {
  const json message = json::parse(text, nullptr, false);
  const json* arm = entry_of(message, "inverse3", device);
  const json* state = arm == nullptr ? nullptr : find(*arm, "state");
  if (state == nullptr) return std::nullopt;
  const std::optional<Vec3> position = vector(*state, "cursor_position");
  if (!position) return std::nullopt;
  HaplyReading reading;
  reading.device = id_of(*arm);
  if (reading.device.empty()) return std::nullopt;
  reading.state.position = *position;
  reading.state.velocity = vector(*state, "cursor_velocity").value_or(Vec3::Zero());
  for (const char* grips : {"wireless_verse_grip", "verse_grip"}) {
    const json* grip = entry_of(message, grips, {});
    const json* of_grip = grip == nullptr ? nullptr : find(*grip, "state");
    if (of_grip == nullptr) continue;
    read_grip(*of_grip, reading);
    break;
  }
  return reading;
}

std::string haply_force(const std::string& device, const Vec3& force) {
  const Vec3 f = force.allFinite() ? force : Vec3(Vec3::Zero());
  const json values = {{"x", f.x()}, {"y", f.y()}, {"z", f.z()}};
  const json id = json::parse(device, nullptr, false);
  const json arm = {{"device_id", id.is_discarded() ? json() : id},
                    {"commands", {{"set_cursor_force", {{"values", values}}}}}};
  return json{{"inverse3", json::array({arm})}}.dump();
}

}  // namespace app
}  // namespace v0
}  // namespace incise
