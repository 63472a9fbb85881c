// SPDX-License-Identifier: BSD-3-Clause
// Damage to JSON lines of ours.
#include "hypermap/io/dataset/detections_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

namespace hypermap {
namespace {

using testing::HasSubstr;

std::size_t num_frames(const std::string& text) {
  const auto loaded = parse_detections(text, "a.jsonl");
  EXPECT_TRUE(loaded) << to_string(loaded.error());
  return loaded ? loaded->value.frames.size() : 0;
}

std::string head_refusal(const std::string& text) {
  const auto loaded = parse_detections(text, "a.jsonl");
  return loaded ? "was accepted" : to_string(loaded.error());
}

/// Three images of ours.
std::string headed_lines() {
  const std::string line =
      "{\"image\": \"a.png\", \"detections\": [{\"label\": \"chair\", \"score\": 0.9, "
      "\"bbox\": [10, 20, 110, 220]}]}\n";
  return to_json_lines(line + line + line);
}

TEST(DetectionsHead, AFileOfOursSaysHowManyImagesThereAre) {
  EXPECT_EQ(to_json_lines(""),
            R"({"format":"hypermap-detections","version":1,"num_images":0,"crc32":"00000000"})"
            "\n");
  EXPECT_EQ(num_frames(to_json_lines("")), 0U);
  EXPECT_EQ(num_frames(headed_lines()), 3U);
}

TEST(DetectionsHead, AFileOfOursIsNeverCutUnnoticed) {
  const std::string text = headed_lines();
  for (std::size_t size = 0; size < text.size(); ++size)
    EXPECT_FALSE(parse_detections(text.substr(0, size), "a.jsonl")) << size;
  EXPECT_THAT(head_refusal(text.substr(0, text.rfind("{\"image"))),
              HasSubstr("says 3 images, there are 2"));
}

TEST(DetectionsHead, NoBitOfAFileOfOursChangesUnnoticed) {
  const std::string text = headed_lines();
  for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
    std::string changed = text;
    changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ 1 << (bit % 8));
    EXPECT_FALSE(parse_detections(changed, "a.jsonl")) << bit / 8 << ": " << changed[bit / 8];
  }
  std::string changed = text;
  changed.replace(changed.find("0.9"), 3, "0.8");
  EXPECT_THAT(head_refusal(changed), HasSubstr("$.crc32: is '"));
}

TEST(DetectionsHead, AHeadOfANewerVersionOrWithAnotherKeyIsRefused) {
  EXPECT_THAT(head_refusal(R"({"format": "hypermap-detections", "version": 2})"),
              HasSubstr("written by a newer version 2"));
  EXPECT_THAT(
      head_refusal(
          R"({"format": "hypermap-detections", "version": 1, "num_images": 0, "crc": "00000000"})"),
      HasSubstr("crc"));
}

}  // namespace
}  // namespace hypermap
