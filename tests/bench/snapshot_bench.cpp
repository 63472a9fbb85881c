// SPDX-License-Identifier: BSD-3-Clause
// What a frame costs more when each one is published, and what a snapshot costs who asks for it.
//
// Two mappers see the same frames of the simulated laboratory (640 x 480, ten detections) in turn,
// one of which publishes every frame. Both go on from a map that already has many voxels and
// objects elsewhere. After a first pass that makes the map, of each frame the least CPU time over
// the passes counts. The writer frees each snapshot that it replaces, for nobody else holds it: the
// dearest case for a frame.
#include "bench/cpu_time.hpp"
#include "bench/laboratory_frames.hpp"
#include "bench/run_benchmarks.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace hypermap::test {
namespace {

constexpr std::size_t kNumFrames = 24;
constexpr int kNumPublishedPasses = 7;

const std::vector<RgbdFrame>& laboratory() {
  static const std::vector<RgbdFrame> kFrames = laboratory_frames(kNumFrames);
  return kFrames;
}

/// Voxels and objects in a plane far from the laboratory; every eighth voxel is occupied.
struct Elsewhere {
  std::size_t num_voxels = 0;
  std::size_t num_objects = 0;
};

SemanticOctree voxels_elsewhere(const OctreeOptions& options, std::size_t num_voxels) {
  std::vector<StoredLeaf> leaves;
  leaves.reserve(num_voxels);
  for (std::size_t i = 0; i < num_voxels; ++i) {
    leaves.push_back({.key = {static_cast<std::uint16_t>(40'000 + i % 1000),
                              static_cast<std::uint16_t>(40'000 + i / 1000),
                              32'768},
                      .log_odds = static_cast<MilliLogOdds>(i % 8 == 0 ? 2000 : -1000)});
  }
  return SemanticOctree::from_leaves(options, leaves).value();
}

ObjectMap objects_elsewhere(std::size_t num_objects) {
  ObjectMap objects;
  for (std::size_t i = 0; i < num_objects; ++i) {
    Object object;
    const std::size_t row = i / 100;
    const Eigen::Vector3d corner(
        400.0 + static_cast<double>(i % 100), 400.0 + static_cast<double>(row), 0.0);
    object.box = {corner, corner + Eigen::Vector3d::Constant(0.5)};
    object.centroid_in_map = object.box.centre();
    (void)objects.add(std::move(object));
  }
  return objects;
}

SemanticMapper mapper_of(double resolution_m, const Elsewhere& elsewhere, int publish) {
  SemanticMapperOptions options;
  options.octree.resolution_m = resolution_m;
  options.publish_every_n_frames = publish;
  auto mapper = SemanticMapper::resume(options,
                                       voxels_elsewhere(options.octree, elsewhere.num_voxels),
                                       objects_elsewhere(elsewhere.num_objects))
                    .value();
  mapper.set_clock(cpu_seconds);
  return mapper;
}

double frame_seconds(SemanticMapper& mapper, const RgbdFrame& frame) {
  const StopWatch watch(cpu_seconds);
  benchmark::DoNotOptimize(mapper.integrate(frame).value());
  return watch.elapsed_s();
}

bool is_skipped(benchmark::State& state) {
  if (!laboratory().empty()) return false;
  state.SkipWithError("no frames: scene not present");
  return true;
}

void publish_frames(benchmark::State& state, double resolution_m, const Elsewhere& elsewhere) {
  if (is_skipped(state)) return;
  std::array<SemanticMapper, 2> mappers{mapper_of(resolution_m, elsewhere, 0),
                                        mapper_of(resolution_m, elsewhere, 1)};
  constexpr double kNever = std::numeric_limits<double>::infinity();
  std::array<std::vector<double>, 2> least{std::vector(laboratory().size(), kNever),
                                           std::vector(laboratory().size(), kNever)};
  for ([[maybe_unused]] const auto _ : state) {
    for (int pass = 0; pass <= kNumPublishedPasses; ++pass) {
      for (std::size_t i = 0; i < laboratory().size(); ++i) {
        for (const std::size_t which : {0U, 1U}) {
          const double seconds = frame_seconds(mappers[which], laboratory()[i]);
          if (pass > 0) least[which][i] = std::min(least[which][i], seconds);
        }
      }
    }
  }
  const auto mean_ms = [](const std::vector<double>& seconds) {
    double sum = 0.0;
    for (const double s : seconds) sum += s;
    return 1e3 * sum / static_cast<double>(seconds.size());
  };
  state.counters["frame_ms"] = mean_ms(least[0]);
  state.counters["published_ms"] = mean_ms(least[1]);
  state.counters["more_percent"] = 100.0 * (mean_ms(least[1]) / mean_ms(least[0]) - 1.0);
  const LeafCount leaves = mappers[0].octree().num_leaves();
  state.counters["voxels"] = static_cast<double>(leaves.occupied + leaves.free);
  state.counters["objects"] = static_cast<double>(mappers[0].objects().size());
  state.counters["alone_mb"] = 1e-6 * static_cast<double>(mappers[0].octree().memory_bytes());
  state.counters["published_mb"] = 1e-6 * static_cast<double>(mappers[1].octree().memory_bytes());
}

void take_snapshot(benchmark::State& state, const Elsewhere& elsewhere) {
  if (is_skipped(state)) return;
  const SemanticMapper mapper = mapper_of(0.05, elsewhere, 1);
  for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(mapper.snapshot());
}

void register_publishing() {
  const auto add = [](const std::string& name, double resolution_m, const Elsewhere& elsewhere) {
    benchmark::RegisterBenchmark(name.c_str(), publish_frames, resolution_m, elsewhere)
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
  };
  add("publish/5cm/voxels:10000/objects:100", 0.05, {10'000, 100});
  add("publish/5cm/voxels:1000000/objects:100", 0.05, {1'000'000, 100});
  add("publish/5cm/voxels:1000000/objects:10000", 0.05, {1'000'000, 10'000});
  add("publish/2cm/voxels:10000/objects:100", 0.02, {10'000, 100});
  add("publish/2cm/voxels:1000000/objects:10000", 0.02, {1'000'000, 10'000});
  const auto take = [](const std::string& name, const Elsewhere& elsewhere) {
    benchmark::RegisterBenchmark(name.c_str(), take_snapshot, elsewhere);
  };
  take("snapshot/voxels:10000/objects:100", {10'000, 100});
  take("snapshot/voxels:1000000/objects:10000", {1'000'000, 10'000});
}

}  // namespace
}  // namespace hypermap::test

int main(int argc, char** argv) {
  hypermap::test::register_publishing();
  return hypermap::test::run_benchmarks(argc, argv);
}
