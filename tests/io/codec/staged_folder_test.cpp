// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/staged_folder.hpp"

#include "hypermap/io/codec/atomic_file.hpp"
#include "io/codec/system_faults.hpp"
#include "support/files_below.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {
namespace {

namespace fs = std::filesystem;
using test::files_below;
using test::TempDir;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

std::size_t num_entries(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// Replaces `target` by a folder with one file.
Result<void> replace_folder(const fs::path& target, std::string_view content) {
  HYPERMAP_ASSIGN_OR_RETURN(StagedFolder folder, StagedFolder::create(target));
  HYPERMAP_TRY(folder.make_folder("sub"));
  HYPERMAP_TRY(folder.write("sub/file", content));
  return folder.commit();
}

TEST(StagedFolder, AppearsWholeOrNotAtAll) {
  const TempDir dir;
  {
    const auto folder = StagedFolder::create(dir / "lab");
    ASSERT_TRUE(folder);
    ASSERT_TRUE(folder->write("file", "x"));
    EXPECT_FALSE(fs::exists(dir / "lab"));
  }
  EXPECT_TRUE(fs::is_empty(dir.path()));
  ASSERT_TRUE(replace_folder(dir / "deep" / "lab", "new"));
  EXPECT_THAT(files_below(dir.path()), ElementsAre(Pair("deep/lab/sub/file", "new")));
  EXPECT_EQ(num_entries(dir / "deep"), 1U);
}

TEST(StagedFolder, ALinkIsFollowedAndStays) {
  const TempDir dir;
  ASSERT_TRUE(replace_folder(dir / "disk" / "lab", "old"));
  fs::create_symlink("disk/lab", dir / "lab");
  fs::create_symlink("disk/none", dir / "none");
  ASSERT_TRUE(replace_folder(dir / "lab" / "", "new"));  // with a slash at its end
  ASSERT_TRUE(replace_folder(dir / "none", "first"));
  EXPECT_TRUE(fs::is_symlink(dir / "lab"));
  EXPECT_TRUE(fs::is_symlink(dir / "none"));
  EXPECT_THAT(files_below(dir.path()),
              ElementsAre(Pair("disk/lab/sub/file", "new"), Pair("disk/none/sub/file", "first")));
}

TEST(StagedFolder, IsSyncedWithItsPlaceBeforeTheOldOneGoes) {
  const TempDir dir;
  ASSERT_TRUE(replace_folder(dir / "lab", "old"));
  std::vector<std::string> calls;
  const test::SystemFaults faults([&](std::string_view call, int) {
    if (call != "syncfs" && call != "renameat2" && call != "fsync") return 0;
    calls.emplace_back(call);
    std::vector<std::string> contents;
    for (const auto& [name, content] : files_below(dir.path())) {
      calls.back() += " ";
      calls.back() += name == "lab/sub/file" ? "lab:" + content : content;
    }
    return 0;
  });
  ASSERT_TRUE(replace_folder(dir / "lab", "new"));
  EXPECT_THAT(calls,
              ElementsAre("syncfs new lab:old", "renameat2 new lab:old", "fsync old lab:new"));
  EXPECT_THAT(files_below(dir.path()), ElementsAre(Pair("lab/sub/file", "new")));
}

TEST(StagedFolder, WhicheverCallFailsTheOldOneStaysOrTheMessageSaysReplaced) {
  for (int failing_call = 1;; ++failing_call) {
    const TempDir dir;
    ASSERT_TRUE(replace_folder(dir / "lab", "old"));
    int num_calls = 0;
    Result<void> replaced;
    {
      const test::SystemFaults faults(
          [&](std::string_view, int) { return ++num_calls == failing_call ? EIO : 0; });
      replaced = replace_folder(dir / "lab", "new");
    }
    if (num_calls < failing_call) break;  // more than there are
    const auto files = files_below(dir / "lab");
    const bool is_new = replaced || replaced.error().what.starts_with("replaced, ");
    EXPECT_THAT(files, ElementsAre(Pair("sub/file", is_new ? "new" : "old"))) << failing_call;
    if (!replaced) {
      EXPECT_THAT(to_string(replaced.error()), HasSubstr("errno 5"));
    }
    if (!is_new) {
      EXPECT_EQ(num_entries(dir.path()), 1U) << failing_call;
    }
    ASSERT_TRUE(write_file_atomically(dir / "a", "x"));
    EXPECT_EQ(num_entries(dir.path()), 2U) << "what was left goes with the next save";
  }
}

TEST(StagedFolder, WhereFoldersCannotBeExchangedTheyAreRenamed) {
  const TempDir dir;
  const auto no_exchange = [](std::string_view call, int) {
    return call == "renameat2" ? EINVAL : 0;
  };
  const test::SystemFaults faults(no_exchange);
  ASSERT_TRUE(replace_folder(dir / "lab", "old"));
  ASSERT_TRUE(replace_folder(dir / "lab", "new"));
  EXPECT_THAT(files_below(dir.path()), ElementsAre(Pair("lab/sub/file", "new")));
  EXPECT_EQ(num_entries(dir.path()), 1U);
}

}  // namespace
}  // namespace hypermap
