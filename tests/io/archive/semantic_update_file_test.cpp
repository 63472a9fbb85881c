// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/semantic_update_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

const SourceName kUpdateSource{.file = "changes.yaml"};

std::string refused_update(const std::string& yaml) {
  const auto update = parse_semantic_update(yaml, kUpdateSource);
  EXPECT_FALSE(update) << yaml;
  return update ? "" : to_string(update.error());
}

TEST(SemanticUpdateFile, HasThreeLists) {
  const auto read = parse_semantic_update(
      "add:\n"
      "- {name: sofa, shape: 'POLYGON((0 0,1 0,1 1,0 0))', id: 40, tags: [soft], confidence: 0.5}\n"
      "- {name: plant, shape: 'POLYGON((0 0,1 0,1 1,0 0))'}\n"
      "modify:\n"
      "- {id: 7, name: desk, owner: me}\n"
      "- {id: 8, shape: 'POLYGON((0 0, 2 0, 2 2))', tags: ~, confidence: 0.1}\n"
      "delete: [3, 9]\n",
      kUpdateSource);
  ASSERT_TRUE(read) << to_string(read.error());
  const SemanticUpdate& update = read->value;
  ASSERT_THAT(update.to_add, SizeIs(1));
  EXPECT_EQ(update.to_add[0].id, 40U);
  EXPECT_THAT(update.to_add[0].tags, ElementsAre("soft"));
  ASSERT_THAT(update.to_number, SizeIs(1));
  EXPECT_EQ(update.to_number[0].name, "plant");
  ASSERT_THAT(update.to_modify, SizeIs(2));
  EXPECT_EQ(update.to_modify[0].name, "desk");
  EXPECT_FALSE(update.to_modify[0].parts);
  EXPECT_FALSE(update.to_modify[0].tags);
  EXPECT_EQ(update.to_modify[0].extra.entries.at(0).first, "owner");
  EXPECT_FALSE(update.to_modify[1].name);
  EXPECT_EQ(update.to_modify[1].parts.value().size(), 1U);
  EXPECT_EQ(update.to_modify[1].shape_text, "") << "it was mended, and is written as it was read";
  EXPECT_THAT(update.to_modify[1].tags.value(), SizeIs(0));
  EXPECT_THAT(update.to_modify[1].confidence.value(), ElementsAre(0.1));
  EXPECT_THAT(update.to_delete, ElementsAre(3, 9));
  // The unclosed ring, and the key that nobody knows.
  EXPECT_THAT(read->findings, SizeIs(2));
}

TEST(SemanticUpdateFile, NamesWhatIsWrongAndWhere) {
  EXPECT_EQ(refused_update("add: []\ndeleet: [3]\n"),
            "changes.yaml:2: deleet: unknown key \"deleet\", did you mean \"delete\"?");
  EXPECT_THAT(refused_update("{}\n"), HasSubstr("has none of the keys add, modify and delete"));
  EXPECT_THAT(refused_update("- {name: a}\n"), HasSubstr("changes.yaml:1"));
  EXPECT_THAT(refused_update("modify:\n- {name: chair}\n"),
              HasSubstr("changes.yaml:2: modify[0] (chair).id: the key is missing"));
  EXPECT_THAT(refused_update("modify:\n- {id: -1}\n"), HasSubstr("changes.yaml:2: modify[0].id: "));
  EXPECT_EQ(refused_update("modify:\n- {id: 5}\n"),
            "changes.yaml:2: modify[0]: has no key beside id, so nothing would change");
  EXPECT_THAT(refused_update("delete: [1, x]\n"), HasSubstr("delete[1]: "));
  EXPECT_THAT(refused_update("delete: 7\n"), HasSubstr("delete: "));
  EXPECT_THAT(refused_update("add:\n- {name: tie, shape: 'POLYGON((0 0,1 1,1 0,0 1,0 0))'}\n"),
              HasSubstr("changes.yaml:2: add[0] (tie).shape: "));
  EXPECT_THAT(refused_update("modify:\n- {id: 1, name: ''}\n"), HasSubstr("is empty"));
  EXPECT_THAT(refused_update("modify:\n- {id: 1, tags: [a], confidence: [0.1, 0.2]}\n"),
              HasSubstr("has 2 values for 1 tags"));
  EXPECT_THAT(refused_update("modify:\n- {id: 1, confidence: 2}\n"), HasSubstr("confidence: "));
}

TEST(SemanticUpdateFile, AMissingFileIsNamed) {
  const auto read = read_semantic_update("/nowhere/changes.yaml");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kIo);
  EXPECT_THAT(to_string(read.error()), HasSubstr("/nowhere/changes.yaml"));
}

}  // namespace
}  // namespace hypermap
