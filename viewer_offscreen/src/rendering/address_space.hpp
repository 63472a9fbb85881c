// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether foreign libraries will find memory: some crash or name another reason where there is
/// none.
#pragma once

#include <sys/mman.h>

#include <cstddef>

namespace hypermap {

/// Whether the process may take so many more bytes of addresses at once (`ulimit -v`); none are
/// kept. Threads that allocate meanwhile may take them first.
[[nodiscard]] inline bool has_address_space(std::size_t num_bytes) {
  void* const reserved =
      ::mmap(nullptr, num_bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (reserved == MAP_FAILED) return false;
  ::munmap(reserved, num_bytes);
  return true;
}

}  // namespace hypermap
