// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/number_bytes.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {
namespace {

using namespace std::string_view_literals;

TEST(NumberBytes, AreLittleEndian) {
  std::string bytes;
  append_uint32(bytes, 0x01020380U);
  EXPECT_EQ(bytes, "\x80\x03\x02\x01"sv);
  EXPECT_EQ(uint32_at("x" + bytes, 1), 0x01020380U);
  // 1 is 0x3f800000, -2 is 0xc0000000; the double 1 is 0x3ff0000000000000.
  EXPECT_EQ(bytes_of_floats(std::vector<float>{1.0F, -2.0F}), "\0\0\x80\x3f\0\0\0\xc0"sv);
  EXPECT_EQ(floats_of_bytes("\0\0\x80\x3f\0\0\0\xc0"sv).value(), (std::vector<float>{1.0F, -2.0F}));
  EXPECT_EQ(doubles_of_bytes("\0\0\0\0\0\0\xf0\x3f"sv).value(), std::vector<double>{1.0});
}

TEST(NumberBytes, ACutNumberIsRefused) {
  EXPECT_EQ(floats_of_bytes("\0\0\x80"sv).error().code, ErrorCode::kMalformedFile);
  EXPECT_EQ(doubles_of_bytes("\0\0\x80\x3f"sv).error().code, ErrorCode::kMalformedFile);
  EXPECT_TRUE(floats_of_bytes("").value().empty());
}

TEST(NumberBytes, WhatIsBeyondAllFloatsIsInfinite) {
  EXPECT_EQ(rounded_to_float(0.1), 0.1F);
  EXPECT_EQ(rounded_to_float(1e300), std::numeric_limits<float>::infinity());
  EXPECT_EQ(rounded_to_float(-1e39), -std::numeric_limits<float>::infinity());
}

}  // namespace
}  // namespace hypermap
