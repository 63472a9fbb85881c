// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/mapping_job.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

TEST(MappingJob, RefusesADeadline) {
  MappingJob job;
  job.mapper.deadline.rule = DeadlineRule::kFixed;
  const auto refused = run_mapping(job);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(refused.error().field, "deadline.rule");
}

}  // namespace
}  // namespace hypermap
