// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What was said about one object, by whom, from where, and what came of it.
///
/// Ours: the answer to "why is this in the map?". Memory: at most 16 KB an object.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// What one frame shows of the place where an object should be.
enum class Visibility : std::uint8_t {
  kOutOfView,       ///< Outside the picture or the range.
  kVisible,         ///< Its surface is where it should be.
  kPartlyOccluded,  ///< Some of it is visible, something hides the rest.
  kOccluded,        ///< Something in front hides it.
  kAbsent,          ///< The camera looks through the place where it should be.
};

/// What an entry of the ledger records.
enum class LedgerKind : std::uint8_t {
  kDetection,  ///< A detector saw it.
  kVerdict,    ///< It should have been seen and was not, or was gone.
};

/// One thing said about an object.
struct LedgerEntry {
  std::uint64_t frame_index = 0;
  Stamp stamp = {};
  LedgerKind kind = LedgerKind::kDetection;
  Visibility visibility = Visibility::kVisible;
  DetectorId detector = {};  ///< 0 for verdicts.
  ClassId class_id = {};     ///< Named by the detector; the object's own for verdicts.
  float score = 0.0F;        ///< Of the detection; the visible share for verdicts.
  float bearing_rad = 0.0F;  ///< Of the camera from the object, in the map frame.
  float distance_m = 0.0F;
  float effect = 0.0F;  ///< Change of the existence in log-odds.
  friend bool operator==(const LedgerEntry&, const LedgerEntry&) = default;
};

/// Sums over all entries of one kind, detector, class and direction.
struct LedgerSummary {
  LedgerKind kind = LedgerKind::kDetection;
  DetectorId detector = {};
  ClassId class_id = {};
  std::uint8_t bearing_bin = 0;  ///< 0 to 17: 20 degrees each, as the visibility histogram's.
  std::uint32_t count = 0;
  float score_sum = 0.0F;
  float effect_sum = 0.0F;
  std::uint64_t last_frame_index = 0;
  friend bool operator==(const LedgerSummary&, const LedgerSummary&) = default;
};

/// Everything that a ledger holds, for storing it.
struct ObjectLedgerState {
  std::optional<LedgerEntry> first;
  std::vector<LedgerEntry> newest;       ///< Oldest first.
  std::vector<LedgerSummary> summaries;  ///< Ascending by kind, detector, class, bearing bin.
  std::uint64_t num_unsummarised = 0;    ///< Entries that came when all summaries were taken.
  friend bool operator==(const ObjectLedgerState&, const ObjectLedgerState&) = default;
};

/// The first and the newest entries, and sums over all of them.
class ObjectLedger {
 public:
  static constexpr std::size_t kMaxNewest = 64;
  static constexpr std::size_t kMaxSummaries = 256;
  static constexpr int kNumBearingBins = 18;

  ObjectLedger() = default;
  /// Errors: kInvalidArgument: more entries or summaries than are kept, summaries not ascending, a
  /// bin beyond the last, a number that is not finite, newest entries without a first one.
  [[nodiscard]] static Result<ObjectLedger> from_state(ObjectLedgerState state);

  void add(const LedgerEntry& entry);
  /// Joins the ledger of an object that turned out to be the same: newest by frame, then as here.
  void merge(const ObjectLedger& other);

  /// Detections of `class_id` (any class when none) that were recorded in sums.
  [[nodiscard]] std::uint64_t num_detections(std::optional<ClassId> class_id = {}) const;
  [[nodiscard]] const ObjectLedgerState& state() const noexcept { return state_; }
  friend bool operator==(const ObjectLedger&, const ObjectLedger&) = default;

 private:
  void summarise(const LedgerSummary& addition);

  ObjectLedgerState state_;
};

static_assert(sizeof(LedgerEntry) * (ObjectLedger::kMaxNewest + 1) +
                      sizeof(LedgerSummary) * ObjectLedger::kMaxSummaries + sizeof(ObjectLedger) <=
                  std::size_t{16} * 1024,
              "a ledger takes at most 16 KB");

/// Bin of 20 degrees that a bearing falls into; bin 0 starts at 0, counter-clockwise.
[[nodiscard]] std::uint8_t ledger_bearing_bin(double bearing_rad);

}  // namespace hypermap
