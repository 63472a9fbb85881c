// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A detector of the simulation, perfect or with the errors that detectors make.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/random_numbers.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/detection.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

struct OptionTable;

/// Source: docs/EVALUATION.md, "Noise".
struct SimulatedDetectorOptions {
  bool noisy = true;                    ///< False: exact boxes, no misses, no false alarms.
  int min_visible_px = 200;             ///< Smaller ones are not detected.           Range: >= 1
  double min_unhidden_share = 0.2;      ///< Objects hidden more are not seen.       Range: 0 .. 1
  double miss_rate = 0.15;              ///< Share of visible objects missed.        Range: 0 .. 1
  double false_alarms_per_frame = 0.3;  ///< Mean of a Poisson distribution.        Range: 0 .. 20
  double box_jitter = 0.04;             ///< Std. dev. of an edge, share of side.   Range: 0 .. 1
  double similar_weight = 0.2;          ///< Share of the weight at similar classes. Range: 0 .. 1
  double wrong_class_rate = 0.05;       ///< Share that names a wrong class outright. Range: 0 .. 1
  double min_score = 0.3;               ///< Scores are uniform from here ...       Range: 0 .. 1
  double max_score = 0.95;              ///< ... to here.                           Range: 0 .. 1
  double perfect_probability = 0.99;    ///< Of the true class without noise.       Range: 0 .. 1
  /// Also give a mask of each object, not of false alarms: its pixels, or what a segmentation
  /// network makes of them when `noisy`.
  bool masks = false;
  /// What the detector can name. Empty: `coco_class_names()`.
  std::vector<std::string> class_names = {};
};

/// Errors: kInvalidArgument naming the field as one of SimulationOptions: "detector.miss_rate".
[[nodiscard]] Result<void> validate(const SimulatedDetectorOptions& options);
[[nodiscard]] const OptionTable& option_table(const SimulatedDetectorOptions& options);

/// `usual` with a further 35 % of the visible objects missed, one more false alarm a frame and box
/// edges of 8 %. Source: docs/EVALUATION.md, "Noise", the worse detector.
[[nodiscard]] SimulatedDetectorOptions worse_detector(SimulatedDetectorOptions usual = {});

/// An object as it appears in one image.
struct VisibleObject {
  ObjectId id;
  std::string_view class_name;
  PixelBox box_px;  ///< Around its visible pixels.
  int visible_px = 0;
  double unhidden_share = 0.0;  ///< Of its own silhouette.
};

/// What is seen of each object: box and number of its pixels, in id order, those without a pixel
/// left out. `class_names[id - 1]` is the class of object id; shares are left at 0.
[[nodiscard]] std::vector<VisibleObject> visible_objects(
    const Image<ObjectId>& instances, std::span<const std::string_view> class_names);

/// What a detector says of one frame.
struct SimulatedDetections {
  /// Those of the objects that are visible and can be named, in id order, then false alarms.
  std::vector<Detection> detections;
  /// Objects that the detections name by their own class, in id order.
  std::vector<ObjectId> named_rightly;
};

/// Names objects in images. A value: same seed, same frame, same objects give the same detections.
///
/// Class vectors of the noisy detector: the score is the weight of the named class; of it a fifth
/// goes to similar classes (chair/sofa, cup/bottle, tvmonitor/laptop, diningtable/desk, table/desk,
/// as far as the detector knows them), and what is left to 1 spreads evenly over the others. A
/// wrong class is a similar one where there is one, else any.
class SimulatedDetector {
 public:
  /// Adds the detector's classes to `registry`.
  /// Errors: of `validate` and of `ClassRegistry::add`.
  [[nodiscard]] static Result<SimulatedDetector> create(const SimulatedDetectorOptions& options,
                                                        ClassRegistry& registry,
                                                        std::uint64_t seed);

  /// True when the detector has a word for the class.
  [[nodiscard]] bool knows_class(std::string_view class_name) const;

  /// True when an object of this size and openness counts as visible.
  [[nodiscard]] bool is_visible(const VisibleObject& object) const;

  /// Requires: `objects` are given in id order.
  [[nodiscard]] SimulatedDetections detect(std::span<const VisibleObject> objects,
                                           const Image<ObjectId>& instances,
                                           std::uint64_t frame) const;

 private:
  struct Known {
    ClassId id;
    std::string canonical;
    std::vector<std::size_t> similar;  ///< Positions in known_.
  };
  SimulatedDetector() = default;
  [[nodiscard]] std::optional<std::size_t> position_of(std::string_view class_name) const;
  /// `weight` on the named class (noisy: a part of it on similar ones), the rest spread evenly.
  [[nodiscard]] std::vector<ClassEvidence> class_vector(std::size_t named, double weight) const;
  /// A similar class when there is one, else any other.
  [[nodiscard]] std::size_t wrong_class(std::size_t truth, CounterRng& random) const;
  /// Whether a detection of `object` names it by its own class. Requires: a class that is known.
  [[nodiscard]] bool names_rightly(const Detection& detection, const VisibleObject& object) const;
  [[nodiscard]] std::optional<Detection> detect_one(const VisibleObject& object,
                                                    const Image<ObjectId>& instances,
                                                    std::uint64_t frame) const;
  [[nodiscard]] Detection false_alarm(const Image<ObjectId>& instances, CounterRng& random) const;

  SimulatedDetectorOptions options_;
  std::uint64_t seed_ = 0;
  std::vector<Known> known_;
};

}  // namespace hypermap
