// SPDX-License-Identifier: BSD-3-Clause
// Does a frame cost the same after ten thousand of them? A robot goes along a corridor of 500 m, or
// round and round in one room, with a small depth image (160 x 120) and the cupboards that it
// shows as detections. Reports the CPU time of a frame and the memory by tenths of the way.
//
// HYPERMAP_SCALE_FRAMES: how many frames (1,000); 10,000 go the whole way.
#include "bench/cpu_time.hpp"
#include "bench/run_benchmarks.hpp"
#include "hypermap/core/geometry/box.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"
#include "support/camera_pose.hpp"

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

namespace hypermap::test {
namespace {

constexpr double kCorridorLengthM = 500.0;
constexpr double kViewRangeM = 6.0;
constexpr std::size_t kNumTenths = 10;
constexpr std::uint32_t kNumClasses = 8;
const PinholeCamera kCamera{160, 120, 131.0, 131.0, 79.5, 59.5};

struct Cupboard {
  Box box;
  ClassId class_id;
};

/// A box that one is in, and cupboards along its way.
struct World {
  Box walls;
  std::vector<Cupboard> cupboards;  ///< By ascending x.
};

Cupboard cupboard(std::uint32_t number, double x, double y, double height_m) {
  return {{{x, y, 0.0}, {x + 0.8, y + 0.4, height_m}}, ClassId{number % kNumClasses}};
}

World corridor() {
  World world{.walls = {{0.0, 0.0, 0.0}, {kCorridorLengthM + 10.0, 2.6, 2.6}}, .cupboards = {}};
  for (std::uint32_t i = 0; 2.0 * i < kCorridorLengthM + 8.0; ++i) {
    const double y = i % 2 == 0 ? 0.05 : 2.15;
    world.cupboards.push_back(cupboard(i, 2.0 * i + 1.0, y, 0.6 + 0.2 * (i % 5)));
  }
  return world;
}

World room() {
  World world{.walls = {{0.0, 0.0, 0.0}, {8.0, 6.0, 2.6}}, .cupboards = {}};
  for (std::uint32_t i = 0; i < 8; ++i) {
    const double y = i % 2 == 0 ? 0.05 : 5.55;
    world.cupboards.push_back(cupboard(i, 0.5 + 0.9 * i, y, 0.6 + 0.2 * (i % 5)));
  }
  return world;
}

constexpr double kPitchRad = -0.15;

/// Five centimetres a frame, and back again.
MapFromCamera along_corridor(std::size_t i) {
  const double way_m = std::fmod(0.05 * static_cast<double>(i), 2.0 * kCorridorLengthM);
  const double x = way_m < kCorridorLengthM ? way_m : 2.0 * kCorridorLengthM - way_m;
  return camera_at({0.5 + x, 1.3, 1.3}, 0.4 * std::sin(0.02 * static_cast<double>(i)), kPitchRad);
}

MapFromCamera round_room(std::size_t i) {
  const double turn = 2.0 * std::numbers::pi * static_cast<double>(i) / 200.0;
  return camera_at({4.0 + 1.5 * std::cos(turn), 3.0 + std::sin(turn), 1.3}, turn, kPitchRad);
}

/// What one ray meets.
struct Hit {
  double depth_m;
  int cupboard;  ///< -1: a wall.
};

class Painter {
 public:
  Painter(const World& world, const MapFromCamera& pose) : walls_(world.walls) {
    origin_ = pose.origin().xyz;
    for (const Cupboard& c : world.cupboards) {
      const bool near = (c.box.centre() - origin_).norm() < kViewRangeM + 1.0;
      if (near) near_.push_back(&c);
    }
  }

  [[nodiscard]] Hit look(const Eigen::Vector3d& ray) const {
    Hit hit{span(walls_, ray)[1], -1};
    for (std::size_t i = 0; i < near_.size(); ++i) {
      const auto [enter, leave] = span(near_[i]->box, ray);
      if (enter > 0.0 && enter <= leave && enter < hit.depth_m) hit = {enter, static_cast<int>(i)};
    }
    return hit;
  }
  [[nodiscard]] const std::vector<const Cupboard*>& near() const { return near_; }

 private:
  [[nodiscard]] std::array<double, 2> span(const Box& box, const Eigen::Vector3d& ray) const {
    const Eigen::Array3d a = (box.min_in_map - origin_).array() / ray.array();
    const Eigen::Array3d b = (box.max_in_map - origin_).array() / ray.array();
    return {a.min(b).maxCoeff(), a.max(b).minCoeff()};
  }

  Box walls_;
  Eigen::Vector3d origin_;
  std::vector<const Cupboard*> near_;
};

std::vector<ClassEvidence> class_vector(ClassId id) {
  std::vector<ClassEvidence> scores;
  for (std::uint32_t i = 0; i < kNumClasses; ++i) {
    scores.push_back({ClassId{i}, Probability(ClassId{i} == id ? 0.72 : 0.04)});
  }
  return scores;
}

RgbdFrame paint(const World& world, const MapFromCamera& pose, std::size_t index) {
  RgbdFrame frame;
  frame.index = index;
  frame.camera = kCamera;
  frame.map_from_camera = pose;
  frame.depth_m = DepthImage(kCamera.width_px, kCamera.height_px);
  const Painter painter(world, pose);
  std::vector<PixelBox> boxes(painter.near().size(), PixelBox{1e9, 1e9, 0, 0});
  std::vector<int> num_pixels(boxes.size(), 0);
  const Eigen::Matrix3d rotation = pose.isometry().linear();
  for (int v = 0; v < kCamera.height_px; ++v) {
    for (int u = 0; u < kCamera.width_px; ++u) {
      const Hit hit = painter.look(rotation * kCamera.unproject(u, v, 1.0).xyz);
      // Millimetres, with a ripple in the place of noise.
      const double ripple_m =
          0.001 * static_cast<double>((static_cast<std::size_t>(u * 7 + v * 13) + index * 31) % 5);
      frame.depth_m.at(u, v) =
          static_cast<float>(std::round(1e3 * (hit.depth_m + ripple_m)) * 1e-3);
      if (hit.cupboard < 0 || hit.depth_m > kViewRangeM) continue;
      PixelBox& box = boxes[static_cast<std::size_t>(hit.cupboard)];
      box = {std::min(box.u_min_px, u + 0.0),
             std::min(box.v_min_px, v + 0.0),
             std::max(box.u_max_px, u + 1.0),
             std::max(box.v_max_px, v + 1.0)};
      ++num_pixels[static_cast<std::size_t>(hit.cupboard)];
    }
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (num_pixels[i] < 100) continue;
    frame.detections.push_back({.box_px = boxes[i],
                                .class_scores = class_vector(painter.near()[i]->class_id),
                                .score = Probability(0.72),
                                .detector = {},
                                .mask = {}});
  }
  return frame;
}

std::size_t resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::size_t total = 0;
  std::size_t resident = 0;
  statm >> total >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

std::size_t num_frames_wanted() {
  const char* text = std::getenv("HYPERMAP_SCALE_FRAMES");
  const long wanted = text == nullptr ? 1'000 : std::strtol(text, nullptr, 10);
  return static_cast<std::size_t>(std::max(wanted, static_cast<long>(kNumTenths)));
}

void add(StageSeconds& sum, const StageSeconds& frame) {
  sum.segment += frame.segment;
  sum.associate += frame.associate;
  sum.integrate += frame.integrate;
  sum.visibility += frame.visibility;
}

/// Wall time of a frame by stages.
void report_stages(benchmark::State& state,
                   const StageSeconds& sum,
                   const std::string& tenth,
                   double num_frames) {
  state.counters["segment_ms_tenth" + tenth] = 1e3 * sum.segment / num_frames;
  state.counters["associate_ms_tenth" + tenth] = 1e3 * sum.associate / num_frames;
  state.counters["integrate_ms_tenth" + tenth] = 1e3 * sum.integrate / num_frames;
  state.counters["visibility_ms_tenth" + tenth] = 1e3 * sum.visibility / num_frames;
}

void go(benchmark::State& state, World (*world_of)(), MapFromCamera (*pose_of)(std::size_t)) {
  const World world = world_of();
  const std::size_t num_frames = num_frames_wanted();
  auto mapper = SemanticMapper::create({}).value();
  for ([[maybe_unused]] const auto _ : state) {
    std::vector<double> times_ms;
    std::size_t num_detections = 0;
    for (std::size_t tenth = 0; tenth < kNumTenths; ++tenth) {
      double seconds = 0.0;
      StageSeconds stages;
      const std::size_t begin = tenth * num_frames / kNumTenths;
      const std::size_t end = (tenth + 1) * num_frames / kNumTenths;
      for (std::size_t i = begin; i < end; ++i) {
        const RgbdFrame frame = paint(world, pose_of(i), i);
        num_detections += frame.detections.size();
        const double taken =
            cpu_time_of([&] { add(stages, mapper.integrate(frame).value().seconds); });
        seconds += taken;
        times_ms.push_back(1e3 * taken);
      }
      const std::string name = (tenth < 9 ? "0" : "") + std::to_string(tenth + 1);
      state.counters["ms_tenth" + name] = 1e3 * seconds / static_cast<double>(end - begin);
      report_stages(state, stages, name, static_cast<double>(end - begin));
      state.counters["rss_mb_tenth" + name] = 1e-6 * static_cast<double>(resident_bytes());
      state.counters["octree_mb_tenth" + name] =
          1e-6 * static_cast<double>(mapper.octree().memory_bytes());
    }
    std::sort(times_ms.begin(), times_ms.end());
    state.counters["ms_median"] = times_ms[times_ms.size() / 2];
    state.counters["ms_90th"] = times_ms[times_ms.size() * 9 / 10];
    state.counters["ms_worst"] = times_ms.back();
    state.counters["detections"] =
        static_cast<double>(num_detections) / static_cast<double>(num_frames);
  }
  state.counters["objects"] = static_cast<double>(mapper.objects().size());
  state.counters["occupied"] = static_cast<double>(mapper.octree().num_leaves().occupied);
}

}  // namespace
}  // namespace hypermap::test

int main(int argc, char** argv) {
  benchmark::RegisterBenchmark(
      "corridor/5cm", hypermap::test::go, hypermap::test::corridor, hypermap::test::along_corridor)
      ->Iterations(1)
      ->Unit(benchmark::kSecond);
  benchmark::RegisterBenchmark(
      "one_room/5cm", hypermap::test::go, hypermap::test::room, hypermap::test::round_room)
      ->Iterations(1)
      ->Unit(benchmark::kSecond);
  return hypermap::test::run_benchmarks(argc, argv);
}
