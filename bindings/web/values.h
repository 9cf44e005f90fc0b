// SPDX-License-Identifier: Apache-2.0
// Values as JavaScript has them, and back.
#pragma once

#include <emscripten/val.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "incise/core/result.h"
#include "incise/geom/vec.h"

namespace incise_web {

using emscripten::val;

/// An `Error` with `name`, `code` and `ids`; whoever called throws it (bindings/web/index.mjs). It is returned and not
/// thrown here, since a JavaScript exception would pass C++ frames without running their destructors.
[[nodiscard]] val to_error(const incise::Error& error);
/// Undefined, or the error.
[[nodiscard]] val to_value(const incise::Status& status);
[[nodiscard]] val to_value(const incise::Result<bool>& result);

/// Sixteen hexadecimal digits, as recordings and reports write hashes.
[[nodiscard]] std::string to_hex(std::uint64_t hash);
[[nodiscard]] val to_array(const incise::Vec3& vector);
/// A `Uint8Array` of its own.
[[nodiscard]] val to_bytes(std::string_view bytes);
/// The bytes of a `Uint8Array`.
[[nodiscard]] std::string from_bytes(const val& bytes);
/// Three finite numbers. Errors: kBadArgument, naming `what`.
[[nodiscard]] incise::Result<incise::Vec3> to_vec3(const val& array, const char* what);

/// A view of the heap: what is behind it moves when memory grows, so it is to be copied before the next call.
template <class Number, class Item>
[[nodiscard]] val view_of(std::span<const Item> items) {
  static_assert(sizeof(Item) % sizeof(Number) == 0);
  return val(emscripten::typed_memory_view(items.size() * (sizeof(Item) / sizeof(Number)),
                                           reinterpret_cast<const Number*>(items.data())));
}
/// An array of numbers that JavaScript owns.
template <class Number>
[[nodiscard]] val copy_of(const char* type, const std::vector<Number>& numbers) {
  val copy = val::global(type).new_(numbers.size());
  copy.call<void>("set", view_of<Number>(std::span<const Number>(numbers)));
  return copy;
}

}  // namespace incise_web
