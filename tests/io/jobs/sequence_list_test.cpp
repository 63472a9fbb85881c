// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/sequence_list.hpp"

#include "support/temp_dir.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

Result<std::vector<ListedSequence>> parsed(const std::string& text) {
  return parse_sequence_list(text, {.file = "list.yaml"}, "/data");
}

std::string refusal(const std::string& text) {
  const auto list = parsed(text);
  return list ? "read" : to_string(list.error());
}

TEST(SequenceList, SaysOfEachSequenceWhatIsItsOwn) {
  const auto list = parsed(
      "sequences:\n"
      "- input: halls/east/\n"
      "- input: /elsewhere/lab\n"
      "  name: the lab\n"
      "  dataset: lab.yaml\n"
      "  detections: [{file: a.jsonl, detector: yolo}, b.jsonl]\n"
      "  poses: closed.txt\n"
      "  up: -y\n"
      "  transform: [4.2, -1, 0.5, 90]\n");
  ASSERT_TRUE(list) << to_string(list.error());
  ASSERT_THAT(*list, SizeIs(2));
  const ListedSequence& first = list->front();
  EXPECT_EQ(first.name, "east");
  EXPECT_FALSE(first.is_named);
  EXPECT_EQ(first.input, "/data/halls/east/");
  EXPECT_FALSE(first.description || first.poses || first.up_axis || first.placement);
  EXPECT_TRUE(first.detections.empty());
  const ListedSequence& second = list->back();
  EXPECT_EQ(second.name, "the lab");
  EXPECT_TRUE(second.is_named);
  EXPECT_EQ(second.input, "/elsewhere/lab");
  EXPECT_EQ(second.description, "/data/lab.yaml");
  EXPECT_THAT(second.detections, ElementsAre("/data/a.jsonl", "/data/b.jsonl"));
  EXPECT_THAT(second.detector_names, ElementsAre("yolo"));
  EXPECT_EQ(second.poses, "/data/closed.txt");
  EXPECT_EQ(second.up_axis, "-y");
  ASSERT_TRUE(second.placement);
  EXPECT_EQ(second.placement->x_m, 4.2);
  EXPECT_EQ(second.placement->y_m, -1.0);
  EXPECT_EQ(second.placement->z_m, 0.5);
  EXPECT_DOUBLE_EQ(second.placement->yaw_rad, std::numbers::pi / 2.0);
}

TEST(SequenceList, AnEntryMayBeItsInputAlone) {
  const auto list = parsed("sequences: [a, b/c, ../d/.]\n");
  ASSERT_TRUE(list) << to_string(list.error());
  std::vector<std::string> names;
  for (const ListedSequence& sequence : *list) names.push_back(sequence.name);
  EXPECT_THAT(names, ElementsAre("a", "c", "d"));
}

TEST(SequenceList, RefusalsNameFileLineAndField) {
  EXPECT_THAT(refusal("sequences: []\n"), HasSubstr("must have 1 sequence or more"));
  EXPECT_THAT(refusal("sequence: [a]\n"), HasSubstr("did you mean \"sequences\"?"));
  EXPECT_THAT(refusal("sequences:\n- input: a\n  inputs: b\n"), StartsWith("list.yaml:"));
  EXPECT_THAT(refusal("sequences:\n- name: a\n"), HasSubstr("input"));
  EXPECT_THAT(refusal("sequences:\n- a\n- input: b/a\n"),
              HasSubstr("must have another name than the sequence of line 2, is a"));
  EXPECT_THAT(refusal("sequences:\n- input: a\n  transform: [0, 0, 0, 0]\n"),
              StartsWith("list.yaml:3: sequences[0].transform: is of the first sequence"));
  EXPECT_THAT(refusal("sequences: [b, {input: a, transform: [0, 0, 0]}]\n"),
              HasSubstr("sequences[1].transform"));
  EXPECT_THAT(refusal("sequences: [b, {input: a, transform: [1e9, 0, 0, 0]}]\n"),
              HasSubstr("within 32768 m"));
  EXPECT_THAT(refusal("sequences: [{input: a, up: down}]\n"), HasSubstr("must be one of x, -x"));
  EXPECT_THAT(refusal("sequences: [{input: a, detections: [a.json, {file: b, detector: c}]}]\n"),
              HasSubstr("must be said of the files before it, too"));
  EXPECT_THAT(refusal("sequences: [{input: ''}]\n"), HasSubstr("must be a path of 1 to 4096"));
}

TEST(SequenceList, NamesAreThoseOfFilesAndSessions) {
  EXPECT_EQ(refusal("sequences: [{input: a, name: 'Küche 2'}]\n"), "read");
  EXPECT_EQ(refusal("sequences: ['1', '2']\n"), "read") << "a folder may be called so";
  for (const char* name : {"''", "'a/b'", ".hidden", "..", "'1'", "' a'", "\"a\\nb\""}) {
    EXPECT_THAT(refusal(std::string("sequences: [{input: a, name: ") + name + "}]\n"),
                HasSubstr("name"))
        << name;
  }
  EXPECT_THAT(refusal("sequences: [{input: a, name: " + std::string(101, 'n') + "}]\n"),
              HasSubstr("1 to 100 bytes"));
  EXPECT_THAT(refusal("sequences: [/]\n"), HasSubstr("must have a name"));
}

TEST(SequenceList, HasLimits) {
  std::string text = "sequences:\n";
  for (std::size_t i = 0; i <= kMaxListedSequences; ++i) text += "- s" + std::to_string(i) + "\n";
  const auto list = parsed(text);
  ASSERT_FALSE(list);
  EXPECT_EQ(list.error().code, ErrorCode::kLimit);
}

TEST(SequenceList, AFilesPathsAreRelativeToItsFolder) {
  const test::TempDir folder;
  test::write_text(folder.path() / "lists/list.yaml", "sequences: [lab]\n");
  const auto list = read_sequence_list(folder.path() / "lists/list.yaml");
  ASSERT_TRUE(list) << to_string(list.error());
  EXPECT_EQ(list->front().input, folder.path() / "lists/lab");
  EXPECT_EQ(read_sequence_list(folder.path() / "none.yaml").error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace hypermap
