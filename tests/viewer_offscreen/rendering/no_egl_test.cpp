// SPDX-License-Identifier: BSD-3-Clause
// A program of its own: EGL reads its environment once, when it is first used.
#include "hypermap/viewer_offscreen/rendering/egl_context.hpp"
#include "hypermap/viewer_offscreen/snapshot/snapshot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace hypermap {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Whatever driver the machine has, none is found from here on.
class NoEgl : public testing::Test {
 protected:
  void SetUp() override {
    setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent", 1);
    setenv("LIBGL_DRIVERS_PATH", "/nonexistent", 1);
  }
};

TEST_F(NoEgl, TheErrorSaysWhatWasTriedAndWhatToInstall) {
  const auto context = EglContext::create();
  ASSERT_FALSE(context);
  EXPECT_EQ(context.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(context.error().what,
              AllOf(HasSubstr("surfaceless"),
                    HasSubstr("device"),
                    HasSubstr("default display"),
                    HasSubstr("libegl1 libegl-mesa0 libgl1-mesa-dri")));
}

TEST_F(NoEgl, AnImageGivesTheSameError) {
  const auto image = render_snapshot({});
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, ErrorCode::kUnavailable);
}

TEST_F(NoEgl, BadOptionsAreSaidFirst) {
  EXPECT_EQ(render_snapshot({}, {.width_px = 1}).error().code, ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace hypermap
