// SPDX-License-Identifier: BSD-3-Clause
// Occlusion rays through a furnished room of 10,000 to a million occupied voxels, in millions of
// answers per second on one thread, against OctoMap's castRay in the same run (which says more: it
// finds the voxel). `ratio` is ours over OctoMap's. Lines come as an object's do: 64 from one
// camera to places within 0.25 m of each other; `scattered`: each from anywhere to anywhere.
#include "bench/cpu_time.hpp"
#include "bench/run_benchmarks.hpp"
#include "hypermap/octree_semantic/occlusion/occlusion_scene.hpp"

#include <benchmark/benchmark.h>
#include <octomap/octomap.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace hypermap::test {
namespace {

constexpr std::size_t kNumRays = 320'000;
constexpr std::size_t kNumCasts = 20'000;
constexpr std::size_t kLinesPerObject = 64;

struct Cuboid {
  std::array<double, 3> low;
  std::array<double, 3> high;
};

/// A room of 8 m by 6 m with two tables, a shelf, a sofa, a sideboard, a box and four chairs.
std::vector<Cuboid> room() {
  std::vector<Cuboid> parts{{{0, 0, 0}, {8, 6, 2.7}},
                            {{1, 1, 0.7}, {2.6, 1.8, 0.74}},
                            {{4.5, 2.2, 0.71}, {6.3, 3.2, 0.75}},
                            {{7.5, 0.5, 0}, {7.95, 2, 2}},
                            {{0.05, 3.5, 0}, {0.95, 5.5, 0.42}},
                            {{3, 5.5, 0}, {4.2, 5.95, 1.2}},
                            {{6.8, 5.2, 0}, {7.3, 5.7, 0.6}}};
  for (const double x : {1.4, 4.7, 5.5, 6.2}) {
    parts.push_back({{x, 2.0, 0.42}, {x + 0.45, 2.45, 0.46}});
    parts.push_back({{x, 2.0, 0.46}, {x + 0.45, 2.04, 0.95}});
    parts.push_back({{x, 2.0, 0}, {x + 0.05, 2.05, 0.42}});
    parts.push_back({{x + 0.4, 2.4, 0}, {x + 0.45, 2.45, 0.42}});
  }
  return parts;
}

/// Voxels that the faces of a cuboid pass through.
void add_shell(const Cuboid& cuboid, double resolution_m, std::vector<VoxelKey>& voxels) {
  const auto index = [&](double at) {
    return static_cast<std::uint16_t>(32768 + static_cast<int>(std::floor(at / resolution_m)));
  };
  const std::array low{index(cuboid.low[0]), index(cuboid.low[1]), index(cuboid.low[2])};
  const std::array high{index(cuboid.high[0]), index(cuboid.high[1]), index(cuboid.high[2])};
  for (std::uint16_t x = low[0]; x <= high[0]; ++x) {
    for (std::uint16_t y = low[1]; y <= high[1]; ++y) {
      const bool is_edge = x == low[0] || x == high[0] || y == low[1] || y == high[1];
      const auto step = static_cast<std::uint16_t>(is_edge ? 1 : std::max(1, high[2] - low[2]));
      for (std::uint16_t z = low[2]; z <= high[2]; z = static_cast<std::uint16_t>(z + step)) {
        voxels.push_back({x, y, z});
      }
    }
  }
}

struct Place {
  SemanticOctree tree;
  octomap::OcTree octomap;
  std::vector<VoxelKey> voxels;
};

Place make_place(double resolution_m) {
  std::vector<VoxelKey> voxels;
  for (const Cuboid& part : room()) add_shell(part, resolution_m, voxels);
  Place place{SemanticOctree::create({.resolution_m = resolution_m}).value(),
              octomap::OcTree(resolution_m),
              std::move(voxels)};
  for (const VoxelKey& key : place.voxels) {
    static_cast<void>(place.tree.set_leaf({.key = key, .log_odds = 2000}));
    place.octomap.updateNode(octomap::OcTreeKey(key.x, key.y, key.z), 2.0F, true);
  }
  place.octomap.updateInnerOccupancy();
  return place;
}

std::vector<OcclusionRay> rays_in(const Place& place, bool scattered, double margin_m) {
  std::mt19937 random(3);
  const auto within = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  std::vector<OcclusionRay> rays;
  rays.reserve(kNumRays);
  OcclusionRay ray{.from = {}, .to = {}, .margin_m = margin_m};
  Eigen::Vector3d object;
  for (std::size_t i = 0; i < kNumRays; ++i) {
    if (scattered || i % kLinesPerObject == 0) {
      ray.from.xyz = {within(1.5, 6.5), within(1.3, 4.7), within(1.0, 1.5)};
      object = place.tree.grid().centre(place.voxels[random() % place.voxels.size()]).xyz;
    }
    ray.to.xyz =
        object + Eigen::Vector3d(within(-0.25, 0.25), within(-0.25, 0.25), within(-0.25, 0.25));
    rays.push_back(ray);
  }
  return rays;
}

/// Millions of castRay's answers per second.
double cast_rate(const Place& place, std::span<const OcclusionRay> rays) {
  const double seconds = cpu_time_of([&] {
    octomap::point3d end;
    for (const OcclusionRay& ray : rays) {
      const Eigen::Vector3f from = ray.from.xyz.cast<float>();
      const Eigen::Vector3f way = (ray.to.xyz - ray.from.xyz).cast<float>();
      benchmark::DoNotOptimize(
          place.octomap.castRay({from.x(), from.y(), from.z()},
                                {way.x(), way.y(), way.z()},
                                end,
                                true,
                                static_cast<double>(way.norm()) - ray.margin_m));
    }
  });
  return static_cast<double>(rays.size()) / seconds * 1e-6;
}

/// Milliseconds to bring the scene up to date when one voxel in the middle of the room comes.
double update_ms(SemanticOctree& tree, OcclusionScene& scene) {
  const VoxelKey key = tree.grid().key(PointInMap{{4.0, 4.0, 1.2}}).value();
  static_cast<void>(tree.set_leaf({.key = key, .log_odds = 2000}));
  return 1e3 * cpu_time_of([&] { benchmark::DoNotOptimize(scene.update(tree)); });
}

void occlusion_rays(benchmark::State& state, double resolution_m, bool scattered) {
  Place place = make_place(resolution_m);
  const std::vector<OcclusionRay> rays = rays_in(place, scattered, 2.0 * resolution_m);
  auto scene = OcclusionScene::create().value();
  double build = 1e9;
  for (int i = 0; i < 3; ++i) {
    scene = OcclusionScene::create().value();
    const auto update = [&] { benchmark::DoNotOptimize(scene.update(place.tree)); };
    build = std::min(build, cpu_time_of(update));
  }
  std::vector<std::uint8_t> answers;
  double best = 1e9;
  for ([[maybe_unused]] const auto _ : state) {
    const double seconds = cpu_time_of([&] { answers = scene.occluded(rays); });
    state.SetIterationTime(seconds);
    best = std::min(best, seconds);
  }
  const double rate = static_cast<double>(rays.size()) / best * 1e-6;
  state.counters["million_per_s"] = rate;
  state.counters["ratio"] = rate / cast_rate(place, std::span(rays).first(kNumCasts));
  state.counters["build_ms"] = build * 1e3;
  state.counters["update_ms"] = update_ms(place.tree, scene);
  state.counters["occupied"] = static_cast<double>(place.tree.num_leaves().occupied);
  state.counters["bricks"] = static_cast<double>(scene.num_bricks());
  state.counters["hidden"] =
      static_cast<double>(std::count(answers.begin(), answers.end(), std::uint8_t{1}));
}

}  // namespace
}  // namespace hypermap::test

int main(int argc, char** argv) {
  const auto add = [](const std::string& name, bool scattered) {
    for (const auto& [size, resolution_m] :
         {std::pair{"10k", 0.14}, {"100k", 0.0445}, {"1M", 0.0141}}) {
      const std::string full = name + "/" + size;
      benchmark::RegisterBenchmark(
          full.c_str(), hypermap::test::occlusion_rays, resolution_m, scattered)
          ->UseManualTime()
          ->Iterations(7)
          ->Unit(benchmark::kMillisecond);
    }
  };
  add("occlusion_rays", false);
  add("scattered", true);
  return hypermap::test::run_benchmarks(argc, argv);
}
