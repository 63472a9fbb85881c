// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/rendering/egl_context.hpp"

#include "address_space.hpp"
#include "egl_api.hpp"

#include <epoxy/gl.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::string_view kRemedy =
    "; install an OpenGL driver (Debian: libegl1 libegl-mesa0 libgl1-mesa-dri libopengl0)";

/// Mesa's llvmpipe and its compiler take 640 MB on two cores, and may crash where they get less.
constexpr std::size_t kDriverBytes = std::size_t{768} << 20U;

/// A display that may give a context, and how a person would call it.
struct Candidate {
  std::string name;
  EGLDisplay display = EGL_NO_DISPLAY;
  std::string unavailable_reason = "no display";  ///< Said when there is no display.
};

struct Version {
  EGLint major = 0;
  EGLint minor = 0;
};
constexpr std::array<Version, 2> kVersions{{{4, 5}, {3, 3}}};

bool client_has(const char* extension) {
  return epoxy_has_egl_extension(EGL_NO_DISPLAY, extension);
}

void add_surfaceless(std::vector<Candidate>& candidates) {
  if (!client_has("EGL_EXT_platform_base") || !client_has("EGL_MESA_platform_surfaceless")) {
    candidates.push_back({"surfaceless", EGL_NO_DISPLAY, "the driver lacks it"});
    return;
  }
  candidates.push_back(
      {"surfaceless",
       eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)});
}

void add_devices(std::vector<Candidate>& candidates) {
  constexpr EGLint kMaxDevices = 16;
  std::array<EGLDeviceEXT, kMaxDevices> devices{};
  EGLint num_devices = 0;
  const bool known =
      client_has("EGL_EXT_platform_base") && client_has("EGL_EXT_platform_device") &&
      (client_has("EGL_EXT_device_base") || client_has("EGL_EXT_device_enumeration")) &&
      eglQueryDevicesEXT(kMaxDevices, devices.data(), &num_devices) == EGL_TRUE;
  if (!known || num_devices == 0) candidates.push_back({"device", EGL_NO_DISPLAY, "none found"});
  for (EGLint i = 0; i < (known ? num_devices : 0); ++i) {
    candidates.push_back(
        {"device " + std::to_string(i),
         eglGetPlatformDisplayEXT(
             EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr)});
  }
}

std::vector<Candidate> find_candidates() {
  std::vector<Candidate> candidates;
  add_surfaceless(candidates);
  add_devices(candidates);
  candidates.push_back({"default display", eglGetDisplay(EGL_DEFAULT_DISPLAY)});
  return candidates;
}

Result<EGLConfig> choose_config(EGLDisplay display) {
  constexpr std::array<EGLint, 11> kWanted{EGL_SURFACE_TYPE,
                                           EGL_PBUFFER_BIT,
                                           EGL_RENDERABLE_TYPE,
                                           EGL_OPENGL_BIT,
                                           EGL_RED_SIZE,
                                           8,
                                           EGL_GREEN_SIZE,
                                           8,
                                           EGL_BLUE_SIZE,
                                           8,
                                           EGL_NONE};
  EGLConfig config = nullptr;
  EGLint num_configs = 0;
  if (eglChooseConfig(display, kWanted.data(), &config, 1, &num_configs) != EGL_TRUE ||
      num_configs == 0) {
    return fail(ErrorCode::kUnavailable, "no configuration for OpenGL off screen");
  }
  return config;
}

EGLContext create_core_context(EGLDisplay display, EGLConfig config, Version version) {
  const std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                         version.major,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         version.minor,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                         EGL_NONE};
  return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
}

/// What is current on this thread, to be so again.
struct CurrentContext {
  EGLenum api = eglQueryAPI();
  EGLDisplay display = eglGetCurrentDisplay();
  EGLContext context = eglGetCurrentContext();
  EGLSurface drawn = eglGetCurrentSurface(EGL_DRAW);
  EGLSurface read = eglGetCurrentSurface(EGL_READ);

  /// False when there was none, or when it has been destroyed meanwhile.
  [[nodiscard]] bool make_current_again() const {
    return context != EGL_NO_CONTEXT && eglMakeCurrent(display, drawn, read, context) == EGL_TRUE;
  }
};

Unexpected refused(const char* step) {
  return fail(ErrorCode::kUnavailable, std::string(step) + ": " + egl_error_text(eglGetError()));
}

std::string driver_text() {
  const auto text = [](GLenum name) {
    const GLubyte* value = glGetString(name);
    return value == nullptr ? std::string("?") : std::string(reinterpret_cast<const char*>(value));
  };
  return "OpenGL " + text(GL_VERSION) + ", " + text(GL_RENDERER);
}

}  // namespace

struct EglContext::Impl {
  CurrentContext callers;
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLSurface surface = EGL_NO_SURFACE;
  EGLContext context = EGL_NO_CONTEXT;
  std::string description;

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  /// The display stays initialised: EGL counts no users of it, and others may draw on it.
  ~Impl() {
    if (context != EGL_NO_CONTEXT) {
      if (is_current() && !callers.make_current_again()) {
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
      }
      if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
      eglDestroyContext(display, context);
    }
    eglBindAPI(callers.api);
  }

  [[nodiscard]] bool is_current() const { return eglGetCurrentContext() == context; }

  /// Makes a context on `candidate` current.
  Result<void> open(const Candidate& candidate) {
    display = candidate.display;
    if (display == EGL_NO_DISPLAY)
      return fail(ErrorCode::kUnavailable, candidate.unavailable_reason);
    if (eglInitialize(display, nullptr, nullptr) != EGL_TRUE) return refused("eglInitialize");
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return refused("eglBindAPI");
    HYPERMAP_ASSIGN_OR_RETURN(const EGLConfig config, choose_config(display));
    for (const Version version : kVersions) {
      context = create_core_context(display, config, version);
      if (context != EGL_NO_CONTEXT) break;
    }
    if (context == EGL_NO_CONTEXT) return refused("OpenGL 4.5 and 3.3 core");
    HYPERMAP_TRY(make_current(config));
    if (!epoxy_is_desktop_gl() || epoxy_gl_version() < 33) {
      return fail(ErrorCode::kUnavailable, "gave " + driver_text() + " instead of 3.3 core");
    }
    description = candidate.name + ", " + driver_text();
    return {};
  }

  /// Without a surface where that is possible, else with the smallest one.
  Result<void> make_current(EGLConfig config) {
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE) return {};
    constexpr std::array<EGLint, 5> kOnePixel{EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    surface = eglCreatePbufferSurface(display, config, kOnePixel.data());
    if (surface != EGL_NO_SURFACE &&
        eglMakeCurrent(display, surface, surface, context) == EGL_TRUE) {
      return {};
    }
    return refused("eglMakeCurrent");
  }
};

EglContext::EglContext(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
EglContext::EglContext(EglContext&&) noexcept = default;
EglContext& EglContext::operator=(EglContext&&) noexcept = default;
EglContext::~EglContext() = default;

Result<EglContext> EglContext::create() {
  if (!has_address_space(kDriverBytes)) {
    return fail(ErrorCode::kOutOfMemory,
                "a driver of OpenGL may take " + std::to_string(kDriverBytes >> 20U) +
                    " MiB of memory, more than there is or than the process may have");
  }
  if (const auto libraries = open_gl_libraries(); !libraries) {
    return fail(libraries.error().code,
                "images need OpenGL through EGL: " + libraries.error().what + std::string(kRemedy));
  }
  std::string tried;
  for (const Candidate& candidate : find_candidates()) {
    auto impl = std::make_unique<Impl>();
    const Result<void> opened = impl->open(candidate);
    if (opened) return EglContext(std::move(impl));
    tried += (tried.empty() ? "" : "; ") + candidate.name + ": " + opened.error().what;
  }
  return fail(ErrorCode::kUnavailable,
              "images need OpenGL through EGL, tried " + tried + std::string(kRemedy));
}

const std::string& EglContext::description() const {
  return impl_->description;
}

}  // namespace hypermap
