// SPDX-License-Identifier: BSD-3-Clause
// Long because: each call to the system fails once, and what is then on the disk is told.
#include "hypermap/io/codec/atomic_file.hpp"

#include "hypermap/io/codec/byte_source.hpp"
#include "io/codec/system_faults.hpp"
#include "support/temp_dir.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace hypermap {
namespace {

namespace fs = std::filesystem;
using test::TempDir;
using testing::HasSubstr;

std::string content_of(const fs::path& path) {
  const auto bytes = read_file(path, 1 << 20);
  return bytes ? *bytes : "cannot be read";
}

std::size_t num_files(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

mode_t mode_of(const fs::path& path) {
  struct stat status {};
  ::stat(path.c_str(), &status);
  return status.st_mode & 07777U;
}

/// Saves while the n-th of all calls fails with `reason`; `num_calls` is how many there were.
struct FailingSave {
  FailingSave(const fs::path& path, std::string_view bytes, int failing_call, int reason) {
    const test::SystemFaults faults(
        [&](std::string_view, int) { return ++num_calls == failing_call ? reason : 0; });
    written = write_file_atomically(path, bytes);
  }
  int num_calls = 0;
  Result<void> written;
};

bool is_folder(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && S_ISDIR(status.st_mode);
}

/// A process that has ended.
pid_t dead_process() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  int status = 0;
  ::waitpid(child, &status, 0);
  return child;
}

TEST(AtomicFile, WritesANewFileAndLeavesNothingElse) {
  const TempDir dir;
  ASSERT_TRUE(write_file_atomically(dir / "a", "new"));
  EXPECT_EQ(content_of(dir / "a"), "new");
  EXPECT_EQ(num_files(dir.path()), 1U);
}

TEST(AtomicFile, ANewFileHasTheModeOfTheUmask) {
  const TempDir dir;
  const mode_t before = ::umask(027);
  ASSERT_TRUE(write_file_atomically(dir / "a", "x"));
  ::umask(before);
  EXPECT_EQ(mode_of(dir / "a"), 0640U);
}

TEST(AtomicFile, KeepsTheModeOfTheFileThatItReplaces) {
  const TempDir dir;
  ASSERT_TRUE(write_file_atomically(dir / "a", "old"));
  fs::permissions(dir / "a",
                  fs::perms::owner_read | fs::perms::owner_write | fs::perms::others_read);
  ASSERT_TRUE(write_file_atomically(dir / "a", "new"));
  EXPECT_EQ(mode_of(dir / "a"), 0604U);
  EXPECT_EQ(content_of(dir / "a"), "new");
}

TEST(AtomicFile, WhicheverCallFailsTheOldFileIsIntactAndNoTemporaryIsLeft) {
  constexpr int kReasons[] = {ENOSPC, EIO, EDQUOT, EROFS, EFBIG};
  for (const int reason : kReasons) {
    for (int failing_call = 1;; ++failing_call) {
      const TempDir dir;
      ASSERT_TRUE(write_file_atomically(dir / "a", "old"));
      const FailingSave save(dir / "a", "new content", failing_call, reason);
      const auto& written = save.written;
      if (save.num_calls < failing_call) break;  // more than there are
      EXPECT_EQ(num_files(dir.path()), 1U) << failing_call;
      if (written) continue;  // a close of a folder does not matter
      EXPECT_EQ(written.error().code, ErrorCode::kIo);
      EXPECT_THAT(written.error().file, HasSubstr(dir.path().string()));
      EXPECT_THAT(written.error().what, HasSubstr("errno " + std::to_string(reason)));
      const bool replaced = written.error().what.starts_with("replaced, durability unconfirmed");
      EXPECT_EQ(content_of(dir / "a"), replaced ? "new content" : "old") << failing_call;
    }
  }
}

TEST(AtomicFile, OnlyTheSyncOfTheFolderFailsAfterTheReplacement) {
  const TempDir dir;
  const test::SystemFaults faults([](std::string_view call, int descriptor) {
    return call == "fsync" && is_folder(descriptor) ? EIO : 0;
  });
  const auto written = write_file_atomically(dir / "a", "new");
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().what, HasSubstr("replaced, durability unconfirmed"));
  EXPECT_EQ(content_of(dir / "a"), "new");
}

TEST(AtomicFile, InterruptedCallsAreRepeated) {
  const TempDir dir;
  const std::set<std::string_view> repeated{"open", "write"};
  std::set<std::string_view> interrupted;
  const test::SystemFaults faults([&](std::string_view call, int) {
    return repeated.contains(call) && interrupted.insert(call).second ? EINTR : 0;
  });
  ASSERT_TRUE(write_file_atomically(dir / "a", "new content"));
  EXPECT_EQ(interrupted, repeated);
  EXPECT_EQ(content_of(dir / "a"), "new content");
}

TEST(AtomicFile, FollowsALinkAndKeepsIt) {
  const TempDir dir;
  fs::create_directory(dir / "maps");
  ASSERT_TRUE(write_file_atomically(dir / "maps" / "real", "old"));
  fs::create_symlink("maps/real", dir / "link");
  ASSERT_TRUE(write_file_atomically(dir / "link", "new"));
  EXPECT_TRUE(fs::is_symlink(dir / "link"));
  EXPECT_EQ(content_of(dir / "maps" / "real"), "new");
}

TEST(AtomicFile, FollowsALinkToAFileThatIsNotThereYet) {
  const TempDir dir;
  fs::create_symlink("real", dir / "link");
  ASSERT_TRUE(write_file_atomically(dir / "link", "new"));
  EXPECT_TRUE(fs::is_symlink(dir / "link"));
  EXPECT_EQ(content_of(dir / "real"), "new");
}

TEST(AtomicFile, ALinkToItselfIsAnError) {
  const TempDir dir;
  fs::create_symlink("link", dir / "link");
  const auto written = write_file_atomically(dir / "link", "new");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kIo);
}

TEST(AtomicFile, ADeviceAFolderAndAFifoAreNotReplaced) {
  const TempDir dir;
  fs::create_directory(dir / "folder");
  ASSERT_EQ(::mkfifo((dir / "fifo").c_str(), 0600), 0);
  fs::create_symlink("/dev/full", dir / "full");
  for (const fs::path& path : {fs::path("/dev/full"), dir / "folder", dir / "fifo", dir / "full"}) {
    const auto written = write_file_atomically(path, "new");
    ASSERT_FALSE(written) << path;
    EXPECT_EQ(written.error().code, ErrorCode::kIo);
    EXPECT_EQ(written.error().file, path.string());
  }
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(AtomicFile, ATargetIsJudgedBeforeTheWork) {
  const TempDir dir;
  fs::create_directory(dir / "folder");
  ASSERT_TRUE(write_file_atomically(dir / "old", "old"));
  EXPECT_TRUE(check_target(dir / "new"));
  EXPECT_TRUE(check_target(dir / "old"));
  EXPECT_TRUE(check_target("new"));
  for (const fs::path& path : {dir / "folder",
                               dir / "no" / "a",
                               dir / "old" / "a",
                               fs::path("/dev/null"),
                               fs::path("/proc/a"),
                               dir / std::string(300, 'a')}) {
    const auto judged = check_target(path);
    ASSERT_FALSE(judged) << path;
    EXPECT_EQ(judged.error().code, ErrorCode::kIo);
    EXPECT_EQ(judged.error().file, path.string());
  }
}

TEST(AtomicFile, ATargetOnAFullDiskIsToldBeforeTheWork) {
  const TempDir dir;
  ASSERT_TRUE(write_file_atomically(dir / "old", "old"));
  const auto check_on_a_full_disk = [&] {
    const test::SystemFaults full(
        [](std::string_view call, int) { return call == "write" ? ENOSPC : 0; });
    return check_target(dir / "old");
  };
  const auto judged = check_on_a_full_disk();
  ASSERT_FALSE(judged);
  EXPECT_THAT(to_string(judged.error()), HasSubstr("errno 28"));
  EXPECT_TRUE(check_target(dir / "old"));
  EXPECT_EQ(content_of(dir / "old"), "old");
  EXPECT_EQ(num_files(dir.path()), 1U) << "what was made to find out is gone";
}

TEST(AtomicFile, AFolderThatIsNotThereOrReadOnlyIsNamedWithErrno) {
  const TempDir dir;
  const auto missing = write_file_atomically(dir / "no" / "a", "new");
  ASSERT_FALSE(missing);
  EXPECT_THAT(to_string(missing.error()), HasSubstr("errno 2"));
  if (::geteuid() == 0) GTEST_SKIP() << "root may write to read-only folders";
  fs::permissions(dir.path(), fs::perms::owner_read | fs::perms::owner_exec);
  const auto refused = write_file_atomically(dir / "a", "new");
  fs::permissions(dir.path(), fs::perms::owner_all);
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("errno 13"));
}

TEST(AtomicFile, ALimitOnFileSizesIsAnErrorAndNoSignal) {
  const TempDir dir;
  ASSERT_TRUE(write_file_atomically(dir / "a", "old"));
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const rlimit limit{.rlim_cur = 100, .rlim_max = 100};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const auto written = write_file_atomically(dir / "a", std::string(1000, 'x'));
    const bool said = !written && written.error().what.find("errno 27") != std::string::npos;
    ::_exit(said ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status)) << "ended by signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(content_of(dir / "a"), "old");
  EXPECT_EQ(num_files(dir.path()), 1U);
}

TEST(AtomicFile, WhatNobodyHoldsALockOnGoesWhateverProcessItsNameTells) {
  const TempDir dir;
  const std::string prefix = ".hypermap-save-";
  const fs::path dead = dir / (prefix + std::to_string(dead_process()) + "-0.tmp");
  const fs::path same_number = dir / (prefix + std::to_string(::getpid()) + "-0.tmp");
  const fs::path locked = dir / (prefix + std::to_string(dead_process()) + "-1.tmp");
  const fs::path foreign = dir / (prefix + "notes.txt");
  for (const auto& path : {dead, same_number, locked, foreign}) std::ofstream(path) << "x";
  fs::create_directory(dir / (prefix + "aB3dE6"));
  std::ofstream(dir / (prefix + "aB3dE6") / "new") << "x";
  const int lock = ::open(locked.c_str(), O_RDONLY);
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);
  ASSERT_TRUE(write_file_atomically(dir / "a", "new"));
  ::close(lock);
  EXPECT_THAT(
      names_in(dir.path()),
      testing::UnorderedElementsAre("a", locked.filename().string(), foreign.filename().string()));
}

TEST(AtomicFile, AThousandTemporariesOfTheSameProcessNumberHinderNoSave) {
  const TempDir dir;
  for (int n = 0; n < 1000; ++n)
    std::ofstream(
        dir / (".hypermap-save-" + std::to_string(::getpid()) + "-" + std::to_string(n) + ".tmp"))
        << "x";
  ASSERT_TRUE(write_file_atomically(dir / "a", "new"));
  EXPECT_THAT(names_in(dir.path()), testing::ElementsAre("a"));
}

TEST(AtomicFile, WhatALivingSaverWritesStaysUntilItsRename) {
  const TempDir dir;
  for (const std::string_view moment : {"write", "fsync", "close", "rename"}) {
    bool is_other_saved = false;
    const test::SystemFaults faults([&](std::string_view call, int) {
      if (call != moment || is_other_saved) return 0;
      std::thread([&] {
        is_other_saved = write_file_atomically(dir / "b", "other").has_value();
      }).join();
      return 0;
    });
    ASSERT_TRUE(write_file_atomically(dir / "a", moment)) << moment;
    EXPECT_TRUE(is_other_saved);
    EXPECT_EQ(content_of(dir / "a"), moment);
    EXPECT_THAT(names_in(dir.path()), testing::UnorderedElementsAre("a", "b"));
  }
}

TEST(AtomicFile, AProcessKilledAtAnyCallLeavesTheOldOrTheNewFile) {
  for (int killing_call = 1;; ++killing_call) {
    const TempDir dir;
    ASSERT_TRUE(write_file_atomically(dir / "a", "old"));
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      int num_calls = 0;
      const test::SystemFaults faults([&](std::string_view, int) {
        return ++num_calls == killing_call ? ::kill(::getpid(), SIGKILL) : 0;
      });
      static_cast<void>(write_file_atomically(dir / "a", "new"));
      ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_THAT(content_of(dir / "a"), testing::AnyOf("old", "new")) << killing_call;
    ASSERT_TRUE(write_file_atomically(dir / "a", "newer"));
    EXPECT_THAT(names_in(dir.path()), testing::ElementsAre("a")) << killing_call;
    if (!WIFSIGNALED(status)) {  // more than there are
      EXPECT_GT(killing_call, 8);
      break;
    }
  }
}

TEST(AtomicFile, OfManySaversOneWinsWhole) {
  const TempDir dir;
  std::vector<std::thread> savers;
  for (char c = 'a'; c < 'i'; ++c)
    savers.emplace_back([&dir, c] {
      for (int i = 0; i < 5; ++i)
        EXPECT_TRUE(write_file_atomically(dir / "map", std::string(50000, c)));
    });
  for (std::thread& saver : savers) saver.join();
  const std::string content = content_of(dir / "map");
  EXPECT_EQ(content, std::string(50000, content.at(0)));
  EXPECT_EQ(num_files(dir.path()), 1U);
}

}  // namespace
}  // namespace hypermap
