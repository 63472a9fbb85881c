// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the command line of `hypermap eval` says, and which jobs that is.
#pragma once

#include "class_names.hpp"
#include "cloud_eval.hpp"
#include "hypermap/io/codec/file_kind.hpp"
#include "hypermap/io/jobs/cloud_evaluation_job.hpp"
#include "hypermap/io/jobs/evaluation_job.hpp"
#include "hypermap/io/jobs/listed_evaluation_job.hpp"
#include "hypermap/io/jobs/rates_job.hpp"
#include "load_arguments.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hypermap::app {

struct EvalArguments {
  std::vector<std::string> maps;
  std::vector<std::string> truths;
  std::optional<std::string> against;
  std::vector<std::pair<std::string, std::string>> also;
  std::string layer = "semantic";
  std::vector<std::string> classes;
  std::optional<std::string> reliability;
  std::optional<std::string> image;
  std::optional<std::string> input;
  std::optional<std::string> description;
  std::vector<std::string> detections;
  bool json = false;
  bool rates = false;
  std::optional<std::string> csv;
  CloudArguments cloud;
  ClassNames class_names;
  LoadArguments load;

  /// Tables of one map have rates, but for a cloud, which has no things.
  [[nodiscard]] bool asks_for_rates(FileKind truth) const {
    return rates || maps.size() > 1 || truths.size() > 1 || (csv && truth != FileKind::kCloud);
  }
};

/// Everything that is read.
[[nodiscard]] std::vector<std::filesystem::path> inputs_of(const EvalArguments& arguments);

/// Errors of all: those of the file of class names.
[[nodiscard]] Result<EvaluationJob> job_of(const EvalArguments& arguments);
[[nodiscard]] Result<CloudEvaluationJob> cloud_job_of(const EvalArguments& arguments);
[[nodiscard]] Result<ListedEvaluationJob> listed_job_of(const EvalArguments& arguments);
[[nodiscard]] Result<RatesJob> rates_job_of(const EvalArguments& arguments);

/// What only one map allows. Errors: kInvalidArgument naming the option.
[[nodiscard]] Result<void> check_options_of_runs(const EvalArguments& arguments);
/// What only another kind of truth allows. Errors: kInvalidArgument naming the option.
[[nodiscard]] Result<void> check_options_of(const EvalArguments& arguments, FileKind truth);

}  // namespace hypermap::app
