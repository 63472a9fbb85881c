// SPDX-License-Identifier: BSD-3-Clause
// Does a frame cost the same after ten thousand of them? A robot goes along a corridor of 500 m, or
// round and round in one room, with a small depth image (160 x 120) and the cupboards that it
// shows as detections. Reports the CPU time of a frame and the memory by tenths of the way.
//
// HYPERMAP_SCALE_FRAMES: how many frames (1,000); 10,000 go the whole way.
#include "bench/cpu_time.hpp"
#include "bench/painted_world.hpp"
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
constexpr std::size_t kNumTenths = 10;

World corridor() {
  World world{.walls = {{0.0, 0.0, 0.0}, {kCorridorLengthM + 10.0, 2.6, 2.6}}, .cupboards = {}};
  for (std::uint32_t i = 0; 2.0 * i < kCorridorLengthM + 8.0; ++i) {
    const double y = i % 2 == 0 ? 0.05 : 2.15;
    world.cupboards.push_back(cupboard(i, 2.0 * i + 1.0, y, {0.8, 0.4, 0.6 + 0.2 * (i % 5)}));
  }
  return world;
}

World room() {
  World world{.walls = {{0.0, 0.0, 0.0}, {8.0, 6.0, 2.6}}, .cupboards = {}};
  for (std::uint32_t i = 0; i < 8; ++i) {
    const double y = i % 2 == 0 ? 0.05 : 5.55;
    world.cupboards.push_back(cupboard(i, 0.5 + 0.9 * i, y, {0.8, 0.4, 0.6 + 0.2 * (i % 5)}));
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
  sum.smooth += frame.smooth;
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
  state.counters["smooth_ms_tenth" + tenth] = 1e3 * sum.smooth / num_frames;
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
