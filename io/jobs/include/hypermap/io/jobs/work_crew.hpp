// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Who does the tasks of a large job: threads of this program, or programs on other machines.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hypermap {

/// A task by its number, and those that must be done before it.
struct CrewTask {
  std::size_t number = 0;
  std::vector<std::size_t> needs = {};
};

/// What became of a task.
struct TaskOutcome {
  std::size_t number = 0;
  std::optional<Error> error = std::nullopt;  ///< None: it is done.
  std::string note = {};                      ///< What whoever did it says of it.
  std::size_t worker = 0;                     ///< Who did it, counted from 0.
  double wall_s = 0.0;                        ///< How long it took.
  /// The most memory that its process has held until then.
  std::uint64_t peak_rss_bytes = 0;
};

/// Does a task by its number: the same whoever calls it. Threads: any number at once. Throws
/// nothing.
using TaskWork = std::function<TaskOutcome(std::size_t number)>;
/// Told of each task, one call at a time, from any thread. False: nothing more is begun.
using TaskDone = std::function<bool(const TaskOutcome& outcome)>;

/// Plugged by whoever has more machines. What tasks make lies in files that all workers see; the
/// crew only carries numbers to them and outcomes back.
class WorkCrew {
 public:
  WorkCrew() = default;
  WorkCrew(const WorkCrew&) = delete;
  WorkCrew& operator=(const WorkCrew&) = delete;
  WorkCrew(WorkCrew&&) = delete;
  WorkCrew& operator=(WorkCrew&&) = delete;
  virtual ~WorkCrew() = default;

  [[nodiscard]] virtual std::size_t num_workers() const = 0;
  /// Outcomes of the tasks that were begun, by their numbers. A task of which another one failed
  /// that it needs is not begun; others go on.
  /// Requires: what a task needs is among the tasks before it.
  /// Errors: what keeps the crew itself from working.
  [[nodiscard]] virtual Result<std::vector<TaskOutcome>> run(std::span<const CrewTask> tasks,
                                                             const TaskWork& work,
                                                             const TaskDone& done) = 0;
};

/// Threads of this program, one a worker.
class ThreadCrew final : public WorkCrew {
 public:
  /// Requires: num_workers > 0.
  explicit ThreadCrew(std::size_t num_workers) : num_workers_(num_workers) {}

  [[nodiscard]] std::size_t num_workers() const override { return num_workers_; }
  /// No more threads than tasks. Errors: kUnavailable when no thread can be started.
  [[nodiscard]] Result<std::vector<TaskOutcome>> run(std::span<const CrewTask> tasks,
                                                     const TaskWork& work,
                                                     const TaskDone& done) override;

 private:
  std::size_t num_workers_;
};

}  // namespace hypermap
