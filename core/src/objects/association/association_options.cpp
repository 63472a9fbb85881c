// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/objects/association.hpp"
#include "hypermap/core/objects/object.hpp"
#include "objects/option_names.hpp"

namespace hypermap {
namespace {

using Assignment = AssignmentOptions;
using Association = AssociationOptions;
using Carving = BoxCarvingOptions;

constexpr OptionRow kAssignmentRows[] = {
    option::number<&Assignment::near_m>(
        "near_m",
        option::above(0, 10),
        {.unit = "m", .effect = "Points and boxes this near touch."}),
    option::number<&Assignment::same_class_agreement>(
        "same_class_agreement",
        {0, 1},
        {.effect = "Class vectors that agree so much count as one class."}),
    option::number<&Assignment::same_class_share>(
        "same_class_share",
        {0, 1},
        {.effect = "Same class: share of points that must lie in the other,"}),
    option::number<&Assignment::same_class_box_share>(
        "same_class_box_share", {0, 1}, {.effect = "or share of the smaller box,"}),
    option::number<&Assignment::same_class_distance>(
        "same_class_distance",
        {0, 100},
        {.unit = "diagonals", .effect = "or the most distance of the centres."}),
    option::number<&Assignment::other_class_share>(
        "other_class_share",
        {0, 1},
        {.effect = "Other class: share of points of each that must lie in the other,"}),
    option::number<&Assignment::part_share>(
        "part_share", {0, 1}, {.effect = "or nearly all of one lies in the other"}),
    option::number<&Assignment::part_diagonal>(
        "part_diagonal",
        {0, 1},
        {.effect = "and its diagonal is at least this share of the other."}),
    option::number<&Assignment::part_maturity>(
        "part_maturity",
        option::above(0, 1000),
        {.effect = "and it was not seen more than this many times as often."}),
    option::number<&Assignment::merge_factor>(
        "merge_factor",
        {1, 100},
        {.effect = "Objects merge when the shares are exceeded by this factor."}),
    option::count<&Assignment::apart_frames>(
        "apart_frames",
        {1, 64},
        {.effect = "Objects that were detected apart in so many frames do not merge,"}),
    option::number<&Assignment::one_surface_share>(
        "one_surface_share",
        {0, 1},
        {.effect = "unless each has this share of its points in the other."}),
    option::count<&Assignment::hidden_part_detections>(
        "hidden_part_detections",
        {0, 64},
        {.effect =
             "Objects of a class whose boxes touch, seen so often and hardly together, merge; "
             "0: none."}),
    option::number<&Assignment::apart_share>(
        "apart_share",
        {0, 1},
        {.effect = "Observations of one frame that share no more points show two objects."}),
    option::number<&Assignment::contested_factor>(
        "contested_factor",
        {1, 1000},
        {.effect = "A cell goes to the object that agrees on it so many times more."}),
};

constexpr std::string_view kCarvingNames[] = {"none", "boxes", "boxes_and_background"};

constexpr OptionRow kCarvingRows[] = {
    option::choice<&Carving::rule>(
        "rule",
        kCarvingNames,
        {.effect =
             "What of an object is denied: seen outside its box, or on what runs on beyond it.",
         .smap = BoxCarvingRule::kNone,
         .hypermap = BoxCarvingRule::kNone}),
    option::number<&Carving::margin_share>(
        "margin_share", {0, 1}, {.effect = "Boxes reach farther by this share of their sides."}),
    option::number<&Carving::max_share>(
        "max_share",
        {0, 1},
        {.effect =
             "A box that leaves out more of what is seen shows a part, and counts for nothing."}),
};

constexpr std::string_view kAssociationNames[] = {"assignment", "overlap", "radius", "smap"};

constexpr std::string_view kSeveralMatchesNames[] = {"combine", "keep_apart"};

constexpr OptionRow kAssociationRows[] = {
    option::choice<&Association::policy>("policy",
                                         kAssociationNames,
                                         {.effect = "Which object an observation shows.",
                                          .smap = AssociationPolicy::kSmap,
                                          .hypermap = AssociationPolicy::kOverlap}),
    option::section<&Association::assignment>("assignment"),
    option::number<&Association::min_jaccard>(
        "min_jaccard",
        {0, 1},
        {.source = "[hypermap] 3.4.5",
         .effect = "Policy overlap: least Jaccard index of the shapes.",
         .hypermap = 0.2}),
    option::number<&Association::radius_m>("radius_m",
                                           option::above(0, 1000),
                                           {.unit = "m",
                                            .source = "[hypermap] 3.4.5",
                                            .effect = "Policy radius: half side of the square."}),
    option::choice<&Association::several_matches>(
        "several_matches",
        kSeveralMatchesNames,
        {.source = "[hypermap] 3.4.5",
         .effect =
             "Policies overlap and radius: whether objects that one observation matches become "
             "one.",
         .hypermap = SeveralMatches::kCombine}),
    option::number<&Association::position_error_m>("position_error_m",
                                                   option::above(0, 1000),
                                                   {.unit = "m",
                                                    .source = "[smap] table D.2, o_e",
                                                    .effect = "Policy smap: error of a position.",
                                                    .smap = 0.2}),
    option::number<&Association::tracking_factor>(
        "tracking_factor",
        option::above(0, 1000),
        {.source = "[smap] table D.2, o_t",
         .effect = "Policy smap: times that error is the same thing.",
         .smap = 0.5}),
    option::count<&Association::graph_layers>(
        "graph_layers",
        {0, 1000000},
        {.unit = "edges",
         .source = "[smap] 3.5.4, figure 3.22",
         .effect = "Policy smap: candidates are so near the sensor's vertex; none: anywhere.",
         .smap = 3}),
    option::choice<&Association::shape>("shape",
                                        kShapeNames,
                                        {.source = "[hypermap] 3.4.5",
                                         .effect = "Which shape policy overlap compares with.",
                                         .hypermap = ShapePolicy::kBest}),
    option::number<&Association::shape_leaf_m>(
        "shape_leaf_m",
        {0, 10},
        {.unit = "m", .source = "[hypermap] 3.4.4", .effect = "Thins projected points."}),
    option::flag<&Association::box_from_points>(
        "box_from_points",
        {.effect = "The box follows the agreed points instead of a filter.", .smap = false}),
    option::number<&Association::max_box_confidence>(
        "max_box_confidence",
        option::inside(0.5, 1),
        {.unit = "probability",
         .source = "public implementation of [smap]",
         .effect = "A certain box would freeze the object."}),
    option::number<&Association::min_gain>(
        "min_gain", {0, 1}, {.effect = "Smallest gain of the box filter."}),
    option::number<&Association::max_box_log_odds>("max_box_log_odds",
                                                   option::above(0, 1000),
                                                   {.unit = "log-odds",
                                                    .source = "[smap] table D.2",
                                                    .effect = "Clamp of the box confidence."}),
    option::number<&Association::new_existence>(
        "new_existence",
        {-1000, 1000},
        {.unit = "log-odds", .source = "[hypermap] 3.4.5", .effect = "Existence of a new object."}),
    option::number<&Association::seen_existence>(
        "seen_existence",
        {0, 1000},
        {.unit = "log-odds", .source = "[hypermap] 3.4.5", .effect = "Added by each observation."}),
    option::number<&Association::max_existence>("max_existence",
                                                {-1000, 1000},
                                                {.unit = "log-odds",
                                                 .source = "public implementation of [hypermap]",
                                                 .effect = "Cap of the existence."}),
    option::section<&Association::belief>("belief"),
    option::section<&Association::histogram>("histogram"),
    option::section<&Association::points>("points"),
    option::section<&Association::carving>("carving"),
};

}  // namespace

const OptionTable& option_table(const AssignmentOptions&) {
  static constexpr OptionTable kTable{kAssignmentRows};
  return kTable;
}

const OptionTable& option_table(const BoxCarvingOptions&) {
  static constexpr OptionTable kTable{kCarvingRows};
  return kTable;
}

AssociationOptions without_hidden_parts(AssociationOptions options) {
  options.assignment.hidden_part_detections = 0;
  return options;
}

const OptionTable& option_table(const AssociationOptions&) {
  static constexpr OptionTable kTable{kAssociationRows};
  return kTable;
}

Result<void> validate(const AssociationOptions& options) {
  return check_options(options);
}

}  // namespace hypermap
