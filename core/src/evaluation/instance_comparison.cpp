// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/instance_comparison.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/objects/assignment.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

namespace hypermap {
namespace {

using Options = InstanceComparisonOptions;

constexpr OptionRow kInstanceRows[] = {
    option::number<&Options::max_distance_m>(
        "max_distance_m",
        option::below(0, kUnbounded),
        {.unit = "m", .effect = "Nearer centres are in place."}),
    option::number<&Options::max_side_share>(
        "max_side_share",
        option::below(0, kUnbounded),
        {.effect = "By which share of the thing's a side may differ."}),
    option::number<&Options::max_chair_height_share>("max_chair_height_share",
                                                     option::below(0, kUnbounded),
                                                     {.effect = "The same for heights of chairs."}),
    option::number<&Options::gate_m>("gate_m",
                                     option::inside(0, kUnbounded),
                                     {.unit = "m", .effect = "Farther centres are another thing."}),
    option::number<&Options::small_gate_m>("small_gate_m",
                                           option::inside(0, kUnbounded),
                                           {.unit = "m", .effect = "The same for small things."}),
    option::number<&Options::small_size_m>(
        "small_size_m",
        option::inside(0, kUnbounded),
        {.unit = "m", .effect = "Things with all sides below this are small."}),
    option::number<&Options::min_box_overlap>(
        "min_box_overlap",
        {0, 1},
        {.effect = "Intersection over union with which a wrong class stands there."}),
    option::number<&Options::near_m>(
        "near_m",
        option::below(0, kUnbounded),
        {.unit = "m", .effect = "How far from a thing an object's centre lies on it."}),
};

constexpr std::array<std::string_view, 6> kStandings{
    "counts", "no word", "no depth", "never whole", "far", "rarely seen"};

double distance_m(const Box& a, const Box& b) {
  return (a.centre() - b.centre()).norm();
}

/// One comparison under way: which objects and things have found their partner.
class InstanceMatching {
 public:
  InstanceMatching(std::span<const ComparedObject> objects,
                   std::span<const ComparedInstance> instances,
                   const Options& options)
      : objects_(objects),
        instances_(instances),
        options_(options),
        is_placed_(objects.size(), false) {
    result_.instances.resize(instances.size());
    for (const ComparedObject& object : objects)
      object_classes_.push_back(canonical_class_name(object.class_name));
    for (const ComparedInstance& instance : instances) {
      auto& names = instance_classes_.emplace_back();
      for (const std::string& name : instance.class_names)
        names.push_back(canonical_class_name(name));
    }
  }

  InstanceComparison run() {
    match(true, [this](std::size_t o, std::size_t t) {
      return distance_within(o, t, options_.max_distance_m);
    });
    for (const bool counts : {true, false}) {
      match(counts, [this](std::size_t o, std::size_t t) {
        return distance_within(o, t, instance_reach_m(instances_[t].box, options_));
      });
    }
    place_wrong_classes();
    for (std::size_t o = 0; o < objects_.size(); ++o) {
      if (!is_placed_[o]) place_left(o);
    }
    count();
    return std::move(result_);
  }

 private:
  /// The cost of a pair; kForbiddenPair when it must not be made.
  using PairCost = std::function<double(std::size_t object, std::size_t instance)>;

  [[nodiscard]] bool counts(std::size_t t) const {
    return instances_[t].standing == InstanceStanding::kCounts;
  }

  [[nodiscard]] bool is_of_right_class(std::size_t o, std::size_t t) const {
    const auto& names = instance_classes_[t];
    return std::find(names.begin(), names.end(), object_classes_[o]) != names.end();
  }

  [[nodiscard]] double distance_within(std::size_t o, std::size_t t, double limit_m) const {
    const double distance = distance_m(objects_[o].box, instances_[t].box);
    if (is_of_right_class(o, t) && distance <= limit_m) return distance;
    return kForbiddenPair;
  }

  /// Pairs of what is left of the objects and of the things that count, or of those that do not.
  [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> best_pairs(
      bool of_counting, const PairCost& cost) const {
    std::vector<std::size_t> rows;
    std::vector<std::size_t> cols;
    for (std::size_t o = 0; o < objects_.size(); ++o) {
      if (!is_placed_[o]) rows.push_back(o);
    }
    for (std::size_t t = 0; t < instances_.size(); ++t) {
      if (counts(t) == of_counting && !result_.instances[t].object) cols.push_back(t);
    }
    Eigen::MatrixXd costs(rows.size(), cols.size());
    for (std::size_t row = 0; row < rows.size(); ++row) {
      for (std::size_t col = 0; col < cols.size(); ++col)
        costs(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(col)) =
            cost(rows[row], cols[col]);
    }
    const auto assigned = assign(costs);
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    pairs.reserve(assigned.size());
    for (std::size_t row = 0; row < assigned.size(); ++row) {
      if (assigned[row]) pairs.emplace_back(rows[row], cols[*assigned[row]]);
    }
    return pairs;
  }

  void match(bool of_counting, const PairCost& cost) {
    for (const auto& [o, t] : best_pairs(of_counting, cost)) {
      is_placed_[o] = true;
      record_match(o, t);
    }
  }

  void record_match(std::size_t o, std::size_t t) {
    const Box& instance = instances_[t].box;
    InstanceResult& result = result_.instances[t];
    result.object = o;
    result.distance_m = distance_m(objects_[o].box, instance);
    result.is_in_place = result.distance_m <= options_.max_distance_m;
    result.side_ratios = objects_[o].box.extent().cwiseQuotient(instance.extent());
    Eigen::Array3d allowed = Eigen::Array3d::Constant(options_.max_side_share);
    if (object_classes_[o] == "chair") allowed.z() = options_.max_chair_height_share;
    const Eigen::Array3d deviation = (objects_[o].box.extent() - instance.extent()).array().abs();
    result.is_of_right_size = (deviation <= allowed * instance.extent().array()).all();
  }

  void place_wrong_classes() {
    const auto pairs = best_pairs(true, [this](std::size_t o, std::size_t t) {
      const double overlap = intersection_over_union(objects_[o].box, instances_[t].box);
      return overlap >= options_.min_box_overlap ? 1.0 - overlap : kForbiddenPair;
    });
    for (const auto& [o, t] : pairs) {
      is_placed_[o] = true;
      result_.instances[t].others.push_back(o);
    }
  }

  /// The found thing of its class that is nearest to an object, within reach.
  [[nodiscard]] std::optional<std::size_t> nearest_found(std::size_t o) const {
    std::optional<std::size_t> nearest;
    double least_m = kForbiddenPair;
    for (std::size_t t = 0; t < instances_.size(); ++t) {
      if (!result_.instances[t].object) continue;
      const double distance = distance_within(o, t, instance_reach_m(instances_[t].box, options_));
      if (distance >= least_m) continue;
      least_m = distance;
      nearest = t;
    }
    return nearest;
  }

  /// The thing that does not count on which an object lies, the nearest of several.
  [[nodiscard]] std::optional<std::size_t> nearest_apart(std::size_t o) const {
    std::optional<std::size_t> nearest;
    double least_m = kForbiddenPair;
    for (std::size_t t = 0; t < instances_.size(); ++t) {
      if (counts(t)) continue;
      const Box& instance = instances_[t].box;
      const double distance = distance_m(objects_[o].box, instance);
      if (distance >= least_m) continue;
      if (!grown(instance, options_.near_m).contains(objects_[o].box.centre())) continue;
      least_m = distance;
      nearest = t;
    }
    return nearest;
  }

  void place_left(std::size_t o) {
    if (const auto t = nearest_found(o)) {
      result_.instances[*t].duplicates.push_back(o);
      return;
    }
    if (const auto t = nearest_apart(o)) {
      result_.instances[*t].others.push_back(o);
      return;
    }
    result_.false_objects.push_back(o);
  }

  void count() {
    InstanceCounts& counts_of = result_.counts;
    for (std::size_t t = 0; t < instances_.size(); ++t) {
      if (!counts(t)) continue;
      const InstanceResult& instance = result_.instances[t];
      ++counts_of.counted;
      counts_of.found += instance.object ? 1U : 0U;
      counts_of.in_place += instance.is_in_place ? 1U : 0U;
      counts_of.right_size += instance.is_of_right_size ? 1U : 0U;
      counts_of.right += instance.is_right() ? 1U : 0U;
      counts_of.wrong_class += instance.others.empty() ? 0U : 1U;
      counts_of.duplicates += instance.duplicates.size();
    }
    counts_of.false_objects = result_.false_objects.size();
  }

  std::span<const ComparedObject> objects_;
  std::span<const ComparedInstance> instances_;
  const Options& options_;
  std::vector<std::string> object_classes_;
  std::vector<std::vector<std::string>> instance_classes_;
  std::vector<bool> is_placed_;
  InstanceComparison result_;
};

}  // namespace

std::string_view name_of(InstanceStanding standing) {
  return kStandings[static_cast<std::size_t>(standing)];
}

double instance_reach_m(const Box& instance, const InstanceComparisonOptions& options) {
  const Eigen::Vector3d sides = instance.extent();
  const bool is_small = sides.maxCoeff() < options.small_size_m;
  const double gate = is_small ? options.small_gate_m : options.gate_m;
  return std::max(gate, 0.5 * sides.head<2>().maxCoeff());
}

const OptionTable& option_table(const InstanceComparisonOptions&) {
  static constexpr OptionTable kTable{kInstanceRows};
  return kTable;
}

Result<void> validate(const InstanceComparisonOptions& options) {
  return check_options(options);
}

InstanceComparison compare_instances(std::span<const ComparedObject> objects,
                                     std::span<const ComparedInstance> instances,
                                     const InstanceComparisonOptions& options) {
  return InstanceMatching(objects, instances, options).run();
}

}  // namespace hypermap
