// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/byte_source.hpp"

#include "hypermap/io/codec/atomic_file.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace hypermap {
namespace {

using test::TempDir;
using testing::HasSubstr;

TEST(ByteSource, ReadsAnyPartOfAFileAndOfMemory) {
  const TempDir dir;
  ASSERT_TRUE(write_file_atomically(dir / "a", "0123456789"));
  const auto file = open_file(dir / "a", 10);
  ASSERT_TRUE(file);
  const auto memory = view_bytes("0123456789");
  for (const ByteSource* source : {file->get(), memory.get()}) {
    EXPECT_EQ(source->size(), 10U);
    EXPECT_EQ(source->read_at(3, 4).value(), "3456");
    EXPECT_EQ(source->read_at(10, 0).value(), "");
    for (const auto& beyond : {source->read_at(7, 4), source->read_at(11, 0)}) {
      ASSERT_FALSE(beyond);
      EXPECT_EQ(beyond.error().code, ErrorCode::kMalformedFile);
    }
  }
}

TEST(ByteSource, StaysWithTheFileThatWasOpened) {
  const TempDir dir;
  ASSERT_TRUE(write_file_atomically(dir / "a", "old"));
  const auto file = open_file(dir / "a", 10);
  ASSERT_TRUE(file);
  ASSERT_TRUE(write_file_atomically(dir / "a", "new"));
  EXPECT_EQ((*file)->read_at(0, 3).value(), "old");
}

TEST(ByteSource, AFileThatShrinksWhileItIsReadIsAnError) {
  const TempDir dir;
  ASSERT_TRUE(write_file_atomically(dir / "a", "0123456789"));
  const auto file = open_file(dir / "a", 10);
  ASSERT_TRUE(file);
  std::filesystem::resize_file(dir / "a", 4);
  const auto bytes = (*file)->read_at(0, 10);
  ASSERT_FALSE(bytes);
  EXPECT_THAT(bytes.error().what, HasSubstr("unexpected end"));
}

TEST(ByteSource, AFifoAFolderADeviceAndAMissingFileAreErrorsWithReason) {
  const TempDir dir;
  ASSERT_EQ(::mkfifo((dir / "fifo").c_str(), 0600), 0);
  for (const std::filesystem::path& path :
       {dir / "fifo", dir.path(), std::filesystem::path("/dev/zero"), dir / "none"}) {
    const auto bytes = read_file(path, 10);
    ASSERT_FALSE(bytes) << path;
    EXPECT_EQ(bytes.error().code, ErrorCode::kIo);
    EXPECT_EQ(bytes.error().file, path.string());
  }
  EXPECT_THAT(read_file(dir / "none", 10).error().what, HasSubstr("errno 2"));
}

TEST(ByteSource, ALargerFileThanTheLimitIsRefusedUnread) {
  const TempDir dir;
  ASSERT_TRUE(write_file_atomically(dir / "a", "0123456789"));
  const auto bytes = read_file(dir / "a", 9);
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().code, ErrorCode::kLimit);
  EXPECT_THAT(bytes.error().what, HasSubstr("the limit is 9"));
}

}  // namespace
}  // namespace hypermap
