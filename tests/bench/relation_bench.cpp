// SPDX-License-Identifier: BSD-3-Clause
// What it costs to find the relations of many objects: rooms side by side, each a table with what
// stands on, under and beside it.
#include "core/places/furniture.hpp"
#include "hypermap/core/places/relations.hpp"

#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

namespace hypermap {
namespace {

using namespace testing_support;  // NOLINT(google-build-using-namespace): builders in words

constexpr int kObjectsPerRoom = 10;
constexpr int kRoomsPerRow = 32;

FurnishedRoom rooms(std::int64_t num_objects) {
  FurnishedRoom room;
  const Eigen::Vector3d cup(0.08, 0.08, 0.1);
  const auto num_rooms = static_cast<int>(num_objects) / kObjectsPerRoom;
  for (int i = 0; i < num_rooms; ++i) {
    const int row = i / kRoomsPerRow;
    const double x = 3.0 * (i % kRoomsPerRow);
    const double y = 3.0 * row;
    room.add("table", table_at(x, y));
    room.add("chair", chair_at(x - 0.3, y + 0.25));
    room.add("chair", chair_at(x + 0.3, y + 0.25));
    room.add("chair", chair_at(x, y - 0.9));
    for (int k = 0; k < kObjectsPerRoom - 4; ++k) {
      room.add("cup", standing(x - 0.5 + 0.15 * k, y, 0.74, cup));
    }
  }
  return room;
}

void find_relations_of_rooms(benchmark::State& state) {
  const FurnishedRoom room = rooms(state.range(0));
  const std::vector<ObjectId> ids = room.ids();
  std::size_t num_relations = 0;
  for ([[maybe_unused]] const auto _ : state) {
    num_relations = find_relations(room.objects, room.classes, ids).relations.size();
    benchmark::DoNotOptimize(num_relations);
  }
  state.counters["relations"] = static_cast<double>(num_relations);
}
BENCHMARK(find_relations_of_rooms)->Arg(1'000)->Arg(10'000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hypermap

BENCHMARK_MAIN();
