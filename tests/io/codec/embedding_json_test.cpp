// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/embedding_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

Result<Embedding> embedding_of(const std::string& text) {
  const auto document = JsonDocument::parse(text, "e.json");
  EXPECT_TRUE(document) << text;
  return parse_embedding(document->root());
}

TEST(EmbeddingJson, WhatIsWrittenReadsBackBitByBit) {
  const Embedding embedding{"a \"model\"", {0.1F, -0.0F, 1e-40F, 3e38F}};
  EXPECT_EQ(embedding_of(embedding_json(embedding)).value(), embedding);
  EXPECT_EQ(embedding_json({"m", {1.0F}}), R"({"model": "m", "vector": "AACAPw=="})");
}

TEST(EmbeddingJson, AListMayHaveAsManyNumbersAsAnEmbedding) {
  std::string list = "[1";
  for (std::size_t i = 1; i < kMaxEmbeddingDimension; ++i) list += ", 1";
  EXPECT_EQ(embedding_of(R"({"model": "m", "vector": )" + list + "]}")->vector.size(), 4096U);
  EXPECT_THAT(to_string(embedding_of(R"({"model": "m", "vector": )" + list + ", 1]}").error()),
              HasSubstr("e.json:1: $.vector: must have 1 .. 4096 numbers, has 4097"));
}

}  // namespace
}  // namespace hypermap
