// SPDX-License-Identifier: Apache-2.0
// Three framebuffers: several samples to draw to, one depth for each pixel to read from, and plain colours to show;
// what has no samples does without the first.
#include "render/canvas.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace incise {
inline namespace v0 {
namespace render {
namespace {

unsigned clamp_samples(unsigned wanted) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  const unsigned samples = std::min(wanted, static_cast<unsigned>(std::max(most, 0)));
  return samples < 2 ? 0 : samples;
}

GlObject make_storage(const app::Viewport& viewport, unsigned samples, GLenum format) {
  GlObject storage = make_renderbuffer();
  glBindRenderbuffer(GL_RENDERBUFFER, storage.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, static_cast<GLsizei>(samples), format, viewport.width,
                                   viewport.height);
  return storage;
}

bool is_complete() {
  return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

}  // namespace

Status Canvas::fit(const app::Viewport& viewport, unsigned samples) {
  samples = clamp_samples(samples);
  if (viewport.width == viewport_.width && viewport.height == viewport_.height && samples == samples_) return {};
  Status status = build(viewport, samples);
  if (!status.ok() && samples > 0) status = build(viewport, 0);
  if (!status.ok()) viewport_ = {0, 0};
  return status;
}

Status Canvas::build(const app::Viewport& viewport, unsigned samples) {
  viewport_ = viewport;
  samples_ = samples;
  build_plain();
  bool ok = is_complete();
  if (samples > 0) {
    build_sampled();
    ok = ok && is_complete();
  }
  build_depth();
  ok = ok && is_complete();
  const Status status = check_gl("making the picture's memory");
  if (!status.ok() || ok) return status;
  return Error{ErrorCode::kInternal, "the context cannot draw into a picture of this size", {}};
}

void Canvas::build_sampled() {
  sampled_color_ = make_storage(viewport_, samples_, GL_RGBA8);
  sampled_depth_ = make_storage(viewport_, samples_, GL_DEPTH_COMPONENT24);
  sampled_ = make_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, sampled_.id());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, sampled_color_.id());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, sampled_depth_.id());
}

void Canvas::build_plain() {
  color_ = make_storage(viewport_, 0, GL_RGBA8);
  plain_ = make_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, plain_.id());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_.id());
  if (samples_ > 0) return;
  plain_depth_ = make_storage(viewport_, 0, GL_DEPTH_COMPONENT24);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, plain_depth_.id());
}

void Canvas::build_depth() {
  depth_ = make_texture();
  glBindTexture(GL_TEXTURE_2D, depth_.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, viewport_.width, viewport_.height, 0, GL_DEPTH_COMPONENT,
               GL_UNSIGNED_INT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  depth_copy_ = make_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, depth_copy_.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.id(), 0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
}

void Canvas::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, drawn());
  glViewport(0, 0, viewport_.width, viewport_.height);
}

void Canvas::copy(unsigned from, unsigned to, unsigned what) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
  glBlitFramebuffer(0, 0, viewport_.width, viewport_.height, 0, 0, viewport_.width, viewport_.height, what, GL_NEAREST);
}

void Canvas::resolve_depth() const {
  copy(drawn(), depth_copy_.id(), GL_DEPTH_BUFFER_BIT);
  bind();
}

void Canvas::show(unsigned framebuffer) const {
  // Samples are averaged into the same format first: from several samples to another format not every driver copies.
  if (samples_ > 0) copy(sampled_.id(), plain_.id(), GL_COLOR_BUFFER_BIT);
  copy(plain_.id(), framebuffer, GL_COLOR_BUFFER_BIT);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

}  // namespace render
}  // namespace v0
}  // namespace incise
