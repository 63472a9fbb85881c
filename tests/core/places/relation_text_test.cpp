// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/relation_text.hpp"

#include <gtest/gtest.h>

#include <string>

namespace hypermap {
namespace {

std::string numbered(ObjectId id) {
  return "object " + std::to_string(id.value);
}

TEST(Sentence, SaysWhatAnObjectIsToOthers) {
  const RelationGraph graph{.relations = {{RelationKind::kOn, ObjectId{12}, ObjectId{3}, {}},
                                          {RelationKind::kBeside, ObjectId{7}, ObjectId{12}, {}}},
                            .supports = {{ObjectId{3}, SupportKind::kFloor, kNoObject},
                                         {ObjectId{7}, SupportKind::kUnknown, kNoObject},
                                         {ObjectId{8}, SupportKind::kUnknown, kNoObject},
                                         {ObjectId{12}, SupportKind::kObject, ObjectId{3}}}};
  EXPECT_EQ(sentence_of(graph, ObjectId{12}, numbered),
            "object 12 is on object 3, beside object 7");
  EXPECT_EQ(sentence_of(graph, ObjectId{3}, numbered), "object 3 is on the floor");
  EXPECT_EQ(sentence_of(graph, ObjectId{7}, numbered),
            "object 7 is beside object 12; what it stands on was not seen or has no class");
  EXPECT_EQ(sentence_of(graph, ObjectId{8}, numbered),
            "object 8: what it stands on was not seen or has no class");
  EXPECT_EQ(sentence_of(graph, ObjectId{12}, numbered, "in the kitchen (room 2)"),
            "object 12 is in the kitchen (room 2), on object 3, beside object 7");
  EXPECT_EQ(sentence_of(graph, ObjectId{8}, numbered, "in room 1"),
            "object 8 is in room 1; what it stands on was not seen or has no class");
}

}  // namespace
}  // namespace hypermap
