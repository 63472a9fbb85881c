// SPDX-License-Identifier: BSD-3-Clause
#include "mapping_job_checks.hpp"

#include "hypermap/io/archive/provenance.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "run_checkpoint.hpp"

namespace hypermap {
namespace {

/// A map does not depend on the clock.
Result<void> refuse_deadline(const DeadlineOptions& options) {
  if (options.rule == DeadlineRule::kNone) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be none: what is mapped from a dataset may not depend on the clock",
              "deadline.rule");
}

Result<void> refuse_two_worlds(const MappingJob& job) {
  if (!job.same_world || !job.placement) return {};
  return fail(ErrorCode::kInvalidArgument,
              "the input's world is that of the map or lies elsewhere in it, not both",
              "same_world");
}

Result<void> refuse_mixed_poses(const MappingJob& job) {
  if (!job.poses || !job.append) return {};
  return fail(ErrorCode::kInvalidArgument,
              "a map is built anew with corrected poses, what it holds has the old ones",
              "append");
}

}  // namespace

Result<void> check_job(const MappingJob& job) {
  HYPERMAP_TRY(refuse_deadline(job.mapper.deadline));
  HYPERMAP_TRY(refuse_two_worlds(job));
  HYPERMAP_TRY(refuse_mixed_poses(job));
  if (job.session) HYPERMAP_TRY(check_session_name(*job.session));
  HYPERMAP_TRY(validate(job.layers));
  HYPERMAP_TRY(validate(job.looks));
  HYPERMAP_TRY(check_target(job.output));
  if (job.checkpoint_every > 0) HYPERMAP_TRY(check_target(checkpoint_path(job.output)));
  return {};
}

}  // namespace hypermap
