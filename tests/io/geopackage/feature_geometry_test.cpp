// SPDX-License-Identifier: BSD-3-Clause
#include "feature_geometry.hpp"

#include "hypermap/io/codec/number_bytes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;

// A triangle with a hole: head 8 bytes, envelope 32, multipolygon 9, polygon 9, rings 4 + 4 * 16.
TEST(FeatureGeometry, IsHeadEnvelopeAndWkb) {
  const Polygon triangle{.outer = {{1, 2}, {5, 2}, {1, 8}}, .holes = {{{2, 3}, {2, 4}, {3, 3}}}};
  const std::string bytes = feature_geometry({&triangle, 1});
  ASSERT_EQ(bytes.size(), 8U + 32U + 9U + 9U + 2U * 68U);
  EXPECT_EQ(bytes.substr(0, 8), std::string("GP\0\x03\xFF\xFF\xFF\xFF", 8));
  EXPECT_THAT(doubles_of_bytes(bytes.substr(8, 32)).value(), ElementsAre(1, 5, 2, 8));
  EXPECT_EQ(bytes[40], 1) << "little endian";
  EXPECT_EQ(uint32_at(bytes, 41), 6U) << "multipolygon";
  EXPECT_EQ(uint32_at(bytes, 45), 1U) << "of one";
  EXPECT_EQ(bytes[49], 1);
  EXPECT_EQ(uint32_at(bytes, 50), 3U) << "polygon";
  EXPECT_EQ(uint32_at(bytes, 54), 2U) << "of two rings";
  EXPECT_EQ(uint32_at(bytes, 58), 4U);
  EXPECT_THAT(doubles_of_bytes(bytes.substr(62, 64)).value(), ElementsAre(1, 2, 5, 2, 1, 8, 1, 2));
  EXPECT_EQ(uint32_at(bytes, 126), 4U);
  EXPECT_THAT(doubles_of_bytes(bytes.substr(130, 64)).value(), ElementsAre(2, 3, 2, 4, 3, 3, 2, 3));
}

TEST(FeatureGeometry, TheEnvelopeIsAroundAllParts) {
  const std::vector<Polygon> parts{{.outer = {{0, 0}, {1, 0}, {0, 1}}, .holes = {}},
                                   {.outer = {{-4, 7}, {-3, 7}, {-4, 9}}, .holes = {}}};
  const std::string bytes = feature_geometry(parts);
  EXPECT_THAT(doubles_of_bytes(bytes.substr(8, 32)).value(), ElementsAre(-4, 1, 0, 9));
  EXPECT_EQ(uint32_at(bytes, 45), 2U);
}

}  // namespace
}  // namespace hypermap
