// SPDX-License-Identifier: BSD-3-Clause
#include "program_run.hpp"

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  hypermap::app::prepare_process();
  const int status = hypermap::app::run_program(nullptr, argc, argv);
  std::fflush(nullptr);
#if defined(HYPERMAP_FINALISERS)
  return status;
#else
  // All is written. What libraries do after main (drivers end threads, compilers free their pools)
  // may fail where memory is short, and must not become the status of the run.
  std::_Exit(status);
#endif
}
