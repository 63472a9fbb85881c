// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Why an object is in the map, what speaks against it, and what would remove it.
///
/// Ours. From the observation log, which sums up all that was seen of an object since it is there.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/objects/absence.hpp"
#include "hypermap/core/objects/confirmation.hpp"
#include "hypermap/core/objects/object_beliefs.hpp"
#include "hypermap/core/objects/object_map.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace hypermap {

/// Detections that named an object one class, by one detector.
struct Naming {
  DetectorId detector;
  ClassId class_id;
  std::uint64_t num_detections = 0;
  double mean_score = 0.0;
  int num_directions = 0;  ///< Bearing bins of 20 degrees.
  std::uint64_t last_frame_index = 0;
  friend bool operator==(const Naming&, const Naming&) = default;
};

/// Frames that should have shown an object to a detector and gave no detection of it.
struct MissedDetections {
  std::uint64_t num_frames = 0;
  double mean_visible_share = 0.0;  ///< Of the object in them; 0 where the camera looked through.
  double existence_lost = 0.0;      ///< By them. Unit: log-odds.
  friend bool operator==(const MissedDetections&, const MissedDetections&) = default;
};

/// What would remove an object from those that are shown, or from the map, if nothing showed it
/// again.
struct Removal {
  AbsenceRun clear_looks;  ///< Through its place, up to now.
  /// Further ones, one after the other, after which it is gone; 0: it is. None: never.
  std::optional<std::uint32_t> looks_until_gone;
  double seconds_until_gone = 0.0;  ///< From the first of the looks to the last of them, at least.
  /// After which it leaves the map, by rule kExistence, when they come from sides on which it was
  /// detected. None: another rule, or no decay.
  std::optional<std::uint32_t> looks_until_removed;
  /// The same from sides on which it never was, which take less (`unseen_side_factor`).
  std::optional<std::uint32_t> looks_until_removed_unseen;
  /// By rule kConfidence: the confidence now, and that below which it leaves the map.
  struct Threshold {
    Probability confidence;
    Probability removed_below;
    friend bool operator==(const Threshold&, const Threshold&) = default;
  };
  std::optional<Threshold> threshold = std::nullopt;
  friend bool operator==(const Removal&, const Removal&) = default;
};

/// How many times as probable outside knowledge makes the class that an object is shown as, and the
/// runner-up. Source: [smap] Eq. (3.17).
struct PriorFactors {
  double best = 1.0;
  double runner_up = 1.0;
  /// Whether each observation had one and these are of the newest; else they hold once for all.
  bool is_of_each_observation = false;
  friend bool operator==(const PriorFactors&, const PriorFactors&) = default;
};

/// All that decides whether and as what an object is shown.
struct Explanation {
  ObjectId id;
  ObjectBeliefs beliefs;
  Probability confidence;                          ///< By the rule that all outputs have it by.
  std::vector<MissedCondition> missed_conditions;  ///< Empty: it is confirmed.
  std::optional<ObservationLogEntry> first;
  std::optional<ObservationLogEntry> newest;
  /// The newest detection. None when it is so old that of it only the frame is kept.
  std::optional<ObservationLogEntry> last_seen;
  std::optional<std::uint64_t> last_seen_frame;  ///< Of the newest detection.
  std::vector<Naming> namings;           ///< Most detections first, then by class, then detector.
  std::vector<std::uint8_t> directions;  ///< Bearing bins with a detection, ascending.
  MissedDetections missed_detections;
  Removal removal;
  /// None where it says nothing of both, or there is no runner-up.
  std::optional<PriorFactors> prior = std::nullopt;
  friend bool operator==(const Explanation&, const Explanation&) = default;
};

/// None when the map has no such object. The rules are those that the map was made by, where they
/// are known. Cost: that of `confirmation_results`.
[[nodiscard]] std::optional<Explanation> explain(const ObjectMap& objects,
                                                 ObjectId id,
                                                 const ConfirmationOptions& confirmation = {},
                                                 const AbsenceOptions& absence = {});

}  // namespace hypermap
