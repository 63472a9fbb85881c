// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/options/relation_rules_file.hpp"

#include "hypermap/core/base/option_table.hpp"
#include "support/temp_dir.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class RelationRulesFile : public testing::Test {
 protected:
  Result<RelationOptions> read(const std::string& text) {
    std::ofstream(dir_ / "rules.yaml") << text;
    return read_relation_options(dir_ / "rules.yaml");
  }

  test::TempDir dir_;
};

TEST_F(RelationRulesFile, SaysWhatIsNotTheDefault) {
  const auto options = read("gap_voxels: 2\nholders: [drawer, bowl]\nvoxel_m: 0.02\n");
  ASSERT_TRUE(options) << to_string(options.error());
  EXPECT_EQ(options->gap_voxels, 2.0);
  EXPECT_EQ(options->voxel_m, 0.02);
  EXPECT_THAT(options->holders, ElementsAre("drawer", "bowl"));
  EXPECT_EQ(options->parts, RelationOptions().parts);
}

TEST_F(RelationRulesFile, TheShippedFileHasEveryRuleWithItsDefault) {
  const auto path = test::source_path("data/relations.yaml");
  const auto options = read_relation_options(path);
  ASSERT_TRUE(options) << to_string(options.error());
  EXPECT_EQ(*options, RelationOptions());
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  RelationOptions named;
  for (const BoundOption& rule : bind_options(option_table(named), &named)) {
    EXPECT_THAT("\n" + text.str(), HasSubstr("\n" + rule.name + ":"));
  }
}

TEST_F(RelationRulesFile, WhatIsWrongIsNamed) {
  const auto unknown = read("gap_voxels: 1\nholder: [bowl]\n");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(unknown.error().line, 2);
  EXPECT_THAT(unknown.error().what, HasSubstr("did you mean \"holders\""));
  EXPECT_EQ(read("max_beside: 65\n").error().code, ErrorCode::kMalformedFile);
  EXPECT_EQ(read("parts: [door]\n").error().field, "parts");
  EXPECT_FALSE(read("- 1\n"));
  EXPECT_EQ(read_relation_options(dir_ / "absent.yaml").error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace hypermap
