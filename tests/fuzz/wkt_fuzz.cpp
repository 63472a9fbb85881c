// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "hypermap/io/codec/wkt.hpp"
#include "targets.hpp"

#include <utility>
#include <vector>

namespace hypermap::fuzz {

void fuzz_wkt(std::string_view bytes) {
  constexpr WktLimits kLimits{.max_vertices = 1'000, .max_holes = 50, .max_parts = 20};
  require_round_trip(
      bytes,
      [&](std::string_view text) -> Result<std::vector<Polygon>> {
        HYPERMAP_ASSIGN_OR_RETURN(WktShape shape, read_wkt(text, kLimits));
        return std::move(shape.parts);
      },
      [](const std::vector<Polygon>& parts) { return write_wkt(parts); });
}

}  // namespace hypermap::fuzz
