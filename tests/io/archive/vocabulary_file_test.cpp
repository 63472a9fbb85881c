// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/vocabulary_file.hpp"

#include "hypermap/io/archive/archive_info.hpp"
#include "io/archive/archive_edits.hpp"
#include "io/archive/sample_archive.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace hypermap {
namespace {

using test::all_findings;
using test::changed;
using test::kArchiveSource;
using test::load_error;
using test::member_of;
using test::sample_archive;
using testing::ElementsAre;
using testing::HasSubstr;

const SourceName kVocabularySource{.file = "a.hmap", .entry = "vocabulary.yaml"};

ClassVocabulary vocabulary_with_odd_names() {
  return ClassVocabulary::create(
             {.aliases = {{{"sofa"}, {{"settee"}, {"007"}, {"no: \"x\""}}},
                          {{"1.5"}, {{"~"}}},
                          {{"lonely"}, {}}},
              .super_classes = {{{"seat"}, {{"chair"}, {"sofa"}}}, {{"yes"}, {{"seat"}}}}})
      .value();
}

std::string vocabulary_error(const std::string& text) {
  const auto parsed = parse_vocabulary(text, kVocabularySource);
  return parsed ? "was accepted" : to_string(parsed.error());
}

TEST(VocabularyFile, WhatIsWrittenIsReadAgain) {
  const std::string text = write_vocabulary(vocabulary_with_odd_names());
  const auto parsed = parse_vocabulary(text, kVocabularySource);
  ASSERT_TRUE(parsed) << to_string(parsed.error());
  EXPECT_EQ(*parsed, vocabulary_with_odd_names());
  EXPECT_EQ(write_vocabulary(*parsed), text);
  EXPECT_EQ(parse_vocabulary(write_vocabulary({}), kVocabularySource).value(), ClassVocabulary());
  EXPECT_EQ(vocabulary_error("super_classes: {seat: [chair]}\n"), "was accepted");
}

TEST(VocabularyFile, RefusalsNameFileLineFieldAndValue) {
  EXPECT_EQ(vocabulary_error("aliases:\n  sofa: [couch]\n  bench:\n    - pew\n    - Pew\n"),
            "a.hmap!vocabulary.yaml:5: aliases.bench: \"Pew\" stands there twice");
  EXPECT_EQ(
      vocabulary_error("aliases:\n  sofa: [settee]\nsuper_classes:\n  seat: [chair, settee]\n"),
      "a.hmap!vocabulary.yaml:4: super_classes.seat: \"settee\" is an alias of \"sofa\": that "
      "class must stand here");
  EXPECT_EQ(
      vocabulary_error("super_classes:\n  seat: [chair]\n  chair: [stool]\n  stool: [seat]\n"),
      "a.hmap!vocabulary.yaml:4: super_classes.stool: super-classes form a circle: seat > "
      "chair > stool > seat");
  EXPECT_THAT(vocabulary_error("alias: {sofa: [settee]}\n"),
              HasSubstr("unknown key \"alias\", did you mean \"aliases\"?"));
  EXPECT_THAT(vocabulary_error("aliases: {sofa: settee}\n"), HasSubstr("aliases.sofa"));
  EXPECT_THAT(vocabulary_error("aliases: [sofa]\n"), HasSubstr(":1: aliases"));
  EXPECT_THAT(vocabulary_error("aliases: {sofa: [[settee]]}\n"), HasSubstr("aliases.sofa[0]"));
  EXPECT_THAT(vocabulary_error("aliases: {sofa: [a], sofa: [b]}\n"), HasSubstr("sofa"));
  EXPECT_THAT(vocabulary_error("aliases: {sofa: [\"\\xFFx\", a\xFF]}\n"), HasSubstr("UTF-8"));
  EXPECT_THAT(vocabulary_error(""), HasSubstr("a.hmap!vocabulary.yaml"));
  EXPECT_THAT(vocabulary_error("- sofa\n"), HasSubstr("a.hmap!vocabulary.yaml:1"));
  EXPECT_EQ(parse_vocabulary("aliases: {sofa: [settee], bench: [settee]}\n", kVocabularySource)
                .error()
                .code,
            ErrorCode::kMalformedFile);
}

TEST(VocabularyFile, IsPartOfTheArchive) {
  MapArchive archive = sample_archive();
  const std::string without = write_archive(archive).value();
  archive.vocabulary = vocabulary_with_odd_names();
  const std::string bytes = write_archive(archive).value();
  const auto loaded = parse_archive(bytes, kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(all_findings(loaded->findings), "");
  EXPECT_TRUE(loaded->value == archive);
  EXPECT_FALSE(loaded->value == sample_archive());
  EXPECT_EQ(write_archive(loaded->value).value(), bytes);
  // A map that keeps none is the same bytes as before there were any.
  archive.vocabulary = {};
  EXPECT_EQ(write_archive(archive).value(), without);
  EXPECT_EQ(without.find("vocabulary"), std::string::npos);
}

TEST(VocabularyFile, ADamagedMemberIsRefusedByItsName) {
  MapArchive archive = sample_archive();
  archive.vocabulary = vocabulary_with_odd_names();
  const std::string bytes = write_archive(archive).value();
  EXPECT_THAT(load_error(changed(
                  bytes, {{"vocabulary.yaml", "aliases: {a: [b]}\nsuper_classes: {b: [a]}"}})),
              HasSubstr("vocabulary.yaml:2: super_classes.b: \"b\" is an alias of \"a\""));
  EXPECT_THAT(load_error(changed(bytes, {{"vocabulary.yaml", "aliases: {a: [b\n"}})),
              HasSubstr("vocabulary.yaml"));
  const std::string config = member_of(bytes, "hmap_config.yaml");
  const std::string second =
      "  - {format: hypermap-vocabulary, version: 1, name: again, frame_id: map, file: b.yaml}\n";
  EXPECT_THAT(load_error(changed(bytes, {{"hmap_config.yaml", config + second}})),
              HasSubstr("a second 'hypermap-vocabulary'"));
}

TEST(VocabularyFile, InfoCountsAliasesAndSuperClasses) {
  MapArchive archive = sample_archive();
  EXPECT_THAT(to_json(describe(archive)),
              HasSubstr(R"("class_names":{"aliases":0,"super_classes":0})"));
  archive.vocabulary = vocabulary_with_odd_names();
  EXPECT_THAT(to_json(describe(archive)),
              HasSubstr(R"("class_names":{"aliases":4,"super_classes":2})"));
}

TEST(VocabularyFile, TheShippedOneIsWhole) {
  const auto shipped = read_vocabulary(test::source_path("data/vocabulary.yaml"));
  ASSERT_TRUE(shipped) << to_string(shipped.error());
  EXPECT_EQ(shipped->class_of("couch"), shipped->class_of("settee"));
  EXPECT_EQ(shipped->class_of("television"), shipped->class_of("tvmonitor"));
  EXPECT_THAT(shipped->super_classes_of("sofa"), ElementsAre("seat", "furniture"));
  EXPECT_THAT(shipped->names_of("furniture"), testing::Contains("diningtable"));
  EXPECT_THAT(shipped->names_of("tableware"), testing::IsSupersetOf({"cup", "mug", "fork"}));
}

}  // namespace
}  // namespace hypermap
