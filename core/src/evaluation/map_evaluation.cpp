// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/map_evaluation.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/evaluation/match_gate.hpp"
#include "hypermap/core/objects/assignment.hpp"
#include "running_mean.hpp"
#include "truth_averages.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

namespace hypermap {
namespace {

/// Half the longest horizontal side.
double half_width_m(const EvaluatedObject& object) {
  const Rect box = bounds(object.footprint);
  return 0.5 * (box.max - box.min).maxCoeff();
}

std::optional<double> box_iou(const EvaluatedObject& a, const EvaluatedObject& b) {
  if (!a.box || !b.box) return std::nullopt;
  return intersection_over_union(*a.box, *b.box);
}

/// The objects of one class on both sides, as positions in the input.
struct ClassMembers {
  std::vector<std::size_t> map;
  std::vector<std::size_t> truth;
};

/// The class of a map object in the one-to-one metric.
enum class MapObjectStatus { kMatched, kExcluded, kDuplicate, kFalse };

class Evaluation {
 public:
  Evaluation(std::span<const EvaluatedObject> map,
             std::span<const EvaluatedObject> truth,
             const EvaluationOptions& options)
      : map_(map),
        truth_(truth),
        options_(options),
        statuses_(map.size(), MapObjectStatus::kFalse) {}

  EvaluationReport run() {
    const auto members = members_by_class();
    results_.resize(truth_.size());
    for (const auto& [name, group] : members) {
      match_one_to_one(group);
      find_nearest(group);
    }
    EvaluationReport report;
    std::vector<const ClassMembers*> everyone;
    for (const auto& [name, group] : members) {
      report.classes[name] = metrics_of({&group});
      everyone.push_back(&group);
    }
    report.all = metrics_of(everyone);
    list_results(members, report);
    return report;
  }

 private:
  [[nodiscard]] std::map<std::string, ClassMembers> members_by_class() const {
    std::set<std::string> chosen;
    for (const std::string& name : options_.classes) chosen.insert(canonical_class_name(name));
    std::map<std::string, ClassMembers> members;
    const auto is_chosen = [&](const std::string& name) {
      return chosen.empty() || chosen.contains(name);
    };
    for (std::size_t i = 0; i < map_.size(); ++i) {
      const std::string name = canonical_class_name(map_[i].class_name);
      if (is_chosen(name)) members[name].map.push_back(i);
    }
    for (std::size_t i = 0; i < truth_.size(); ++i) {
      const std::string name = canonical_class_name(truth_[i].class_name);
      if (is_chosen(name)) members[name].truth.push_back(i);
    }
    return members;
  }

  [[nodiscard]] double distance(std::size_t map_index, std::size_t truth_index) const {
    return (map_[map_index].centroid - truth_[truth_index].centroid).norm();
  }

  [[nodiscard]] double gate_m(std::size_t truth_index) const {
    return match_gate_m(truth_[truth_index], options_);
  }

  /// Hungarian over the counted truths first, then the remaining map objects over the excluded
  /// ones.
  void match_one_to_one(const ClassMembers& group) {
    std::vector<std::size_t> counted;
    std::vector<std::size_t> excluded;
    for (const std::size_t t : group.truth) (truth_[t].excluded ? excluded : counted).push_back(t);
    for (const auto& [m, t] : assign_within_gates(group.map, counted)) {
      statuses_[m] = MapObjectStatus::kMatched;
      results_[t].matched_map_index = m;
      results_[t].matched_distance_m = distance(m, t);
      results_[t].jaccard_in_place = jaccard(map_[m].footprint, truth_[t].footprint);
      results_[t].footprint_covered = covered_share(truth_[t].footprint, map_[m].footprint);
      results_[t].box_iou = box_iou(map_[m], truth_[t]);
    }
    std::vector<std::size_t> left = group.map;
    std::erase_if(left, [&](std::size_t m) { return statuses_[m] == MapObjectStatus::kMatched; });
    for (const auto& [m, t] : assign_within_gates(left, excluded))
      statuses_[m] = MapObjectStatus::kExcluded;
    for (const std::size_t t : counted) mark_duplicates_of(t, left);
  }

  /// Of the objects left over those at the truth, beyond the first there.
  void mark_duplicates_of(std::size_t t, const std::vector<std::size_t>& left) {
    const double reach_m = std::max(gate_m(t), half_width_m(truth_[t]));
    std::vector<std::size_t> there;
    std::copy_if(left.begin(), left.end(), std::back_inserter(there), [&](std::size_t m) {
      const bool is_false = statuses_[m] != MapObjectStatus::kExcluded;
      return is_false && distance(m, t) <= reach_m;
    });
    if (there.empty()) return;
    if (!results_[t].matched_map_index) {
      there.erase(std::min_element(there.begin(), there.end(), [&](std::size_t a, std::size_t b) {
        return distance(a, t) < distance(b, t);
      }));
    }
    for (const std::size_t m : there) statuses_[m] = MapObjectStatus::kDuplicate;
  }

  [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> assign_within_gates(
      const std::vector<std::size_t>& map_side, const std::vector<std::size_t>& truth_side) const {
    Eigen::MatrixXd costs(static_cast<Eigen::Index>(map_side.size()),
                          static_cast<Eigen::Index>(truth_side.size()));
    for (Eigen::Index i = 0; i < costs.rows(); ++i) {
      for (Eigen::Index k = 0; k < costs.cols(); ++k) {
        const std::size_t t = truth_side[static_cast<std::size_t>(k)];
        const double d = distance(map_side[static_cast<std::size_t>(i)], t);
        costs(i, k) = kForbiddenPair;
        if (d <= gate_m(t)) costs(i, k) = d;
      }
    }
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    const auto columns = assign(costs);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i]) pairs.emplace_back(map_side[i], truth_side[*columns[i]]);
    }
    return pairs;
  }

  /// Steps 2 to 4 of [hypermap] 5.2.1.
  void find_nearest(const ClassMembers& group) {
    if (group.map.empty()) return;
    for (const std::size_t t : group.truth) {
      const std::size_t nearest =
          *std::min_element(group.map.begin(), group.map.end(), [&](std::size_t a, std::size_t b) {
            return distance(a, t) < distance(b, t);
          });
      const Eigen::Vector2d offset = truth_[t].centroid - map_[nearest].centroid;
      results_[t].nearest_map_index = nearest;
      results_[t].nearest_distance_m = offset.norm();
      results_[t].aligned_jaccard =
          jaccard(translated(map_[nearest].footprint, offset), truth_[t].footprint);
    }
  }

  [[nodiscard]] ClassMetrics metrics_of(const std::vector<const ClassMembers*>& groups) const {
    return {nearest_metric(groups), one_to_one_metric(groups)};
  }

  [[nodiscard]] NearestMetric nearest_metric(const std::vector<const ClassMembers*>& groups) const {
    NearestMetric metric;
    RunningMean distances;
    RunningMean jaccards;
    for (const ClassMembers* group : groups) {
      metric.num_truth += group->truth.size();
      for (const std::size_t t : group->truth) {
        if (!results_[t].nearest_map_index) continue;
        distances.add(results_[t].nearest_distance_m);
        jaccards.add(results_[t].aligned_jaccard);
      }
    }
    metric.n = distances.n();
    metric.distance_m = distances.value();
    metric.jaccard = jaccards.value();
    return metric;
  }

  [[nodiscard]] OneToOneMetric one_to_one_metric(
      const std::vector<const ClassMembers*>& groups) const {
    OneToOneMetric metric;
    TruthAverages averages(options_);
    for (const ClassMembers* group : groups) {
      for (const std::size_t m : group->map) {
        metric.num_map += statuses_[m] == MapObjectStatus::kExcluded ? 0U : 1U;
        metric.duplicates += statuses_[m] == MapObjectStatus::kDuplicate ? 1U : 0U;
      }
      for (const std::size_t t : group->truth) {
        if (truth_[t].excluded) {
          ++metric.excluded;
          metric.rarely_seen += truth_[t].is_nameable ? 1U : 0U;
          continue;
        }
        ++metric.num_truth;
        averages.add(truth_[t], results_[t]);
      }
    }
    averages.write_to(metric);
    fill_ratios(metric);
    return metric;
  }

  static void fill_ratios(OneToOneMetric& metric) {
    const auto matched = static_cast<double>(metric.matched);
    const auto num_map = static_cast<double>(metric.num_map);
    const auto num_truth = static_cast<double>(metric.num_truth);
    if (num_map > 0.0) metric.precision = matched / num_map;
    if (num_truth > 0.0) metric.recall = matched / num_truth;
    if (num_map + num_truth > 0.0) metric.f1 = 2.0 * matched / (num_map + num_truth);
  }

  void list_results(const std::map<std::string, ClassMembers>& members, EvaluationReport& report) {
    for (const auto& [name, group] : members) {
      for (const std::size_t t : group.truth) {
        results_[t].truth_index = t;
        report.truths.push_back(results_[t]);
      }
      for (const std::size_t m : group.map) {
        const bool is_duplicate = statuses_[m] == MapObjectStatus::kDuplicate;
        if (is_duplicate) report.duplicates.push_back(m);
        if (is_duplicate || statuses_[m] == MapObjectStatus::kFalse)
          report.false_positives.push_back(m);
      }
    }
    std::sort(report.truths.begin(), report.truths.end(), [](const auto& a, const auto& b) {
      return a.truth_index < b.truth_index;
    });
    std::sort(report.false_positives.begin(), report.false_positives.end());
    std::sort(report.duplicates.begin(), report.duplicates.end());
  }

  std::span<const EvaluatedObject> map_;
  std::span<const EvaluatedObject> truth_;
  const EvaluationOptions& options_;
  std::vector<MapObjectStatus> statuses_;
  std::vector<TruthResult> results_;
};

}  // namespace

EvaluationReport evaluate(std::span<const EvaluatedObject> map,
                          std::span<const EvaluatedObject> truth,
                          const EvaluationOptions& options) {
  return Evaluation(map, truth, options).run();
}

}  // namespace hypermap
