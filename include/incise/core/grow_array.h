// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

namespace incise::inline v0 {

namespace detail {
/// Reserve `bytes` of address space that the system backs page by page on first touch; null where it cannot.
void* reserve_address_space(std::size_t bytes) noexcept;
void release_address_space(void* start, std::size_t bytes) noexcept;
}  // namespace detail

/// A growing array of plain values (ids, numbers, small vectors: anything that may be moved as bytes) that does not
/// copy itself while it grows.
///
/// It reserves address space for `kReservedCount` elements once; pages are backed when first touched, so an array
/// of ten million tets grows during a stroke without a stall. Where address space cannot be reserved
/// (WebAssembly, a limit on virtual memory) it falls back to doubling. Indexing is checked in debug builds.
/// Not thread-safe for writers.
template <class T>
class GrowArray {
  static_assert(std::is_trivially_destructible_v<T>, "elements are moved as bytes");

 public:
  static constexpr std::size_t kReservedCount = std::size_t{1} << 28U;

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
  ~GrowArray() { release(); }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] T* data() { return data_; }
  [[nodiscard]] const T* data() const { return data_; }
  [[nodiscard]] T* begin() { return data_; }
  [[nodiscard]] T* end() { return data_ + size_; }
  [[nodiscard]] const T* begin() const { return data_; }
  [[nodiscard]] const T* end() const { return data_ + size_; }

  T& operator[](std::size_t i) {
    assert(i < size_);
    return data_[i];
  }
  const T& operator[](std::size_t i) const {
    assert(i < size_);
    return data_[i];
  }
  T& back() { return (*this)[size_ - 1]; }

  void push_back(const T& value) {
    if (size_ == capacity_) {
      const T copy = value;  // it may live in this very array
      grow(size_ + 1);
      data_[size_++] = copy;
      return;
    }
    data_[size_++] = value;
  }
  void pop_back() { --size_; }
  void clear() { size_ = 0; }
  /// New elements are copies of `value`; the others stay.
  void resize(std::size_t count, const T& value = T{}) {
    const T copy = value;
    if (count > capacity_) {
      grow(count);
    }
    for (std::size_t i = size_; i < count; ++i) {
      data_[i] = copy;
    }
    size_ = count;
  }
  void swap(GrowArray& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
    std::swap(is_mapped_, other.is_mapped_);
  }

 private:
  void assign(const GrowArray& other) {
    if (other.size_ > capacity_) {
      grow(other.size_);
    }
    if (other.size_ > 0) {
      std::memcpy(static_cast<void*>(data_), other.data_, other.size_ * sizeof(T));
    }
    size_ = other.size_;
  }
  void grow(std::size_t count) {
    if (data_ == nullptr && count <= kReservedCount) {
      if (void* start = detail::reserve_address_space(kReservedCount * sizeof(T))) {
        data_ = static_cast<T*>(start);
        capacity_ = kReservedCount;
        is_mapped_ = true;
        return;
      }
    }
    const std::size_t capacity = count + count / 2 + 16;
    T* larger = static_cast<T*>(::operator new(capacity * sizeof(T)));
    if (size_ > 0) {
      std::memcpy(static_cast<void*>(larger), data_, size_ * sizeof(T));
    }
    const std::size_t kept = size_;
    release();
    data_ = larger;
    size_ = kept;
    capacity_ = capacity;
  }
  void release() noexcept {
    if (is_mapped_) {
      detail::release_address_space(data_, capacity_ * sizeof(T));
    } else {
      ::operator delete(static_cast<void*>(data_));
    }
    data_ = nullptr;
    size_ = capacity_ = 0;
    is_mapped_ = false;
  }

  T* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
  bool is_mapped_ = false;
};

/// Numbers by slot that all start at zero and cost memory only where they were written.
///
/// For marks on a mesh of any size: construction is O(1) where address space can be reserved, O(slots) elsewhere.
/// Whoever keeps one for reuse sets the entries that it wrote back to zero, since fresh pages cost more than that.
template <class T>
class ZeroedArray {
 public:
  ZeroedArray() = default;
  explicit ZeroedArray(std::size_t count) { ensure(count); }
  /// A copy starts all zero: marks belong to one search on one object.
  ZeroedArray(const ZeroedArray& /*other*/) {}
  ZeroedArray& operator=(const ZeroedArray& other) {
    if (this != &other) {
      release();
    }
    return *this;
  }
  ZeroedArray(ZeroedArray&& other) noexcept { swap(other); }
  ZeroedArray& operator=(ZeroedArray&& other) noexcept {
    swap(other);
    return *this;
  }
  ~ZeroedArray() { release(); }

  /// Makes elements [0, count) addressable.
  void ensure(std::size_t count) {
    if (count > capacity_) {
      grow(count);
    }
  }
  T& operator[](std::size_t i) {
    assert(i < capacity_);
    return data_[i];
  }
  const T& operator[](std::size_t i) const {
    assert(i < capacity_);
    return data_[i];
  }
  [[nodiscard]] std::size_t capacity() const { return capacity_; }

 private:
  void grow(std::size_t count) {
    constexpr std::size_t kReserved = std::size_t{1} << 28U;
    if (data_ == nullptr && count <= kReserved) {
      if (void* start = detail::reserve_address_space(kReserved * sizeof(T))) {
        data_ = static_cast<T*>(start);
        capacity_ = kReserved;
        is_mapped_ = true;
        return;
      }
    }
    const std::size_t capacity = count + count / 2 + 16;
    T* larger = static_cast<T*>(::operator new(capacity * sizeof(T)));
    std::memset(static_cast<void*>(larger), 0, capacity * sizeof(T));
    if (capacity_ > 0) {
      std::memcpy(static_cast<void*>(larger), data_, capacity_ * sizeof(T));
    }
    release();
    data_ = larger;
    capacity_ = capacity;
  }
  void release() noexcept {
    if (is_mapped_) {
      detail::release_address_space(data_, capacity_ * sizeof(T));
    } else {
      ::operator delete(static_cast<void*>(data_));
    }
    data_ = nullptr;
    capacity_ = 0;
    is_mapped_ = false;
  }
  void swap(ZeroedArray& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(capacity_, other.capacity_);
    std::swap(is_mapped_, other.is_mapped_);
  }

  T* data_ = nullptr;
  std::size_t capacity_ = 0;
  bool is_mapped_ = false;
};

}  // namespace incise::inline v0
