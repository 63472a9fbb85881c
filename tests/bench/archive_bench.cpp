// SPDX-License-Identifier: BSD-3-Clause
// A map of the simulated laboratory as a file: its size (octree with labels, objects, layers)
// against OctoMap's .ot of the occupancy alone, and the time to save and to load it against the
// time to make it, reading the frames included. CPU time of all threads, one thread's worth of
// work.
#include "bench/cpu_time.hpp"
#include "bench/run_benchmarks.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"
#include "hypermap/io/simulator/scene_file.hpp"
#include "hypermap/io/simulator/simulator.hpp"
#include "octree_semantic/support/octomap_trees.hpp"
#include "support/temp_dir.hpp"
#include "support/test_data.hpp"

#include <benchmark/benchmark.h>

#include <filesystem>
#include <sstream>
#include <string>

namespace hypermap::test {
namespace {

constexpr int kNumFrames = 100;

struct Made {
  bool ok = false;
  double mapping_s = 0.0;
  MapArchive archive;
};

Made make_map(const std::filesystem::path& folder, double resolution_m) {
  const auto scene = load_scene(source_path("data/scenes/laboratory.yaml"));
  if (!scene) return {};
  SimulationOptions simulation;
  simulation.num_frames = kNumFrames;
  if (!simulate(*scene, simulation, folder / "lab")) return {};
  MappingJob job;
  job.input = folder / "lab";
  job.output = folder / "lab.hmap";
  job.mapper.octree.resolution_m = resolution_m;
  Made made;
  made.mapping_s = cpu_time_of([&] { made.ok = run_mapping(job).has_value(); });
  auto loaded = load_archive(job.output);
  if (!made.ok || !loaded) return {};
  made.archive = std::move(loaded->value);
  return made;
}

void archive(benchmark::State& state, double resolution_m) {
  const TempDir folder;
  const Made made = make_map(folder.path(), resolution_m);
  if (!made.ok || !made.archive.octree) {
    state.SkipWithError("the laboratory could not be mapped");
    return;
  }
  const std::filesystem::path file = folder.path() / "again.hmap";
  double save_s = 0.0;
  double load_s = 0.0;
  for ([[maybe_unused]] const auto _ : state) {
    save_s += cpu_time_of([&] {
      if (!save_archive(made.archive, file, {.limits = {}, .verify = false})) {
        state.SkipWithError("the archive could not be saved");
      }
    });
    load_s += cpu_time_of([&] { benchmark::DoNotOptimize(load_archive(file)); });
  }
  std::ostringstream ot;
  to_octomap(*made.archive.octree)->write(ot);
  const auto count = static_cast<double>(state.iterations());
  const auto archive_bytes = static_cast<double>(std::filesystem::file_size(file));
  state.counters["archive_kb"] = 1e-3 * archive_bytes;
  state.counters["ot_kb"] = 1e-3 * static_cast<double>(ot.str().size());
  state.counters["archive_over_ot"] = archive_bytes / static_cast<double>(ot.str().size());
  state.counters["save_ms"] = 1e3 * save_s / count;
  state.counters["load_ms"] = 1e3 * load_s / count;
  state.counters["mapping_ms"] = 1e3 * made.mapping_s;
  state.counters["occupied"] = static_cast<double>(made.archive.octree->num_leaves().occupied);
}

}  // namespace
}  // namespace hypermap::test

int main(int argc, char** argv) {
  for (const auto& [name, resolution_m] : {std::pair{"5cm", 0.05}, {"2cm", 0.02}}) {
    benchmark::RegisterBenchmark(
        (std::string("archive/laboratory/") + name).c_str(), hypermap::test::archive, resolution_m)
        ->Iterations(5)
        ->Unit(benchmark::kMillisecond);
  }
  return hypermap::test::run_benchmarks(argc, argv);
}
