// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/preset_name.hpp"

#include <algorithm>
#include <cstddef>

namespace hypermap {
namespace {

constexpr std::string_view kPresetNames[] = {"default", "smap", "hypermap"};

}  // namespace

std::span<const std::string_view> preset_names() {
  return kPresetNames;
}

std::optional<PresetName> preset_of(std::string_view name) {
  const auto found = std::ranges::find(kPresetNames, name);
  if (found == std::end(kPresetNames)) return std::nullopt;
  return static_cast<PresetName>(found - std::begin(kPresetNames));
}

std::string_view to_string(PresetName name) {
  return kPresetNames[static_cast<std::size_t>(name)];
}

}  // namespace hypermap
