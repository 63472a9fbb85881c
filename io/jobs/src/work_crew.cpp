// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/work_crew.hpp"

#include "shared_schedule.hpp"

#include <algorithm>
#include <string>
#include <system_error>
#include <thread>

namespace hypermap {

Result<std::vector<TaskOutcome>> ThreadCrew::run(std::span<const CrewTask> tasks,
                                                 const TaskWork& work,
                                                 const TaskDone& done) {
  SharedSchedule schedule(tasks, done);
  std::vector<std::thread> threads;
  const std::size_t num_threads = std::min(num_workers_, tasks.size());
  std::string refused;
  for (std::size_t worker = 0; worker < num_threads && refused.empty(); ++worker) {
    try {
      threads.emplace_back([&, worker] { work_through(schedule, work, worker); });
    } catch (const std::system_error& error) {
      refused = error.what();
    }
  }
  if (!refused.empty()) schedule.stop();
  for (std::thread& thread : threads) thread.join();
  if (!refused.empty()) {
    return fail(ErrorCode::kUnavailable, "a thread could not be started: " + refused);
  }
  return schedule.outcomes();
}

}  // namespace hypermap
