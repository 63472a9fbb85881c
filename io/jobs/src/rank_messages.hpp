// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What ranks say to each other, as JSON.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/jobs/work_crew.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace hypermap {

/// A rank is at this job and waits for a task.
struct RankIsReady {
  std::string job;
};
/// A rank cannot begin.
struct RankCannotBegin {
  Error error;
};
/// A rank has done its task and waits for another one.
struct RankIsDone {
  TaskOutcome outcome;
};
using RankSays = std::variant<RankIsReady, RankCannotBegin, RankIsDone>;

[[nodiscard]] std::string write_rank_says(const RankSays& says);
/// Errors: kMalformedFile.
[[nodiscard]] Result<RankSays> parse_rank_says(std::string_view bytes);

/// The task that a rank is to do; none: it is let go.
using RankTask = std::optional<std::size_t>;

[[nodiscard]] std::string write_rank_task(const RankTask& task);
/// Errors: kMalformedFile.
[[nodiscard]] Result<RankTask> parse_rank_task(std::string_view bytes);

}  // namespace hypermap
