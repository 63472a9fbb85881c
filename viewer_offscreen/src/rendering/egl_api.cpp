// SPDX-License-Identifier: BSD-3-Clause
#include "egl_api.hpp"

#include <dlfcn.h>

#include <array>
#include <charconv>
#include <initializer_list>
#include <utility>

namespace hypermap {
namespace {

/// Opens the first of `names` that there is.
Result<void> open_one_of(std::initializer_list<const char*> names) {
  std::string reasons;
  for (const char* name : names) {
    if (dlopen(name, RTLD_LAZY | RTLD_LOCAL) != nullptr) return {};
    const char* reason = dlerror();
    reasons += (reasons.empty() ? "" : "; ") + std::string(name) +
               " cannot be opened: " + (reason != nullptr ? reason : "?");
  }
  return fail(ErrorCode::kUnavailable, reasons);
}

}  // namespace

Result<void> open_gl_libraries() {
  HYPERMAP_TRY(open_one_of({"libEGL.so.1"}));
  return open_one_of({"libOpenGL.so.0", "libGL.so.1"});
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
