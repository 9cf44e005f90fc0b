// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

#include "app/view/picture.h"
#include "incise/core/result.h"

namespace incise {
inline namespace v0 {
namespace render {

/// What one `Renderer::draw` did. Times are processor time of the calling thread, in ms, and leave out what the
/// graphics processor does meanwhile; a software renderer does part of its work in the calling thread, within
/// `submit_ms`.
struct DrawStatistics {
  std::size_t bytes_uploaded = 0;  ///< into buffers; 0 where the picture is the same but for the camera
  std::size_t triangles = 0;       ///< slots of the surface, free ones left out
  std::size_t points = 0;          ///< of the surface
  std::size_t marks = 0;           ///< lines (front edges among them), stretches of rims, balls and triangles
  double compare_ms = 0;           ///< finding what changed, and the bounds
  double normals_ms = 0;
  double upload_ms = 0;
  double submit_ms = 0;  ///< giving the commands

  [[nodiscard]] double cpu_ms() const { return compare_ms + normals_ms + upload_ms + submit_ms; }
};

/// Draws pictures with OpenGL 3.3 core, in the context that was current when it was created.
///
/// Uploads only what changed since the last picture: blocks of 4096 triangles or points that differ. Normals are
/// averaged anew when points or triangles changed. In colours that tell a number (`ColorBy` other than kTissue) walls
/// are not tinted as newest: the tint would tell another number. Must be destroyed while its context is current.
class Renderer {
 public:
  /// Compiles the shaders. Errors: kUnsupported without a current context of OpenGL 3.3 or where a shader does not
  /// compile, with the driver's log. `samples`, in [0, 16], smooth the edges; fewer where the context has fewer.
  static Result<Renderer> create(unsigned samples = 4);

  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  /// Draws a picture into the lower left of a framebuffer, 0 for the window's. Leaves that framebuffer bound, blending
  /// and the depth test off, and no program or vertex array bound.
  ///
  /// Errors, with nothing drawn: kBadArgument for a viewport out of range, a camera, opacity or points that are not
  /// finite or out of their documented ranges, or triangles with points that there are not; kUnsupported for more
  /// triangles than the context can look up; kOutOfMemory; kInternal where OpenGL reports an error.
  /// Cost: the calling thread about 7 ns per triangle where all points moved.
  Status draw(const app::Picture& picture, const app::Viewport& viewport, unsigned framebuffer);

  /// Of the last `draw`.
  [[nodiscard]] const DrawStatistics& statistics() const;
  /// Samples per pixel in use; 0 for none.
  [[nodiscard]] unsigned samples() const;

 private:
  struct State;
  explicit Renderer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace render
}  // namespace v0
}  // namespace incise
