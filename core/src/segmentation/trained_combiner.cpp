// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/trained_combiner.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/segmentation/detector_registry.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kMaxCombinedDetectors = 64;
constexpr std::size_t kMaxFeatures = 4096;
constexpr double kMaxWeight = 1e6;
constexpr double kLeastShare = 1e-6;
constexpr double kLeastProbability = 1e-3;
constexpr double kDecades = 3.0;

/// In 0 .. 1: a factor of ten counts a third, and what is below a thousandth is as good as 0.
double feature_of(Probability p) {
  return 1.0 + std::log10(std::max(p.value(), kLeastProbability)) / kDecades;
}

Unexpected model_error(std::string what, std::string field) {
  return fail(ErrorCode::kInvalidArgument, std::move(what), std::move(field));
}

std::string indexed(const char* field, std::size_t i) {
  return std::string(field) + "[" + std::to_string(i) + "]";
}

Result<void> check_detectors(const CombinerModel& model) {
  if (model.detectors.empty()) return model_error("must name one or more", "detectors");
  if (model.detectors.size() > kMaxCombinedDetectors) {
    return fail(ErrorCode::kLimit,
                "at most 64 detectors are combined, has " + std::to_string(model.detectors.size()),
                "detectors");
  }
  DetectorRegistry registry;
  for (std::size_t i = 0; i < model.detectors.size(); ++i) {
    const auto& [name, classes] = model.detectors[i];
    const auto id = registry.add({.name = name, .classes = classes});
    if (!id) {
      return fail(
          id.error().code, id.error().field + " " + id.error().what, indexed("detectors", i));
    }
    if (id->value == i) continue;
    return model_error("\"" + printable(name) + "\" is there twice", indexed("detectors", i));
  }
  if (model.num_features() <= kMaxFeatures) return {};
  return fail(ErrorCode::kLimit,
              "at most 4096 features are weighed, has " + std::to_string(model.num_features()),
              "detectors");
}

Result<void> check_number(double number, const std::string& field) {
  if (std::abs(number) <= kMaxWeight) return {};
  return model_error("must be in -1e6 .. 1e6, is " + number_text(number), field);
}

Result<void> check_rule(const OneAgainstAll& rule, std::size_t num_features, std::size_t i) {
  const std::string field = indexed("classes", i);
  HYPERMAP_TRY(check_number(rule.offset, field + ".offset"));
  if (rule.weights.size() != num_features) {
    return model_error("must have " + std::to_string(num_features) + " numbers, has " +
                           std::to_string(rule.weights.size()),
                       field + ".weights");
  }
  for (std::size_t w = 0; w < rule.weights.size(); ++w) {
    HYPERMAP_TRY(check_number(rule.weights[w], field + "." + indexed("weights", w)));
  }
  if (rule.share >= kLeastShare && rule.share <= 1.0) return {};
  return model_error("must be in 1e-6 .. 1, is " + number_text(rule.share), field + ".share");
}

/// The mean of what is said of each class, by those who know it.
std::map<ClassId, double> mean_words(std::span<const std::vector<ClassEvidence>> likelihoods) {
  std::map<ClassId, std::pair<double, std::size_t>> sums;
  for (const std::vector<ClassEvidence>& likelihood : likelihoods) {
    for (const ClassEvidence& evidence : likelihood) {
      auto& [sum, count] = sums[evidence.id];
      sum += evidence.probability.value();
      ++count;
    }
  }
  std::map<ClassId, double> means;
  for (const auto& [id, sum] : sums) {
    means.emplace(id, sum.first / static_cast<double>(sum.second));
  }
  return means;
}

}  // namespace

std::size_t CombinerModel::num_features() const {
  std::size_t count = 0;
  for (const CombinedDetector& detector : detectors) count += 1 + detector.classes.size();
  return count;
}

Result<void> validate(const CombinerModel& model) {
  HYPERMAP_TRY(check_detectors(model));
  if (model.classes.empty()) return model_error("must name one or more", "classes");
  std::vector<std::string> names;
  const std::size_t num_features = model.num_features();
  for (std::size_t i = 0; i < model.classes.size(); ++i) {
    names.push_back(model.classes[i].class_name);
    HYPERMAP_TRY(check_rule(model.classes[i], num_features, i));
  }
  const auto classes = ClassRegistry::from_names(names);
  if (classes) return {};
  return fail(classes.error().code, classes.error().what, "classes: " + classes.error().field);
}

Result<CombinerFeatures> CombinerFeatures::bind(std::span<const CombinedDetector> detectors,
                                                const DetectorRegistry& registry,
                                                ClassRegistry& classes) {
  CombinerFeatures features;
  for (const CombinedDetector& detector : detectors) {
    Block block{.first = features.num_features_, .feature_of = {}};
    for (const std::string& name : detector.classes) {
      HYPERMAP_ASSIGN_OR_RETURN(const ClassId id, classes.add(name));
      block.feature_of.emplace(id, block.first + 1 + block.feature_of.size());
    }
    features.num_features_ += 1 + detector.classes.size();
    if (const auto id = registry.find(detector.name)) {
      features.blocks_.emplace(*id, std::move(block));
    }
  }
  return features;
}

std::vector<double> CombinerFeatures::of(std::span<const std::vector<ClassEvidence>> likelihoods,
                                         std::span<const DetectorId> detectors) const {
  assert(likelihoods.size() == detectors.size());
  std::vector<double> features(num_features_, 0.0);
  for (std::size_t i = 0; i < likelihoods.size(); ++i) {
    const auto found = blocks_.find(detectors[i]);
    if (found == blocks_.end()) continue;
    const Block& block = found->second;
    features[block.first] = 1.0;
    for (const ClassEvidence& evidence : likelihoods[i]) {
      const auto position = block.feature_of.find(evidence.id);
      if (position == block.feature_of.end()) continue;
      features[position->second] = feature_of(evidence.probability);
    }
  }
  return features;
}

Result<std::shared_ptr<const TrainedCombiner>> TrainedCombiner::bind(
    const CombinerModel& model, const DetectorRegistry& registry, ClassRegistry& classes) {
  HYPERMAP_TRY(validate(model));
  HYPERMAP_ASSIGN_OR_RETURN(CombinerFeatures features,
                            CombinerFeatures::bind(model.detectors, registry, classes));
  std::string names;
  bool is_known = false;
  for (const CombinedDetector& detector : model.detectors) {
    is_known = is_known || registry.find(detector.name).has_value();
    names += (names.empty() ? "" : ", ") + printable(detector.name);
  }
  if (!is_known) {
    return fail(
        ErrorCode::kNotFound, "knows none of the detectors; it was learnt of " + names, "combiner");
  }
  double mean_share = 0.0;
  for (const OneAgainstAll& rule : model.classes) mean_share += rule.share;
  mean_share /= static_cast<double>(model.classes.size());
  std::vector<Rule> rules;
  rules.reserve(model.classes.size());
  for (const OneAgainstAll& rule : model.classes) {
    HYPERMAP_ASSIGN_OR_RETURN(const ClassId id, classes.add(rule.class_name));
    rules.push_back({.id = id,
                     .offset = rule.offset,
                     .weights = rule.weights,
                     .scale = mean_share / rule.share});
  }
  return std::shared_ptr<const TrainedCombiner>(
      new TrainedCombiner(std::move(features), std::move(rules)));
}

Result<std::vector<ClassEvidence>> TrainedCombiner::combine(
    std::span<const std::vector<ClassEvidence>> likelihoods,
    std::span<const DetectorId> detectors) const {
  std::map<ClassId, double> cells = mean_words(likelihoods);
  if (std::ranges::any_of(detectors, [this](DetectorId id) { return knows(id); })) {
    const std::vector<double> features = features_.of(likelihoods, detectors);
    for (const Rule& rule : rules_) {
      double log_odds = rule.offset;
      for (std::size_t i = 0; i < features.size(); ++i) log_odds += rule.weights[i] * features[i];
      cells[rule.id] = rule.scale / (1.0 + std::exp(-log_odds));
    }
  }
  double total = 0.0;
  for (const auto& [id, value] : cells) total += value;
  if (!(total > 0.0)) {
    return fail(ErrorCode::kInvalidArgument, "must have a sum > 0", "class_scores");
  }
  std::vector<ClassEvidence> combined;
  combined.reserve(cells.size());
  for (const auto& [id, value] : cells) {
    combined.push_back({id, Probability(std::min(1.0, value / total))});
  }
  return combined;
}

}  // namespace hypermap
