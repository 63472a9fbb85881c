// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/detections_file.hpp"

#include "support/temp_dir.hpp"
#include "support/test_data.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hypermap {
namespace {

using test::TempDir;
using test::write_text;
using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

std::string frame(const std::string& detections) {
  return R"({"image": "a.png", "width": 640, "height": 480, "detections": [)" + detections + "]}";
}

DetectionSet parsed_detections(const std::string& text, const DetectionReadOptions& options = {}) {
  auto loaded = parse_detections(text, "d.json", options);
  EXPECT_TRUE(loaded) << to_string(loaded.error());
  return loaded ? std::move(loaded->value) : DetectionSet{};
}

std::string detections_refusal(const std::string& text, const DetectionReadOptions& options = {}) {
  const auto loaded = parse_detections(text, "d.json", options);
  return loaded ? "was accepted" : to_string(loaded.error());
}

const std::string kChair = R"({"label": "chair", "score": 0.9, "bbox": [10, 20, 110, 220]})";

TEST(DetectionsFile, AFrameGivesImageBoxAndScore) {
  const DetectionSet set = parsed_detections(frame(kChair));
  ASSERT_THAT(set.frames, SizeIs(1));
  EXPECT_EQ(set.frames[0].image, "a.png");
  ASSERT_THAT(set.frames[0].detections, SizeIs(1));
  const NamedDetection& detection = set.frames[0].detections[0];
  EXPECT_EQ(detection.label, "chair");
  EXPECT_EQ(detection.score.value(), 0.9);
  EXPECT_EQ(detection.box_px, (PixelBox{10, 20, 110, 220}));
  EXPECT_THAT(set.class_names, ElementsAre("chair"));
}

TEST(DetectionsFile, LinesAreFramesAndStampsAreExact) {
  const DetectionSet set = parsed_detections(
      "{\"timestamp\": 1341841278.842700001, \"detections\": []}\n\n"
      "{\"timestamp\": \"1.5\", \"detections\": [{\"class\": \"cup\", \"score\": 1,"
      " \"bbox_xywh\": [1, 2, 3, 4]}]}\n");
  ASSERT_THAT(set.frames, SizeIs(2));
  EXPECT_EQ(set.frames[0].stamp->ns, 1341841278842700001);
  EXPECT_EQ(set.frames[1].stamp->ns, 1500000000);
  EXPECT_EQ(set.frames[1].detections[0].box_px, (PixelBox{1, 2, 4, 6}));
}

TEST(DetectionsFile, AnErrorInALineNamesTheLine) {
  EXPECT_THAT(
      detections_refusal(frame(kChair) + "\n" + frame(R"({"label": "x", "score": 2})") + "\n"),
      HasSubstr("d.json:2: $.detections[0].score: must be in 0 .. 1, is 2"));
}

TEST(DetectionsFile, ABoxBeyondTheImageIsClippedAndCounted) {
  const auto loaded =
      parse_detections(frame(R"({"label": "a", "score": 1, "bbox": [-10, -10, 99999, 50]})"), "d");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(loaded->value.num_clipped, 1U);
  EXPECT_EQ(loaded->value.frames[0].detections[0].box_px, (PixelBox{0, 0, 640, 50}));
  ASSERT_THAT(loaded->findings, SizeIs(1));
  EXPECT_THAT(loaded->findings[0].error.what, HasSubstr("1 box(es)"));
}

TEST(DetectionsFile, BoxesWithoutSenseAreRefused) {
  const auto refused = [](const std::string& box) {
    return detections_refusal(frame(R"({"label": "a", "score": 1, "bbox": )" + box + "}"));
  };
  EXPECT_THAT(refused("[1, 2, 3]"), HasSubstr("must have 4 numbers, has 3"));
  EXPECT_THAT(refused("[10, 10, 10, 20]"), HasSubstr("must have an area"));
  EXPECT_THAT(refused("[20, 10, 10, 20]"), HasSubstr("must have an area"));
  EXPECT_THAT(refused("[1, 2, 1e300, 4]"), HasSubstr("$.detections[0].bbox[2]"));
  EXPECT_THAT(refused("[700, 10, 800, 20]"), HasSubstr("wholly outside"));
  EXPECT_THAT(refused("[1, 2, null, 4]"), HasSubstr("is null, expected a number"));
}

TEST(DetectionsFile, LabelsArePlainTextWithinLimits) {
  const auto with_label = [](const std::string& label) {
    return frame(R"({"label": ")" + label + R"(", "score": 1, "bbox": [1, 2, 3, 4]})");
  };
  EXPECT_EQ(parsed_detections(with_label("../../etc\\n- evil: true")).class_names[0],
            "../../etc\n- evil: true");
  EXPECT_THAT(detections_refusal(with_label("")), HasSubstr("must not be empty"));
  EXPECT_THAT(detections_refusal(with_label("a\\u0000b")), HasSubstr("NUL"));
  EXPECT_THAT(detections_refusal(with_label(std::string(257, 'a'))),
              HasSubstr("at most 256 bytes"));
}

TEST(DetectionsFile, AFrameHoldsAThousandDetectionsAndNoMore) {
  std::string many = kChair;
  for (int i = 1; i < 1000; ++i) many += "," + kChair;
  EXPECT_EQ(parsed_detections(frame(many)).num_detections(), 1000U);
  EXPECT_THAT(detections_refusal(frame(many + "," + kChair)), HasSubstr("at most 1000 detections"));
}

TEST(DetectionsFile, CompressedRunsOfCocoAreRead) {
  // Runs 1 3 2 4: 1 -> '1', 3 -> '3', 2 -> '2', then 4 - 3 = 1 -> '1'.
  const std::string text =
      R"({"image": "a", "width": 2, "height": 5, "detections": [{"label": "a", "score": 1,)"
      R"( "bbox": [0, 0, 1, 1], "mask": {"size": [5, 2], "counts": "1321"}}]})";
  EXPECT_EQ(parsed_detections(text).frames[0].detections[0].mask->runs,
            (std::vector<std::uint32_t>{1, 3, 2, 4}));
}

TEST(DetectionsFile, ClassVectorsAreScaledAndOthersSpread) {
  ClassRegistry registry;
  const DetectionSet set = parsed_detections(frame(
      R"({"label": "chair", "score": 0.8, "bbox": [1, 2, 3, 4], "scores": {"chair": 0.6, "sofa": 0.2}},)"
      R"({"label": "sofa", "score": 0.7, "bbox": [1, 2, 3, 4]},)"
      R"({"label": "cup", "score": 0.5, "bbox": [1, 2, 3, 4]})"));
  const auto known = register_classes(set.class_names, registry);
  ASSERT_TRUE(known);
  const auto resolved = resolve(set.frames[0], registry, *known, DetectorId{2}, 640, 480);
  ASSERT_TRUE(resolved) << to_string(resolved.error());
  // 0.6 / 0.8 and 0.2 / 0.8.
  const Detection& first = resolved->detections[0];
  EXPECT_THAT(first.class_scores[0].probability.value(), DoubleEq(0.75));
  EXPECT_THAT(first.class_scores[1].probability.value(), DoubleEq(0.25));
  EXPECT_EQ(first.detector, DetectorId{2});
  // 0.7 for sofa, (1 - 0.7) / 2 for chair and cup each.
  const Detection& second = resolved->detections[1];
  ASSERT_THAT(second.class_scores, SizeIs(3));
  EXPECT_THAT(second.class_scores[0].probability.value(), ::testing::DoubleNear(0.15, 1e-12));
  EXPECT_EQ(second.class_scores[1].probability.value(), 0.7);
}

TEST(DetectionsFile, SpellingsOfAClassAreOneClass) {
  const DetectionSet set =
      parsed_detections(frame(R"({"label": "tv", "score": 0.5, "bbox": [1, 2, 3, 4]},)"
                              R"({"label": "Tv-Monitor", "score": 0.5, "bbox": [1, 2, 3, 4]})"));
  EXPECT_THAT(distinct_classes(set.class_names), ElementsAre("tv"));
  EXPECT_THAT(
      detections_refusal(frame(
          R"({"label": "a", "score": 0.5, "bbox": [1, 2, 3, 4], "scores": {"tv": 0.5, "TV": 0.1}})")),
      HasSubstr("another spelling"));
}

TEST(DetectionsFile, ResolvingChecksTheImagesSize) {
  ClassRegistry registry;
  const DetectionSet set = parsed_detections(frame(kChair));
  const auto known = register_classes(set.class_names, registry).value();
  EXPECT_THAT(to_string(resolve(set.frames[0], registry, known, {}, 320, 240).error()),
              HasSubstr("640 x 480, expected 320 x 240"));
}

TEST(DetectionsFile, WrittenLinesReadBackTheSame) {
  const std::string text =
      R"({"image": "a/b.png", "timestamp": 1.000000001, "width": 2, "height": 3, "detections": [)"
      R"({"label": "x \"y\"", "score": 0.1, "bbox": [0, 0.3333333333333333, 1, 2],)"
      R"( "scores": {"x \"y\"": 0.1, "z": 1e-10}, "mask": {"size": [3, 2], "counts": [1, 3, 2]}}]})";
  const DetectionSet set = parsed_detections(text);
  EXPECT_EQ(to_json_line(set.frames[0]), text + "\n");
  EXPECT_EQ(parsed_detections(to_json_line(set.frames[0])).frames, set.frames);
}

TEST(DetectionsFile, WrittenCocoResultsReadBackTheSame) {
  DetectionSet set = parsed_detections(frame(
      R"({"label": "cup", "score": 0.25, "bbox": [1, 2, 3, 5], "scores": {"chair": 0.1, "cup": 0.25}})"));
  const auto text = to_coco_results(set.frames, set.class_names);
  ASSERT_TRUE(text);
  const DetectionSet again = parsed_detections(*text);
  ASSERT_THAT(again.frames, SizeIs(1));
  EXPECT_EQ(again.frames[0].image, "a.png");
  EXPECT_EQ(again.frames[0].detections, set.frames[0].detections);
  EXPECT_THAT(*text, HasSubstr(R"("image_id": 0)"));
  EXPECT_THAT(*text, HasSubstr(R"("bbox": [1, 2, 2, 3])"));
}

TEST(DetectionsFile, CocoNumbersAreNamedByTheirTables) {
  const DetectionSet set = parsed_detections(
      R"({"images": [{"id": 7, "file_name": "b.jpg", "width": 10, "height": 10}, {"id": 8, "file_name": "c.jpg"}],)"
      R"( "categories": [{"id": 3, "name": "tv"}, {"id": 1, "name": "cup"}],)"
      R"( "annotations": [{"id": 1, "image_id": 7, "category_id": 3, "bbox": [1, 1, 4, 4], "score": 0.5}]})");
  ASSERT_THAT(set.frames, SizeIs(2));
  EXPECT_EQ(set.frames[0].image, "b.jpg");
  EXPECT_EQ(set.frames[0].detections[0].label, "tv");
  EXPECT_THAT(set.frames[1].detections, SizeIs(0));
  EXPECT_THAT(set.class_names, ElementsAre("cup", "tv"));
  EXPECT_THAT(detections_refusal(
                  R"([{"image_id": 7, "category_id": 3, "bbox": [1, 1, 4, 4], "score": 0.5}])"),
              HasSubstr("$[0].category_id: must be one of the categories, is 3"));
}

TEST(DetectionsFile, CocoTablesMayLieBesideTheList) {
  const TempDir dir;
  write_text(dir / "images.json", R"({"images": [{"id": 7, "file_name": "b.jpg"}]})");
  write_text(dir / "categories.json", R"({"categories": [{"id": 3, "name": "tv"}]})");
  write_text(dir / "results.json",
             R"([{"image_id": 7, "category_id": 3, "bbox": [1, 1, 4, 4], "score": 0.5}])");
  const auto loaded = read_detections(dir / "results.json");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(loaded->value.frames[0].image, "b.jpg");
  EXPECT_EQ(loaded->value.frames[0].detections[0].label, "tv");
}

TEST(DetectionsFile, YoloTextIsInSharesOfTheImage) {
  const TempDir dir;
  write_text(dir / "labels" / "0001.txt", "1 0.5 0.5 0.5 0.25 0.75\n");
  write_text(dir / "labels" / "0002.txt", "");
  const auto loaded = read_detections(dir / "labels", {.class_names = {"cup", "chair"}});
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  ASSERT_THAT(loaded->value.frames, SizeIs(2));
  ClassRegistry registry;
  const auto known = register_classes(loaded->value.class_names, registry).value();
  const auto resolved = resolve(loaded->value.frames[0], registry, known, {}, 640, 480);
  ASSERT_TRUE(resolved) << to_string(resolved.error());
  // Centre (320, 240), size 320 x 120.
  EXPECT_EQ(resolved->detections[0].box_px, (PixelBox{160, 180, 480, 300}));
  EXPECT_EQ(resolved->detections[0].score.value(), 0.75);
  EXPECT_EQ(best_class(resolved->detections[0].class_scores)->id, *registry.find("chair"));
}

TEST(DetectionsFile, PlainBoxesOfTheCabinetAreRead) {
  HYPERMAP_REQUIRE_SHARED_DATA("rgbd/tum_fr3_cabinet");
  const auto loaded = read_detections(test::shared_data("rgbd/tum_fr3_cabinet/filter_2d_obj_txts"));
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_THAT(loaded->value.frames, SizeIs(58));
  EXPECT_EQ(loaded->value.num_detections(), 51U);
  EXPECT_EQ(loaded->value.frames[0].detections[0].box_px, (PixelBox{175, 24, 560, 397}));
  EXPECT_THAT(loaded->value.class_names, ElementsAre("object"));
}

TEST(DetectionsFile, ADetectorsRecordedOutputIsRead) {
  HYPERMAP_REQUIRE_SHARED_DATA("rgbd/7scenes_redkitchen");
  const auto loaded =
      read_detections(test::shared_data("rgbd/7scenes_redkitchen/detections_yolox_nano.jsonl"));
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_THAT(loaded->value.frames, SizeIs(200));
  EXPECT_THAT(loaded->findings, SizeIs(0));
}

}  // namespace
}  // namespace hypermap
