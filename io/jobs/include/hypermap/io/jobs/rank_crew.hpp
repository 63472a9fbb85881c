// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Programs on several machines as one crew: rank 0 hands out tasks, every rank does them.
///
/// Scope: knows no MPI; what carries the messages is plugged in. All ranks see the same files under
/// the same names.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/jobs/work_crew.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

struct RankMessage {
  std::size_t from = 0;
  std::string bytes;
};

/// Carries messages of a few hundred bytes between ranks 0 .. num_ranks - 1, those from one to
/// another in their order. Threads: one at a time.
class MessagePort {
 public:
  MessagePort() = default;
  MessagePort(const MessagePort&) = delete;
  MessagePort& operator=(const MessagePort&) = delete;
  MessagePort(MessagePort&&) = delete;
  MessagePort& operator=(MessagePort&&) = delete;
  virtual ~MessagePort() = default;

  [[nodiscard]] virtual std::size_t rank() const = 0;
  [[nodiscard]] virtual std::size_t num_ranks() const = 0;
  virtual void send(std::size_t to, std::string_view bytes) = 0;
  /// The next message, if one has come; does not wait.
  [[nodiscard]] virtual std::optional<RankMessage> poll() = 0;
};

/// The crew as rank 0 leads it; it does tasks itself, too. When this goes, the others are let go.
class RankCrew final : public WorkCrew {
 public:
  /// `job` is what all ranks must be at, in a text that is equal for equal jobs.
  /// Requires: `port` is that of rank 0, used by the thread that made this, and outlives it.
  RankCrew(MessagePort& port, std::string job);
  RankCrew(const RankCrew&) = delete;
  RankCrew& operator=(const RankCrew&) = delete;
  RankCrew(RankCrew&&) = delete;
  RankCrew& operator=(RankCrew&&) = delete;
  /// Waits until each rank has done what it is at, and lets it go.
  ~RankCrew() override;

  [[nodiscard]] std::size_t num_workers() const override;
  /// Errors: kInvalidArgument naming the rank that is at another job; what kept a rank from
  /// beginning; kMalformedFile for a message that is none of this; kUnavailable when no thread can
  /// be started.
  [[nodiscard]] Result<std::vector<TaskOutcome>> run(std::span<const CrewTask> tasks,
                                                     const TaskWork& work,
                                                     const TaskDone& done) override;

 private:
  class Shift;

  MessagePort& port_;
  std::string job_;
  std::set<std::size_t> idle_;                  ///< Ranks that wait for a task.
  std::map<std::size_t, std::size_t> at_work_;  ///< The task of each rank that has one.
};

/// Does what rank 0 asks for, on any other rank, until it is let go. `job` as of RankCrew; an error
/// is what keeps this rank from beginning: rank 0 is told, which ends the job.
void serve_rank(MessagePort& port, const Result<std::string>& job, const TaskWork& work);

}  // namespace hypermap
