// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/labelled_cloud.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace hypermap {
namespace {

LabelledCloud small_cloud() {
  LabelledCloud cloud;
  cloud.points_in_map = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  cloud.class_vectors = {{{ClassId{0}, Probability(1.0)}}};
  cloud.class_vector_of_point = {0, LabelledCloud::kNoClassVector, 0};
  cloud.instance_of_point = {LabelledCloud::kNoInstance, 4, 4};
  return cloud;
}

std::string field_of(const LabelledCloud& cloud) {
  const auto checked = validate(cloud);
  return checked ? std::string() : checked.error().field;
}

TEST(LabelledCloud, PointsMayBearNothing) {
  LabelledCloud cloud = small_cloud();
  EXPECT_EQ(field_of(cloud), "");
  cloud.class_vectors = {};
  cloud.class_vector_of_point = {};
  cloud.instance_of_point = {};
  EXPECT_EQ(field_of(cloud), "");
  EXPECT_EQ(field_of({}), "");
}

TEST(LabelledCloud, NamesTheFieldThatBreaksItsRule) {
  LabelledCloud cloud = small_cloud();
  cloud.index = std::uint64_t{1} << 63U;
  EXPECT_EQ(field_of(cloud), "index");
  cloud = small_cloud();
  cloud.sensor.xyz.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(field_of(cloud), "sensor");
  cloud = small_cloud();
  cloud.class_vectors.push_back({{ClassId{0}, Probability(0.5)}});
  EXPECT_EQ(field_of(cloud), "class_vectors[1]");
  cloud = small_cloud();
  cloud.class_vector_of_point.pop_back();
  EXPECT_EQ(field_of(cloud), "class_vector_of_point");
  cloud = small_cloud();
  cloud.class_vector_of_point[2] = 1;
  EXPECT_EQ(field_of(cloud), "class_vector_of_point");
  cloud = small_cloud();
  cloud.instance_of_point.pop_back();
  EXPECT_EQ(field_of(cloud), "instance_of_point");
  cloud = small_cloud();
  cloud.class_vector_of_point[2] = LabelledCloud::kNoClassVector;
  EXPECT_EQ(field_of(cloud), "instance_of_point") << "instance 4 has no class";
}

}  // namespace
}  // namespace hypermap
