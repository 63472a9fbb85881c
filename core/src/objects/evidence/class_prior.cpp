// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/class_prior.hpp"

#include "hypermap/core/base/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace hypermap {

Result<ClassPrior> ClassPrior::create(std::vector<ClassLogOdds> log_factors) {
  for (std::size_t i = 0; i < log_factors.size(); ++i) {
    const auto& [id, log_factor] = log_factors[i];
    if (i > 0 && id <= log_factors[i - 1].id) {
      return fail(ErrorCode::kInvalidArgument, "must name classes in ascending order", "prior");
    }
    if (std::abs(log_factor.value()) <= kMaxLogFactor) continue;
    return fail(ErrorCode::kInvalidArgument,
                "must be within +- " + number_text(kMaxLogFactor) + " for class " +
                    std::to_string(id.value) + ", is " + number_text(log_factor.value()),
                "prior");
  }
  ClassPrior prior;
  prior.log_factors_ = std::move(log_factors);
  return prior;
}

double ClassPrior::factor(ClassId id) const {
  const auto found = std::ranges::lower_bound(log_factors_, id, {}, &ClassLogOdds::id);
  if (found == log_factors_.end() || found->id != id) return 1.0;
  return std::exp(found->log_odds.value());
}

std::vector<ClassEvidence> with_prior(std::vector<ClassEvidence> classes, const ClassPrior& prior) {
  if (prior.empty()) return classes;
  double before = 0.0;
  double after = 0.0;
  std::vector<double> weights;
  weights.reserve(classes.size());
  for (const ClassEvidence& one : classes) {
    weights.push_back(one.probability.value() * prior.factor(one.id));
    before += one.probability.value();
    after += weights.back();
  }
  if (!(after > 0.0)) return classes;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    classes[i].probability = Probability(std::min(1.0, weights[i] * before / after));
  }
  return classes;
}

}  // namespace hypermap
