// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The images that `hypermap eval` writes when it is asked to.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/jobs/evaluation_job.hpp"

#include <optional>
#include <string>

namespace hypermap::app {

struct EvaluationImages {
  std::optional<std::string> reliability;  ///< Of draw_reliability.
  std::optional<std::string> plan;         ///< Of draw_compared_plan.
  std::string title;                       ///< Of draw_compared_plan.
};

/// Each is replaced atomically. Errors: kIo, with what was written before; those of
/// draw_compared_plan.
[[nodiscard]] Result<void> write_images(const EvaluationOutcome& outcome,
                                        const EvaluationImages& images);

}  // namespace hypermap::app
