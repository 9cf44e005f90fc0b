// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "render/gl_object.h"

namespace incise {
inline namespace v0 {
namespace render {

/// Bytes on the graphics processor with a copy here, to upload only what differs.
class MirroredBuffer {
 public:
  static constexpr std::size_t kBlock = 4096;  ///< elements that are compared and uploaded together

  MirroredBuffer() = default;
  explicit MirroredBuffer(unsigned target) : target_(target), buffer_(make_buffer()) {}

  /// Makes the buffer hold `count` elements of `stride` bytes. Returns the bytes uploaded; 0 where nothing differs.
  /// Cost: comparing, and copying what differs; about 0.1 ms per MB each.
  std::size_t update(const void* data, std::size_t count, std::size_t stride);

  [[nodiscard]] unsigned id() const { return buffer_.id(); }

 private:
  struct Range {
    std::size_t begin = 0, end = 0;  // bytes
  };

  void find_changes(const unsigned char* data, std::size_t size, std::size_t block);
  std::size_t replace(const unsigned char* data, std::size_t size);

  unsigned target_ = 0;
  GlObject buffer_;
  std::vector<unsigned char> copy_;
  std::vector<Range> changes_;  // scratch
  std::size_t capacity_ = 0;    // of the buffer, bytes
};

}  // namespace render
}  // namespace v0
}  // namespace incise
