// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which task is next, as others are done.
#pragma once

#include "hypermap/io/jobs/work_crew.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace hypermap {

/// The order in which tasks are handed out. A task waits for those that it needs; where one of
/// these failed it is never handed out.
/// Threads: one at a time.
class TaskSchedule {
 public:
  /// Requires: what a task needs is among the tasks before it.
  explicit TaskSchedule(std::span<const CrewTask> tasks);

  /// The first task, in the given order, that waits for nothing; from now on it is at work. None:
  /// all that could be are at work or done.
  [[nodiscard]] std::optional<std::size_t> next();
  /// Requires: `task` is at work. Cost: that of the tasks which need it.
  void finish(std::size_t task, bool is_done);
  /// Hands out nothing more.
  void stop() { is_stopped_ = true; }
  /// Nothing is at work and nothing can be handed out.
  [[nodiscard]] bool is_over() const;

 private:
  struct Entry {
    std::size_t number = 0;
    std::size_t num_missing = 0;              ///< Tasks that it waits for.
    std::vector<std::size_t> needed_by = {};  ///< Places of those that wait for it.
  };

  std::vector<Entry> entries_;
  std::map<std::size_t, std::size_t> place_of_;  ///< By number.
  std::set<std::size_t> ready_;                  ///< Places.
  std::size_t num_at_work_ = 0;
  bool is_stopped_ = false;
};

}  // namespace hypermap
