// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/rendering/egl_context.hpp"

#include "egl_api.hpp"

#include <GL/glcorearb.h>

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::string_view kRemedy =
    "; install an OpenGL driver (Debian: libegl1 libegl-mesa0 libgl1-mesa-dri)";

/// A display that may give a context, and how a person would call it.
struct Candidate {
  std::string name;
  EGLDisplay display = EGL_NO_DISPLAY;
  std::string why_none = "no display";  ///< Said when there is no display.
};

struct Version {
  EGLint major = 0;
  EGLint minor = 0;
};
constexpr std::array<Version, 2> kVersions{{{4, 5}, {3, 3}}};

bool client_has(const EglApi& egl, std::string_view extension) {
  const char* all = egl.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  return all != nullptr && std::string_view(all).find(extension) != std::string_view::npos;
}

void add_surfaceless(const EglApi& egl, std::vector<Candidate>& candidates) {
  if (egl.GetPlatformDisplayEXT == nullptr || !client_has(egl, "EGL_MESA_platform_surfaceless")) {
    candidates.push_back({"surfaceless", EGL_NO_DISPLAY, "the driver lacks it"});
    return;
  }
  candidates.push_back(
      {"surfaceless",
       egl.GetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)});
}

void add_devices(const EglApi& egl, std::vector<Candidate>& candidates) {
  constexpr EGLint kMaxDevices = 16;
  std::array<EGLDeviceEXT, kMaxDevices> devices{};
  EGLint num_devices = 0;
  const bool known = egl.GetPlatformDisplayEXT != nullptr && egl.QueryDevicesEXT != nullptr &&
                     egl.QueryDevicesEXT(kMaxDevices, devices.data(), &num_devices) == EGL_TRUE;
  if (!known || num_devices == 0) candidates.push_back({"device", EGL_NO_DISPLAY, "none found"});
  for (EGLint i = 0; i < (known ? num_devices : 0); ++i) {
    candidates.push_back(
        {"device " + std::to_string(i),
         egl.GetPlatformDisplayEXT(
             EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr)});
  }
}

std::vector<Candidate> candidates_of(const EglApi& egl) {
  std::vector<Candidate> candidates;
  add_surfaceless(egl, candidates);
  add_devices(egl, candidates);
  candidates.push_back({"default display", egl.GetDisplay(EGL_DEFAULT_DISPLAY)});
  return candidates;
}

Result<EGLConfig> choose_config(const EglApi& egl, EGLDisplay display) {
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
  if (egl.ChooseConfig(display, kWanted.data(), &config, 1, &num_configs) != EGL_TRUE ||
      num_configs == 0) {
    return fail(ErrorCode::kUnavailable, "no configuration for OpenGL off screen");
  }
  return config;
}

EGLContext create_core_context(const EglApi& egl,
                               EGLDisplay display,
                               EGLConfig config,
                               Version version) {
  const std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                         version.major,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         version.minor,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                         EGL_NONE};
  return egl.CreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
}

}  // namespace

struct EglContext::Impl {
  EglApi egl;
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLSurface surface = EGL_NO_SURFACE;
  EGLContext context = EGL_NO_CONTEXT;
  std::string description;

  explicit Impl(const EglApi& api) : egl(api) {}
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  /// The display stays initialised: EGL counts no users of it, and others may draw on it.
  ~Impl() {
    if (context == EGL_NO_CONTEXT) return;
    egl.MakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (surface != EGL_NO_SURFACE) egl.DestroySurface(display, surface);
    egl.DestroyContext(display, context);
  }

  [[nodiscard]] Unexpected refused(const char* step) const {
    return fail(ErrorCode::kUnavailable, std::string(step) + ": " + egl_error_text(egl.GetError()));
  }

  /// Makes a context on `candidate` current.
  Result<void> open(const Candidate& candidate) {
    display = candidate.display;
    if (display == EGL_NO_DISPLAY) return fail(ErrorCode::kUnavailable, candidate.why_none);
    if (egl.Initialize(display, nullptr, nullptr) != EGL_TRUE) return refused("eglInitialize");
    if (egl.BindAPI(EGL_OPENGL_API) != EGL_TRUE) return refused("eglBindAPI");
    HYPERMAP_ASSIGN_OR_RETURN(const EGLConfig config, choose_config(egl, display));
    for (const Version version : kVersions) {
      context = create_core_context(egl, display, config, version);
      if (context != EGL_NO_CONTEXT) break;
    }
    if (context == EGL_NO_CONTEXT) return refused("OpenGL 4.5 and 3.3 core");
    HYPERMAP_TRY(make_current(config));
    description = candidate.name + ", " + driver_text();
    return {};
  }

  /// Without a surface where that is possible, else with the smallest one.
  Result<void> make_current(EGLConfig config) {
    if (egl.MakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE) return {};
    constexpr std::array<EGLint, 5> kOnePixel{EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    surface = egl.CreatePbufferSurface(display, config, kOnePixel.data());
    if (surface != EGL_NO_SURFACE &&
        egl.MakeCurrent(display, surface, surface, context) == EGL_TRUE) {
      return {};
    }
    return refused("eglMakeCurrent");
  }

  [[nodiscard]] std::string driver_text() const {
    const auto get_string = reinterpret_cast<PFNGLGETSTRINGPROC>(egl.GetProcAddress("glGetString"));
    const auto text = [&](GLenum name) {
      const GLubyte* value = get_string == nullptr ? nullptr : get_string(name);
      return value == nullptr ? std::string("?")
                              : std::string(reinterpret_cast<const char*>(value));
    };
    return "OpenGL " + text(GL_VERSION) + ", " + text(GL_RENDERER);
  }
};

EglContext::EglContext(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
EglContext::EglContext(EglContext&&) noexcept = default;
EglContext& EglContext::operator=(EglContext&&) noexcept = default;
EglContext::~EglContext() = default;

Result<EglContext> EglContext::create() {
  auto egl = load_egl();
  if (!egl) {
    egl.error().what = "pictures need OpenGL through EGL: " + egl.error().what;
    egl.error().what += kRemedy;
    return tl::make_unexpected(std::move(egl).error());
  }
  std::string tried;
  for (const Candidate& candidate : candidates_of(*egl)) {
    auto impl = std::make_unique<Impl>(*egl);
    const Result<void> opened = impl->open(candidate);
    if (opened) return EglContext(std::move(impl));
    tried += (tried.empty() ? "" : "; ") + candidate.name + ": " + opened.error().what;
  }
  return fail(ErrorCode::kUnavailable,
              "pictures need OpenGL through EGL, tried " + tried + std::string(kRemedy));
}

const std::string& EglContext::description() const {
  return impl_->description;
}

EglContext::Function EglContext::function(const char* name) const {
  return impl_->egl.GetProcAddress(name);
}

}  // namespace hypermap
