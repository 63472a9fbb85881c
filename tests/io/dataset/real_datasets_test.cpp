// SPDX-License-Identifier: BSD-3-Clause
// Data by others.
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "io/dataset/opened_dataset.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hypermap {
namespace {

using test::opened;
using ::testing::SizeIs;

TEST(RealDatasets, TheKitchenIsFoundByLooking) {
  HYPERMAP_REQUIRE_SHARED_DATA("rgbd/7scenes_redkitchen");
  ClassRegistry registry;
  const auto folder = test::shared_data("rgbd/7scenes_redkitchen");
  const auto reader =
      opened(folder, registry, {.detections = {folder / "detections_yolox_nano.jsonl"}});
  ASSERT_NE(reader, nullptr);
  EXPECT_EQ(reader->size(), 200U);
  EXPECT_EQ(reader->summary().layout, "7scenes");
  // Depth of 585 px, colour by the Kinect's other camera: 525 px as it is published.
  EXPECT_NEAR(reader->camera().fx_px, 525.0, 8.0);
  EXPECT_NEAR(reader->camera().cx_px, 320.0, 8.0);
  EXPECT_NEAR(reader->camera().cy_px, 240.0, 8.0);
  EXPECT_THAT(reader->summary().unpaired, SizeIs(0));
  EXPECT_THAT(reader->summary().findings, SizeIs(0));
  const auto frame = reader->read(1);
  ASSERT_TRUE(frame) << to_string(frame.error());
  EXPECT_EQ(frame->name, "frame-000005.color.jpg");
  EXPECT_THAT(frame->detections, SizeIs(6));
}

TEST(RealDatasets, TheCabinetIsReadByItsDescription) {
  HYPERMAP_REQUIRE_SHARED_DATA("rgbd/tum_fr3_cabinet");
  ClassRegistry registry;
  const auto folder = test::shared_data("rgbd/tum_fr3_cabinet");
  const auto reader =
      opened(folder,
             registry,
             {.description = test::source_path("data/datasets/tum_fr3_cabinet.yaml"),
              .detections = {folder / "detections_yolox_nano.jsonl"}});
  ASSERT_NE(reader, nullptr);
  EXPECT_EQ(reader->size(), 58U);
  EXPECT_THAT(reader->summary().unpaired, SizeIs(0));
  EXPECT_EQ(reader->summary().up_axis, "z");
  const auto frame = reader->read(1);
  ASSERT_TRUE(frame) << to_string(frame.error());
  EXPECT_EQ(frame->stamp.ns, 1341841279510700000);
  EXPECT_NEAR(frame->map_from_camera.origin().xyz.z(), 1.0996, 1e-9);
  EXPECT_THAT(frame->detections, SizeIs(2));
}

TEST(RealDatasets, TheLivingRoomIsReadByItsDescriptionAndByLooking) {
  HYPERMAP_REQUIRE_SHARED_DATA("rgbd/icl_nuim_livingroom1");
  const auto folder = test::shared_data("rgbd/icl_nuim_livingroom1");
  ClassRegistry registry;
  const auto described =
      opened(folder,
             registry,
             {.description = test::source_path("data/datasets/icl_nuim_livingroom1.yaml")});
  const auto found = opened(folder, registry);
  ASSERT_NE(described, nullptr);
  ASSERT_NE(found, nullptr);
  ASSERT_EQ(described->size(), 43U);
  ASSERT_EQ(found->size(), 43U);
  EXPECT_EQ(described->camera(), found->camera());
  EXPECT_EQ(found->summary().layout, "open3d");
  EXPECT_THAT(found->summary().findings, SizeIs(1));  // intrinsics that the folder lacks
  // Image 00005 has record 5, not record 1.
  EXPECT_NEAR(described->read(1)->map_from_camera.origin().xyz.x(), 0.00679, 0.05);
  EXPECT_EQ(described->read(1)->map_from_camera.isometry().matrix(),
            found->read(1)->map_from_camera.isometry().matrix());
}

}  // namespace
}  // namespace hypermap
