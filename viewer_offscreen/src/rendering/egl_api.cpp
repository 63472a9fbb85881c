// SPDX-License-Identifier: BSD-3-Clause
#include "egl_api.hpp"

#include <dlfcn.h>

#include <array>
#include <charconv>
#include <utility>

namespace hypermap {
namespace {

constexpr const char* kLibrary = "libEGL.so.1";

template <class Function>
bool find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  return function != nullptr;
}

bool find_core(void* library, EglApi& egl) {
  return find(library, "eglBindAPI", egl.BindAPI) &&
         find(library, "eglChooseConfig", egl.ChooseConfig) &&
         find(library, "eglCreateContext", egl.CreateContext) &&
         find(library, "eglCreatePbufferSurface", egl.CreatePbufferSurface) &&
         find(library, "eglDestroyContext", egl.DestroyContext) &&
         find(library, "eglDestroySurface", egl.DestroySurface) &&
         find(library, "eglGetDisplay", egl.GetDisplay) &&
         find(library, "eglGetError", egl.GetError) &&
         find(library, "eglGetProcAddress", egl.GetProcAddress) &&
         find(library, "eglInitialize", egl.Initialize) &&
         find(library, "eglMakeCurrent", egl.MakeCurrent) &&
         find(library, "eglQueryString", egl.QueryString);
}

template <class Function>
Function extension(const EglApi& egl, const char* name) {
  return reinterpret_cast<Function>(egl.GetProcAddress(name));
}

}  // namespace

Result<EglApi> load_egl() {
  void* library = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* reason = dlerror();
    return fail(ErrorCode::kUnavailable,
                std::string(kLibrary) + " cannot be opened: " + (reason != nullptr ? reason : "?"));
  }
  EglApi egl;
  if (!find_core(library, egl)) {
    return fail(ErrorCode::kUnavailable, std::string(kLibrary) + " lacks functions of EGL 1.4");
  }
  egl.GetPlatformDisplayEXT =
      extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>(egl, "eglGetPlatformDisplayEXT");
  egl.QueryDevicesEXT = extension<PFNEGLQUERYDEVICESEXTPROC>(egl, "eglQueryDevicesEXT");
  return egl;
}

std::string egl_error_text(EGLint error) {
  constexpr std::array<std::pair<EGLint, const char*>, 8> kNames{{
      {EGL_SUCCESS, "no error"},
      {EGL_NOT_INITIALIZED, "EGL_NOT_INITIALIZED"},
      {EGL_BAD_ALLOC, "EGL_BAD_ALLOC"},
      {EGL_BAD_ATTRIBUTE, "EGL_BAD_ATTRIBUTE"},
      {EGL_BAD_CONFIG, "EGL_BAD_CONFIG"},
      {EGL_BAD_DISPLAY, "EGL_BAD_DISPLAY"},
      {EGL_BAD_MATCH, "EGL_BAD_MATCH"},
      {EGL_BAD_PARAMETER, "EGL_BAD_PARAMETER"},
  }};
  for (const auto& [value, name] : kNames) {
    if (value == error) return name;
  }
  std::array<char, 16> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), error, 16).ptr;
  return "EGL error 0x" + std::string(digits.data(), end);
}

}  // namespace hypermap
