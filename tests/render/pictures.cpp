// SPDX-License-Identifier: Apache-2.0
#include "pictures.h"

#include <epoxy/gl.h>

#include <cmath>

#include "incise/mesh/shapes.h"

namespace incise_test {

using incise::Vec3;
namespace app = incise::app;
namespace render = incise::render;

WoundedCube::WoundedCube() {
  auto soup = incise::kuhn_cube(5);
  soup.regions.assign(soup.tets.size(), 0);
  for (std::size_t i = 0; i < soup.tets.size(); ++i) soup.regions[i] = soup.points[soup.tets[i][0]].z() < 0.55 ? 1 : 2;
  auto mesh = incise::TetMesh::build(soup);
  engine_ = std::make_unique<incise::Engine>(incise::Engine::create(std::move(mesh).value()).value());
  cut(0.72, 0.75);
  cut(0.38, 0.45);
}

void WoundedCube::cut(double x, double depth) {
  const auto blade = [&](double z) { return incise::BladePose{{Vec3(x, -0.2, z), Vec3(x, 1.2, z)}, Vec3(0, 0, -1)}; };
  static_cast<void>(engine_->begin_stroke(blade(1.1)));
  for (int i = 1; i <= 10; ++i) static_cast<void>(engine_->step(blade(1.1 + (depth - 1.1) * i / 10)));
  static_cast<void>(engine_->end_stroke());
}

// Lips go apart, away from the side that their walls face.
void WoundedCube::open(app::SurfaceFrame& frame) const {
  const app::SurfaceTopology& topology = *frame.topology;
  std::vector<float> faced(engine_->mesh().vertex_slots(), 0);
  for (std::size_t i = 0; i < topology.triangles.size(); ++i) {
    if ((topology.looks[i].flags & app::TriangleLook::kWall) == 0) continue;
    const auto& [a, b, c] = topology.triangles[i];
    const auto& at = frame.positions;
    const float area = (at[b] - at[a]).cross(at[c] - at[a]).x();
    for (const std::uint32_t point : {a, b, c}) faced[topology.vertices[point].value] += area;
  }
  for (std::size_t i = 0; i < frame.positions.size(); ++i) {
    if (!topology.vertices[i].is_valid()) continue;
    Eigen::Vector3f& p = frame.positions[i];
    const float lip = faced[topology.vertices[i].value], height = std::max(0.0F, p.z() - 0.4F);
    const float side = lip != 0 ? -lip : p.x() - 0.38F;
    p.x() += std::copysign(0.22F * height * std::exp(-4 * std::abs(p.x() - 0.38F)), side);
  }
}

app::Picture WoundedCube::picture(const app::SurfaceOptions& options) const {
  app::SurfaceView view(engine_->mesh(), engine_->journal());
  view.set_options(options);
  view.follow(engine_->mesh(), engine_->journal());
  app::Picture picture;
  view.fill(engine_->mesh(), picture.surface);
  if (!options.clip) open(picture.surface);
  picture.camera.azimuth = -1.0;
  picture.camera.elevation = 0.6;
  app::frame_all(picture.camera, kSmall, app::bounds_of(picture.surface));
  return picture;
}

app::Picture sheet(std::uint32_t n) {
  auto topology = std::make_shared<app::SurfaceTopology>();
  app::Picture picture;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) {
      const float x = static_cast<float>(i) / static_cast<float>(n), y = static_cast<float>(j) / static_cast<float>(n);
      picture.surface.positions.emplace_back(x, y, 0.1F * std::sin(6 * x) * std::cos(5 * y));
    }
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = i + (n + 1) * j, b = a + 1, c = a + n + 1, d = c + 1;
      topology->triangles.push_back({a, b, d});
      topology->triangles.push_back({a, d, c});
    }
  }
  topology->looks.assign(topology->triangles.size(), {0, 0, 0, 0});
  topology->sides.resize(topology->triangles.size());
  topology->vertices.resize(picture.surface.positions.size());
  topology->used = topology->triangles.size();
  picture.surface.topology = topology;
  picture.camera.elevation = 0.9;
  app::frame_all(picture.camera, kSmall, app::bounds_of(picture.surface));
  return picture;
}

std::shared_ptr<app::SurfaceTopology> copy_of(const app::SurfaceFrame& frame) {
  return std::make_shared<app::SurfaceTopology>(*frame.topology);
}

Drawing::Drawing(const app::Viewport& viewport, unsigned samples) : viewport_(viewport) {
  auto context = render::HeadlessContext::create();
  if (!context.ok()) {
    trouble_ = context.error().message;
    return;
  }
  context_ = std::make_unique<render::HeadlessContext>(std::move(context).value());
  listen();
  auto renderer = render::Renderer::create(samples);
  auto target = render::OffscreenTarget::create(viewport);
  if (!renderer.ok() || !target.ok()) {
    trouble_ = renderer.ok() ? target.error().message : renderer.error().message;
    return;
  }
  renderer_ = std::make_unique<render::Renderer>(std::move(renderer).value());
  target_ = std::make_unique<render::OffscreenTarget>(std::move(target).value());
}

Drawing::~Drawing() {
  if (context_) glDebugMessageCallback(nullptr, nullptr);
}

void Drawing::listen() {
  if (!epoxy_has_gl_extension("GL_KHR_debug")) return;
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(
      [](GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* text, const void* all) {
        if (type != GL_DEBUG_TYPE_ERROR && type != GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR) return;
        static_cast<std::string*>(const_cast<void*>(all))->append(text).append("\n");
      },
      messages_.get());
}

incise::Status Drawing::draw(const app::Picture& picture) {
  return renderer_->draw(picture, viewport_, target_->framebuffer());
}

render::Image Drawing::read() const {
  auto image = target_->read();
  return image.ok() ? std::move(image).value() : render::Image{};
}

std::string Drawing::complaints() const {
  const GLenum error = glGetError();
  return *messages_ + (error == GL_NO_ERROR ? "" : "glGetError " + std::to_string(error));
}

}  // namespace incise_test
