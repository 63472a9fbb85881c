// SPDX-License-Identifier: BSD-3-Clause
// Memory ends at every allocation of a frame, whichever thread asks for it: a program of its own.
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"
#include "octree_semantic/support/detected_frame.hpp"
#include "support/allocation_faults.hpp"
#include "support/sanitized.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <new>
#include <optional>
#include <tuple>
#include <vector>

#if !HYPERMAP_THREAD_SANITIZER
namespace hypermap {
namespace {

using test::AllocationFaults;
using test::MemoryLoss;

const std::vector<RgbdFrame>& seen_frames() {
  static const std::vector<RgbdFrame> kFrames = test::detected_room_frames(2, 160);
  return kFrames;
}

/// The next allocation to fail comes this part of those granted after the last.
constexpr long kSpacing = test::kSanitized ? 8 : 16;

/// Threads, and how often a snapshot is published.
class WithoutMemory : public ::testing::TestWithParam<std::tuple<int, int, MemoryLoss>> {
 protected:
  static SemanticMapper mapper() {
    SemanticMapperOptions options;
    options.num_threads = std::get<0>(GetParam());
    options.publish_every_n_frames = std::get<1>(GetParam());
    return SemanticMapper::create(options).value();
  }
};
INSTANTIATE_TEST_SUITE_P(All,
                         WithoutMemory,
                         ::testing::Combine(::testing::Values(1, 2),
                                            ::testing::Values(0, 1),
                                            ::testing::Values(MemoryLoss::kOnce,
                                                              MemoryLoss::kFromThen)));

/// Nothing when not even the error finds room.
std::optional<Result<FrameReport>> integrated(SemanticMapper& mapper, const RgbdFrame& frame) {
  try {
    return mapper.integrate(frame);
  } catch (const std::bad_alloc&) {
    return std::nullopt;
  }
}

TEST_P(WithoutMemory, AFrameIsWholeOrNotAtAll) {
  const MemoryLoss loss = std::get<2>(GetParam());
  const RgbdFrame& frame = seen_frames()[1];
  SemanticMapper expected = mapper();
  ASSERT_TRUE(expected.integrate(seen_frames()[0]));
  ASSERT_TRUE(expected.integrate(frame));
  std::size_t num_refused = 0;
  long granted = 0;
  for (bool done = false; !done; granted += 1 + granted / kSpacing) {
    SemanticMapper mapper = WithoutMemory::mapper();
    ASSERT_TRUE(mapper.integrate(seen_frames()[0]));
    const SemanticOctree octree = mapper.octree();
    const ObjectMap objects = mapper.objects();
    std::optional<Result<FrameReport>> report;
    {
      const AllocationFaults faults(granted, loss);
      report = integrated(mapper, frame);
      done = !faults.happened();
    }
    const bool is_in = report && *report;
    if (mapper.options().publish_every_n_frames == 1) {
      const bool published = is_in && (*report)->published;
      const auto snapshot = mapper.snapshot();
      ASSERT_TRUE(snapshot->octree == (published ? mapper.octree() : octree));
      ASSERT_TRUE(snapshot->objects == (published ? mapper.objects() : objects));
    }
    if (!is_in) {
      ++num_refused;
      if (loss == MemoryLoss::kOnce) {
        ASSERT_TRUE(report) << "after " << granted << " allocations an exception came out";
        EXPECT_EQ(report->error().code, ErrorCode::kOutOfMemory);
      }
      ASSERT_TRUE(mapper.octree() == octree) << "after " << granted << " allocations";
      ASSERT_TRUE(mapper.objects() == objects) << "after " << granted << " allocations";
      ASSERT_TRUE(mapper.integrate(frame)) << "it can be tried again";
    }
    ASSERT_TRUE(mapper.octree() == expected.octree()) << "after " << granted << " allocations";
    if (!is_in || (*report)->visibility_evaluated) {
      ASSERT_TRUE(mapper.objects() == expected.objects()) << "after " << granted << " allocations";
    }
  }
  EXPECT_GE(num_refused, 20U);
}

}  // namespace
}  // namespace hypermap
#endif
