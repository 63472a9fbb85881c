// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/embedding.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

std::string refusal_of(const Embedding& embedding) {
  const auto valid = validate(embedding);
  return valid ? "" : to_string(valid.error());
}

TEST(Embedding, IsBounded) {
  EXPECT_EQ(refusal_of({"m", {1.0F}}), "");
  EXPECT_EQ(refusal_of({"m", std::vector<float>(4096, 1.0F)}), "");
  EXPECT_THAT(refusal_of({"m", {}}), HasSubstr("1 .. 4096 numbers, has 0"));
  EXPECT_THAT(refusal_of({"m", std::vector<float>(4097, 1.0F)}), HasSubstr("has 4097"));
  EXPECT_THAT(refusal_of({"m", {0.0F, -0.0F}}), HasSubstr("is all 0"));
  EXPECT_THAT(refusal_of({"m", {1.0F, std::numeric_limits<float>::infinity()}}),
              HasSubstr("number 1 is inf"));
  EXPECT_THAT(refusal_of({"", {1.0F}}), HasSubstr("model: must not be empty"));
  EXPECT_THAT(refusal_of({"a\nb", {1.0F}}), HasSubstr("control characters"));
  EXPECT_THAT(refusal_of({"a\xff", {1.0F}}), HasSubstr("UTF-8"));
  EXPECT_THAT(refusal_of({std::string(257, 'm'), {1.0F}}), HasSubstr("at most 256 bytes"));
}

TEST(Embedding, ADetectionHasOneOfEachModelAndFourAtMost) {
  std::vector<Embedding> several;
  for (const char* model : {"a", "b", "c", "d"}) several.push_back({model, {1.0F}});
  EXPECT_TRUE(validate(several));
  several.back().model = "b";
  EXPECT_THAT(to_string(validate(several).error()), HasSubstr("b is there twice"));
  several.push_back({"e", {1.0F}});
  EXPECT_EQ(validate(several).error().code, ErrorCode::kLimit);
}

// (3, 4) / 5 = (0.6, 0.8).
TEST(UnitVector, HasTheDirectionAndLengthOne) {
  EXPECT_EQ(unit_vector(std::vector<float>{3.0F, 4.0F}), (std::vector<float>{0.6F, 0.8F}));
  const float least = std::numeric_limits<float>::denorm_min();
  EXPECT_EQ(unit_vector(std::vector<float>{0.0F, -least}), (std::vector<float>{0.0F, -1.0F}));
  const float most = std::numeric_limits<float>::max();
  EXPECT_FLOAT_EQ(unit_vector(std::vector<float>{most, most})[0], 0.70710678F);
}

// (1, 2, 2) . (2, 1, -2) = 0; (3, 4) . (4, 3) / 25 = 0.96.
TEST(CosineSimilarity, IsThatOfTheDirections) {
  const auto cosine = [](std::vector<float> a, std::vector<float> b) {
    return cosine_similarity(a, b);
  };
  EXPECT_DOUBLE_EQ(cosine({1, 2, 2}, {2, 1, -2}), 0.0);
  EXPECT_DOUBLE_EQ(cosine({3, 4}, {4, 3}), 0.96);
  EXPECT_DOUBLE_EQ(cosine({3, 4}, {-30, -40}), -1.0);
  EXPECT_DOUBLE_EQ(cosine({0, 0}, {1, 0}), 0.0);
}

TEST(EmbeddingDimensions, TheFirstOfAModelDecides) {
  EmbeddingDimensions dimensions;
  EXPECT_EQ(dimensions.find("clip"), std::nullopt);
  EXPECT_TRUE(dimensions.add("clip", 512));
  EXPECT_TRUE(dimensions.add("clip", 512));
  EXPECT_TRUE(dimensions.add("dino", 768));
  const auto clash = dimensions.add("clip", 768);
  EXPECT_THAT(to_string(clash.error()),
              HasSubstr("\"clip\" must have 512 numbers as before, has 768"));
  EXPECT_EQ(dimensions.find("clip"), 512U);
}

TEST(EmbeddingDimensions, KnowsSixtyFourModels) {
  EmbeddingDimensions dimensions;
  for (std::size_t i = 0; i < kMaxMapModels; ++i) {
    EXPECT_TRUE(dimensions.add(std::to_string(i), 1 + i));
  }
  EXPECT_EQ(dimensions.add("one more", 1).error().code, ErrorCode::kLimit);
  EXPECT_TRUE(dimensions.add("0", 1));
}

}  // namespace
}  // namespace hypermap
