// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace incise {
inline namespace v0 {

/// Why a call did not do what was asked.
enum class ErrorCode : std::uint8_t {
  kBadArgument,  ///< an argument is outside its documented range
  kBadFile,      ///< a file cannot be opened, or its content is not what its format promises
  kUnsupported,  ///< well formed, but of a kind that Incise does not handle
  kOutOfMemory,  ///< an allocation or an id range would be exceeded
  kIo,           ///< writing failed
  kInternal,     ///< a broken invariant: the step was rolled back
};

/// What went wrong, where, and how to mend it.
struct Error {
  ErrorCode code = ErrorCode::kInternal;  ///< which kind of failure
  std::string message;                    ///< one line that names the place and the remedy
  std::vector<std::uint64_t> ids = {};    ///< offending elements (at most a few), meaning given by the message
};

/// Either a value or an error. The library never throws across its public API.
template <class T>
class [[nodiscard]] Result {
 public:
  /// Success, with its value.
  Result(T value) : value_(std::move(value)) {}  // NOLINT(google-explicit-constructor)
  /// A failure.
  Result(Error error) : error_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

  /// Whether there is a value.
  [[nodiscard]] bool ok() const { return value_.has_value(); }
  /// The same as `ok`.
  explicit operator bool() const { return ok(); }
  /// The value; only where `ok()`.
  T& value() & { return *value_; }
  /// The same, to read.
  const T& value() const& { return *value_; }
  /// The same, to be moved from.
  T&& value() && { return std::move(*value_); }
  /// The value; only where `ok()`.
  T& operator*() & { return *value_; }
  /// The value; only where `ok()`.
  const T& operator*() const& { return *value_; }
  /// A member of the value; only where `ok()`.
  T* operator->() { return &*value_; }
  /// A member of the value; only where `ok()`.
  const T* operator->() const { return &*value_; }
  /// The error; only where not `ok()`.
  [[nodiscard]] const Error& error() const { return error_; }

 private:
  std::optional<T> value_;
  Error error_;
};

/// The result of a call that returns nothing but success.
class [[nodiscard]] Status {
 public:
  /// Success.
  Status() = default;
  /// A failure.
  Status(Error error) : error_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

  /// Whether all went well.
  [[nodiscard]] bool ok() const { return !error_.has_value(); }
  /// The same as `ok`.
  explicit operator bool() const { return ok(); }
  /// The error; only where not `ok()`.
  [[nodiscard]] const Error& error() const { return *error_; }

 private:
  std::optional<Error> error_;
};

}  // namespace v0
}  // namespace incise
