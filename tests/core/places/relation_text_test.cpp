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

TEST(Sentence, TellsWhatIsNearestBesideTheHolder) {
  RelationGraph graph{.relations = {{RelationKind::kOn, ObjectId{12}, ObjectId{3}, {}},
                                    {RelationKind::kBeside, ObjectId{1}, ObjectId{3}, {}},
                                    {RelationKind::kBeside, ObjectId{2}, ObjectId{3}, {}},
                                    {RelationKind::kBeside, ObjectId{3}, ObjectId{12}, {}}},
                      .supports = {{ObjectId{1}, SupportKind::kFloor, kNoObject},
                                   {ObjectId{2}, SupportKind::kFloor, kNoObject},
                                   {ObjectId{3}, SupportKind::kFloor, kNoObject},
                                   {ObjectId{12}, SupportKind::kObject, ObjectId{3}}}};
  graph.relations[1].evidence.gap_m = 0.6;
  graph.relations[2].evidence.gap_m = 0.2;
  EXPECT_EQ(sentence_of(graph, ObjectId{12}, numbered, "in the kitchen (room 2)"),
            "object 12 is in the kitchen (room 2), on object 3 by object 2, beside object 3");
}

}  // namespace
}  // namespace hypermap
