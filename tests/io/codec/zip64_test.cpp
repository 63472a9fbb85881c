// SPDX-License-Identifier: BSD-3-Clause
// Zip files with numbers of 64 bits.
#include "hypermap/io/codec/zip_reader.hpp"
#include "hypermap/io/codec/zip_salvage.hpp"
#include "io/codec/raw_zip.hpp"
#include "support/temp_dir.hpp"
#include "zip/zip_records.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zip.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using namespace std::string_literals;
using test::raw_zip;
using test::RawMember;
using test::stored;
using test::TempDir;
using testing::HasSubstr;

constexpr std::uint64_t kGiB = std::uint64_t{1} << 30U;
constexpr ZipLimits kLarge{.max_archive_bytes = 64 * kGiB, .max_total_bytes = 128 * kGiB};

/// Three members of 2 GiB that the file has no blocks for, and a small one behind them.
void write_sparse_zip(const std::filesystem::path& path) {
  std::ofstream file(path, std::ios::binary);
  std::vector<ZipMember> members;
  std::uint64_t at = 0;
  const auto add = [&](const std::string& name, std::uint64_t num_bytes, std::uint32_t crc32) {
    ZipMember member{
        .name = name, .num_bytes = num_bytes, .num_packed_bytes = num_bytes, .crc32 = crc32};
    const std::string header = zip::local_header(member);
    file.seekp(static_cast<std::streamoff>(at));
    file << header;
    member.data_offset = at + header.size();
    members.push_back(member);
    at = member.data_offset + num_bytes;
  };
  for (const char* name : {"a", "b", "c"}) add(name, 2 * kGiB, 0);
  add("last", 7, stored("last", "content").crc);
  file << "content" << zip::directory_of(members, at);
}

Result<ZipReader> open_large(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(std::unique_ptr<ByteSource> source, open_file(path, 64 * kGiB));
  return ZipReader::create(std::move(source), kLarge);
}

TEST(Zip64, AnArchiveBeyondFourGiBIsReadWhereThatIsAllowed) {
  const TempDir dir;
  write_sparse_zip(dir / "large.zip");
  const auto zip = open_large(dir / "large.zip");
  ASSERT_TRUE(zip) << to_string(zip.error());
  ASSERT_EQ(zip->members().size(), 4U);
  EXPECT_EQ(zip->members()[2].data_offset, 4 * kGiB + 93);  // three headers of 31 bytes
  EXPECT_EQ(zip->read("last").value(), "content");
  EXPECT_EQ(zip->read_start("c", 2).value(), "\0\0"s);
  const auto refused =
      ZipReader::create(open_file(dir / "large.zip", 64 * kGiB).value(), ZipLimits{});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kLimit);
  EXPECT_THAT(refused.error().what,
              HasSubstr("the limit is 4294967296; --large allows 68719476736"));
}

TEST(Zip64, LibzipReadsItInStrictMode) {
  const TempDir dir;
  write_sparse_zip(dir / "large.zip");
  int error = 0;
  zip_t* archive = zip_open((dir / "large.zip").c_str(), ZIP_RDONLY | ZIP_CHECKCONS, &error);
  ASSERT_NE(archive, nullptr) << error;
  EXPECT_EQ(zip_get_num_entries(archive, 0), 4);
  zip_file_t* member = zip_fopen(archive, "last", 0);
  ASSERT_NE(member, nullptr);
  std::string content(7, '\0');
  EXPECT_EQ(zip_fread(member, content.data(), content.size()), 7);
  EXPECT_EQ(content, "content");
  zip_fclose(member);
  zip_discard(archive);
}

/// Fields of the extra field, each with its number.
std::string zip64_field(const std::vector<std::uint64_t>& numbers) {
  std::string field = "\x01\x00"s;
  test::put(field, 8 * numbers.size(), 2);
  for (const std::uint64_t number : numbers) test::put(field, number, 8);
  return field;
}

/// "content" whose sizes stand in the extra field.
RawMember wide_member() {
  RawMember member = stored("a", "content");
  member.num_bytes = 0xffffffff;
  member.num_packed_bytes = 0xffffffff;
  member.extra = zip64_field({7, 7});
  return member;
}

std::string zip64_error(const std::string& bytes) {
  const auto zip = ZipReader::create(view_bytes(bytes));
  if (!zip) return to_string(zip.error());
  const auto content = zip->read("a");
  return content ? "no error: " + *content : to_string(content.error());
}

TEST(Zip64, SizesMayStandInTheExtraField) {
  EXPECT_EQ(zip64_error(raw_zip({wide_member()})), "no error: content");
}

TEST(Zip64, ADescriptorOfAWideMemberHasWideSizes) {
  RawMember member = wide_member();
  member.flags = 1U << 3U;
  test::put(member.descriptor, 0x08074b50, 4);
  test::put(member.descriptor, member.crc, 4);
  test::put(member.descriptor, 7, 8);
  test::put(member.descriptor, 7, 8);
  EXPECT_EQ(zip64_error(raw_zip({member})), "no error: content");
  member.descriptor = member.descriptor.substr(4);
  EXPECT_EQ(zip64_error(raw_zip({member})), "no error: content");
  member.descriptor.back() = 1;
  EXPECT_THAT(zip64_error(raw_zip({member})), HasSubstr("data descriptor"));
}

TEST(Zip64, WhatTheExtraFieldSaysIsSaidOnce) {
  const auto with_extra = [](const std::string& extra) {
    RawMember member = wide_member();
    member.extra = extra;
    return zip64_error(raw_zip({member}));
  };
  EXPECT_THAT(with_extra(""), HasSubstr("zip64: a number is marked that no extra field gives"));
  EXPECT_THAT(with_extra(zip64_field({7})), HasSubstr("extra field of 8 bytes for 2 marked"));
  EXPECT_THAT(with_extra(zip64_field({7, 7, 0})), HasSubstr("extra field of 24 bytes for 2"));
  EXPECT_THAT(with_extra(zip64_field({7, 7}) + zip64_field({7, 7})), HasSubstr("two extra fields"));
  EXPECT_THAT(with_extra(zip64_field({~std::uint64_t{0}, ~std::uint64_t{0}})),
              HasSubstr("limit for an entry"));
  EXPECT_THAT(with_extra(zip64_field({7, ~std::uint64_t{0}})), HasSubstr("two sizes differ"));
  RawMember narrow = stored("a", "content");
  narrow.extra = zip64_field({7, 7});
  EXPECT_THAT(zip64_error(raw_zip({narrow})), HasSubstr("for 0 marked numbers"));
}

/// The bytes up to the end record, then an end record of zip64 with its locator.
std::string with_wide_end(std::uint64_t num_entries, std::uint64_t offset_too_far = 0) {
  const std::string narrow = raw_zip({stored("a", "content")});
  const std::uint64_t members = 30 + 1 + 7;
  std::string out = narrow.substr(0, narrow.size() - 22);
  const std::uint64_t end = out.size();
  test::put(out, 0x06064b50, 4);
  test::put(out, 44, 8);
  test::put(out, 45, 2);
  test::put(out, 45, 2);
  test::put(out, 0, 8);
  test::put(out, num_entries, 8);
  test::put(out, num_entries, 8);
  test::put(out, end - members, 8);
  test::put(out, members + offset_too_far, 8);
  test::put(out, 0x07064b50, 4);
  test::put(out, 0, 4);
  test::put(out, end, 8);
  test::put(out, 1, 4);
  return out;
}

TEST(Zip64, TheEndRecordsSayOneThing) {
  const auto end = [](std::uint64_t entries) {
    return test::end_record(entries, 0xffffffff, 0xffffffff);
  };
  EXPECT_EQ(zip64_error(with_wide_end(1) + end(1)), "no error: content");
  EXPECT_EQ(zip64_error(with_wide_end(1) + end(0xffff)), "no error: content");
  EXPECT_THAT(zip64_error(with_wide_end(1) + end(2)), HasSubstr("the other one differ"));
  EXPECT_THAT(zip64_error(with_wide_end(1, 1) + end(1)), HasSubstr("does not end where"));
  EXPECT_THAT(zip64_error(with_wide_end(1, ~std::uint64_t{0}) + end(1)),
              HasSubstr("does not end where"));
  EXPECT_THAT(zip64_error(with_wide_end(1) + test::end_record(1, 47, 38)),
              HasSubstr("does not end where"))
      << "a record that nothing points to";
  std::string moved = with_wide_end(1);
  moved[moved.size() - 12] = static_cast<char>(moved[moved.size() - 12] + 1);
  EXPECT_THAT(zip64_error(moved + end(1)), HasSubstr("not where the locator says"));
  EXPECT_THAT(zip64_error(end(1)), HasSubstr("without an end record of its own"));
}

// By another program that does not know the sizes beforehand.
TEST(Zip64, SalvageReadsSizesOfLocalHeaders) {
  const std::string cut = raw_zip({wide_member()}).substr(0, 58);
  const auto salvaged = salvage_zip(*view_bytes(cut), {});
  ASSERT_TRUE(salvaged) << to_string(salvaged.error());
  ASSERT_EQ(salvaged->members.size(), 1U);
  EXPECT_EQ(salvaged->members[0].bytes, "content");
}

TEST(Zip64, SalvageNotesSizesBeyondTheFile) {
  RawMember member = wide_member();
  member.extra = zip64_field({7, ~std::uint64_t{0}});
  const std::string bytes = raw_zip({member});
  const auto salvaged = salvage_zip(*view_bytes(bytes), {});
  ASSERT_TRUE(salvaged) << to_string(salvaged.error());
  EXPECT_TRUE(salvaged->members.empty());
}

}  // namespace
}  // namespace hypermap
