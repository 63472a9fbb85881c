// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Lets memory end in a test program that has support/allocation_faults.cpp among its sources:
/// every form of operator new, in every thread, asks here first. Clang's thread sanitizer lets no
/// program replace them.
#pragma once

namespace hypermap::test {

enum class MemoryLoss {
  kOnce,      ///< One allocation fails.
  kFromThen,  ///< It and all that follow.
};

/// While it lives the allocation after `num_granted` more fails. One at a time.
class AllocationFaults {
 public:
  AllocationFaults(long num_granted, MemoryLoss loss);
  ~AllocationFaults();
  AllocationFaults(const AllocationFaults&) = delete;
  AllocationFaults& operator=(const AllocationFaults&) = delete;
  AllocationFaults(AllocationFaults&&) = delete;
  AllocationFaults& operator=(AllocationFaults&&) = delete;

  /// Whether an allocation has failed.
  [[nodiscard]] bool happened() const;
};

}  // namespace hypermap::test
