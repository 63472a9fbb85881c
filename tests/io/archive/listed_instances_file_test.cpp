// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/listed_instances_file.hpp"

#include "support/temp_dir.hpp"
#include "support/test_data.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>
#include <string>

namespace hypermap {
namespace {

using test::TempDir;
using test::write_text;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kListHead =
    "format: hypermap-sequence-truth\nversion: 1\nsequence: kitchen\nup: [0, -1, 0]\n";
const std::string kListedChair =
    "  - {name: c, class: chair, centre: [1, 2, 3], size: [0.5, 0.6, 0.8], first_frame: 0, "
    "marks: []}\n";

Result<ListedInstances> parsed_list(const std::string& text) {
  return parse_listed_instances(text, {"truth.yaml"});
}

/// Of a list whose only thing has these keys beside its name.
std::string instance_refusal(const std::string& keys) {
  const auto listed = parsed_list(kListHead + "things:\n  - {name: c, " + keys + "}\n");
  return listed ? "" : to_string(listed.error());
}

TEST(ListedInstancesFile, AllKeysAreRead) {
  const auto listed =
      parsed_list(kListHead +
                  "things:\n"
                  "  - name: armchair\n"
                  "    class: [chair, sofa]\n"
                  "    description: red\n"
                  "    centre: [1, -0.5, 2]\n"
                  "    size: [0.7, 0.8, 1.1]\n"
                  "    yaw: 90\n"
                  "    first_frame: 5\n"
                  "    marks: [{frame: 10, pixel: [300, 200]}]\n"
                  "    no_depth: true\n"
                  "    far: true\n"
                  "  - {name: box, unnameable: true, centre: [0, 0, 1], "
                  "size: [1, 1, 1], first_frame: 0, marks: [], never_whole: yes}\n");
  ASSERT_TRUE(listed) << to_string(listed.error());
  EXPECT_EQ(listed->sequence, "kitchen");
  EXPECT_EQ(listed->up_in_input, -Eigen::Vector3d::UnitY());
  ASSERT_EQ(listed->instances.size(), 2U);
  const ListedInstance& chair = listed->instances[0];
  EXPECT_EQ(chair.name, "armchair");
  EXPECT_THAT(chair.class_names, ElementsAre("chair", "sofa"));
  EXPECT_EQ(chair.description, "red");
  EXPECT_EQ(chair.centre.xyz, Eigen::Vector3d(1.0, -0.5, 2.0));
  EXPECT_EQ(chair.size_m, Eigen::Vector3d(0.7, 0.8, 1.1));
  EXPECT_DOUBLE_EQ(chair.yaw_rad, std::numbers::pi / 2.0);
  EXPECT_EQ(chair.first_frame, 5U);
  EXPECT_THAT(chair.marks, ElementsAre(InstanceMark{.frame = 10, .column = 300, .row = 200}));
  EXPECT_TRUE(chair.has_no_depth);
  EXPECT_FALSE(chair.is_never_whole);
  EXPECT_TRUE(chair.is_far);
  EXPECT_THAT(listed->instances[1].class_names, IsEmpty());
  EXPECT_TRUE(listed->instances[1].is_never_whole);
}

TEST(ListedInstancesFile, ErrorsNameFileInstanceFieldRuleAndValue) {
  const std::string rest = ", first_frame: 0, marks: []";
  const std::string size =
      instance_refusal("class: chair, centre: [0, 0, 0], size: [0.5, -0.6, 1]" + rest);
  EXPECT_THAT(size, HasSubstr("truth.yaml"));
  EXPECT_THAT(size, HasSubstr("things[0].size[1]"));
  EXPECT_THAT(size, HasSubstr("0.001"));
  EXPECT_THAT(size, HasSubstr("-0.6"));
  EXPECT_THAT(size, HasSubstr("(of thing c)"));
  for (const std::string bad : {".nan", ".inf", "1e999", "1001", "wide"}) {
    std::string instance = "class: chair, centre: [0, ";
    instance.append(bad).append(", 0], size: [1, 1, 1]").append(rest);
    EXPECT_THAT(instance_refusal(instance), HasSubstr("things[0].centre[1]"));
  }
  EXPECT_THAT(instance_refusal("class: chair, centre: [0, 0], size: [1, 1, 1]" + rest),
              HasSubstr("must have 3 numbers, has 2"));
}

TEST(ListedInstancesFile, UnknownKeysAreErrorsWithTheNearestKnown) {
  EXPECT_THAT(instance_refusal("class: chair, center: [0, 0, 0]"), HasSubstr("\"centre\""));
  const auto root = parsed_list(kListHead + "thing: []\n");
  ASSERT_FALSE(root);
  EXPECT_THAT(to_string(root.error()), HasSubstr("\"things\""));
}

TEST(ListedInstancesFile, AInstanceHasAClassOrNone) {
  const std::string rest = ", centre: [0, 0, 0], size: [1, 1, 1], first_frame: 0, marks: []";
  EXPECT_THAT(instance_refusal("description: red" + rest), HasSubstr("has neither"));
  EXPECT_THAT(instance_refusal("class: chair, unnameable: true" + rest), HasSubstr("together"));
  EXPECT_THAT(instance_refusal("class: []" + rest), HasSubstr("1 class or more"));
  EXPECT_THAT(instance_refusal("class: ''" + rest), HasSubstr("1 to 256 bytes"));
  EXPECT_EQ(instance_refusal("class: chair, unnameable: false" + rest), "");
}

TEST(ListedInstancesFile, MarksArePixelsOfFrames) {
  const std::string head = "class: chair, centre: [0, 0, 0], size: [1, 1, 1], first_frame: 0, ";
  EXPECT_THAT(instance_refusal(head + "marks: [{frame: -1, pixel: [0, 0]}]"),
              HasSubstr("marks[0].frame"));
  EXPECT_THAT(instance_refusal(head + "marks: [{frame: 1, pixel: [0]}]"),
              HasSubstr("[column, row]"));
  EXPECT_THAT(instance_refusal(head + "marks: [{frame: 1, pixel: [0, 70000]}]"),
              HasSubstr("pixel[1]"));
  EXPECT_THAT(instance_refusal(head + "marks: [{frame: 1}]"), HasSubstr("pixel"));
}

TEST(ListedInstancesFile, OtherFormatsAndVersionsAreRefused) {
  const auto version = parsed_list("format: hypermap-sequence-truth\nversion: 2\nnew: key\n");
  ASSERT_FALSE(version);
  EXPECT_EQ(version.error().code, ErrorCode::kUnsupported);
  EXPECT_THAT(to_string(version.error()), HasSubstr("must be 1, is 2"));
  const auto format = parsed_list("format: shopping-list\nversion: 1\n");
  ASSERT_FALSE(format);
  EXPECT_EQ(format.error().code, ErrorCode::kUnsupported);
}

TEST(ListedInstancesFile, UpHasLengthOneAndNamesAreTheirOwn) {
  const auto up = parsed_list(
      "format: hypermap-sequence-truth\nversion: 1\nsequence: a\nup: [0, 0, 0.9]\nthings: []\n");
  ASSERT_FALSE(up);
  EXPECT_THAT(to_string(up.error()), HasSubstr("length 1 within 0.01, has 0.9"));
  const auto twice = parsed_list(kListHead + "things:\n" + kListedChair + kListedChair);
  ASSERT_FALSE(twice);
  EXPECT_THAT(to_string(twice.error()), HasSubstr("two things are named c"));
  EXPECT_TRUE(parsed_list(kListHead + "things:\n" + kListedChair));
}

TEST(ListedInstancesFile, FilesThatAreTooLargeAreRefused) {
  const TempDir folder;
  const auto path = folder.path() / "truth.yaml";
  write_text(path,
             kListHead + "things: []\n# " + std::string(kMaxListedInstancesBytes, 'x') + "\n");
  const auto refused = load_listed_instances(path);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kLimit);
  EXPECT_EQ(refused.error().file, path.string());
}

TEST(ListedInstancesFile, TheListsThatShipAreRead) {
  std::size_t num_files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_path("data/truth"))) {
    if (entry.path().extension() != ".yaml") continue;
    const auto listed = load_listed_instances(entry.path());
    ASSERT_TRUE(listed) << to_string(listed.error());
    EXPECT_FALSE(listed->instances.empty());
    ++num_files;
  }
  EXPECT_EQ(num_files, 3U);
}

}  // namespace
}  // namespace hypermap
