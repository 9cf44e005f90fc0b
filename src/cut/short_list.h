// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

namespace incise {
inline namespace v0 {

/// A list of at most `kMost` values that lies where it is named: no memory is asked for, and it may be copied as bytes.
template <class T, std::size_t kMost>
class ShortList {
 public:
  void push_back(const T& value) {
    assert(size_ < kMost);
    values_[size_++] = value;
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  // NOLINTNEXTLINE(google-explicit-constructor): a view
  operator std::span<const T>() const { return {values_.data(), size_}; }
  [[nodiscard]] const T* begin() const { return values_.data(); }
  [[nodiscard]] const T* end() const { return values_.data() + size_; }
  const T& operator[](std::size_t i) const {
    assert(i < size_);
    return values_[i];
  }
  [[nodiscard]] const T& back() const { return (*this)[size_ - std::size_t{1}]; }

 private:
  std::array<T, kMost> values_{};
  std::uint8_t size_ = 0;
  static_assert(kMost < 256);
};

}  // namespace v0
}  // namespace incise
