// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/zip_salvage.hpp"

#include "hypermap/io/codec/zip_writer.hpp"
#include "raw_zip.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using test::raw_zip;
using test::stored;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::vector<std::pair<std::string, std::string>>& sound_members() {
  static const std::vector<std::pair<std::string, std::string>> kMembers{
      {"hmap_config.yaml", "layers: []\n"},
      {"long", std::string(5000, 'a') + "b"},
      {"empty", ""},
      {"folder/last", "the last one"}};
  return kMembers;
}

std::string sound_zip() {
  ZipWriter writer;
  for (const auto& [name, content] : sound_members()) EXPECT_TRUE(writer.add(name, content));
  return writer.finish().value();
}

Result<ZipSalvage> salvaged(const std::string& bytes, const ZipLimits& limits = {}) {
  return salvage_zip(*view_bytes(bytes), limits);
}

TEST(ZipSalvage, FindsAllOfASoundFile) {
  const auto salvage = salvaged(sound_zip()).value();
  ASSERT_EQ(salvage.members.size(), sound_members().size());
  for (std::size_t i = 0; i < sound_members().size(); ++i) {
    EXPECT_EQ(salvage.members[i].name, sound_members()[i].first);
    EXPECT_EQ(salvage.members[i].bytes, sound_members()[i].second);
  }
  EXPECT_THAT(salvage.lost, IsEmpty());
}

TEST(ZipSalvage, OfACutFileFindsTheMembersBeforeTheCut) {
  const std::string bytes = sound_zip();
  std::size_t num_before = 0;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto salvage = salvaged(bytes.substr(0, size));
    const std::size_t num_found = salvage ? salvage->members.size() : 0;
    EXPECT_GE(num_found, num_before) << size;
    for (std::size_t i = 0; i < num_found; ++i)
      EXPECT_EQ(salvage->members[i].bytes, sound_members()[i].second) << size;
    num_before = num_found;
  }
  EXPECT_EQ(num_before, sound_members().size());
}

TEST(ZipSalvage, AChangedByteLosesOneMemberAtMost) {
  const std::string bytes = sound_zip();
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    const auto salvage = salvaged(changed);
    ASSERT_TRUE(salvage) << at;
    EXPECT_GE(salvage->members.size() + 1, sound_members().size()) << at;
    for (const SalvagedMember& member : salvage->members) {
      const auto original = std::ranges::find(
          sound_members(), member.bytes, &std::pair<std::string, std::string>::second);
      EXPECT_NE(original, sound_members().end()) << at;
    }
  }
}

TEST(ZipSalvage, SaysWhyAMemberIsLost) {
  auto wrong = stored("b", "content");
  wrong.crc ^= 1U;
  auto encrypted = stored("c", "x");
  encrypted.flags = 1;
  auto unknown = stored("d", "x");
  unknown.method = 12;
  const auto salvage = salvaged(raw_zip({stored("a", "kept"),
                                         wrong,
                                         encrypted,
                                         unknown,
                                         stored("../e", "x"),
                                         stored("A", "x"),
                                         stored("f", "kept, too")}))
                           .value();
  ASSERT_EQ(salvage.members.size(), 2U);
  EXPECT_EQ(salvage.members[0].name, "a");
  EXPECT_EQ(salvage.members[1].name, "f");
  std::vector<std::string> reasons;
  for (const Error& error : salvage.lost) reasons.push_back(error.entry + ": " + error.what);
  EXPECT_THAT(reasons,
              ElementsAre(HasSubstr("b: CRC-32"),
                          HasSubstr("c: encrypted"),
                          HasSubstr("d: compression method 12"),
                          HasSubstr("../e"),
                          HasSubstr("A: ")));
}

TEST(ZipSalvage, FindsTheEndOfAMemberWhoseSizesFollowIt) {
  for (const bool with_signature : {true, false}) {
    auto streamed = stored("a", "written before its size was known");
    streamed.flags = 8;
    streamed.descriptor = test::descriptor_of(streamed, with_signature);
    std::string bytes = raw_zip({streamed, stored("b", "next")});
    // Sizes and CRC-32 of the local header are left open.
    for (std::size_t at = 14; at < 26; ++at) bytes[at] = '\0';
    const auto salvage = salvaged(bytes.substr(0, bytes.rfind("PK\x01\x02"))).value();
    ASSERT_EQ(salvage.members.size(), 2U) << with_signature;
    EXPECT_EQ(salvage.members[0].bytes, streamed.data);
    EXPECT_EQ(salvage.members[1].bytes, "next");
  }
}

TEST(ZipSalvage, OpensNoZipWithinAMember) {
  const std::string inner = sound_zip();
  const auto kept = salvaged(raw_zip({stored("inner.zip", inner), stored("b", "next")})).value();
  EXPECT_EQ(kept.members.size(), 2U);
  auto wrong = stored("inner.zip", inner);
  wrong.crc ^= 1U;
  const auto lost = salvaged(raw_zip({wrong, stored("b", "next")})).value();
  ASSERT_EQ(lost.members.size(), 1U);
  EXPECT_EQ(lost.members[0].name, "b");
  EXPECT_EQ(lost.lost.size(), 1U);
}

TEST(ZipSalvage, KeepsToLimits) {
  const std::string bytes = sound_zip();
  EXPECT_EQ(salvaged(bytes, {.max_archive_bytes = 10}).error().code, ErrorCode::kLimit);
  EXPECT_EQ(salvaged(bytes, {.max_entries = 3}).error().code, ErrorCode::kLimit);
  EXPECT_EQ(salvaged(bytes, {.max_total_bytes = 100}).error().code, ErrorCode::kLimit);
  const auto salvage = salvaged(bytes, {.max_ratio = 10, .ratio_free_bytes = 100}).value();
  EXPECT_EQ(salvage.members.size(), 3U);
  ASSERT_EQ(salvage.lost.size(), 1U);
  EXPECT_EQ(salvage.lost[0].code, ErrorCode::kLimit);
}

TEST(ZipSalvage, RefusesWhatHasNoMember) {
  for (const char* bytes : {"", "PK", "no zip at all", "PK\x03\x04"})
    EXPECT_TRUE(salvaged(bytes).value_or(ZipSalvage{}).members.empty()) << bytes;
  EXPECT_EQ(salvaged("no zip at all").error().code, ErrorCode::kMalformedFile);
}

}  // namespace
}  // namespace hypermap
