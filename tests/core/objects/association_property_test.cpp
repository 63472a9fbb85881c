// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Random rooms of objects, seen in parts, by a detector that errs: nothing twice.
#include "hypermap/core/objects/association.hpp"
#include "hypermap/core/objects/confirmation.hpp"
#include "support/object_builders.hpp"
#include "support/sanitized.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace hypermap {
namespace {

using testing_support::box_at;
using testing_support::kNumClasses;
using testing_support::observed;
using testing_support::scores;
using testing_support::surface_of;

struct TrueObject {
  Box box;
  ClassId class_id;
};

bool is_free(const std::vector<TrueObject>& truths, const Box& box, double gap_m) {
  const Box around{box.min_in_map.array() - gap_m, box.max_in_map.array() + gap_m};
  return std::none_of(truths.begin(), truths.end(), [&](const TrueObject& truth) {
    return truth.box.intersects(around);
  });
}

/// Objects of 8 cm to 1.2 m, at least 10 cm apart.
std::vector<TrueObject> furnish_room(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-3.0, 3.0);
  std::uniform_real_distribution<double> log_size(std::log(0.08), std::log(1.2));
  std::vector<TrueObject> truths;
  for (int tries = 0; tries < 1000 && truths.size() < 20; ++tries) {
    const double size = std::exp(log_size(random));
    const Box box = box_at({place(random), place(random), 0.5 * size}, {size, 0.7 * size, size});
    if (!is_free(truths, box, 0.1)) continue;
    truths.push_back({box, ClassId{static_cast<std::uint32_t>(random() % kNumClasses)}});
  }
  return truths;
}

/// What a camera in direction `bearing` sees of the box: the sides towards it and the top, with
/// noise, and sometimes cut off at a random height or side.
std::vector<Eigen::Vector3f> part_seen(const Box& box, double bearing, std::mt19937& random) {
  const double spacing = std::max(0.006, box.extent().maxCoeff() / 40.0);
  const Eigen::Vector3d way(std::cos(bearing), std::sin(bearing), 0.0);
  std::normal_distribution<double> noise(0.0, 0.006);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const double cut = share(random) < 0.3 ? 0.5 + 0.5 * share(random) : 1.0;
  const int axis = static_cast<int>(random() % 3);
  std::vector<Eigen::Vector3f> points;
  for (const Eigen::Vector3f& p : surface_of(box, spacing)) {
    const Eigen::Vector3d from_centre = p.cast<double>() - box.centre();
    const bool is_top = static_cast<double>(p.z()) > box.max_in_map.z() - 1e-4;
    if (!is_top && from_centre.dot(way) < 0.2 * box.extent().x()) continue;
    const double along = (p.cast<double>() - box.min_in_map)[axis] / box.extent()[axis];
    if (along > cut) continue;
    points.emplace_back(
        (p.cast<double>() + Eigen::Vector3d(noise(random), noise(random), noise(random)))
            .cast<float>());
  }
  return points;
}

std::vector<Observation> frame_of(const std::vector<TrueObject>& truths,
                                  std::uint64_t index,
                                  std::mt19937& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<Observation> frame;
  for (const TrueObject& truth : truths) {
    if (share(random) < 0.5) continue;  // out of view or missed
    const bool is_wrong = share(random) < 0.05;
    const ClassId id =
        is_wrong ? ClassId{static_cast<std::uint32_t>(random() % kNumClasses)} : truth.class_id;
    auto points = part_seen(truth.box, 0.15 * static_cast<double>(index), random);
    if (points.size() < 20) continue;
    frame.push_back(observed(std::move(points), scores(id, 0.4 + 0.5 * share(random)), index));
  }
  return frame;
}

class RandomRoom : public ::testing::TestWithParam<unsigned> {};

TEST_P(RandomRoom, HasEachThingOnce) {
  std::mt19937 random(GetParam());
  const std::vector<TrueObject> truths = furnish_room(random);
  ObjectMap map;
  for (std::uint64_t index = 0; index < 60; ++index) {
    (void)associate(map, frame_of(truths, index, random), {});
  }
  const auto ids = confirmed_objects(map, {});
  EXPECT_EQ(ids.size(), truths.size());
  for (const TrueObject& truth : truths) {
    int num_here = 0;
    for (const ObjectId id : ids) {
      const Object& object = map.at(id);
      if (!truth.box.contains(object.centroid_in_map)) continue;
      ++num_here;
      EXPECT_EQ(best_class(object)->id, truth.class_id);
      // Three standard deviations of the noise and two of the largest cells.
      EXPECT_LT((object.box.min_in_map - truth.box.min_in_map).cwiseAbs().maxCoeff(), 0.1);
      EXPECT_LT((object.box.max_in_map - truth.box.max_in_map).cwiseAbs().maxCoeff(), 0.1);
    }
    EXPECT_EQ(num_here, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomRoom, ::testing::Range(1U, 1U + test::repetitions(12U)));

TEST(RandomRoom, TwoRunsGiveTheSameObjects) {
  std::vector<ObjectMap> maps(2);
  for (ObjectMap& map : maps) {
    std::mt19937 random(99);
    const std::vector<TrueObject> truths = furnish_room(random);
    for (std::uint64_t index = 0; index < 10; ++index) {
      (void)associate(map, frame_of(truths, index, random), {});
    }
  }
  EXPECT_EQ(maps[0], maps[1]);
}

}  // namespace
}  // namespace hypermap
