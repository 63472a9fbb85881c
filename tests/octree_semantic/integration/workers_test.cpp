// SPDX-License-Identifier: BSD-3-Clause
#include "integration/workers.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <vector>

namespace {

constexpr long kPlenty = std::numeric_limits<long>::max();

/// Pieces of work for which TBB still finds memory.
std::atomic<long>& pieces_left() {
  static std::atomic<long> left = kPlenty;
  return left;
}

}  // namespace

// tbb::detail::r1::allocate, where TBB takes the memory of a piece of work; the linker leads it
// here. NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" {
void* __real__ZN3tbb6detail2r18allocateERPNS0_2d117small_object_poolEm(void** pool,
                                                                       std::size_t size);
void* __real__ZN3tbb6detail2r18allocateERPNS0_2d117small_object_poolEmRKNS2_14execution_dataE(
    void** pool, std::size_t size, const void* execution);
void* __wrap__ZN3tbb6detail2r18allocateERPNS0_2d117small_object_poolEm(void** pool,
                                                                       std::size_t size);
void* __wrap__ZN3tbb6detail2r18allocateERPNS0_2d117small_object_poolEmRKNS2_14execution_dataE(
    void** pool, std::size_t size, const void* execution);

void* __wrap__ZN3tbb6detail2r18allocateERPNS0_2d117small_object_poolEm(void** pool,
                                                                       std::size_t size) {
  if (pieces_left()-- <= 0) throw std::bad_alloc();
  return __real__ZN3tbb6detail2r18allocateERPNS0_2d117small_object_poolEm(pool, size);
}
void* __wrap__ZN3tbb6detail2r18allocateERPNS0_2d117small_object_poolEmRKNS2_14execution_dataE(
    void** pool, std::size_t size, const void* execution) {
  if (pieces_left()-- <= 0) throw std::bad_alloc();
  return __real__ZN3tbb6detail2r18allocateERPNS0_2d117small_object_poolEmRKNS2_14execution_dataE(
      pool, size, execution);
}
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

namespace hypermap {
namespace {

constexpr std::size_t kNumChunks = 200;

TEST(Workers, EachChunkIsDoneOnceWhereverTheMemoryOfTheThreadsEnds) {
  Workers workers;
  workers.set_num_threads(2);
  int num_ended_early = 0;
  for (long pieces = 0; pieces < 24; ++pieces) {
    std::vector<std::atomic<int>> times(kNumChunks);
    std::vector<std::uint8_t> done(kNumChunks, 0);
    pieces_left() = pieces;
    workers.finish_each(done, [&](std::size_t slot, std::size_t chunk) {
      EXPECT_LT(slot, workers.num_slots());
      ++times[chunk];
    });
    if (pieces_left() < 0) ++num_ended_early;
    pieces_left() = kPlenty;
    for (std::size_t chunk = 0; chunk < kNumChunks; ++chunk) {
      EXPECT_EQ(times[chunk], 1) << pieces << " pieces, chunk " << chunk;
      EXPECT_EQ(done[chunk], 1);
    }
  }
  if (workers.num_slots() > 1) {
    EXPECT_GT(num_ended_early, 0);
  }
}

TEST(Workers, WithoutMemoryAnOrdinaryLoopThrows) {
  Workers workers;
  workers.set_num_threads(2);
  if (workers.num_slots() == 1) GTEST_SKIP() << "one core: no threads that want memory";
  pieces_left() = 0;
  EXPECT_THROW(workers.for_each(kNumChunks, [](std::size_t, std::size_t) {}), std::bad_alloc);
  pieces_left() = kPlenty;
}

}  // namespace
}  // namespace hypermap
