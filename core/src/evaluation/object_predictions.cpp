// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/object_predictions.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/evaluation/match_gate.hpp"
#include "hypermap/core/objects/assignment.hpp"

#include <optional>
#include <string>

namespace hypermap {
namespace {

constexpr double kLeastBoxOverlap = 0.1;

/// Finds out which true object each object of the map is.
class ObjectIdentification {
 public:
  ObjectIdentification(std::span<const BelievedObject> objects,
                       std::span<const EvaluatedObject> truth,
                       const EvaluationOptions& options)
      : objects_(objects),
        truth_(truth),
        options_(options),
        truth_of_(objects.size()),
        is_taken_(truth.size(), false) {
    for (const BelievedObject& object : objects)
      object_classes_.push_back(canonical_class_name(object.shape.class_name));
    for (const EvaluatedObject& object : truth)
      truth_classes_.push_back(canonical_class_name(object.class_name));
  }

  ObjectPredictions run() {
    for (const bool same_class : {true, false}) {
      for (const bool confirmed : {true, false}) assign_round(confirmed, same_class);
    }
    ObjectPredictions predictions;
    predictions.truth_of = truth_of_;
    for (std::size_t m = 0; m < objects_.size(); ++m) {
      const BelievedObject& object = objects_[m];
      const auto t = truth_of_[m];
      predictions.real.push_back({object.real_probability, t.has_value()});
      if (!t || !object.is_confirmed || !tells_class(truth_[*t])) continue;
      predictions.best_class.push_back(
          {object.best_class_probability, object_classes_[m] == truth_classes_[*t]});
    }
    return predictions;
  }

 private:
  static bool tells_class(const EvaluatedObject& truth) {
    return truth.is_nameable && (!truth.excluded || truth.frames_named.has_value());
  }

  [[nodiscard]] bool may_be(std::size_t m, std::size_t t, bool same_class) const {
    if (same_class) return object_classes_[m] == truth_classes_[t];
    const auto& a = objects_[m].shape.box;
    const auto& b = truth_[t].box;
    return a && b && intersection_over_union(*a, *b) >= kLeastBoxOverlap;
  }

  void assign_round(bool confirmed, bool same_class) {
    std::vector<std::size_t> rows;
    std::vector<std::size_t> cols;
    for (std::size_t m = 0; m < objects_.size(); ++m) {
      if (objects_[m].is_confirmed == confirmed && !truth_of_[m]) rows.push_back(m);
    }
    for (std::size_t t = 0; t < truth_.size(); ++t) {
      if (!is_taken_[t]) cols.push_back(t);
    }
    Eigen::MatrixXd costs = Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(rows.size()),
                                                      static_cast<Eigen::Index>(cols.size()),
                                                      kForbiddenPair);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t k = 0; k < cols.size(); ++k) {
        const double distance_m =
            (objects_[rows[i]].shape.centroid - truth_[cols[k]].centroid).norm();
        const bool is_near = distance_m <= match_gate_m(truth_[cols[k]], options_);
        if (is_near && may_be(rows[i], cols[k], same_class))
          costs(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = distance_m;
      }
    }
    const auto columns = assign(costs);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (!columns[i]) continue;
      truth_of_[rows[i]] = cols[*columns[i]];
      is_taken_[cols[*columns[i]]] = true;
    }
  }

  std::span<const BelievedObject> objects_;
  std::span<const EvaluatedObject> truth_;
  const EvaluationOptions& options_;
  std::vector<std::string> object_classes_;  ///< Canonical.
  std::vector<std::string> truth_classes_;
  std::vector<std::optional<std::size_t>> truth_of_;
  std::vector<bool> is_taken_;
};

}  // namespace

ObjectPredictions object_predictions(std::span<const BelievedObject> objects,
                                     std::span<const EvaluatedObject> truth,
                                     const EvaluationOptions& options) {
  return ObjectIdentification(objects, truth, options).run();
}

}  // namespace hypermap
