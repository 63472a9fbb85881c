// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/caught.hpp"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <string>

namespace hypermap {
namespace {

TEST(Caught, OnlyMemoryIsCalledMemory) {
  const auto error_of = [](const std::exception& exception) {
    return caught(exception, ErrorCode::kMalformedFile, "the map").value();
  };
  EXPECT_EQ(error_of(std::bad_alloc()).code, ErrorCode::kOutOfMemory);
  EXPECT_EQ(error_of(std::bad_alloc()).what, "no memory for the map");
  EXPECT_EQ(error_of(std::bad_array_new_length()).code, ErrorCode::kOutOfMemory);
  EXPECT_EQ(error_of(std::length_error("basic_string::_M_create")).code, ErrorCode::kOutOfMemory);
  EXPECT_EQ(error_of(std::runtime_error("a\nb")).code, ErrorCode::kMalformedFile);
  EXPECT_EQ(error_of(std::runtime_error("a\nb")).what, "the map: a\\x0ab");
  EXPECT_EQ(error_of(std::out_of_range("at")).code, ErrorCode::kMalformedFile);
}

}  // namespace
}  // namespace hypermap
