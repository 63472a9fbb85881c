// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/base64.hpp"

#include <gtest/gtest.h>

#include <string>

namespace hypermap {
namespace {

// RFC 4648 section 10.
TEST(Base64, WritesAndReadsTheVectorsOfItsStandard) {
  const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors) {
    EXPECT_EQ(encode_base64(bytes), text);
    EXPECT_EQ(decode_base64(text).value(), bytes);
  }
}

TEST(Base64, AllBytesComeBack) {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
  for (std::size_t n = 0; n < 5; ++n) {
    EXPECT_EQ(decode_base64(encode_base64(bytes.substr(n))).value(), bytes.substr(n));
  }
}

TEST(Base64, WhatAnotherWriterWouldNotWriteIsRefused) {
  for (const char* text : {"Zg",
                           "Zg=",
                           "Zg===",
                           "====",
                           "Z===",
                           "Zg==Zg==",
                           "Zm9\n",
                           "Zm9-",
                           "Zh==",
                           "Zm9=",
                           "=Zm9",
                           "Zm9v "}) {
    EXPECT_EQ(decode_base64(text).error().code, ErrorCode::kMalformedFile) << text;
  }
}

}  // namespace
}  // namespace hypermap
