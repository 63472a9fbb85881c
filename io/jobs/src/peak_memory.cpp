// SPDX-License-Identifier: BSD-3-Clause
#include "peak_memory.hpp"

#include <sys/resource.h>

namespace hypermap {

std::size_t peak_rss_bytes() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024U;
}

}  // namespace hypermap
