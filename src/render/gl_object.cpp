// SPDX-License-Identifier: Apache-2.0
// Every name of OpenGL comes with the function that deletes it; shaders are compiled with the version line and a
// prelude in front.
#include "render/gl_object.h"

#include <epoxy/gl.h>

#include <array>

namespace incise {
inline namespace v0 {
namespace render {
namespace {

using Log = std::array<char, 2048>;

constexpr const char* kShaderVersion = "#version 330 core\n";

Error refused(std::string_view name, const char* what, const char* log) {
  return {ErrorCode::kUnsupported,
          "the shader '" + std::string(name) + "' does not " + what + "; update the graphics driver. It says: " + log,
          {}};
}

Result<GlObject> make_shader(std::string_view name, GLenum kind, std::string_view prelude, std::string_view text) {
  GlObject shader(glCreateShader(kind), [](unsigned id) { glDeleteShader(id); });
  const std::string all = kShaderVersion + std::string(prelude) + std::string(text);
  const char* source = all.c_str();
  glShaderSource(shader.id(), 1, &source, nullptr);
  glCompileShader(shader.id());
  GLint ok = GL_FALSE;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &ok);
  if (ok == GL_TRUE) return shader;
  Log log{};
  glGetShaderInfoLog(shader.id(), static_cast<GLsizei>(log.size()), nullptr, log.data());
  return refused(name, "compile", log.data());
}

}  // namespace

GlObject make_buffer() {
  GLuint id = 0;
  glGenBuffers(1, &id);
  return {id, [](unsigned one) { glDeleteBuffers(1, &one); }};
}

GlObject make_framebuffer() {
  GLuint id = 0;
  glGenFramebuffers(1, &id);
  return {id, [](unsigned one) { glDeleteFramebuffers(1, &one); }};
}

GlObject make_renderbuffer() {
  GLuint id = 0;
  glGenRenderbuffers(1, &id);
  return {id, [](unsigned one) { glDeleteRenderbuffers(1, &one); }};
}

GlObject make_texture() {
  GLuint id = 0;
  glGenTextures(1, &id);
  return {id, [](unsigned one) { glDeleteTextures(1, &one); }};
}

GlObject make_vertex_array() {
  GLuint id = 0;
  glGenVertexArrays(1, &id);
  return {id, [](unsigned one) { glDeleteVertexArrays(1, &one); }};
}

Result<GlObject> make_program(std::string_view name, std::string_view prelude, std::string_view vertex,
                              std::string_view fragment) {
  Result<GlObject> vertex_shader = make_shader(name, GL_VERTEX_SHADER, prelude, vertex);
  if (!vertex_shader.ok()) return vertex_shader;
  Result<GlObject> fragment_shader = make_shader(name, GL_FRAGMENT_SHADER, prelude, fragment);
  if (!fragment_shader.ok()) return fragment_shader;
  GlObject program(glCreateProgram(), [](unsigned id) { glDeleteProgram(id); });
  glAttachShader(program.id(), vertex_shader->id());
  glAttachShader(program.id(), fragment_shader->id());
  glLinkProgram(program.id());
  glDetachShader(program.id(), vertex_shader->id());
  glDetachShader(program.id(), fragment_shader->id());
  GLint ok = GL_FALSE;
  glGetProgramiv(program.id(), GL_LINK_STATUS, &ok);
  if (ok == GL_TRUE) return program;
  Log log{};
  glGetProgramInfoLog(program.id(), static_cast<GLsizei>(log.size()), nullptr, log.data());
  return refused(name, "link", log.data());
}

int location(const GlObject& program, const char* uniform) {
  return glGetUniformLocation(program.id(), uniform);
}

Status check_gl(std::string_view doing) {
  GLenum first = GL_NO_ERROR;
  // Some drivers keep several; a lost context reports forever.
  for (int i = 0; i < 8; ++i) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) break;
    if (first == GL_NO_ERROR) first = error;
  }
  if (first == GL_NO_ERROR) return {};
  if (first == GL_OUT_OF_MEMORY) {
    return Error{ErrorCode::kOutOfMemory, std::string(doing) + ": the graphics memory is full; use a smaller view", {}};
  }
  return Error{ErrorCode::kInternal, std::string(doing) + ": OpenGL reports error " + std::to_string(first), {}};
}

}  // namespace render
}  // namespace v0
}  // namespace incise
