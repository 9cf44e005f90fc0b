// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>

namespace incise {
inline namespace v0 {

namespace detail {

/// Reserve `bytes` of address space that the system backs with zeros page by page on first touch; null where it cannot.
void* reserve_address_space(std::size_t bytes) noexcept;
void release_address_space(void* start, std::size_t bytes) noexcept;

/// Memory for up to 2^28 values that grows in place: address space is reserved once. Where that fails (WebAssembly, a
/// limit on virtual memory) it falls back to doubling. Memory that was never written is zero.
template <class T>
class ReservedBlock {
  static_assert(std::is_trivially_destructible_v<T>, "elements are moved as bytes");

 public:
  static constexpr std::size_t kReservedCount = std::size_t{1} << 28U;

  ReservedBlock() = default;
  ReservedBlock(const ReservedBlock&) = delete;
  ReservedBlock& operator=(const ReservedBlock&) = delete;
  ~ReservedBlock() { release(); }

  [[nodiscard]] T* data() const { return data_; }
  [[nodiscard]] std::size_t capacity() const { return capacity_; }
  [[nodiscard]] bool is_mapped() const { return is_mapped_; }

  /// Makes room for `count` values; the first `kept` keep their bytes.
  void grow(std::size_t count, std::size_t kept) {
    if (data_ == nullptr && count <= kReservedCount) {
      if (void* start = reserve_address_space(kReservedCount * sizeof(T))) {
        data_ = static_cast<T*>(start);
        capacity_ = kReservedCount;
        is_mapped_ = true;
        return;
      }
    }
    const std::size_t capacity = count + count / 2 + 16;
    T* larger = static_cast<T*>(::operator new(capacity * sizeof(T)));
    std::memset(static_cast<void*>(larger), 0, capacity * sizeof(T));
    if (kept > 0) {
      std::memcpy(static_cast<void*>(larger), data_, kept * sizeof(T));
    }
    release();
    data_ = larger;
    capacity_ = capacity;
  }
  void release() noexcept {
    if (is_mapped_) {
      release_address_space(data_, capacity_ * sizeof(T));
    } else {
      ::operator delete(static_cast<void*>(data_));
    }
    data_ = nullptr;
    capacity_ = 0;
    is_mapped_ = false;
  }
  void swap(ReservedBlock& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(capacity_, other.capacity_);
    std::swap(is_mapped_, other.is_mapped_);
  }

 private:
  T* data_ = nullptr;
  std::size_t capacity_ = 0;
  bool is_mapped_ = false;
};

}  // namespace detail

/// A growing array of plain values (ids, numbers, small vectors: anything that may be moved as bytes) that does not
/// copy itself while it grows, so that an array of ten million tets grows during a stroke without a stall.
///
/// Indexing is checked in debug builds. Not thread-safe for writers.
template <class T>
class GrowArray {
 public:
  static constexpr std::size_t kReservedCount =
      detail::ReservedBlock<T>::kReservedCount;  ///< elements that have their place reserved

  GrowArray() = default;
  GrowArray(const GrowArray& other) { assign(other); }
  GrowArray(GrowArray&& other) noexcept { swap(other); }
  GrowArray& operator=(const GrowArray& other) {
    if (this != &other) {
      size_ = 0;
      assign(other);
    }
    return *this;
  }
  GrowArray& operator=(GrowArray&& other) noexcept {
    swap(other);
    return *this;
  }
  ~GrowArray() = default;

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  /// Whether the elements stay where they are while the array grows, to `kReservedCount` of them.
  [[nodiscard]] bool has_stable_address() const { return block_.is_mapped(); }
  [[nodiscard]] T* data() { return block_.data(); }
  [[nodiscard]] const T* data() const { return block_.data(); }
  [[nodiscard]] T* begin() { return data(); }
  [[nodiscard]] T* end() { return data() + size_; }
  [[nodiscard]] const T* begin() const { return data(); }
  [[nodiscard]] const T* end() const { return data() + size_; }

  T& operator[](std::size_t i) {
    assert(i < size_);
    return data()[i];
  }
  const T& operator[](std::size_t i) const {
    assert(i < size_);
    return data()[i];
  }
  T& back() { return (*this)[size_ - 1]; }

  void push_back(const T& value) {
    if (size_ == block_.capacity()) {
      const T copy = value;  // it may live in this very array
      block_.grow(size_ + 1, size_);
      data()[size_++] = copy;
      return;
    }
    data()[size_++] = value;
  }
  void pop_back() { --size_; }
  void clear() { size_ = 0; }
  /// New elements are copies of `value`; the others stay.
  void resize(std::size_t count, const T& value = T{}) {
    const T copy = value;
    if (count > block_.capacity()) {
      block_.grow(count, size_);
    }
    for (std::size_t i = size_; i < count; ++i) {
      data()[i] = copy;
    }
    size_ = count;
  }
  void swap(GrowArray& other) noexcept {
    block_.swap(other.block_);
    std::swap(size_, other.size_);
  }

 private:
  void assign(const GrowArray& other) {
    if (other.size_ > block_.capacity()) {
      block_.grow(other.size_, 0);
    }
    if (other.size_ > 0) {
      std::memcpy(static_cast<void*>(data()), other.data(), other.size_ * sizeof(T));
    }
    size_ = other.size_;
  }

  detail::ReservedBlock<T> block_;
  std::size_t size_ = 0;
};

/// Numbers by slot that all start at zero and cost memory only where they were written.
///
/// For marks on a mesh of any size: construction is O(1) where address space can be reserved, O(slots) elsewhere.
/// Whoever keeps one for reuse sets the entries that it wrote back to zero, since fresh pages cost more than that.
template <class T>
class ZeroedArray {
 public:
  ZeroedArray() = default;
  /// With elements [0, count) addressable.
  explicit ZeroedArray(std::size_t count) { ensure(count); }
  /// A copy starts all zero: marks belong to one search on one object.
  ZeroedArray(const ZeroedArray& /*other*/) {}
  ZeroedArray& operator=(const ZeroedArray& other) {
    if (this != &other) {
      block_.release();
    }
    return *this;
  }
  ZeroedArray(ZeroedArray&& other) noexcept { block_.swap(other.block_); }
  ZeroedArray& operator=(ZeroedArray&& other) noexcept {
    block_.swap(other.block_);
    return *this;
  }
  ~ZeroedArray() = default;

  /// Makes elements [0, count) addressable.
  void ensure(std::size_t count) {
    if (count > block_.capacity()) {
      block_.grow(count, block_.capacity());
    }
  }
  T& operator[](std::size_t i) {
    assert(i < block_.capacity());
    return block_.data()[i];
  }
  const T& operator[](std::size_t i) const {
    assert(i < block_.capacity());
    return block_.data()[i];
  }
  [[nodiscard]] std::size_t capacity() const { return block_.capacity(); }

 private:
  detail::ReservedBlock<T> block_;
};

}  // namespace v0
}  // namespace incise
