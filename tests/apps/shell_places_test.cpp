// SPDX-License-Identifier: BSD-3-Clause
#include "shell/shell_places.hpp"

#include <gmock/gmock.h>

#include <string>

namespace hypermap::app {
namespace {

using ::testing::HasSubstr;

TEST(ShellLocation, IsTypedInSeveralForms) {
  for (const char* text : {"1.5,-2",
                           "1.5 -2",
                           " 1.5, -2 ",
                           "(1.5, -2)",
                           "POINT (1.5 -2)",
                           "point(1.5 -2)",
                           "POINT(1.5, -2)"}) {
    const auto point = parse_location(text);
    ASSERT_TRUE(point) << text;
    EXPECT_EQ(point->xy, Eigen::Vector2d(1.5, -2.0)) << text;
    EXPECT_FALSE(point->z) << text;
  }
  EXPECT_EQ(parse_location("1,2,3").value().z, 3.0);
  EXPECT_EQ(parse_location("POINT (1 2 3)").value().z, 3.0);
}

TEST(ShellLocation, RefusesWhatIsNone) {
  for (const char* text : {"",
                           "1",
                           "1 2 3 4",
                           "1,x",
                           "1,nan",
                           "inf,1",
                           "POINT 1 2",
                           "POINT ()",
                           "(1,2",
                           "POLYGON (1 2)",
                           "1e999,0",
                           "POINTS (1 2)"}) {
    const auto point = parse_location(text);
    ASSERT_FALSE(point) << text;
    EXPECT_EQ(point.error().field, "location");
    EXPECT_THAT(point.error().what, HasSubstr("X,Y"));
  }
}

TEST(ShellArea, IsTypedInSeveralForms) {
  for (const char* text : {"0 0,2 0,2 1,0 1",
                           "0,0 2,0 2,1 0,1",
                           "(0 0, 2 0, 2 1, 0 1)",
                           "POLYGON ((0 0, 2 0, 2 1, 0 1, 0 0))",
                           "polygon((0 0,2 0,2 1,0 1))",
                           "POLYGON ((0 0, 0 1, 2 1, 2 0))"}) {
    const auto area = parse_shell_area(text);
    ASSERT_TRUE(area) << text << ": " << area.error().what;
    EXPECT_NEAR(area_m2(*area), 2.0, 1e-12) << text;
  }
  const auto hole =
      parse_shell_area("POLYGON ((0 0, 4 0, 4 4, 0 4), (1 1, 2 1, 2 2, 1 2))").value();
  EXPECT_NEAR(area_m2(hole), 15.0, 1e-12);
}

TEST(ShellArea, RefusesWhatIsNone) {
  for (const char* text : {"",
                           "0 0,1 0",
                           "0 0,1 1,2 2",
                           "1 2 3",
                           "POLYGON ((0 0, 1 1, 1 0, 0 1))",
                           "POLYGON EMPTY",
                           "POLYGON ((0 0, 1 0, 1 1)",
                           "MULTIPOLYGON (((0 0, 1 0, 1 1)), ((3 0, 4 0, 4 1)))"}) {
    const auto area = parse_shell_area(text);
    ASSERT_FALSE(area) << text;
    EXPECT_THAT(area.error().field, ::testing::StartsWith("area")) << text;
  }
}

}  // namespace
}  // namespace hypermap::app
