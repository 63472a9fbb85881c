// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/relation_evaluation.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hypermap {
namespace {

Relation link(RelationKind kind, std::uint32_t subject, std::uint32_t object) {
  return {kind, ObjectId{subject}, ObjectId{object}, {}};
}

TEST(RelationEvaluation, CountsWhatMapAndTruthSayOfMatchedObjects) {
  // Objects 1, 2, 3 of the map are 11, 12, 10 of the truth; 4 is false, 13 is not in the map.
  const std::map<ObjectId, ObjectId> truth_of{
      {ObjectId{1}, ObjectId{11}}, {ObjectId{2}, ObjectId{12}}, {ObjectId{3}, ObjectId{10}}};
  const std::vector<Relation> map{link(RelationKind::kOn, 1, 2),
                                  link(RelationKind::kOn, 3, 1),       // wrong
                                  link(RelationKind::kOn, 4, 2),       // of a false object
                                  link(RelationKind::kBeside, 1, 3)};  // 11 and 10: turned
  const std::vector<Relation> truth{link(RelationKind::kOn, 11, 12),
                                    link(RelationKind::kOn, 10, 12),
                                    link(RelationKind::kOn, 13, 12),  // of an object not mapped
                                    link(RelationKind::kBeside, 10, 11)};
  const RelationEvaluation found = evaluate_relations(map, truth, truth_of);
  EXPECT_EQ(found.of(RelationKind::kOn),
            (RelationCounts{.right = 1, .num_map = 2, .num_truth = 2}));
  EXPECT_EQ(found.of(RelationKind::kOn).precision(), 0.5);
  EXPECT_EQ(found.of(RelationKind::kOn).recall(), 0.5);
  EXPECT_EQ(found.of(RelationKind::kBeside).recall(), 1.0);
  EXPECT_FALSE(found.of(RelationKind::kIn).precision());
}

}  // namespace
}  // namespace hypermap
