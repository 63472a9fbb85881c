// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/detector_registry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

DetectorDescription yolo() {
  return {.name = "yolo",
          .type = "detection",
          .architecture = "YOLOX",
          .classes = {"cup", "dining table"}};
}

std::string clash_with_yolo(const DetectorDescription& other) {
  DetectorRegistry registry;
  EXPECT_TRUE(registry.add(yolo()));
  const DetectorRegistry before = registry;
  const auto added = registry.add(other);
  EXPECT_EQ(registry, before);
  return added ? "was accepted" : to_string(added.error());
}

TEST(DetectorRegistry, CountsDetectorsInTheOrderOfTheirAppearance) {
  DetectorRegistry registry;
  EXPECT_EQ(registry.add(yolo()), DetectorId{0});
  EXPECT_EQ(registry.add({.name = "ssd"}), DetectorId{1});
  EXPECT_EQ(registry.find("ssd"), DetectorId{1});
  EXPECT_EQ(registry.find("SSD"), std::nullopt);
  EXPECT_EQ(registry.description(DetectorId{0}), yolo());
  EXPECT_THAT(registry.names(), ElementsAre("yolo", "ssd"));
  EXPECT_FALSE(registry.contains(DetectorId{2}));
}

// [smap] 4.2: a detector that was registered before is the same.
TEST(DetectorRegistry, ADetectorThatComesBackIsTheSame) {
  DetectorRegistry registry;
  ASSERT_TRUE(registry.add(yolo()));
  DetectorDescription again = yolo();
  again.classes = {"diningtable", "Cup"};
  EXPECT_EQ(registry.add(again), DetectorId{0});
  EXPECT_EQ(registry.size(), 1U);
  EXPECT_EQ(registry.description(DetectorId{0}), yolo());
}

TEST(DetectorRegistry, WhatADetectorStatesLaterIsKept) {
  DetectorRegistry registry;
  ASSERT_TRUE(registry.add({.name = "yolo", .type = "detection"}));
  EXPECT_EQ(registry.add(yolo()), DetectorId{0});
  EXPECT_EQ(registry.description(DetectorId{0}), yolo());
  EXPECT_EQ(registry.add({.name = "yolo"}), DetectorId{0});
  EXPECT_EQ(registry.description(DetectorId{0}), yolo());
}

TEST(DetectorRegistry, AClashNamesBoth) {
  DetectorDescription other = yolo();
  other.architecture = "YOLOv5";
  EXPECT_THAT(clash_with_yolo(other),
              HasSubstr("\"yolo\" (detection, YOLOv5, 2 classes) has another architecture than the "
                        "detector \"yolo\" (detection, YOLOX, 2 classes)"));
  other = yolo();
  other.type = "segmentation";
  EXPECT_THAT(clash_with_yolo(other), HasSubstr("another type"));
  other = yolo();
  other.classes.emplace_back("sofa");
  EXPECT_THAT(clash_with_yolo(other), HasSubstr("other classes (\"sofa\" among them)"));
  other.classes = {"cup"};
  EXPECT_THAT(clash_with_yolo(other), HasSubstr("other classes (\"dining table\" not among them)"));
}

TEST(DetectorRegistry, FilesWithoutADetectorAreToldApartByNumbers) {
  DetectorRegistry registry;
  const DetectorId first = registry.add_unnamed("detections", {}).value();
  const std::vector<DetectorId> taken{first};
  const DetectorId second = registry.add_unnamed("detections", taken).value();
  EXPECT_NE(first, second);
  EXPECT_THAT(registry.names(), ElementsAre("detections", "detections 2"));
  EXPECT_EQ(registry.add_unnamed("detections", {}), first);
  EXPECT_EQ(registry.add_unnamed("detections", taken), second);
}

TEST(DetectorRegistry, RefusesWhatIsNoDescription) {
  const auto field = [](const DetectorDescription& description) {
    const auto checked = validate(description);
    return checked ? "was accepted" : checked.error().field;
  };
  EXPECT_EQ(field({.name = ""}), "name");
  EXPECT_EQ(field({.name = "a\nb"}), "name");
  EXPECT_EQ(field({.name = "\xFF"}), "name");
  EXPECT_EQ(field({.name = "a", .type = std::string(257, 't')}), "type");
  EXPECT_EQ(field({.name = "a", .architecture = std::string(1, '\0')}), "architecture");
  EXPECT_EQ(field({.name = "a", .classes = {"cup", "Cup"}}), "classes: names[1]");
  EXPECT_EQ(field({.name = "a", .classes = {""}}), "classes: names[0]");
}

TEST(DetectorRegistry, IsBounded) {
  DetectorRegistry registry;
  for (std::size_t i = 0; i < DetectorRegistry::kMaxDetectors; ++i) {
    ASSERT_TRUE(registry.add({.name = std::to_string(i)}));
  }
  EXPECT_EQ(registry.add({.name = "more"}).error().code, ErrorCode::kLimit);
  EXPECT_EQ(registry.add({.name = "7"}), DetectorId{7});
}

}  // namespace
}  // namespace hypermap
