// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Observation log of one object: detections and missed detections, with detector, viewpoint and
/// effect.
///
/// Ours: the answer to "why is this in the map?". Memory: at most 16 KB an object.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/log_odds.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/objects/belief_changes.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

struct OptionTable;

/// What one frame shows of the place where an object should be.
enum class Visibility : std::uint8_t {
  kOutOfView,       ///< Outside the image or the range.
  kVisible,         ///< Its surface is where it should be.
  kPartlyOccluded,  ///< Some of it is visible, something hides the rest.
  kOccluded,        ///< Something in front hides it.
  kAbsent,          ///< The camera looks through the place where it should be.
};

/// What an entry of the log records.
enum class ObservationKind : std::uint8_t {
  kDetection,        ///< A detector saw it.
  kMissedDetection,  ///< It was visible and not detected, or absent.
};

/// One observation of an object.
struct ObservationLogEntry {
  std::uint64_t frame_index = 0;
  Stamp stamp = {};
  ObservationKind kind = ObservationKind::kDetection;
  Visibility visibility = Visibility::kVisible;
  DetectorId detector = {};  ///< 0 for missed detections.
  ClassId class_id = {};     ///< Named by the detector; the object's own for missed detections.
  float score = 0.0F;        ///< Of the detection; the visible share for missed detections.
  float bearing_rad = 0.0F;  ///< Of the camera from the object, in the map frame.
  float distance_m = 0.0F;
  float effect = 0.0F;         ///< Change of the existence in log-odds.
  float belief_change = 0.0F;  ///< Of the log-odds of `class_id`, to 0.001; 0 in older archives.
  BeliefChanges other_changes = {};  ///< Of classes beside `class_id`; none in older archives.
  friend bool operator==(const ObservationLogEntry&, const ObservationLogEntry&) = default;
};

/// Sums over all entries of one kind, detector, class and direction.
struct ObservationLogSummary {
  ObservationKind kind = ObservationKind::kDetection;
  DetectorId detector = {};
  ClassId class_id = {};
  std::uint8_t bearing_bin = 0;  ///< 0 to 17: 20 degrees each, as the visibility histogram's.
  std::uint32_t count = 0;
  float score_sum = 0.0F;
  float effect_sum = 0.0F;
  std::uint64_t last_frame_index = 0;
  friend bool operator==(const ObservationLogSummary&, const ObservationLogSummary&) = default;
};

/// All state of a log, for storing it.
struct ObservationLogState {
  std::optional<ObservationLogEntry> first;
  std::vector<ObservationLogEntry> newest;  ///< Oldest first.
  std::vector<ObservationLogSummary>
      summaries;                       ///< Ascending by kind, detector, class, bearing bin.
  std::uint64_t num_unsummarised = 0;  ///< Entries that came when all summaries were taken.
  friend bool operator==(const ObservationLogState&, const ObservationLogState&) = default;
};

/// The first and the newest entries, and sums over all of them.
class ObservationLog {
 public:
  static constexpr std::size_t kMaxNewest = 64;
  static constexpr std::size_t kMaxSummaries = 256;
  static constexpr int kNumBearingBins = 18;
  static constexpr double kDegreesPerBearingBin = 360.0 / kNumBearingBins;

  ObservationLog() = default;
  /// Errors: kInvalidArgument: more entries or summaries than are kept, summaries not ascending, a
  /// bin beyond the last, a number that is not finite, an entry whose other changes are of its own
  /// class, newest entries without a first one.
  [[nodiscard]] static Result<ObservationLog> from_state(ObservationLogState state);

  void add(const ObservationLogEntry& entry);
  /// The frame of the newest entry changed more: so much of the existence, of the log-odds of the
  /// entry's class and of those of other ones. Requires: an entry.
  void add_to_newest(LogOdds existence_change,
                     LogOdds belief_change,
                     const BeliefChanges& other_changes = {});
  /// Joins the log of a duplicate: newest by frame, then as here. A frame that one of them was
  /// detected in and the other one was not shows the thing: the missed detection is taken back, as
  /// far as both are kept one by one.
  void merge(const ObservationLog& other);

  /// Detections of `class_id` (any class when none) that were recorded in sums.
  [[nodiscard]] std::uint64_t num_detections(std::optional<ClassId> class_id = {}) const;
  [[nodiscard]] const ObservationLogState& state() const noexcept { return state_; }
  friend bool operator==(const ObservationLog&, const ObservationLog&) = default;

 private:
  void summarise(const ObservationLogSummary& addition);
  /// Takes an entry that was recorded before out of the sums.
  void take_back(const ObservationLogEntry& entry);

  ObservationLogState state_;
};

static_assert(sizeof(ObservationLogEntry) * (ObservationLog::kMaxNewest + 1) +
                      sizeof(ObservationLogSummary) * ObservationLog::kMaxSummaries +
                      sizeof(ObservationLog) <=
                  std::size_t{16} * 1024,
              "an observation log takes at most 16 KB");

/// Detections that were recorded in sums from the bearing's bin and those beside it.
/// Cost: linear in the log's summaries.
[[nodiscard]] std::uint64_t num_detections_from(const ObservationLog& log, double bearing_rad);

/// Whether a detection was ever recorded from the bearing's bin or one beside it. Looks through the
/// object's place change nothing of it, as they would of the visibility histogram.
/// Boundary: true of a log without detections, which knows of no side.
/// Cost: linear in the log's summaries.
[[nodiscard]] bool was_detected_from(const ObservationLog& log, double bearing_rad);

/// How regularly a log's object was detected, from the sums over all its entries.
struct DetectionRegularity {
  std::uint64_t num_detections = 0;
  int num_directions = 0;  ///< Bearing bins with a detection.
  /// Detections with another class than the one that the same detector named most often.
  std::uint64_t num_named_otherwise = 0;
  /// Sum of the visible shares of the frames that should have shown it to the detector and did not.
  double missed_visibility = 0.0;
  friend bool operator==(const DetectionRegularity&, const DetectionRegularity&) = default;
};
[[nodiscard]] DetectionRegularity detection_regularity(const ObservationLog& log);

/// The newest entries of a log in which the camera looks through the object's place, one after the
/// other; whatever shows it there, detected or not, ends them.
struct AbsenceRun {
  std::uint32_t looks = 0;
  Stamp first = {};  ///< Stamps of the first and the last of them.
  Stamp last = {};
  friend bool operator==(const AbsenceRun&, const AbsenceRun&) = default;
};
[[nodiscard]] AbsenceRun absence_run(const ObservationLog& log);

/// When an object is gone: so many clear looks through its place in a row, over so long a time. Who
/// walks through a room is seen a few times at each place, and the place once more for a moment.
/// One frame of false depth is one look; frames in which something hides the place are none.
struct GoneRule {
  std::uint32_t looks = 5;  ///< 0: never. At most ObservationLog::kMaxNewest.
  double seconds = 1.0;     ///< Not asked of a run of kMaxNewest looks, the most that are kept.
  /// A clear look outweighs so many detections, 1 at least: what was detected so rarely that fewer
  /// than `looks` outweigh it is gone after those, over any time.
  std::uint32_t detections_per_look = 5;
  /// The fewest looks that end what was rarely detected; 0: the rule is one for all.
  std::uint32_t rare_looks = 3;
  friend bool operator==(const GoneRule&, const GoneRule&) = default;
};
/// The looks and seconds that the rule asks of an object that was detected so often.
/// Boundary: of one that was never detected, those of the rule.
[[nodiscard]] GoneRule gone_rule_for(std::uint64_t num_detections, const GoneRule& rule);
[[nodiscard]] const OptionTable& option_table(const GoneRule& rule);
[[nodiscard]] bool is_gone(const ObservationLog& log, const GoneRule& rule = {});

/// Frames in whose detections both logs had one of their own, of those that both still hold. Two
/// objects with such frames were told apart by a detector.
[[nodiscard]] std::size_t num_common_frames(const ObservationLog& a, const ObservationLog& b);

/// Detections of two objects in the frames that had both in view.
struct DetectionsInView {
  std::size_t num_frames = 0;
  std::size_t of_first = 0;  ///< Frames of these that detected the first one, ...
  std::size_t of_second = 0;
  std::size_t of_both = 0;
  bool is_complete = false;  ///< None of them is forgotten.

  [[nodiscard]] std::size_t of_any() const noexcept { return of_first + of_second - of_both; }
  /// Detections of both that are to be expected of two things, each detected as often as it was
  /// whether the other one is or not. Boundary: 0 without frames.
  [[nodiscard]] double expected_of_both() const noexcept;
  friend bool operator==(const DetectionsInView&, const DetectionsInView&) = default;
};

/// A log has an object in view in the frames that detected it, and in those in which it noted a
/// missed detection: at least this share of the object was visible, or the camera looked through
/// its place. None when one of them has no entry, or runs restarted their stamps.
/// Boundary: a frame with several entries counts once. What is not noted is not counted, as misses
/// of frames whose detections a deadline dropped. Cost: linear in the kept entries, times their
/// logarithm.
[[nodiscard]] std::optional<DetectionsInView> detections_in_view(const ObservationLog& a,
                                                                 const ObservationLog& b,
                                                                 double least_visible_share);

/// Bin of 20 degrees that a bearing falls into; bin 0 starts at 0, counter-clockwise.
[[nodiscard]] std::uint8_t log_bearing_bin(double bearing_rad);

}  // namespace hypermap
