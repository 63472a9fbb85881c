// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// OpenGL without a screen.
///
/// Source: EGL 1.5 specification; EGL_EXT_platform_base, EGL_MESA_platform_surfaceless,
/// EGL_EXT_platform_device. libEGL is opened at run time, so a program that links this library
/// starts and does all else where there is none.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <memory>
#include <string>

namespace hypermap {

/// A current OpenGL core context that draws into memory. Move-only; the context goes with it, and
/// what was current before it was made (through EGL: context, surfaces, bound API) is so again.
///
/// Boundary: contexts end in the reverse order of their making; one that ends earlier leaves the
/// current one alone.
/// Threads: made current on the thread that creates it; use it and destroy it there.
class EglContext {
 public:
  /// Tries Mesa's surfaceless platform, then each EGL device, then the default display; on each,
  /// OpenGL 4.5 core, then 3.3 core.
  /// Errors: kOutOfMemory when a driver might not find enough; kUnavailable naming every way tried,
  /// what each answered, and what to install.
  [[nodiscard]] static Result<EglContext> create();

  EglContext(EglContext&&) noexcept;
  EglContext& operator=(EglContext&&) noexcept;
  ~EglContext();

  /// The way that worked, version and renderer: "surfaceless, OpenGL 4.5, llvmpipe (LLVM 15)".
  [[nodiscard]] const std::string& description() const;

 private:
  struct Impl;
  explicit EglContext(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace hypermap
