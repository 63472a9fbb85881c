// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The options by which commands that map say how: all but which dataset becomes which file.
#pragma once

#include "class_names.hpp"
#include "combination_arguments.hpp"
#include "dataset_arguments.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"
#include "hypermap/io/options/options_file.hpp"
#include "load_arguments.hpp"
#include "look_arguments.hpp"
#include "network_arguments.hpp"

#include <CLI/App.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hypermap::app {

struct MappingArguments {
  DatasetArguments dataset;
  NetworkArguments network;
  LookArguments looks;
  CombinationArguments combination;
  ClassNames class_names;
  LoadArguments load;
  std::optional<std::filesystem::path> model;
  std::vector<std::string> transient;
  std::vector<std::string> kept_classes;
  std::string preset = "default";
  std::optional<std::string> config;
  std::optional<std::string> mode;
  std::optional<std::string> resolution_m;
  std::optional<std::string> max_range_m;
  std::optional<std::string> up_axis;
  std::string places;
  bool refine_poses = false;
  bool keeps_views = false;
  bool class_stack = false;
  double max_skipped_share = MappingJob{}.max_skipped_share;
  bool strict = false;
  int num_threads = 0;

  /// All of them but those of `dataset` and `load`.
  void add_to(CLI::App& command);
  /// Throws CLI::ValidationError for what does not go together.
  void keep_to_rules() const;
  /// Files that are read, but those of datasets.
  [[nodiscard]] std::vector<std::filesystem::path> files_read() const;
  /// The threads that were asked for, else one for each core.
  [[nodiscard]] int threads() const;
  /// What the options say: preset, then the options file, then the command line. Input and output
  /// are left empty. Errors: those of reading the files that are named, and of `validate`.
  [[nodiscard]] Result<MappingJob> job() const;

 private:
  void add_model_to(CLI::App& command);
  void add_map_options_to(CLI::App& command);
  void add_class_options_to(CLI::App& command);
  void add_run_options_to(CLI::App& command);
  [[nodiscard]] Result<MapOptions> map_options() const;
};

}  // namespace hypermap::app
