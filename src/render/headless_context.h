// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "incise/core/result.h"

namespace incise {
inline namespace v0 {
namespace render {

/// An OpenGL 3.3 core context without a window and without an X server, through EGL's surfaceless platform (Mesa).
///
/// Belongs to one thread at a time: the one that it was made current on. What was created in it must be destroyed
/// before it is, while it is current.
class HeadlessContext {
 public:
  /// Creates a context and makes it current on this thread. Errors: kUnsupported where a library or the platform is
  /// missing, naming the packages that bring them. Cost: tens of ms, at first.
  static Result<HeadlessContext> create();

  HeadlessContext(HeadlessContext&&) noexcept;
  HeadlessContext& operator=(HeadlessContext&&) noexcept;
  ~HeadlessContext();

  /// Makes it current on this thread. Errors: kInternal, for instance while another thread has it.
  Status make_current();
  /// For people, for instance "llvmpipe (LLVM 15.0.6, 256 bits)".
  [[nodiscard]] const std::string& renderer_name() const;
  /// Whether the processor draws.
  [[nodiscard]] bool is_software() const;

 private:
  struct State;
  explicit HeadlessContext(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Whether an OpenGL renderer of this name draws on the processor: llvmpipe, softpipe, SwiftShader.
[[nodiscard]] bool is_software_renderer(const std::string& name);

}  // namespace render
}  // namespace v0
}  // namespace incise
