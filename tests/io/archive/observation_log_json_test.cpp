// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/object_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::HasSubstr;
using testing::Not;

const SourceName kLoggedSource{.file = "a.hmap", .entry = "objects.jsonl"};
const std::string kTwoChanges = ",1.25,[[7,-0.413],[0,0.1]]]";

/// One object of one observation, which changed two other classes.
ObjectMap logged(const std::vector<BeliefChange>& changes) {
  Object object;
  object.box.max_in_map = {1, 1, 1};
  object.observation_log.add({.class_id = ClassId{2},
                              .effect = 0.5F,
                              .belief_change = 1.25F,
                              .other_changes = BeliefChanges::from_entries(changes).value()});
  ObjectMap objects;
  objects.add(object);
  return objects;
}

ObjectMap logged_with_two() {
  return logged({{ClassId{7}, -0.413F}, {ClassId{0}, 0.1F}});
}

/// With `to` instead of `from` in the newest entry.
std::string changed_newest(const std::string& from, const std::string& to) {
  std::string text = write_objects(logged_with_two()).value();
  const std::size_t at = text.find(from, text.find("\"newest\""));
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string log_error(const std::string& text) {
  const auto objects = parse_objects(text, kLoggedSource);
  return objects ? "no error" : to_string(objects.error());
}

TEST(ObservationLogJson, ChangesOfOtherClassesSurviveAndCostNothingWhereThereAreNone) {
  const std::string text = write_objects(logged_with_two()).value();
  EXPECT_THAT(text, HasSubstr(kTwoChanges));
  EXPECT_EQ(parse_objects(text, kLoggedSource).value(), logged_with_two());
  EXPECT_EQ(write_objects(parse_objects(text, kLoggedSource).value()).value(), text);
  const std::string without = write_objects(logged({})).value();
  EXPECT_THAT(without, HasSubstr(",0.5,1.25]"));
  EXPECT_EQ(parse_objects(without, kLoggedSource).value(), logged({}));
}

TEST(ObservationLogJson, OlderArchivesHaveChangesOfTheNamedClassOrNone) {
  const auto newest_of = [](const std::string& text) {
    const auto objects = parse_objects(text, kLoggedSource);
    EXPECT_TRUE(objects) << log_error(text);
    return objects ? objects->at(ObjectId{1}).observation_log.state().newest.at(0)
                   : ObservationLogEntry{};
  };
  const ObservationLogEntry named = newest_of(changed_newest(kTwoChanges, ",1.25]"));
  EXPECT_EQ(named.belief_change, 1.25F);
  EXPECT_EQ(named.other_changes, BeliefChanges{});
  const ObservationLogEntry none = newest_of(changed_newest(kTwoChanges, "]"));
  EXPECT_EQ(none.effect, 0.5F);
  EXPECT_EQ(none.belief_change, 0.0F);
}

TEST(ObservationLogJson, WhatNoLogHoldsIsNamedByItsPath) {
  const auto error_of = [](const std::string& changes) {
    return log_error(changed_newest("[[7,-0.413],[0,0.1]]", changes));
  };
  const std::string member = "a.hmap!objects.jsonl:2: $.ledger.newest[0]";
  EXPECT_THAT(error_of("[[7,-0.413],[7,0.1]]"),
              HasSubstr(member + "[11]: belief_changes must have a class once"));
  EXPECT_THAT(error_of("[[7,0.1],[0,-0.413]]"),
              HasSubstr(member + "[11]: belief_changes must have the larger"));
  EXPECT_THAT(error_of("[[7,0]]"),
              HasSubstr(member + "[11]: belief_changes must be finite and not 0"));
  EXPECT_THAT(error_of("[[1,5],[3,4],[4,3],[5,2],[6,1]]"),
              HasSubstr("at most 4 classes, are of 5"));
  EXPECT_THAT(error_of("[[7,\"x\"]]"), HasSubstr(member + "[11][0][1]"));
  EXPECT_THAT(error_of("[[-1,0.5]]"), HasSubstr(member + "[11][0][0]"));
  EXPECT_THAT(error_of("[[7]]"), HasSubstr(member + "[11][0]"));
  EXPECT_THAT(error_of("7"), HasSubstr(member + "[11]"));
  EXPECT_THAT(error_of("[[2,0.5]]"),
              HasSubstr("$.ledger: ledger has an entry whose other changes"));
  EXPECT_THAT(log_error(changed_newest(kTwoChanges, ",1.25,[],3]")), HasSubstr(member + ":"));
}

}  // namespace
}  // namespace hypermap
