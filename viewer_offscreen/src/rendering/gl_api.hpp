// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// OpenGL under its own names (libepoxy), up to version 3.3, whatever is called while an EglContext
/// is current; programs and errors.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <epoxy/gl.h>

namespace hypermap {

/// Errors: kUnavailable with the driver's log, which names line and reason.
[[nodiscard]] Result<GLuint> make_program(const char* vertex_source, const char* fragment_source);

/// Errors: kOutOfMemory or kUnavailable when OpenGL reports an error since the last call; `during`
/// says what was done.
[[nodiscard]] Result<void> check_gl(const char* during);

}  // namespace hypermap
