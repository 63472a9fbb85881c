// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/detectors_file.hpp"

#include "io/archive/archive_edits.hpp"
#include "io/archive/sample_archive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace hypermap {
namespace {

using test::all_findings;
using test::changed;
using test::kArchiveSource;
using test::load_error;
using test::member_of;
using test::sample_archive;
using testing::HasSubstr;

const SourceName kDetectorsSource{.file = "a.hmap", .entry = "detectors.yaml"};

DetectorRegistry two_detectors() {
  DetectorRegistry registry;
  EXPECT_TRUE(registry.add({.name = "yolo: 1",
                            .type = "detection",
                            .architecture = "YOLOX",
                            .classes = {"cup", "no", "007"}}));
  EXPECT_TRUE(registry.add({.name = "detections"}));
  return registry;
}

std::string detectors_refusal(const std::string& text) {
  const auto parsed = parse_detectors(text, kDetectorsSource);
  return parsed ? "was accepted" : to_string(parsed.error());
}

TEST(DetectorsFile, WhatIsWrittenIsReadAgain) {
  const std::string text = write_detectors(two_detectors());
  const auto parsed = parse_detectors(text, kDetectorsSource);
  ASSERT_TRUE(parsed) << to_string(parsed.error());
  EXPECT_EQ(parsed->value, two_detectors());
  EXPECT_TRUE(parsed->findings.empty());
  EXPECT_EQ(write_detectors(parsed->value), text);
}

TEST(DetectorsFile, RefusalsNameLineAndField) {
  EXPECT_THAT(detectors_refusal("- {name: a}\n- {name: a}\n"),
              HasSubstr("a.hmap!detectors.yaml:2: [1]: \"a\" is there twice"));
  EXPECT_THAT(detectors_refusal("- {type: detection}\n"), HasSubstr("name"));
  EXPECT_THAT(detectors_refusal("- {name: \"\"}\n"), HasSubstr("must not be empty"));
  EXPECT_THAT(detectors_refusal("- {name: a, classes: [cup, CUP]}\n"), HasSubstr("names[1]"));
  EXPECT_THAT(detectors_refusal("name: a\n"), HasSubstr("detectors.yaml:1"));
  const auto parsed = parse_detectors("- {name: a, colour: red}\n", kDetectorsSource);
  ASSERT_TRUE(parsed);
  EXPECT_EQ(parsed->findings.size(), 1U);
}

TEST(DetectorsFile, IsPartOfTheArchive) {
  MapArchive archive = sample_archive();
  archive.detectors = two_detectors();
  const std::string bytes = write_archive(archive).value();
  const auto loaded = parse_archive(bytes, kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(all_findings(loaded->findings), "");
  EXPECT_TRUE(loaded->value == archive);
  EXPECT_FALSE(loaded->value == sample_archive());
  EXPECT_EQ(write_archive(loaded->value).value(), bytes);
  EXPECT_THAT(load_error(changed(bytes, {{"detectors.yaml", "- {name: 1, name: 2}\n"}})),
              HasSubstr("detectors.yaml:1"));
  const std::string config = member_of(bytes, "hmap_config.yaml");
  const std::string second =
      "  - {format: hypermap-detectors, version: 1, name: again, frame_id: map, file: b.yaml}\n";
  EXPECT_THAT(load_error(changed(bytes, {{"hmap_config.yaml", config + second}})),
              HasSubstr("a second 'hypermap-detectors'"));
}

}  // namespace
}  // namespace hypermap
