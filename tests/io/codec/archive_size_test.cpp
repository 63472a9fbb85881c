// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/archive_size.hpp"

#include "hypermap/io/codec/zip_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hypermap {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string size_error(std::uint64_t num_bytes, std::uint64_t limit) {
  const auto checked = check_archive_size(num_bytes, {.max_archive_bytes = limit});
  return checked ? "allowed" : checked.error().what;
}

TEST(ArchiveSize, UpToTheLimit) {
  EXPECT_EQ(size_error(9, 9), "allowed");
  EXPECT_EQ(size_error(10, 9), "archive of 10 bytes, the limit is 9; --large allows 68719476736");
}

TEST(ArchiveSize, WhatNoOptionAllowsNamesNone) {
  EXPECT_EQ(size_error(kLargeArchiveBytes, 9),
            "archive of 68719476736 bytes, the limit is 9; --large allows 68719476736");
  EXPECT_THAT(size_error(kLargeArchiveBytes + 1, 9), Not(HasSubstr("--large")));
  EXPECT_EQ(size_error(kLargeArchiveBytes + 1, kLargeArchiveBytes),
            "archive of 68719476737 bytes, the limit is 68719476736");
}

TEST(ArchiveSize, WriterAndReaderSayTheSame) {
  ZipWriter allowed;
  ASSERT_TRUE(allowed.add("a", "content"));
  const std::string bytes = allowed.finish().value();
  const ZipLimits less{.max_archive_bytes = bytes.size() - 1};
  ZipWriter refused(less);
  ASSERT_TRUE(refused.add("a", "content"));
  const auto written = refused.finish();
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kLimit);
  EXPECT_EQ(written.error().what, size_error(bytes.size(), bytes.size() - 1));
  const auto read = ZipReader::create(view_bytes(bytes), less);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().what, written.error().what);
}

}  // namespace
}  // namespace hypermap
