// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/split_job.hpp"

#include "io/archive/sample_archive.hpp"
#include "support/files_below.hpp"
#include "support/temp_dir.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>

namespace hypermap {
namespace {

class SplitJobTest : public testing::Test {
 protected:
  test::TempDir dir;
  MapArchive map = test::sample_archive();
  SplitJob job{.edge_m = 0.5, .output = dir.path() / "tiles"};
};

TEST_F(SplitJobTest, TheIndexSaysWhatEachTileHas) {
  const auto report = run_split(map, job);
  ASSERT_TRUE(report) << to_string(report.error());
  ASSERT_GT(report->tiles.size(), 1U);
  std::size_t num_voxels = 0;
  for (const MapTile& tile : report->tiles) {
    const auto loaded = load_archive(job.output / tile.file);
    ASSERT_TRUE(loaded) << to_string(loaded.error());
    const LeafCount leaves = loaded->value.octree->num_leaves();
    EXPECT_EQ(leaves.occupied + leaves.free, tile.num_voxels);
    EXPECT_EQ(loaded->value.objects.size(), tile.num_objects);
    num_voxels += tile.num_voxels;
  }
  EXPECT_EQ(num_voxels, 100U);  // of the sample
  const auto files = test::files_below(job.output);
  EXPECT_EQ(files.size(), report->tiles.size() + 1);
  EXPECT_TRUE(files.at("tiles.json").starts_with("{\"tile_m\":0.5,\"tiles\":[{\"file\":\"tile_"));
}

TEST_F(SplitJobTest, AnInterruptedOneLeavesTheFolderAsItWas) {
  ASSERT_TRUE(run_split(map, job));
  const auto before = test::files_below(dir.path());
  job.edge_m = 0.25;
  const auto stopped = run_split(map, job, [](std::size_t done, std::size_t) { return done < 2; });
  EXPECT_EQ(stopped.error().code, ErrorCode::kInterrupted);
  EXPECT_EQ(test::files_below(dir.path()), before);
}

TEST_F(SplitJobTest, OtherFilesAreNotReplaced) {
  std::filesystem::create_directories(job.output);
  std::ofstream(job.output / "letter.txt") << "dear";
  EXPECT_EQ(run_split(map, job).error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(test::files_below(job.output).size(), 1U);
}

TEST_F(SplitJobTest, AnEmptyMapHasNoTiles) {
  const auto report = run_split(MapArchive{}, job);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_TRUE(report->tiles.empty());
  EXPECT_EQ(test::files_below(job.output).at("tiles.json"),
            "{\"tile_m\":0.5,\"tiles\":[],\"ways\":[]}\n");
}

}  // namespace
}  // namespace hypermap
