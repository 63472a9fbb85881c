// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the detections of a posed frame say of each class on the ground.
///
/// Source: [sogm] III-B: sensor and algorithm together make an inverse sensor model.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "hypermap/projection/sensor_models/inverse_sensor_model.hpp"

#include <string>
#include <utility>
#include <vector>

namespace hypermap {

struct DetectionModelOptions {
  std::string parent = "/ism/detections";  ///< Each class has the layer of its name below it.
  std::string frame_id = "map";            ///< Of the poses, and so of the grids.
  /// Of a detection with score 1; one with score s has s times the log-odds.
  EvidenceOptions evidence = {.p_hit = Probability(0.8)};
  HeightOptions heights = {};
  double max_range_m = 4.0;  ///< In the plan, from the camera; feet and cells beyond are left out.
  /// A mask's foot is what it has in so much of its height, from below.
  double foot_share = 0.1;
  /// Objects reach as far away from the camera as they are wide, and no farther than this.
  double max_length_m = 1.0;
  friend bool operator==(const DetectionModelOptions&, const DetectionModelOptions&) = default;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const DetectionModelOptions& options);
[[nodiscard]] const OptionTable& option_table(const DetectionModelOptions& options);

/// An object stands where the foot of its detection meets the ground: the lower edge of its box or,
/// better, of its mask's lowest part. What lies from there away from the camera is evidence for its
/// most probable class, each cell by its covered share; where detections of a class overlap, the
/// strongest counts. Where the depth shows the ground itself is evidence against every class that
/// no detection claims there.
///
/// Boundary: a detection says nothing whose foot is cut by the image's lower edge, meets no ground
/// within range, stands for a class that the model does not know, or whose foot depth shows to be
/// above the ground, as of what stands on a table or behind something. Without depth a foot is
/// taken for one, and nothing is said against a class.
class DetectionModel final : public InverseSensorModel<RgbdFrame> {
 public:
  /// Speaks of these classes. Errors: those of validate; kInvalidArgument without a class.
  [[nodiscard]] static Result<DetectionModel> create(ClassRegistry classes,
                                                     DetectionModelOptions options = {});

  /// A grid for each class in the order of their ids, each around what it knows. Errors: also those
  /// of validate(RgbdFrame). Cost: O(cells in range x classes + pixels of masks).
  [[nodiscard]] Result<std::vector<SensorGrid>> grids(const RgbdFrame& frame) const override;

  [[nodiscard]] const DetectionModelOptions& options() const noexcept { return options_; }

 private:
  DetectionModel(ClassRegistry classes, DetectionModelOptions options)
      : classes_(std::move(classes)), options_(std::move(options)) {}

  ClassRegistry classes_;
  DetectionModelOptions options_;
};

}  // namespace hypermap
