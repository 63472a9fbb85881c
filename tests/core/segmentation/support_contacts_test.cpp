// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/policies/support_contacts.hpp"

#include "hypermap/core/segmentation/rgbd_frame.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace hypermap {
namespace {

const Eigen::Vector3f kUp{0, -1, 0};
constexpr float kNearM = 2.0F;
constexpr float kFarM = 3.0F;
constexpr float kOutOfRangeM = 9.0F;

/// A picture of letters: T the top of a desk, its plane 0.3 m below the camera; R its rim; B a
/// book; C a chair; F the floor, far behind; . nothing measured; X what is out of range. A row
/// falls by 0.025 per metre. The box has the columns 2 to 8 of ten and all rows but the first.
class DrawnSurfaces {
 public:
  explicit DrawnSurfaces(const std::vector<std::string_view>& rows)
      : depth_m(10, static_cast<int>(rows.size())) {
    window.rect = {0, 0, 10, static_cast<int>(rows.size())};
    window.box = {2, 1, 8, static_cast<int>(rows.size())};
    window.tolerant_box = window.box;
    window.slope_x.assign(10, 0.0F);
    for (std::size_t y = 0; y < rows.size(); ++y) {
      window.slope_y.push_back(0.025F * static_cast<float>(y));
      for (std::size_t x = 0; x < rows[y].size(); ++x) draw(rows[y][x], x, y);
    }
    window.step_m.assign(window.size(), 0.06F);
  }
  DrawnSurfaces(const DrawnSurfaces&) = delete;  // contacts look at it
  DrawnSurfaces& operator=(const DrawnSurfaces&) = delete;

  [[nodiscard]] SupportContacts contacts(const Eigen::Vector3f& up_in_camera = kUp) const {
    return {depth_m, window, surfaces, planes, up_in_camera};
  }
  [[nodiscard]] bool has_rim() const { return contacts().is_rim(id_of('R')); }
  [[nodiscard]] static std::uint32_t id_of(char letter) {
    return static_cast<std::uint32_t>(kLetters.find(letter));
  }

  DepthImage depth_m;
  DepthWindow window;
  DepthComponents surfaces{.of_cell = {}, .components = {{.kind = 1}, {}, {}, {}, {.kind = 2}}};
  std::vector<Plane> planes{{.normal = {0, -1, 0}, .offset_m = 0.3F},
                            {.normal = {0, -1, 0}, .offset_m = 1.0F}};

 private:
  static constexpr std::string_view kLetters = "TRBCF";

  void draw(char letter, std::size_t x, std::size_t y) {
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    const bool is_in_range = letter != '.' && letter != 'X';
    window.depth_m.push_back(!is_in_range ? 0.0F : letter == 'F' ? kFarM : kNearM);
    depth_m.at(column, row) = letter == 'X' ? kOutOfRangeM : window.depth_m.back();
    surfaces.of_cell.push_back(is_in_range ? id_of(letter) : kNoComponent);
    if (!is_in_range) return;
    DepthComponent& surface = surfaces.components[id_of(letter)];
    const PixelRect cell{column, row, column + 1, row + 1};
    surface.bounds = surface.bounds.empty() ? cell : united(surface.bounds, cell);
    if (!window.box.contains(column, row)) {
      ++surface.num_outside;
      return;
    }
    ++surface.num_in_box;
    surface.bounds_in_box =
        surface.bounds_in_box.empty() ? cell : united(surface.bounds_in_box, cell);
  }
};

const std::vector<std::string_view> kDesk{"TTTTTTTTTT",  //
                                          "TTTTTTTTTT",
                                          "RRRRRRRRRR",
                                          "FFFFFFFFFF",
                                          "FFFFFFFFFF"};

TEST(SupportContacts, ARimHangsFromATopThatGoesOnBesideTheBox) {
  EXPECT_TRUE(DrawnSurfaces(kDesk).has_rim());
}

TEST(SupportContacts, WhatIsBelowARimMayBeUnmeasuredNearIt) {
  EXPECT_TRUE(DrawnSurfaces({"TTTTTTTTTT",  //
                             "TTTTTTTTTT",
                             "RRRRRRRRRR",
                             "..........",
                             "FFFFFFFFFF"})
                  .has_rim());
  EXPECT_FALSE(DrawnSurfaces({"TTTTTTTTTT",  //
                              "TTTTTTTTTT",
                              "RRRRRRRRRR",
                              "..........",
                              ".........."})
                   .has_rim());
}

TEST(SupportContacts, ALegBelowItLeavesARimARim) {
  EXPECT_TRUE(DrawnSurfaces({"TTTTTTTTTT",  //
                             "TTTTTTTTTT",
                             "RRRRRRRRRR",
                             "FFFFFFRFFF",
                             "FFFFFFRFFF",
                             "FFFFFFRFFF"})
                  .has_rim());
}

TEST(SupportContacts, TheFrameBelowTheEdgeOfATopIsARim) {
  DrawnSurfaces drawn({"TTTTTTTTTT",  //
                       "TTTTTTTTTT",
                       "RRRRRRRRRR",
                       "BBBBBBBBBB",
                       "FFFFFFFFFF"});
  EXPECT_TRUE(drawn.contacts().is_rim(DrawnSurfaces::id_of('R')));
  EXPECT_TRUE(drawn.contacts().is_rim(DrawnSurfaces::id_of('B')));
  for (int x = 0; x < 10; ++x) drawn.window.depth_m[drawn.window.cell(x, 3)] = kNearM + 0.2F;
  EXPECT_TRUE(drawn.contacts().is_rim(DrawnSurfaces::id_of('R')));
  EXPECT_FALSE(drawn.contacts().is_rim(DrawnSurfaces::id_of('B'))) << "it is far behind";
}

TEST(SupportContacts, ARimWithAHoleCountsOnceInAColumn) {
  // Two of six columns; the rest goes on.
  EXPECT_FALSE(DrawnSurfaces({"TTTTTTTTTT",  //
                              "TTTTTTTTTT",
                              "RRRRRRRRRR",
                              "RR..RRRRRR",
                              "RRRRRRRRRR",
                              "FFFFRRRRRR",
                              "FFFFFFFFFF"})
                   .has_rim());
}

/// A rim over the floor, below so many rows of nothing or of what is out of range.
bool is_rim_below(std::size_t num_rows, std::string_view row) {
  std::vector<std::string_view> rows(1 + num_rows, row);
  rows.insert(rows.end(), {"RRRRRRRRRR", "FFFFFFFFFF"});
  return DrawnSurfaces(rows).has_rim();
}

TEST(SupportContacts, ARimHangsFromATopThatIsSeenTooFlatToBeMeasured) {
  EXPECT_TRUE(is_rim_below(20, ".........."));
  EXPECT_FALSE(is_rim_below(10, "..........")) << "sensors lose so much at edges";
  EXPECT_FALSE(is_rim_below(20, "XXXXXXXXXX")) << "a hall behind a bench";
}

TEST(SupportContacts, WhatIsDeepIsNoRimBelowAnUnmeasuredTop) {
  std::vector<std::string_view> rows(21, "..........");
  rows.insert(rows.end(), {"RRRRRRRRRR", "RRRRRRRRRR", "FFFFFFFFFF"});
  DrawnSurfaces bench(rows);
  EXPECT_TRUE(bench.has_rim());
  for (int x = 0; x < 10; ++x) bench.window.depth_m[bench.window.cell(x, 21)] = kNearM + 0.3F;
  EXPECT_FALSE(bench.has_rim()) << "its seat, and the edge of it";
}

TEST(SupportContacts, WhatIsHighIsNoRim) {
  // 3 rows of 0.025 at 2 m are 0.15 m.
  EXPECT_FALSE(DrawnSurfaces({"TTTTTTTTTT",  //
                              "TTTTTTTTTT",
                              "RRRRRRRRRR",
                              "RRRRRRRRRR",
                              "RRRRRRRRRR",
                              "FFFFFFFFFF"})
                   .has_rim());
}

TEST(SupportContacts, WhatLiesOnThePlaneIsNoRim) {
  EXPECT_FALSE(DrawnSurfaces({"TTTTTTTTTT",  //
                              "TTTTTTTTTT",
                              "RRRRRRRRRR",
                              "TTTTTTTTTT",
                              "FFFFFFFFFF"})
                   .has_rim());
}

TEST(SupportContacts, ARimThatEndsWithTheBoxMayBeTheObjects) {
  EXPECT_FALSE(DrawnSurfaces({"TTTTTTTTTT",  //
                              "TTTTTTTTTT",
                              "FFRRRRRRFF",
                              "FFFFFFFFFF",
                              "FFFFFFFFFF"})
                   .has_rim());
}

TEST(SupportContacts, WhatThePictureCutsIsNoRimForThat) {
  DrawnSurfaces drawn({"TTTTTTTTTT",  //
                       "TTTTTTTTTT",
                       "RRRRRRRRFF",
                       "FFFFFFFFFF",
                       "FFFFFFFFFF"});
  EXPECT_TRUE(drawn.has_rim());
  drawn.window.box.u_begin = 0;
  drawn.surfaces.components[DrawnSurfaces::id_of('R')].num_outside = 0;
  EXPECT_FALSE(drawn.has_rim());
}

TEST(SupportContacts, ATopThatEndsWithTheBoxMayBeTheObjects) {
  EXPECT_FALSE(DrawnSurfaces({"FFFFFFFFFF",  //
                              "FFTTTTTTFF",
                              "RRRRRRRRRR",
                              "FFFFFFFFFF",
                              "FFFFFFFFFF"})
                   .has_rim());
}

TEST(SupportContacts, RolledCamerasSeeNoRim) {
  const auto is_rim = [](const Eigen::Vector3f& up_in_camera) {
    DrawnSurfaces drawn(kDesk);
    for (Plane& plane : drawn.planes) plane.normal = -up_in_camera;
    return drawn.contacts(up_in_camera).is_rim(DrawnSurfaces::id_of('R'));
  };
  EXPECT_FALSE(is_rim({-0.6F, -0.8F, 0.0F}));
  EXPECT_FALSE(is_rim({-0.3F, -0.4F, -0.8660254F})) << "looks down";
  EXPECT_TRUE(is_rim({0.0F, -0.5F, -0.8660254F}));
  EXPECT_FALSE(is_rim({0.0F, 1.0F, 0.0F})) << "upside down";
}

TEST(SupportContacts, ARimIsAsHighFromAbove) {
  // 2 rows of 0.025 at 2 m are 0.1 m across the line of sight: of a camera that looks down by 60
  // degrees 0.2 m of height.
  const std::vector<std::string_view> rows{"TTTTTTTTTT",  //
                                           "TTTTTTTTTT",
                                           "RRRRRRRRRR",
                                           "RRRRRRRRRR",
                                           "FFFFFFFFFF"};
  EXPECT_TRUE(DrawnSurfaces(rows).has_rim());
  const Eigen::Vector3f from_above{0.0F, -0.5F, -0.8660254F};
  DrawnSurfaces drawn(rows);
  for (Plane& plane : drawn.planes) plane.normal = from_above;
  EXPECT_FALSE(drawn.contacts(from_above).is_rim(DrawnSurfaces::id_of('R')));
}

/// Whether the book on the top is of a support that the chair beside it passes, which has so many
/// rows: the top is at the height of row 6, and row 8 is the first one more than 5 cm below.
bool is_book_of_passed_support(std::size_t num_rows) {
  std::vector<std::string_view> rows{"TTTTTTTTTT",  //
                                     "TTTTTTTTTT",
                                     "TTBBBTTCCT",
                                     "TTBBBTTCCT",
                                     "TTTTTTTCCT",
                                     "TTTTTTTCCT"};
  rows.resize(2 + num_rows, "FFFFFFFCCF");
  const DrawnSurfaces drawn(rows);
  const auto is_of_support = drawn.contacts().of_passed_supports(DrawnSurfaces::id_of('C'));
  return is_of_support[DrawnSurfaces::id_of('B')];
}

TEST(SupportContacts, WhatLiesOnATopThatTheObjectPassesIsNotTheObjects) {
  EXPECT_FALSE(is_book_of_passed_support(4)) << "it stands beside the book";
  EXPECT_FALSE(is_book_of_passed_support(7)) << "1 of 7 is less than 0.15";
  EXPECT_TRUE(is_book_of_passed_support(8)) << "2 of 8";
}

TEST(SupportContacts, WhatTouchesATopAcrossTheBoxsEdgeIsAsMuchOfItOnEitherSide) {
  // A quarter of the border: 3 cells of 12, all of them across one side of the box.
  const auto is_of_support = [](const std::vector<std::string_view>& rows) -> bool {
    const DrawnSurfaces drawn(rows);
    const auto of_supports = drawn.contacts().of_passed_supports(DrawnSurfaces::id_of('C'));
    return of_supports[DrawnSurfaces::id_of('B')];
  };
  EXPECT_TRUE(is_of_support({"TTTTTTTTTT",
                             "FFFFFFFCCF",
                             "TTBBBFFCCF",
                             "TTBBBFFCCF",
                             "TTBBBFFCCF",
                             "FFFFFFFCCF",
                             "FFFFFFFCCF",
                             "FFFFFFFCCF",
                             "FFFFFFFCCF",
                             "FFFFFFFCCF"}));
  EXPECT_TRUE(is_of_support({"TTTTTTTTTT",
                             "FFCFFFFFFF",
                             "FFCFFBBBTT",
                             "FFCFFBBBTT",
                             "FFCFFBBBTT",
                             "FFCFFFFFFF",
                             "FFCFFFFFFF",
                             "FFCFFFFFFF",
                             "FFCFFFFFFF",
                             "FFCFFFFFFF"}));
}

TEST(SupportContacts, ASurfaceTouchesNoPlaneAcrossAStep) {
  DrawnSurfaces drawn(kDesk);
  for (int x = 0; x < 10; ++x) drawn.window.depth_m[drawn.window.cell(x, 2)] = kNearM - 0.1F;
  EXPECT_FALSE(drawn.has_rim());
}

}  // namespace
}  // namespace hypermap
