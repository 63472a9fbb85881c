// SPDX-License-Identifier: BSD-3-Clause
// What an evaluation says of the layers `occupancy`.
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/jobs/evaluation_job.hpp"
#include "hypermap/projection/layers/occupancy_layer.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"
#include "support/temp_dir.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace hypermap {
namespace {

class EvaluatedOccupancy : public testing::Test {
 protected:
  /// A map of a chair, with a grid of three cells whose first is `cell`; none: without a grid.
  [[nodiscard]] std::filesystem::path saved(const std::string& name,
                                            std::optional<std::int8_t> cell,
                                            const std::string& frame_id = "map") const {
    MapArchive archive;
    SemanticLayer chair;
    const Polygon square = make_polygon({{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}).value();
    EXPECT_TRUE(chair.add({.id = 1, .name = "chair", .parts = {square}}));
    EXPECT_TRUE(archive.hypermap.add_layer({{.name = "semantic"}, std::move(chair)}));
    if (cell) {
      const GridGeometry geometry{.resolution_m = 1.0, .cols = 3, .rows = 1};
      auto grid = OccupancyGrid::create(geometry, {*cell, kFreeCell, kFreeCell}).value();
      EXPECT_TRUE(archive.hypermap.add_layer(
          {{.name = "occupancy", .frame_id = frame_id}, OccupancyLayer(std::move(grid))}));
    }
    EXPECT_TRUE(save_archive(archive, dir / name));
    return dir / name;
  }
  [[nodiscard]] std::optional<GridAgreement> agreement(const std::filesystem::path& map) const {
    return run_evaluation({.map = map, .truth = saved("truth.hmap", kOccupiedCell)})
        .value()
        .occupancy;
  }

  test::TempDir dir;
};

TEST_F(EvaluatedOccupancy, IsThatOfBothLayers) {
  const auto all_free = agreement(saved("free.hmap", kFreeCell));
  ASSERT_TRUE(all_free);
  EXPECT_DOUBLE_EQ(*all_free->free_precision(), 2.0 / 3.0);
  EXPECT_EQ(all_free->occupied_free, 1U);
}

TEST_F(EvaluatedOccupancy, IsNoneOfOneLayerOrOfTwoFrames) {
  EXPECT_FALSE(agreement(saved("moved.hmap", kFreeCell, "lab")));
  EXPECT_FALSE(agreement(saved("without.hmap", std::nullopt)));
}

}  // namespace
}  // namespace hypermap
