// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/detector/onnx_detector.hpp"

#include "hypermap/io/dataset/class_names.hpp"
#include "hypermap/io/dataset/depth_file.hpp"
#include "hypermap/io/dataset/detections_file.hpp"
#include "support/sanitized.hpp"
#include "support/temp_dir.hpp"
#include "support/test_data.hpp"
#include "support/text_files.hpp"
#include "support/tiny_onnx.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core/utility.hpp>

#include <cmath>
#include <fstream>
#include <iterator>
#include <vector>

namespace hypermap {
namespace {

using test::TempDir;
using test::write_text;
using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr int kSide = 32;  // grids of 4 x 4, 2 x 2 and 1 x 1 cells
constexpr std::size_t kRows = 21;
constexpr std::size_t kLength = 7;  // x y w h objectness and two classes

OnnxDetectorOptions tiny_options() {
  return {.input_side_px = kSide, .class_names = {"cup", "chair"}};
}

/// A network that gives the same rows for every image: all zero but row 5 (stride 8, column 1,
/// row 1) and those in `more`.
std::string tiny_network(const std::vector<std::pair<std::size_t, std::vector<float>>>& rows) {
  std::vector<float> values(kRows * kLength, 0.0F);
  for (const auto& [row, numbers] : rows) {
    std::copy(numbers.begin(), numbers.end(), values.begin() + static_cast<long>(row * kLength));
  }
  return test::constant_onnx(kSide, static_cast<std::int64_t>(kRows), kLength, values);
}

Result<std::vector<Detection>> detect_with(const std::string& model, const ColorImage& image) {
  const TempDir dir;
  write_text(dir / "m.onnx", model);
  ClassRegistry registry;
  auto detector = OnnxDetector::load(dir / "m.onnx", tiny_options(), registry);
  if (!detector) return tl::make_unexpected(detector.error());
  return detector->detect(image);
}

TEST(OnnxDetector, ARowIsDecodedByItsCellAndStride) {
  // Row 5 is column 1, row 1 of stride 8: centre (0.5 + 1) * 8 = 12 across, (0.25 + 1) * 8 = 10
  // down; size e^0 * 8 = 8 by e^ln2 * 8 = 16. The image is 64 x 64, the input 32: scale 0.5, so
  // all doubles. Score 0.8 * 0.75 = 0.6; class vector 0.25, 0.75.
  const auto found =
      detect_with(tiny_network({{5, {0.5F, 0.25F, 0.0F, std::log(2.0F), 0.8F, 0.25F, 0.75F}}}),
                  ColorImage(64, 64));
  ASSERT_TRUE(found) << to_string(found.error());
  ASSERT_THAT(*found, SizeIs(1));
  const Detection& detection = found->front();
  EXPECT_NEAR(detection.box_px.u_min_px, 24 - 8, 1e-4);
  EXPECT_NEAR(detection.box_px.u_max_px, 24 + 8, 1e-4);
  EXPECT_NEAR(detection.box_px.v_min_px, 20 - 16, 1e-4);
  EXPECT_NEAR(detection.box_px.v_max_px, 20 + 16, 1e-4);
  EXPECT_NEAR(detection.score.value(), 0.6, 1e-6);
  ASSERT_THAT(detection.class_scores, SizeIs(2));
  EXPECT_NEAR(detection.class_scores[1].probability.value(), 0.75, 1e-6);
}

TEST(OnnxDetector, BoxesAreClippedToTheImage) {
  // Row 0: centre (0, 0), size 16: half of it lies outside.
  const auto found = detect_with(
      tiny_network({{0, {0.0F, 0.0F, std::log(2.0F), std::log(2.0F), 1.0F, 1.0F, 0.0F}}}),
      ColorImage(32, 32));
  ASSERT_TRUE(found) << to_string(found.error());
  ASSERT_THAT(*found, SizeIs(1));
  EXPECT_EQ(found->front().box_px.u_min_px, 0.0);
  EXPECT_NEAR(found->front().box_px.u_max_px, 8.0, 1e-4);
}

TEST(OnnxDetector, OverlapsAreSuppressedWithinAClassOnly) {
  // Cells 5 and 6 with offsets that give the same box: column 2 - 1 = column 1.
  const std::vector<float> cup{0.5F, 0.5F, 0.0F, 0.0F, 0.9F, 0.9F, 0.1F};
  const std::vector<float> same_cup{-0.5F, 0.5F, 0.0F, 0.0F, 0.8F, 0.9F, 0.1F};
  const std::vector<float> same_chair{-0.5F, 0.5F, 0.0F, 0.0F, 0.8F, 0.1F, 0.9F};
  EXPECT_THAT(*detect_with(tiny_network({{5, cup}, {6, same_cup}}), ColorImage(32, 32)), SizeIs(1));
  EXPECT_THAT(*detect_with(tiny_network({{5, cup}, {6, same_chair}}), ColorImage(32, 32)),
              SizeIs(2));
}

TEST(OnnxDetector, AScoreMustExceedTheThreshold) {
  const std::vector<float> row{0.5F, 0.5F, 0.0F, 0.0F, 0.5F, 0.5F, 0.0F};  // 0.25, not more
  EXPECT_THAT(*detect_with(tiny_network({{5, row}}), ColorImage(32, 32)), SizeIs(0));
}

TEST(OnnxDetector, NumbersThatAreNotFiniteAreRefused) {
  const auto found = detect_with(tiny_network({{5, {0.5F, 0.5F, 1e30F, 0.0F, 0.9F, 0.9F, 0.0F}}}),
                                 ColorImage(32, 32));
  ASSERT_FALSE(found);
  EXPECT_THAT(to_string(found.error()), HasSubstr("row 5"));
}

TEST(OnnxDetector, FilesThatAreNoNetworkAreRefusedAndTheRegistryStays) {
  const TempDir dir;
  ClassRegistry registry;
  const auto refused = [&](const std::string& bytes) {
    write_text(dir / "m.onnx", bytes);
    const auto detector = OnnxDetector::load(dir / "m.onnx", tiny_options(), registry);
    return detector ? std::string("was accepted") : to_string(detector.error());
  };
  const std::string good = tiny_network({});
  EXPECT_EQ(refused(good), "was accepted");
  registry = {};
  EXPECT_THAT(refused(""), HasSubstr("is no ONNX model"));
  EXPECT_THAT(refused("garbage"), HasSubstr("is no ONNX model"));
  EXPECT_THAT(refused(good.substr(0, good.size() / 2)), HasSubstr("is no ONNX model"));
  EXPECT_THAT(refused(std::string(1000, '\0')), HasSubstr("is no ONNX model"));
  EXPECT_THAT(refused(test::constant_onnx(kSide, 20, 7, std::vector<float>(140, 0.0F))),
              HasSubstr("expected yolox 1 x 21 x 7"));
  EXPECT_EQ(registry.size(), 0U);
}

TEST(OnnxDetector, OptionsOutOfRangeAreNamed) {
  EXPECT_THAT(to_string(validate(OnnxDetectorOptions{.min_score = 1.5}).error()),
              HasSubstr("min_score"));
  EXPECT_THAT(to_string(validate(OnnxDetectorOptions{.input_side_px = 100,
                                                     .network_form = NetworkForm::kYolox})
                            .error()),
              HasSubstr("multiple of 32"));
}

TEST(OnnxDetector, ClassNamesAreOneALineAndDifferent) {
  const TempDir dir;
  write_text(dir / "names.txt", "cup\r\ntraffic light\n\n");
  EXPECT_EQ(read_class_names(dir / "names.txt").value(),
            (std::vector<std::string>{"cup", "traffic light"}));
  write_text(dir / "names.txt", "tv\ntvmonitor\n");
  EXPECT_THAT(to_string(read_class_names(dir / "names.txt").error()), HasSubstr("names.txt:2"));
  write_text(dir / "names.txt", "cup\n\nchair\n");
  EXPECT_THAT(to_string(read_class_names(dir / "names.txt").error()),
              HasSubstr("must not be empty"));
  EXPECT_THAT(coco_class_names(), SizeIs(80));
}

// --- the real network against its recorded output ---

class RecordedOutput : public ::testing::TestWithParam<const char*> {};

TEST_P(RecordedOutput, IsReproducedWithinRounding) {
  const std::string folder = std::string("rgbd/") + GetParam();
  HYPERMAP_REQUIRE_SHARED_DATA(folder);
  HYPERMAP_REQUIRE_SHARED_DATA("models/yolox_nano/yolox_nano.onnx");
  if (test::kThreadSanitized) GTEST_SKIP() << "the real network runs on threads below";
  ClassRegistry registry;
  auto detector =
      OnnxDetector::load(test::shared_data("models/yolox_nano/yolox_nano.onnx"), {}, registry);
  ASSERT_TRUE(detector) << to_string(detector.error());
  const auto recorded = read_detections(test::shared_data(folder + "/detections_yolox_nano.jsonl"));
  ASSERT_TRUE(recorded);
  const auto& frames = recorded->value.frames;
  const std::size_t step = std::getenv("HYPERMAP_SLOW_TESTS") != nullptr ? 1 : frames.size() / 6;
  for (std::size_t i = 0; i < frames.size(); i += step) {
    const auto image = read_color(test::shared_data(folder + "/" + frames[i].image));
    ASSERT_TRUE(image) << to_string(image.error());
    const auto found = detector->detect(*image);
    ASSERT_TRUE(found) << to_string(found.error());
    ASSERT_EQ(found->size(), frames[i].detections.size()) << frames[i].image;
    for (std::size_t k = 0; k < found->size(); ++k) {
      const Detection& ours = (*found)[k];
      const NamedDetection& theirs = frames[i].detections[k];
      EXPECT_EQ(registry.name(best_class(ours.class_scores)->id), theirs.label);
      EXPECT_NEAR(ours.score.value(), theirs.score.value(), 1e-3);
      EXPECT_NEAR(ours.box_px.u_min_px, theirs.box_px.u_min_px, 0.11) << frames[i].image;
      EXPECT_NEAR(ours.box_px.v_min_px, theirs.box_px.v_min_px, 0.11);
      EXPECT_NEAR(ours.box_px.width_px(), theirs.box_px.width_px(), 0.11);
      EXPECT_NEAR(ours.box_px.height_px(), theirs.box_px.height_px(), 0.11);
      EXPECT_THAT(ours.class_scores, SizeIs(80));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kitchen, RecordedOutput, ::testing::Values("7scenes_redkitchen"));
INSTANTIATE_TEST_SUITE_P(Cabinet, RecordedOutput, ::testing::Values("tum_fr3_cabinet"));
INSTANTIATE_TEST_SUITE_P(LivingRoom, RecordedOutput, ::testing::Values("icl_nuim_livingroom1"));

TEST(OnnxDetector, TakesNoMoreThreadsThanItIsGiven) {
  const TempDir dir;
  write_text(dir / "m.onnx", tiny_network({}));
  ClassRegistry registry;
  OnnxDetectorOptions options = tiny_options();
  options.num_threads = 1;
  ASSERT_TRUE(OnnxDetector::load(dir / "m.onnx", options, registry));
  EXPECT_EQ(cv::getNumThreads(), 1);
  options.num_threads = 0;
  ASSERT_TRUE(OnnxDetector::load(dir / "m.onnx", options, registry));
  EXPECT_EQ(cv::getNumThreads(), cv::getNumberOfCPUs());
}

TEST(OnnxDetector, TheRealNetworkGivesTheSameNumbersTwiceAndOnAnyNumberOfThreads) {
  HYPERMAP_REQUIRE_SHARED_DATA("models/yolox_nano/yolox_nano.onnx");
  HYPERMAP_REQUIRE_SHARED_DATA("rgbd/7scenes_redkitchen");
  const auto image =
      read_color(test::shared_data("rgbd/7scenes_redkitchen/frame-000000.color.jpg"));
  ASSERT_TRUE(image);
  ClassRegistry registry;
  const auto model = test::shared_data("models/yolox_nano/yolox_nano.onnx");
  auto one = OnnxDetector::load(model, {}, registry);
  auto two = OnnxDetector::load(model, {}, registry);
  ASSERT_TRUE(one && two);
  const auto expected = one->detect(*image).value();
  if (!test::kThreadSanitized) {
    EXPECT_EQ(two->detect(*image).value(), expected);
    EXPECT_EQ(one->detect(*image).value(), expected);
  }
  for (const int num_threads : test::kThreadSanitized ? std::vector{3} : std::vector{1, 3}) {
    auto some = OnnxDetector::load(model, {.num_threads = num_threads}, registry);
    ASSERT_TRUE(some);
    EXPECT_EQ(some->detect(*image).value(), expected) << num_threads;
  }
}

}  // namespace
}  // namespace hypermap
