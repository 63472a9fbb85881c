// SPDX-License-Identifier: BSD-3-Clause
// Runs that people call by a name.
#include "hypermap/io/jobs/mapping_job.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>

namespace hypermap {
namespace {

using test::TempDir;
using ::testing::HasSubstr;
using ::testing::SizeIs;

/// A described dataset of four frames in the world `house`; `depth` tells its first one from
/// others.
std::filesystem::path house(const std::filesystem::path& folder, std::uint16_t depth) {
  test::write_described(folder);
  test::write_text(folder / "dataset.yaml",
                   "name: synthetic\n"
                   "intrinsics: {width: 8, height: 6, fx: 8, fy: 8, cx: 3.5, cy: 2.5}\n"
                   "depth: d/*_d.pgm\ndepth_scale: 100\ntrajectory: p.txt\npair_by: order\n"
                   "pose_direction: world_to_camera\nup_axis: z\nworld: house\n");
  test::write_text(folder / "d/0000_d.pgm", test::pgm16(depth));
  return folder;
}

TEST(NamedSessions, EachSessionHasItsNameAndItsTimes) {
  const TempDir folder;
  MappingJob job{.input = house(folder / "first", 100), .output = folder / "a.hmap"};
  job.mapper.num_threads = 1;
  ASSERT_TRUE(run_mapping(job));
  job.input = house(folder / "second", 150);
  job.append = true;
  job.session = "evening";
  ASSERT_TRUE(run_mapping(job));
  const auto runs = load_archive(job.output)->value.provenance;
  ASSERT_THAT(runs, SizeIs(2));
  EXPECT_EQ(runs[0].session, "");
  EXPECT_EQ(runs[1].session, "evening");
  for (const Provenance& run : runs) {
    ASSERT_TRUE(run.first_stamp && run.last_stamp);
    EXPECT_LT(*run.first_stamp, *run.last_stamp);
  }
  job.force = true;
  const auto refused = run_mapping(job);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(to_string(refused.error()),
              HasSubstr("--session: the map has a session of that name"));
  job.session = "3";
  EXPECT_FALSE(run_mapping(job)) << "a number stands for a run without a name";
}

}  // namespace
}  // namespace hypermap
