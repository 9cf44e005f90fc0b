// SPDX-License-Identifier: Apache-2.0
// OpenGL's names with owners. All of it needs the context in which it was made to be current.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "incise/core/result.h"

namespace incise {
inline namespace v0 {
namespace render {

/// An object of OpenGL, deleted with its owner.
class GlObject {
 public:
  using Delete = void (*)(unsigned);

  GlObject() = default;
  GlObject(unsigned id, Delete erase) : id_(id), erase_(erase) {}
  GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)), erase_(other.erase_) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(erase_, other.erase_);
    return *this;
  }
  ~GlObject() {
    if (id_ != 0) erase_(id_);
  }

  [[nodiscard]] unsigned id() const { return id_; }

 private:
  unsigned id_ = 0;
  Delete erase_ = nullptr;
};

GlObject make_buffer();
GlObject make_framebuffer();
GlObject make_renderbuffer();
GlObject make_texture();
GlObject make_vertex_array();

/// A vertex and a fragment shader. `name` stands for them in messages; `prelude` comes after the version line.
/// Errors: kUnsupported with the driver's log.
[[nodiscard]] Result<GlObject> make_program(std::string_view name, std::string_view prelude, std::string_view vertex,
                                            std::string_view fragment);
/// Of a program; -1, which OpenGL ignores, for one that the compiler has removed.
[[nodiscard]] int location(const GlObject& program, const char* uniform);

/// What OpenGL reports since it was last asked; it forgets it. Errors: kOutOfMemory, kInternal.
[[nodiscard]] Status check_gl(std::string_view doing);

}  // namespace render
}  // namespace v0
}  // namespace incise
