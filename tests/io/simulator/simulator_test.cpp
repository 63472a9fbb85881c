// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/simulator.hpp"

#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/simulator/simulation_truth.hpp"
#include "hypermap/projection/layers/evaluated_objects.hpp"
#include "io/simulator/room_simulation.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using test::kSmall;
using test::room_scene;
using test::small_options;
using testing::HasSubstr;

TEST(Simulator, AFrameIsWhatADatasetReaderWouldGive) {
  const auto simulator = Simulator::create(room_scene(), small_options());
  ASSERT_TRUE(simulator) << to_string(simulator.error());
  ASSERT_EQ(simulator->size(), 6U);
  const SimulatedFrame simulated = simulator->render(3);
  EXPECT_TRUE(validate(simulated.frame));
  EXPECT_EQ(simulated.frame.index, 3U);
  EXPECT_EQ(simulated.frame.name, "000003");
  EXPECT_TRUE(simulated.frame.map_from_camera.isometry().isApprox(simulated.true_pose.isometry()));
  EXPECT_GT(std::ranges::count_if(simulated.frame.depth_m.pixels(), [](float z) { return z > 0; }),
            160 * 120 / 2);
  EXPECT_LT(simulator->render(2).frame.stamp, simulated.frame.stamp);
}

TEST(Simulator, ImagesHaveABound) {
  SimulationOptions options = small_options();
  options.camera = {.width_px = 16'384,
                    .height_px = 4'096,
                    .fx_px = 525,
                    .fy_px = 525,
                    .cx_px = 8'192,
                    .cy_px = 2'048};
  EXPECT_TRUE(validate(options)) << "2^26 pixels";
  options.camera.height_px = 4'097;
  const auto refused = validate(options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().field, "width_px");
  EXPECT_THAT(refused.error().what, HasSubstr("16384 x 4097"));
}

TEST(Simulator, UnprojectedDepthLiesOnTheThingsItShows) {
  SimulationOptions options = small_options();
  options.sensor = {.noise_base_m = 0.0, .noise_per_m2 = 0.0, .dropout = 0.0};
  const auto simulator = Simulator::create(room_scene(), options);
  ASSERT_TRUE(simulator);
  const SimulatedFrame simulated = simulator->render(0);
  int checked = 0;
  for (int v = 0; v < kSmall.height_px; ++v) {
    for (int u = 0; u < kSmall.width_px; ++u) {
      const ObjectId id = simulated.instances.at(u, v);
      const double depth = static_cast<double>(simulated.frame.depth_m.at(u, v));
      if (id == kNoObject || depth == 0.0) continue;
      const Eigen::Vector3d point = (simulated.true_pose * kSmall.unproject(u, v, depth)).xyz;
      Box box = simulator->objects()[id.value - 1].box;
      box.min_in_map.array() -= 0.002;  // depth comes in steps of 1 mm
      box.max_in_map.array() += 0.002;
      EXPECT_TRUE(box.contains(point)) << id.value << " at " << u << " " << v;
      ++checked;
    }
  }
  EXPECT_GT(checked, 500);
}

TEST(Simulator, FramesDoNotDependOnWhatWasRenderedBefore) {
  const auto a = Simulator::create(room_scene(), small_options());
  const auto b = Simulator::create(room_scene(), small_options());
  ASSERT_TRUE(a && b);
  (void)a->render(0);
  EXPECT_EQ(a->render(4).frame.depth_m, b->render(4).frame.depth_m);
  EXPECT_EQ(a->render(4).frame.detections, b->render(4).frame.detections);
}

TEST(Simulator, PoseNoiseDriftsInThePlaneAndStartsAtTheTruth) {
  SimulationOptions options = small_options();
  options.pose_noise = 2.0;
  const auto simulator = Simulator::create(room_scene(), options);
  ASSERT_TRUE(simulator);
  const SimulatedFrame first = simulator->render(0);
  EXPECT_TRUE(first.frame.map_from_camera.isometry().isApprox(first.true_pose.isometry()));
  const SimulatedFrame last = simulator->render(5);
  const Eigen::Vector3d drift =
      last.frame.map_from_camera.origin().xyz - last.true_pose.origin().xyz;
  EXPECT_GT(drift.norm(), 1e-4);
  EXPECT_LT(drift.norm(), 0.3);
  EXPECT_EQ(drift.z(), 0.0);
  // The recorded gaze keeps its pitch.
  EXPECT_NEAR(last.frame.map_from_camera.isometry().linear()(2, 2),
              last.true_pose.isometry().linear()(2, 2),
              1e-12);
}

TEST(Simulator, ThingsThatDoNotCountSayWhy) {
  const test::TempDir dir;
  const auto report = simulate(room_scene(), small_options(), dir / "out");
  ASSERT_TRUE(report) << to_string(report.error());
  const auto reason = [&](std::size_t i) { return report->objects.at(i).exclusion_reason; };
  EXPECT_THAT(reason(0), HasSubstr("no word"));                      // table
  EXPECT_EQ(reason(1), "");                                          // tvmonitor
  EXPECT_EQ(reason(2), "");                                          // chair
  EXPECT_THAT(reason(3), HasSubstr("no word"));                      // bin
  EXPECT_THAT(reason(4), HasSubstr("200 depth pixels, at most 0"));  // behind the camera
  EXPECT_GT(report->objects[2].most_depth_pixels, 200);
  EXPECT_GT(report->objects[2].num_frames_visible, 0U);
}

TEST(Simulator, TheTruthLoadsWithoutAFindingAndSaysTheSame) {
  const test::TempDir dir;
  const auto report = simulate(room_scene(), small_options(), dir / "out");
  ASSERT_TRUE(report) << to_string(report.error());
  const auto loaded = load_archive(dir / "out/truth.hmap");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  for (const Finding& finding : loaded->findings) ADD_FAILURE() << to_string(finding.error);
  const auto simulator = Simulator::create(room_scene(), small_options());
  ASSERT_TRUE(simulator);
  const auto expected =
      make_truth(*simulator, room_scene(), report->objects, *loaded->value.true_surfaces);
  ASSERT_TRUE(expected);
  EXPECT_EQ(loaded->value.objects, expected->objects);
  EXPECT_EQ(loaded->value.classes, expected->classes);
  const auto layer = loaded->value.hypermap.at("semantic");
  ASSERT_TRUE(layer);
  const auto evaluated = evaluated_objects(*(*layer)->content.as<SemanticLayer>());
  ASSERT_EQ(evaluated.size(), 5U);
  EXPECT_TRUE(evaluated[0].excluded);   // table
  EXPECT_FALSE(evaluated[2].excluded);  // chair
  EXPECT_NEAR(evaluated[2].size_m, 0.86, 1e-5);
  const EvaluationReport perfect = evaluate(evaluated, evaluated);
  EXPECT_EQ(perfect.all.one_to_one.f1, 1.0);
  EXPECT_NEAR(*perfect.all.one_to_one.jaccard_in_place, 1.0, 1e-9);
}

TEST(Simulator, BadOptionsNameTheirField) {
  const auto field = [](auto change) {
    SimulationOptions options = small_options();
    change(options);
    const auto simulator = Simulator::create(room_scene(), options);
    return simulator ? std::string() : simulator.error().field;
  };
  EXPECT_EQ(field([](auto& o) { o.num_frames = 0; }), "num_frames");
  EXPECT_EQ(field([](auto& o) { o.pose_noise = std::nan(""); }), "pose_noise");
  EXPECT_EQ(field([](auto& o) { o.num_threads = -1; }), "num_threads");
  EXPECT_EQ(field([](auto& o) { o.sensor.dropout = 2.0; }), "sensor.dropout");
  EXPECT_EQ(field([](auto& o) { o.detector.miss_rate = 2.0; }), "detector.miss_rate");
  EXPECT_NE(field([](auto& o) { o.camera.fx_px = 0.0; }), "");
  EXPECT_EQ(field([](auto& o) { o.num_frames = 1; }), "");
}

}  // namespace
}  // namespace hypermap
