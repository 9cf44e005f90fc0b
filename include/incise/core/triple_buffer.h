// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace incise {
inline namespace v0 {

/// Hands the newest value from one thread to another; neither waits, neither sees half a value.
///
/// Exactly one thread publishes and exactly one takes. Each owns one of three slots, and the third changes hands by an
/// atomic exchange, so both calls are wait-free: one copy of `T` and one exchange. Values that nobody took are lost:
/// only the newest counts. `T` is default-constructible and copied by `publish`; where its copy allocates, so does
/// that.
template <class T>
class TripleBuffer {
 public:
  /// With a value to be seen until one is published.
  explicit TripleBuffer(const T& initial = T{}) : slots_{Slot{initial}, Slot{initial}, Slot{initial}} {}
  TripleBuffer(const TripleBuffer&) = delete;
  TripleBuffer& operator=(const TripleBuffer&) = delete;
  ~TripleBuffer() = default;

  /// Makes `value` the newest. Producer thread only.
  void publish(const T& value) {
    slots_[back_].value = value;
    // Release: who takes the slot sees the value. Acquire: its last reader is done before it is written again.
    back_ = middle_.exchange(back_ | kFresh, std::memory_order_acq_rel) & kSlotMask;
  }
  /// Takes the newest value, if there is one that was not taken yet; `value` then is that one. Consumer thread only.
  bool take() {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kSlotMask;
    return true;
  }
  /// What `take` took last; the initial value before. Stays valid until the next `take`. Consumer thread only.
  [[nodiscard]] const T& value() const { return slots_[front_].value; }

 private:
  static constexpr std::uint32_t kSlotMask = 3;
  static constexpr std::uint32_t kFresh = 4;
  /// Two threads write two slots at once: on lines of their own they do not slow each other down.
  struct alignas(64) Slot {
    T value;
  };

  std::array<Slot, 3> slots_;
  alignas(64) std::uint32_t back_ = 0;   ///< the producer's
  alignas(64) std::uint32_t front_ = 1;  ///< the consumer's
  alignas(64) std::atomic<std::uint32_t> middle_{2};
};

}  // namespace v0
}  // namespace incise
