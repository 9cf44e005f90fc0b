// SPDX-License-Identifier: Apache-2.0
// The order of passes for one picture: shadows, background, solids, body with its hollows, marks, translucent skin.
// All is checked before anything is drawn.
#include "render/renderer.h"

#include <epoxy/gl.h>

#include <cmath>
#include <numbers>

#include "render/background_pass.h"
#include "render/canvas.h"
#include "render/marks_pass.h"
#include "render/occlusion_pass.h"
#include "render/scene_box.h"
#include "render/shadow_pass.h"
#include "render/solids_pass.h"
#include "render/surface_pass.h"
#include "render/thread_timer.h"
#include "render/view_matrices.h"
#include "render/viewport_check.h"

namespace incise {
inline namespace v0 {
namespace render {
namespace {

constexpr unsigned kMostSamples = 16;
constexpr int kLeastVersion = 33;      // of OpenGL
constexpr float kShadowReach = 1.25F;  // of the body's half diagonal

Error bad_argument(const std::string& what) {
  return {ErrorCode::kBadArgument, what, {}};
}

bool is_finite(const Box& box) {
  return box.is_empty() || (box.lo.allFinite() && box.hi.allFinite());
}

Status check_camera(const app::Camera& camera) {
  const bool is_sane = camera.target.allFinite() && std::isfinite(camera.distance) && camera.distance > 0 &&
                       std::isfinite(camera.azimuth) && std::isfinite(camera.elevation) &&
                       std::abs(camera.up.norm() - 1) < 1e-3 && camera.field_of_view > 0 &&
                       camera.field_of_view < std::numbers::pi;
  if (is_sane && camera.to_view().allFinite()) return {};
  return bad_argument("the camera is not finite or out of range; frame the scene anew");
}

Status check_options(const app::ViewOptions& options) {
  if (options.skin_opacity > 0 && options.skin_opacity <= 1) return {};
  return bad_argument("the skin's opacity must be above 0 and at most 1");
}

double size_of(const Box& box, const app::Camera& camera) {
  const double size = box.is_empty() ? 0 : (box.hi - box.lo).norm();
  return size > 0 ? size : camera.distance;
}

/// Where colours tell a number, a shadow would tell another.
bool has_shadows(const app::ViewOptions& options) {
  return options.shows_shadows && options.color == app::ColorBy::kTissue;
}

Result<ViewMatrices> make_view(const app::Picture& picture, const app::Viewport& viewport, const Box& body) {
  const Box scene = box_of_all(picture, body);
  ViewMatrices view;
  view.to_view = picture.camera.to_view().cast<float>();
  view.to_clip = to_clip(picture.camera, viewport, scene).cast<float>();
  view.viewport = viewport;
  view.pixel_scale = static_cast<float>(2 * std::tan(0.5 * picture.camera.field_of_view) / viewport.height);
  view.scene_size = static_cast<float>(size_of(body.is_empty() ? scene : body, picture.camera));
  if (view.to_view.allFinite() && view.to_clip.allFinite() && std::isfinite(view.scene_size)) return view;
  return bad_argument("the scene is too large or too small to be drawn from here; frame it anew");
}

void prepare(const Canvas& canvas) {
  canvas.bind();
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glEnable(GL_MULTISAMPLE);
  glFrontFace(GL_CCW);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glClear(GL_DEPTH_BUFFER_BIT);
}

}  // namespace

struct Renderer::State {
  unsigned wanted_samples = 0;
  Canvas canvas;
  BackgroundPass background;
  SurfacePass surface;
  OcclusionPass occlusion;
  MarksPass marks;
  SolidsPass solids;
  ShadowPass shadows;
  DrawStatistics statistics;

  Status draw(const app::Picture& picture, const app::Viewport& viewport, unsigned framebuffer);

 private:
  Status draw_body(const app::ViewOptions& options, const ViewMatrices& view);
  Status draw_shadows(const app::Picture& picture, const ViewMatrices& view, const Box& body);
  Status draw_passes(const app::Picture& picture, const ViewMatrices& view);
};

Status Renderer::State::draw_shadows(const app::Picture& picture, const ViewMatrices& view, const Box& body) {
  if (!has_shadows(picture.options) || body.is_empty()) return {};
  const Vec3 centre = 0.5 * (body.lo + body.hi), half = 0.5 * (body.hi - body.lo);
  const float radius = kShadowReach * static_cast<float>(half.norm());
  if (!(radius > 0)) return {};
  if (Status status = shadows.begin(view, centre.cast<float>(), radius); !status.ok()) return status;
  if (picture.options.shows_surface && statistics.triangles > 0) surface.draw_shadows();
  solids.draw_shadows();
  shadows.end();
  return {};
}

Status Renderer::State::draw_body(const app::ViewOptions& options, const ViewMatrices& view) {
  if (!options.shows_surface) return {};
  surface.draw_opaque(options, view, has_shadows(options) ? &shadows : nullptr);
  if (!options.shows_occlusion) return {};
  return occlusion.draw(canvas, view, options.color == app::ColorBy::kTissue);
}

// Marks come before translucent skin, which then tones those that are behind it.
Status Renderer::State::draw_passes(const app::Picture& picture, const ViewMatrices& view) {
  const app::ViewOptions& options = picture.options;
  prepare(canvas);
  background.draw(options.theme);
  if (options.shows_surface) solids.draw_opaque(view, has_shadows(options) ? &shadows : nullptr);
  if (statistics.triangles > 0) {
    if (const Status status = draw_body(options, view); !status.ok()) return status;
  }
  if (options.shows_surface) solids.draw_ghosts(view);
  marks.draw(options.theme, view);
  if (statistics.triangles == 0) return {};
  if (options.shows_surface && options.skin_opacity < 1) surface.draw_translucent(options, view);
  if (options.shows_wireframe) surface.draw_wireframe(options, view);
  return {};
}

Status Renderer::State::draw(const app::Picture& picture, const app::Viewport& viewport, unsigned framebuffer) {
  statistics = {};
  ThreadTimer watch;
  const Box body = picture.surface.topology ? bounds_of(picture.surface) : Box{};
  if (!is_finite(body)) return bad_argument("the surface has a point that is not finite");
  const Result<ViewMatrices> view = make_view(picture, viewport, body);
  if (!view.ok()) return view.error();
  statistics.compare_ms += watch.lap();
  if (Status status = canvas.fit(viewport, wanted_samples); !status.ok()) return status;
  if (Status status = surface.upload(picture.surface, statistics); !status.ok()) return status;
  marks.upload(picture, statistics);
  solids.upload(picture, statistics);
  watch.lap();
  if (Status status = draw_shadows(picture, *view, body); !status.ok()) return status;
  const Status status = draw_passes(picture, *view);
  canvas.show(framebuffer);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glBindVertexArray(0);
  glUseProgram(0);
  statistics.submit_ms = watch.lap();
  return status.ok() ? check_gl("drawing") : status;
}

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::create(unsigned samples) {
  if (samples > kMostSamples) return bad_argument("samples per pixel must be at most 16");
  if (epoxy_gl_version() < kLeastVersion) {
    return Error{ErrorCode::kUnsupported, "drawing needs OpenGL 3.3; update the graphics driver", {}};
  }
  auto background = BackgroundPass::create();
  if (!background.ok()) return background.error();
  auto surface = SurfacePass::create();
  if (!surface.ok()) return surface.error();
  auto occlusion = OcclusionPass::create();
  if (!occlusion.ok()) return occlusion.error();
  auto marks = MarksPass::create();
  if (!marks.ok()) return marks.error();
  auto solids = SolidsPass::create();
  if (!solids.ok()) return solids.error();
  auto shadows = ShadowPass::create();
  if (!shadows.ok()) return shadows.error();
  auto state = std::make_unique<State>();
  state->solids = std::move(solids).value();
  state->shadows = std::move(shadows).value();
  state->wanted_samples = samples;
  state->background = std::move(background).value();
  state->surface = std::move(surface).value();
  state->occlusion = std::move(occlusion).value();
  state->marks = std::move(marks).value();
  if (const Status status = check_gl("making a renderer"); !status.ok()) return status.error();
  return Renderer(std::move(state));
}

Status Renderer::draw(const app::Picture& picture, const app::Viewport& viewport, unsigned framebuffer) {
  state_->statistics = {};
  if (Status status = check_viewport(viewport); !status.ok()) return status;
  if (Status status = check_camera(picture.camera); !status.ok()) return status;
  if (Status status = check_options(picture.options); !status.ok()) return status;
  return state_->draw(picture, viewport, framebuffer);
}

const DrawStatistics& Renderer::statistics() const {
  return state_->statistics;
}

unsigned Renderer::samples() const {
  return state_->canvas.samples();
}

}  // namespace render
}  // namespace v0
}  // namespace incise
