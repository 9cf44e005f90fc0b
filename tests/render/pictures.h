// SPDX-License-Identifier: Apache-2.0
// Pictures for tests, and where to draw them.
#pragma once

#include <memory>
#include <string>

#include "app/view/picture.h"
#include "incise/engine/engine.h"
#include "render/headless_context.h"
#include "render/offscreen_target.h"
#include "render/renderer.h"

namespace incise_test {

inline constexpr incise::app::Viewport kSmall{320, 240};

/// A unit cube with a wound from above to half its depth, held open, and a second one beside it.
class WoundedCube {
 public:
  WoundedCube();
  /// Seen obliquely from above, all of it.
  [[nodiscard]] incise::app::Picture picture() const { return picture(incise::app::SurfaceOptions{}); }
  [[nodiscard]] incise::app::Picture picture(const incise::app::SurfaceOptions& options) const;

 private:
  void cut(double x, double depth);
  void open(incise::app::SurfaceFrame& frame) const;

  std::unique_ptr<incise::Engine> engine_;
};

/// A wavy sheet of `2·n²` triangles at `(n+1)²` points.
incise::app::Picture sheet(std::uint32_t n);
/// The same topology, as another object.
std::shared_ptr<incise::app::SurfaceTopology> copy_of(const incise::app::SurfaceFrame& frame);

/// A context, a renderer and a target that are there for as long as a test.
class Drawing {
 public:
  /// Why there is none; empty where there is.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }
  explicit Drawing(const incise::app::Viewport& viewport = kSmall, unsigned samples = 4);
  ~Drawing();
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  incise::Status draw(const incise::app::Picture& picture);
  [[nodiscard]] incise::render::Image read() const;
  [[nodiscard]] const incise::render::DrawStatistics& statistics() const { return renderer_->statistics(); }
  [[nodiscard]] const incise::render::HeadlessContext& context() const { return *context_; }
  [[nodiscard]] incise::render::Renderer& renderer() { return *renderer_; }
  [[nodiscard]] const incise::render::OffscreenTarget& target() const { return *target_; }
  /// What OpenGL complained about, through its error and its messages.
  [[nodiscard]] std::string complaints() const;

 private:
  void listen();

  std::string trouble_;
  incise::app::Viewport viewport_;
  std::unique_ptr<std::string> messages_ = std::make_unique<std::string>();
  std::unique_ptr<incise::render::HeadlessContext> context_;
  std::unique_ptr<incise::render::Renderer> renderer_;
  std::unique_ptr<incise::render::OffscreenTarget> target_;
};

/// Ends a test visibly where nothing can be drawn.
#define INCISE_SKIP_WITHOUT(drawing) \
  if (!(drawing).trouble().empty()) GTEST_SKIP() << (drawing).trouble()

}  // namespace incise_test
