// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/trajectory_file.hpp"

#include "support/temp_dir.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace hypermap {
namespace {

using test::TempDir;
using test::write_text;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::SizeIs;

Result<Loaded<StampedTrajectory>> read_poses(const std::string& text,
                                             const TrajectoryOptions& options = {}) {
  const TempDir dir;
  write_text(dir / "t.txt", text);
  return read_tum_trajectory(dir / "t.txt", options);
}

std::string trajectory_refusal(const std::string& text) {
  const auto result = read_poses(text);
  return result ? "was accepted" : to_string(result.error());
}

TEST(TrajectoryFile, StampsAreExactToTheNanosecond) {
  const auto loaded = read_poses(
      "1341841278.842700001 0 0 1 0 0 0 1\n"
      "1.341841279842700002e+09 0 0 1 0 0 0 1\n");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(loaded->value.poses[0].stamp.ns, 1341841278842700001);
  EXPECT_EQ(loaded->value.poses[1].stamp.ns, 1341841279842700002);
}

TEST(TrajectoryFile, NanosecondsAreRecognisedByTheirSizeAndNotRounded) {
  const auto loaded = read_poses("1403636579763555584 0 0 1 0 0 0 1\n");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(loaded->value.poses[0].stamp.ns, 1403636579763555584);
  EXPECT_THAT(loaded->findings, SizeIs(0));
  const auto rounded = read_poses("1.4036365797635556e+18 0 0 1 0 0 0 1\n");
  ASSERT_TRUE(rounded);
  EXPECT_THAT(rounded->findings, SizeIs(1));
  EXPECT_THAT(trajectory_refusal("1.0 0 0 1 0 0 0 1\n1403636579763555584 0 0 1 0 0 0 1\n"),
              HasSubstr("unit of the lines before"));
  EXPECT_THAT(trajectory_refusal("1403636579763 0 0 1 0 0 0 1\n"),
              HasSubstr("seconds or nanoseconds"));
}

TEST(TrajectoryFile, TheTenthDecimalRoundsToTheNearestNanosecond) {
  const auto loaded = read_poses("0.0000000014 0 0 1 0 0 0 1\n0.0000000025 0 0 1 0 0 0 1\n");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(loaded->value.poses[0].stamp.ns, 1);
  EXPECT_EQ(loaded->value.poses[1].stamp.ns, 3);
}

TEST(TrajectoryFile, ARotationOfNinetyDegreesAboutZTurnsXIntoY) {
  // q = (0, 0, sin 45, cos 45), written with four digits as in TUM files: norm 0.99999.
  const auto loaded = read_poses("1 1 2 3 0 0 0.7071 0.7071\n");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  const auto point = loaded->value.poses[0].input_from_camera * PointInCamera{{1, 0, 0}};
  EXPECT_NEAR((point.xyz - Eigen::Vector3d(1, 3, 3)).norm(), 0.0, 1e-12);
  EXPECT_EQ(loaded->value.num_normalised, 0U);
}

TEST(TrajectoryFile, AQuaternionAndItsNegativeAreOneRotation) {
  const auto loaded = read_poses("1.0 0 0 1 0 0 0 -1\n");
  ASSERT_TRUE(loaded);
  EXPECT_TRUE(loaded->value.poses[0].input_from_camera.isometry().linear().isIdentity());
}

TEST(TrajectoryFile, APositionBeyondTheEarthIsRefusedByLineAndValue) {
  EXPECT_TRUE(read_poses("1.0 1e8 -1e8 1 0 0 0 1\n"));
  const std::string long_number = "1" + std::string(300, '0');
  for (const std::string& value : {std::string("1e9"), std::string("-1e9"), std::string("1e308")}) {
    for (const std::string& position : {value + " 0 0", "0 " + value + " 0", "0 0 " + value}) {
      const std::string refusal =
          trajectory_refusal("1.0 0 0 1 0 0 0 1\n1.1 " + position + " 0 0 0 1\n");
      EXPECT_THAT(refusal, HasSubstr("t.txt:2: t"));
      EXPECT_THAT(refusal, HasSubstr("within 1e8 m"));
      EXPECT_THAT(refusal, HasSubstr("is " + value));
      EXPECT_LE(refusal.size(), 200U);
    }
  }
  EXPECT_LE(trajectory_refusal("1.0 " + long_number + " 0 1 0 0 0 1\n").size(), 200U);
}

TEST(TrajectoryFile, AFarPositionInASequenceCostsItsLineAlone) {
  const auto loaded = read_poses("1.0 0 0 1 0 0 0 1\n1.1 1e308 0 1 0 0 0 1\n1.2 0 0 1 0 0 0 1\n",
                                 {.skip_bad_lines = true});
  ASSERT_TRUE(loaded);
  EXPECT_THAT(loaded->value.poses, SizeIs(2));
  ASSERT_THAT(loaded->findings, SizeIs(1));
  EXPECT_THAT(to_string(loaded->findings[0].error), HasSubstr("1e308"));
}

TEST(TrajectoryFile, APositionOfAMatrixBeyondTheEarthIsRefusedByLineAndValue) {
  const TempDir dir;
  const std::string rows = "1 0 0 0\n0 1 0 -1e308\n0 0 1 0\n0 0 0 1\n";
  write_text(dir / "pose.txt", rows);
  write_text(dir / "t.log", "0 0 1\n" + rows);
  const auto pose = read_pose_matrix(dir / "pose.txt");
  ASSERT_FALSE(pose);
  EXPECT_THAT(to_string(pose.error()), HasSubstr("pose.txt:2: pose: must be within 1e8 m"));
  EXPECT_THAT(to_string(pose.error()), HasSubstr("is -1e308"));
  const auto log = read_log_trajectory(dir / "t.log");
  ASSERT_FALSE(log);
  EXPECT_THAT(to_string(log.error()), HasSubstr("t.log:3: pose: must be within 1e8 m"));
  EXPECT_LE(to_string(log.error()).size(), 200U);
}

TEST(TrajectoryFile, ACutInsideTheLastNumberIsAFinding) {
  const std::string lines = "1.0 0 0 1 0 0 0.7071 0.7071\n1.1 0 0 1 0 0 0.6018 0.7986\n";
  const auto findings_of = [](const std::string& text) {
    const auto loaded = read_poses(text);
    EXPECT_TRUE(loaded) << to_string(loaded.error());
    return loaded->findings;
  };
  EXPECT_THAT(findings_of(lines), SizeIs(0));
  EXPECT_THAT(findings_of(lines.substr(0, lines.size() - 1)), SizeIs(0)) << "only the line end";
  const auto cut = findings_of(lines.substr(0, lines.size() - 2));
  ASSERT_THAT(cut, SizeIs(1));
  EXPECT_THAT(to_string(cut[0].error), HasSubstr("t.txt:2: line: ends without a line end"));
  EXPECT_THAT(findings_of("1.0 0 0 1 0 0 0 1"), SizeIs(0)) << "nothing to compare it with";
  EXPECT_THAT(findings_of("1.0 0 0 1 0 0 0 1\n1.1 0 0 1 0 0 0 1"), SizeIs(0));
  EXPECT_THAT(findings_of(lines + "# end"), SizeIs(0));
}

TEST(TrajectoryFile, BlanksCommentsAndLineEndsAreFree) {
  const auto loaded = read_poses("# t tx\r\n\r\n 1.0  0\t0 1 0 0 0 1\r\n1.1 0.1 0 1 0 0 0 1");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_THAT(loaded->value.poses, SizeIs(2));
}

TEST(TrajectoryFile, EachBrokenLineIsRefusedWithFieldAndLine) {
  const std::string good = "1.0 0 0 1 0 0 0 1\n";
  EXPECT_THAT(trajectory_refusal(good + "1.2 inf 0 1 0 0 0 1\n"), HasSubstr("t.txt:2: tx"));
  EXPECT_THAT(trajectory_refusal(good + "1.2 0 0 1 nan 0 0 1\n"), HasSubstr("t.txt:2: qx"));
  EXPECT_THAT(trajectory_refusal(good + "nan 0 0 1 0 0 0 1\n"), HasSubstr("t.txt:2: timestamp"));
  EXPECT_THAT(trajectory_refusal(good + "-5 0 0 1 0 0 0 1\n"),
              HasSubstr("timestamp: must be 0 or more"));
  EXPECT_THAT(trajectory_refusal(good + "1,2 0 0 1 0 0 0 1\n"), HasSubstr("timestamp"));
  EXPECT_THAT(trajectory_refusal(good + "1.2 0 0 1 0 0 0 0\n"), HasSubstr("quaternion"));
  EXPECT_THAT(trajectory_refusal(good + "1.2 0 0 1 0 0 0 1.02\n"), HasSubstr("quaternion"));
  EXPECT_THAT(trajectory_refusal(good + "1.2 0 0 1 0 0 0\n"), HasSubstr("has 7"));
  EXPECT_THAT(trajectory_refusal(good + "1.2 0 0 1 0 0 0 1 9\n"), HasSubstr("has 9"));
  EXPECT_THAT(trajectory_refusal(good + std::string("1.2 0 0\0 1 0 0 0 1\n", 19)),
              HasSubstr("t.txt:2"));
  EXPECT_THAT(trajectory_refusal(good + "0.9 0 0 1 0 0 0 1\n"), HasSubstr("must not run back"));
  EXPECT_THAT(trajectory_refusal(good + "1.0 5 5 5 0 0 0 1\n"),
              HasSubstr("another pose in line 1"));
  EXPECT_THAT(trajectory_refusal("# only\n"), HasSubstr("has no pose"));
  EXPECT_THAT(trajectory_refusal(""), HasSubstr("has no pose"));
  EXPECT_THAT(trajectory_refusal(good + std::string(5000, ' ') + "\n"),
              HasSubstr("at most 4096 bytes"));
}

TEST(TrajectoryFile, ARepeatedPoseIsKeptOnce) {
  const auto loaded = read_poses("1.0 0 0 1 0 0 0 1\n1.0 0 0 1 0 0 0 1\n");
  ASSERT_TRUE(loaded);
  EXPECT_THAT(loaded->value.poses, SizeIs(1));
  EXPECT_EQ(loaded->value.num_repeated, 1U);
}

TEST(TrajectoryFile, BadLinesCanBeSkippedAndAreThenNamed) {
  const auto loaded = read_poses("1.0 0 0 1 0 0 0 1\n1.1 x 0 1 0 0 0 1\n1.2 0 0 1 0 0 0 1\n",
                                 {.skip_bad_lines = true});
  ASSERT_TRUE(loaded);
  EXPECT_THAT(loaded->value.poses, SizeIs(2));
  ASSERT_THAT(loaded->findings, SizeIs(1));
  EXPECT_EQ(loaded->findings[0].error.line, 2);
}

TEST(TrajectoryFile, AJumpIsAFindingWithItsLine) {
  // 10 m in 0.1 s is 100 m/s.
  const auto loaded = read_poses("1.0 0 0 1 0 0 0 1\n1.1 10 0 1 0 0 0 1\n");
  ASSERT_TRUE(loaded);
  ASSERT_THAT(loaded->findings, SizeIs(1));
  EXPECT_EQ(loaded->findings[0].error.line, 2);
  EXPECT_THAT(loaded->findings[0].error.what, HasSubstr("jumps 10 m"));
}

TEST(TrajectoryFile, AWrittenLineReadsBackTheSame) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(0.1, -2.0 / 3.0, 1e-9);
  const auto loaded = read_poses(to_tum_line({1341841278842700001}, InputFromCamera(pose)));
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->value.poses[0].stamp.ns, 1341841278842700001);
  EXPECT_EQ(loaded->value.poses[0].input_from_camera.isometry().matrix(), pose.matrix());
}

constexpr const char* kIdentityRows = "1 0 0 0.5\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";

TEST(TrajectoryFile, LogRecordsCarryTheirNumbers) {
  const TempDir dir;
  write_text(dir / "t.log", std::string("0 0 1\n") + kIdentityRows + "5 5 6\n" + kIdentityRows);
  const auto loaded = read_log_trajectory(dir / "t.log");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  ASSERT_THAT(loaded->value.poses, SizeIs(2));
  EXPECT_EQ(loaded->value.poses[1].number, 5U);
  EXPECT_EQ(loaded->value.poses[1].input_from_camera.origin().xyz.x(), 0.5);
}

TEST(TrajectoryFile, ALogThatIsCutOrNumbersARecordTwiceIsRefused) {
  const TempDir dir;
  write_text(dir / "cut.log", "0 0 1\n1 0 0 0\n0 1 0 0\n");
  EXPECT_THAT(to_string(read_log_trajectory(dir / "cut.log").error()), HasSubstr("after 2 rows"));
  write_text(dir / "twice.log", std::string("0 0 1\n") + kIdentityRows + "0 0 1\n" + kIdentityRows);
  EXPECT_THAT(to_string(read_log_trajectory(dir / "twice.log").error()),
              HasSubstr("must occur once, is 0"));
}

TEST(TrajectoryFile, APoseMatrixMustBeARigidMotion) {
  const TempDir dir;
  const auto refused = [&](const std::string& text) {
    write_text(dir / "p.txt", text);
    const auto pose = read_pose_matrix(dir / "p.txt");
    return pose ? std::string("was accepted") : to_string(pose.error());
  };
  EXPECT_EQ(refused(kIdentityRows), "was accepted");
  EXPECT_THAT(refused("2 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"), HasSubstr("must be a rotation"));
  EXPECT_THAT(refused("1 0 0 0\n0 1 0 0\n0 0 -1 0\n0 0 0 1\n"), HasSubstr("mirrored"));
  EXPECT_THAT(refused("1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 2\n"), HasSubstr("last row"));
  EXPECT_THAT(refused("-inf 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"), HasSubstr("p.txt:1"));
  EXPECT_THAT(refused("1 0 0 0\n0 1 0 0\n"), HasSubstr("after 2 rows"));
}

TEST(TrajectoryFile, StampedLinesWithoutStampAreRefusedWithTheFormatThatReadsThem) {
  EXPECT_THAT(trajectory_refusal("0 0 0 0 0 0 1\n"), HasSubstr("has 7: a pose without stamp"));
  EXPECT_THAT(trajectory_refusal("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n"),
              HasSubstr("`trajectory_format: lines`"));
}

TEST(TrajectoryFile, APoseMatrixMayStandInOneLine) {
  const TempDir dir;
  write_text(dir / "p.txt", "1 0 0 4 0 1 0 5 0 0 1 6 0 0 0 1\n");
  const auto pose = read_pose_matrix(dir / "p.txt");
  ASSERT_TRUE(pose) << to_string(pose.error());
  EXPECT_EQ(pose->origin().xyz, Eigen::Vector3d(4.0, 5.0, 6.0));
}

TEST(TrajectoryFile, OptionsOutOfTheirRangeAreNamedBeforeAnyFileIsRead) {
  const auto fields = [](const TrajectoryOptions& options) {
    return std::vector{read_tum_trajectory("absent", options).error().field,
                       read_log_trajectory("absent", options).error().field,
                       read_pose_matrix("absent", options).error().field};
  };
  EXPECT_THAT(fields({.max_speed_m_per_s = -1.0}), Each("max_speed_m_per_s"));
  EXPECT_THAT(fields({.max_rotation_error = std::nan("")}), Each("max_rotation_error"));
  EXPECT_THAT(fields({.max_rotation_error = 1.5}), Each("max_rotation_error"));
}

}  // namespace
}  // namespace hypermap
