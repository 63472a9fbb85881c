// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/combiner/combiner_training.hpp"

#include "hypermap/core/base/option_rows.hpp"
#include "sigmoid_fit.hpp"

#include <opencv2/core.hpp>
#include <opencv2/ml.hpp>

#include <algorithm>
#include <exception>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

namespace hypermap {
namespace {

constexpr OptionRow kTrainingRows[] = {
    option::number<&CombinerTrainingOptions::penalty>(
        "penalty",
        {0.001, 1000},
        {.source = "OpenCV C_SVC", .effect = "Larger follows the examples more closely."}),
    option::count<&CombinerTrainingOptions::min_examples>(
        "min_examples", {1, 1000000}, {.effect = "A class with fewer is not learnt."}),
};

/// Each detector that spoke, with the classes that it gave probabilities of, by the ids.
std::vector<CombinedDetector> detectors_of(std::span<const CombinerExample> examples,
                                           const DetectorRegistry& detectors,
                                           const ClassRegistry& classes) {
  std::map<DetectorId, std::set<ClassId>> spoken;
  for (const CombinerExample& example : examples) {
    for (std::size_t i = 0; i < example.detectors.size(); ++i) {
      std::set<ClassId>& known = spoken[example.detectors[i]];
      for (const ClassEvidence& evidence : example.likelihoods[i]) known.insert(evidence.id);
    }
  }
  std::vector<CombinedDetector> out;
  for (const auto& [id, known] : spoken) {
    CombinedDetector detector{.name = detectors.description(id).name, .classes = {}};
    for (const ClassId one : known) detector.classes.push_back(classes.name(one));
    out.push_back(std::move(detector));
  }
  return out;
}

struct Boundary {
  std::vector<double> weights;
  double offset = 0.0;

  [[nodiscard]] double distance(std::span<const float> features) const {
    double sum = offset;
    for (std::size_t i = 0; i < features.size(); ++i) {
      sum += weights[i] * static_cast<double>(features[i]);
    }
    return sum;
  }
};

/// A linear support vector machine. Which side is which is left to the sigmoid.
Boundary find_boundary(const cv::Mat& features, const cv::Mat& labels, double penalty) {
  constexpr int kMaxIterations = 100000;
  constexpr double kTolerance = 1e-4;
  const cv::Ptr<cv::ml::SVM> svm = cv::ml::SVM::create();
  svm->setType(cv::ml::SVM::C_SVC);
  svm->setKernel(cv::ml::SVM::LINEAR);
  svm->setC(penalty);
  svm->setTermCriteria(cv::TermCriteria(
      cv::TermCriteria::MAX_ITER + cv::TermCriteria::EPS, kMaxIterations, kTolerance));
  svm->train(features, cv::ml::ROW_SAMPLE, labels);
  const cv::Mat vectors = svm->getSupportVectors();
  std::vector<double> alpha;
  std::vector<int> index;
  Boundary boundary;
  boundary.offset = -svm->getDecisionFunction(0, alpha, index);
  boundary.weights.assign(static_cast<std::size_t>(features.cols), 0.0);
  for (std::size_t v = 0; v < index.size(); ++v) {
    for (int i = 0; i < features.cols; ++i) {
      boundary.weights[static_cast<std::size_t>(i)] +=
          alpha[v] * static_cast<double>(vectors.at<float>(index[v], i));
    }
  }
  return boundary;
}

OneAgainstAll train_class(const cv::Mat& features,
                          std::span<const CombinerExample> examples,
                          ClassId id,
                          double penalty) {
  const std::size_t count = examples.size();
  cv::Mat labels(static_cast<int>(count), 1, CV_32S);
  const auto are_positive = std::make_unique<bool[]>(count);
  for (std::size_t i = 0; i < count; ++i) {
    are_positive[i] = examples[i].truth == id;
    labels.at<int>(static_cast<int>(i)) = are_positive[i] ? 1 : -1;
  }
  const Boundary boundary = find_boundary(features, labels, penalty);
  std::vector<double> distances;
  distances.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::span<const float> row(features.ptr<float>(static_cast<int>(i)),
                                     static_cast<std::size_t>(features.cols));
    distances.push_back(boundary.distance(row));
  }
  const Sigmoid sigmoid = fit_sigmoid(distances, {are_positive.get(), count});
  OneAgainstAll rule;
  rule.offset = sigmoid.slope * boundary.offset + sigmoid.offset;
  for (const double weight : boundary.weights) rule.weights.push_back(sigmoid.slope * weight);
  return rule;
}

cv::Mat feature_rows(std::span<const CombinerExample> examples, const CombinerFeatures& features) {
  cv::Mat rows;
  for (const CombinerExample& example : examples) {
    const std::vector<double> row = features.of(example.likelihoods, example.detectors);
    cv::Mat one(1, static_cast<int>(row.size()), CV_32F);
    for (std::size_t i = 0; i < row.size(); ++i) {
      one.at<float>(static_cast<int>(i)) = static_cast<float>(row[i]);
    }
    rows.push_back(one);
  }
  return rows;
}

/// How many examples there are of each class.
std::map<ClassId, std::size_t> counts_of(std::span<const CombinerExample> examples) {
  std::map<ClassId, std::size_t> counts;
  for (const CombinerExample& example : examples) ++counts[example.truth];
  return counts;
}

}  // namespace

const OptionTable& option_table(const CombinerTrainingOptions&) {
  static constexpr OptionTable kTable{kTrainingRows};
  return kTable;
}

Result<void> validate(const CombinerTrainingOptions& options) {
  return check_options(options);
}

Result<CombinerModel> train_combiner(std::span<const CombinerExample> examples,
                                     const DetectorRegistry& detectors,
                                     const ClassRegistry& classes,
                                     const CombinerTrainingOptions& options) {
  HYPERMAP_TRY(validate(options));
  const std::map<ClassId, std::size_t> counts = counts_of(examples);
  if (counts.size() < 2) {
    return fail(ErrorCode::kInvalidArgument,
                "must be of two or more classes, are of " + std::to_string(counts.size()),
                "examples");
  }
  CombinerModel model{.detectors = detectors_of(examples, detectors, classes), .classes = {}};
  ClassRegistry known = classes;
  HYPERMAP_ASSIGN_OR_RETURN(const CombinerFeatures features,
                            CombinerFeatures::bind(model.detectors, detectors, known));
  try {
    const cv::Mat rows = feature_rows(examples, features);
    for (const auto& [id, count] : counts) {
      if (count < options.min_examples) continue;
      OneAgainstAll rule = train_class(rows, examples, id, options.penalty);
      rule.class_name = classes.name(id);
      rule.share = static_cast<double>(count) / static_cast<double>(examples.size());
      model.classes.push_back(std::move(rule));
    }
  } catch (const std::exception& e) {
    return fail(ErrorCode::kUnavailable, "OpenCV cannot learn it: " + printable(e.what()));
  }
  if (model.classes.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                "no class has " + std::to_string(options.min_examples) + " of them",
                "examples");
  }
  HYPERMAP_TRY(validate(model));
  return model;
}

}  // namespace hypermap
