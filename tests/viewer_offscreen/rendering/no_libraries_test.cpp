// SPDX-License-Identifier: BSD-3-Clause
// A program of its own: what is opened once stays open.
#include "hypermap/viewer_offscreen/rendering/egl_context.hpp"
#include "hypermap/viewer_offscreen/snapshot/snapshot.hpp"

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace {

/// Libraries that this machine does not have.
std::vector<std::string>& absent_libraries() {
  static std::vector<std::string> names;
  return names;
}

}  // namespace

/// Stands before the system's: every library of the process, libepoxy among them, opens others
/// through it.
extern "C" void* dlopen(const char* name, int flags) noexcept {
  using Open = void* (*)(const char*, int);
  static const auto kOpen = reinterpret_cast<Open>(dlsym(RTLD_NEXT, "dlopen"));
  const auto& absent = absent_libraries();
  const bool is_absent =
      name != nullptr && std::find(absent.begin(), absent.end(), name) != absent.end();
  return kOpen(is_absent ? "/nonexistent/library" : name, flags);
}

namespace hypermap {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// In the order of the tests: each begins with less than was opened before it.
TEST(NoLibraries, WithoutLibEglTheErrorSaysWhatToInstall) {
  absent_libraries() = {"libEGL.so.1"};
  const auto context = EglContext::create();
  ASSERT_FALSE(context);
  EXPECT_EQ(context.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(context.error().what,
              AllOf(HasSubstr("libEGL.so.1"), HasSubstr("libegl1 libegl-mesa0 libgl1-mesa-dri")));
}

TEST(NoLibraries, WithoutOpenGlTheErrorSaysWhatToInstall) {
  absent_libraries() = {"libOpenGL.so.0", "libGL.so.1"};
  const auto context = EglContext::create();
  ASSERT_FALSE(context);
  EXPECT_EQ(context.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(context.error().what,
              testing::AnyOf(AllOf(HasSubstr("libOpenGL.so.0"), HasSubstr("libopengl0")),
                             HasSubstr("libEGL.so.1")));
}

TEST(NoLibraries, AnImageGivesTheSameError) {
  absent_libraries() = {"libEGL.so.1"};
  const auto image = render_snapshot({});
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, ErrorCode::kUnavailable);
}

TEST(NoLibraries, WhatIsInstalledMeanwhileIsFound) {
  absent_libraries() = {};
  const auto context = EglContext::create();
  if (!context) GTEST_SKIP() << to_string(context.error());
  EXPECT_THAT(context->description(), HasSubstr("OpenGL"));
}

}  // namespace
}  // namespace hypermap
