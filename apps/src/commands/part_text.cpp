// SPDX-License-Identifier: BSD-3-Clause
#include "part_text.hpp"

#include <cstdio>

namespace hypermap::app {

std::size_t num_voxels(const MapArchive& archive) {
  if (!archive.octree) return 0;
  const LeafCount leaves = archive.octree->num_leaves();
  return leaves.occupied + leaves.free;
}

ExitCode warn_of_left_out(const std::string& command, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    std::fprintf(
        stderr, "%s: cannot be divided, left out: %s\n", command.c_str(), printable(name).c_str());
  }
  return names.empty() ? ExitCode::kDone : ExitCode::kFindings;
}

}  // namespace hypermap::app
