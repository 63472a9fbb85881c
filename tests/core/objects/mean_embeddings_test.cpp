// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/mean_embeddings.hpp"

#include "hypermap/core/objects/object_map.hpp"
#include "support/object_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::FloatEq;
using ::testing::HasSubstr;
using testing_support::box_at;
using testing_support::observed;
using testing_support::scores;
using testing_support::surface_of;

MeanEmbeddings observing(const std::vector<Embedding>& all) {
  MeanEmbeddings means;
  for (const Embedding& one : all) means.observe(std::vector{one});
  return means;
}

// (3, 4) counts as (0.6, 0.8) and (0, 10) as (0, 1): their mean is (0.3, 0.9). With (-2, 0), which
// is
// (-1, 0): ((0.6 + 0 - 1) / 3, (0.8 + 1 + 0) / 3) = (-0.13333, 0.6).
TEST(MeanEmbeddings, AreMeansOfUnitVectors) {
  const MeanEmbeddings two = observing({{"m", {3, 4}}, {"m", {0, 10}}});
  EXPECT_EQ(two.find("m")->count, 2U);
  EXPECT_THAT(two.find("m")->mean, ElementsAre(FloatEq(0.3F), FloatEq(0.9F)));
  const MeanEmbeddings three = observing({{"m", {3, 4}}, {"m", {0, 10}}, {"m", {-2, 0}}});
  EXPECT_THAT(three.find("m")->mean, ElementsAre(FloatEq(-0.4F / 3.0F), FloatEq(0.6F)));
}

TEST(MeanEmbeddings, KeepModelsApartInTheOrderOfTheirNames) {
  const MeanEmbeddings means = observing({{"z", {1, 0}}, {"a", {0, 0, 1}}, {"z", {0, 1}}});
  ASSERT_EQ(means.entries().size(), 2U);
  EXPECT_EQ(means.entries()[0].model, "a");
  EXPECT_EQ(means.entries()[1].count, 2U);
  EXPECT_EQ(means.find("b"), nullptr);
}

TEST(MeanEmbeddings, OfAFifthModelOrAnotherDimensionNothingIsTakenIn) {
  MeanEmbeddings means = observing({{"d", {1}}, {"c", {1}}, {"b", {1}}, {"e", {1}}});
  const MeanEmbeddings before = means;
  means.observe(std::vector<Embedding>{{"a", {1}}});
  means.observe(std::vector<Embedding>{{"b", {1, 1}}});
  means.merge(observing({{"a", {1}}, {"c", {1, 1}}}));
  EXPECT_EQ(means, before);
}

// 3 x (1, 0) and 1 x (0, 1): (3/4, 1/4).
TEST(MeanEmbeddings, MergedOnesAreWeightedByTheirCounts) {
  MeanEmbeddings means = observing({{"m", {1, 0}}, {"m", {2, 0}}, {"m", {3, 0}}});
  means.merge(observing({{"m", {0, 5}}, {"other", {1}}}));
  EXPECT_EQ(means.find("m")->count, 4U);
  EXPECT_THAT(means.find("m")->mean, ElementsAre(FloatEq(0.75F), FloatEq(0.25F)));
  EXPECT_EQ(means.find("other")->count, 1U);
}

TEST(MeanEmbeddings, MergingIsAsObservingAll) {
  std::mt19937 random(7);
  std::normal_distribution<float> number;
  for (int round = 0; round < 50; ++round) {
    std::vector<Embedding> all;
    for (int i = 0; i < 20; ++i) {
      std::vector<float> vector(8);
      std::ranges::generate(vector, [&] { return number(random); });
      all.push_back({i % 3 == 0 ? "a" : "b", vector});
    }
    const auto middle = all.begin() + round % 21;
    MeanEmbeddings merged = observing({all.begin(), middle});
    merged.merge(observing({middle, all.end()}));
    const MeanEmbeddings whole = observing(all);
    for (const MeanEmbedding& expected : whole.entries()) {
      const MeanEmbedding* found = merged.find(expected.model);
      ASSERT_NE(found, nullptr);
      EXPECT_EQ(found->count, expected.count);
      for (std::size_t i = 0; i < expected.mean.size(); ++i) {
        EXPECT_NEAR(found->mean[i], expected.mean[i], 1e-6);
      }
    }
  }
}

TEST(MeanEmbeddings, StoredOnesAreChecked) {
  const auto refusal = [](std::vector<MeanEmbedding> entries) {
    return to_string(MeanEmbeddings::restore(std::move(entries)).error());
  };
  EXPECT_THAT(refusal({{"m", 0, {1}}}), HasSubstr("count: must be > 0"));
  EXPECT_THAT(refusal({{"m", 1, {}}}), HasSubstr("has 0"));
  EXPECT_THAT(refusal({{"m", 1, {0.8F, 0.8F}}}), HasSubstr("length of at most 1"));
  EXPECT_THAT(refusal({{"m", 1, {std::numeric_limits<float>::quiet_NaN()}}}), HasSubstr("length"));
  EXPECT_THAT(refusal({{"m", 1, {1}}, {"m", 1, {1}}}), HasSubstr("m is there twice"));
  EXPECT_EQ(MeanEmbeddings::restore(std::vector<MeanEmbedding>(5, {"m", 1, {1}})).error().code,
            ErrorCode::kLimit);
  const MeanEmbeddings kept = observing({{"a", {1, 2}}, {"b", {3}}});
  EXPECT_EQ(MeanEmbeddings::restore({kept.entries()[1], kept.entries()[0]}).value(), kept);
  EXPECT_TRUE(MeanEmbeddings::restore({{"m", 2, {0, 0}}}));
}

Observation looking_like(std::vector<float> vector, std::uint64_t frame_index = 0) {
  Observation seen = observed(
      surface_of(box_at({1, 1, 0.2}, {0.4, 0.4, 0.4})), scores(ClassId{3}, 0.8), frame_index);
  if (!vector.empty()) seen.embeddings = {{"m", std::move(vector)}};
  return seen;
}

TEST(MeanEmbeddings, BelongToTheObjectThatAnObservationIsMatchedWith) {
  ObjectMap objects;
  associate(objects, std::vector{looking_like({1, 0})}, {});
  associate(objects, std::vector{looking_like({}, 1)}, {});
  associate(objects, std::vector{looking_like({0, 1}, 2)}, {});
  ASSERT_EQ(objects.size(), 1U);
  const Object& object = *objects.objects().begin();
  EXPECT_EQ(object.num_observations, 3U);
  EXPECT_EQ(object.embeddings.find("m")->count, 2U);
  EXPECT_THAT(object.embeddings.find("m")->mean, ElementsAre(FloatEq(0.5F), FloatEq(0.5F)));
  EXPECT_EQ(embedding_dimensions(objects)->find("m"), 2U);
}

TEST(MeanEmbeddings, OfMergedObjectsAreMerged) {
  Object a = make_object(looking_like({1, 0}), {});
  Object b = make_object(looking_like({0, 1}), {});
  a.id = ObjectId{1};
  b.id = ObjectId{2};
  EXPECT_THAT(merged(a, b, LogOdds(20.0)).embeddings.find("m")->mean,
              ElementsAre(FloatEq(0.5F), FloatEq(0.5F)));
}

TEST(MeanEmbeddings, OfObjectsThatDifferInTheirDimensionAreRefused) {
  ObjectMap objects;
  objects.add(make_object(looking_like({1, 0}), {}));
  objects.add(make_object(looking_like({1, 0, 0}), {}));
  EXPECT_THAT(to_string(embedding_dimensions(objects).error()),
              HasSubstr("object 2: vector: of model \"m\" must have 2 numbers"));
}

}  // namespace
}  // namespace hypermap
