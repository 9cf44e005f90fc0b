// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace incise {
inline namespace v0 {

/// An array that remembers what a batch of writes changed, so that it can be taken back and done again.
template <class T>
class LoggedArray {
 public:
  /// What a batch changed: the values on the other side of it.
  struct Log {
    std::size_t size_before = 0, size_after = 0;
    std::vector<std::pair<std::uint32_t, T>> written;  // slots that were there before
    std::vector<T> appended;                           // those that the batch appended, while it is undone
  };

  [[nodiscard]] const std::vector<T>& items() const { return items_; }
  [[nodiscard]] std::size_t size() const { return items_.size(); }
  const T& operator[](std::size_t slot) const { return items_[slot]; }

  void begin() {
    ++batch_;
    log_ = {};
    log_.size_before = items_.size();
    marks_.resize(items_.size(), 0);
  }
  Log end() {
    log_.size_after = items_.size();
    return std::move(log_);
  }
  /// The value of a slot, to be changed within a batch.
  T& write(std::uint32_t slot) {
    if (slot < log_.size_before && marks_[slot] != batch_) {
      marks_[slot] = batch_;
      log_.written.emplace_back(slot, items_[slot]);
    }
    return items_[slot];
  }
  /// A new slot.
  std::uint32_t append(T value) {
    items_.push_back(std::move(value));
    return static_cast<std::uint32_t>(items_.size() - 1);
  }

  void undo(Log& log) {
    swap_written(log);
    for (std::size_t i = log.size_before; i < items_.size(); ++i) log.appended.push_back(std::move(items_[i]));
    items_.resize(log.size_before);
  }
  void redo(Log& log) {
    for (T& value : log.appended) items_.push_back(std::move(value));
    log.appended.clear();
    swap_written(log);
  }

 private:
  void swap_written(Log& log) {
    for (auto& [slot, value] : log.written) std::swap(items_[slot], value);
  }

  std::vector<T> items_;
  std::vector<std::uint64_t> marks_;  // the batch that wrote a slot
  std::uint64_t batch_ = 0;
  Log log_;
};

}  // namespace v0
}  // namespace incise
