// SPDX-License-Identifier: BSD-3-Clause
#include "reserved_names.hpp"

#include "extension_entries.hpp"
#include "guessed_config.hpp"
#include "layers/layer_files.hpp"

#include <algorithm>

namespace hypermap {
namespace {

/// Letters of ASCII in lower case.
std::string folded(std::string_view name) {
  std::string out(name);
  std::ranges::transform(out, out.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return out;
}

}  // namespace

ReservedNames::ReservedNames(const HypermapConfig& config, bool is_config_guessed)
    : has_grids_(is_config_guessed) {
  for (const LayerEntry& entry : config.layers) stems_.insert(folded(stem_of(entry.info)));
  for (const ExtensionEntry& entry : config.extensions) stems_.insert(folded(entry.file));
  for (const std::string_view format : single_formats()) stems_.insert(new_entry(format).file);
  if (is_config_guessed) stems_.insert({"occupancy", "semantic"});
}

bool ReservedNames::contains(std::string_view name) const {
  const std::string asked = folded(name);
  if (has_grids_ && asked.starts_with("class_grid_")) return true;
  for (std::size_t end = asked.size(); end != std::string::npos && end > 0;
       end = asked.rfind('.', end - 1)) {
    if (stems_.contains(std::string_view(asked).substr(0, end))) return true;
  }
  return false;
}

}  // namespace hypermap
