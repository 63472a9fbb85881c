// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/simulated_detector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace hypermap {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr int kFrames = 4000;

/// A chair of 100 x 80 pixels in the middle of the image, and what a detector makes of it.
struct Rig {
  explicit Rig(const SimulatedDetectorOptions& options, std::string_view class_name = "chair")
      : instances(kWidth, kHeight),
        detector(SimulatedDetector::create(options, registry, 42).value()) {
    for (int v = 200; v < 280; ++v) {
      for (int u = 300; u < 400; ++u) instances.at(u, v) = ObjectId{1};
    }
    objects = visible_objects(instances, std::array{class_name});
    objects.at(0).unhidden_share = 1.0;
  }

  [[nodiscard]] std::vector<Detection> detect(std::uint64_t frame) const {
    return detector.detect(objects, instances, frame).detections;
  }
  [[nodiscard]] std::string named(const Detection& detection) const {
    return canonical_class_name(registry.name(best_class(detection.class_scores)->id));
  }
  [[nodiscard]] double probability(const Detection& detection, std::string_view name) const {
    for (const ClassEvidence& evidence : detection.class_scores) {
      if (evidence.id == *registry.find(name)) return evidence.probability.value();
    }
    return 0.0;
  }

  ClassRegistry registry;
  Image<ObjectId> instances;
  SimulatedDetector detector;
  std::vector<VisibleObject> objects;
};

/// Four standard deviations of a count of `n` events of probability `p`.
double four_sigma(double n, double p) {
  return 4.0 * std::sqrt(n * p * (1.0 - p));
}

const SimulatedDetectorOptions kPerfect{.noisy = false};
const SimulatedDetectorOptions kNoFalseAlarms{.false_alarms_per_frame = 0.0};

TEST(SimulatedDetector, VisibleObjectsHaveTheirPixelsAndBoxes) {
  const Rig rig(kPerfect);
  ASSERT_EQ(rig.objects.size(), 1U);
  EXPECT_EQ(rig.objects[0].visible_px, 100 * 80);
  EXPECT_EQ(rig.objects[0].box_px, (PixelBox{300, 200, 400, 280}));
  EXPECT_EQ(rig.objects[0].class_name, "chair");
}

TEST(SimulatedDetector, ThePerfectOneSeesEverythingExactly) {
  const Rig rig(kPerfect);
  for (std::uint64_t frame = 0; frame < 50; ++frame) {
    const auto detections = rig.detect(frame);
    ASSERT_EQ(detections.size(), 1U);
    EXPECT_EQ(detections[0].box_px, (PixelBox{300, 200, 400, 280}));
    EXPECT_EQ(rig.named(detections[0]), "chair");
    EXPECT_DOUBLE_EQ(rig.probability(detections[0], "chair"), 0.99);
    EXPECT_FALSE(detections[0].mask);
  }
}

TEST(SimulatedDetector, ItNamesTheEightyClassesOfCoco) {
  const Rig rig(kPerfect);
  EXPECT_EQ(rig.registry.size(), 80U);
  EXPECT_EQ(rig.detect(0)[0].class_scores.size(), 80U);
  for (const char* name : {"sofa",
                           "couch",
                           "tvmonitor",
                           "tv",
                           "pottedplant",
                           "cup",
                           "sink",
                           "keyboard",
                           "mouse",
                           "suitcase",
                           "umbrella",
                           "backpack",
                           "bench"})
    EXPECT_TRUE(rig.detector.knows_class(name)) << name;
  for (const char* name : {"table", "cupboard", "fan", "noteboard", "bin"})
    EXPECT_FALSE(rig.detector.knows_class(name)) << name;
}

TEST(SimulatedDetector, ThingsWithoutAWordAreNotDetected) {
  EXPECT_TRUE(Rig(kPerfect, "noteboard").detect(0).empty());
}

TEST(SimulatedDetector, SmallOrHiddenThingsAreNotSeen) {
  Rig rig(kPerfect);
  rig.objects[0].visible_px = 200;
  rig.objects[0].unhidden_share = 0.2;
  EXPECT_EQ(rig.detect(0).size(), 1U);
  rig.objects[0].visible_px = 199;
  EXPECT_TRUE(rig.detect(0).empty());
  rig.objects[0].visible_px = 200;
  rig.objects[0].unhidden_share = 0.199;
  EXPECT_TRUE(rig.detect(0).empty());
}

TEST(SimulatedDetector, MasksAreThePixelsOfTheThing) {
  const auto detections = Rig({.noisy = false, .masks = true}).detect(0);
  ASSERT_TRUE(detections.at(0).mask);
  EXPECT_EQ(std::ranges::count(detections[0].mask->pixels(), 1), 100 * 80);
  EXPECT_EQ(detections[0].mask->at(300, 200), 1);
  EXPECT_EQ(detections[0].mask->at(299, 200), 0);
}

TEST(SimulatedDetector, FifteenPercentAreMissed) {
  const Rig rig(kNoFalseAlarms);
  int missed = 0;
  for (std::uint64_t frame = 0; frame < kFrames; ++frame)
    missed += rig.detect(frame).empty() ? 1 : 0;
  EXPECT_NEAR(missed, 0.15 * kFrames, four_sigma(kFrames, 0.15));
}

TEST(SimulatedDetector, ThereAreThreeFalseAlarmsInTenFramesOfAnyClassAnywhere) {
  const Rig rig({}, "noteboard");
  int count = 0;
  int frames_with = 0;
  std::vector<int> of_class(80, 0);
  double middle_u = 0.0;
  for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
    const auto alarms = rig.detect(frame);
    count += static_cast<int>(alarms.size());
    frames_with += alarms.empty() ? 0 : 1;
    for (const Detection& alarm : alarms) {
      ++of_class.at(best_class(alarm.class_scores)->id.value);
      middle_u += 0.5 * (alarm.box_px.u_min_px + alarm.box_px.u_max_px);
      EXPECT_GE(alarm.box_px.u_min_px, 0.0);
      EXPECT_LE(alarm.box_px.u_max_px, kWidth);
      EXPECT_GE(alarm.box_px.v_min_px, 0.0);
      EXPECT_LE(alarm.box_px.v_max_px, kHeight);
      EXPECT_GT(alarm.box_px.width_px(), 0.0);
      EXPECT_GT(alarm.box_px.height_px(), 0.0);
    }
  }
  // Poisson of mean 0.3: variance 0.3 a frame, and e^-0.3 = 0.7408 of the frames have none.
  EXPECT_NEAR(count, 0.3 * kFrames, 4.0 * std::sqrt(0.3 * kFrames));
  EXPECT_NEAR(frames_with, 0.2592 * kFrames, four_sigma(kFrames, 0.2592));
  EXPECT_GE(std::ranges::count_if(of_class, [](int n) { return n > 0; }), 78);
  EXPECT_NEAR(middle_u / count, 0.5 * kWidth, 25.0);
}

TEST(SimulatedDetector, BoxEdgesMoveByFourPercentOfTheSide) {
  const Rig rig(kNoFalseAlarms);
  std::array<double, 4> sum{};
  std::array<double, 4> squares{};
  int n = 0;
  for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
    for (const Detection& detection : rig.detect(frame)) {
      const PixelBox& box = detection.box_px;
      const std::array<double, 4> error{(box.u_min_px - 300) / 100,
                                        (box.u_max_px - 400) / 100,
                                        (box.v_min_px - 200) / 80,
                                        (box.v_max_px - 280) / 80};
      for (std::size_t i = 0; i < 4; ++i) {
        sum.at(i) += error.at(i);
        squares.at(i) += error.at(i) * error.at(i);
      }
      ++n;
    }
  }
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(sum.at(i) / n, 0.0, 4.0 * 0.04 / std::sqrt(n));
    EXPECT_NEAR(std::sqrt(squares.at(i) / n), 0.04, 4.0 * 0.04 / std::sqrt(2.0 * n));
  }
}

TEST(SimulatedDetector, FivePercentNameAWrongClassWhichIsASimilarOne) {
  const Rig rig(kNoFalseAlarms);
  int right = 0;
  int sofa = 0;
  int all = 0;
  int named_rightly = 0;
  for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
    const auto said = rig.detector.detect(rig.objects, rig.instances, frame);
    named_rightly += static_cast<int>(said.named_rightly.size());
    for (const Detection& detection : said.detections) {
      ++all;
      right += rig.named(detection) == "chair" ? 1 : 0;
      sofa += rig.named(detection) == "sofa" ? 1 : 0;
    }
  }
  EXPECT_EQ(right + sofa, all);
  EXPECT_EQ(named_rightly, right);
  EXPECT_NEAR(sofa, 0.05 * all, four_sigma(all, 0.05));
}

TEST(SimulatedDetector, AClassWithoutSimilarOnesIsMistakenForAny) {
  const Rig rig({.false_alarms_per_frame = 0.0, .wrong_class_rate = 1.0}, "suitcase");
  std::vector<std::string> names;
  for (std::uint64_t frame = 0; frame < 500; ++frame) {
    for (const Detection& detection : rig.detect(frame)) names.push_back(rig.named(detection));
  }
  EXPECT_EQ(std::ranges::count(names, "suitcase"), 0);
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  EXPECT_GT(names.size(), 70U);
}

TEST(SimulatedDetector, AFifthOfTheWeightIsAtSimilarClasses) {
  const Rig rig({.false_alarms_per_frame = 0.0, .wrong_class_rate = 0.0});
  for (std::uint64_t frame = 0; frame < 200; ++frame) {
    for (const Detection& detection : rig.detect(frame)) {
      const double score = detection.score.value();
      EXPECT_NEAR(rig.probability(detection, "chair"), 0.8 * score, 1e-12);
      EXPECT_NEAR(rig.probability(detection, "sofa"), 0.2 * score, 1e-12);
      EXPECT_NEAR(rig.probability(detection, "dog"), (1.0 - score) / 78.0, 1e-12);
    }
  }
}

TEST(SimulatedDetector, ClassVectorsSumToOneAndScoresStayInTheirRange) {
  for (const char* name : {"chair", "cup", "tvmonitor", "suitcase", "diningtable"}) {
    const Rig rig({}, name);
    for (std::uint64_t frame = 0; frame < 300; ++frame) {
      for (const Detection& detection : rig.detect(frame)) {
        double sum = 0.0;
        for (const ClassEvidence& evidence : detection.class_scores)
          sum += evidence.probability.value();
        EXPECT_NEAR(sum, 1.0, 1e-9);
        EXPECT_TRUE(std::ranges::is_sorted(detection.class_scores, {}, &ClassEvidence::id));
        EXPECT_GE(detection.score.value(), 0.3);
        EXPECT_LE(detection.score.value(), 0.95);
      }
    }
  }
}

TEST(SimulatedDetector, BoxesStayInTheImageAndKeepAnArea) {
  Rig rig({.miss_rate = 0.0, .box_jitter = 1.0});
  rig.objects[0].box_px = {0, 0, 12, 480};
  for (std::uint64_t frame = 0; frame < 2000; ++frame) {
    for (const Detection& detection : rig.detect(frame)) {
      EXPECT_GE(detection.box_px.u_min_px, 0.0);
      EXPECT_LE(detection.box_px.v_max_px, kHeight);
      EXPECT_GE(detection.box_px.width_px(), 2.0 - 1e-9);
      EXPECT_GE(detection.box_px.height_px(), 2.0 - 1e-9);
    }
  }
}

TEST(SimulatedDetector, SameSeedAndFrameGiveTheSameDetections) {
  const Rig a({});
  const Rig b({});
  bool frames_differ = false;
  for (std::uint64_t frame = 0; frame < 20; ++frame) {
    EXPECT_EQ(a.detect(frame), b.detect(frame));
    frames_differ = frames_differ || a.detect(frame) != a.detect(frame + 1);
  }
  EXPECT_TRUE(frames_differ);
}

TEST(SimulatedDetector, AThingIsJudgedAloneWhateverElseIsInTheFrame) {
  Rig rig(kNoFalseAlarms);
  const auto alone = rig.detect(3);
  VisibleObject other = rig.objects[0];
  other.id = ObjectId{2};
  rig.objects.push_back(other);
  const auto both = rig.detect(3);
  ASSERT_GE(both.size(), alone.size());
  if (!alone.empty()) {
    EXPECT_EQ(both[0], alone[0]);
  }
}

TEST(SimulatedDetector, BadOptionsNameTheirField) {
  const auto field = [](const SimulatedDetectorOptions& options) {
    ClassRegistry registry;
    const auto detector = SimulatedDetector::create(options, registry, 1);
    return detector ? std::string() : detector.error().field;
  };
  EXPECT_EQ(field({}), "");
  EXPECT_EQ(field({.min_visible_px = 0}), "detector.min_visible_px");
  EXPECT_EQ(field({.miss_rate = 1.5}), "detector.miss_rate");
  EXPECT_EQ(field({.false_alarms_per_frame = -1.0}), "detector.false_alarms_per_frame");
  EXPECT_EQ(field({.box_jitter = std::nan("")}), "detector.box_jitter");
  EXPECT_EQ(field({.min_score = 0.9, .max_score = 0.5}), "detector.min_score");
}

}  // namespace
}  // namespace hypermap
