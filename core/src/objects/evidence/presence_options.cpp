// SPDX-License-Identifier: BSD-3-Clause
// Options of what it means not to be seen, and of which objects the map stands for.
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/objects/absence.hpp"
#include "hypermap/core/objects/confirmation.hpp"
#include "hypermap/core/objects/object.hpp"

namespace hypermap {
namespace {

using Absence = AbsenceOptions;
using Confirmation = ConfirmationOptions;

constexpr std::string_view kVisibilityNames[] = {"rays", "hull", "panels"};
constexpr std::string_view kRemovalNames[] = {"existence", "confidence"};
constexpr std::string_view kConfidenceNames[] = {"real_and_class", "weighted", "multiplied"};

constexpr OptionRow kConfidenceRows[] = {
    option::choice<&ObjectConfidenceOptions::rule>("rule",
                                                   kConfidenceNames,
                                                   {.source = "[smap] Eq. (3.27)",
                                                    .effect = "What an object's confidence is.",
                                                    .smap = ConfidenceRule::kWeighted,
                                                    .hypermap = ConfidenceRule::kMultiplied}),
};

/// [smap] has no existence, attenuates what is partly occluded and decays a little what is hidden,
/// without a number; an object whose panels lie inside it is valid.
constexpr OptionRow kAbsenceRows[] = {
    option::choice<&Absence::policy>("policy",
                                     kVisibilityNames,
                                     {.effect = "Who judges what a frame shows of known objects.",
                                      .smap = VisibilityPolicy::kPanels,
                                      .hypermap = VisibilityPolicy::kHull}),
    option::number<&Absence::missed_decay>(
        "missed_decay",
        {0, 1000},
        {.unit = "log-odds",
         .source = "[hypermap] 3.4.5",
         .effect = "Taken from the existence of what is visible and not detected.",
         .smap = 0.0,
         .hypermap = 0.2}),
    option::number<&Absence::absent_decay>(
        "absent_decay",
        {0, 1000},
        {.unit = "log-odds", .effect = "Taken from the existence of what is absent.", .smap = 0.0}),
    option::number<&Absence::absent_class_decay>(
        "absent_class_decay",
        {0, 1000},
        {.unit = "log-odds",
         .source = "[smap] figure 3.23",
         .effect = "Taken from all classes of what is absent.",
         .hypermap = 0.0}),
    option::number<&Absence::partly_occluded_factor>(
        "partly_occluded_factor",
        {0, 1},
        {.source = "[smap] 3.5.2",
         .effect = "Share of the decay when partly occluded.",
         .smap = 0.5}),
    option::number<&Absence::occluded_factor>(
        "occluded_factor",
        {0, 1},
        {.source = "[smap] 3.5.2", .effect = "Share of the decay when occluded.", .smap = 0.1}),
    option::number<&Absence::unseen_side_factor>(
        "unseen_side_factor",
        {0, 1},
        {.source = "[smap] 3.5.2",
         .effect = "Share of the decay from a side on which it was never detected.",
         .hypermap = 1.0}),
    option::flag<&Absence::spare_seen>("spare_seen",
                                       {.effect = "Objects that this frame detected lose nothing.",
                                        .smap = false,
                                        .hypermap = false}),
    option::number<&Absence::expected_range_factor>(
        "expected_range_factor",
        {0, 1000},
        {.effect = "Times the farthest detection within which one is expected; 0: everywhere.",
         .smap = 0.0,
         .hypermap = 0.0}),
    option::choice<&Absence::removal>(
        "removal",
        kRemovalNames,
        {.effect = "When an object leaves the map.", .smap = RemovalRule::kConfidence}),
    option::number<&Absence::min_existence>("min_existence",
                                            {-1000, 1000},
                                            {.unit = "log-odds",
                                             .source = "public implementation of [hypermap]: -5",
                                             .effect = "Removed below.",
                                             .hypermap = -5.0}),
    option::number<&Absence::min_confidence>("min_confidence",
                                             {0, 1},
                                             {.unit = "probability",
                                              .source = "[smap] table D.2, o_valid",
                                              .effect = "Removed below.",
                                              .smap = 0.5}),
    option::section<&Absence::confidence>("confidence"),
    option::count<&Absence::graph_layers>(
        "graph_layers",
        {0, 1000000},
        {.unit = "edges",
         .source = "[smap] 3.5.5, figure 3.23",
         .effect = "Policy panels: objects so near the sensor's vertex decay; none: anywhere.",
         .smap = 5}),
    option::number<&Absence::panel_tolerance_m>(
        "panel_tolerance_m",
        {0, 100},
        {.unit = "m", .source = "[smap] figure 3.24", .effect = "Widens the box against panels."}),
    option::number<&Absence::absent_share>(
        "absent_share", {0, 1}, {.effect = "Share of panels after the box that means absent."}),
    option::number<&Absence::occluded_share>(
        "occluded_share",
        {0, 1},
        {.effect = "Share of panels before the box that means occluded."}),
};

/// The sources lower an existence, or a confidence, instead.
constexpr OptionRow kGoneRows[] = {
    option::count<&GoneRule::looks>(
        "looks",
        {0, ObservationLog::kMaxNewest},
        {.effect = "Clear looks through its place in a row that end an object; 0: none do.",
         .smap = 0,
         .hypermap = 0}),
    option::number<&GoneRule::seconds>(
        "seconds",
        {0, 3600},
        {.unit = "s",
         .effect = "Time over which they are, at least; not asked of what was rarely detected."}),
    option::count<&GoneRule::detections_per_look>(
        "detections_per_look",
        {1, 1000},
        {.effect = "Detections that a clear look outweighs: what fewer than `looks` outweigh ends "
                   "after those, over any time. P(real) goes by the defaults."}),
    option::count<&GoneRule::rare_looks>(
        "rare_looks",
        {0, ObservationLog::kMaxNewest},
        {.effect = "The fewest looks that end what was rarely detected; 0: as all else. P(real) "
                   "goes by the defaults."}),
};

constexpr OptionRow kPublicationRows[] = {
    option::number<&Confirmation::min_existence>("min_existence",
                                                 {-1000, 1000},
                                                 {.unit = "log-odds",
                                                  .source = "[hypermap] 3.4.5",
                                                  .effect = "Published above; none: not asked.",
                                                  .smap = kNoValue,
                                                  .hypermap = 2.0}),
    option::number<&Confirmation::min_real_probability>(
        "min_real_probability",
        {0, 1},
        {.unit = "probability",
         .effect = "Probability of being real, from here on; none: not asked.",
         .smap = kNoValue,
         .hypermap = kNoValue}),
    option::section<&Confirmation::gone>("gone"),
    option::number<&Confirmation::min_confidence>(
        "min_confidence",
        {0, 1},
        {.unit = "probability",
         .source = "[smap] table D.2, o_valid",
         .effect = "Published from here on; none: not asked.",
         .smap = 0.5}),
    option::section<&Confirmation::confidence>("confidence"),
    option::count<&Confirmation::min_observations>(
        "min_observations",
        {0, 1000000},
        {.effect = "Seen less often is not enough.", .smap = 1, .hypermap = 1}),
    option::flag<&Confirmation::one_per_place>(
        "one_per_place",
        {.effect = "Of two objects on the same points only the stronger.",
         .smap = false,
         .hypermap = false}),
    option::number<&Confirmation::same_place_share>(
        "same_place_share", {0, 1}, {.effect = "Share of points that makes it the same place,"}),
    option::number<&Confirmation::same_place_diagonal>(
        "same_place_diagonal", {0, 1}, {.effect = "and least share of the diagonal."}),
    option::count<&Confirmation::apart_frames>(
        "apart_frames",
        {0, 64},
        {.effect = "Both are there when detected apart in so many frames,"}),
    option::number<&Confirmation::apart_share>(
        "apart_share", {0, 1}, {.effect = "and in this share of those of the weaker one."}),
};

}  // namespace

const OptionTable& option_table(const ObjectConfidenceOptions&) {
  static constexpr OptionTable kTable{kConfidenceRows};
  return kTable;
}

const OptionTable& option_table(const GoneRule&) {
  static constexpr OptionTable kTable{kGoneRows};
  return kTable;
}

const OptionTable& option_table(const AbsenceOptions&) {
  static constexpr OptionTable kTable{kAbsenceRows};
  return kTable;
}

Result<void> validate(const AbsenceOptions& options) {
  return check_options(options);
}

const OptionTable& option_table(const ConfirmationOptions&) {
  static constexpr OptionTable kTable{kPublicationRows};
  return kTable;
}

Result<void> validate(const ConfirmationOptions& options) {
  return check_options(options);
}

}  // namespace hypermap
