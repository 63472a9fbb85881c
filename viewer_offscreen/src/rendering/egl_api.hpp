// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// EGL under its own names (libepoxy), and whether it can be called.
#pragma once

#include "hypermap/core/base/result.hpp"

#define EGL_NO_X11
#include <epoxy/egl.h>

#include <string>

namespace hypermap {

/// Opens what libepoxy looks for when a function is first called: libEGL.so.1, and libOpenGL.so.0
/// or libGL.so.1. Without them libepoxy would end the process, so nothing of EGL may be called
/// before this has succeeded. They stay open: drivers do not survive being unloaded.
/// Errors: kUnavailable with the loader's reason.
[[nodiscard]] Result<void> open_gl_libraries();

/// "EGL_NOT_INITIALIZED" and the like; the number in hexadecimal when it has no name.
[[nodiscard]] std::string egl_error_text(EGLint error);

}  // namespace hypermap
