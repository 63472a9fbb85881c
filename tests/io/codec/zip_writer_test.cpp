// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/zip_writer.hpp"

#include "hypermap/io/codec/zip_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zip.h>

#include <random>
#include <string>

namespace hypermap {
namespace {

using testing::HasSubstr;

std::string noise(std::size_t num_bytes) {
  std::mt19937 engine(7);
  std::string bytes(num_bytes, '\0');
  for (char& c : bytes) c = static_cast<char>(engine() & 0xff);
  return bytes;
}

std::string write(std::initializer_list<std::pair<std::string, std::string>> members) {
  ZipWriter writer;
  for (const auto& [name, content] : members) EXPECT_TRUE(writer.add(name, content));
  return writer.finish().value();
}

TEST(ZipWriter, WhatItWritesIsReadBack) {
  const std::string random = noise(70000);
  const std::string large(3 << 20, 'z');
  const std::string bytes = write({{"empty", ""},
                                   {"random", random},
                                   {"large", large},
                                   {"k\xc3\xbc"
                                    "che",
                                    "sink"}});
  const auto zip = ZipReader::create(view_bytes(bytes));
  ASSERT_TRUE(zip) << to_string(zip.error());
  EXPECT_EQ(zip->read("empty").value(), "");
  EXPECT_EQ(zip->read("random").value(), random);
  EXPECT_EQ(zip->read("large").value(), large);
  EXPECT_EQ(zip->read("k\xc3\xbc"
                      "che")
                .value(),
            "sink");
}

TEST(ZipWriter, LibzipReadsItInStrictMode) {
  const std::string bytes = write({{"a", "first"}, {"b", std::string(5000, 'b')}});
  zip_error_t error{};
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  ASSERT_NE(source, nullptr);
  zip_t* archive = zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error);
  ASSERT_NE(archive, nullptr) << zip_error_strerror(&error);
  EXPECT_EQ(zip_get_num_entries(archive, 0), 2);
  zip_file_t* member = zip_fopen(archive, "b", 0);
  ASSERT_NE(member, nullptr);
  std::string content(6000, '\0');
  EXPECT_EQ(zip_fread(member, content.data(), content.size()), 5000);
  EXPECT_EQ(content.substr(0, 5000), std::string(5000, 'b'));
  zip_fclose(member);
  zip_discard(archive);
}

TEST(ZipWriter, TheSameMembersGiveTheSameBytes) {
  EXPECT_EQ(write({{"a", "1"}, {"b", noise(100)}}), write({{"a", "1"}, {"b", noise(100)}}));
}

TEST(ZipWriter, EveryStampIsTheFirstDayOfZip) {
  const std::string bytes = write({{"a", "1"}});
  // Local header, bytes 10 to 13: time 0, date (1980 - 1980) << 9 | 1 << 5 | 1 = 0x0021.
  EXPECT_EQ(bytes.substr(10, 4), std::string("\x00\x00\x21\x00", 4));
}

TEST(ZipWriter, NamesThatTheReaderRefusesAreRefused) {
  ZipWriter writer;
  EXPECT_FALSE(writer.add("../a", "1"));
  ASSERT_TRUE(writer.add("a", "1"));
  ASSERT_TRUE(writer.add("A", "1"));
  const auto finished = writer.finish();
  ASSERT_FALSE(finished);
  EXPECT_THAT(finished.error().what, HasSubstr("there twice"));
}

TEST(ZipWriter, LimitsHoldForWritingToo) {
  ZipWriter writer({.max_entries = 1, .max_entry_bytes = 10, .max_total_bytes = 12});
  EXPECT_EQ(writer.add("a", std::string(11, 'a')).error().code, ErrorCode::kLimit);
  EXPECT_TRUE(writer.add("a", std::string(10, 'a')));
  EXPECT_EQ(writer.add("b", std::string(1, 'a')).error().code, ErrorCode::kLimit);
}

}  // namespace
}  // namespace hypermap
