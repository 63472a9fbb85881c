// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/map_evaluation.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/objects/assignment.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

namespace hypermap {
namespace {

/// A running mean that says when there is nothing to average.
class Mean {
 public:
  void add(double value) {
    sum_ += value;
    ++n_;
  }
  [[nodiscard]] std::size_t n() const { return n_; }
  [[nodiscard]] std::optional<double> value() const {
    return n_ == 0 ? std::nullopt : std::optional(sum_ / static_cast<double>(n_));
  }

 private:
  double sum_ = 0.0;
  std::size_t n_ = 0;
};

double size_of(const EvaluatedObject& object) {
  if (object.size_m > 0.0) return object.size_m;
  const Rect box = bounds(object.footprint);
  return (box.max - box.min).maxCoeff();
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
    return size_of(truth_[truth_index]) < options_.small_size_m ? options_.small_gate_m
                                                                : options_.gate_m;
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
    }
    std::vector<std::size_t> left = group.map;
    std::erase_if(left, [&](std::size_t m) { return statuses_[m] == MapObjectStatus::kMatched; });
    for (const auto& [m, t] : assign_within_gates(left, excluded))
      statuses_[m] = MapObjectStatus::kExcluded;
    for (const std::size_t m : left) {
      const bool is_repeated = std::any_of(counted.begin(), counted.end(), [&](std::size_t t) {
        return results_[t].matched_map_index && distance(m, t) <= gate_m(t);
      });
      if (statuses_[m] == MapObjectStatus::kFalse && is_repeated)
        statuses_[m] = MapObjectStatus::kDuplicate;
    }
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
    Mean distances;
    Mean jaccards;
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
    Mean distances;
    Mean judged;
    Mean small;
    for (const ClassMembers* group : groups) {
      for (const std::size_t m : group->map) {
        metric.num_map += statuses_[m] == MapObjectStatus::kExcluded ? 0U : 1U;
        metric.duplicates += statuses_[m] == MapObjectStatus::kDuplicate ? 1U : 0U;
      }
      for (const std::size_t t : group->truth) {
        if (truth_[t].excluded) {
          ++metric.excluded;
          continue;
        }
        ++metric.num_truth;
        if (results_[t].matched_map_index) distances.add(results_[t].matched_distance_m);
        const bool is_judged = area_m2(truth_[t].footprint) >= options_.min_judged_area_m2;
        (is_judged ? judged : small).add(results_[t].jaccard_in_place);
      }
    }
    metric.matched = distances.n();
    metric.distance_m = distances.value();
    metric.jaccard_in_place = judged.value();
    metric.num_judged = judged.n();
    metric.small_jaccard_in_place = small.value();
    metric.num_small = small.n();
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
