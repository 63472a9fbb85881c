// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/rendering/egl_context.hpp"

#include "hypermap/viewer_offscreen/snapshot/snapshot.hpp"

#define EGL_NO_X11
#include <epoxy/egl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <utility>

namespace hypermap {
namespace {

using testing::HasSubstr;

TEST(EglContext, SaysHowItDraws) {
  auto context = EglContext::create();
  if (!context) GTEST_SKIP() << to_string(context.error());
  EXPECT_THAT(context->description(), HasSubstr("OpenGL"));
}

TEST(EglContext, CanBeMovedAndMadeAgain) {
  auto first = EglContext::create();
  if (!first) GTEST_SKIP() << to_string(first.error());
  EglContext moved = std::move(*first);
  EXPECT_THAT(moved.description(), HasSubstr("OpenGL"));
  {
    auto second = EglContext::create();
    ASSERT_TRUE(second);
    EXPECT_EQ(second->description(), moved.description());
  }
  EXPECT_TRUE(EglContext::create());
}

/// A caller's own context, of OpenGL ES and on a surface, current until the end of the test.
class CallersContext : public testing::Test {
 protected:
  void SetUp() override {
    {
      const auto finder = EglContext::create();
      if (!finder) GTEST_SKIP() << to_string(finder.error());
      display = eglGetCurrentDisplay();
    }
    constexpr std::array<EGLint, 5> kWanted{
        EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES2_BIT, EGL_NONE};
    constexpr std::array<EGLint, 3> kVersion{EGL_CONTEXT_MAJOR_VERSION, 2, EGL_NONE};
    constexpr std::array<EGLint, 5> kSize{EGL_WIDTH, 2, EGL_HEIGHT, 2, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint num_configs = 0;
    eglBindAPI(EGL_OPENGL_ES_API);
    eglChooseConfig(display, kWanted.data(), &config, 1, &num_configs);
    if (num_configs == 0) GTEST_SKIP() << "no configuration of OpenGL ES with a surface";
    context = eglCreateContext(display, config, EGL_NO_CONTEXT, kVersion.data());
    surface = eglCreatePbufferSurface(display, config, kSize.data());
    ASSERT_EQ(eglMakeCurrent(display, surface, surface, context), EGL_TRUE);
  }
  void TearDown() override {
    if (context == EGL_NO_CONTEXT) return;
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroySurface(display, surface);
    eglDestroyContext(display, context);
  }
  void expect_current() const {
    EXPECT_EQ(eglQueryAPI(), static_cast<EGLenum>(EGL_OPENGL_ES_API));
    EXPECT_EQ(eglGetCurrentContext(), context);
    EXPECT_EQ(eglGetCurrentDisplay(), display);
    EXPECT_EQ(eglGetCurrentSurface(EGL_DRAW), surface);
    EXPECT_EQ(eglGetCurrentSurface(EGL_READ), surface);
  }

  EGLDisplay display = EGL_NO_DISPLAY;
  EGLSurface surface = EGL_NO_SURFACE;
  EGLContext context = EGL_NO_CONTEXT;
};

TEST_F(CallersContext, IsCurrentAgainWhenOursEnds) {
  {
    const auto ours = EglContext::create();
    ASSERT_TRUE(ours);
    EXPECT_NE(eglGetCurrentContext(), context);
  }
  expect_current();
}

TEST_F(CallersContext, IsCurrentAgainAfterTwoOfOurs) {
  {
    const auto first = EglContext::create();
    ASSERT_TRUE(first);
    const EGLContext of_first = eglGetCurrentContext();
    EXPECT_TRUE(EglContext::create());
    EXPECT_EQ(eglGetCurrentContext(), of_first);
  }
  expect_current();
}

TEST_F(CallersContext, IsCurrentAgainAfterAnImage) {
  ASSERT_TRUE(render_snapshot({}, {.width_px = 64, .height_px = 64, .annotations = false}));
  expect_current();
}

TEST(EglContext, OneThatEndsEarlierLeavesTheCurrentOneAlone) {
  auto first = EglContext::create();
  if (!first) GTEST_SKIP() << to_string(first.error());
  auto second = EglContext::create();
  ASSERT_TRUE(second);
  const EGLContext of_second = eglGetCurrentContext();
  first = std::move(second);
  EXPECT_EQ(eglGetCurrentContext(), of_second);
}

}  // namespace
}  // namespace hypermap
