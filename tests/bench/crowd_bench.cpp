// SPDX-License-Identifier: BSD-3-Clause
// Ten thousand objects in a hall of 100 m: small cupboards, one a square metre, of which some
// thirty are in range of the robot that drives between them with a small depth image (160 x 120).
// When it has seen them all: what a frame's association and visibility take, what it takes to tell
// which objects are confirmed, and the map as a file.
//
// HYPERMAP_CROWD_SIDE_M: the hall's side (100), for a shorter look.
#include "bench/cpu_time.hpp"
#include "bench/painted_world.hpp"
#include "bench/run_benchmarks.hpp"
#include "hypermap/core/objects/confirmation.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"
#include "support/camera_pose.hpp"
#include "support/temp_dir.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

namespace hypermap::test {
namespace {

constexpr double kStepM = 0.75;
constexpr double kLaneM = 5.0;
constexpr std::size_t kNumTimedFrames = 60;

int side_m() {
  const char* text = std::getenv("HYPERMAP_CROWD_SIDE_M");
  return text == nullptr ? 100 : std::clamp(std::atoi(text), 10, 1'000);
}

World hall(int side_m) {
  World world{.walls = {{-1.0, -1.0, 0.0}, {side_m + 1.0, side_m + 1.0, 4.0}},
              .view_range_m = 7.2,
              .cupboards = {}};
  for (int x = 0; x < side_m; ++x) {
    for (int y = 0; y < side_m; ++y) {
      const int number = x * side_m + y;
      const double height_m = 0.3 + 0.1 * (number % 4);
      world.cupboards.push_back(
          cupboard(static_cast<std::uint32_t>(number), x + 0.35, y + 0.35, {0.3, 0.3, height_m}));
    }
  }
  return world;
}

/// Along x, a lane further, and back.
std::vector<MapFromCamera> lanes(int side_m) {
  std::vector<MapFromCamera> poses;
  bool forth = true;
  for (double y = 0.5 * kLaneM; y < side_m; y += kLaneM) {
    for (double way = 0.0; way < side_m; way += kStepM) {
      const double x = forth ? way : side_m - way;
      poses.push_back(camera_at({x, y, 1.6}, forth ? 0.0 : std::numbers::pi, -0.35));
    }
    forth = !forth;
  }
  return poses;
}

std::size_t num_in_range(const World& world, const MapFromCamera& pose) {
  const auto near = [&](const Cupboard& c) {
    const Eigen::Vector3d along = pose.inverse().isometry() * c.box.centre();
    return along.z() > 0.0 && along.norm() < world.view_range_m &&
           std::abs(along.x()) < 0.61 * along.z();
  };
  return static_cast<std::size_t>(
      std::count_if(world.cupboards.begin(), world.cupboards.end(), near));
}

/// A frame's times when all are known, in the middle of the hall.
void report_frames(benchmark::State& state,
                   SemanticMapper& mapper,
                   const World& world,
                   std::size_t index) {
  const double middle = 0.5 * side_m();
  StageSeconds sum;
  double in_range = 0.0;
  for (std::size_t i = 0; i < kNumTimedFrames; ++i) {
    const double turn = 2.0 * std::numbers::pi * static_cast<double>(i) / kNumTimedFrames;
    const MapFromCamera pose =
        camera_at({middle + std::cos(turn), middle + std::sin(turn), 1.6}, turn, -0.35);
    const auto report = mapper.integrate(paint(world, pose, index + i)).value();
    sum.associate += report.seconds.associate;
    sum.visibility += report.seconds.visibility;
    in_range += static_cast<double>(num_in_range(world, pose));
  }
  state.counters["in_range"] = in_range / kNumTimedFrames;
  state.counters["associate_ms"] = 1e3 * sum.associate / kNumTimedFrames;
  state.counters["visibility_ms"] = 1e3 * sum.visibility / kNumTimedFrames;
}

ClassRegistry cupboard_classes() {
  ClassRegistry classes;
  for (std::uint32_t i = 0; i < kNumCupboardClasses; ++i)
    (void)classes.add("cupboard " + std::to_string(i)).value();
  return classes;
}

void report_seconds(benchmark::State& state, const std::string& what, const WorkSeconds& seconds) {
  state.counters[what + "_s"] = seconds.cpu;
  state.counters[what + "_wall_s"] = seconds.wall;
}

void report_file(benchmark::State& state, const SemanticMapper& mapper) {
  const TempDir folder;
  const std::filesystem::path file = folder.path() / "hall.hmap";
  MapArchive archive;
  archive.objects = mapper.objects();
  archive.classes = cupboard_classes();
  bool saved = false;
  report_seconds(
      state, "objects_save", seconds_of([&] { saved = save_archive(archive, file).has_value(); }));
  if (!saved) return state.SkipWithError("the objects could not be saved");
  const double objects_bytes = static_cast<double>(std::filesystem::file_size(file));
  state.counters["kb_an_object"] =
      1e-3 * objects_bytes / static_cast<double>(mapper.objects().size());
  archive.octree = mapper.octree();
  report_seconds(
      state, "save", seconds_of([&] { saved = save_archive(archive, file).has_value(); }));
  if (!saved) return state.SkipWithError("the map could not be saved");
  state.counters["archive_mb"] = 1e-6 * static_cast<double>(std::filesystem::file_size(file));
  bool same = false;
  report_seconds(state, "load", seconds_of([&] {
                   const auto loaded = load_archive(file);
                   same = loaded && loaded->value.objects == archive.objects;
                 }));
  if (!same) state.SkipWithError("the map was not read as it was saved");
}

/// Preset smap knows things within 1.7 m ([smap] table D.1) and compares them with objects within
/// three edges of its graph, less than 3 m: of this hall it would hold the row beside the way. Here
/// it looks as far as the detector does, and compares with objects anywhere in its cone.
ObjectPipelineOptions options_for(const World& world, PresetName name) {
  ObjectPipelineOptions options = preset(name);
  if (name != PresetName::kSmap) return options;
  options.segmentation.max_range_m = world.view_range_m;
  options.association.graph_layers.reset();
  options.absence.graph_layers.reset();
  return options;
}

void crowd(benchmark::State& state, PresetName name) {
  const World world = hall(side_m());
  SemanticMapperOptions options;
  options.objects = options_for(world, name);
  options.octree.resolution_m = 0.1;
  auto mapper = SemanticMapper::create(options).value();
  for ([[maybe_unused]] const auto _ : state) {
    std::size_t index = 0;
    for (const MapFromCamera& pose : lanes(side_m()))
      (void)mapper.integrate(paint(world, pose, index++)).value();
    report_frames(state, mapper, world, index);
    std::size_t num_confirmed = 0;
    state.counters["confirm_ms"] =
        1e3 * cpu_time_of([&] {
          num_confirmed = confirmed_objects(mapper.objects(), options.objects.confirmation).size();
        });
    state.counters["confirmed"] = static_cast<double>(num_confirmed);
    state.counters["objects"] = static_cast<double>(mapper.objects().size());
    report_file(state, mapper);
  }
}

}  // namespace
}  // namespace hypermap::test

int main(int argc, char** argv) {
  benchmark::RegisterBenchmark(
      "crowd/default", hypermap::test::crowd, hypermap::PresetName::kDefault)
      ->Iterations(1)
      ->Unit(benchmark::kSecond);
  benchmark::RegisterBenchmark("crowd/smap", hypermap::test::crowd, hypermap::PresetName::kSmap)
      ->Iterations(1)
      ->Unit(benchmark::kSecond);
  return hypermap::test::run_benchmarks(argc, argv);
}
