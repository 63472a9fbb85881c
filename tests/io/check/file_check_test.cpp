// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/check/file_check.hpp"

#include "support/hostile_index.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace hypermap {
namespace {

using test::TempDir;
using test::write_text;
using ::testing::HasSubstr;
using ::testing::SizeIs;

std::string first_finding(const FileCheckResult& result) {
  return result.findings.empty() ? "nothing found" : to_string(result.findings[0].error);
}

TEST(FileCheck, KindsAreFoundByContent) {
  const TempDir dir;
  const auto kind_of = [&](const std::string& name, const std::string& text) {
    write_text(dir / name, text);
    const auto kind = find_file_kind(dir / name);
    return kind ? std::string(name_of(*kind)) : to_string(kind.error());
  };
  EXPECT_EQ(kind_of("a", "PK\x03\x04"), "archive");
  EXPECT_EQ(kind_of("a.hmap", "garbage"), "archive");
  EXPECT_EQ(kind_of("a", "# Octomap OcTree file\n"), "octree");
  EXPECT_EQ(kind_of("a", test::pgm8(1)), "image");
  EXPECT_EQ(kind_of("a", test::pgm16(1)), "depth");
  EXPECT_EQ(kind_of("a", "# comment\n1.0 0 0 1 0 0 0 1\n"), "trajectory");
  EXPECT_EQ(kind_of("a", "1.0 0 0 1 0 0 0\n"), "trajectory");
  EXPECT_EQ(kind_of("a", "1,2 0 0 1 0 0 0 1\n"), "trajectory");
  EXPECT_EQ(kind_of("a", "0 0 1\n" + test::pose_rows(1)), "trajectory");
  EXPECT_EQ(kind_of("a", test::pose_rows(1)), "trajectory");
  EXPECT_EQ(kind_of("a", "585 0 320\n0 585 240\n0 0 1\n"), "intrinsics");
  EXPECT_EQ(kind_of("a", "585 0 320 0\n0 585 240 0\n0 0 1 0\n0 0 0 1\n"), "intrinsics");
  EXPECT_EQ(kind_of("a", test::intrinsics_json(5000)), "intrinsics");
  EXPECT_EQ(kind_of("a", test::chair_in("a.png")), "detections");
  EXPECT_EQ(kind_of("a", "[]"), "detections");
  EXPECT_EQ(kind_of("a", "layers:\n  - {}\n"), "config");
  EXPECT_EQ(kind_of("a", "image: a.png\nresolution: 1\n"), "map");
  EXPECT_EQ(kind_of("a", "- name: sink\n  shape: POLYGON\n"), "semantic");
  EXPECT_EQ(kind_of("a", "name: x\ndepth: d/*.png\n"), "dataset");
  EXPECT_EQ(kind_of("a", "# list\nformat: hypermap-sequence-truth\nversion: 9\n"), "truth");
  EXPECT_EQ(kind_of("empty.txt", ""), "trajectory");
  EXPECT_THAT(kind_of("empty", ""), HasSubstr("is of no kind"));
  EXPECT_EQ(*find_file_kind(dir.path()), FileKind::kDataset);
  EXPECT_THAT(to_string(find_file_kind(dir / "absent").error()), HasSubstr("does not exist"));
  EXPECT_THAT(to_string(file_kind("picture").error()), HasSubstr("must be one of archive, octree"));
}

TEST(FileCheck, ExitCodesFollowTheWorstFinding) {
  const TempDir dir;
  write_text(dir / "good.json", test::intrinsics_json(5000));
  EXPECT_EQ(check_file(dir / "good.json").exit_code(), 0);
  std::string extra = test::intrinsics_json(5000);
  extra.insert(1, "\"fz\": 1, ");
  write_text(dir / "extra.json", extra);
  const FileCheckResult result = check_file(dir / "extra.json");
  EXPECT_EQ(result.exit_code(), 1);
  EXPECT_THAT(first_finding(result), HasSubstr("extra.json:1: $.fz: unknown key, did you mean"));
  EXPECT_EQ(check_file(dir / "extra.json", {.strict = true}).exit_code(), 2);
  EXPECT_EQ(check_file(dir / "absent.json").exit_code(), 3);
  write_text(dir / "bad.json", "{\"width\": 640}");
  EXPECT_EQ(check_file(dir / "bad.json", {.as = FileKind::kIntrinsics}).exit_code(), 2);
}

TEST(FileCheck, ADatasetIsReadFrameByFrame) {
  const TempDir dir;
  const test::SyntheticDataset data = test::write_tum(dir / "t");
  const FileCheckResult good = check_file(data.folder);
  EXPECT_EQ(good.exit_code(), 0) << first_finding(good);
  EXPECT_EQ(good.summary, "tum, 4 frames, 1 detection");
  write_text(data.folder / data.depth_of_1, "cut");
  EXPECT_EQ(check_file(data.folder).exit_code(), 2);
}

TEST(FileCheck, AListOfThingsAndPosesWithoutStampsAreReadByTheirReaders) {
  const TempDir dir;
  EXPECT_EQ(check_file(test::source_path("data/truth/cabinet.yaml")).summary,
            "1 thing of tum_fr3_cabinet");
  write_text(dir / "truth.yaml", "format: hypermap-sequence-truth\nversion: 9\n");
  const FileCheckResult refused = check_file(dir / "truth.yaml");
  EXPECT_EQ(refused.exit_code(), 2);
  EXPECT_THAT(first_finding(refused), HasSubstr("version: must be 1, is 9"));
  write_text(dir / "traj.txt",
             "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n1 0 0 2 0 1 0 0 0 0 1 0 0 0 0 1\n");
  EXPECT_EQ(check_file(dir / "traj.txt").summary, "2 poses");
}

TEST(FileCheck, FilesThatAConfigurationNamesAndThatAreAbsentAreFindings) {
  const TempDir dir;
  write_text(dir / "c.yaml",
             "layers:\n"
             "  - {class: OccupancyGridLayer, name: occ, frame_id: map, load_file: true}\n"
             "  - {class: SemanticLayer, name: sem, frame_id: map, load_file: true, file: s}\n");
  write_text(dir / "occ.yaml", "");
  const FileCheckResult result = check_file(dir / "c.yaml");
  EXPECT_EQ(result.exit_code(), 1) << first_finding(result);
  ASSERT_THAT(result.findings, SizeIs(1));
  EXPECT_THAT(first_finding(result), HasSubstr("layers[1].file"));
}

TEST(FileCheck, AFileOfOptionsIsJudgedByItsNamesAndRanges) {
  const TempDir dir;
  EXPECT_EQ(check_file(test::source_path("data/options/smap.yaml")).summary, "options");
  write_text(dir / "o.yaml", "octree: {resolution_m: 0}\n");
  EXPECT_EQ(check_file(dir / "o.yaml").exit_code(), 2);
}

TEST(FileCheck, HostileConfigurationsAreRefused) {
  HYPERMAP_REQUIRE_SHARED_DATA("hostile/INDEX.md");
  for (const char* name : {"err_alias_bomb",
                           "err_deep_flow_450_closed",
                           "err_deep_block_600",
                           "err_layers_missing",
                           "err_layer_name_empty_or_slash",
                           "err_3000_layers"}) {
    const auto path = test::shared_data(std::string("hostile/yaml/") + name + ".yaml");
    EXPECT_EQ(check_file(path, {.as = FileKind::kConfig}).exit_code(), 2) << name;
  }
  // Its layers' files are absent there.
  EXPECT_EQ(check_file(test::shared_data("hostile/yaml/ok_config.yaml")).exit_code(), 1);
}

// --- hostile files by others: each gives what the index says ---

class HostileFiles : public ::testing::TestWithParam<FileKind> {};

TEST_P(HostileFiles, AreJudgedAsTheIndexSays) {
  HYPERMAP_REQUIRE_SHARED_DATA("hostile/INDEX.md");
  const std::string kind(name_of(GetParam()));
  const auto files = test::hostile_files(GetParam() == FileKind::kSemantic ? "wkt" : kind);
  ASSERT_THAT(files, ::testing::Not(::testing::IsEmpty()));
  for (const test::HostileFile& file : files) {
    FileCheckOptions options{.as = GetParam()};
    if (GetParam() == FileKind::kDepth) options.size = {32, 24};
    const FileCheckResult result = check_file(file.path, options);
    const std::string said = file.path.filename().string() + ": " + first_finding(result);
    if (file.may_be_repaired) {
      EXPECT_EQ(result.exit_code(), 1) << said;
    } else if (file.must_load) {
      EXPECT_LE(result.exit_code(), 1) << said;
    } else {
      EXPECT_EQ(result.exit_code(), 2) << said;
      EXPECT_THAT(said, HasSubstr(file.path.string()));
      ASSERT_FALSE(result.findings.empty());
      EXPECT_FALSE(result.findings[0].error.what.empty()) << said;
    }
    // By content alone, 16 bits of grey are depth, and 8 bits are none.
    if (GetParam() != FileKind::kDepth && GetParam() != FileKind::kImage) {
      EXPECT_EQ(find_file_kind(file.path).value(), GetParam()) << said;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Trajectory, HostileFiles, ::testing::Values(FileKind::kTrajectory));
INSTANTIATE_TEST_SUITE_P(Intrinsics, HostileFiles, ::testing::Values(FileKind::kIntrinsics));
INSTANTIATE_TEST_SUITE_P(Detections, HostileFiles, ::testing::Values(FileKind::kDetections));
INSTANTIATE_TEST_SUITE_P(Depth, HostileFiles, ::testing::Values(FileKind::kDepth));
INSTANTIATE_TEST_SUITE_P(Image, HostileFiles, ::testing::Values(FileKind::kImage));
INSTANTIATE_TEST_SUITE_P(Octree, HostileFiles, ::testing::Values(FileKind::kOctree));

INSTANTIATE_TEST_SUITE_P(Semantic, HostileFiles, ::testing::Values(FileKind::kSemantic));

TEST(FileCheck, HostileMapDescriptionsAreRefused) {
  HYPERMAP_REQUIRE_SHARED_DATA("hostile/INDEX.md");
  for (const test::HostileFile& file : test::hostile_files("yaml")) {
    const auto kind = find_file_kind(file.path);
    ASSERT_TRUE(kind) << to_string(kind.error());
    const FileCheckResult result = check_file(file.path);
    const std::string said = file.path.filename().string() + ": " + first_finding(result);
    // What the good ones name lies elsewhere, which is a finding.
    EXPECT_EQ(result.exit_code(), file.must_load ? 1 : 2) << said;
  }
}

TEST(FileCheck, CountsOfTheIndexComeOut) {
  HYPERMAP_REQUIRE_SHARED_DATA("hostile/INDEX.md");
  const auto summary = [](const std::string& file) {
    return check_file(test::shared_data("hostile/" + file)).summary;
  };
  EXPECT_EQ(summary("trajectory/ok_two.txt"), "2 poses");
  EXPECT_EQ(summary("trajectory/ok_crlf_tabs_double_spaces.txt"), "2 poses");
  EXPECT_EQ(summary("trajectory/ok_integers_ns.txt"), "1 pose");
  EXPECT_EQ(summary("detections/ok_one.json"), "1 detection in 1 frame");
  EXPECT_EQ(summary("detections/ok_none.json"), "0 detections in 1 frame");
  EXPECT_EQ(summary("depth/ok_plane_1m.png"), "32 x 24, 768 measured pixels");
  EXPECT_EQ(summary("depth/ok_one_pixel.png"), "32 x 24, 1 measured pixel");
}

}  // namespace
}  // namespace hypermap
