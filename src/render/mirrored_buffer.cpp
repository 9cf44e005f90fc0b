// SPDX-License-Identifier: Apache-2.0
// Blocks are compared with the copy, and neighbouring ones that differ go up together; a buffer that changed by half
// is replaced.
#include "render/mirrored_buffer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstring>

namespace incise {
inline namespace v0 {
namespace render {

std::size_t MirroredBuffer::update(const void* data, std::size_t count, std::size_t stride) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  const std::size_t size = count * stride;
  if (size == 0) {
    copy_.clear();
    return 0;
  }
  find_changes(bytes, size, kBlock * stride);
  std::size_t changed = 0;
  for (const Range& range : changes_) changed += range.end - range.begin;
  // Whole buffers are replaced: the driver then takes new memory instead of waiting for what still draws from it.
  if (size > capacity_ || 2 * changed > size) return replace(bytes, size);
  copy_.resize(size);
  if (changed == 0) return 0;
  glBindBuffer(target_, buffer_.id());
  for (const auto [begin, end] : changes_) {
    std::memcpy(copy_.data() + begin, bytes + begin, end - begin);
    glBufferSubData(target_, static_cast<GLintptr>(begin), static_cast<GLsizeiptr>(end - begin), bytes + begin);
  }
  return changed;
}

void MirroredBuffer::find_changes(const unsigned char* data, std::size_t size, std::size_t block) {
  changes_.clear();
  for (std::size_t begin = 0; begin < size; begin += block) {
    const std::size_t end = std::min(begin + block, size);
    if (end <= copy_.size() && std::memcmp(copy_.data() + begin, data + begin, end - begin) == 0) continue;
    if (!changes_.empty() && changes_.back().end == begin) {
      changes_.back().end = end;
    } else {
      changes_.push_back({begin, end});
    }
  }
}

std::size_t MirroredBuffer::replace(const unsigned char* data, std::size_t size) {
  copy_.assign(data, data + size);
  glBindBuffer(target_, buffer_.id());
  if (size > capacity_) capacity_ = size + size / 4;  // room to grow in while a cut goes on
  glBufferData(target_, static_cast<GLsizeiptr>(capacity_), nullptr, GL_STREAM_DRAW);
  glBufferSubData(target_, 0, static_cast<GLsizeiptr>(size), data);
  return size;
}

}  // namespace render
}  // namespace v0
}  // namespace incise
