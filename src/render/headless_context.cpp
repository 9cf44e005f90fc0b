// SPDX-License-Identifier: Apache-2.0
// Libraries are looked for before libepoxy asks for them, since it ends the program where they are missing; then EGL's
// surfaceless platform gives a context.
#include "render/headless_context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <string_view>

namespace incise {
inline namespace v0 {
namespace render {
namespace {

constexpr const char* kRemedy = "install libegl1 and libgl1-mesa-dri, for instance with apt-get";

Error unsupported(const std::string& what) {
  return {ErrorCode::kUnsupported, "cannot draw without a window: " + what + "; " + kRemedy, {}};
}

bool has_library(std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(), [](const char* name) {
    void* library = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
    if (library != nullptr) dlclose(library);
    return library != nullptr;
  });
}

/// libepoxy ends the program where a library is missing, so it is asked for only what is there.
Status check_libraries() {
  if (!has_library({"libEGL.so.1"})) return unsupported("there is no libEGL.so.1");
  if (!has_library({"libOpenGL.so.0", "libGL.so.1"})) return unsupported("there is no libOpenGL.so.0");
  return {};
}

bool has_word(const char* list, std::string_view word) {
  std::string_view rest = list == nullptr ? "" : list;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == word) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

Result<EGLDisplay> open_display() {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!has_word(extensions, "EGL_EXT_platform_base") || !has_word(extensions, "EGL_MESA_platform_surfaceless")) {
    return unsupported("EGL has no surfaceless platform");
  }
  const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) {
    return unsupported("EGL's surfaceless platform does not start");
  }
  if (!has_word(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context")) {
    return unsupported("EGL has no contexts without surfaces");
  }
  return display;
}

Result<EGLContext> open_context(EGLDisplay display) {
  constexpr std::array<EGLint, 5> kConfig = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
  constexpr std::array<EGLint, 7> kContextVersion = {EGL_CONTEXT_MAJOR_VERSION_KHR,
                                                     3,
                                                     EGL_CONTEXT_MINOR_VERSION_KHR,
                                                     3,
                                                     EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR,
                                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR,
                                                     EGL_NONE};
  EGLConfig config = nullptr;
  EGLint found = 0;
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return unsupported("EGL has no desktop OpenGL");
  if (eglChooseConfig(display, kConfig.data(), &config, 1, &found) != EGL_TRUE || found < 1) {
    return unsupported("EGL offers no configuration for OpenGL");
  }
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, kContextVersion.data());
  if (context == EGL_NO_CONTEXT) return unsupported("there is no OpenGL 3.3 core");
  return context;
}

std::string gl_string(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

}  // namespace

bool is_software_renderer(const std::string& name) {
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array<const char*, 3> kSoftware = {"llvmpipe", "softpipe", "swiftshader"};
  return std::any_of(kSoftware.begin(), kSoftware.end(),
                     [&](const char* one) { return lower.find(one) != std::string::npos; });
}

// The display is the process's and shared by all contexts: nobody may terminate it while others draw, so nobody does.
struct HeadlessContext::State {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  std::string renderer_name;

  ~State() {
    if (context == EGL_NO_CONTEXT) return;
    if (eglGetCurrentContext() == context) eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
  }
};

HeadlessContext::HeadlessContext(std::unique_ptr<State> state) : state_(std::move(state)) {}
HeadlessContext::HeadlessContext(HeadlessContext&&) noexcept = default;
HeadlessContext& HeadlessContext::operator=(HeadlessContext&&) noexcept = default;
HeadlessContext::~HeadlessContext() = default;

Result<HeadlessContext> HeadlessContext::create() {
  if (const Status status = check_libraries(); !status.ok()) return status.error();
  const Result<EGLDisplay> display = open_display();
  if (!display.ok()) return display.error();
  const Result<EGLContext> context = open_context(display.value());
  if (!context.ok()) return context.error();
  auto state = std::make_unique<State>();
  state->display = display.value();
  state->context = context.value();
  HeadlessContext made(std::move(state));
  if (!made.make_current().ok()) return unsupported("the context cannot be made current");
  made.state_->renderer_name = gl_string(GL_RENDERER);
  return made;
}

Status HeadlessContext::make_current() {
  if (eglMakeCurrent(state_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, state_->context) == EGL_TRUE) return {};
  return Error{ErrorCode::kInternal, "the context cannot be made current; another thread may have it", {}};
}

const std::string& HeadlessContext::renderer_name() const {
  return state_->renderer_name;
}

bool HeadlessContext::is_software() const {
  return is_software_renderer(state_->renderer_name);
}

}  // namespace render
}  // namespace v0
}  // namespace incise
