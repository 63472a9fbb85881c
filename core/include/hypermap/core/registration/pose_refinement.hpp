// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How the given pose of a frame is refined by what other frames showed.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/frames.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace hypermap {

struct OptionTable;

enum class PoseRefinementRule : std::uint8_t {
  kNone,          ///< Poses are used as they are given.
  kPointToPlane,  ///< Points of the depth are brought onto the planes that earlier frames showed.
};

struct PoseRefinementOptions {
  PoseRefinementRule rule = PoseRefinementRule::kNone;
  /// How wrong a given pose is expected to be, one standard deviation of each coordinate: what the
  /// surfaces do not determine better than this stays as given.
  double sigma_m = 0.01;
  double sigma_rad = 0.0087;  ///< Of each rotation; half a degree.
  /// A larger correction is refused: the given pose is used.
  double max_translation_m = 0.15;
  double max_rotation_rad = 0.1;  ///< The same for the angle.
  double cell_m = 0.1;       ///< Edge of the large cells of the surface model; half in the small.
  int max_cells = 262'144;   ///< Of either size; what was seen least recently goes first.
  int num_points = 3000;     ///< Pixels of a regular grid that are brought onto the planes.
  double max_depth_m = 5.0;  ///< Farther pixels are left out.
  /// Corrections are none on the mean over about so many frames: a frame counts less by a share of
  /// 1 / window_frames with each frame that it is apart. The smaller, the sooner the map follows
  /// the given poses, with less of their noise taken out and less drift of the surfaces let in.
  int window_frames = 12;
  /// So many frames a frame of a recorded sequence waits for, before it is put into the map: they
  /// have a say in its pose (PoseSmoother). 0: none. A mapper that is given frames one by one has
  /// those before alone.
  int lag_frames = 24;
  friend bool operator==(const PoseRefinementOptions&, const PoseRefinementOptions&) = default;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const PoseRefinementOptions& options);
[[nodiscard]] const OptionTable& option_table(const PoseRefinementOptions& options);

/// What became of the pose of a frame.
enum class PoseOutcome : std::uint8_t {
  kGiven,         ///< Not asked for: the rule is none.
  kRefined,       ///< The pose is another one.
  kTooFewPoints,  ///< Too little depth, or too little of it at planes that were seen before.
  kAmbiguous,     ///< Surfaces determine fewer than three directions better than the given pose.
  kTooLarge,      ///< The correction exceeds the limits.
  kNoBetter,      ///< The points do not lie nearer to the planes than at the given pose.
};

/// "given", "refined", "too_few_points", ...
[[nodiscard]] std::string_view name_of(PoseOutcome outcome) noexcept;

struct PoseCorrection {
  PoseOutcome outcome = PoseOutcome::kGiven;
  double translation_m = 0.0;  ///< Length, of the camera's place; 0 unless refined.
  double rotation_rad = 0.0;   ///< Angle; 0 unless refined.
  int num_directions = 0;      ///< Of 6, that the surfaces determine better than the given pose.
  std::size_t num_points = 0;  ///< Of the grid, that lay at a plane.
  /// False when there was no memory for what the frame showed: later ones are refined without it.
  bool is_added = true;
  double rms_m = 0.0;  ///< Of their distances from the planes, at the refined pose.
};

/// The same with outcome kRefined, and how far `used` is from `given`.
[[nodiscard]] PoseCorrection corrected(PoseCorrection correction,
                                       const MapFromCamera& given,
                                       const MapFromCamera& used);

}  // namespace hypermap
