// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// CPU time of this process: what a figure means on a machine that others use as well; and what a
/// clock on the wall says, of work that several threads share.
#pragma once

#include <chrono>
#include <ctime>

namespace hypermap::test {

/// CPU time of all threads of this process so far.
inline double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Runs `work` and returns the CPU time it took, of all threads.
template <class Work>
double cpu_time_of(Work&& work) {
  const double before = cpu_seconds();
  work();
  return cpu_seconds() - before;
}

struct WorkSeconds {
  double cpu = 0.0;   ///< Of all threads.
  double wall = 0.0;  ///< On a machine that others use too it takes longer.
};

template <class Work>
WorkSeconds seconds_of(Work&& work) {
  const auto begin = std::chrono::steady_clock::now();
  const double cpu = cpu_time_of(work);
  return {.cpu = cpu,
          .wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()};
}

}  // namespace hypermap::test
