// SPDX-License-Identifier: BSD-3-Clause
// What is known about the thesis' laboratory must come out of queries on its archive.
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/projection/layers/hypermap_query.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

constexpr const char* kLaboratory = "hmap/semantic_gt_2019-04-23-12-51-46.hmap";
const QueryScope kSemantic{.layer = "semantic", .frame_id = "map"};

class KnownAnswers : public ::testing::Test {
 protected:
  void SetUp() override {
    HYPERMAP_REQUIRE_SHARED_DATA(kLaboratory);
    auto archive = load_archive(test::shared_data(kLaboratory));
    ASSERT_TRUE(archive) << to_string(archive.error());
    map_ = std::move(archive->value.hypermap);
  }

  [[nodiscard]] const Hypermap& map() const { return *map_; }

 private:
  std::optional<Hypermap> map_;
};

std::vector<std::string> names(const Result<std::vector<LayerAnswer>>& answers) {
  EXPECT_TRUE(answers) << (answers ? "" : to_string(answers.error()));
  return answers ? distinct_names(*answers) : std::vector<std::string>{};
}

TEST_F(KnownAnswers, TheSinkIsAtOnePlace) {
  const auto sinks = query_string(map(), kSemantic, "sink");
  ASSERT_TRUE(sinks);
  ASSERT_EQ(sinks->size(), 1U);
  EXPECT_NEAR(sinks->front().position.x(), 3.259, 0.001);
  EXPECT_NEAR(sinks->front().position.y(), 2.378, 0.001);
}

TEST_F(KnownAnswers, OneChairIsInTheArea) {
  const Polygon area = *make_polygon({{2, 2}, {2, 3}, {1, 3}, {1, 2}});
  const auto chairs = query_string(map(), kSemantic, "chair", area);
  ASSERT_TRUE(chairs);
  ASSERT_EQ(chairs->size(), 1U);
  EXPECT_NEAR(chairs->front().position.x(), 1.429, 0.001);
  EXPECT_NEAR(chairs->front().position.y(), 2.887, 0.001);
}

TEST_F(KnownAnswers, ATableStandsAtAPoint) {
  EXPECT_THAT(names(query_at(map(), kSemantic, {3, -2})), ElementsAre("table"));
}

TEST_F(KnownAnswers, ThreeKindsOfThingsAreInAnArea) {
  const Polygon area = *make_polygon({{3, -2}, {3, -1}, {2, -1}, {2, -2}});
  EXPECT_THAT(names(query_area(map(), kSemantic, area)),
              UnorderedElementsAre("table", "tvmonitor", "chair"));
}

TEST_F(KnownAnswers, TheOccupancyLayerAnswersToo) {
  const auto answers = query_at(map(), {.layer = "occupancy"}, {1, 1});
  ASSERT_TRUE(answers);
  ASSERT_EQ(answers->size(), 1U);
  EXPECT_THAT(answers->front().value, ::testing::AllOf(::testing::Ge(-1), ::testing::Le(100)));
}

}  // namespace
}  // namespace hypermap
