// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The functions of libEGL, which is opened at run time.
#pragma once

#include "hypermap/core/base/result.hpp"

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <string>

namespace hypermap {

struct EglApi {
  PFNEGLBINDAPIPROC BindAPI = nullptr;
  PFNEGLCHOOSECONFIGPROC ChooseConfig = nullptr;
  PFNEGLCREATECONTEXTPROC CreateContext = nullptr;
  PFNEGLCREATEPBUFFERSURFACEPROC CreatePbufferSurface = nullptr;
  PFNEGLDESTROYCONTEXTPROC DestroyContext = nullptr;
  PFNEGLDESTROYSURFACEPROC DestroySurface = nullptr;
  PFNEGLGETDISPLAYPROC GetDisplay = nullptr;
  PFNEGLGETERRORPROC GetError = nullptr;
  PFNEGLGETPROCADDRESSPROC GetProcAddress = nullptr;
  PFNEGLINITIALIZEPROC Initialize = nullptr;
  PFNEGLMAKECURRENTPROC MakeCurrent = nullptr;
  PFNEGLQUERYSTRINGPROC QueryString = nullptr;
  PFNEGLGETPLATFORMDISPLAYEXTPROC GetPlatformDisplayEXT = nullptr;  ///< Null when absent.
  PFNEGLQUERYDEVICESEXTPROC QueryDevicesEXT = nullptr;              ///< Null when absent.
};

/// Opens libEGL.so.1. It stays open: drivers do not survive being unloaded.
/// Errors: kUnavailable with the loader's reason.
[[nodiscard]] Result<EglApi> load_egl();

/// "EGL_NOT_INITIALIZED" and the like; the number in hexadecimal when it has no name.
[[nodiscard]] std::string egl_error_text(EGLint error);

}  // namespace hypermap
