// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/similar_query.hpp"

#include "core/places/furniture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using namespace testing_support;  // NOLINT(google-build-using-namespace): builders in words

/// Cups in a row, which look like `vectors` to "clip" where these are not empty.
MapArchive row_of_cups(const std::vector<std::vector<float>>& vectors) {
  FurnishedRoom room;
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    room.add(i % 2 == 0 ? "cup" : "book", standing(static_cast<double>(i), 0, 0, {0.1, 0.1, 0.1}));
  }
  MapArchive archive;
  archive.objects = std::move(room.objects);
  archive.classes = std::move(room.classes);
  std::uint32_t id = 1;
  for (const std::vector<float>& vector : vectors) {
    const ObjectId object{id++};
    if (vector.empty()) continue;
    archive.objects.modify(object, [&](Object& one) {
      one.embeddings.observe(std::vector<Embedding>{{"clip", vector}});
    });
  }
  return archive;
}

std::vector<std::uint64_t> ids_like(const MapArchive& archive,
                                    const SimilarTo& similar_to,
                                    const MapQuery& query = {}) {
  const auto answers = query_similar(archive, similar_to, query);
  EXPECT_TRUE(answers) << to_string(answers.error());
  std::vector<std::uint64_t> ids;
  if (!answers) return ids;
  for (const MapAnswer& one : answers->found) ids.push_back(one.id);
  return ids;
}

std::string similar_refusal(const MapArchive& archive, const SimilarTo& similar_to) {
  const auto answers = query_similar(archive, similar_to, {});
  return answers ? "none" : to_string(answers.error());
}

// cos of (4, 3) with (1, 0): 0.8; with (0, 1): 0.6; with (3, 4): 24 / 25; with (-4, -3): -1.
TEST(SimilarQuery, RanksByTheCosineAndEqualsByTheirIds) {
  const MapArchive archive = row_of_cups({{0, 1}, {1, 0}, {}, {3, 4}, {-4, -3}, {0, 9}});
  EXPECT_THAT(ids_like(archive, {.vector = {4, 3}}), ElementsAre(4, 2, 1, 6, 5));
  const MapAnswers answers = query_similar(archive, {.vector = {4, 3}}, {}).value();
  EXPECT_NEAR(answers.found[0].similarity.value(), 0.96, 1e-7);
  EXPECT_NEAR(answers.found[1].similarity.value(), 0.8, 1e-7);
  EXPECT_NEAR(answers.found[4].similarity.value(), -1.0, 1e-7);
}

TEST(SimilarQuery, TellsTheFirstOfThoseThatFulfilTheConditions) {
  const MapArchive archive = row_of_cups({{0, 1}, {1, 0}, {}, {3, 4}, {-4, -3}, {0, 9}});
  EXPECT_THAT(ids_like(archive, {.vector = {4, 3}, .top = 2}), ElementsAre(4, 2));
  EXPECT_THAT(ids_like(archive, {.vector = {4, 3}}, {.text = "cup"}), ElementsAre(1, 5));
  EXPECT_THAT(ids_like(archive, {.vector = {4, 3}}, {.value = 3}), IsEmpty());
}

TEST(SimilarQuery, RanksPlantedVectorsAsBruteForceDoes) {
  std::mt19937 random(3);
  std::normal_distribution<float> number;
  const auto any_vector = [&] {
    std::vector<float> vector(32);
    std::ranges::generate(vector, [&] { return number(random); });
    return vector;
  };
  std::vector<std::vector<float>> planted(40);
  std::ranges::generate(planted, any_vector);
  const MapArchive archive = row_of_cups(planted);
  for (int round = 0; round < 10; ++round) {
    const std::vector<float> asked = any_vector();
    std::vector<std::pair<double, std::uint64_t>> expected;
    for (std::size_t i = 0; i < planted.size(); ++i) {
      long double dot = 0;
      long double square = 0;
      for (std::size_t k = 0; k < asked.size(); ++k) {
        dot += static_cast<long double>(planted[i][k]) * static_cast<long double>(asked[k]);
        square += static_cast<long double>(planted[i][k]) * static_cast<long double>(planted[i][k]);
      }
      expected.emplace_back(static_cast<double>(-dot / std::sqrt(square)), i + 1);
    }
    std::ranges::sort(expected);
    std::vector<std::uint64_t> ids;
    ids.reserve(expected.size());
    for (const auto& [similarity, id] : expected) ids.push_back(id);
    EXPECT_EQ(ids_like(archive, {.vector = asked, .top = 40}), ids);
  }
}

TEST(SimilarQuery, AsksOneModel) {
  MapArchive archive = row_of_cups({{0, 1}, {1, 0}});
  archive.objects.modify(ObjectId{1}, [](Object& one) {
    one.embeddings.observe(std::vector<Embedding>{{"dino", {1, 2, 3}}});
  });
  EXPECT_THAT(similar_refusal(archive, {.vector = {1, 0}}),
              HasSubstr("model: must be one of clip, dino"));
  EXPECT_THAT(ids_like(archive, {.vector = {1, 0}, .model = "clip"}), ElementsAre(2, 1));
  EXPECT_THAT(ids_like(archive, {.vector = {1, 0, 0}, .model = "dino"}), ElementsAre(1));
  EXPECT_THAT(similar_refusal(archive, {.vector = {1}, .model = "clop"}), HasSubstr("clip"));
}

TEST(SimilarQuery, WhatCannotBeComparedIsSaid) {
  const MapArchive archive = row_of_cups({{0, 1}});
  EXPECT_THAT(similar_refusal(archive, {.vector = {1, 2, 3}}),
              HasSubstr("must have 2 numbers as those of model clip, has 3"));
  EXPECT_THAT(similar_refusal(archive, {.vector = {0, 0}}), HasSubstr("is all 0"));
  EXPECT_THAT(similar_refusal(row_of_cups({{}}), {.vector = {1}}),
              HasSubstr("no object of the map has an embedding"));
}

}  // namespace
}  // namespace hypermap
