// SPDX-License-Identifier: BSD-3-Clause
// Poses without stamps, a line each.
#include "hypermap/io/dataset/trajectory_file.hpp"
#include "support/temp_dir.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace hypermap {
namespace {

using test::TempDir;
using test::write_text;
using ::testing::HasSubstr;
using ::testing::SizeIs;

TEST(PoseLines, PosesWithoutStampsHave16Or12Or7NumbersALine) {
  const TempDir dir;
  // Half a turn about z at (1, 2, 3), the second line of each form.
  for (const std::string lines :
       {"1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n-1 0 0 1 0 -1 0 2 0 0 1 3 0 0 0 1\n",
        "1 0 0 0 0 1 0 0 0 0 1 0\n# turned\n-1 0 0 1 0 -1 0 2 0 0 1 3\n",
        "0 0 0 0 0 0 1\n1 2 3 0 0 1 0\n"}) {
    write_text(dir / "traj.txt", lines);
    const auto loaded = read_pose_lines(dir / "traj.txt");
    ASSERT_TRUE(loaded) << to_string(loaded.error());
    ASSERT_THAT(loaded->value.poses, SizeIs(2));
    EXPECT_EQ(loaded->value.poses[1].number, 1U);
    const Point<frame::Camera> point{{1.0, 0.0, 0.0}};
    const Eigen::Vector3d there = (loaded->value.poses[1].input_from_camera * point).xyz;
    EXPECT_TRUE(there.isApprox(Eigen::Vector3d(0.0, 2.0, 3.0))) << lines;
  }
}

TEST(PoseLines, BrokenPosesWithoutStampsAreRefusedByLineAndRule) {
  const TempDir dir;
  const auto refused = [&](const std::string& text) {
    write_text(dir / "traj.txt", text);
    const auto poses = read_pose_lines(dir / "traj.txt");
    return poses ? std::string("was accepted") : to_string(poses.error());
  };
  EXPECT_THAT(refused("0 0 0 0 0 0 1\n0 0 0 0 0 0 2\n"), HasSubstr("traj.txt:2: quaternion"));
  EXPECT_THAT(refused("0 0 0 0 0 0 1\n1 0 0 0 0 1 0 0 0 0 1 0\n"),
              HasSubstr("must have 7 numbers as the lines before, has 12"));
  EXPECT_THAT(refused("1 0 0 0 0 0 0 1\n"), HasSubstr("`trajectory_format: tum`"));
  EXPECT_THAT(refused("1 0 0\n"), HasSubstr("must have 16 numbers (4x4), 12 (3x4) or 7"));
  EXPECT_THAT(refused("1 0 0 0 0 1 0 0 0 0 nan 0\n"), HasSubstr("pose: must be a finite number"));
  EXPECT_THAT(refused("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 2\n"), HasSubstr("last row"));
  EXPECT_THAT(refused("-1 0 0 0 0 1 0 0 0 0 1 0\n"), HasSubstr("mirrored"));
  EXPECT_THAT(refused("0 0 1e9 0 0 0 1\n"), HasSubstr("tz: must be within 1e8 m"));
  EXPECT_THAT(refused("# none\n"), HasSubstr("has no pose"));
}

TEST(PoseLines, ASkippedPoseWithoutStampKeepsThePlacesOfTheOthers) {
  const TempDir dir;
  write_text(dir / "traj.txt", "0 0 0 0 0 0 1\n0 0 0 0 0 0 0\n2 0 0 0 0 0 1\n");
  const auto loaded = read_pose_lines(dir / "traj.txt", {.skip_bad_lines = true});
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  ASSERT_THAT(loaded->value.poses, SizeIs(2));
  EXPECT_EQ(loaded->value.poses[1].number, 2U);
  EXPECT_THAT(loaded->findings, SizeIs(1));
}

}  // namespace
}  // namespace hypermap
