// SPDX-License-Identifier: BSD-3-Clause
// How the camera goes through a scene: passes, steps, heights, noise of its poses, its images.
#include "hypermap/io/simulator/simulator.hpp"
#include "io/simulator/room_simulation.hpp"
#include "support/files_below.hpp"
#include "support/temp_dir.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>

namespace hypermap {
namespace {

using test::files_below;
using test::room_scene;
using test::small_options;

Simulator simulator_of(const SimulationOptions& options) {
  auto simulator = Simulator::create(room_scene(), options);
  EXPECT_TRUE(simulator) << to_string(simulator.error());
  return *std::move(simulator);
}

TEST(SimulatedWalk, EveryThirdFrameIsTheSameToTheLastByte) {
  const test::TempDir dir;
  SimulationOptions options = small_options();
  options.num_frames = 8;
  options.pose_noise = 1.0;
  options.pose_noise_m = 0.01;
  ASSERT_TRUE(simulate(room_scene(), options, dir / "all"));
  options.frame_step = 3;
  const auto report = simulate(room_scene(), options, dir / "some");
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->num_frames, 3U);
  const auto all = files_below(dir / "all");
  const auto some = files_below(dir / "some");
  for (const std::string name : {"000000", "000003", "000006"}) {
    EXPECT_EQ(some.at("depth/" + name + ".png"), all.at("depth/" + name + ".png"));
    EXPECT_EQ(some.at("rgb/" + name + ".png"), all.at("rgb/" + name + ".png"));
  }
  EXPECT_FALSE(some.contains("depth/000001.png"));
  // Each line of poses and detections is one of the whole walk.
  for (const std::string list : {"groundtruth.txt", "detections.jsonl", "depth.txt"}) {
    const std::string& text = some.at(list);
    const bool has_head = list == "detections.jsonl";  // which says how many lines there are
    for (std::size_t from = has_head ? text.find('\n') + 1 : 0; from < text.size();) {
      const std::size_t end = text.find('\n', from);
      EXPECT_NE(all.at(list).find(text.substr(from, end - from)), std::string::npos) << list;
      from = end + 1;
    }
  }
}

TEST(SimulatedWalk, FurtherPassesGoTheSameWayLater) {
  SimulationOptions options = small_options();
  options.num_passes = 2;
  options.frame_step = 4;
  const Simulator simulator = simulator_of(options);
  ASSERT_EQ(simulator.size(), 4U);  // numbers 0, 4 and 6, 10
  EXPECT_EQ(simulator.render(1).frame.name, "000004");
  EXPECT_EQ(simulator.render(2).frame.name, "000006");
  for (const std::size_t i : {0U, 1U}) {
    const SimulatedFrame first = simulator.render(i);
    const SimulatedFrame second = simulator.render(i + 2);
    EXPECT_TRUE(first.true_pose.isometry().isApprox(second.true_pose.isometry()));
    EXPECT_EQ(first.instances, second.instances);
    EXPECT_NE(first.frame.depth_m, second.frame.depth_m);  // noise anew
    EXPECT_LT(first.frame.stamp, second.frame.stamp);
  }
  EXPECT_LT(simulator.render(1).frame.stamp, simulator.render(2).frame.stamp);
}

TEST(SimulatedWalk, ImagesOfAnotherSizeSeeTheSameWithinTheirEdges) {
  SimulationOptions options;  // 640 x 480, 525, centre (319.5, 239.5)
  options.width_px = 320;
  options.height_px = 240;
  // Half of the focal lengths; the centre of the image stays its centre: (319.5 + 0.5) / 2 - 0.5.
  EXPECT_EQ(image_camera(options), (PinholeCamera{320, 240, 262.5, 262.5, 159.5, 119.5}));
  options.width_px = 0;
  EXPECT_EQ(image_camera(options), (PinholeCamera{640, 240, 525.0, 262.5, 319.5, 119.5}));
  options = small_options();
  options.width_px = 80;
  options.height_px = 60;
  const SimulatedFrame half = simulator_of(options).render(2);
  EXPECT_EQ(half.frame.depth_m.width_px(), 80);
  EXPECT_EQ(half.frame.depth_m.height_px(), 60);
  EXPECT_EQ(half.frame.camera, image_camera(options));
  // Pixel (u, v) of the half image lies between pixels 2 u and 2 u + 1 of the whole one.
  const SimulatedFrame whole = simulator_of(small_options()).render(2);
  int same = 0;
  for (int v = 0; v < 60; ++v) {
    for (int u = 0; u < 80; ++u)
      same += half.instances.at(u, v) == whole.instances.at(2 * u, 2 * v) ? 1 : 0;
  }
  EXPECT_GT(same, 80 * 60 * 95 / 100);
}

TEST(SimulatedWalk, WhitePoseNoiseIsAsLargeAsAskedAndAnewInEveryFrame) {
  SimulationOptions options = small_options();
  options.camera = {8, 6, 6.5, 6.5, 3.5, 2.5};  // the poses matter here
  options.num_frames = 400;
  options.pose_noise_m = 0.01;
  options.pose_noise_rad = 0.02;
  const Simulator simulator = simulator_of(options);
  double sum_m2 = 0.0;
  double sum_rad2 = 0.0;
  double neighbours = 0.0;
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < simulator.size(); ++i) {
    const SimulatedFrame simulated = simulator.render(i);
    const Eigen::Isometry3d& truth = simulated.true_pose.isometry();
    const Eigen::Isometry3d& recorded = simulated.frame.map_from_camera.isometry();
    const Eigen::Vector3d offset = recorded.translation() - truth.translation();
    const double angle = Eigen::AngleAxisd(recorded.linear() * truth.linear().transpose()).angle();
    sum_m2 += offset.squaredNorm();
    sum_rad2 += angle * angle;
    neighbours += offset.dot(before);
    before = offset;
  }
  // Three coordinates a frame: 1200 numbers, so their root mean square is right within 8 %.
  EXPECT_NEAR(std::sqrt(sum_m2 / 1200.0), 0.01, 0.0008);
  EXPECT_NEAR(std::sqrt(sum_rad2 / 1200.0), 0.02, 0.0016);
  EXPECT_NEAR(neighbours / sum_m2, 0.0, 0.12);
}

TEST(SimulatedWalk, AFrameDoesNotShowHowFastTheCameraCame) {
  SimulationOptions options = small_options();
  const Simulator usual = simulator_of(options);
  options.speed = 2.0;
  const Simulator fast = simulator_of(options);
  const SimulatedFrame at_usual = usual.render(5);
  const SimulatedFrame at_fast = fast.render(5);
  EXPECT_EQ(at_usual.frame.depth_m, at_fast.frame.depth_m);
  EXPECT_NEAR(
      static_cast<double>(at_usual.frame.stamp.ns) / static_cast<double>(at_fast.frame.stamp.ns),
      2.0,
      1e-6);
}

TEST(SimulatedWalk, TheLensHeightIsThatOfEveryFrame) {
  SimulationOptions options = small_options();
  options.lens_height_m = 0.6;
  const Simulator simulator = simulator_of(options);
  for (const std::size_t i : {0U, 3U, 5U})
    EXPECT_DOUBLE_EQ(simulator.render(i).true_pose.origin().xyz.z(), 0.6);
}

TEST(SimulatedWalk, BadOptionsNameTheirField) {
  const auto field = [](auto change) {
    SimulationOptions options = small_options();
    change(options);
    const auto simulator = Simulator::create(room_scene(), options);
    return simulator ? std::string() : simulator.error().field;
  };
  EXPECT_EQ(field([](auto& o) { o.frame_step = 0; }), "frame_step");
  EXPECT_EQ(field([](auto& o) { o.num_passes = 0; }), "num_passes");
  EXPECT_EQ(field([](auto& o) { o.speed = 0.0; }), "speed");
  EXPECT_EQ(field([](auto& o) { o.lens_height_m = 0.01; }), "lens_height_m");
  EXPECT_EQ(field([](auto& o) { o.pose_noise_m = -1.0; }), "pose_noise_m");
  EXPECT_EQ(field([](auto& o) { o.pose_noise_rad = std::nan(""); }), "pose_noise_rad");
  EXPECT_EQ(field([](auto& o) { o.width_px = -1; }), "width_px");
  EXPECT_EQ(field([](auto& o) { o.height_px = 65536; }), "height_px");
  EXPECT_EQ(field([](auto& o) { o.changes.num_moved = -1; }), "changes.num_moved");
  EXPECT_EQ(field([](auto& o) { o.changes.num_moved = 1; }), "num_passes");
}

}  // namespace
}  // namespace hypermap
