// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What an image of class labels, from a camera that sees the ground, says of each class.
///
/// Source: [sogm] III-B, II-A: inverse perspective mapping; the plane of the ground is seen by a
/// homography.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/image.hpp"
#include "hypermap/core/geometry/camera.hpp"
#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/projection/sensor_models/inverse_sensor_model.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {

/// A class for each pixel.
struct ClassImage {
  static constexpr std::uint16_t kNoClass = 0xFFFF;  ///< Of a pixel that nothing is known of.

  PinholeCamera camera;
  MapFromCamera map_from_camera;
  Image<std::uint16_t> classes;  ///< `ClassId::value`, or kNoClass. In the camera's size, or empty.
};

/// Errors: kInvalidArgument naming the field: those of validate(PinholeCamera), a size that is not
/// the camera's, a pose that is no finite rigid motion or lies beyond 1e6 m.
[[nodiscard]] Result<void> validate(const ClassImage& image);

struct ClassImageOptions {
  std::string parent = "/ism/classes";  ///< Each class has the layer of its name below it.
  std::string frame_id = "map";         ///< Of the poses, and so of the grids.
  EvidenceOptions evidence = {};
  double ground_m = 0.0;     ///< Height of the ground. Frame: Map.
  double max_range_m = 5.0;  ///< In the plan, from the camera; farther cells are left out.
  friend bool operator==(const ClassImageOptions&, const ClassImageOptions&) = default;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const ClassImageOptions& options);
[[nodiscard]] const OptionTable& option_table(const ClassImageOptions& options);

/// A cell bears the class of the pixel that shows its centre, as if all that is seen lay on the
/// ground: evidence for that class, and against all others that the model knows. Where the pixel
/// has no class, or one that the model does not know, nothing is said.
class ClassImageModel final : public InverseSensorModel<ClassImage> {
 public:
  /// Speaks of these classes. Errors: those of validate; kInvalidArgument without a class.
  [[nodiscard]] static Result<ClassImageModel> create(ClassRegistry classes,
                                                      ClassImageOptions options = {});

  /// A grid for each class in the order of their ids, each around what it knows. Errors: also those
  /// of validate(ClassImage). Cost: O(cells in range x classes).
  [[nodiscard]] Result<std::vector<SensorGrid>> grids(const ClassImage& image) const override;

  [[nodiscard]] const ClassImageOptions& options() const noexcept { return options_; }

 private:
  ClassImageModel(ClassRegistry classes, ClassImageOptions options)
      : classes_(std::move(classes)), options_(std::move(options)) {}

  ClassRegistry classes_;
  ClassImageOptions options_;
};

}  // namespace hypermap
