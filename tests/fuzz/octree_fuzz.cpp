// SPDX-License-Identifier: BSD-3-Clause
// `.ot` and `.bt`; a tree of any kind becomes a map of our own, which is saved, too.
#include "fuzz_target.hpp"
#include "hypermap/io/archive/octomap_file.hpp"
#include "targets.hpp"

#include <utility>

namespace hypermap::fuzz {

void fuzz_octree(std::string_view bytes) {
  const auto read = [](std::string_view text) -> Result<OctomapTree> {
    HYPERMAP_ASSIGN_OR_RETURN(auto loaded, parse_octomap(text, kFuzzSource));
    return std::move(loaded.value);
  };
  require_round_trip(bytes, read, write_octomap);
  const auto tree = read(bytes);
  if (!tree) return;
  const auto map =
      to_semantic_octree(*tree, {}, {.max_voxels = 1U << 16U, .unchecked_voxels = 512});
  if (!map) return;
  const auto written = write_octomap(to_octomap_tree(map->value));
  const auto again = read(require(written, "a map of any tree can be written"));
  require(require(again, "it is read again") == to_octomap_tree(map->value), "as the same tree");
}

}  // namespace hypermap::fuzz
