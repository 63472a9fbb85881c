// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The named sets of options.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace hypermap {

enum class PresetName : std::uint8_t {
  kDefault,   ///< Ours: what the evaluation shows to be best.
  kSmap,      ///< The configuration of [smap], tables D.1 and D.2.
  kHypermap,  ///< The configuration of [hypermap], best shape and overlap.
};

/// "default", "smap", "hypermap": in the order of the enumerators.
[[nodiscard]] std::span<const std::string_view> preset_names();

/// One of preset_names(). None for other names.
[[nodiscard]] std::optional<PresetName> preset_of(std::string_view name);
[[nodiscard]] std::string_view to_string(PresetName name);

}  // namespace hypermap
