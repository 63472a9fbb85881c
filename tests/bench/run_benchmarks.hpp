// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What `main` of a benchmark does once all are registered.
#pragma once

#include <benchmark/benchmark.h>

namespace hypermap::test {

/// Returns the program's exit code: 2 for arguments that nobody knows.
inline int run_benchmarks(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace hypermap::test
