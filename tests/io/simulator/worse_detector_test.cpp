// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/simulated_detector.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace hypermap {
namespace {

TEST(WorseDetector, MissesAFurtherThirdAndGivesAnotherFalseAlarm) {
  const SimulatedDetectorOptions worse = worse_detector();
  // Of the 85 % that the noisy one sees, 35 % are missed: 0.15 + 0.35 * 0.85 in all.
  EXPECT_DOUBLE_EQ(worse.miss_rate, 0.4475);
  EXPECT_DOUBLE_EQ(worse.false_alarms_per_frame, 1.3);
  EXPECT_DOUBLE_EQ(worse.box_jitter, 0.08);
  EXPECT_EQ(worse.wrong_class_rate, SimulatedDetectorOptions{}.wrong_class_rate);
  EXPECT_TRUE(validate(worse));
}

TEST(WorseDetector, DetectsAsOftenAsItsRatesSay) {
  constexpr int kNumFrames = 4000;
  Image<ObjectId> instances(640, 480);
  for (int v = 200; v < 280; ++v) {
    for (int u = 300; u < 400; ++u) instances.at(u, v) = ObjectId{1};
  }
  auto objects = visible_objects(instances, std::array<std::string_view, 1>{"chair"});
  objects.at(0).unhidden_share = 1.0;
  ClassRegistry registry;
  const auto detector = SimulatedDetector::create(worse_detector(), registry, 42);
  ASSERT_TRUE(detector);
  int detections = 0;
  for (std::uint64_t frame = 0; frame < kNumFrames; ++frame)
    detections += static_cast<int>(detector->detect(objects, instances, frame).detections.size());
  // A binomial and a Poisson count: four standard deviations of their sum.
  EXPECT_NEAR(detections,
              kNumFrames * (1.0 - 0.4475 + 1.3),
              4.0 * std::sqrt(kNumFrames * (0.4475 * 0.5525 + 1.3)));
}

}  // namespace
}  // namespace hypermap
