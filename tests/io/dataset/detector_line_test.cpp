// SPDX-License-Identifier: BSD-3-Clause
// Who speaks in a detections file.
#include "hypermap/io/dataset/detections_file.hpp"
#include "opened_dataset.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

namespace hypermap {
namespace {

using test::opened;
using test::refusal;
using test::TempDir;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kYoloLine =
    R"({"detector": {"name": "yolo", "architecture": "YOLOX", "classes": ["sofa", "chair"]}})"
    "\n";

DetectionSet parsed_set(const std::string& text) {
  const auto loaded = parse_detections(text, "a.jsonl");
  EXPECT_TRUE(loaded) << to_string(loaded.error());
  return loaded ? loaded->value : DetectionSet{};
}

std::string line_refusal(const std::string& text) {
  const auto loaded = parse_detections(text, "a.jsonl");
  return loaded ? "was accepted" : to_string(loaded.error());
}

TEST(DetectorLine, SaysWhoSpeaksAndWhatItCanName) {
  const DetectionSet set = parsed_set(kYoloLine + test::chair_in("a.png"));
  EXPECT_EQ(set.detector.name, "yolo");
  EXPECT_EQ(set.detector.type, "");
  EXPECT_EQ(set.detector.architecture, "YOLOX");
  EXPECT_THAT(set.class_names, ElementsAre("sofa", "chair"));
  EXPECT_EQ(set.frames.size(), 1U);
  EXPECT_EQ(parsed_set(kYoloLine).detector.name, "yolo");
  EXPECT_EQ(parsed_set(test::chair_in("a.png")).detector, DetectorDescription{});
}

TEST(DetectorLine, IsPartOfWhatTheHeadProtects) {
  const DetectorDescription detector{
      .name = "y\"1", .type = "detection", .architecture = "X", .classes = {"cup", "chair"}};
  const std::string text = to_json_lines(test::chair_in("a.png"), detector);
  const DetectionSet set = parsed_set(text);
  EXPECT_EQ(set.detector, detector);
  EXPECT_EQ(set.frames.size(), 1U);
  EXPECT_EQ(parsed_set(to_json_lines("", detector)).detector, detector);
  for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
    std::string changed = text;
    changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ 1 << (bit % 8));
    EXPECT_FALSE(parse_detections(changed, "a.jsonl")) << bit / 8 << ": " << changed[bit / 8];
  }
}

TEST(DetectorLine, RefusalsNameTheLine) {
  EXPECT_THAT(line_refusal(test::chair_in("a.png") + kYoloLine),
              HasSubstr("a.jsonl:2: $: the detector must be named once, before the first image"));
  EXPECT_THAT(line_refusal(kYoloLine + kYoloLine), HasSubstr("must be named once"));
  EXPECT_THAT(line_refusal(R"({"detector": {"type": "detection"}})"), HasSubstr("name"));
  EXPECT_THAT(line_refusal(R"({"detector": {"name": "a", "colour": 1}})"), HasSubstr("colour"));
  EXPECT_THAT(line_refusal(R"({"detector": {"name": "a", "classes": ["x", "X"]}})"),
              HasSubstr("$.detector: classes: names[1]"));
  EXPECT_THAT(line_refusal(R"({"detector": {"name": ""}})"), HasSubstr("must not be empty"));
  EXPECT_THAT(line_refusal(R"({"detector": "yolo"})"), HasSubstr("$.detector"));
}

TEST(DetectorLine, AFrameMayHaveAKeyOfThatName) {
  const DetectionSet set = parsed_set(R"({"image": "a.png", "detector": 3, "detections": []})");
  EXPECT_EQ(set.frames.size(), 1U);
  EXPECT_EQ(set.detector.name, "");
}

TEST(DetectorLine, FilesThatDoNotSayAreCalledByTheirStems) {
  const TempDir folder;
  test::write_tum(folder.path());
  test::write_text(folder / "a/yolo.jsonl", test::chair_in("rgb/102.010.pgm"));
  test::write_text(folder / "b/yolo.jsonl", test::chair_in("rgb/103.010.pgm"));
  test::write_text(folder / "ssd.jsonl", kYoloLine + test::chair_in("rgb/102.010.pgm"));
  ClassRegistry classes;
  const auto reader = opened(
      folder.path(),
      classes,
      {.detections = {folder / "a/yolo.jsonl", folder / "b/yolo.jsonl", folder / "ssd.jsonl"}});
  ASSERT_NE(reader, nullptr);
  EXPECT_THAT(reader->summary().detectors.names(), ElementsAre("yolo", "yolo 2"))
      << "a file that says who speaks is that detector's, whatever the file is called";
}

TEST(DetectorLine, ACocoObjectMaySayItToo) {
  const auto coco = [](const std::string& detector) {
    return R"({"detector": )" + detector +
           R"(, "images": [{"id": 1, "file_name": "a.png"}], "categories": [{"id": 2, "name": "cup"}],)"
           R"( "annotations": [{"image_id": 1, "category_id": 2, "bbox": [0, 0, 5, 5], "score": 1}]})";
  };
  const DetectionSet set = parsed_set(coco(R"({"name": "yolo", "classes": ["cup", "saucer"]})"));
  EXPECT_EQ(set.detector.name, "yolo");
  EXPECT_EQ(set.frames.size(), 1U);
  EXPECT_THAT(set.class_names, testing::UnorderedElementsAre("cup", "saucer"));
  EXPECT_THAT(line_refusal(coco(R"("ssd")")), HasSubstr("$.detector"));
  EXPECT_THAT(line_refusal(coco(R"({"type": "boxes"})")), HasSubstr("name"));
}

TEST(DetectorLine, WhoAsksMayNameTheDetectorsOfFiles) {
  const TempDir folder;
  test::write_tum(folder.path());
  test::write_text(folder / "a.jsonl", test::chair_in("rgb/102.010.pgm"));
  test::write_text(folder / "b.jsonl", test::chair_in("rgb/103.010.pgm"));
  test::write_text(folder / "y.jsonl", kYoloLine + test::chair_in("rgb/102.010.pgm"));
  DatasetOptions options{.detections = {folder / "a.jsonl", folder / "y.jsonl", folder / "b.jsonl"},
                         .detector_names = {"ssd", "yolo"}};
  ClassRegistry classes;
  const auto reader = opened(folder.path(), classes, options);
  ASSERT_NE(reader, nullptr);
  EXPECT_THAT(reader->summary().detectors.names(), ElementsAre("ssd", "yolo", "b"));
  options.detector_names = {"ssd", "other"};
  EXPECT_THAT(refusal(folder.path(), options),
              HasSubstr("y.jsonl: detector: is of detector \"yolo\" by what it says, not of "
                        "\"other\""));
  options.detector_names = {std::string(257, 'x')};
  EXPECT_THAT(refusal(folder.path(), options), HasSubstr("a.jsonl"));
}

TEST(DetectorLine, OneFileGivenTwiceIsNoSecondDetector) {
  const TempDir folder;
  test::write_tum(folder.path());
  const std::string chair = test::chair_in("rgb/102.010.pgm");
  test::write_text(folder / "a.jsonl", chair);
  test::write_text(folder / "copy.jsonl", chair);
  test::write_text(folder / "y.jsonl", kYoloLine + chair);
  EXPECT_THAT(refusal(folder.path(), {.detections = {folder / "a.jsonl", folder / "copy.jsonl"}}),
              HasSubstr("copy.jsonl: says what"));
  EXPECT_THAT(refusal(folder.path(), {.detections = {folder / "y.jsonl", folder / "y.jsonl"}}),
              HasSubstr("the same evidence would count twice"));
  ClassRegistry classes;
  EXPECT_NE(
      opened(folder.path(), classes, {.detections = {folder / "a.jsonl", folder / "y.jsonl"}}),
      nullptr)
      << "two detectors may agree";
}

TEST(DetectorLine, ADetectorThatSpeaksOfAFrameInTwoFilesIsTold) {
  const TempDir folder;
  test::write_tum(folder.path());
  test::write_text(folder / "a.jsonl", kYoloLine + test::chair_in("rgb/102.010.pgm"));
  test::write_text(folder / "other.jsonl", kYoloLine + test::chair_in("rgb/103.010.pgm"));
  test::write_text(
      folder / "more.jsonl",
      kYoloLine + test::chair_in("rgb/103.010.pgm") + test::chair_in("rgb/102.010.pgm"));
  const auto findings = [&](const char* second) {
    ClassRegistry classes;
    const auto reader =
        opened(folder.path(), classes, {.detections = {folder / "a.jsonl", folder / second}});
    std::string text;
    for (const Finding& finding : reader->summary().findings) text += to_string(finding.error);
    return text;
  };
  EXPECT_EQ(findings("other.jsonl"), "") << "parts of one detector's words";
  EXPECT_THAT(findings("more.jsonl"),
              AllOf(HasSubstr("more.jsonl: detector: speaks for the same detector as"),
                    HasSubstr("in 1 frame of both: what it saw there counts twice")));
}

TEST(DetectorLine, LabelsThatTheDetectorDoesNotStateAreTold) {
  const auto warnings_of = [](const std::string& text) {
    const auto loaded = parse_detections(text, "a.jsonl");
    EXPECT_TRUE(loaded) << to_string(loaded.error());
    std::string all;
    for (const Finding& one : loaded->findings) all += to_string(one.error);
    return all;
  };
  const std::string chair = test::chair_in("a.png");
  const auto stating = [](const std::string& classes) {
    return R"({"detector": {"name": "yolo", "classes": [)" + classes + "]}}\n";
  };
  EXPECT_EQ(warnings_of(chair + chair), "");
  EXPECT_EQ(warnings_of(stating(R"("Chair")") + chair), "") << "another spelling";
  EXPECT_EQ(warnings_of(stating("") + chair), "") << "no classes are stated";
  EXPECT_EQ(warnings_of(stating(R"("cup")") + chair + chair),
            "a.jsonl: label: 1 label that the detector does not state among its classes: "
            "\"chair\"");
}

TEST(DetectorLine, DetectorsThatAreKnownKeepTheirIds) {
  const TempDir folder;
  test::write_tum(folder.path());
  test::write_text(folder / "new.jsonl", test::chair_in("rgb/102.010.pgm"));
  test::write_text(folder / "y.jsonl", kYoloLine + test::chair_in("rgb/102.010.pgm"));
  DatasetOptions options{.detections = {folder / "new.jsonl", folder / "y.jsonl"}};
  ASSERT_TRUE(options.detectors.add({.name = "yolo", .architecture = "YOLOX"}));
  ClassRegistry classes;
  const auto reader = opened(folder.path(), classes, options);
  ASSERT_NE(reader, nullptr);
  const auto frame = reader->read(2);
  ASSERT_TRUE(frame);
  ASSERT_EQ(frame->detections.size(), 2U);
  EXPECT_EQ(frame->detections[0].detector, DetectorId{1});
  EXPECT_EQ(frame->detections[1].detector, DetectorId{0});
  DatasetOptions clash{.detections = {folder / "y.jsonl"}};
  ASSERT_TRUE(clash.detectors.add({.name = "yolo", .architecture = "YOLOv5"}));
  EXPECT_THAT(refusal(folder.path(), clash),
              HasSubstr("y.jsonl: detector: \"yolo\" (YOLOX, 2 classes) has another architecture "
                        "than the detector \"yolo\" (YOLOv5)"));
}

}  // namespace
}  // namespace hypermap
