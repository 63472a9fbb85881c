// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/rank_crew.hpp"

#include "rank_messages.hpp"
#include "shared_schedule.hpp"

#include <chrono>
#include <system_error>
#include <thread>
#include <utility>

namespace hypermap {
namespace {

/// Waiting for a message keeps no core busy. Tasks take seconds.
constexpr std::chrono::milliseconds kPollPause{2};

void pause_polling() {
  std::this_thread::sleep_for(kPollPause);
}

Error of_rank(Error error, std::size_t rank) {
  error.what = "rank " + std::to_string(rank) + ": " + error.what;
  return error;
}

}  // namespace

/// One run of the crew: what comes in from the ranks, and what goes out to them.
class RankCrew::Shift {
 public:
  Shift(RankCrew& crew, SharedSchedule& schedule) : crew_(crew), schedule_(schedule) {}

  /// Errors: those of `run`.
  Result<void> carry() {
    bool is_quiet = false;
    do {
      if (is_quiet) pause_polling();
      is_quiet = true;
      while (auto message = crew_.port_.poll()) {
        is_quiet = false;
        HYPERMAP_TRY(take(*message));
      }
      hand_out();
    } while (!schedule_.is_over());
    return {};
  }

  /// Nothing more is begun, and what the ranks are at does not count.
  void give_up(const Error& error) {
    schedule_.stop();
    for (const auto& [rank, task] : crew_.at_work_) {
      schedule_.finish({.number = task, .error = error, .worker = rank});
    }
  }

 private:
  Result<void> take(const RankMessage& message) {
    auto says = parse_rank_says(message.bytes);
    if (!says) return Unexpected(of_rank(says.error(), message.from));
    crew_.idle_.insert(message.from);
    if (const auto* cannot = std::get_if<RankCannotBegin>(&*says)) {
      return Unexpected(of_rank(cannot->error, message.from));
    }
    if (const auto* ready = std::get_if<RankIsReady>(&*says))
      return check_job(*ready, message.from);
    return take(std::get<RankIsDone>(std::move(*says)).outcome, message.from);
  }

  [[nodiscard]] Result<void> check_job(const RankIsReady& ready, std::size_t rank) const {
    if (ready.job == crew_.job_) return {};
    return Unexpected(of_rank({.code = ErrorCode::kInvalidArgument,
                               .what = "has another list, other options or another program"},
                              rank));
  }

  Result<void> take(TaskOutcome outcome, std::size_t rank) {
    const auto task = crew_.at_work_.find(rank);
    if (task == crew_.at_work_.end() || task->second != outcome.number) {
      return Unexpected(of_rank({.code = ErrorCode::kMalformedFile,
                                 .what = "has done task " + std::to_string(outcome.number) +
                                         ", which it was not asked for"},
                                rank));
    }
    crew_.at_work_.erase(task);
    outcome.worker = rank;
    schedule_.finish(std::move(outcome));
    return {};
  }

  void hand_out() {
    while (!crew_.idle_.empty()) {
      const auto task = schedule_.take_next();
      if (!task) return;
      const std::size_t rank = *crew_.idle_.begin();
      crew_.idle_.erase(crew_.idle_.begin());
      crew_.at_work_.emplace(rank, *task);
      crew_.port_.send(rank, write_rank_task(*task));
    }
  }

  RankCrew& crew_;
  SharedSchedule& schedule_;
};

RankCrew::RankCrew(MessagePort& port, std::string job) : port_(port), job_(std::move(job)) {}

RankCrew::~RankCrew() {
  std::size_t num_left = port_.num_ranks() - 1;
  while (num_left > 0) {
    for (const std::size_t rank : idle_) port_.send(rank, write_rank_task(std::nullopt));
    num_left -= idle_.size();
    idle_.clear();
    if (num_left == 0) return;
    if (const auto message = port_.poll()) {
      idle_.insert(message->from);
    } else {
      pause_polling();
    }
  }
}

std::size_t RankCrew::num_workers() const {
  return port_.num_ranks();
}

Result<std::vector<TaskOutcome>> RankCrew::run(std::span<const CrewTask> tasks,
                                               const TaskWork& work,
                                               const TaskDone& done) {
  SharedSchedule schedule(tasks, done);
  std::thread own;
  try {
    own = std::thread([&] { work_through(schedule, work, port_.rank()); });
  } catch (const std::system_error& error) {
    return fail(ErrorCode::kUnavailable,
                std::string("a thread could not be started: ") + error.what());
  }
  Shift shift(*this, schedule);
  const auto carried = shift.carry();
  if (!carried) shift.give_up(carried.error());
  own.join();
  if (!carried) return Unexpected(carried.error());
  return schedule.outcomes();
}

void serve_rank(MessagePort& port, const Result<std::string>& job, const TaskWork& work) {
  port.send(
      0, job ? write_rank_says(RankIsReady{*job}) : write_rank_says(RankCannotBegin{job.error()}));
  for (;;) {
    const auto message = port.poll();
    if (!message) {
      pause_polling();
      continue;
    }
    const auto task = parse_rank_task(message->bytes);
    if (!task || !*task) return;
    port.send(0, write_rank_says(RankIsDone{work(**task)}));
  }
}

}  // namespace hypermap
