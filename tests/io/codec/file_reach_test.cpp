// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/file_reach.hpp"

#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace hypermap {
namespace {

namespace fs = std::filesystem;
using test::TempDir;
using testing::HasSubstr;

/// maps/ with a file, a folder, links; secret beside it.
class OwnFolder : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder / "sub");
    for (const fs::path& file : {folder / "grid.yaml", folder / "sub" / "a.png", dir / "secret"})
      std::ofstream(file) << "x";
    fs::create_symlink("../secret", folder / "leads_out");
    fs::create_symlink("sub/a.png", folder / "stays_in");
    fs::create_directory_symlink("..", folder / "sub" / "up");
  }
  [[nodiscard]] bool is_within(const fs::path& name) const {
    return check_reach(FileReach::kOwnFolder, folder, name).has_value();
  }

  TempDir dir;
  fs::path folder = dir / "maps";
};

TEST_F(OwnFolder, FilesInItAndBelowMayBeNamed) {
  for (const char* name : {"grid.yaml",
                           "sub/a.png",
                           "sub/../grid.yaml",
                           "stays_in",
                           "not_there",
                           "sub/up/grid.yaml",
                           "sub/none/../a.png"}) {
    EXPECT_TRUE(is_within(name)) << name;
  }
  EXPECT_TRUE(is_within(fs::absolute(folder / "grid.yaml")));
}

TEST_F(OwnFolder, WhatLiesElsewhereMayNot) {
  for (const char* name : {"../secret",
                           "leads_out",
                           "sub/up/../secret",
                           "/etc/passwd",
                           "..",
                           "../maps_of_another/grid.yaml",
                           "not_there/../../secret"}) {
    EXPECT_FALSE(is_within(name)) << name;
  }
  const auto refused = check_reach(FileReach::kOwnFolder, folder, "../secret");
  EXPECT_EQ(refused.error().code, ErrorCode::kMalformedFile);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("../secret lies outside"));
}

TEST_F(OwnFolder, AFolderThatIsItselfALinkIsWhereItLeads) {
  fs::create_directory_symlink("maps", dir / "link");
  EXPECT_TRUE(check_reach(FileReach::kOwnFolder, dir / "link", "grid.yaml"));
  EXPECT_FALSE(check_reach(FileReach::kOwnFolder, dir / "link", "../secret"));
}

TEST_F(OwnFolder, ALinkThatLeadsToItselfIsTheSystemsError) {
  fs::create_symlink("circle", folder / "circle");
  const auto refused = check_reach(FileReach::kOwnFolder, folder, "circle");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kIo);
}

TEST_F(OwnFolder, WithoutThatRuleAnyFileMayBeNamed) {
  for (const char* name : {"../secret", "leads_out", "/etc/passwd", "grid.yaml"})
    EXPECT_TRUE(check_reach(FileReach::kAnywhere, folder, name)) << name;
}

}  // namespace
}  // namespace hypermap
