// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/preset_name.hpp"

namespace hypermap {

std::optional<PresetName> preset_of(std::string_view name) {
  for (const PresetName preset : {PresetName::kDefault, PresetName::kSmap, PresetName::kHypermap}) {
    if (to_string(preset) == name) return preset;
  }
  return std::nullopt;
}

std::string_view to_string(PresetName name) {
  switch (name) {
    case PresetName::kSmap:
      return "smap";
    case PresetName::kHypermap:
      return "hypermap";
    case PresetName::kDefault:
      break;
  }
  return "default";
}

}  // namespace hypermap
