// SPDX-License-Identifier: BSD-3-Clause
// Large layers: an archive of 100,000 shapes and one of a grid of 4000 x 4000 cells, loaded; what
// is at a point and in an area of such a layer; changes to it.
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/projection/layers/semantic_update.hpp"
#include "support/temp_dir.hpp"

#include <benchmark/benchmark.h>

#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::uint64_t kNumShapes = 100'000;
constexpr double kHalfPlaneM = 500.0;

Polygon square_of(double x, double y, double edge_m) {
  return make_polygon({{x, y}, {x + edge_m, y}, {x + edge_m, y + edge_m}, {x, y + edge_m}}).value();
}

/// Squares of 0.2 to 2 m, scattered over a square kilometre, of fifty classes.
class ScatteredSquares {
 public:
  SemanticObject next(std::uint64_t id) {
    const double edge_m = edge_(random_);
    return {.id = id,
            .name = "class " + std::to_string(id % 50),
            .parts = {square_of(place(), place(), edge_m)},
            .confidence = {0.25}};
  }
  double place() { return place_(random_); }

 private:
  std::mt19937 random_{1};
  std::uniform_real_distribution<double> place_{-kHalfPlaneM, kHalfPlaneM};
  std::uniform_real_distribution<double> edge_{0.2, 2.0};
};

SemanticLayer many_shapes() {
  ScatteredSquares squares;
  std::vector<SemanticObject> objects;
  for (std::uint64_t id = 0; id < kNumShapes; ++id) objects.push_back(squares.next(id));
  return SemanticLayer::create(std::move(objects)).value();
}

std::filesystem::path saved_layer(const test::TempDir& folder, LayerContent content) {
  MapArchive archive;
  (void)archive.hypermap.add_layer({.info = {.name = "layer"}, .content = std::move(content)});
  auto path = folder / "a.hmap";
  (void)save_archive(archive, path, {.limits = {}, .verify = false});
  return path;
}

void load(benchmark::State& state, LayerContent content) {
  const test::TempDir folder;
  const auto path = saved_layer(folder, std::move(content));
  for ([[maybe_unused]] const auto _ : state) {
    if (!load_archive(path)) state.SkipWithError("the archive could not be loaded");
  }
}

void load_shapes(benchmark::State& state) {
  load(state, many_shapes());
}
BENCHMARK(load_shapes)->Unit(benchmark::kMillisecond)->Iterations(3);

void load_grid(benchmark::State& state) {
  const GridGeometry geometry{.resolution_m = 0.05, .cols = 4000, .rows = 4000};
  OccupancyGrid grid = OccupancyGrid::create(geometry, kFreeCell).value();
  std::mt19937 random(2);
  for (int i = 0; i < 1'000'000; ++i) {
    const auto at = [&] { return std::uniform_int_distribution<int>(0, 3999)(random); };
    grid.set({.col = at(), .row = at()}, i % 2 == 0 ? kOccupiedCell : kUnknownCell);
  }
  load(state, OccupancyLayer(std::move(grid)));
}
BENCHMARK(load_grid)->Unit(benchmark::kMillisecond)->Iterations(3);

void shapes_at_a_point(benchmark::State& state) {
  const SemanticLayer layer = many_shapes();
  ScatteredSquares places;
  for ([[maybe_unused]] const auto _ : state)
    benchmark::DoNotOptimize(layer.at({places.place(), places.place()}));
}
BENCHMARK(shapes_at_a_point)->Unit(benchmark::kMicrosecond);

/// By the edge of the area in metres; `answers` is how many shapes meet it.
void shapes_in_an_area(benchmark::State& state) {
  const SemanticLayer layer = many_shapes();
  const double edge_m = static_cast<double>(state.range(0));
  ScatteredSquares places;
  std::size_t answers = 0;
  for ([[maybe_unused]] const auto _ : state)
    answers += layer.in(square_of(0.5 * places.place(), 0.5 * places.place(), edge_m)).size();
  state.counters["answers"] =
      benchmark::Counter(static_cast<double>(answers), benchmark::Counter::kAvgIterations);
}
BENCHMARK(shapes_in_an_area)->Arg(1)->Arg(10)->Arg(100)->Unit(benchmark::kMicrosecond);

/// An update that adds, modifies and deletes as many objects each.
void update_shapes(benchmark::State& state) {
  SemanticLayer layer = many_shapes();
  ScatteredSquares squares;
  const auto count = static_cast<std::uint64_t>(state.range(0));
  std::uint64_t oldest = 0;
  for ([[maybe_unused]] const auto _ : state) {
    SemanticUpdate update;
    for (std::uint64_t i = 0; i < count; ++i) {
      update.to_delete.push_back(oldest + i);
      update.to_modify.push_back({.id = oldest + count + i, .name = "renamed"});
      update.to_number.push_back(squares.next(0));
    }
    if (!layer.apply(update)) state.SkipWithError("the update was refused");
    oldest += count;
  }
}
BENCHMARK(update_shapes)->Arg(1)->Arg(100)->Unit(benchmark::kMicrosecond)->Iterations(200);

}  // namespace
}  // namespace hypermap

BENCHMARK_MAIN();
