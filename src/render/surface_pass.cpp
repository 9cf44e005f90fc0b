// SPDX-License-Identifier: Apache-2.0
// Looks of triangles lie in a buffer texture that shaders read by the triangle's number, so that points can be shared
// by triangles of different looks.
#include "render/surface_pass.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "app/view/color_map.h"
#include "render/ink_style.h"
#include "render/noise.h"
#include "render/surface_shaders.h"
#include "render/thread_timer.h"

namespace incise {
inline namespace v0 {
namespace render {
namespace {

constexpr int kPaletteWidth = 256;
enum Unit : int { kLooksUnit, kPaletteUnit, kNoiseUnit, kShadowUnit };

GlObject make_noise() {
  const std::vector<std::uint8_t> values = noise_values();
  GlObject noise = make_texture();
  glBindTexture(GL_TEXTURE_3D, noise.id());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage3D(GL_TEXTURE_3D, 0, GL_R8, kNoiseSide, kNoiseSide, kNoiseSide, 0, GL_RED, GL_UNSIGNED_BYTE, values.data());
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return noise;
}

GlObject make_palette() {
  std::array<std::array<app::Color, kPaletteWidth>, 2> rows;
  for (std::size_t i = 0; i < rows[0].size(); ++i) {
    rows[0][i] = app::label_color(static_cast<std::uint32_t>(i));
    rows[1][i] = app::quality_color(static_cast<std::uint8_t>(i));
  }
  GlObject palette = make_texture();
  glBindTexture(GL_TEXTURE_2D, palette.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, kPaletteWidth, 2, 0, GL_RGB, GL_UNSIGNED_BYTE, rows.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return palette;
}

void attach(unsigned place, unsigned buffer, int floats) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glVertexAttribPointer(place, floats, GL_FLOAT, GL_FALSE, 0, nullptr);
  glEnableVertexAttribArray(place);
}

}  // namespace

Result<SurfacePass> SurfacePass::create() {
  SurfacePass pass;
  auto all = make_program("surface", "", kSurfaceVertex, kSurfaceFragment);
  if (!all.ok()) return all.error();
  auto some = make_program("part of the surface", "#define ONLY_SOME\n", kSurfaceVertex, kSurfaceFragment);
  if (!some.ok()) return some.error();
  auto wire = make_program("wireframe", "#define WIRE\n", kSurfaceVertex, kSurfaceFragment);
  if (!wire.ok()) return wire.error();
  const std::string shaded = std::string(kShadowFunction) + kSurfaceFragment;
  auto all_shaded = make_program("surface with shadows", kShadowLookup, kSurfaceVertex, shaded);
  if (!all_shaded.ok()) return all_shaded.error();
  auto some_shaded = make_program("part of the surface with shadows",
                                  std::string(kShadowLookup) + "#define ONLY_SOME\n", kSurfaceVertex, shaded);
  if (!some_shaded.ok()) return some_shaded.error();
  pass.all_shaded_ = std::move(all_shaded).value();
  pass.some_shaded_ = std::move(some_shaded).value();
  pass.all_ = std::move(all).value();
  pass.some_ = std::move(some).value();
  pass.wire_ = std::move(wire).value();
  pass.set_up();
  return pass;
}

void SurfacePass::set_up() {
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most_looks_);
  palette_ = make_palette();
  noise_ = make_noise();
  positions_ = MirroredBuffer(GL_ARRAY_BUFFER);
  normals_ = MirroredBuffer(GL_ARRAY_BUFFER);
  places_ = MirroredBuffer(GL_ARRAY_BUFFER);
  triangles_ = MirroredBuffer(GL_ELEMENT_ARRAY_BUFFER);
  looks_ = MirroredBuffer(GL_TEXTURE_BUFFER);
  array_ = make_vertex_array();
  glBindVertexArray(array_.id());
  attach(0, positions_.id(), 3);
  attach(1, normals_.id(), 3);
  attach(2, places_.id(), 4);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, triangles_.id());
  glBindBuffer(GL_TEXTURE_BUFFER, looks_.id());
  looks_texture_ = make_texture();
  glBindTexture(GL_TEXTURE_BUFFER, looks_texture_.id());
  glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA8UI, looks_.id());
  glBindVertexArray(0);
}

Status SurfacePass::check(const app::SurfaceFrame& frame) const {
  const app::SurfaceTopology& topology = *frame.topology;
  if (frame.positions.size() != topology.vertices.size() || topology.looks.size() != topology.triangles.size()) {
    return Error{ErrorCode::kBadArgument, "the surface's arrays differ in length; take it from SurfaceView::fill", {}};
  }
  if (topology.triangles.size() > static_cast<std::size_t>(most_looks_)) {
    return Error{ErrorCode::kUnsupported,
                 "the surface has " + std::to_string(topology.triangles.size()) + " triangles and this context draws " +
                     std::to_string(most_looks_) + "; use a coarser mesh",
                 {}};
  }
  if (frame.topology == topology_) return {};
  const auto* corners = reinterpret_cast<const std::uint32_t*>(topology.triangles.data());
  const std::size_t count = 3 * topology.triangles.size();
  const std::uint32_t most = count == 0 ? 0 : *std::max_element(corners, corners + count);
  if (count == 0 || most < frame.positions.size()) return {};
  return Error{ErrorCode::kBadArgument, "the surface has a triangle at a point that there is not", {most}};
}

// Versions tell nothing here: two views of two meshes count alike. What is uploaded is compared itself.
Status SurfacePass::upload(const app::SurfaceFrame& frame, DrawStatistics& statistics) {
  if (!frame.topology) {
    topology_ = nullptr;
    return {};
  }
  ThreadTimer watch;
  if (const Status status = check(frame); !status.ok()) return status;
  statistics.compare_ms += watch.lap();
  const app::SurfaceTopology& topology = *frame.topology;
  glBindVertexArray(array_.id());
  std::size_t bytes = positions_.update(frame.positions.data(), frame.positions.size(), sizeof(Eigen::Vector3f));
  std::size_t look_bytes = 0;
  const bool is_new = frame.topology != topology_;
  if (is_new) {
    bytes += triangles_.update(topology.triangles.data(), topology.triangles.size(), sizeof topology.triangles[0]);
    place_of_.find(frame);
    const std::vector<Eigen::Vector4f>& places = place_of_.of_points();
    bytes += places_.update(places.data(), places.size(), sizeof places[0]);
    look_bytes = looks_.update(topology.looks.data(), topology.looks.size(), sizeof(app::TriangleLook));
  }
  topology_ = frame.topology;
  statistics.upload_ms += watch.lap();
  if (bytes > 0) {
    if (is_new) averages_.find_creases(topology.triangles, frame.positions);
    const std::vector<Eigen::Vector3f>& normals = averages_.average(topology.triangles, frame.positions);
    statistics.normals_ms += watch.lap();
    bytes += normals_.update(normals.data(), normals.size(), sizeof(Eigen::Vector3f));
    statistics.upload_ms += watch.lap();
  }
  bytes += look_bytes;
  statistics.bytes_uploaded += bytes;
  statistics.triangles = topology.used;
  statistics.points = frame.positions.size();
  return {};
}

void SurfacePass::use(const GlObject& program, const app::ViewOptions& options, const ViewMatrices& view,
                      Only only) const {
  const Grounds grounds = grounds_of(options.theme);
  glUseProgram(program.id());
  glUniformMatrix4fv(location(program, "to_view"), 1, GL_FALSE, view.to_view.data());
  glUniformMatrix4fv(location(program, "to_clip"), 1, GL_FALSE, view.to_clip.data());
  glUniform1i(location(program, "looks"), kLooksUnit);
  glUniform1i(location(program, "palette"), kPaletteUnit);
  glUniform1i(location(program, "color_by"), static_cast<int>(options.color));
  glUniform1i(location(program, "tissue_look"), static_cast<int>(options.look));
  glUniform1ui(location(program, "red_from"), app::quality_byte(app::kRedRatio));
  glUniform1i(location(program, "only"), static_cast<int>(only));
  glUniform1i(location(program, "shows_newest"), options.shows_newest ? 1 : 0);
  glUniform1i(location(program, "is_flat_light"), options.color == app::ColorBy::kTissue ? 0 : 1);
  glUniform1f(location(program, "opacity"), only == Only::kSkin ? static_cast<float>(options.skin_opacity) : 1.0F);
  glUniform1f(location(program, "rim"), grounds.rim);
  glUniform1f(location(program, "extent"), place_of_.extent());
  glUniform1i(location(program, "noise"), kNoiseUnit);
  glUniform3f(location(program, "lone_wire"), options.shows_surface ? -1.0F : grounds.lone_wire[0],
              grounds.lone_wire[1], grounds.lone_wire[2]);
  glActiveTexture(GL_TEXTURE0 + kNoiseUnit);
  glBindTexture(GL_TEXTURE_3D, noise_.id());
  glActiveTexture(GL_TEXTURE0 + kPaletteUnit);
  glBindTexture(GL_TEXTURE_2D, palette_.id());
  glActiveTexture(GL_TEXTURE0 + kLooksUnit);
  glBindTexture(GL_TEXTURE_BUFFER, looks_texture_.id());
}

void SurfacePass::draw() const {
  if (!topology_ || topology_->triangles.empty()) return;
  glBindVertexArray(array_.id());
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * topology_->triangles.size()), GL_UNSIGNED_INT, nullptr);
}

void SurfacePass::draw_opaque(const app::ViewOptions& options, const ViewMatrices& view,
                              const ShadowPass* shadows) const {
  const bool has_skin = options.skin_opacity >= 1;
  const GlObject& plain = has_skin ? all_ : some_;
  const GlObject& shaded = has_skin ? all_shaded_ : some_shaded_;
  use(shadows != nullptr ? shaded : plain, options, view, has_skin ? Only::kAll : Only::kNoSkin);
  if (shadows != nullptr) shadows->bind(shaded, kShadowUnit);
  // Lines then lie before the triangles that they belong to.
  if (options.shows_wireframe) glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1, 1);
  draw();
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void SurfacePass::draw_translucent(const app::ViewOptions& options, const ViewMatrices& view) const {
  use(some_, options, view, Only::kSkin);
  if (options.shows_wireframe) glEnable(GL_POLYGON_OFFSET_FILL);
  glEnable(GL_BLEND);
  glEnable(GL_CULL_FACE);
  glDepthMask(GL_FALSE);
  glCullFace(GL_FRONT);
  draw();
  // Of what faces the eye only the nearest: first its depth, then its colour.
  glCullFace(GL_BACK);
  glDepthMask(GL_TRUE);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw();
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  draw();
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void SurfacePass::draw_wireframe(const app::ViewOptions& options, const ViewMatrices& view) const {
  use(wire_, options, view, Only::kAll);
  if (options.shows_surface) glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  draw();
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glDisable(GL_CULL_FACE);
}

}  // namespace render
}  // namespace v0
}  // namespace incise
