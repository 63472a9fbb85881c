// SPDX-License-Identifier: BSD-3-Clause
// Embeddings in files of detections.
#include "hypermap/io/dataset/detections_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

DetectionSet set_of(const std::string& text) {
  auto loaded = parse_detections(text, "d.json");
  EXPECT_TRUE(loaded) << to_string(loaded.error());
  return loaded ? std::move(loaded->value) : DetectionSet{};
}

std::string refusal_of(const std::string& text, const DetectionReadOptions& options = {}) {
  const auto loaded = parse_detections(text, "d.json", options);
  return loaded ? "none" : to_string(loaded.error());
}

std::string frame_of(const std::string& detection) {
  return R"({"image": "a.png", "width": 640, "height": 480, "detections": [)" + detection + "]}";
}

/// A detection with this `embedding`.
std::string looking_like(const std::string& embedding) {
  return frame_of(R"({"label": "a", "score": 1, "bbox": [1, 2, 3, 4], "embedding": )" + embedding +
                  "}");
}

// 1 is 00 00 80 3f and -2 is 00 00 00 c0: "AACAPwAAAMA=".
TEST(DetectionsEmbedding, EmbeddingsAreNumbersOrBase64OfFloats) {
  const std::vector<Embedding> expected{{"clip", {1.0F, -2.0F}}};
  for (const char* vector : {"[1, -2.0]", "\"AACAPwAAAMA=\""}) {
    const DetectionSet set =
        set_of(looking_like(R"({"model": "clip", "vector": )" + std::string(vector) + "}"));
    EXPECT_EQ(set.frames[0].detections[0].embeddings, expected);
    EXPECT_EQ(set.embeddings.find("clip"), 2U);
    EXPECT_EQ(set_of(to_json_line(set.frames[0])).frames, set.frames);
    const auto coco = to_coco_results(set.frames, set.class_names);
    EXPECT_EQ(set_of(coco.value()).frames[0].detections[0].embeddings, expected);
    ClassRegistry registry;
    const auto known = register_classes(set.class_names, registry).value();
    const auto resolved = resolve(set.frames[0], registry, known, {}, 640, 480);
    ASSERT_TRUE(resolved);
    EXPECT_EQ(resolved->detections[0].embeddings, expected);
    EXPECT_EQ(named(resolved->detections, registry, "a.png", {}, 640, 480).detections[0].embeddings,
              expected);
  }
}

TEST(DetectionsEmbedding, ADetectionMayHaveEmbeddingsOfSeveralModels) {
  const DetectionSet set =
      set_of(looking_like(R"([{"model": "a", "vector": [1]}, {"model": "b", "vector": [0, 2]}])"));
  EXPECT_EQ(set.frames[0].detections[0].embeddings.size(), 2U);
  EXPECT_EQ(set_of(to_json_line(set.frames[0])).frames, set.frames);
}

TEST(DetectionsEmbedding, EmbeddingsThatAreNoneAreRefused) {
  const auto refused = [](const std::string& embedding) {
    return refusal_of(looking_like(embedding));
  };
  EXPECT_THAT(refused(R"({"vector": [1]})"), HasSubstr("missing key \"model\""));
  EXPECT_THAT(refused(R"({"model": "a"})"), HasSubstr("missing key \"vector\""));
  EXPECT_THAT(refused(R"({"model": "", "vector": [1]})"),
              HasSubstr("embedding.model: must not be"));
  EXPECT_THAT(refused(R"({"model": "a", "vector": []})"), HasSubstr("1 .. 4096 numbers, has 0"));
  EXPECT_THAT(refused(R"({"model": "a", "vector": [0, 0]})"), HasSubstr("is all 0"));
  EXPECT_THAT(refused(R"({"model": "a", "vector": [1e39]})"), HasSubstr("must be finite"));
  EXPECT_THAT(refused(R"({"model": "a", "vector": "AAA"})"), HasSubstr("multiple of 4 letters"));
  EXPECT_THAT(refused(R"({"model": "a", "vector": "AACA"})"), HasSubstr("multiple of 4 bytes"));
  EXPECT_THAT(refused(R"({"model": "a", "vector": "AACAfw=="})"), HasSubstr("must be finite"));
  EXPECT_THAT(refused(R"([{"model": "a", "vector": [1]}, {"model": "a", "vector": [1]}])"),
              HasSubstr("embedding[1]: must name each model once"));
  std::string five = R"({"model": "a", "vector": [1]})";
  for (int i = 0; i < 4; ++i) five += R"(, {"model": "a", "vector": [1]})";
  EXPECT_THAT(refused("[" + five + "]"), HasSubstr("at most 4 embeddings"));
}

TEST(DetectionsEmbedding, EmbeddingsOfAModelHaveOneDimension) {
  const std::string two = looking_like(R"({"model": "clip", "vector": [1, 2]})");
  const std::string three = looking_like(R"({"model": "clip", "vector": [1, 2, 3]})");
  EXPECT_THAT(
      refusal_of(two + "\n" + three + "\n"),
      HasSubstr("d.json:2: $.detections[0].embedding: of model \"clip\" must have 2 numbers "
                "as before, has 3"));
  DetectionReadOptions after_another_file;
  after_another_file.embeddings = set_of(three).embeddings;
  EXPECT_THAT(refusal_of(two, after_another_file), HasSubstr("must have 3 numbers"));
}

}  // namespace
}  // namespace hypermap
