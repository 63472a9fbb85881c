// SPDX-License-Identifier: BSD-3-Clause
// hypermap-ranks: hypermap as one of the ranks of an MPI job; `hypermap map-many --ranks` runs it.
#include "command.hpp"
#include "mpi_port.hpp"
#include "program_run.hpp"

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  hypermap::app::prepare_process();
  int status = 0;
  {
    const auto port = hypermap::app::MpiPort::open();
    status = port ? hypermap::app::run_program(port->get(), argc, argv)
                  : static_cast<int>(hypermap::app::report(port.error()));
    std::fflush(nullptr);
  }
#if defined(HYPERMAP_FINALISERS)
  return status;
#else
  std::_Exit(status);  // as in main.cpp
#endif
}
