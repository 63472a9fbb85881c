// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/sensor_models/inverse_sensor_model.hpp"

#include "../stack/grid_builders.hpp"
#include "hypermap/projection/sensor_models/class_image_model.hpp"
#include "hypermap/projection/sensor_models/depth_camera_model.hpp"
#include "hypermap/projection/sensor_models/detection_model.hpp"
#include "hypermap/projection/sensor_models/planar_scan_model.hpp"
#include "hypermap/projection/sensor_models/proximity_model.hpp"
#include "hypermap/projection/sensor_models/tilted_scan_model.hpp"
#include "sensor_model_contract.hpp"
#include "sensor_worlds.hpp"

#include <gtest/gtest.h>

namespace hypermap::test {
namespace {

constexpr EvidenceOptions kCoarse{.resolution_m = kCellM};

/// Whether a cell of the world meets the wall's front and what a sensor's error makes of it.
bool is_at_front(const Eigen::Vector2d& middle, double error_m) {
  return middle.x() + kCellM / 2.0 > kWallFrontM - error_m &&
         middle.x() - kCellM / 2.0 < kWallFrontM + error_m;
}

/// Whether part of a cell lies before the wall.
bool is_before_wall(const Eigen::Vector2d& middle) {
  return middle.x() - kCellM / 2.0 < kWallFrontM;
}

struct OfWall {
  static constexpr int kNumCellsOnEdges = 0;
  static bool may_be_hit(std::size_t /*layer*/, const Eigen::Vector2d& in_world) {
    return is_at_front(in_world, 0.05);
  }
  static bool may_be_free(std::size_t /*layer*/, const Eigen::Vector2d& in_world) {
    return is_before_wall(in_world);
  }
};

struct PlanarCase : OfWall {
  static PlanarScanModel model() { return PlanarScanModel::create({.evidence = kCoarse}).value(); }
  static RangeScan reading(const Eigen::Isometry3d& map_from_world) {
    return scan_of_wall(mounted(0.5), map_from_world);
  }
  static RangeScan nothing(const Eigen::Isometry3d& map_from_world) {
    return nothing_of(reading(map_from_world));
  }
};

struct TiltedCase : OfWall {
  static TiltedScanModel model() { return TiltedScanModel::create({.evidence = kCoarse}).value(); }
  /// 0.5 m high and 0.3 rad down: the middle of the scan meets the ground at 1.62 m; where it is
  /// rolled it meets the wall as well.
  static RangeScan reading(const Eigen::Isometry3d& map_from_world) {
    Eigen::Isometry3d sensor = mounted(0.5, 0.2);
    sensor.rotate(Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX()));
    return scan_of_wall(sensor, map_from_world);
  }
  static RangeScan nothing(const Eigen::Isometry3d& map_from_world) {
    return nothing_of(reading(map_from_world));
  }
};

struct ProximityCase : OfWall {
  static ProximityModel model() {
    return ProximityModel::create({.evidence = kCoarse, .field_of_view_rad = 0.3}).value();
  }
  static ProximityReading reading(const Eigen::Isometry3d& map_from_world) {
    return {MapFromScanner(map_from_world * mounted(0.5)), kWallFrontM};
  }
  static ProximityReading nothing(const Eigen::Isometry3d& map_from_world) {
    ProximityReading reading = ProximityCase::reading(map_from_world);
    reading.range_m = std::nan("");
    return reading;
  }
  /// The arc of 0.15 rad either way lies up to 2.3 cm nearer at its ends.
  static bool may_be_hit(std::size_t /*layer*/, const Eigen::Vector2d& in_world) {
    return is_at_front(in_world, 0.051 + 0.024);
  }
};

struct DepthCase : OfWall {
  static DepthCameraModel model() {
    return DepthCameraModel::create({.evidence = kCoarse}).value();
  }
  static RgbdFrame reading(const Eigen::Isometry3d& map_from_world) {
    return frame_of_wall(map_from_world);
  }
  static RgbdFrame nothing(const Eigen::Isometry3d& map_from_world) {
    return nothing_of(reading(map_from_world));
  }
};

ClassRegistry two_classes() {
  const std::string names[] = {"lawn", "road"};
  return ClassRegistry::from_names(names).value();
}

/// Lawn (class 0) to the left, y >= 0, road (class 1) to the right.
struct ClassImageCase {
  static constexpr int kNumCellsOnEdges = 4;  // centres at an image's or a label's edge
  static ClassImageModel model() {
    return ClassImageModel::create(two_classes(), {.evidence = kCoarse, .max_range_m = 3.0})
        .value();
  }
  static ClassImage reading(const Eigen::Isometry3d& map_from_world) {
    ClassImage image{.camera = wide_camera(),
                     .map_from_camera = MapFromCamera(map_from_world * camera_in_world()),
                     .classes = Image<std::uint16_t>(160, 120)};
    for (int v = 0; v < 120; ++v) {
      for (int u = 80; u < 160; ++u) image.classes.at(u, v) = 1;
    }
    return image;
  }
  static ClassImage nothing(const Eigen::Isometry3d& map_from_world) {
    ClassImage image = reading(map_from_world);
    for (std::uint16_t& label : image.classes.pixels()) label = ClassImage::kNoClass;
    return image;
  }
  static bool may_be_hit(std::size_t layer, const Eigen::Vector2d& in_world) {
    return (layer == 0) == (in_world.y() >= 0.0);
  }
  static bool may_be_free(std::size_t layer, const Eigen::Vector2d& in_world) {
    return !may_be_hit(layer, in_world);
  }
};

/// A detection of the second class whose foot runs along x = 1.5 from y = 0.25 to -0.25.
struct DetectionCase {
  static constexpr int kNumCellsOnEdges = 0;
  static DetectionModel model() {
    return DetectionModel::create(two_classes(), {.evidence = kCoarse, .max_range_m = 3.0}).value();
  }
  static RgbdFrame reading(const Eigen::Isometry3d& map_from_world) {
    RgbdFrame frame = frame_of_wall(map_from_world);
    Detection detection;
    const PixelPoint left = pixel_of(1.5, 0.25, 0.0);
    const PixelPoint right = pixel_of(1.5, -0.25, 0.0);
    detection.box_px = {left.u_px + 0.5, 10.0, right.u_px + 0.5, left.v_px + 0.5};
    detection.score = Probability(0.9);
    detection.class_scores = {{ClassId{0}, Probability(0.25)}, {ClassId{1}, Probability(0.75)}};
    frame.detections.push_back(detection);
    return frame;
  }
  static RgbdFrame nothing(const Eigen::Isometry3d& map_from_world) {
    return nothing_of(reading(map_from_world));
  }
  /// As deep as it is wide: 0.5 m.
  static bool may_be_hit(std::size_t layer, const Eigen::Vector2d& in_world) {
    const Eigen::Vector2d from_middle = in_world - Eigen::Vector2d(1.75, 0.0);
    return layer == 1 && from_middle.cwiseAbs().maxCoeff() < 0.25 + kCellM / 2.0 + 1e-9;
  }
  static bool may_be_free(std::size_t /*layer*/, const Eigen::Vector2d& in_world) {
    return is_before_wall(in_world);
  }
};

using AllModels =
    testing::Types<PlanarCase, TiltedCase, ProximityCase, DepthCase, ClassImageCase, DetectionCase>;
INSTANTIATE_TYPED_TEST_SUITE_P(Ours, SensorModelContract, AllModels);

TEST(EvidenceOptions, ProbabilitiesSpeakForAndAgainst) {
  EXPECT_TRUE(validate(EvidenceOptions{}).has_value());
  EXPECT_EQ(validate(EvidenceOptions{.p_hit = Probability(0.5)}).error().field, "p_hit");
  EXPECT_EQ(validate(EvidenceOptions{.p_free = Probability(0.5)}).error().field, "p_free");
  EXPECT_EQ(validate(EvidenceOptions{.resolution_m = 0.0}).error().field, "resolution_m");
}

TEST(HeightOptions, ObstaclesAreHigherThanTheGround) {
  EXPECT_TRUE(validate(HeightOptions{}).has_value());
  const HeightOptions low{.ground_tolerance_m = 0.5, .max_obstacle_m = 0.4};
  EXPECT_EQ(validate(low).error().field, "max_obstacle_m");
}

}  // namespace
}  // namespace hypermap::test
