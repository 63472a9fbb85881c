// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A schedule that threads take tasks from, and what became of them.
#pragma once

#include "hypermap/io/jobs/work_crew.hpp"
#include "task_schedule.hpp"

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// Threads: any number at once.
class SharedSchedule {
 public:
  SharedSchedule(std::span<const CrewTask> tasks, const TaskDone& done)
      : schedule_(tasks), done_(done) {}

  /// The next task; waits while one may become ready. None: it is over.
  [[nodiscard]] std::optional<std::size_t> wait_for_next();
  /// The next task, if one is ready now.
  [[nodiscard]] std::optional<std::size_t> take_next();
  void finish(TaskOutcome outcome);
  /// Hands out nothing more.
  void stop();
  [[nodiscard]] bool is_over() const;
  /// By the numbers of the tasks.
  [[nodiscard]] std::vector<TaskOutcome> outcomes() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  TaskSchedule schedule_;
  const TaskDone& done_;
  std::vector<TaskOutcome> outcomes_;
};

/// Takes tasks until the schedule is over, as worker `worker`.
void work_through(SharedSchedule& schedule, const TaskWork& work, std::size_t worker);

}  // namespace hypermap
