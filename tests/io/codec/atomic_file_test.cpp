// SPDX-License-Identifier: BSD-3-Clause
// Long because: each call to the system fails once, and what is then on the disk is told.
#include "hypermap/io/codec/atomic_file.hpp"

#include "files/file_calls.hpp"
#include "hypermap/io/codec/byte_source.hpp"
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
#include <functional>
#include <string>
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

mode_t mode_of(const fs::path& path) {
  struct stat status {};
  ::stat(path.c_str(), &status);
  return status.st_mode & 07777U;
}

/// Lets the n-th of all calls fail with `reason`; counts them.
class FailingCalls {
 public:
  FailingCalls(int failing_call, int reason) : failing_call_(failing_call), reason_(reason) {}
  FileCalls calls() {
    const FileCalls real;
    return {.open = failing(real.open),
            .write = [this](int descriptor, const void* bytes, std::size_t num_bytes) -> ssize_t {
              // Short writes, so that there are several of them.
              return fails() ? -1 : ::write(descriptor, bytes, std::min<std::size_t>(num_bytes, 3));
            },
            .fchmod = failing(real.fchmod),
            .fchown = failing(real.fchown),
            .fsync = failing(real.fsync),
            .close =
                [this](int descriptor) {
                  const int result = ::close(descriptor);
                  return fails() ? -1 : result;
                },
            .rename = failing(real.rename)};
  }
  [[nodiscard]] int num_calls() const { return num_calls_; }

 private:
  template <class... Arguments>
  std::function<int(Arguments...)> failing(std::function<int(Arguments...)> call) {
    return [this, call](Arguments... arguments) { return fails() ? -1 : call(arguments...); };
  }
  bool fails() {
    if (++num_calls_ != failing_call_) return false;
    errno = reason_;
    return true;
  }
  int failing_call_;
  int reason_;
  int num_calls_ = 0;
};

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
      FailingCalls calls(failing_call, reason);
      const auto written = write_file_atomically(dir / "a", "new content", calls.calls());
      if (calls.num_calls() < failing_call) break;  // more than there are
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
  const FileCalls calls{.fsync = [](int descriptor) {
    struct stat status {};
    ::fstat(descriptor, &status);
    if (!S_ISDIR(status.st_mode)) return ::fsync(descriptor);
    errno = EIO;
    return -1;
  }};
  const auto written = write_file_atomically(dir / "a", "new", calls);
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().what, HasSubstr("replaced, durability unconfirmed"));
  EXPECT_EQ(content_of(dir / "a"), "new");
}

TEST(AtomicFile, InterruptedCallsAreRepeated) {
  const TempDir dir;
  for (int call = 1; call <= 4; ++call) {  // the opening and the first writes
    FailingCalls calls(call, EINTR);
    ASSERT_TRUE(write_file_atomically(dir / "a", "new content", calls.calls())) << call;
    EXPECT_EQ(content_of(dir / "a"), "new content");
  }
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
  const FileCalls full{.write = [](int, const void*, std::size_t) -> ssize_t {
    errno = ENOSPC;
    return -1;
  }};
  const auto judged = check_target(dir / "old", full);
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

TEST(AtomicFile, TemporariesOfDeadProcessesGoThoseOfLivingOnesStay) {
  const TempDir dir;
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) ::_exit(0);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  const fs::path dead = dir / (".hypermap-save-" + std::to_string(child) + "-0.tmp");
  const fs::path dead_yet_locked = dir / (".hypermap-save-" + std::to_string(child) + "-1.tmp");
  const fs::path alive = dir / (".hypermap-save-" + std::to_string(::getppid()) + "-0.tmp");
  const fs::path foreign = dir / ".hypermap-save-notes.txt";
  for (const auto& path : {dead, dead_yet_locked, alive, foreign}) std::ofstream(path) << "x";
  const int locked = ::open(dead_yet_locked.c_str(), O_RDONLY);
  ASSERT_EQ(::flock(locked, LOCK_EX), 0);
  ASSERT_TRUE(write_file_atomically(dir / "a", "new"));
  ::close(locked);
  EXPECT_FALSE(fs::exists(dead));
  EXPECT_TRUE(fs::exists(dead_yet_locked));
  EXPECT_TRUE(fs::exists(alive));
  EXPECT_TRUE(fs::exists(foreign));
}

TEST(AtomicFile, AProcessKilledInTheMiddleLeavesTheOldFile) {
  const TempDir dir;
  ASSERT_TRUE(write_file_atomically(dir / "a", "old"));
  const FileCalls calls{.fsync = [](int) { return ::kill(::getpid(), SIGKILL); }};
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    static_cast<void>(write_file_atomically(dir / "a", "new", calls));
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(content_of(dir / "a"), "old");
  EXPECT_EQ(num_files(dir.path()), 2U);  // the temporary of the dead
  ASSERT_TRUE(write_file_atomically(dir / "a", "newer"));
  EXPECT_EQ(num_files(dir.path()), 1U);
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
