// SPDX-License-Identifier: BSD-3-Clause
// CPU time of putting frames with labels into the semantic octree, against OctoMap's
// insertPointCloud (without labels) on the same points in the same run. `cpu_ratio` is OctoMap's
// time over ours; a ray is a measured depth pixel. `occupied_iou` and `free_iou` compare our voxels
// with OctoMap's.
#include "bench/cpu_time.hpp"
#include "bench/run_benchmarks.hpp"
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"
#include "octree_semantic/support/labelled_frame.hpp"
#include "octree_semantic/support/octomap_oracle.hpp"

#include <benchmark/benchmark.h>
#include <octomap/octomap.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace hypermap::test {
namespace {

constexpr double kMaxRangeM = 5.0;

struct Sequence {
  std::vector<LabelledFrame> frames;
  std::vector<octomap::Pointcloud> clouds;
  std::size_t num_rays = 0;
};

Sequence prepare(std::vector<LabelledFrame> frames) {
  Sequence sequence{.frames = std::move(frames), .clouds = {}, .num_rays = 0};
  for (const LabelledFrame& labelled : sequence.frames) {
    octomap::Pointcloud& cloud = sequence.clouds.emplace_back();
    for (const Eigen::Vector3f& point : measured_points(labelled.frame)) {
      cloud.push_back(point.x(), point.y(), point.z());
    }
    sequence.num_rays += cloud.size();
  }
  return sequence;
}

const Sequence& room() {
  static const Sequence kSequence = prepare(room_frames(20, 640));
  return kSequence;
}
const Sequence& kitchen() {
  static const Sequence kSequence = prepare(kitchen_frames(5, 40));
  return kSequence;
}

double insert_into_octomap(const Sequence& sequence, octomap::OcTree& tree, bool discretize) {
  return cpu_time_of([&] {
    for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
      const Eigen::Vector3d sensor = sequence.frames[i].frame.map_from_camera.origin().xyz;
      const octomap::point3d origin(static_cast<float>(sensor.x()),
                                    static_cast<float>(sensor.y()),
                                    static_cast<float>(sensor.z()));
      tree.insertPointCloud(sequence.clouds[i], origin, kMaxRangeM, false, discretize);
    }
  });
}

double integrate(const Sequence& sequence,
                 SemanticOctree& tree,
                 const IntegrationOptions& options,
                 benchmark::State& state) {
  FrameIntegrator integrator;
  return cpu_time_of([&] {
    for (const LabelledFrame& labelled : sequence.frames) {
      if (!integrator.integrate(tree, labelled.frame, labelled.labels, options)) {
        state.SkipWithError("a frame was refused");
      }
    }
  });
}

void report_map(const SemanticOctree& tree,
                const octomap::OcTree& theirs,
                benchmark::State& state) {
  const LeafCount leaves = tree.num_leaves();
  state.counters["occupied"] = static_cast<double>(leaves.occupied);
  state.counters["bytes_per_occupied"] =
      static_cast<double>(tree.memory_bytes()) / static_cast<double>(leaves.occupied);
  const Agreement agreement = compare(tree, theirs, 0.0);
  state.counters["occupied_iou"] = agreement.occupied_iou();
  state.counters["free_iou"] = agreement.free_iou();
}

void compare(benchmark::State& state,
             const Sequence& (*sequence_of)(),
             double resolution_m,
             IntegrationMode mode,
             bool octomap_discretize) {
  const Sequence& sequence = sequence_of();
  if (sequence.frames.empty()) {
    state.SkipWithError("test data not present");
    return;
  }
  const IntegrationOptions options{.mode = mode, .max_range_m = kMaxRangeM, .num_threads = 1};
  double ours = 0.0;
  double octomaps = 0.0;
  for ([[maybe_unused]] const auto _ : state) {
    auto tree = SemanticOctree::create({.resolution_m = resolution_m}).value();
    octomap::OcTree theirs(resolution_m);
    const double seconds = integrate(sequence, tree, options, state);
    octomaps += insert_into_octomap(sequence, theirs, octomap_discretize);
    ours += seconds;
    state.SetIterationTime(seconds);
    report_map(tree, theirs, state);
  }
  const double rays =
      static_cast<double>(sequence.num_rays) * static_cast<double>(state.iterations());
  state.counters["ns_per_ray"] = ours / rays * 1e9;
  state.counters["octomap_ns_per_ray"] = octomaps / rays * 1e9;
  state.counters["cpu_ratio"] = octomaps / ours;
}

/// How the cost of a ray grows as voxels shrink: ours alone, for OctoMap takes minutes at 1 cm.
void by_resolution(benchmark::State& state, IntegrationMode mode) {
  const double resolution_m = 0.01 * static_cast<double>(state.range(0));
  const Sequence& sequence = room();
  const IntegrationOptions options{.mode = mode, .max_range_m = kMaxRangeM, .num_threads = 1};
  double seconds = 0.0;
  for ([[maybe_unused]] const auto _ : state) {
    auto tree = SemanticOctree::create({.resolution_m = resolution_m}).value();
    const double taken = integrate(sequence, tree, options, state);
    state.SetIterationTime(taken);
    seconds += taken;
    state.counters["occupied"] = static_cast<double>(tree.num_leaves().occupied);
    state.counters["bytes_per_occupied"] =
        static_cast<double>(tree.memory_bytes()) / static_cast<double>(tree.num_leaves().occupied);
  }
  state.counters["ns_per_ray"] = 1e9 * seconds / static_cast<double>(sequence.num_rays) /
                                 static_cast<double>(state.iterations());
}

void register_by_resolution() {
  for (const auto& [name, mode] : {std::pair{"projective", IntegrationMode::kProjective},
                                   {"discretize", IntegrationMode::kDiscretize},
                                   {"exact", IntegrationMode::kExact}}) {
    benchmark::RegisterBenchmark(
        (std::string("resolution/") + name + "/cm").c_str(), by_resolution, mode)
        ->Arg(1)
        ->Arg(2)
        ->Arg(5)
        ->Arg(10)
        ->UseManualTime()
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
  }
}

void register_one(const std::string& scene, const Sequence& (*sequence)(), double resolution_m) {
  const std::string suffix =
      "/" + scene + "/" + std::to_string(std::lround(resolution_m * 100.0)) + "cm";
  const auto add = [&](const std::string& name, IntegrationMode mode, bool octomap_discretize) {
    benchmark::RegisterBenchmark(
        (name + suffix).c_str(), compare, sequence, resolution_m, mode, octomap_discretize)
        ->UseManualTime()
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
  };
  add("projective_vs_insertPointCloud", IntegrationMode::kProjective, false);
  add("discretize_vs_insertPointCloud", IntegrationMode::kDiscretize, false);
  add("discretize_vs_octomap_discretize", IntegrationMode::kDiscretize, true);
  add("exact_vs_insertPointCloud", IntegrationMode::kExact, false);
}

}  // namespace
}  // namespace hypermap::test

int main(int argc, char** argv) {
  for (const double resolution_m : {0.05, 0.02}) {
    hypermap::test::register_one("room", hypermap::test::room, resolution_m);
    hypermap::test::register_one("kitchen", hypermap::test::kitchen, resolution_m);
  }
  hypermap::test::register_by_resolution();
  return hypermap::test::run_benchmarks(argc, argv);
}
