// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "hypermap/io/archive/listed_instances_file.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_listed(std::string_view bytes) {
  const auto listed = parse_listed_instances(bytes, kFuzzSource);
  if (!listed) return;
  for (const ListedInstance& instance : listed->instances) {
    const Box box = box_in_map(instance, listed->up_in_input, {});
    require(box.min_in_map.allFinite() && box.max_in_map.allFinite(), "a box is finite");
    require(box.extent().minCoeff() > 0.0, "a box has positive sides");
  }
}

}  // namespace hypermap::fuzz
