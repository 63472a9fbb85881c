// SPDX-License-Identifier: BSD-3-Clause
#include "support/allocation_faults.hpp"

#include "support/sanitized.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>

namespace hypermap::test {
namespace {

constexpr long kAll = std::numeric_limits<long>::max();

struct Memory {
  std::atomic<long> num_granted{kAll};
  std::atomic<MemoryLoss> loss{MemoryLoss::kOnce};
};

Memory& memory() {
  static constinit Memory value;  // is there before the first allocation
  return value;
}

#if !HYPERMAP_THREAD_SANITIZER
bool is_granted() {
  Memory& now = memory();
  if (now.num_granted == kAll) return true;
  const long left = now.num_granted--;
  return left > 0 || (left < 0 && now.loss == MemoryLoss::kOnce);
}
#endif

}  // namespace

AllocationFaults::AllocationFaults(long num_granted, MemoryLoss loss) {
  memory().loss = loss;
  memory().num_granted = num_granted;
}

AllocationFaults::~AllocationFaults() {
  memory().num_granted = kAll;
}

bool AllocationFaults::happened() const {
  return memory().num_granted < 0;
}

}  // namespace hypermap::test

#if !HYPERMAP_THREAD_SANITIZER
namespace {

void* allocated_or_null(std::size_t size, std::size_t alignment) noexcept {
  if (!hypermap::test::is_granted()) return nullptr;
  const std::size_t whole =
      (std::max<std::size_t>(size, 1) + alignment - 1) / alignment * alignment;
  return std::aligned_alloc(alignment, whole);
}

void* allocated(std::size_t size, std::size_t alignment) {
  if (void* memory = allocated_or_null(size, alignment)) return memory;
  throw std::bad_alloc();
}

constexpr std::size_t kUsual = alignof(std::max_align_t);

}  // namespace

// Not inlined: GCC 12 takes an inlined half of a pair for a mismatch. The forms for arrays and for
// exact sizes lead to these by themselves.
[[gnu::noinline]] void* operator new(std::size_t size) {
  return allocated(size, kUsual);
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return allocated_or_null(size, kUsual);
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocated(size, static_cast<std::size_t>(alignment));
}
[[gnu::noinline]] void* operator new(std::size_t size,
                                     std::align_val_t alignment,
                                     const std::nothrow_t&) noexcept {
  return allocated_or_null(size, static_cast<std::size_t>(alignment));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
#endif
