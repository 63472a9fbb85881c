// SPDX-License-Identifier: BSD-3-Clause
// A camera of what is said is written and read again.
#include "fuzz_target.hpp"
#include "hypermap/io/dataset/intrinsics_file.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_intrinsics(std::string_view bytes) {
  const auto read = read_intrinsics(file_of(bytes, "camera.json"));
  if (!read) return;
  const Intrinsics& said = read->value;
  const auto camera = camera_of(said, said.width_px.value_or(640), said.height_px.value_or(480));
  if (!camera) return;
  const std::string written = to_intrinsics_json(*camera, said.depth_units_per_m.value_or(1000.0));
  const auto again = read_intrinsics(file_of(written, "written.json"));
  require(require(again, "what was written is read").value.fx_px == said.fx_px &&
              again->value.cy_px == said.cy_px && again->value.width_px == camera->width_px,
          "as the same camera");
}

}  // namespace hypermap::fuzz
