// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/zip_reader.hpp"

#include "hypermap/io/codec/zip_writer.hpp"
#include "io/codec/raw_zip.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using test::raw_zip;
using test::RawMember;
using test::stored;
using testing::HasSubstr;

Result<ZipReader> open(const std::string& bytes, const ZipLimits& limits = {}) {
  return ZipReader::create(view_bytes(bytes), limits);
}

/// Opens and reads every member; the first error there is.
Result<std::vector<std::string>> contents(const std::string& bytes, const ZipLimits& limits = {}) {
  HYPERMAP_ASSIGN_OR_RETURN(const ZipReader zip, open(bytes, limits));
  std::vector<std::string> all;
  for (const ZipMember& member : zip.members()) {
    HYPERMAP_ASSIGN_OR_RETURN(std::string content, zip.read(member.name));
    all.push_back(member.name + "=" + content);
  }
  return all;
}

std::string zip_error(const std::string& bytes, const ZipLimits& limits = {}) {
  const auto all = contents(bytes, limits);
  return all ? "no error" : to_string(all.error());
}

std::string sample_zip() {
  ZipWriter writer;
  EXPECT_TRUE(writer.add("hmap_config.yaml", "layers: []\n"));
  EXPECT_TRUE(writer.add("grid.txt", std::string(300, 'x')));
  return writer.finish().value();
}

RawMember with(RawMember member, void (*change)(RawMember&)) {
  change(member);
  return member;
}

TEST(ZipReader, ReadsStoredAndDeflatedMembersInTheOrderOfTheDirectory) {
  const std::string bytes = sample_zip();
  const auto zip = open(bytes);
  ASSERT_TRUE(zip) << to_string(zip.error());
  ASSERT_EQ(zip->members().size(), 2U);
  EXPECT_EQ(zip->members()[1].name, "grid.txt");
  EXPECT_TRUE(zip->members()[1].deflated);
  EXPECT_EQ(zip->read("grid.txt").value(), std::string(300, 'x'));
  EXPECT_EQ(zip->read("hmap_config.yaml").value(), "layers: []\n");
  EXPECT_EQ(zip->read("other").error().code, ErrorCode::kNotFound);
}

TEST(ZipReader, AnEmptyArchiveIsAnArchive) {
  EXPECT_TRUE(contents(test::end_record(0, 0, 0)));
}

TEST(ZipReader, OtherFilesAreNoArchives) {
  for (const std::string& bytes : {std::string(),
                                   std::string("PK"),
                                   std::string("PK\x03\x04"),
                                   std::string(5000, '\0'),
                                   std::string("layers:\n  - {class: OccupancyGridLayer}\n")})
    EXPECT_THAT(zip_error(bytes), HasSubstr("not a map archive"));
}

TEST(ZipReader, ACutAtAnyOffsetIsAnError) {
  const std::string bytes = sample_zip();
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_FALSE(contents(bytes.substr(0, length))) << length;
}

TEST(ZipReader, AFlippedBitGivesTheSameContentOrAnError) {
  const std::string bytes = sample_zip();
  const auto content = contents(bytes);
  ASSERT_TRUE(content);
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string flipped = bytes;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ 1 << (bit % 8));
    const auto after = contents(flipped);
    if (after) {
      EXPECT_EQ(*after, *content) << "bit " << bit;
    }
  }
}

TEST(ZipReader, BytesBeforeBetweenAndAfterAreErrors) {
  const std::string bytes = sample_zip();
  EXPECT_THAT(zip_error("garbage" + bytes), HasSubstr("central directory does not end where"));
  EXPECT_THAT(zip_error(bytes + "garbage"), HasSubstr("no zip end record"));
  RawMember gap = stored("b", "2");
  gap.header_offset = 30 + 1 + 1 + 3;
  const std::string members = raw_zip({stored("a", "1"), gap});
  EXPECT_THAT(zip_error(members), HasSubstr("belong to no entry"));
}

TEST(ZipReader, ACommentIsAcceptedTwoEndRecordsAreNot) {
  EXPECT_TRUE(contents(raw_zip({stored("a", "1")}, "a comment")));
  EXPECT_THAT(zip_error(raw_zip({stored("a", "1")}, test::end_record(0, 0, 0))),
              HasSubstr("two end records"));
}

TEST(ZipReader, LocalAndCentralHeaderMustAgree) {
  const auto member = [](void (*change)(RawMember&)) {
    return raw_zip({with(stored("a", "content"), change)});
  };
  EXPECT_THAT(zip_error(member([](RawMember& m) { m.local_name = "b"; })),
              HasSubstr("names another member"));
  EXPECT_THAT(zip_error(member([](RawMember& m) { m.local_method = 8; })), HasSubstr("differ"));
  EXPECT_THAT(zip_error(member([](RawMember& m) { m.local_crc = 1; })), HasSubstr("differ"));
  EXPECT_THAT(zip_error(member([](RawMember& m) { m.local_num_bytes = 6; })), HasSubstr("differ"));
}

TEST(ZipReader, ContentMustFitItsCrcAndSize) {
  const auto wrong_crc = with(stored("a", "content"), [](RawMember& m) { m.crc ^= 1; });
  EXPECT_THAT(zip_error(raw_zip({wrong_crc})), HasSubstr("CRC-32"));
  EXPECT_THAT(zip_error(raw_zip({wrong_crc})), HasSubstr("a: "));
  for (const std::uint32_t declared : {std::uint32_t{6}, std::uint32_t{8}}) {
    RawMember member = stored("a",
                              std::string("\x01\x07\x00\xf8\xff"
                                          "content",
                                          12));  // deflate
    member.method = 8;
    member.num_bytes = declared;
    member.crc = stored("a", "content").crc;
    EXPECT_THAT(zip_error(raw_zip({member})), HasSubstr("than its declared size"));
    member.num_bytes = 7;
    EXPECT_TRUE(contents(raw_zip({member})));
    member.data += "x";
    ++member.num_packed_bytes;
    EXPECT_THAT(zip_error(raw_zip({member})), HasSubstr("after the end of the deflate stream"));
  }
}

TEST(ZipReader, DataDescriptorsAreReadAndJudged) {
  for (const bool with_signature : {false, true}) {
    RawMember member = stored("a", "content");
    member.flags = 8;
    member.descriptor = test::descriptor_of(member, with_signature);
    EXPECT_TRUE(contents(raw_zip({member, stored("b", "2")})));
    member.descriptor[with_signature ? 4 : 0] ^= 1;
    EXPECT_THAT(zip_error(raw_zip({member, stored("b", "2")})), HasSubstr("data descriptor"));
  }
}

TEST(ZipReader, EqualNamesAreErrorsAlsoInAnotherCaseOrAsAFolder) {
  EXPECT_THAT(zip_error(raw_zip({stored("a", "1"), stored("a", "2")})), HasSubstr("there twice"));
  EXPECT_THAT(zip_error(raw_zip({stored("Map", "1"), stored("mAP", "2")})),
              HasSubstr("there twice"));
  EXPECT_THAT(zip_error(raw_zip({stored("a/b", "1"), stored("a", "2")})), HasSubstr("folder"));
  EXPECT_THAT(zip_error(raw_zip({stored("a", "2"), stored("a/b", "1")})), HasSubstr("folder"));
}

TEST(ZipReader, FolderEntriesAreLeftOut) {
  RawMember folder = stored("maps/", "");
  folder.attributes = 0040755U << 16U;
  const auto zip = contents(raw_zip({folder, stored("maps/a", "1")}));
  ASSERT_TRUE(zip);
  EXPECT_THAT(*zip, testing::ElementsAre("maps/a=1"));
  EXPECT_THAT(zip_error(raw_zip({stored("maps/", "1")})), HasSubstr("folder with content"));
}

TEST(ZipReader, NamesThatCouldLeadElsewhereAreErrors) {
  using namespace std::string_literals;
  for (const std::string& name : {""s,
                                  "../a"s,
                                  "a/../b"s,
                                  "/a"s,
                                  "a//b"s,
                                  "./a"s,
                                  "a/."s,
                                  "C:\\a"s,
                                  "C:a"s,
                                  "a\\b"s,
                                  "a\0b"s,
                                  "a\nb"s,
                                  "\xff\xfe"s,
                                  "\xc0\xae"s,
                                  std::string(256, 'a')})
    EXPECT_THAT(zip_error(raw_zip({stored(name, "1")})), HasSubstr("member name '")) << name;
  EXPECT_TRUE(contents(raw_zip({stored(std::string(255, 'a'), "1"),
                                stored("k\xc3\xbc"
                                       "che",
                                       "2"),
                                stored("a..b", "3"),
                                stored("...", "4")})));
}

TEST(ZipReader, LinksDevicesEncryptedAndOtherMethodsAreErrors) {
  const auto member = [](void (*change)(RawMember&)) {
    return zip_error(raw_zip({with(stored("a", "content"), change)}));
  };
  EXPECT_THAT(member([](RawMember& m) { m.attributes = 0120777U << 16U; }), HasSubstr("link"));
  EXPECT_THAT(member([](RawMember& m) { m.attributes = 0020666U << 16U; }), HasSubstr("device"));
  EXPECT_THAT(member([](RawMember& m) { m.flags = 1; }),
              HasSubstr("encrypted entries are not supported"));
  EXPECT_THAT(member([](RawMember& m) { m.method = 12; }), HasSubstr("compression method 12"));
}

TEST(ZipReader, Zip64MarkersAreErrors) {
  using namespace std::string_literals;
  EXPECT_THAT(
      zip_error(raw_zip({with(stored("a", "x"), [](RawMember& m) { m.num_bytes = 0xffffffff; })})),
      HasSubstr("zip64"));
  EXPECT_THAT(zip_error(raw_zip(
                  {with(stored("a", "x"), [](RawMember& m) { m.extra = "\x01\x00\x00\x00"s; })})),
              HasSubstr("zip64"));
  EXPECT_THAT(zip_error(test::end_record(0xffff, 0, 0)), HasSubstr("zip64"));
}

TEST(ZipReader, DamagedExtraFieldsAndASecondNameAreErrors) {
  using namespace std::string_literals;
  EXPECT_THAT(zip_error(raw_zip(
                  {with(stored("a", "x"), [](RawMember& m) { m.extra = "\x99\x99\x05\x00"s; })})),
              HasSubstr("extra field"));
  EXPECT_THAT(zip_error(raw_zip({with(stored("a", "x"),
                                      [](RawMember& m) {
                                        m.extra =
                                            "\x75\x70\x06\x00\x01\x00\x00\x00\x00"
                                            "b"s;
                                      })})),
              HasSubstr("another name"));
}

TEST(ZipReader, OverlapsAreErrors) {
  RawMember second = stored("b", "2");
  second.header_offset = 0;
  second.local_name = "b";
  EXPECT_THAT(zip_error(raw_zip({stored("a", "1"), second})), HasSubstr("overlaps"));
}

TEST(ZipReader, EachLimitIsNamed) {
  const std::string bytes = sample_zip();
  EXPECT_THAT(zip_error(bytes, {.max_archive_bytes = 100}), HasSubstr("the limit is 100"));
  EXPECT_THAT(zip_error(bytes, {.max_entries = 1}), HasSubstr("2 entries, the limit is 1"));
  EXPECT_THAT(zip_error(bytes, {.max_entry_bytes = 299}), HasSubstr("limit for an entry is 299"));
  EXPECT_THAT(zip_error(bytes, {.max_total_bytes = 310}), HasSubstr("together 311 bytes"));
  EXPECT_THAT(zip_error(bytes, {.max_ratio = 10, .ratio_free_bytes = 200}),
              HasSubstr("a ratio of 10:1"));
  const auto zip = open(bytes);
  ASSERT_TRUE(zip);
  EXPECT_EQ(zip->read("grid.txt", 299).error().code, ErrorCode::kLimit);
}

TEST(ZipReader, ADiskThatDiesWhileReadingIsAnErrorWithItsReason) {
  class DyingDisk final : public ByteSource {
   public:
    DyingDisk(std::string bytes, int reads) : bytes_(std::move(bytes)), reads_(reads) {}
    [[nodiscard]] std::uint64_t size() const override { return bytes_.size(); }
    [[nodiscard]] Result<std::string> read_at(std::uint64_t offset,
                                              std::size_t num_bytes) const override {
      if (reads_-- == 0) return fail(ErrorCode::kIo, "Input/output error (errno 5)");
      return bytes_.substr(offset, num_bytes);
    }

   private:
    std::string bytes_;
    mutable int reads_;
  };
  for (int reads = 0; reads < 6; ++reads) {
    const auto zip = ZipReader::create(std::make_shared<DyingDisk>(sample_zip(), reads));
    if (zip) {
      EXPECT_EQ(zip->read("grid.txt").error().code, ErrorCode::kIo);
    } else {
      EXPECT_THAT(zip.error().what, HasSubstr("errno 5"));
    }
  }
}

}  // namespace
}  // namespace hypermap
