// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/object_embeddings.hpp"

#include "hypermap/io/archive/archive_info.hpp"
#include "hypermap/io/codec/number_bytes.hpp"
#include "io/archive/archive_edits.hpp"
#include "io/archive/sample_archive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using test::changed;
using test::kArchiveSource;
using test::load_error;
using test::member_of;
using test::replaced;
using test::sample_archive;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using namespace std::string_view_literals;

const SourceName kEmbeddingsSource{.file = "a.hmap", .entry = "embeddings.bin"};

MeanEmbeddings means_of(const std::vector<Embedding>& seen) {
  MeanEmbeddings means;
  means.observe(seen);
  return means;
}

/// Object 2 looks like (0.6, 0.8) to "a"; object 7 like (0, 1) to "a" and like (1) to "b".
ObjectEmbeddings two_objects() {
  return {{ObjectId{2}, means_of({{"a", {3, 4}}})},
          {ObjectId{7}, means_of({{"a", {0, 5}}, {"b", {2}}})}};
}

std::string uint32s(const std::vector<std::uint32_t>& numbers) {
  std::string bytes;
  for (const std::uint32_t number : numbers) append_uint32(bytes, number);
  return bytes;
}

std::string embeddings_refusal(std::string_view bytes) {
  const auto parsed = parse_object_embeddings(bytes, kEmbeddingsSource);
  return parsed ? "none" : to_string(parsed.error());
}

TEST(ObjectEmbeddings, HaveTheBytesThatTheHeaderTells) {
  const std::string expected = "HMEMBED1" + uint32s({2}) +                                    //
                               uint32s({1}) + "a" + uint32s({2, 2, 2, 1, 7, 1}) +             //
                               bytes_of_floats(std::vector<float>{0.6F, 0.8F, 0.0F, 1.0F}) +  //
                               uint32s({1}) + "b" + uint32s({1, 1, 7, 1}) +
                               bytes_of_floats(std::vector<float>{1.0F});
  EXPECT_EQ(write_object_embeddings(two_objects()).value(), expected);
  EXPECT_EQ(parse_object_embeddings(expected, kEmbeddingsSource).value(), two_objects());
  EXPECT_EQ(parse_object_embeddings("HMEMBED1\0\0\0\0"sv, kEmbeddingsSource).value(),
            ObjectEmbeddings{});
}

TEST(ObjectEmbeddings, EveryCutIsRefusedAtItsByte) {
  const std::string bytes = write_object_embeddings(two_objects()).value();
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THAT(embeddings_refusal(bytes.substr(0, size)),
                HasSubstr("a.hmap!embeddings.bin: byte "));
  EXPECT_THAT(embeddings_refusal(bytes + "x"), HasSubstr("must end here, has 1 bytes more"));
  EXPECT_THAT(embeddings_refusal(bytes.substr(0, 20)), HasSubstr("byte 17: is cut, expected 4"));
}

TEST(ObjectEmbeddings, WhatNoObjectHasIsRefusedAtItsByte) {
  const auto with = [](std::string_view body) {
    return embeddings_refusal("HMEMBED1" + uint32s({1}) + std::string(body));
  };
  const std::string one = bytes_of_floats(std::vector<float>{1.0F});
  EXPECT_EQ(with(uint32s({1}) + "a" + uint32s({1, 1, 3, 1}) + one), "none");
  EXPECT_THAT(with(uint32s({0, 1, 1, 3, 1}) + one), HasSubstr("names of models must ascend"));
  EXPECT_THAT(with(uint32s({1}) + "\n" + uint32s({1, 1, 3, 1}) + one), HasSubstr("control"));
  EXPECT_THAT(with(uint32s({1}) + "a" + uint32s({0, 1, 3, 1})), HasSubstr("1 .. 4096, is 0"));
  EXPECT_THAT(with(uint32s({1}) + "a" + uint32s({4097, 1, 3, 1})), HasSubstr("is 4097"));
  EXPECT_THAT(with(uint32s({1}) + "a" + uint32s({1, 1, 0, 1}) + one), HasSubstr("must ascend"));
  EXPECT_THAT(with(uint32s({1}) + "a" + uint32s({1, 2, 3, 1, 3, 1}) + one + one),
              HasSubstr("must ascend"));
  EXPECT_THAT(with(uint32s({1}) + "a" + uint32s({1, 1, 3, 0}) + one),
              HasSubstr("byte 33: of object 3: count must be > 0"));
  EXPECT_THAT(
      with(uint32s({1}) + "a" + uint32s({1, 1, 3, 1}) + bytes_of_floats(std::vector<float>{1.1F})),
      HasSubstr("byte 33: of object 3: mean must have a length of at most 1"));
}

TEST(ObjectEmbeddings, SizesThatLieAreRefusedBeforeMemoryIsTaken) {
  const std::string most = uint32s({0xffffffffU});
  EXPECT_THAT(embeddings_refusal("HMEMBED1" + most), HasSubstr("at most 64 models"));
  EXPECT_THAT(embeddings_refusal("HMEMBED1" + uint32s({1}) + most), HasSubstr("is cut"));
  EXPECT_THAT(embeddings_refusal("HMEMBED1" + uint32s({1, 1}) + "a" + uint32s({4096, 0xffffffffU})),
              HasSubstr("expected 34359738360 bytes, has 0"));
}

TEST(ObjectEmbeddings, AnArchiveKeepsThemAndTellsOfThem) {
  const MapArchive archive = sample_archive();
  const std::string bytes = write_archive(archive).value();
  const auto loaded = parse_archive(bytes, kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_THAT(loaded->findings, IsEmpty());
  EXPECT_EQ(loaded->value.objects, archive.objects);
  EXPECT_EQ(write_archive(loaded->value).value(), bytes);
  const ArchiveInfo info = describe(loaded->value);
  ASSERT_THAT(info.models, SizeIs(2));
  EXPECT_EQ(info.models[0].model, "clip");
  EXPECT_EQ(info.models[0].dimension, 3U);
  EXPECT_EQ(info.models[1].num_objects, 1U);
  EXPECT_THAT(to_json(info),
              HasSubstr(R"("embeddings":[{"model":"clip","dimension":3,"objects":1},)"));
}

TEST(ObjectEmbeddings, AnArchiveWithoutThemHasNoMember) {
  MapArchive archive = sample_archive();
  archive.objects.modify(ObjectId{1}, [](Object& object) { object.embeddings = {}; });
  const std::string bytes = write_archive(archive).value();
  EXPECT_FALSE(ZipReader::create(view_bytes(bytes))->contains("embeddings.bin"));
  EXPECT_TRUE(describe(parse_archive(bytes, kArchiveSource)->value).models.empty());
}

TEST(ObjectEmbeddings, MayStandBeforeTheObjectsThatHaveThem) {
  const std::string bytes = write_archive(sample_archive()).value();
  std::string config = member_of(bytes, "hmap_config.yaml");
  for (const auto& [from, to] : {std::pair{"hypermap-objects", "later"},
                                 std::pair{"hypermap-embeddings", "hypermap-objects"},
                                 std::pair{"later", "hypermap-embeddings"},
                                 std::pair{"objects.jsonl", "later"},
                                 std::pair{"embeddings.bin", "objects.jsonl"},
                                 std::pair{"later", "embeddings.bin"}}) {
    config = replaced(config, from, to);
  }
  const auto loaded = parse_archive(changed(bytes, {{"hmap_config.yaml", config}}), kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(loaded->value.objects, sample_archive().objects);
}

TEST(ObjectEmbeddings, DamageIsToldWithMemberAndByte) {
  const std::string bytes = write_archive(sample_archive()).value();
  const std::string member = member_of(bytes, "embeddings.bin");
  EXPECT_THAT(load_error(changed(bytes, {{"embeddings.bin", member.substr(0, 30)}})),
              HasSubstr("a.hmap!embeddings.bin: byte "));
  EXPECT_THAT(load_error(changed(bytes, {{"embeddings.bin", "x"}})),
              HasSubstr("byte 0: is no file of embeddings"));
}

TEST(ObjectEmbeddings, OfObjectsThatAreNotThereAreLeftOutAndSaid) {
  const std::string bytes = write_archive(sample_archive()).value();
  const std::string others = write_object_embeddings(two_objects()).value();
  const auto loaded = parse_archive(changed(bytes, {{"embeddings.bin", others}}), kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  ASSERT_THAT(loaded->findings, SizeIs(1));
  EXPECT_THAT(to_string(loaded->findings[0].error), HasSubstr("is of 2 objects"));
  EXPECT_TRUE(embeddings_of(loaded->value.objects).empty());
}

TEST(ObjectEmbeddings, OfOneModelHaveOneDimension) {
  const ObjectEmbeddings clash{{ObjectId{2}, means_of({{"a", {3, 4}}})},
                               {ObjectId{7}, means_of({{"a", {5}}})}};
  EXPECT_THAT(to_string(write_object_embeddings(clash).error()), HasSubstr("must have 2 numbers"));
}

}  // namespace
}  // namespace hypermap
