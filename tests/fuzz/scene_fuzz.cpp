// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "hypermap/io/simulator/scene_file.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_scene(std::string_view bytes) {
  static_cast<void>(parse_scene(bytes, kFuzzSource.file));
}

}  // namespace hypermap::fuzz
