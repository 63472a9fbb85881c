// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/objects/association.hpp"

#include <cmath>
#include <string>

namespace hypermap {
namespace {

struct Check {
  const char* field;
  double value;
  bool ok;
  const char* rule;
};

Check positive(const char* field, double value) {
  return {field, value, std::isfinite(value) && value > 0.0, "must be finite and > 0"};
}

Check not_negative(const char* field, double value) {
  return {field, value, std::isfinite(value) && value >= 0.0, "must be finite and >= 0"};
}

Check share(const char* field, double value) {
  return {field, value, value >= 0.0 && value <= 1.0, "must be in [0, 1]"};
}

Check finite(const char* field, double value) {
  return {field, value, std::isfinite(value), "must be finite"};
}

template <class Checks>
Result<void> first_failure(const Checks& checks) {
  for (const Check& check : checks) {
    if (check.ok) continue;
    return fail(ErrorCode::kInvalidArgument,
                std::string(check.rule) + ", is " + number_text(check.value),
                check.field);
  }
  return {};
}

Result<void> validate_assignment(const AssignmentOptions& o) {
  return first_failure(std::initializer_list<Check>{
      positive("assignment.near_m", o.near_m),
      share("assignment.same_class_agreement", o.same_class_agreement),
      share("assignment.same_class_share", o.same_class_share),
      share("assignment.same_class_box_share", o.same_class_box_share),
      not_negative("assignment.same_class_distance", o.same_class_distance),
      share("assignment.other_class_share", o.other_class_share),
      share("assignment.part_share", o.part_share),
      share("assignment.part_diagonal", o.part_diagonal),
      positive("assignment.part_maturity", o.part_maturity),
      {"assignment.merge_factor", o.merge_factor, o.merge_factor >= 1.0, "must be >= 1"}});
}

}  // namespace

Result<void> validate(const AssociationOptions& options) {
  HYPERMAP_TRY(validate_assignment(options.assignment));
  const double most = options.max_box_confidence;
  HYPERMAP_TRY(first_failure(std::initializer_list<Check>{
      share("min_jaccard", options.min_jaccard),
      positive("radius_m", options.radius_m),
      positive("position_error_m", options.position_error_m),
      positive("tracking_factor", options.tracking_factor),
      not_negative("shape_leaf_m", options.shape_leaf_m),
      {"max_box_confidence", most, most > 0.5 && most < 1.0, "must be above 0.5 and below 1"},
      share("min_gain", options.min_gain),
      positive("max_box_log_odds", options.max_box_log_odds.value()),
      finite("new_existence", options.new_existence.value()),
      not_negative("seen_existence", options.seen_existence.value()),
      finite("max_existence", options.max_existence.value())}));
  HYPERMAP_TRY(validate(options.belief));
  HYPERMAP_TRY(validate(options.histogram));
  return validate(options.points);
}

}  // namespace hypermap
