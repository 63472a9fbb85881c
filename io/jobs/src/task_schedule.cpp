// SPDX-License-Identifier: BSD-3-Clause
#include "task_schedule.hpp"

namespace hypermap {

TaskSchedule::TaskSchedule(std::span<const CrewTask> tasks) {
  entries_.reserve(tasks.size());
  for (const CrewTask& task : tasks) {
    const std::size_t place = entries_.size();
    entries_.push_back({.number = task.number, .num_missing = task.needs.size()});
    place_of_.emplace(task.number, place);
    for (const std::size_t needed : task.needs) {
      entries_[place_of_.at(needed)].needed_by.push_back(place);
    }
    if (task.needs.empty()) ready_.insert(place);
  }
}

std::optional<std::size_t> TaskSchedule::next() {
  if (is_stopped_ || ready_.empty()) return std::nullopt;
  const std::size_t place = *ready_.begin();
  ready_.erase(ready_.begin());
  ++num_at_work_;
  return entries_[place].number;
}

void TaskSchedule::finish(std::size_t task, bool is_done) {
  --num_at_work_;
  if (!is_done) return;
  for (const std::size_t place : entries_[place_of_.at(task)].needed_by) {
    if (--entries_[place].num_missing == 0) ready_.insert(place);
  }
}

bool TaskSchedule::is_over() const {
  return num_at_work_ == 0 && (is_stopped_ || ready_.empty());
}

}  // namespace hypermap
