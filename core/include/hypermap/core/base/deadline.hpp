// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How long the detections of one frame may be worked on, for live use.
///
/// Source: [smap] appendix F.4. What is not done in time is left out and counted; a map made with a
/// deadline depends on the clock, so there is none unless it is asked for.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstddef>

namespace hypermap {

struct OptionTable;

enum class DeadlineRule {
  kNone,   ///< All detections, however long it takes.
  kFixed,  ///< `frame_s` from the start of the frame.
  kSmap,   ///< The lifetime of [smap] Eq. (F.1) for as many threads as there are detections.
};

struct DeadlineOptions {
  DeadlineRule rule = DeadlineRule::kNone;
  /// Rule fixed: no detection is begun later than this after the start of its frame. Unit: second.
  double frame_s = 0.05;
  friend bool operator==(const DeadlineOptions&, const DeadlineOptions&) = default;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const DeadlineOptions& options);
[[nodiscard]] const OptionTable& option_table(const DeadlineOptions& options);

/// How long a thread that works on one object may live while `num_active` of them are at work.
///
/// Source: [smap] Eq. (F.1): 1000 e^(-th / 1.738) ms; at most 8 threads (section 4.1).
/// Boundary: 0 counts as 1, more than 8 as 8. Unit: second.
[[nodiscard]] double object_lifetime_s(std::size_t num_active);

/// When to stop beginning detections, from the start of their frame; infinite without a deadline.
///
/// Deviation: the source gives each object a thread that starts with the frame and is cut off after
/// its lifetime, so that all of them end together. Here what was begun is finished, and nothing is
/// begun after that moment. Unit: second.
[[nodiscard]] double deadline_s(const DeadlineOptions& options, std::size_t num_detections);

}  // namespace hypermap
