// SPDX-License-Identifier: Apache-2.0
#include "values.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace incise_web {

using incise::Error;
using incise::ErrorCode;
using incise::Result;
using incise::Status;
using incise::Vec3;

namespace {

const char* name_of(ErrorCode code) {
  constexpr std::array kNames = {"BadArgument", "BadFile", "Unsupported", "OutOfMemory", "Io", "Internal"};
  const auto i = static_cast<std::size_t>(code);
  return i < kNames.size() ? kNames[i] : "Internal";
}

}  // namespace

val to_error(const Error& error) {
  val made = val::global("Error").new_(error.message);
  val ids = val::array();
  for (const std::uint64_t id : error.ids) ids.call<void>("push", static_cast<double>(id));
  made.set("name", std::string("InciseError"));
  made.set("code", std::string(name_of(error.code)));
  made.set("ids", ids);
  return made;
}

val to_value(const Status& status) {
  return status.ok() ? val::undefined() : to_error(status.error());
}

val to_value(const Result<bool>& result) {
  return result.ok() ? val(*result) : to_error(result.error());
}

std::string to_hex(std::uint64_t hash) {
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash));
  return text.data();
}

val to_array(const Vec3& vector) {
  val array = val::array();
  for (int i = 0; i < 3; ++i) array.call<void>("push", vector[i]);
  return array;
}

val to_bytes(std::string_view bytes) {
  val copy = val::global("Uint8Array").new_(bytes.size());
  copy.call<void>(
      "set", val(emscripten::typed_memory_view(bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()))));
  return copy;
}

std::string from_bytes(const val& bytes) {
  const auto length = bytes["length"].as<std::size_t>();
  std::string text(length, '\0');
  val view(emscripten::typed_memory_view(length, reinterpret_cast<std::uint8_t*>(text.data())));
  view.call<void>("set", bytes);
  return text;
}

Result<Vec3> to_vec3(const val& array, const char* what) {
  Vec3 vector;
  for (int i = 0; i < 3; ++i) {
    const val number = array.isUndefined() || array.isNull() ? val::undefined() : array[i];
    vector[i] = number.isNumber() ? number.as<double>() : NAN;
  }
  if (vector.allFinite()) return vector;
  return Error{ErrorCode::kBadArgument, std::string(what) + " has to be an array of three finite numbers", {}};
}

}  // namespace incise_web
