// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/wkt.hpp"

#include "support/sanitized.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

WktShape shape(const std::string& text) {
  const auto read = read_wkt(text);
  EXPECT_TRUE(read) << text << " " << (read ? "" : to_string(read.error()));
  return read ? *read : WktShape{};
}

std::string refused_wkt(const std::string& text) {
  const auto read = read_wkt(text);
  EXPECT_FALSE(read) << text;
  return read ? "" : to_string(read.error());
}

TEST(Wkt, APolygonIsReadInAnyOrientationClosedOrNot) {
  const Polygon square = *make_polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  for (const char* text : {"POLYGON((0 0,1 0,1 1,0 1,0 0))",
                           "POLYGON((0 0,0 1,1 1,1 0,0 0))",
                           "polygon ( ( 0 0 , 1 0\t, 1 1,0 1 ) ) ",
                           "POLYGON((0 0,1 0,1 0,1 1,0 1,0 0))",
                           "POLYGON((0 -0.0,+1 0,1.0 1e0,0 .1e1,0 0))"}) {
    const WktShape read = shape(text);
    ASSERT_EQ(read.parts.size(), 1U);
    EXPECT_DOUBLE_EQ(area_m2(read.parts[0]), 1.0) << text;
    EXPECT_DOUBLE_EQ(jaccard(read.parts[0], square), 1.0) << text;
  }
  EXPECT_EQ(shape("POLYGON((0 0,1 0,1 1))").unclosed_rings, 1U);
  EXPECT_EQ(shape("POLYGON((0 0,1 0,1 1,0 0))").unclosed_rings, 0U);
}

TEST(Wkt, AHoleIsNoPartOfTheArea) {
  const WktShape read = shape("POLYGON((0 0,0 4,4 4,4 0,0 0),(1 1,2 1,2 2,1 2,1 1))");
  EXPECT_DOUBLE_EQ(area_m2(read.parts[0]), 15.0);
  EXPECT_FALSE(contains(read.parts[0], {1.5, 1.5}));
}

TEST(Wkt, SeveralDisjointPartsAreOneShape) {
  EXPECT_EQ(shape("MULTIPOLYGON(((0 0,1 0,1 1,0 0)),((5 0,6 0,6 1,5 0)))").parts.size(), 2U);
  EXPECT_EQ(shape("MULTIPOLYGON(((0 0,1 0,1 1,0 1)),((1 0,2 0,2 1,1 1)))").parts.size(), 2U);
  EXPECT_THAT(refused_wkt("MULTIPOLYGON(((0 0,0 2,2 2,2 0,0 0)),((1 1,1 3,3 3,3 1,1 1)))"),
              HasSubstr("overlap"));
}

TEST(Wkt, ARingWoundTwiceStandsForItsFill) {
  // The same square, twice around.
  const WktShape read = shape("POLYGON((0 0,1 0,1 1,0 1,0 0,1 0,1 1,0 1,0 0))");
  EXPECT_EQ(read.wound_rings, 1U);
  ASSERT_EQ(read.parts.size(), 1U);
  EXPECT_DOUBLE_EQ(area_m2(read.parts[0]), 1.0);
}

TEST(Wkt, OneMissingCommaInARingIsMendedAndCounted) {
  // As in map_office_small_sem_gt.hmap: the last two points stand without a comma.
  const WktShape read = shape("POLYGON((0 0, 2 0, 2 1 0 1))");
  EXPECT_EQ(read.missing_commas, 1U);
  EXPECT_DOUBLE_EQ(area_m2(read.parts.at(0)), 2.0);
  refused_wkt("POLYGON((0 0 1 0,1 1 0 1))");  // twice: points of four numbers
  refused_wkt("POLYGON((0 0 5,1 0 5,1 1 5))");
}

TEST(Wkt, ErrorsNameTheColumn) {
  EXPECT_EQ(refused_wkt("POLYGON((0 0,nan 0,1 1))"),
            "column 14: is 'nan 0,1 1))', expected a finite number");
  EXPECT_THAT(refused_wkt("POLYGON((0 0,1 0,1 1))x"), HasSubstr("column 23: text follows"));
  EXPECT_THAT(refused_wkt("POLYGON((0 0 5,1 0 5,1 1 5))"), HasSubstr("column 14: is '5"));
  EXPECT_THAT(refused_wkt("POLYGON((0 0,1,1 1,0 0))"), HasSubstr("column 15"));
  EXPECT_THAT(refused_wkt("POLYGON((0 0,1 1,1 0,0 1,0 0))"), HasSubstr("column 9"));
}

TEST(Wkt, WhatIsNoShapeIsRefused) {
  for (const char* text :
       {"",
        " ",
        "POLYGON",
        "POLYGON(",
        "POLYGON(())",
        "POLYGON((0 0))",
        "POLYGON((0 0,1 1))",
        "POLYGON((0 0,1 1,2 2))",
        "POLYGON((0 0,1 0,1 1)",
        "POLYGON((0 0,1 0,1 1)))",
        "POLYGON((0;0,1;0,1;1))",
        "POLYGON((0x0 0,1 0,1 1))",
        "POLYGON((a b,c d,e f))",
        "POLYGON((inf 0,1 0,1 1))",
        "POLYGON((1e400 0,1 0,1 1))",
        "POLYGON((1e308 0,1 0,1 1e308))",
        "POLYGON((1e9 1e9,1e9 2e9,2e9 2e9,1e9 1e9))",
        "POLYGON((0 0,0 9,9 9,9 0,0 0),(1 1,5 1,5 5,1 5,1 1),(2 2,6 2,6 6,2 6,2 2))",
        "POLYGON((0 0,1 0,1 1,0 1),(5 5,6 5,6 6,5 6))",
        "POLYGON((0,0 1,0 1,1))",
        "MULTIPOLYGON((0 0,1 0,1 1))",
        "POLYGON EMPTY",
        "POLYGON Z((0 0 0,1 0 0,1 1 0))"}) {
    EXPECT_FALSE(read_wkt(text)) << text;
  }
}

TEST(Wkt, SpikesAreDroppedAndTheirRingsCounted) {
  const auto shape = read_wkt("POLYGON((0 0,0 1,1 1,5 1,1 1,1 0,0 0))").value();
  EXPECT_EQ(shape.spiked_rings, 1U);
  EXPECT_EQ(shape.wound_rings, 0U);
  ASSERT_EQ(shape.parts.size(), 1U);
  EXPECT_EQ(area_m2(shape.parts[0]), 1.0);
  // A hole with a spike, too; and a ring that is wound twice.
  const auto holed =
      read_wkt("POLYGON((0 0,9 0,9 9,0 9,0 0),(1 1,2 1,2 2,2 4,2 2,1 2,1 1))").value();
  EXPECT_EQ(holed.spiked_rings, 1U);
  EXPECT_EQ(area_m2(holed.parts.at(0)), 80.0);
  const auto wound = read_wkt("POLYGON((0 0,2 0,2 2,0 2,0 0,2 0,2 2,5 2,2 2,0 2,0 0))").value();
  EXPECT_EQ(wound.spiked_rings, 1U);
  EXPECT_EQ(wound.wound_rings, 1U);
  EXPECT_NEAR(area_m2(wound.parts.at(0)), 4.0, 1e-9);
}

TEST(Wkt, OtherGeometriesAreRefusedByName) {
  EXPECT_THAT(refused_wkt("POINT(1 2)"), HasSubstr("POINT is not read"));
  EXPECT_THAT(refused_wkt("GEOMETRYCOLLECTION(POINT(1 2))"), HasSubstr("GEOMETRYCOLLECTION"));
  EXPECT_THAT(refused_wkt("SRID=4326;POLYGON((0 0,0 1,1 1))"), HasSubstr("SRID is not read"));
}

TEST(Wkt, VerticesAndPartsAreLimited) {
  EXPECT_EQ(read_wkt("POLYGON((0 0,1 0,1 1,0 1))", {.max_vertices = 3}).error().code,
            ErrorCode::kLimit);
  EXPECT_EQ(read_wkt("POLYGON((0 0,9 0,9 9),(1 .1,2 .1,2 .2),(3 .1,4 .1,4 .2))", {.max_holes = 1})
                .error()
                .code,
            ErrorCode::kLimit);
  std::string many = "MULTIPOLYGON(((0 0,1 0,1 1))";
  for (int i = 1; i <= 100; ++i) {
    const std::string x = std::to_string(2 * i);
    many.append(",((").append(x).append(" 0,").append(x).append(" 1,0 7))");
  }
  EXPECT_EQ(read_wkt(many + ")").error().code, ErrorCode::kLimit);
}

TEST(Wkt, WhatIsWrittenReadsTheSame) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> wobble(-0.1, 0.1);
  for (int i = 0; i < 50; ++i) {
    const auto at = [&](double x, double y) {
      return Eigen::Vector2d(x + wobble(random), y + wobble(random));
    };
    const std::vector<Polygon> parts = {
        *make_polygon({at(0, 0), at(4, 0), at(4, 4), at(0, 4)}, {{at(1, 1), at(2, 1), at(1, 2)}}),
        *make_polygon({at(10, 0), at(11, 0), at(10, 1e-3 + 1)})};
    EXPECT_EQ(shape(write_wkt(parts)).parts, parts);
    const std::vector<Polygon> one = {parts[0]};
    EXPECT_EQ(shape(write_wkt(one)).parts, one);
  }
  EXPECT_EQ(write_wkt(std::vector{*make_polygon({{0, 0}, {0.1, 0}, {0.1, 1}})}),
            "POLYGON((0 0,0.1 0,0.1 1,0 0))");
}

TEST(Wkt, TheFillOfARingMayHaveAHoleThatTouchesIt) {
  // Around a square, in at its corner (0, 0), around a triangle the other way, and out.
  const WktShape read = shape("POLYGON((0 0,4 0,4 4,0 4,0 0,1 3,3 1,0 0))");
  EXPECT_EQ(read.wound_rings, 1U);
  ASSERT_EQ(read.parts.size(), 1U);
  EXPECT_EQ(read.parts[0].holes.size(), 1U);
  EXPECT_DOUBLE_EQ(area_m2(read.parts[0]), 12.0);
  EXPECT_EQ(shape(write_wkt(read.parts)).parts, read.parts);
}

/// A ring of whole coordinates below `range`, which crosses and touches itself more often than not.
std::string random_ring_text(std::mt19937& random, std::size_t num_points, unsigned range) {
  std::string text = "(";
  for (std::size_t i = 0; i < num_points; ++i) {
    text += (i == 0 ? "" : ",") + std::to_string(random() % range) + " ";
    text += std::to_string(random() % range) + (random() % 3 == 0 ? ".3" : "");
  }
  return text + ")";
}

std::string random_polygon_text(std::mt19937& random, unsigned range) {
  std::string text = "(" + random_ring_text(random, 3 + random() % 10, range);
  for (auto holes = random() % 6 < 3 ? 0U : random() % 3; holes > 0; --holes)
    text += "," + random_ring_text(random, 3 + random() % 2, range);
  return text + ")";
}

TEST(Wkt, WhatIsReadIsWrittenSoThatItReadsTheSame) {
  std::mt19937 random(23);
  std::size_t num_wound = 0;
  std::size_t num_holed = 0;
  std::size_t num_several = 0;
  for (int i = 0; i < test::repetitions(200'000); ++i) {
    const unsigned range = 3 + static_cast<unsigned>(random() % 6);
    const std::string polygon = random_polygon_text(random, range);
    const bool is_multi = random() % 8 == 0;
    std::string text = is_multi ? "MULTIPOLYGON(" : "POLYGON";
    text.append(polygon);
    if (is_multi) text.append(",").append(random_polygon_text(random, range)).append(")");
    const auto first = read_wkt(text);
    if (!first) continue;
    const std::string written = write_wkt(first->parts);
    const auto again = read_wkt(written);
    ASSERT_TRUE(again) << text << "\n" << written << "\n" << to_string(again.error());
    ASSERT_EQ(again->parts, first->parts) << text << "\n" << written;
    num_wound += first->wound_rings;
    num_holed += first->parts[0].holes.empty() ? 0U : 1U;
    num_several += first->parts.size() > 1 ? 1U : 0U;
  }
  EXPECT_GT(num_wound, 200U);
  EXPECT_GT(num_holed, 100U);
  EXPECT_GT(num_several, 20U);
}

TEST(Wkt, LimitsHoldForTheFillOfARingToo) {
  // A chain of squares, each touching the next in a corner: as many parts as squares.
  const auto corner = [](int x, int y) {
    return std::to_string(x).append(" ").append(std::to_string(y));
  };
  const auto chain = [&corner](int num_squares) {
    std::string ring;
    for (int i = 0; i < num_squares; ++i) {
      ring.append(corner(i, i)).append(",").append(corner(i + 1, i)).append(",");
    }
    for (int i = num_squares; i > 0; --i) {
      ring.append(corner(i, i)).append(",").append(corner(i - 1, i)).append(i > 1 ? "," : "");
    }
    return "POLYGON((" + ring + "))";
  };
  EXPECT_EQ(shape(chain(100)).parts.size(), 100U);
  EXPECT_EQ(read_wkt(chain(101)).error().code, ErrorCode::kLimit);
  EXPECT_EQ(read_wkt("POLYGON((0 0,4 0,4 4,0 4,0 0,1 3,3 1,0 0))", {.max_holes = 0}).error().code,
            ErrorCode::kLimit);
}

TEST(Wkt, TheVertexThatClosesARingIsNoFurtherOne) {
  EXPECT_TRUE(read_wkt("POLYGON((0 0,1 0,1 1,0 1))", {.max_vertices = 4}));
  EXPECT_TRUE(read_wkt("POLYGON((0 0,1 0,1 1,0 1,0 0))", {.max_vertices = 4}));
  EXPECT_FALSE(read_wkt("POLYGON((0 0,1 0,1 1,0 1,0 .5))", {.max_vertices = 4}));
}

TEST(Wkt, PartsAreHeldAgainstEachOtherOnTheBudget) {
  // The boxes of the two triangles overlap, they themselves do not: one pair of boxes and nine of
  // edges.
  const std::string parts = "MULTIPOLYGON(((0 0,4 0,0 4,0 0)),((5 1,5 5,1 5,5 1)))";
  EXPECT_TRUE(read_wkt(parts, {}, LoadBudget({.max_edge_tests = 10})));
  const auto refused = read_wkt(parts, {}, LoadBudget({.max_edge_tests = 9}));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kLimit);
}

TEST(Wkt, AStopIsNoReasonToMendAShape) {
  int num_checks = 0;
  const LoadBudget budget(BudgetLimits{}, [&num_checks] { return ++num_checks == 1; });
  const auto stopped = read_wkt("POLYGON((0 0,9 0,9 9,0 9),(1 1,2 1,1 2))", {}, budget);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace hypermap
