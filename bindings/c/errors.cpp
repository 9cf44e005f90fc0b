// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <string_view>

#include "app/text/shortened.h"
#include "handles.h"
#include "incise/version.h"

namespace incise::c {
namespace {

struct LastError {
  incise_status code = INCISE_OK;
  std::string message;
  std::vector<std::uint64_t> ids;
};

LastError& last_error() {
  thread_local LastError error;
  return error;
}

const void* this_thread() {
  thread_local const char token = 0;
  return &token;
}

constexpr std::array<const char*, 8> kStatusNames = {"ok", "bad argument", "bad file", "unsupported", "out of memory",
                                                     "io", "internal",     "busy"};

incise_status keep(incise_status code, std::string_view message, std::vector<std::uint64_t> ids) {
  last_error() = {code, app::shortened(message), std::move(ids)};
  return code;
}

}  // namespace

incise_status fail(const Error& error) {
  static_assert(static_cast<int>(ErrorCode::kInternal) + 1 == INCISE_INTERNAL);
  return keep(static_cast<incise_status>(error.code) + 1, error.message, error.ids);
}

incise_status refuse(const std::string& message) {
  return keep(INCISE_BAD_ARGUMENT, message, {});
}

incise_status busy() {
  return keep(INCISE_BUSY,
              "another call on this handle has not returned yet: an engine, and what belongs to it, is for one thread "
              "at a time; wait for the call, or give each thread an engine",
              {});
}

incise_status finish(const Status& status) {
  return status.ok() ? INCISE_OK : fail(status.error());
}

incise_status give_text(const std::string& from, char* text, std::uint64_t room, std::uint64_t* count) {
  if (text == nullptr && room > 0) return refuse("the buffer is null, and its room is not 0");
  if (count != nullptr) *count = from.size() + 1;
  if (room == 0) return INCISE_OK;
  const std::size_t n = std::min<std::size_t>(room - 1, from.size());
  std::memcpy(text, from.data(), n);
  text[n] = 0;
  return INCISE_OK;
}

bool Turn::begin(bool only_looks) {
  const void* const me = this_thread();
  const void* owner = nullptr;
  if (thread_.compare_exchange_strong(owner, me, std::memory_order_acquire)) {
    depth_ = 1;
    return true;
  }
  if (owner != me || !only_looks || !lets_look_) return false;
  ++depth_;
  return true;
}

void Turn::end() {
  if (--depth_ > 0) return;
  lets_look_ = false;
  thread_.store(nullptr, std::memory_order_release);
}

incise_status check_size(std::uint32_t size, std::size_t known, std::size_t alignment, const char* name) {
  constexpr std::uint32_t kLeast = 8;
  const bool is_one = size >= kLeast && size % alignment == 0;
  if (is_one && size <= known) return INCISE_OK;
  const std::string begin = std::string(name) + ".size is " + std::to_string(size);
  if (!is_one) return refuse(begin + "; set it to sizeof(" + name + ") before the call");
  return refuse(begin + ", this library knows " + std::to_string(known) +
                " bytes: the program was built for a newer one; update the library");
}

}  // namespace incise::c

using incise::c::last_error;

uint32_t incise_abi(void) {
  return INCISE_ABI;
}

const char* incise_version(void) {
  return INCISE_VERSION;
}

const char* incise_status_name(incise_status status) {
  const auto& names = incise::c::kStatusNames;
  const auto index = static_cast<std::size_t>(status);
  return status >= 0 && index < names.size() ? names[index] : "unknown";
}

const char* incise_last_error(void) {
  return last_error().message.c_str();
}

incise_status incise_last_error_code(void) {
  return last_error().code;
}

uint64_t incise_last_error_ids(uint64_t* ids, uint64_t room) {
  const auto& all = last_error().ids;
  if (ids != nullptr) std::copy_n(all.begin(), std::min<std::uint64_t>(room, all.size()), ids);
  return all.size();
}
