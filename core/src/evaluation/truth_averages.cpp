// SPDX-License-Identifier: BSD-3-Clause
#include "truth_averages.hpp"

#include <algorithm>

namespace hypermap {

void TruthAverages::add(const EvaluatedObject& truth, const TruthResult& result) {
  const double jaccard = result.jaccard_in_place;
  if (result.matched_map_index) distances_.add(result.matched_distance_m);
  if (result.box_iou) box_ious_.add(*result.box_iou);
  covered_.add(result.footprint_covered);
  if (area_m2(truth.footprint) < options_.min_judged_area_m2) {
    small_.add(jaccard);
    return;
  }
  judged_.add(jaccard);
  worst_ = std::min(worst_.value_or(jaccard), jaccard);
  const auto seen = truth.seen_footprint_share;
  if (seen && *seen >= options_.min_seen_share) seen_.add(jaccard);
}

void TruthAverages::write_to(OneToOneMetric& metric) const {
  metric.matched = distances_.n();
  metric.distance_m = distances_.value();
  metric.jaccard_in_place = judged_.value();
  metric.num_judged = judged_.n();
  metric.small_jaccard_in_place = small_.value();
  metric.num_small = small_.n();
  metric.worst_jaccard_in_place = worst_;
  metric.seen_jaccard_in_place = seen_.value();
  metric.num_seen = seen_.n();
  metric.footprint_covered = covered_.value();
  metric.box_iou = box_ious_.value();
  metric.num_boxes = box_ious_.n();
}

}  // namespace hypermap
