// SPDX-License-Identifier: BSD-3-Clause
#include "shared_schedule.hpp"

#include <algorithm>
#include <utility>

namespace hypermap {

std::optional<std::size_t> SharedSchedule::wait_for_next() {
  std::unique_lock lock(mutex_);
  for (;;) {
    if (const auto task = schedule_.next()) return task;
    if (schedule_.is_over()) return std::nullopt;
    changed_.wait(lock);
  }
}

std::optional<std::size_t> SharedSchedule::take_next() {
  const std::scoped_lock lock(mutex_);
  return schedule_.next();
}

void SharedSchedule::finish(TaskOutcome outcome) {
  const std::scoped_lock lock(mutex_);
  schedule_.finish(outcome.number, !outcome.error);
  if (done_ && !done_(outcome)) schedule_.stop();
  outcomes_.push_back(std::move(outcome));
  changed_.notify_all();
}

void SharedSchedule::stop() {
  const std::scoped_lock lock(mutex_);
  schedule_.stop();
  changed_.notify_all();
}

bool SharedSchedule::is_over() const {
  const std::scoped_lock lock(mutex_);
  return schedule_.is_over();
}

std::vector<TaskOutcome> SharedSchedule::outcomes() const {
  const std::scoped_lock lock(mutex_);
  std::vector<TaskOutcome> sorted = outcomes_;
  std::ranges::sort(sorted, {}, &TaskOutcome::number);
  return sorted;
}

void work_through(SharedSchedule& schedule, const TaskWork& work, std::size_t worker) {
  while (const auto task = schedule.wait_for_next()) {
    TaskOutcome outcome = work(*task);
    outcome.worker = worker;
    schedule.finish(std::move(outcome));
  }
}

}  // namespace hypermap
