// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The maps of a job of many sequences: of what each is made, where it lies, and its making.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/jobs/map_many_job.hpp"
#include "merge_plan.hpp"
#include "merge_tree.hpp"
#include "part_record.hpp"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

/// How the parts are merged. Points into itself: stays where it is.
struct ManyPlan {
  MergeJob job = {};                       ///< Its files are the parts, in the order of the list.
  std::vector<PlannedMap> maps = {};       ///< In the order of merging.
  std::vector<std::string> contents = {};  ///< Hashes of their bytes, in that order.
  std::vector<MergeNode> nodes = {};
};

/// Makes the maps of a job, each by the number of its task: 0 .. n - 1 are the sequences, from n on
/// come the nodes of the tree that merges them.
/// Threads: each task at any time, as long as what it needs is done.
class ManyParts {
 public:
  /// Requires: `job` has a sequence and outlives this.
  explicit ManyParts(const MapManyJob& job) : job_(job) {}

  /// Makes what the task stands for, unless it stands already, and says so. Throws nothing.
  [[nodiscard]] TaskOutcome do_task(std::size_t number);

  /// The part of a sequence and its record.
  [[nodiscard]] PartFiles part_files(std::size_t sequence) const;
  /// The map that a node makes.
  [[nodiscard]] PartFiles node_files(const MergeNode& node) const;
  /// What is on the way from parts to the whole.
  [[nodiscard]] std::filesystem::path merging_folder() const { return job_.parts / "merging"; }

  /// Hash of all that parts and merges have in common.
  [[nodiscard]] std::string settings_text() const;
  /// How the parts are merged. Requires: all are made, two or more.
  /// Errors: those of plan_merge and read_part_record.
  [[nodiscard]] Result<const ManyPlan*> plan();
  /// Whether the map of this node must be made; else it is as it was made of the same.
  [[nodiscard]] bool must_make(const ManyPlan& plan, const MergeNode& node) const;
  /// Whether the job's output is the map of the last node, made of the same.
  [[nodiscard]] bool is_in_place(const ManyPlan& plan) const;

 private:
  [[nodiscard]] MappingJob mapping_job_of(std::size_t sequence) const;
  [[nodiscard]] MapOptions map_options() const;
  [[nodiscard]] Result<PartRecipe> recipe_of_part(std::size_t sequence) const;
  [[nodiscard]] PartRecipe recipe_of_node(const ManyPlan& plan, const MergeNode& node) const;
  [[nodiscard]] Result<std::string> make_part(std::size_t sequence) const;
  [[nodiscard]] Result<std::string> make_node(std::size_t index);
  [[nodiscard]] Result<std::unique_ptr<ManyPlan>> new_plan() const;
  void remove_node_files(const ManyPlan& plan, const std::optional<std::size_t>& node) const;

  const MapManyJob& job_;
  std::mutex mutex_;  ///< Of the plan.
  std::unique_ptr<ManyPlan> plan_;
};

}  // namespace hypermap
