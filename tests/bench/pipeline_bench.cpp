// SPDX-License-Identifier: BSD-3-Clause
// CPU time of a whole frame, from depth and detections to its report: SemanticMapper::integrate on
// the simulated laboratory (640 x 480, ten detections a frame) and on recorded kitchen frames.
//
// A first pass over the frames makes the map; the passes after it are measured. All figures but
// `frame_wall_ms` are CPU time of all threads; of each frame the least over the passes counts, so
// that another program on the machine hardly shows.
#include "bench/cpu_time.hpp"
#include "bench/laboratory_frames.hpp"
#include "bench/run_benchmarks.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"
#include "support/test_data.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace hypermap::test {
namespace {

constexpr std::size_t kMaxFrames = 24;
constexpr int kNumPasses = 5;

std::vector<RgbdFrame> read_kitchen() {
  std::vector<RgbdFrame> frames;
  const auto folder = shared_data("rgbd/7scenes_redkitchen");
  ClassRegistry classes;
  DatasetOptions options;
  options.detections = {folder / "detections_yolox_nano.jsonl"};
  options.max_frames = kMaxFrames;
  options.read_color = false;
  const auto dataset = open_dataset(folder, options, classes);
  if (!dataset) return frames;
  for (std::size_t i = 0; i < (*dataset)->size(); ++i) {
    if (auto frame = (*dataset)->read(i)) frames.push_back(*std::move(frame));
  }
  return frames;
}

const std::vector<RgbdFrame>& laboratory() {
  static const std::vector<RgbdFrame> kFrames = laboratory_frames(kMaxFrames);
  return kFrames;
}
const std::vector<RgbdFrame>& kitchen() {
  static const std::vector<RgbdFrame> kFrames = read_kitchen();
  return kFrames;
}

/// What one frame took, each figure the least so far.
struct FrameCost {
  double cpu = std::numeric_limits<double>::infinity();
  double wall = cpu;
  StageSeconds stages{
      .smooth = cpu, .segment = cpu, .associate = cpu, .integrate = cpu, .visibility = cpu};

  void take(double wall_s, const StageSeconds& seconds) {
    wall = std::min(wall, wall_s);
    cpu = std::min(cpu,
                   seconds.smooth + seconds.segment + seconds.associate + seconds.integrate +
                       seconds.visibility);
    stages.smooth = std::min(stages.smooth, seconds.smooth);
    stages.segment = std::min(stages.segment, seconds.segment);
    stages.associate = std::min(stages.associate, seconds.associate);
    stages.integrate = std::min(stages.integrate, seconds.integrate);
    stages.visibility = std::min(stages.visibility, seconds.visibility);
  }
};

void whole_frame(benchmark::State& state,
                 const std::vector<RgbdFrame>& (*frames_of)(),
                 double resolution_m,
                 int num_threads) {
  const std::vector<RgbdFrame>& frames = frames_of();
  if (frames.empty()) {
    state.SkipWithError("no frames: scene or test data not present");
    return;
  }
  SemanticMapperOptions options;
  options.octree.resolution_m = resolution_m;
  options.num_threads = num_threads;
  auto mapper = SemanticMapper::create(options).value();
  mapper.set_clock(cpu_seconds);
  std::vector<FrameCost> costs(frames.size());
  FrameReport report;
  std::size_t num_detections = 0;
  for ([[maybe_unused]] const auto _ : state) {
    for (int pass = 0; pass <= kNumPasses; ++pass) {
      num_detections = 0;
      for (std::size_t i = 0; i < frames.size(); ++i) {
        const StopWatch watch;
        report = mapper.integrate(frames[i]).value();
        if (pass > 0) costs[i].take(watch.elapsed_s(), report.seconds);
        num_detections += report.num_detections;
      }
    }
  }
  const auto mean_ms = [&](auto figure) {
    double sum = 0.0;
    for (const FrameCost& cost : costs) sum += figure(cost);
    return 1e3 * sum / static_cast<double>(costs.size());
  };
  const double per_frame = static_cast<double>(num_detections) / static_cast<double>(frames.size());
  const double segment_ms = mean_ms([](const FrameCost& c) { return c.stages.segment; });
  state.counters["frame_ms"] = mean_ms([](const FrameCost& c) { return c.cpu; });
  state.counters["frame_wall_ms"] = mean_ms([](const FrameCost& c) { return c.wall; });
  state.counters["smooth_ms"] = mean_ms([](const FrameCost& c) { return c.stages.smooth; });
  state.counters["segment_ms"] = segment_ms;
  state.counters["associate_ms"] = mean_ms([](const FrameCost& c) { return c.stages.associate; });
  state.counters["integrate_ms"] = mean_ms([](const FrameCost& c) { return c.stages.integrate; });
  state.counters["visibility_ms"] = mean_ms([](const FrameCost& c) { return c.stages.visibility; });
  state.counters["detections"] = per_frame;
  state.counters["segment_ms_per_detection"] = segment_ms / per_frame;
  state.counters["objects"] = static_cast<double>(mapper.objects().size());
}

void register_all() {
  const auto add = [](const std::string& name, auto frames, double resolution_m, int threads) {
    benchmark::RegisterBenchmark(name.c_str(), whole_frame, frames, resolution_m, threads)
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
  };
  add("frame/laboratory/5cm/threads:1", laboratory, 0.05, 1);
  add("frame/laboratory/5cm/threads:2", laboratory, 0.05, 2);
  add("frame/laboratory/2cm/threads:1", laboratory, 0.02, 1);
  add("frame/kitchen/5cm/threads:1", kitchen, 0.05, 1);
}

}  // namespace
}  // namespace hypermap::test

int main(int argc, char** argv) {
  hypermap::test::register_all();
  return hypermap::test::run_benchmarks(argc, argv);
}
