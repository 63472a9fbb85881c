// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/transformed_map.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace hypermap {
namespace {

constexpr double kBoxRoundingM = 1e-9;

MapFromOldMap motion_by(const Eigen::Vector3d& shift_m, double yaw_rad) {
  return MapFromOldMap(Eigen::Translation3d(shift_m) *
                       Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
}

/// Ten observations saw its left end, the two last ones alone its right one, in the next block.
MapArchive with_a_chair_of_two_ends() {
  const std::vector<Eigen::Vector3f> left{{0.025F, 0.1F, 0.1F}, {0.035F, 0.1F, 0.1F}};
  const std::vector<Eigen::Vector3f> right{{0.045F, 0.1F, 0.1F}};
  const auto nothing = [](const Eigen::Vector3d&) { return false; };
  Object object;
  for (int i = 0; i < 12; ++i) {
    const auto& seen = i < 10 ? left : right;
    object.points.observe(seen);
    object.points.look(seen, nothing, 0);
  }
  object.box = *object.points.agreed_box();
  object.centroid_in_map = object.box.centre();
  MapArchive archive{.hypermap = {}};
  archive.objects.add(object);
  return archive;
}

const Object& first_object(const MapArchive& archive) {
  return *archive.objects.objects().begin();
}

// Blocks of 4 cells of 1 cm do not move as a whole; which cells count may then be another question.
TEST(TransformedBoxes, AShiftTakesThemAlong) {
  const MapArchive archive = with_a_chair_of_two_ends();
  const Box& old = first_object(archive).box;
  EXPECT_NEAR(old.max_in_map.x(), 0.0475, 1e-6) << "both ends count";
  for (int cells = 1; cells <= 8; ++cells) {
    const Eigen::Vector3d shift(0.01 * cells, -0.01 * cells, 0.05);
    const Object moved = first_object(transformed(archive, motion_by(shift, 0.0)).value());
    EXPECT_LT((moved.box.min_in_map - old.min_in_map - shift).norm(), kBoxRoundingM) << cells;
    EXPECT_LT((moved.box.max_in_map - old.max_in_map - shift).norm(), kBoxRoundingM) << cells;
    EXPECT_LT((moved.centroid_in_map - old.centre() - shift).norm(), kBoxRoundingM) << cells;
  }
}

TEST(TransformedBoxes, ThoseOfATruthsShapesMoveToo) {
  std::vector<ValueTree> numbers;
  for (const double number : {1.0, 2.0, 0.0, 2.0, 2.5, 0.8}) numbers.push_back(make_number(number));
  const SemanticObject shape{.id = 3,
                             .name = "bed",
                             .parts = {Polygon{{{1, 2}, {2, 2}, {2, 2.5}, {1, 2.5}}, {}}},
                             .extra = make_map({{"box", make_list(numbers)}})};
  MapArchive archive{.hypermap = {}};
  ASSERT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "semantic"}, .content = SemanticLayer::create({shape}).value()}));
  const auto moved =
      transformed(archive, motion_by({0.0, 0.0, 12.0}, 0.5 * std::numbers::pi)).value();
  const auto* layer = moved.hypermap.find_as<SemanticLayer>("semantic");
  const ValueTree* box = layer->objects().front().extra.find("box");
  ASSERT_NE(box, nullptr);
  const std::vector<double> expected{-2.5, 1.0, 12.0, -2.0, 2.0, 12.8};
  ASSERT_EQ(box->items.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(std::stod(box->items[i].text), expected[i], kBoxRoundingM) << i;
  }
}

}  // namespace
}  // namespace hypermap
