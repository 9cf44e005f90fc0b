// SPDX-License-Identifier: Apache-2.0
// Ghosts are drawn twice: depths alone, then colours where the depth is equal, so that only the nearest triangles are
// seen.
#include "render/solids_pass.h"

#include <epoxy/gl.h>

#include <string>

#include "render/solid_shaders.h"
#include "render/thread_timer.h"

namespace incise {
inline namespace v0 {
namespace render {
namespace {

constexpr int kSolidsShadowUnit = 3;  // beside those of the surface

void attach(unsigned place, int count, unsigned type, bool is_share, std::size_t offset) {
  glVertexAttribPointer(place, count, type, is_share ? GL_TRUE : GL_FALSE, sizeof(app::SolidCorner),
                        reinterpret_cast<const void*>(offset));
  glEnableVertexAttribArray(place);
}

}  // namespace

Result<SolidsPass> SolidsPass::create() {
  const std::string fragment = std::string(kShadowFunction) + kSolidFragment;
  auto plain = make_program("solids", "", kSolidVertex, fragment);
  if (!plain.ok()) return plain.error();
  auto shadowed = make_program("solids with shadows", kShadowLookup, kSolidVertex, fragment);
  if (!shadowed.ok()) return shadowed.error();
  SolidsPass pass;
  pass.plain_ = std::move(plain).value();
  pass.shadowed_ = std::move(shadowed).value();
  pass.set_up();
  return pass;
}

void SolidsPass::set_up() {
  buffer_ = MirroredBuffer(GL_ARRAY_BUFFER);
  array_ = make_vertex_array();
  glBindVertexArray(array_.id());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  attach(0, 3, GL_FLOAT, false, offsetof(app::SolidCorner, at));
  attach(1, 3, GL_FLOAT, false, offsetof(app::SolidCorner, normal));
  attach(2, 4, GL_UNSIGNED_BYTE, true, offsetof(app::SolidCorner, finish) + offsetof(app::Finish, color));
  attach(3, 1, GL_FLOAT, false, offsetof(app::SolidCorner, finish) + offsetof(app::Finish, gloss));
  glBindVertexArray(0);
}

void SolidsPass::upload(const app::Picture& picture, DrawStatistics& statistics) {
  ThreadTimer watch;
  rows_.gather(picture);
  const std::vector<app::SolidCorner>& corners = rows_.corners();
  statistics.compare_ms += watch.lap();
  statistics.bytes_uploaded += buffer_.update(corners.data(), corners.size(), sizeof(app::SolidCorner));
  statistics.upload_ms += watch.lap();
}

void SolidsPass::use(const GlObject& program, const ViewMatrices& view) const {
  glUseProgram(program.id());
  glUniformMatrix4fv(location(program, "to_view"), 1, GL_FALSE, view.to_view.data());
  glUniformMatrix4fv(location(program, "to_clip"), 1, GL_FALSE, view.to_clip.data());
  glBindVertexArray(array_.id());
}

void SolidsPass::draw_opaque(const ViewMatrices& view, const ShadowPass* shadows) const {
  if (rows_.opaque() == 0) return;
  use(shadows != nullptr ? shadowed_ : plain_, view);
  if (shadows != nullptr) shadows->bind(shadowed_, kSolidsShadowUnit);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(rows_.opaque()));
}

void SolidsPass::draw_ghosts(const ViewMatrices& view) const {
  if (rows_.corners().size() == rows_.opaque()) return;
  use(plain_, view);
  const auto first = static_cast<GLint>(rows_.opaque());
  const auto count = static_cast<GLsizei>(rows_.corners().size() - rows_.opaque());
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glDrawArrays(GL_TRIANGLES, first, count);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glEnable(GL_BLEND);
  glDrawArrays(GL_TRIANGLES, first, count);
  glDisable(GL_BLEND);
}

void SolidsPass::draw_shadows() const {
  if (rows_.corners().size() == rows_.ground()) return;
  glBindVertexArray(array_.id());
  glDrawArrays(GL_TRIANGLES, static_cast<GLint>(rows_.ground()),
               static_cast<GLsizei>(rows_.corners().size() - rows_.ground()));
}

}  // namespace render
}  // namespace v0
}  // namespace incise
