// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Learns from labelled frames how to combine what several detectors say.
///
/// Source: [smap] 3.5.3: a meta-classifier, trained one against all by a small set.
#pragma once

#include "hypermap/core/base/job_progress.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/combiner/combiner_training.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace hypermap {

struct CombinerJob {
  std::filesystem::path input = {};
  /// `dataset.detections`: the detectors' files.
  DatasetOptions dataset = {};
  /// A file of detections that are true: of each box the class is what is there.
  std::filesystem::path labels = {};
  std::filesystem::path output = {};
  CombinerTrainingOptions training = {};
  /// Boxes that overlap so much are of one thing: intersection over union, 0.1 .. 1.
  double min_overlap = 0.5;
};

/// How often some rule named the class that is there.
struct NamingScore {
  std::string name;           ///< A detector, "sum", "product" or "trained".
  std::size_t num_right = 0;  ///< The most probable class was the true one.
  std::size_t num_named = 0;  ///< Things that it said something of.
};

struct CombinerJobReport {
  std::size_t num_frames = 0;
  std::size_t num_examples = 0;      ///< That it was learnt from.
  std::size_t num_held_out = 0;      ///< Of every fifth frame: what `scores` are counted on.
  std::size_t num_unlabelled = 0;    ///< Things that no label says what they are: false alarms.
  std::vector<std::string> classes;  ///< That were learnt.
  std::vector<NamingScore> scores;   ///< Each detector alone, then the rules.
  std::vector<Error> skipped;        ///< Frames that could not be read.
  std::vector<Finding> findings;     ///< Of the dataset and the files.
};

/// Writes the combiner to `output`. Labels of classes that no detector knows teach nothing.
///
/// Errors: those of open_dataset, train_combiner and of writing; kInvalidArgument naming the field;
/// kNotFound without detections. Nothing is written on an error.
[[nodiscard]] Result<CombinerJobReport> train_combiner_job(const CombinerJob& job,
                                                           const JobProgress& progress = {});

}  // namespace hypermap
