// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/rendering/egl_context.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

namespace hypermap {
namespace {

using testing::HasSubstr;

TEST(EglContext, SaysHowItDrawsAndKnowsFunctions) {
  auto context = EglContext::create();
  if (!context) GTEST_SKIP() << to_string(context.error());
  EXPECT_THAT(context->description(), HasSubstr("OpenGL"));
  EXPECT_NE(context->function("glClear"), nullptr);
}

TEST(EglContext, CanBeMovedAndMadeAgain) {
  auto first = EglContext::create();
  if (!first) GTEST_SKIP() << to_string(first.error());
  EglContext moved = std::move(*first);
  EXPECT_NE(moved.function("glClear"), nullptr);
  {
    auto second = EglContext::create();
    ASSERT_TRUE(second);
    EXPECT_EQ(second->description(), moved.description());
  }
  EXPECT_TRUE(EglContext::create());
}

}  // namespace
}  // namespace hypermap
