// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Names of members that parts of a map bear, which no other member may have.
#pragma once

#include "hypermap/io/archive/hypermap_config.hpp"

#include <set>
#include <string>
#include <string_view>

namespace hypermap {

/// The files of a configuration, those that archives of ours have, and, where the configuration was
/// guessed, those of the layers that follow from others.
class ReservedNames {
 public:
  ReservedNames(const HypermapConfig& config, bool is_config_guessed);

  /// Whether a name is one of them, or one with a suffix behind. Upper and lower case alike: an
  /// archive has no two members that differ by it alone.
  [[nodiscard]] bool contains(std::string_view name) const;

 private:
  std::set<std::string, std::less<>> stems_;
  bool has_grids_;  ///< Those of class grids, too.
};

}  // namespace hypermap
