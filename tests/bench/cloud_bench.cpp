// SPDX-License-Identifier: BSD-3-Clause
// A lidar's scan of 64 x 1,024 rays in a street: what it takes to put it into the map, in time and
// in memory to work on. Each scan is seen from half a metre further on.
#include "bench/cpu_time.hpp"
#include "bench/run_benchmarks.hpp"
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

namespace hypermap::test {
namespace {

constexpr int kNumRings = 64;
constexpr int kNumColumns = 1024;
constexpr double kSensorHeightM = 1.8;
constexpr double kHighestRad = 2.0 * std::numbers::pi / 180.0;
constexpr double kLowestRad = -24.8 * std::numbers::pi / 180.0;
constexpr double kFacadeHeightM = 9.0;
constexpr std::size_t kNumScans = 10;

/// How far the facades are in a direction, 8 to 95 m.
double facade_m(double turn) {
  const double gap = std::sin(7.0 * turn) > 0.6 ? 45.0 : 0.0;
  return 28.0 + 20.0 * std::sin(3.0 * turn) + gap;
}

std::vector<Eigen::Vector3f> street_scan(const Eigen::Vector3d& sensor) {
  std::vector<Eigen::Vector3f> points;
  for (int column = 0; column < kNumColumns; ++column) {
    const double turn = 2.0 * std::numbers::pi * column / kNumColumns;
    for (int ring = 0; ring < kNumRings; ++ring) {
      const double rise = kLowestRad + (kHighestRad - kLowestRad) * ring / (kNumRings - 1);
      const Eigen::Vector3d way(std::cos(turn), std::sin(turn), std::tan(rise));
      const double ground =
          rise < 0.0 ? kSensorHeightM / -way.z() : std::numeric_limits<double>::max();
      const double reached = std::min(ground, facade_m(turn));
      const Eigen::Vector3d point = sensor + reached * way;
      if (point.z() <= kFacadeHeightM) points.emplace_back(point.cast<float>());
    }
  }
  return points;
}

void integrate_scans(benchmark::State& state, IntegrationMode mode, double free_range_m) {
  const CloudOptions options{.mode = mode, .max_range_m = 100.0, .free_range_m = free_range_m};
  FrameIntegrator integrator;
  auto tree = SemanticOctree::create({.resolution_m = 0.05}).value();
  double seconds = std::numeric_limits<double>::max();
  IntegrationReport last;
  std::size_t num_points = 0;
  for ([[maybe_unused]] const auto _ : state) {
    for (std::size_t i = 0; i < kNumScans; ++i) {
      const Eigen::Vector3d sensor(0.5 * static_cast<double>(i), 0.0, kSensorHeightM);
      const auto points = street_scan(sensor);
      num_points = points.size();
      const double taken = cpu_time_of([&] {
        last = integrator.integrate_far_cloud(tree, {sensor}, points, {}, options).value();
      });
      if (i > 0) seconds = std::min(seconds, taken);  // the first one takes the memory
    }
  }
  state.counters["scan_ms"] = 1e3 * seconds;
  state.counters["points"] = static_cast<double>(num_points);
  state.counters["working_mb"] = 1e-6 * static_cast<double>(last.working_bytes);
  state.counters["occupied_voxels"] = static_cast<double>(last.num_occupied_voxels);
  state.counters["free_voxels"] = static_cast<double>(last.num_free_voxels);
  state.counters["map_mb"] = 1e-6 * static_cast<double>(tree.memory_bytes());
}

}  // namespace
}  // namespace hypermap::test

int main(int argc, char** argv) {
  using hypermap::IntegrationMode;
  const auto add = [](const char* name, IntegrationMode mode, double free_range_m) {
    benchmark::RegisterBenchmark(name, hypermap::test::integrate_scans, mode, free_range_m)
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
  };
  add("cloud/64x1024/discretize/free:15m", IntegrationMode::kDiscretize, 15.0);
  add("cloud/64x1024/exact/free:15m", IntegrationMode::kExact, 15.0);
  add("cloud/64x1024/discretize/free:100m", IntegrationMode::kDiscretize, 100.0);
  return hypermap::test::run_benchmarks(argc, argv);
}
